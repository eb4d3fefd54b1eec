"""The documents as pages: all links lead somewhere, nothing comes from elsewhere, no markup is left over.

usage: site_test.py SOURCE_FOLDER MKDOCS [unittest's own arguments]
"""

import html.parser
import os
import re
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

SOURCE, MKDOCS = sys.argv[1:3]

PAGES = ["index", "first_picture", "trust_a_plan", "guard_a_library", "make_a_figure", "python", "hands",
         "formats", "interchange", "method", "force_closure", "planner_general", "planner_contour",
         "planner_polygon", "planner_polyhedron", "planner_roadmap", "hand_model", "validation", "failure_reasons",
         "limitations", "reference"]


# A heading may begin with a number, for example "1. Plan".
NO_PROSE = ("pre", "code", "script", "style", "h2", "h3")


class Page(html.parser.HTMLParser):
    """Links, anchors, loaded files, and the text that is neither code nor a heading."""

    def __init__(self, text):
        super().__init__()
        self.links, self.anchors, self.loaded, self.prose = [], set(), [], ""
        self._code = 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if "id" in attributes:
            self.anchors.add(attributes["id"])
        if tag == "a" and "href" in attributes:
            self.links.append(attributes["href"])
        for name in ("src", "href"):
            if tag in ("script", "img", "link") and name in attributes:
                self.loaded.append(attributes[name])
        self._code += tag in NO_PROSE

    def handle_endtag(self, tag):
        self._code -= tag in NO_PROSE

    def handle_data(self, data):
        if not self._code:
            self.prose += data


def faults(folder):
    """What is wrong with the pages of a folder, a line each; and how many links were followed."""
    pages = {}
    for root, _, names in os.walk(folder):
        for name in names:
            if name.endswith(".html") and name != "404.html":
                path = os.path.join(root, name)
                with open(path, encoding="utf-8") as file:
                    pages[path] = Page(file.read())
    found, followed = [], 0
    for path, page in pages.items():
        name = os.path.relpath(path, folder)
        for link in page.links + page.loaded:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme in ("http", "https") or link.startswith("//"):
                if link in page.loaded:
                    found.append(f"{name}: loads {link}")
                continue
            target = os.path.normpath(os.path.join(os.path.dirname(path), urllib.parse.unquote(
                parts.path))) if parts.path else path
            followed += 1
            if not os.path.exists(target):
                found.append(f"{name}: no file {link}")
            elif parts.fragment and target in pages:
                if urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                    found.append(f"{name}: no place {link}")
        for left in re.findall(r"^(?:[-*] |\d+\. |\|.*\||#+ |```).*$", page.prose, re.M):
            found.append(f"{name}: markup is left over: {left}")
    return found, followed


# Pages above the limit of size; the page is generated.
LONG = {"failure_reasons.md", "python_api.md"}
MOST_BYTES = 12000


def long_pages(folder):
    """Return the names of the pages in a folder that are larger than MOST_BYTES, sorted."""
    return sorted(name for name in os.listdir(folder) if name.endswith(".md")
                  and os.path.getsize(os.path.join(folder, name)) > MOST_BYTES)


def names_of(kind, text):
    """Return the names that a C++ function gives to the values of an enumeration, in order."""
    return re.findall(rf'case {kind}::k\w+:\s+return "([^"]+)";', text)


class SiteTest(unittest.TestCase):

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        subprocess.run([MKDOCS, "build", "--quiet", "--strict", "--config-file",
                        os.path.join(SOURCE, "mkdocs.yml"), "--site-dir", cls.folder.name], check=True)

    def test_there_is_a_page_for_each_subject_and_all_lead_to_it(self):
        with open(os.path.join(self.folder.name, "glossary.html"), encoding="utf-8") as file:
            links = Page(file.read()).links
        for name in PAGES:
            self.assertIn(f"{name}.html", links)

    def test_links_lead_somewhere_and_nothing_comes_from_elsewhere(self):
        found, followed = faults(self.folder.name)
        self.assertEqual(found, [])
        self.assertGreater(followed, 300)

    def test_every_failure_reason_and_cause_has_an_anchor(self):
        for kind, path, page in (("Reason", "planner/plan/reason.cc", "failure_reasons"),
                                 ("Cause", "sim/replay/disagreement.cc", "likely_causes")):
            with open(os.path.join(SOURCE, path), encoding="utf-8") as file:
                names = names_of(kind, file.read())
            self.assertGreater(len(names), 10, path)
            with open(os.path.join(self.folder.name, page + ".html"), encoding="utf-8") as file:
                anchors = Page(file.read()).anchors
            self.assertEqual([name for name in names if name not in anchors], [])

    def test_names_of_an_enumeration_are_found(self):
        text = 'case Reason::kNone:\n  return "";\ncase Reason::kOffPoint:\n  return "off-point";\n'
        self.assertEqual(names_of("Reason", text), ["off-point"])
        self.assertEqual(names_of("Cause", text), [])

    def test_pages_are_short(self):
        self.assertEqual(set(long_pages(os.path.join(SOURCE, "docs"))) - LONG, set())

    def test_a_long_page_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, size in (("a.md", MOST_BYTES), ("b.md", MOST_BYTES + 1), ("c.json", 2 * MOST_BYTES)):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write("x" * size)
            self.assertEqual(long_pages(folder), ["b.md"])

    def test_what_is_wrong_is_found(self):
        with tempfile.TemporaryDirectory() as folder:
            with open(os.path.join(folder, "a.html"), "w", encoding="utf-8") as file:
                file.write('<h1 id="top">A</h1><a href="#top">1</a><a href="b.html">2</a>'
                           '<a href="a.html#gone">3</a><script src="https://x.org/a.js"></script>'
                           "<p>so:\n- one\n- two</p>\n<pre>- code</pre><a href='https://x.org'>4</a>")
            self.assertEqual(faults(folder)[0], [
                "a.html: no file b.html", "a.html: no place a.html#gone",
                "a.html: loads https://x.org/a.js", "a.html: markup is left over: - one",
                "a.html: markup is left over: - two"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
