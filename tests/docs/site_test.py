#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""Builds the documentation site and looks at its pages: no link inside is broken, nothing is fetched from elsewhere, formulas are drawn.

Not tested here: how the pages look, and links to other sites, which are for a reader to follow and are not asked for by a page.
"""
import re
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

ROOT = Path(__file__).resolve().parents[2]
# Attributes whose target a browser fetches by itself; of <link> only these relations.
FETCHED = {("script", "src"), ("img", "src"), ("iframe", "src"), ("source", "src"), ("audio", "src"), ("video", "src"), ("embed", "src"),
           ("object", "data"), ("link", "href"), ("use", "href"), ("image", "href"), ("form", "action")}
STYLE_URL = re.compile(r"url\(\s*['\"]?([^'\")]+)|@import\s+['\"]([^'\"]+)")


class Page(HTMLParser):
    """Names, links and what is fetched, of one HTML file."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.names, self.links, self.fetched, self.formulas, self.pictures = set(), [], [], 0, []
        self.code, self.text = 0, []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.names |= {values[key] for key in ("id", "name") if values.get(key)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        if tag == "math":
            self.formulas += 1
        if tag == "img":
            self.pictures.append((values.get("src"), values.get("alt") or ""))
        self.code += tag in ("pre", "code", "script", "style")
        self.fetched += [v for key, v in attributes if (tag, key) in FETCHED and v and values.get("rel") not in ("index", "search", "next", "prev")]
        self.fetched += [target for style in [values.get("style") or ""] for pair in STYLE_URL.findall(style) for target in pair if target]

    def handle_endtag(self, tag):
        self.code -= tag in ("pre", "code", "script", "style")

    def handle_data(self, data):
        if self.code == 0:
            self.text.append(data)


def is_elsewhere(target):
    parts = urlsplit(target)
    return parts.scheme not in ("", "data") or bool(parts.netloc)


def broken_link(page, target, pages, site):
    """Why a link of `page` leads nowhere; empty when it does not."""
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return ""
    place = (page.parent / unquote(parts.path)).resolve() if parts.path else page
    if not place.is_relative_to(site) or not place.is_file():
        return "no such file"
    if parts.fragment and place.suffix == ".html" and place in pages and unquote(parts.fragment) not in pages[place].names:
        return "no such place in the page"
    return ""


def complaints(site):
    """All that is wrong with the pages of a folder, as lines."""
    site = site.resolve()
    pages = {path: Page(path.read_text(encoding="utf-8")) for path in sorted(site.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        name = path.relative_to(site)
        for target in page.links:
            if reason := broken_link(path, target, pages, site):
                found.append(f"{name}: {target}: {reason}")
        for target in page.fetched:
            if is_elsewhere(target):
                found.append(f"{name}: fetches {target}")
            elif reason := broken_link(path, target, pages, site):
                found.append(f"{name}: fetches {target}: {reason}")
        if "$$" in "".join(page.text):
            found.append(f"{name}: a formula that is not drawn")
        found += [f"{name}: the picture {source} has no words for who cannot see it" for source, words in page.pictures if not words]
    for path in sorted(site.rglob("*.js")):
        if re.search(r"^(import|export)\b", path.read_text(encoding="utf-8", errors="replace"), re.MULTILINE):
            found.append(f"{path.relative_to(site)}: a module, which no browser reads from the disk")
    for path in sorted(site.rglob("*.css")):
        for pair in STYLE_URL.findall(path.read_text(encoding="utf-8", errors="replace")):
            if any(is_elsewhere(target) for target in pair):
                found.append(f"{path.relative_to(site)}: fetches {pair}")
    return found


class Planted(unittest.TestCase):
    """The checks find what is planted."""

    def complaints_of(self, body, style="", script=""):
        with tempfile.TemporaryDirectory() as folder:
            site = Path(folder)
            (site / "index.html").write_text(f"<html><body>{body}</body></html>", encoding="utf-8")
            (site / "other.html").write_text("<h1 id='here'>x</h1>", encoding="utf-8")
            (site / "a.css").write_text(style, encoding="utf-8")
            (site / "a.js").write_text(script, encoding="utf-8")
            return complaints(site)

    def test_what_is_wrong_is_found(self):
        for body in ("<a href='nowhere.html'>x</a>", "<a href='other.html#there'>x</a>", "<a href='#there'>x</a>",
                     "<script src='https://cdn.example/x.js'></script>", "<script src='//cdn.example/x.js'></script>",
                     "<link rel='stylesheet' href='https://fonts.example/x.css'>", "<img alt='x' src='nowhere.png'>",
                     "<p style='background: url(http://example/x.png)'>x</p>", "<p>$$a = b$$</p>", "<img src='other.html'>"):
            self.assertEqual(len(self.complaints_of(body)), 1, body)
        self.assertEqual(len(self.complaints_of("", "@import 'https://fonts.example/x.css';")), 1)
        self.assertEqual(len(self.complaints_of("", "p { background: url(//example/x.png) }")), 1)
        self.assertEqual(len(self.complaints_of("", script="'use strict';\nimport A from './a.js';")), 1)

    def test_what_is_right_is_let_through(self):
        body = ("<a href='other.html#here'>x</a><a href='https://example.org'>x</a><code>$$</code><a href='mailto:a@example.org'>x</a>"
                "<img alt='x' src='data:image/png;base64,AA'>")
        self.assertEqual(self.complaints_of(body, "p { background: url(data:image/svg+xml,x) }"), [])


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="dem4grm-site-")
        cls.addClassCleanup(folder.cleanup)
        cls.site = Path(folder.name) / "site"
        cls.built = subprocess.run([ROOT / "tools/build_docs.sh", cls.site], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def test_it_builds_without_a_warning(self):
        self.assertEqual(self.built.returncode, 0, self.built.stdout)
        self.assertNotIn("WARNING", self.built.stdout)

    def test_every_page_of_docs_is_in_it(self):
        wanted = {p.relative_to(ROOT / "docs").with_suffix(".html") for p in (ROOT / "docs").rglob("*.md") if "site" not in p.parts[-3:-1]}
        self.assertEqual({p for p in wanted if not (self.site / p).is_file()}, set())

    def test_links_lead_somewhere_and_nothing_is_fetched_from_elsewhere(self):
        self.assertEqual(complaints(self.site), [])

    def test_formulas_are_drawn_by_the_browser_itself(self):
        for name in ("verification/manual", "theory/contact", "theory/mohr-envelope"):
            self.assertGreater(Page((self.site / f"{name}.html").read_text(encoding="utf-8")).formulas, 2, name)


if __name__ == "__main__":
    unittest.main()
