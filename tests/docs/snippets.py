# SPDX-License-Identifier: BSD-3-Clause
"""The fenced blocks of a Markdown page, and how a test runs them in the order in which a reader does.

A block says by its language what becomes of it: `sh` is typed into one shell, `python` is run by Debian's Python and `matlab` by
Octave where that is installed. A comment before a block, which no reader sees, says anything else:

    <!-- not run: REASON -->    it is left out
    <!-- run by: PAGE -->       the same commands stand in a page of docs/how-to that another test runs; that they do is checked
    <!-- file: NAME -->         the block is written into this file of the working folder
    <!-- output -->             each line of it is printed by the block before, in this order; `...` stands for anything
    <!-- small -->              the cases that `dem4grm new` writes in it are made small before the next command reads them

Any other block is a mistake of the page: nothing that looks like a command goes untested in silence.
"""
import re
import shutil
import subprocess
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"(?:^<!-- (?P<marker>[^\n]*?) -->\n+)?^(?P<fence>```+)(?P<language>[^\n`]*)\n(?P<text>.*?)^(?P=fence)[ \t]*$",
                   re.MULTILINE | re.DOTALL)
RUN_LANGUAGES = {"sh", "python", "matlab"}
IMPORTS_PACKAGE = re.compile(r"^(?:import|from) dem4grm\b", re.MULTILINE)

# What `<!-- small -->` does to a case of the published size, which takes hours: the keys are there, only their values change.
SMALL = {"length": '"30 mm"', "width": '"30 mm"', "height": '"30 mm"', "velocity": '"50 mm/s"', "displacement": '"4.1 mm"',
         "relative_density": "preparation_friction = 0.3"}


@dataclass
class Block:
    number: int
    language: str
    text: str
    action: str  # run, file, output, left out, elsewhere, or wrong
    argument: str = ""  # file name, reason, or page
    small: bool = False


def blocks_of(page_text):
    blocks = []
    for number, found in enumerate(BLOCK.finditer(page_text), 1):
        language, marker = found["language"].strip(), found["marker"] or ""
        block = Block(number, language, found["text"], "wrong")
        if marker.startswith("not run: ") and len(marker) > len("not run: ") + 10:
            block.action, block.argument = "left out", marker.removeprefix("not run: ")
        elif marker.startswith("run by: "):
            block.action, block.argument = "elsewhere", marker.removeprefix("run by: ")
        elif marker.startswith("file: "):
            block.action, block.argument = "file", marker.removeprefix("file: ")
        elif marker == "output":
            block.action = "output"
        elif language in RUN_LANGUAGES:
            block.action, block.small = "run", marker == "small"
        if block.action == "run" and language == "matlab" and not shutil.which("octave"):
            block.action, block.argument = "left out", "Octave is not installed"
        if block.action == "run" and language == "python" and IMPORTS_PACKAGE.search(block.text) and not find_spec("dem4grm"):
            block.action, block.argument = "left out", "the Python package is not built here (DEM4GRM_BUILD_PYTHON)"
        blocks.append(block)
    return blocks


def without_remarks(text):
    return [command for line in text.splitlines() if (command := re.sub(r"(^|\s+)#.*$", "", line).strip())]


def commands_of(page_text):
    """The commands that a page tells its reader to type, in order; those that are marked as not run are left out."""
    return [line for b in blocks_of(page_text) if b.action == "run" and b.language == "sh" for line in without_remarks(b.text)]


def complaints(name, page_text):
    """What is wrong with the blocks of a page before anything is run."""
    found = [f"{name}: block {b.number} ({b.text.strip().splitlines()[0] if b.text.strip() else 'empty'}) is neither run nor marked"
             for b in blocks_of(page_text) if b.action == "wrong"]
    for block in blocks_of(page_text):
        if block.action == "elsewhere":
            there = set(commands_of((ROOT / block.argument).read_text(encoding="utf-8")))
            found += [f"{name}: {command} is not in {block.argument}" for command in without_remarks(block.text) if command not in there]
    # A fence that the pattern does not see would hide a block.
    fences = len(re.findall(r"^\s*(?:```|~~~)", page_text, re.MULTILINE))
    if fences != 2 * len(blocks_of(page_text)):
        found.append(f"{name}: {fences} fences, but {len(blocks_of(page_text))} blocks; blocks begin at the margin with ```")
    return found


