#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Holds files and functions to a size that can be read, and every source to its licence line.

Rules, by the name that an exception uses:
  file-length      a C++ file has at most 500 lines (a remark above 300);
  function-length  a C++ function has at most 120 lines, from the first line of its head to its closing brace;
  licence          a source or script names its licence in one of its first three lines;
  marker           no file holds a note of unfinished work: such notes belong into the list of issues.

Exceptions stand in tools/size_exceptions.txt, one a line: rule, path, reason. An exception without a reason, or one
that nothing needs any more, is a violation too. Exit code 1 if there is any.
"""
import argparse
import re
import subprocess
import sys
from pathlib import Path

FILE_LIMIT, FILE_REMARK, FUNCTION_LIMIT = 500, 300, 120
RULES = {"file-length", "function-length", "licence", "marker"}
CPP_SUFFIXES = {".cpp", ".hpp"}
CPP_FOLDERS = {"src", "apps", "tests", "bench", "python"}
SOURCE_SUFFIXES = {".cpp", ".hpp", ".h", ".cu", ".cuh", ".py", ".sh", ".cmake", ".ts", ".js", ".mjs"}
EXCEPTIONS = "tools/size_exceptions.txt"
LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
MARKER = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b")  # in pieces, so that this file passes its own check
SKIPPED_FOLDERS = {".git", "build", "node_modules", "__pycache__", ".cache"}  # and runs/ at the top

TOKEN = re.compile(
    r'(?P<raw>\b(?:u8|[uUL])?R"(?P<fence>[^()\s\\]{0,16})\(.*?\)(?P=fence)")'
    r"|(?P<comment>//[^\n]*|/\*.*?\*/)"
    r'|(?P<string>"(?:\\.|[^"\\\n])*")'
    r"|(?P<char>(?<![0-9a-fA-F])'(?:\\.|[^'\\\n])+'|\bu8'(?:\\.|[^'\\\n])+')"
    r"|(?P<directive>^[ \t]*\#(?:[^\n\\]|\\.)*)",
    re.DOTALL | re.MULTILINE,
)


def project_files(root: Path) -> list[Path]:
    """Files that git holds or would take; without git, all but those of built folders."""
    answer = subprocess.run(
        ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        capture_output=True, check=False) if (root / ".git").exists() else None
    if answer and answer.returncode == 0:
        files = (root / name for name in answer.stdout.decode().split("\0") if name)
    else:
        parts = {file: file.relative_to(root).parts for file in root.rglob("*")}
        files = (file for file in parts if not SKIPPED_FOLDERS & set(parts[file]) and parts[file][0] != "runs")
    return sorted({file for file in files if file.is_file() and not file.is_symlink()})


def plain_code(text: str) -> str:
    """The text without comments, literals and preprocessor lines; line breaks stay where they were."""
    def blank(found: re.Match) -> str:
        breaks = "\n" * found.group().count("\n")
        return '""' + breaks if found.lastgroup in ("raw", "string", "fence") else " " + breaks
    return TOKEN.sub(blank, text)


def without_brackets(head: str) -> str:
    """The head of a block with the contents of (...), [...] and template <...> taken out."""
    for pattern, stay in ((r"\([^()]*\)", "@"), (r"\[[^\[\]]*\]", " ")):
        while re.search(pattern, head):
            head = re.sub(pattern, stay, head)
    while re.search(r"<[^<>]*>", head):
        head = re.sub(r"<[^<>]*>", " ", head)
    return head


def block_kind(head: str) -> str:
    """What a `{` opens, told from the text in front of it: 'function', 'scope' or 'value'."""
    bare = without_brackets(head).strip()
    if re.search(r"\b(?:namespace|class|struct|union|enum)\b", bare):
        return "scope"
    if "@" not in bare:
        return "value" if bare.endswith(("=", ",", "return")) else "scope"
    if bare.endswith(("=", ",")):
        return "value"
    # `Box::Box(double w) : width_{w} {`: a brace after a member's name in the list in front of a body is a value.
    if re.search(r"@[^:]*(?<!:):(?!:)", bare) and re.search(r"[:,]\s*[\w: ]+$", bare):
        return "value"
    return "function"


def closing_brace(code: str, opening: int) -> int:
    depth = 0
    for found in re.compile(r"[{}]").finditer(code, opening):
        depth += 1 if found.group() == "{" else -1
        if depth == 0:
            return found.start()
    return len(code)


def functions(text: str) -> list[tuple[int, int, str]]:
    """(first line, number of lines, head) of every function that is not inside another one."""
    code = plain_code(text)
    found, head_start, position = [], 0, 0
    while position < len(code):
        letter = code[position]
        if letter in ";}":
            head_start = position + 1
        elif letter == "{":
            head = code[head_start:position]
            # A label such as `public:` does not belong to the head that follows it.
            label = re.match(r"(?:\s*\b(?:public|private|protected)\s*:(?!:))+", head)
            start = head_start + (label.end() if label else 0)
            kind = block_kind(code[start:position])
            if kind == "scope":
                head_start = position + 1
            else:
                end = closing_brace(code, position)
                if kind == "function":
                    first = start + len(code[start:position]) - len(code[start:position].lstrip())
                    line = code.count("\n", 0, first) + 1
                    last = code.count("\n", 0, end) + 1
                    found.append((line, last - line + 1, " ".join(code[first:position].split())))
                    head_start = end + 1
                else:  # a value: its text goes, the head goes on
                    breaks = "\n" * code.count("\n", position, end)
                    filler = "()" + " " * (end - 1 - position - len(breaks)) + breaks
                    code = code[:position] + filler + code[position + len(filler):]
                position = end
        position += 1
    return found


def is_source(file: Path, text: str) -> bool:
    return file.suffix in SOURCE_SUFFIXES or file.name == "CMakeLists.txt" or text.startswith("#!")


def check_file(name: str, file: Path, remarks: list[str]) -> list[tuple[str, str, str]]:
    """(rule, path, message) of each violation in one file."""
    try:
        text = file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return []  # not a text
    found = []
    if is_source(file, text) and not any(LICENCE in line for line in text.splitlines()[:3]):
        found.append(("licence", name, f"{name}:1: none of the first three lines says '{LICENCE}'"))
    for number, line in enumerate(text.splitlines(), 1):
        if MARKER.search(line):
            found.append(("marker", name, f"{name}:{number}: a note of unfinished work"))
    if file.suffix in CPP_SUFFIXES and name.split("/")[0] in CPP_FOLDERS:
        n_lines = len(text.splitlines())
        if n_lines > FILE_LIMIT:
            found.append(("file-length", name, f"{name}:1: {n_lines} lines, at most {FILE_LIMIT}"))
        elif n_lines > FILE_REMARK:
            remarks.append(f"{name}:1: remark: {n_lines} lines, {FILE_REMARK} are the habit")
        for line, length, head in functions(text):
            if length > FUNCTION_LIMIT:
                found.append(("function-length", name,
                              f"{name}:{line}: function of {length} lines, at most {FUNCTION_LIMIT}: {head[:80]}"))
    return found


def read_exceptions(root: Path) -> tuple[set[tuple[str, str]], list[str]]:
    file, allowed, problems = root / EXCEPTIONS, set(), []
    lines = file.read_text(encoding="utf-8").splitlines() if file.exists() else []
    for number, line in enumerate(lines, 1):
        words = line.split(maxsplit=2)
        if not words or words[0].startswith("#"):
            continue
        if len(words) < 3 or words[0] not in RULES:
            problems.append(f"{EXCEPTIONS}:{number}: wanted: one of {', '.join(sorted(RULES))}, a path, a reason")
        else:
            allowed.add((words[0], words[1]))
    return allowed, problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent)
    root = parser.parse_args().root.resolve()
    allowed, messages = read_exceptions(root)
    needed, remarks, files = set(), [], project_files(root)
    for file in files:
        for rule, name, message in check_file(file.relative_to(root).as_posix(), file, remarks):
            if (rule, name) in allowed:
                needed.add((rule, name))
            else:
                messages.append(message)
    messages += [f"{EXCEPTIONS}:1: nothing needs '{rule} {name}' any more" for rule, name in sorted(allowed - needed)]
    print("\n".join(remarks + messages + [f"check_size: {len(files)} files, {len(messages)} violations"]))
    return 1 if messages else 0


if __name__ == "__main__":
    sys.exit(main())
