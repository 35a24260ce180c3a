#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes the program and the style of the report page, build/page/page.js and page.css, from web/.
#
#   tools/build_page.sh
#
# The library takes them in when it is built. Does nothing when they are there and nothing in web/ has changed. Without node and
# npm, or without a way to the packages that web/package-lock.json names, it says so in one line and leaves what is there: then
# the program is built all the same, and `dem4grm report` says what is missing.
set -euo pipefail
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

page=build/page
log=build/logs/page.log
without_page() {
  echo "build_page: $1; the program will carry no report page" >&2
  exit 0
}

# What the page is made from; the same sources and packages give the same page.
state=$(find web -name node_modules -prune -o -type f -not -path 'web/test/*' -print0 | LC_ALL=C sort -z |
  xargs -0 sha256sum | sha256sum)
if [[ -s $page/page.js && -s $page/page.css && "$(cat "$page/made_from" 2>/dev/null)" == "$state" ]]; then
  echo "build_page: $page is up to date"
  exit 0
fi
command -v node >/dev/null && command -v npm >/dev/null || without_page "node and npm are not installed"
mkdir -p "$page" "$(dirname -- "$log")"
packages=$(sha256sum web/package-lock.json)
if [[ ! -d web/node_modules || "$(cat web/node_modules/.made_from 2>/dev/null)" != "$packages" ]]; then
  npm ci --prefix web --no-audit --no-fund >"$log" 2>&1 || without_page "npm could not fetch the packages of web/ ($log)"
  echo "$packages" >web/node_modules/.made_from
fi
# An error in the page itself is a failure, not a page less.
if ! npm run --silent --prefix web build >>"$log" 2>&1; then
  cat "$log" >&2
  echo "build_page: the page could not be built" >&2
  exit 1
fi
echo "$state" >"$page/made_from"
echo "build_page: $(stat -c %s "$page/page.js") bytes of script, $(stat -c %s "$page/page.css") of style in $page"
