# SPDX-License-Identifier: BSD-3-Clause
"""Formulas as MathML, made when the site is built: browsers draw it themselves, with a font of the site, and no script is needed."""
import re
import shutil
from pathlib import Path

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.errors import SphinxError

# A font with the OpenType table for formulas, without which browsers stretch no bracket; of the package fonts-texgyre-math.
FONT = Path("/usr/share/texmf/fonts/opentype/public/tex-gyre-math/texgyretermes-math.otf")
# Between a function and its argument TeX leaves a thin space unless a bracket follows; browsers leave none.
FUNCTION = re.compile(r"<mo>&ApplyFunction;</mo>(?!\s*(?:<mrow>\s*)?<mo[^>]*>[(\[{])")


def convert(node, inline):
    try:
        text = tex2mathml(node.astext(), inline=inline)
    except SyntaxError as error:
        raise SphinxError(f"{node.source}: the formula {node.astext()!r} cannot be turned into MathML: {error}") from error
    return FUNCTION.sub('<mspace width="0.17em"></mspace>', text)


def visit_inline(self, node):
    self.body.append(convert(node, inline=True))
    raise nodes.SkipNode


def visit_display(self, node):
    self.body.append(f'<div class="math">{convert(node, inline=False)}</div>')
    raise nodes.SkipNode


def copy_font(app, error):
    if error is None:
        shutil.copyfile(FONT, Path(app.outdir) / "_static" / FONT.name)


def setup(app):
    if not FONT.is_file():
        raise SphinxError(f"{FONT} is missing; tools/install_dependencies.sh test installs it")
    app.add_html_math_renderer("mathml", (visit_inline, None), (visit_display, None))
    app.connect("build-finished", copy_font)
    return {"version": "2", "parallel_read_safe": True, "parallel_write_safe": True}