def make_small(text):
    for key, value in SMALL.items():
        new = value if " = " in value else f"{key} = {value}"
        text, count = re.subn(rf"(?m)^{key} = .*$", lambda _: new, text)
        if count != 1:
            raise AssertionError(f"the case that `dem4grm new` writes has {count} lines with the key {key}")
    return text


def script_of(blocks, pieces):
    """One shell for the whole page, as its reader has one; a mark before each block parts the output."""
    lines = ["set -e -o pipefail"]
    for block in blocks:
        piece = pieces / f"{block.number}.{block.language or 'txt'}"
        piece.write_text(block.text, encoding="utf-8")
        lines.append(f"echo '@@block {block.number}'")
        if block.action == "file":
            lines.append(f"mkdir -p \"$(dirname '{block.argument}')\" && cp '{piece}' '{block.argument}'")
        elif block.action == "run" and block.language == "sh":
            lines.append(f"export DEM4GRM_SNIPPETS_SMALL={'yes' if block.small else ''}")
            lines.append(block.text)
        elif block.action == "run":
            lines.append(f"/usr/bin/python3 '{piece}'" if block.language == "python" else f"octave --no-gui --quiet '{piece}'")
    return "\n".join(lines) + "\n"


def prepare(folder, program):
    """A working folder that looks like the source after `./run.sh`. The program in it is a small script around the real one: after
    `new` in a block that is marked so it makes the case small."""
    for name in ("cases", "tools", "examples"):
        if (ROOT / name).exists():
            (folder / name).symlink_to(ROOT / name)
    place = folder / "build/run/apps/dem4grm"
    place.mkdir(parents=True)
    if not (folder / "pieces").exists():
        (folder / "pieces").mkdir()
    wrapper = place / "dem4grm"
    wrapper.write_text(f"""#!/usr/bin/env bash
'{program}' "$@" || exit
if [[ "$DEM4GRM_SNIPPETS_SMALL" == yes && "$1" == new ]]; then
  /usr/bin/python3 -c 'import sys; sys.path.insert(0, sys.argv[1]); import snippets; snippets.shrink(sys.argv[2])' \\
    '{Path(__file__).parent}' "${{@: -1}}"
fi
""", encoding="utf-8")
    wrapper.chmod(0o755)


def shrink(case):
    path = Path(case)
    path.write_text(make_small(path.read_text(encoding="utf-8")), encoding="utf-8")


def lines_missing(wanted, printed):
    """The first line of `wanted` that is not in `printed` behind those before it; empty when all are."""
    place = 0
    printed = [" ".join(line.split()) for line in printed.splitlines()]
    for line in wanted.splitlines():
        words = " ".join(line.split())
        if words in ("", "..."):
            continue
        pattern = re.compile(".*".join(re.escape(part.strip()) for part in words.split("...")))
        hit = next((k for k in range(place, len(printed)) if pattern.search(printed[k])), None)
        if hit is None:
            return line
        place = hit + 1
    return ""


def run_page(name, program, folder, environment):
    """Runs all blocks of a page in `folder`; raises with the output up to the mistake."""
    page = (ROOT / name).read_text(encoding="utf-8")
    wrong = complaints(name, page)
    if wrong:
        raise AssertionError("\n".join(wrong))
    blocks = blocks_of(page)
    prepare(folder, program)
    done = subprocess.run(["bash", "-c", script_of(blocks, folder / "pieces")], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, errors="replace")
    printed = dict(re.findall(r"@@block (\d+)\n(.*?)(?=@@block |\Z)", done.stdout, re.DOTALL))
    if done.returncode != 0:
        last = max(map(int, printed))
        raise AssertionError(f"{name}: block {last} ended with {done.returncode}\n{printed[str(last)]}")
    for before, block in zip(blocks, blocks[1:]):
        if block.action == "output":
            line = lines_missing(block.text, printed[str(before.number)])
            if line:
                raise AssertionError(f"{name}: block {before.number} does not print the line\n  {line}\nbut\n{printed[str(before.number)]}")
    return blocks, printed
