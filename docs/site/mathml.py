# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as MathML, made when the site is built: browsers draw it themselves, so no script and no font is fetched."""
from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.errors import SphinxError


def convert(node, inline):
    try:
        return tex2mathml(node.astext(), inline=inline)
    except SyntaxError as error:
        raise SphinxError(f"{node.source}: the formula {node.astext()!r} cannot be turned into MathML: {error}") from error


def visit_inline(self, node):
    self.body.append(convert(node, inline=True))
    raise nodes.SkipNode


def visit_display(self, node):
    self.body.append(f'<div class="math">{convert(node, inline=False)}</div>')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_display, None))
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
