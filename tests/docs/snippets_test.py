#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs what the pages tell their readers to type: `snippets_test.py DEM4GRM PAGE...`, pages relative to the root of the source.

A page that needs a finished demo in runs/quick gets one of a smaller box, sheared faster; snippets.py says what the marks in a page
mean. With `--marks` nothing is run: all pages are only looked through for blocks that are neither run nor marked, the pages that
tests/cluster runs among them.
"""
import os
import re
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import snippets

ROOT = snippets.ROOT
PAGES = ["README.md", "docs/index.md", "docs/tutorial.md", *(str(p.relative_to(ROOT)) for p in sorted(ROOT.glob("docs/how-to/*.md")))]
DEMO = ["--set", 'box.length="30 mm"', "--set", 'box.width="30 mm"', "--set", 'box.height="30 mm"',
        "--set", 'shear.velocity="50 mm/s"', "--set", 'shear.displacement="8.1 mm"']


class Marks(unittest.TestCase):
    def test_every_block_is_run_or_says_why_not(self):
        self.assertEqual([c for page in PAGES for c in snippets.complaints(page, (ROOT / page).read_text(encoding="utf-8"))], [])

    def test_blocks_without_a_mark_are_found(self):
        for text in ("```\ndem4grm run my.toml\n```\n", "```toml\nseed = 1\n```\n", "<!-- not run: -->\n```\nls\n```\n",
                     "  ```sh\n  ls\n  ```\n", "<!-- not run: for reasons that are good -->\n\ntext\n\n```\nls\n```\n"):
            self.assertEqual(len(snippets.complaints("page", text)), 1, text)

    def test_marked_blocks_are_fine(self):
        text = "```sh\nls\n```\n<!-- output -->\n```\na\n```\n<!-- file: a.csv -->\n```csv\n1\n```\n<!-- not run: it takes hours -->\n```\nls\n```\n"
        self.assertEqual(snippets.complaints("page", text), [])
        self.assertEqual([b.action for b in snippets.blocks_of(text)], ["run", "output", "file", "left out"])

    def test_commands_that_another_page_runs_stand_there(self):
        page = "docs/how-to/campaign-on-a-workstation.md"
        text = f"<!-- run by: {page} -->\n```sh\ndem4grm campaign collect runs/quick-study   # all\n```\n"
        self.assertEqual(snippets.complaints("page", text), [])
        self.assertEqual(len(snippets.complaints("page", text.replace("collect", "gather"))), 1)

    def test_output_is_compared_in_order_and_with_gaps(self):
        printed = "first 1.5 s\nsecond   line\nthird\n"
        self.assertEqual(snippets.lines_missing("first ... s\nthird\n", printed), "")
        self.assertEqual(snippets.lines_missing("third\nfirst ... s\n", printed), "first ... s")
        self.assertEqual(snippets.lines_missing("second line\nforth\n", printed), "forth")


def make_demo(program, environment, folder):
    done = subprocess.run([program, "run", ROOT / "cases/quick.toml", "-o", folder, "-q", *DEMO], env=environment, text=True,
                          capture_output=True)
    if done.returncode != 0:
        raise AssertionError(f"the small demo ended with {done.returncode}\n{done.stdout}{done.stderr}")


def main(program, pages):
    environment = {**os.environ, "LC_ALL": "C.UTF-8", "MPLBACKEND": "Agg"}
    failures = 0
    with tempfile.TemporaryDirectory(prefix="dem4grm-snippets-") as folder:
        demo = Path(folder) / "demo"
        for page in pages:
            begin = time.monotonic()
            place = Path(folder) / page.replace("/", "-")
            (place / "runs").mkdir(parents=True)
            try:
                blocks = snippets.blocks_of((ROOT / page).read_text(encoding="utf-8"))
                if any(b.action == "run" and re.search(r"runs/quick\b(?!-)", b.text) for b in blocks):
                    if not demo.exists():
                        make_demo(program, environment, demo)
                    subprocess.run(["cp", "-r", demo, place / "runs/quick"], check=True)
                blocks, _ = snippets.run_page(page, program, place, environment)
                counts = ", ".join(f"{sum(b.action == a for b in blocks)} {a}" for a in ("run", "file", "output", "left out", "elsewhere"))
                print(f"{page}: {counts}; {time.monotonic() - begin:.0f} s", flush=True)
            except AssertionError as error:
                failures += 1
                print(f"FAILED {error}", flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["--marks"]:
        unittest.main(argv=sys.argv[:1])
    elif len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        sys.exit(64)
    else:
        sys.exit(main(str(Path(sys.argv[1]).resolve()), sys.argv[2:]))
