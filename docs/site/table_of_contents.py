# SPDX-License-Identifier: BSD-3-Clause
"""Table of contents of the site, from the folders of docs/: a new page appears in it without being named anywhere.

The pages themselves stay plain Markdown, which a code host shows as they are, so the directives of Sphinx that make the table are added
to index.md and decisions.md while they are read.
"""
from pathlib import Path

# Caption; pages in the order in which they are read. A folder with a star stands for its pages that are not named before it.
SECTIONS = (
    ("Begin", ("tutorial", "glossary", "gallery")),
    ("How to", ("how-to/own-grading", "how-to/own-clump-shape", "how-to/stop-and-resume", "how-to/laboratory-data", "how-to/*")),
    ("Theory", ("theory/specimen", "theory/clumps", "theory/contact", "theory/parallel-bond", "theory/motion", "theory/direct-shear",
                "theory/micro-mechanics", "theory/mohr-envelope", "theory/*")),
    ("Reference", ("reference/command-line", "reference/case-file", "reference/study-file", "reference/output-folder", "reference/*")),
    ("Verification", ("verification/manual", "verification/*")),
    ("Results", ("results/demo", "results/full-size", "results/*")),
    ("What to rely on", ("limits", "determinism", "security", "performance", "*", "decisions")),
)


def expand(entries, docs, taken):
    pages = []
    for entry in entries:
        found = [entry]
        if entry.endswith("*"):
            found = sorted(p.relative_to(docs).with_suffix("").as_posix() for p in docs.glob(entry + ".md"))
        for page in found:
            if page not in taken:
                taken.add(page)
                pages.append(page)
    return pages


def directive(caption, pages):
    lines = ["```{toctree}", ":hidden:", f":caption: {caption}" if caption else "", "", *pages, "```"]
    return "\n".join(line for k, line in enumerate(lines) if line or k == 3)


def add_table(app, name, source):
    docs = Path(app.srcdir)
    named = {page for _, entries in SECTIONS for page in entries}
    if name == "index":
        taken = {"index"}
        tables = []
        for caption, entries in SECTIONS:
            # The star of the last section leaves out what other sections name.
            others = named - set(entries) if "*" in entries else set()
            tables.append(directive(caption, expand([e for e in entries if e not in others], docs, taken)))
        source[0] += "\n\n" + "\n\n".join(tables) + "\n"
    if name == "decisions":
        source[0] += "\n\n" + directive("", expand(["decisions/*"], docs, set())).replace(":hidden:\n", "") + "\n"


def setup(app):
    app.connect("source-read", add_table)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
