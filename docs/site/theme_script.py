# SPDX-License-Identifier: BSD-3-Clause
"""Makes one plain script of the two of the theme, as its author's own build does.

Debian 12 ships them unjoined: furo.js imports the other one, which a browser refuses in a plain script, and refuses for modules that
are read from the disk. The button for light and dark, and the mark in the table of contents beside the page, need it.
"""
from pathlib import Path

IMPORT = 'import Gumshoe from "./gumshoe-patched.js";\n'


def join_scripts(app, error):
    if error is not None:
        return
    folder = Path(app.outdir) / "_static/scripts"
    script = folder / "furo.js"
    text = script.read_text(encoding="utf-8")
    if text.startswith(IMPORT):  # a later package may have it joined already
        script.write_text((folder / "gumshoe-patched.js").read_text(encoding="utf-8") + text.removeprefix(IMPORT), encoding="utf-8")


def setup(app):
    app.connect("build-finished", join_scripts)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
