#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the documentation site from docs/ into build/site: open build/site/index.html. It needs no network, nor do its pages.
#
#   tools/build_docs.sh [FOLDER]    the site goes into FOLDER in place of build/site
#
# Every warning of Sphinx is an error: a link that leads nowhere, a picture that is missing, a page that nothing leads to.
# Exit codes: 0 built, 64 wrong usage, 69 Sphinx is not installed, else that of sphinx-build.
set -euo pipefail
cd -P -- "$(dirname -- "${BASH_SOURCE[0]}")/.."

if [[ $# -gt 1 || "${1:-}" == -* ]]; then
  echo "usage: tools/build_docs.sh [FOLDER]" >&2
  exit 64
fi
site=${1:-build/site}
# Debian's own Python: another one on PATH may lack the packages.
if ! /usr/bin/python3 -c 'import sphinx, myst_parser, furo' 2>/dev/null; then
  echo "build_docs: Sphinx, MyST or the theme is missing; tools/install_dependencies.sh test installs them" >&2
  exit 69
fi
# Always from the beginning, which takes seconds: else pages that did not change would keep an old table of contents.
/usr/bin/python3 -m sphinx -q -E -a -W --keep-going -j auto -b html -c docs/site -d "$site/.doctrees" docs "$site"
rm -rf "$site/.doctrees" "$site/.buildinfo" "$site/objects.inv"
echo "build_docs: open $site/index.html"
