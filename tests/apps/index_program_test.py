"""Index page of a batch in headless Chromium: images, sorting, filters, and links between its pages."""

import json
import os
import xml.etree.ElementTree as ElementTree

import program_case
from browser import Browser
from program_case import ProgramCase

# Names with markup, with characters that links escape, and a long one.
HOSTILE = ["<img src=x onerror=document.title='run'>", "a&b\"c'd%20#?", "größe Ω 掴む", "n" * 200]

COUNT = "document.getElementById('filter-count').textContent"


class Index(ProgramCase):
    program = "validate"

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.browser.resize(1280, 900)
        os.mkdir(self.path("plans"))
        self.plan = self.plan_of_cube()

    def add(self, name, friction_deg=20):
        self.plan["friction"]["half_angle_deg"] = friction_deg
        self.write_json(f"plans/{name}.json", self.plan)

    def validate(self, *more):
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plans", "--output", "result",
                                "--size", "160x120", *more)
        self.assertIn(done.returncode, (0, 1, 2), done.stderr)
        return done

    def open(self, page="index.html"):
        self.browser.open("file://" + self.path("result/" + page))
        self.assertEqual(self.browser.console, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(("file:", "data:"))], [])

    def names(self):
        return json.loads(self.browser.value(
            "JSON.stringify(Array.from(document.querySelectorAll('#plans tbody tr'), row => row.cells[1].textContent))"))

    def set(self, name, value, event="change"):
        self.browser.value(f"(field => {{field.value = {json.dumps(value)}; field.dispatchEvent(new Event('{event}'))}})"
                           f"(document.getElementById('{name}'))")

    def sort(self, head):
        self.browser.value("Array.from(document.querySelectorAll('#plans th button')).find("
                           f"button => button.textContent === {json.dumps(head)}).click()")

    def follow(self, text):
        """Click a link and wait for its page."""
        self.browser.loaded = False
        self.browser.value(f"Array.from(document.links).find(link => link.textContent === {json.dumps(text)}).click()")
        while not self.browser.loaded:
            self.browser.note(self.browser.receive())

    def title(self):
        return self.browser.value("document.querySelector('h1').textContent")

    def wait(self, script):
        """Wait until a JavaScript expression is true. Pages may load twice."""
        while True:
            try:
                if self.browser.value(script):
                    return
            except RuntimeError:
                pass  # the page is being replaced

    def test_failures_are_first_and_rows_are_sorted_and_filtered(self):
        for name in ("plan 10", "plan 9"):
            self.add(name)
        self.add("weak", 6)
        self.write("plans/broken.json", "{")
        self.validate()
        self.open()
        self.assertEqual(self.names(), ["broken", "weak", "plan 10", "plan 9"])
        self.assertEqual(self.browser.value(COUNT), " 4 of 4 plans")
        self.sort("Plan")
        self.assertEqual(self.names(), ["broken", "plan 9", "plan 10", "weak"])
        self.sort("Steps")
        self.assertEqual(self.names()[-1], "broken")  # without a value
        self.set("filter-verdict", "Pass")
        self.assertEqual(sorted(self.names()), ["plan 10", "plan 9"])
        self.set("filter-verdict", "")
        summary = json.loads(self.read("result/summary.json"))
        reason, = (plan["reason"] for plan in summary["plans"] if plan["name"] == "weak")
        self.set("filter-reason", reason)
        self.assertEqual(self.names(), ["weak"])
        self.set("filter-reason", "")
        self.set("filter-text", "CUBE weak", "input")
        self.assertEqual(self.names(), ["weak"])
        self.set("filter-text", "nothing", "input")
        self.assertEqual(self.names(), [])
        # A filter with one value is not shown.
        display = "getComputedStyle(document.getElementById('filter-{}').parentNode).display"
        self.assertEqual(self.browser.value(display.format("object")), "none")
        self.assertEqual(self.browser.value(display.format("verdict")), "flex")
        self.assertEqual(self.browser.value("getComputedStyle(document.getElementById('filter-all')).display"), "none")
        self.wait("Array.from(document.images).every(image => image.complete)")
        self.assertEqual(self.browser.value("Array.from(document.images).filter(image => !image.naturalWidth).length"), 0)

    def test_links_lead_back_and_forth_past_plans_without_a_page(self):
        for name in HOSTILE:
            self.add(name)
        self.add("weak", 6)
        self.write("plans/broken.json", "{")
        self.validate("--frames", "none,viewer=all")
        ElementTree.fromstring(self.read("result/index.html").decode().replace("<!DOCTYPE html>", "", 1))
        self.open()
        order = self.names()
        self.assertEqual(order[:2], ["broken", "weak"])
        self.assertEqual(sorted(order[2:]), sorted(HOSTILE))
        self.follow("weak")
        for name in order[2:]:
            self.follow("Next")
            self.wait("document.querySelector('nav.links') !== null")
            self.assertEqual(self.title(), name + ".json")
            # The replay runs in each page.
            self.assertTrue(self.browser.value("document.getElementById('viewer').classList.contains('running')"))
        self.follow("Previous")
        self.wait("document.querySelector('nav.links') !== null")
        self.assertEqual(self.title(), order[-2] + ".json")
        self.follow("All plans")
        self.assertEqual(self.browser.value("document.querySelector('tr.target').cells[1].textContent"), order[-2])
        # Before the first plan with a page there is none: the index shows the row.
        self.open("weak/report.html")
        self.follow("Previous")
        self.assertEqual(self.browser.value("document.querySelector('tr.target').cells[1].textContent"), "weak")
        self.assertNotEqual(self.browser.value("document.title"), "run")
        self.assertEqual(self.browser.value("document.querySelectorAll('img[src=x]').length"), 0)
        self.open("index.html#after=nothing")
        self.open("index.html#plan=%")
        self.assertEqual(self.names(), order)

    def test_viewers_follow_the_options_and_a_kept_page_keeps_its_bytes(self):
        self.add("one")
        self.add("two")
        for frames, scripts in (("all,viewer=none", 0), ("none", 0), ("none,viewer=all", 4)):
            self.validate("--frames", frames)
            self.assertEqual(self.read("result/one/report.html").count(b"<script>"), scripts, frames)
        pages = [self.read(f"result/{name}/report.html") for name in ("one", "two")]
        index = self.read("result/index.html")
        self.assertIn("2 kept", self.validate("--frames", "none,viewer=all").stdout)
        self.assertEqual([self.read(f"result/{name}/report.html") for name in ("one", "two")], pages)
        self.assertEqual(self.read("result/index.html"), index)
        # A further plan changes the index, and no page of another plan.
        self.add("three")
        self.assertIn("2 kept", self.validate("--frames", "none,viewer=all").stdout)
        self.assertEqual([self.read(f"result/{name}/report.html") for name in ("one", "two")], pages)
        # The page of a single validation has no links to an index.
        self.assert_done("--object", self.model("cube.obj"), "--plan", "plans/one.json", "--output", "single",
                         "--frames", "none")
        self.assertNotIn(b"<nav", self.read("single/report.html"))
        self.assertIn(b"<nav", pages[0])

    def test_it_fits_a_phone_and_works_without_scripts(self):
        self.add("n" * 100)
        self.add("weak", 6)
        self.validate()
        self.browser.resize(390, 844)
        self.open()
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 390)
        self.assertEqual(self.browser.value("document.querySelectorAll('.filter input').length"), 1)
        self.browser.command("Emulation.setScriptExecutionDisabled", value=True)
        self.addCleanup(self.browser.command, "Emulation.setScriptExecutionDisabled", value=False)
        self.open()
        self.assertEqual(self.names(), ["weak", "n" * 100])
        self.assertEqual(self.browser.value("document.querySelectorAll('input, select, button').length"), 0)


if __name__ == "__main__":
    program_case.main()
