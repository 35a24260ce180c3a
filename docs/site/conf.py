# SPDX-License-Identifier: BSD-3-Clause
"""Settings of the documentation site: Sphinx and MyST over the Markdown pages of docs/ (decisions/0029-documentation-site.md)."""
import re
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

project = "DEM4GRM"
copyright = "the authors of DEM4GRM, BSD-3-Clause"
version = release = re.search(r"project\(dem4grm VERSION ([\d.]+)", (HERE.parents[1] / "CMakeLists.txt").read_text(encoding="utf-8"))[1]

extensions = ["myst_parser", "table_of_contents", "mathml", "anchors", "theme_script"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
source_suffix = {".md": "markdown"}
exclude_patterns = ["site"]
highlight_language = "none"  # a block without a language is the output of a program
nitpicky = True

html_theme = "furo"
html_title = f"DEM4GRM {version}"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_use_index = False
html_show_sourcelink = False
html_show_sphinx = False
html_theme_options = {"top_of_page_button": None}
