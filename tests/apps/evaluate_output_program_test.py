"""Outputs of evaluate other than JSON Lines: CSV, and a page that sorts and filters its rows."""

import csv
import io
import json
import math
import os
import re
import xml.etree.ElementTree as ElementTree

import hand_grasp_files
import program_case
from browser import Browser
from hand_grasp_files import grasp
from npz_file import read_npz
from picture_pixels import png_pixels, png_size
from program_case import ProgramCase

XHTML = "{http://www.w3.org/1999/xhtml}"

# Names that a spreadsheet or a browser would execute, and the text of their CSV cells.
HOSTILE = {'=HYPERLINK("x")': '\'=HYPERLINK("x")', "+1": "'+1", "-1,2": "'-1,2", "@SUM(A1)": "'@SUM(A1)",
           "<script>alert(1)</script>": "<script>alert(1)</script>", 'a"b': 'a"b', "line\nbreak": "line\nbreak",
           "\t=1": "'\t=1"}


class OutputCase(ProgramCase):
    program = "evaluate"

    def setUp(self):
        super().setUp()
        hand_grasp_files.write_hand(self.folder)

    def evaluated(self, grasps, *outputs, code=1, protocol="analytic", more=()):
        self.write("grasps.jsonl", grasps if isinstance(grasps, str) else hand_grasp_files.lines(grasps))
        arguments = [argument for output in outputs for argument in ("-o", output)]
        done = self.run_program("--grasps", "grasps.jsonl", "--hand", "gripper.json", "--object", "objects",
                                "--protocol", protocol, *arguments, *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def table(self, name="t.csv"):
        return list(csv.DictReader(io.StringIO(self.read(name).decode(), newline="")))

    def page(self, name="p.html"):
        """Return the page, which must be well-formed XML."""
        return ElementTree.fromstring(self.read(name).decode().removeprefix("<!DOCTYPE html>\n"))

    def rows(self, name="p.html"):
        table, = (table for table in self.page(name).iter(XHTML + "table") if table.get("id") == "grasps")
        heads = ["".join(head.itertext()) for head in table.iter(XHTML + "th")]
        return [dict(zip(heads, ("".join(cell.itertext()) for cell in row.iter(XHTML + "td"))))
                for row in table.find(XHTML + "tbody")]


class EvaluateOutput(OutputCase):
    def test_formats_follow_the_suffixes_and_agree(self):
        grasps = [grasp("hold", claimed=True, score=0.5, set="demo"), grasp("open", 0.0, claimed=True),
                  grasp("deep", 0.03, claimed=False)]
        self.evaluated(grasps, "r.jsonl", "t.CSV", "p.html", protocol="analytic,fall")
        reports = {report["id"]: report for report in map(json.loads, self.read("r.jsonl").splitlines()[1:])}
        table = {row["id"]: row for row in self.table("t.CSV")}
        page = {row["grasp"]: row for row in self.rows()}
        self.assertEqual(list(table), ["hold", "open", "deep"])
        self.assertEqual(list(page), ["open", "deep", "hold"], "grasps that fail must be first")
        for name, report in reports.items():
            for row in table[name], page[name]:
                self.assertEqual((row["verdict"], row["object"], row["hand"]), (report["verdict"], "box.obj", "gripper"))
            self.assertEqual(float(table[name]["distance_mm"]), report["distance_mm"])
            self.assertEqual(table[name]["reason"], report.get("reason", ""))
            self.assertEqual(page[name]["reason"], report.get("reason", "–"))
        self.assertEqual([table[name]["claimed"] for name in table], ["true", "true", "false"])
        self.assertEqual((table["hold"]["score"], table["hold"]["set"], table["hold"]["contacts"], table["hold"]["file"]),
                         ("0.5", "demo", "left 4, right 4", "grasps.jsonl"))
        self.assertEqual((table["hold"]["fall"], table["hold"]["held_s"], table["open"]["fall_reason"]),
                         ("pass", "3", "no-contact"))
        self.assertEqual(table["hold"]["disturbance"], "")
        self.assertAlmostEqual(float(page["deep"]["penetration, mm"]), 5, delta=0.06)
        self.assertEqual(page["hold"]["fall"], "pass: 3.00 s")
        self.assertNotIn("disturbance", page["hold"])

    def test_arrays_have_the_values_of_the_reports(self):
        grasps = [grasp("hold", claimed=True, score=0.5, set="demo"), grasp("open", 0.0, claimed=False),
                  grasp("deep", 0.03)]
        text = hand_grasp_files.lines(grasps) + "{}\n"
        self.evaluated(text, "r.jsonl", "a.npz", protocol="analytic,fall,disturbance", code=2)
        arrays = read_npz(self.path("a.npz"))
        reports = [json.loads(line) for line in self.read("r.jsonl").splitlines()[1:]]
        self.assertEqual(arrays["index"], [1, 2, 3, 4])
        self.assertEqual(arrays["id"], ["hold", "open", "deep", ""])
        self.assertEqual(arrays["set"], ["demo", "", "", ""])
        self.assertEqual(arrays["verdict"], ["pass", "fail", "fail", "bad-input"])
        self.assertEqual(arrays["passed"], [True, False, False, False])
        self.assertEqual(arrays["reason"][:3], ["", "no-contact", "penetrates"])
        self.assertIn("grasps.jsonl: line 4", arrays["reason"][3])
        self.assertEqual(arrays["claimed"][:2], [1, 0])
        self.assertTrue(all(math.isnan(value) for value in arrays["claimed"][2:] + arrays["score"][1:]))
        self.assertEqual(arrays["distance_mm"][:3], [report["distance_mm"] for report in reports[:3]])
        self.assertEqual(arrays["protocols"], ["analytic", "fall", "disturbance"])
        self.assertEqual(arrays["protocol_verdict"][0], ["pass"] * 3)
        self.assertEqual(arrays["protocol_verdict"][3], [""] * 3)
        self.assertEqual(arrays["links"], ["left", "right"])
        self.assertEqual(arrays["contacts"][:2], [[4, 4], [0, 0]])
        by_name = {result["protocol"]: result for result in reports[0]["protocols"]}
        self.assertEqual(arrays["held_s"][0], by_name["fall"]["seconds"])
        self.assertEqual(arrays["resisted_N"][0], by_name["disturbance"]["resisted_N"])
        self.assertEqual(arrays["quality"][0], by_name["analytic"]["quality"])
        self.assertTrue(all(math.isnan(value) for value in arrays["held_s"][3] + arrays["moved_mm"]))

    def test_arrays_have_the_same_bytes_in_every_run(self):
        self.evaluated([grasp("a"), grasp("b", 0.0)], "a.npz")
        self.evaluated([grasp("a"), grasp("b", 0.0)], "b.npz", more=["--jobs", "2"])
        self.assertEqual(self.read("a.npz"), self.read("b.npz"))
        self.evaluated([grasp("a"), grasp("c", 0.0)], "c.npz")
        self.assertNotEqual(self.read("a.npz"), self.read("c.npz"))

    def test_counts_of_claims_are_on_the_page_per_object_and_hand(self):
        self.evaluated([grasp("a", claimed=True), grasp("b", 0.0, claimed=True), grasp("c", 0.0, claimed=False)], "p.html")
        texts = {}
        for table in self.page().iter(XHTML + "table"):
            head, *rows = table.iter(XHTML + "tr")
            texts["".join(next(head.iter(XHTML + "th")).itertext())] = [
                ["".join(cell.itertext()) for cell in row.iter(XHTML + "td")] for row in rows]
        self.assertEqual(texts["object"], [["box.obj", "1", "1", "0", "1"]])
        self.assertEqual(texts["hand"], [["gripper", "1", "1", "0", "1"]])
        (reason, count, meaning, remedies), = texts["reason"]
        self.assertEqual((reason, count), ("no-contact", "2"))
        self.assertTrue(meaning.startswith("No link is within 1 mm of the surface (analytic)"), meaning)
        self.assertIn("Check the conventions if most grasps fail.", remedies)
        self.assertIn("Discard the grasps that fail (2), unless a remedy applies.", self.read("p.html").decode())
        # The most frequent reason is first. A page without failures has no section.
        self.evaluated([grasp("a", 0.0), grasp("b", 0.03), grasp("c", 0.03)], "q.html")
        rows = [["".join(cell.itertext()) for cell in row.iter(XHTML + "td")][:2]
                for table in self.page("q.html").iter(XHTML + "table") if table.get("class") == "counts reasons"
                for row in table.iter(XHTML + "tr")][1:]
        self.assertEqual(rows, [["penetrates", "2"], ["no-contact", "1"]])
        self.evaluated([grasp("a")], "r.html", code=0)
        self.assertNotIn("Reasons for failure", self.read("r.html").decode())

    def test_hostile_names_are_text(self):
        self.evaluated([grasp(name) for name in HOSTILE], "t.csv", "p.html", code=0)
        self.assertEqual([row["id"] for row in self.table()], list(HOSTILE.values()))
        text = self.read("p.html").decode()
        self.assertNotIn("alert(1)<", text.replace("alert(1)&lt;", ""))
        self.assertEqual(len(re.findall("<script", text)), 1)
        self.assertIn('=HYPERLINK("x")', {row["grasp"] for row in self.rows()})

    def test_lines_of_bad_input_have_rows(self):
        self.evaluated(json.dumps(grasp("x")).replace("0.025", "NaN") + "\n" + json.dumps(grasp("good")) + "\n",
                       "t.csv", "p.html", code=2)
        self.assertEqual([(row["index"], row["verdict"]) for row in self.table()], [("1", "bad-input"), ("2", "pass")])
        self.assertIn("grasps.jsonl: line 1", self.table()[0]["reason"])
        self.assertEqual([row["verdict"] for row in self.rows()], ["bad-input", "pass"])

    def test_without_json_lines_only_the_other_files_remain(self):
        self.evaluated([grasp("a")], "t.csv", code=0)
        left = [name for name in os.listdir(self.folder) if name.startswith("t.csv")]
        self.assertEqual(left, ["t.csv"])
        self.evaluated([grasp("a")], "r.jsonl", "t2.csv", code=0)
        self.assertIn("1 kept", self.evaluated([grasp("a")], "r.jsonl", "t2.csv", code=0).stderr)

    def test_each_grasp_has_an_image_that_the_page_links(self):
        text = hand_grasp_files.lines([grasp("hold"), grasp("open", 0.0)]) + "{}\n"
        self.evaluated(text, "p.html", code=2, more=["--images", "images"])
        self.assertEqual(sorted(os.listdir(self.path("images"))), ["000001.png", "000002.png"])
        links = [link.get("href") for link in self.page().iter(XHTML + "a")]
        self.assertEqual(links, ["images/000002.png", "images/000001.png"])
        pictures = [self.read(f"images/{name}") for name in ("000001.png", "000002.png")]
        colors = [{color for row in png_pixels(picture) for color in row} for picture in pictures]
        for picture, found in zip(pictures, colors):
            self.assertEqual(png_size(picture), (640, 640))
            # Object, hand and text on white.
            self.assertGreater(len(found), 50)
        # Only the first grasp has contacts, which are red.
        red = [any(r > 180 and g < 60 and b < 60 for r, g, b in found) for found in colors]
        self.assertEqual(red, [True, False])
        os.remove(self.path("images/000001.png"))
        self.evaluated(text, "p.html", code=2, more=["--images", "images"])
        self.assertEqual(self.read("images/000001.png"), pictures[0])

    def test_a_deleted_image_is_drawn_again_although_its_record_is_kept(self):
        grasps = [grasp("hold"), grasp("open", 0.0)]
        self.evaluated(grasps, "r.jsonl", more=["--images", "images"])
        pictures = {name: self.read(f"images/{name}") for name in sorted(os.listdir(self.path("images")))}
        os.remove(self.path("images/000002.png"))
        records = self.read("r.jsonl")
        self.assertIn("1 kept", self.evaluated(grasps, "r.jsonl", more=["--images", "images"]).stderr)
        self.assertEqual({name: self.read(f"images/{name}") for name in sorted(os.listdir(self.path("images")))}, pictures)
        self.assertEqual(self.read("r.jsonl"), records)

    def test_wrong_combinations_are_refused(self):
        self.write("grasps.jsonl", hand_grasp_files.lines([grasp("a")]))
        start = ["--grasps", "grasps.jsonl", "--hand", "gripper.json", "--object", "objects"]
        self.assert_refused(2, "--output: expected one CSV file, found a.csv and b.csv", *start, "-o", "a.csv", "-o", "b.csv")
        self.assert_refused(2, "--output: expected one JSON Lines file, found a and b", *start, "-o", "a", "-o", "b")
        self.assert_refused(2, "--shard requires an output in JSON Lines, found a.html", *start, "-o", "a.html", "--shard", "1/2")
        self.assert_refused(2, "--output", *start, "-o", "grasps.jsonl", "-o", "a.html")
        self.write("file", "")
        self.assert_refused(3, "file", *start, "-o", "a.html", "--images", "file")


class EvaluatePage(OutputCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def open(self, grasps):
        self.evaluated(grasps, "p.html")
        self.browser.open("file://" + self.path("p.html"))

    def shown(self, column=1):
        return json.loads(self.browser.value(
            "JSON.stringify(Array.from(document.querySelectorAll('#grasps tbody tr')).filter(row => !row.hidden)"
            f".map(row => row.cells[{column}].textContent))"))

    def set(self, name, value, event):
        self.browser.value(f"(field => {{field.value = {json.dumps(value)}; field.dispatchEvent(new Event('{event}'))}})"
                           f"(document.getElementById('{name}'))")

    def click(self, head):
        self.browser.value(f"Array.from(document.querySelectorAll('#grasps th button')).find("
                           f"button => button.textContent.startsWith({json.dumps(head)})).click()")

    def test_rows_are_filtered_and_sorted_without_requests(self):
        self.open([grasp("hold 1", claimed=True), grasp("open 10", 0.0, claimed=True), grasp("deep 2", 0.03, claimed=False),
                   grasp("deeper 3", 0.031)])
        self.assertEqual(self.browser.console, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith("file:")], [])
        self.assertEqual(self.shown(), ["open 10", "deep 2", "deeper 3", "hold 1"])
        self.click("penetration")
        self.assertEqual(self.shown(), ["open 10", "hold 1", "deep 2", "deeper 3"])
        self.click("penetration")
        self.assertEqual(self.shown(), ["deeper 3", "deep 2", "hold 1", "open 10"])
        self.click("no.")
        self.assertEqual(self.shown(), ["hold 1", "open 10", "deep 2", "deeper 3"])
        self.set("filter-text", "PENETRATES deep", "input")
        self.assertEqual(self.shown(), ["deep 2", "deeper 3"])
        self.set("filter-text", "", "input")
        self.set("filter-verdict", "pass", "change")
        self.assertEqual(self.shown(), ["hold 1"])
        self.set("filter-verdict", "claim differs", "change")
        self.assertEqual(self.shown(), ["open 10"])
        self.assertEqual(self.browser.value("document.getElementById('filter-count').textContent"), " 1 of 4 grasps")

    def displayed(self):
        return self.browser.value("Array.from(document.querySelectorAll('table.data tbody tr')).filter(row => "
                                  "getComputedStyle(row).display !== 'none').length")

    def test_large_tables_show_their_first_rows_until_asked_for_all(self):
        self.open([grasp(f"g{i}", 0.0) for i in range(520)] + [grasp("hold")])
        self.assertEqual(self.displayed(), 500)
        self.assertEqual(self.browser.value("document.getElementById('filter-count').textContent"),
                         " 521 of 521 grasps, first 500 shown")
        self.click("verdict")
        self.click("verdict")
        self.assertEqual(self.shown()[:2], ["hold", "g0"])
        self.set("filter-text", "hold", "input")
        self.assertEqual(self.displayed(), 1)
        self.set("filter-text", "", "input")
        self.browser.value("document.getElementById('filter-all').click()")
        self.assertEqual(self.displayed(), 521)
        self.disable_scripts()
        self.browser.open("file://" + self.path("p.html"))
        self.assertEqual(self.displayed(), 521)

    def test_reasons_are_readable_on_a_phone(self):
        self.browser.resize(390, 844)
        self.addCleanup(self.browser.resize, 1000, 844)
        self.open([grasp("open", 0.0)])
        # Each grasp is a card with the names of the columns. Nothing scrolls sideways.
        cell = "[...document.querySelectorAll('#grasps td')].find(cell => cell.textContent === 'no-contact')"
        self.assertGreaterEqual(self.browser.value(cell + ".offsetWidth"), 150)
        name = f"getComputedStyle({cell}, '::before').content"
        self.assertIn("reason", self.browser.value(name))
        wider = "[...document.querySelectorAll('.scroll')].map(e => e.scrollWidth - e.clientWidth)"
        self.assertEqual(set(self.browser.value(wider)), {0})
        self.browser.resize(1280, 844)
        self.assertEqual(self.browser.value(name), "none")
        # On a desktop, words of usual length are not broken.
        for text in ("box.obj", "gripper", "no-contact"):
            found = f"[...document.querySelectorAll('#grasps td')].find(cell => cell.textContent === '{text}')"
            lines = f"(cell => {{const range = document.createRange(); range.selectNodeContents(cell);" \
                    f" return range.getClientRects().length;}})({found})"
            self.assertEqual(self.browser.value(lines), 1, text)
        self.browser.resize(390, 844)
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 390)

    def disable_scripts(self):
        self.browser.command("Emulation.setScriptExecutionDisabled", value=True)
        self.addCleanup(self.browser.command, "Emulation.setScriptExecutionDisabled", value=False)

    def test_without_scripts_the_page_is_a_table(self):
        self.disable_scripts()
        self.open([grasp("hold"), grasp("open", 0.0)])
        self.assertEqual(self.shown(), ["open", "hold"])
        self.assertEqual(self.browser.value("document.querySelectorAll('input, select, button').length"), 0)

    def test_scripts_of_names_do_not_run(self):
        self.open([grasp(f"<img src=x onerror=document.title='run'>{i}", 0.0) for i in range(2)])
        self.assertNotEqual(self.browser.value("document.title"), "run")
        self.assertEqual(self.browser.value("document.images.length"), 0)


if __name__ == "__main__":
    program_case.main()
