# SPDX-License-Identifier: BSD-3-Clause
"""Places that a page names with `<a id="..."></a>`, as code hosts understand it, become targets of Sphinx, and so do links to them."""
import re

ANCHOR = re.compile(r'^<a id="([\w-]+)"></a>$', re.MULTILINE)


def translate(_app, _name, source):
    names = set(ANCHOR.findall(source[0]))
    source[0] = ANCHOR.sub(r"(\1)=", source[0])
    source[0] = re.sub(r"\]\(#([\w-]+)\)", lambda link: f"]({link[1]})" if link[1] in names else link[0], source[0])


def setup(app):
    app.connect("source-read", translate)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
