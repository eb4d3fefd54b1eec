"""The interactive 3-D replay that validate writes into its report, in headless Chromium."""

import base64
import hashlib
import json
import os
import re
import shutil
import xml.etree.ElementTree as ElementTree

import long_plan
import program_case
from browser import Browser, NO_WEBGL
from picture_pixels import count, is_red, png_pixels, png_rows, png_size
from program_case import ProgramCase

XHTML = "{http://www.w3.org/1999/xhtml}"

# Largest size of a report with the replay and four frames, bytes.
LARGEST_PAGE = 1_500_000

STATE = "document.getElementById('viewer').dataset"
RUNNING = "document.getElementById('viewer').classList.contains('running')"

# Poses of the object, at present and at the start.
POSE = "document.getElementById('viewer').viewer.scene.object.quaternion.clone()"
START = "document.getElementById('viewer').viewer.scene.ghost.quaternion.clone().inverse()"

# Hides what covers the scene and changes with time, so that a screenshot shows only the scene.
SCENE_ONLY = ("document.querySelectorAll('.status, .overlay, .banner')"
              ".forEach(element => element.style.visibility = 'hidden')")


# A function of an image of the page: the number of dark pixels in its top or bottom left corner.
DARK_IN_CORNER = """((image, isTop) => {
  const canvas = document.createElement('canvas');
  const width = Math.floor(image.naturalWidth / 2), height = Math.floor(image.naturalHeight / 10);
  canvas.width = width;
  canvas.height = height;
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, isTop ? 0 : height - image.naturalHeight);
  const bytes = context.getImageData(0, 0, width, height).data;
  return bytes.filter((value, i) => i % 4 === 1 && value < 128).length;
})"""


def is_dark(pixel):
    return pixel[1] < 128


def different_pixels(one, other):
    """Return the number of pixels that differ between two PNGs of one size."""
    assert png_size(one) == png_size(other)
    if one == other:
        return 0
    return sum(a != b for row, also in zip(pixels(one), pixels(other)) for a, b in zip(row, also))


def pixels(data):
    if data[25] == 2:
        return png_pixels(data)
    raise AssertionError("expected a PNG without transparency")


class Viewer(ProgramCase):
    program = "validate"

    @classmethod
    def setUpClass(cls):
        cls.browser = Browser()
        cls.addClassCleanup(cls.browser.close)

    def setUp(self):
        super().setUp()
        self.browser.resize(600, 900)

    def validate_cube(self, *more, name="plan.json", code=0, size="320x240"):
        plan = self.plan_of_cube()
        self.write_json(name, plan)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", name, "--output", "result",
                                "--size", size, *more)
        self.assertEqual(done.returncode, code, done.stderr)
        return plan

    def page(self, name="result/report.html"):
        return self.read(name).decode()

    def open(self, link="", name="result/report.html", browser=None):
        browser = browser or self.browser
        browser.open("file://" + self.path(name) + link)
        return browser

    def scene(self):
        self.browser.value(SCENE_ONLY)
        return self.browser.screenshot("#viewer .stage")

    def visible(self, selector):
        """Return the number of visible elements."""
        return self.browser.value(f"[...document.querySelectorAll({json.dumps(selector)})]"
                                  ".filter(each => each.getClientRects().length > 0).length")

    def number(self, name):
        return float(self.browser.value(f"{STATE}.{name}"))

    def test_it_opens_without_errors_and_requests_at_the_initial_grasp(self):
        self.validate_cube()
        self.open()
        self.assertEqual(self.browser.console, [])
        self.assertTrue(self.browser.value(RUNNING))
        self.assertEqual(self.number("step"), 0)
        self.assertEqual([url for url in self.browser.requests if not url.startswith(("data:", "file:///"))], [])
        self.assertEqual(self.browser.value("document.querySelectorAll('.fingers tbody tr').length"), 5)
        shown = self.scene()
        colors = {pixel for row in pixels(shown) for pixel in row}
        self.assertGreater(len(colors), 100)
        # The image for pages without a viewer joins the other frames.
        frames = len(self.plan_of_cube()["steps"]) + 1
        self.assertEqual(self.visible(".still img"), 0)
        self.assertEqual(self.visible(".frames img"), frames)
        # In print it has its own place instead.
        self.browser.resize(1000, 1000, media="print")
        self.assertEqual(self.visible(".still img"), 1)
        self.assertEqual(self.visible(".frames img"), frames - 1)
        # The other frames follow, three in a row, before the table of steps.
        still, table, *tops = self.browser.value("[...document.querySelectorAll('.still, table.cards, .frames figure')]"
                                                 ".filter(e => e.getClientRects().length).map(e => Math.round(e.getBoundingClientRect().top))")
        self.assertLess(still, tops[0])
        self.assertEqual(tops[:3], [tops[0]] * min(3, frames - 1))
        self.assertGreater(table, tops[-1])
        # There the legend is only next to the first image.
        beside = ("(p => [...document.querySelectorAll('.still img, .still .legend')].map("
                  "e => e.getBoundingClientRect()).every((b, i, all) => b.top < all[0].bottom))()")
        self.assertTrue(self.browser.value(beside))
        legends = "[...document.querySelectorAll('p.note')].filter(p => p.textContent.includes('Dashed line')"
        legends += " && p.getClientRects().length).length"
        self.assertEqual(self.browser.value(legends), 1)
        self.browser.resize(1000, 1000)
        self.assertEqual(self.browser.value(legends), 1)
        self.assertEqual(self.visible(".still .legend"), 0)

    def test_captions_of_frames_are_text_on_the_page_and_pixels_only_in_files(self):
        self.validate_cube(size="640x480")
        self.open()
        names = sorted(name for name in os.listdir(self.path("result")) if name[:3].isdigit())
        self.assertEqual(self.browser.value("document.querySelectorAll('.frames img').length"), len(names))
        for index, name in enumerate(names):
            # A caption is the only dark text in the bottom left corner.
            rows = png_pixels(self.read("result/" + name))
            corner = [row[:len(row) // 2] for row in rows[9 * len(rows) // 10:]]
            self.assertGreater(count(corner, is_dark), 50, name)
            image = f"(document.querySelectorAll('.frames img')[{index}], false)"
            self.assertEqual(self.browser.value(DARK_IN_CORNER + image), 0, name)

    def test_links_keys_and_the_slider_move_the_replay(self):
        self.validate_cube()
        self.open("#step=1")
        self.assertEqual(self.number("step"), 1)
        first = self.scene()
        self.open("#step=1")
        self.assertEqual(different_pixels(first, self.scene()), 0)  # control
        self.open("#t=3.6")
        self.assertEqual(self.number("time"), 3.6)
        self.assertGreater(different_pixels(first, self.scene()), 200)
        self.browser.press("2")
        self.assertEqual(self.number("step"), 2)
        self.assertTrue(self.browser.value("location.hash").endswith("#step=2"))
        self.browser.press("ArrowLeft")
        self.assertEqual(self.number("step"), 1)
        self.browser.press("ArrowRight")
        self.assertEqual(self.number("step"), 2)
        self.browser.press("x")
        self.assertEqual(self.number("step"), 2)
        before = self.number("time")
        self.browser.press(" ")
        self.assertTrue(self.browser.value("document.getElementById('viewer').viewer.playing"))
        while self.number("time") == before:
            pass
        self.browser.press(" ")
        self.assertFalse(self.browser.value("document.getElementById('viewer').viewer.playing"))
        self.browser.value("(s => { s.value = 1; s.dispatchEvent(new Event('input')); })"
                           "(document.querySelector('#viewer input[type=range]'))")
        self.assertEqual(self.number("time"), 1)
        self.open("#step=99")
        self.assertEqual(self.number("step"), 0)
        self.assertEqual(self.browser.console, [])

    def test_switches_change_the_scene(self):
        self.validate_cube()
        self.open("#step=1")
        before = self.scene()
        boxes = self.browser.value("document.querySelectorAll('.switches input').length")
        self.assertEqual(boxes, 7)
        for box in range(boxes):
            name = self.browser.value(f"document.querySelectorAll('.switches label')[{box}].textContent")
            self.browser.value(f"document.querySelectorAll('.switches input')[{box}].click()")
            if name not in ("Names", "Start pose", "Path"):  # names are hidden, the cube does not move
                self.assertGreater(different_pixels(before, self.scene()), 50, name)
            self.browser.value(f"document.querySelectorAll('.switches input')[{box}].click()")
        self.assertEqual(different_pixels(before, self.scene()), 0)

    def test_a_failed_plan_opens_at_the_failing_instant_with_the_reason(self):
        self.validate_cube("--friction-angle", "6", code=1, size="640x480")
        self.open()
        self.assertEqual(self.browser.console, [])
        end = self.browser.value("document.getElementById('viewer').viewer.end")
        self.assertAlmostEqual(self.number("time"), end, 2)
        banner = "getComputedStyle(document.querySelector('.banner')).display"
        self.assertEqual(self.browser.value(banner), "block")
        detail = next(step["detail"] for step in self.report()["steps"] if step["verdict"] == "fail")
        self.assertEqual(self.browser.value("document.querySelector('.banner').textContent"), detail)
        self.assert_no_labels_overlap()
        # The page has the reason as text only, the file in its image.
        self.assertGreater(count(png_pixels(self.read("result/000_hold.png"))[:48], is_red), 50)
        self.assertEqual(self.browser.value(DARK_IN_CORNER + "(document.querySelector('.failure img'), true)"), 0)
        self.browser.press("ArrowLeft")
        self.assertEqual(self.browser.value(banner), "none")

    def assert_no_labels_overlap(self):
        boxes = json.loads(self.browser.value(
            "JSON.stringify([...document.querySelectorAll('.tag')].filter(tag => tag.getClientRects().length)"
            ".map(tag => tag.getBoundingClientRect()).map(b => [b.left, b.right, b.top, b.bottom]))"))
        self.assertGreater(len(boxes), 4)
        for i, one in enumerate(boxes):
            for other in boxes[:i]:
                apart = (one[0] >= other[1] - 1 or other[0] >= one[1] - 1 or
                         one[2] >= other[3] - 1 or other[2] >= one[3] - 1)
                self.assertTrue(apart, (one, other))

    def test_a_hand_turns_the_object(self):
        self.assert_done("--object", self.model("cube.obj"), "--hand", self.model("hands/ring5.json"), "--scale",
                         "0.8", "--mu", "0.8", "--turn", "z 30", "--output", "turn.json", program="plan")
        self.run_program("--object", self.model("cube.obj"), "--hand", self.model("hands/ring5.json"),
                         "--plan", "turn.json", "--output", "result", "--frames", "none,viewer=all")
        self.open("#t=0.5")
        self.assertEqual(self.browser.console, [])
        first = self.scene()
        line = "document.querySelector('.status span').textContent"
        self.assertRegex(self.browser.value(line), r"rotated −?[0-9.]+° of 30\.0°")
        self.browser.value("document.getElementById('viewer').viewer.setTime(1e9)")
        turned = float(re.search(r"rotated ([0-9.]+)°", self.browser.value(line))[1])
        self.assertAlmostEqual(turned, 30, delta=3)
        self.assertGreater(different_pixels(first, self.scene()), 2000)
        # The angle is that of the object in the data, not only a text.
        angle = ("(q => 2 * Math.acos(Math.min(1, Math.abs(q.w))) * 180 / Math.PI)"
                 "(document.getElementById('viewer').viewer.scene.object.quaternion.clone().multiply("
                 "document.getElementById('viewer').viewer.scene.ghost.quaternion.clone().inverse()))")
        self.assertAlmostEqual(self.browser.value(angle), turned, delta=1)

        self.check_detail()
        self.check_limits()
        # Without recorded states the hand follows the plan, and a failed check of the hand stops it.
        hand = ["--object", self.model("cube.obj"), "--hand", self.model("hands/ring5.json"), "--plan", "turn.json",
                "--output", "result", "--frames", "none,viewer=all"]
        for more, code in ((["--engine", "ode"], None), (["--clearance", "0.05"], 1)):
            done = self.run_program(*hand, *more)
            self.assertIn(done.returncode, [0, 1] if code is None else [code], done.stderr)
            self.open()
            self.assertEqual(self.browser.console, [])
            self.assertTrue(self.browser.value(RUNNING))
            self.assertIn("not the time of the simulation", self.browser.value(line))
        failure = "document.getElementById('viewer').viewer.data.failure"
        self.assertGreater(self.browser.value(failure + ".links.length"), 0)
        self.assertIn("apart", self.browser.value("document.querySelector('.tag.mark').textContent"))

    def check_limits(self):
        """The limits of the joints are folded, a card per joint on a phone, and complete in print."""
        table = "document.querySelector('table.pairs')"
        self.browser.resize(1000, 1000)
        self.assertFalse(self.browser.value(table + ".checkVisibility()"))
        self.browser.value(table + ".closest('details').open = true")
        self.assertTrue(self.browser.value(table + ".checkVisibility()"))
        name = f"getComputedStyle({table}.querySelector('td[data-name]'), '::before').content"
        self.assertEqual(self.browser.value(name), "none")
        self.browser.resize(390, 844)
        self.assertIn("Actuator", self.browser.value(name))
        wider = f"(e => e.scrollWidth - e.clientWidth)({table}.parentElement)"
        self.assertEqual(self.browser.value(wider), 0)
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 390)
        self.browser.value(table + ".closest('details').open = false")
        self.browser.resize(1000, 1000, media="print")
        self.assertGreater(self.browser.value(table + ".getBoundingClientRect().height"), 200)
        self.browser.resize(600, 900)

    def check_detail(self):
        """Successive slow frames reduce the detail until the replay pauses."""
        viewer = "document.getElementById('viewer').viewer"

        def triangles():
            return self.browser.value(viewer + ".renderer.info.render.triangles")

        def adapt(*intervals_ms):
            self.browser.value(f"{list(intervals_ms)}.forEach(interval => {viewer}.adapt(interval))")

        full, before = self.scene(), triangles()
        adapt(60, 60, 30, 60, 60)
        self.assertEqual(triangles(), before)
        adapt(60)
        self.assertLess(triangles(), 0.7 * before)
        width = self.browser.value(viewer + ".canvas.width")
        adapt(60, 60, 60, 60, 60, 60)
        self.assertLess(self.browser.value(viewer + ".canvas.width"), 0.6 * width)
        self.browser.value(viewer + ".pause()")
        self.assertEqual(triangles(), before)
        self.assertEqual(different_pixels(full, self.scene()), 0)

    def test_a_page_with_200_steps_opens_and_its_slider_moves_the_object(self):
        hand = ["--object", self.model("cube.obj"), "--hand", self.model("hands/ring5.json")]
        self.assert_done(*hand, "--scale", "0.8", "--mu", "0.8", "--turn", "z 5", "--output", "turn.json", program="plan")
        plan = json.loads(self.read("turn.json"))
        long_plan.repeat_motion(plan, 200)
        self.write_json("many.json", plan)
        # In a replay by point fingers, hand and object follow the planned path.
        self.assert_done(*hand, "--plan", "many.json", "--output", "result", "--frames", "none,viewer=all", "--replay", "points")
        self.open("#step=199")
        self.assertEqual(self.browser.console, [])
        self.assertEqual(self.number("step"), 199)
        self.assertEqual(self.browser.value("document.querySelectorAll('#viewer .ticks i').length"), 201)
        turn = "(q => 2 * Math.acos(Math.min(1, Math.abs(q.w))) * 180 / Math.PI)(" + POSE + ".multiply(" + START + "))"
        angles = []
        for step in (100, 101, 200):  # even steps end at the start, odd steps are 5 degrees away
            end = self.browser.value(f"document.getElementById('viewer').viewer.steps[{step}].end - 0.01")
            self.browser.value(f"(s => {{ s.value = {end}; s.dispatchEvent(new Event('input')); }})"
                               "(document.querySelector('#viewer input[type=range]'))")
            self.assertEqual(self.number("step"), step)
            angles.append(self.browser.value(turn))
            if step == 100:
                before = self.scene()
            elif step == 101:
                self.assertGreater(different_pixels(before, self.scene()), 200)
        for angle, expected in zip(angles, (0, 5, 0)):
            self.assertAlmostEqual(angle, expected, delta=0.2)

    def test_it_fits_a_phone(self):
        self.validate_cube()
        self.browser.resize(390, 844)
        self.open()
        self.assertTrue(self.browser.value(RUNNING))
        self.assertLessEqual(self.browser.value("document.documentElement.scrollWidth"), 390)
        sides = "(b => [b.left, b.right])(document.querySelector('#viewer .bar').getBoundingClientRect())"
        left, right = self.browser.value(sides)
        self.assertGreaterEqual(left, 0)
        self.assertLessEqual(right, 390)
        # The table of steps has a card per row, so that it does not scroll sideways.
        wider = "(e => e.scrollWidth - e.clientWidth)(document.querySelector('table.cards').parentElement)"
        self.assertEqual(self.browser.value(wider), 0)
        name = "getComputedStyle(document.querySelector('.cards td[data-name]'), '::before').content"
        self.assertIn("Required friction", self.browser.value(name))
        self.browser.resize(1000, 844)
        self.assertEqual(self.browser.value(name), "none")

    def test_it_has_a_dark_scheme_and_is_not_printed(self):
        self.validate_cube()
        ground = "getComputedStyle(document.documentElement).backgroundColor"
        self.open()
        self.assertEqual(self.browser.value(ground), "rgb(255, 255, 255)")
        self.browser.resize(1000, 1000, dark=True)
        self.open()
        self.assertEqual(self.browser.value(ground), "rgb(20, 24, 31)")
        self.browser.resize(1000, 1000, dark=True, media="print")
        self.assertEqual(self.browser.value(ground), "rgb(255, 255, 255)")
        self.assertEqual(self.browser.value("getComputedStyle(document.getElementById('viewer')).display"), "none")

    def test_pictures_and_animations_are_dimmed_in_the_dark_scheme_only(self):
        self.validate_cube("--video", "film.mp4")
        for selector in (".frames img", ".replay video"):
            dimming = f"getComputedStyle(document.querySelector('{selector}')).filter"
            self.browser.resize(1000, 1000)
            self.open()
            self.assertEqual(self.browser.value(dimming), "none", selector)
            self.browser.resize(1000, 1000, dark=True)
            self.open()
            self.assertIn("brightness", self.browser.value(dimming), selector)

    def assert_shows_a_picture_instead(self, browser):
        self.assertFalse(browser.value(RUNNING))
        self.assertEqual(browser.value("getComputedStyle(document.getElementById('viewer')).display"), "none")
        self.assertEqual(browser.value("document.querySelectorAll('.still img').length"), 1)
        self.assertNotEqual(browser.value("getComputedStyle(document.querySelector('.no-viewer')).display"), "none")

    def test_a_picture_replaces_it_without_webgl_without_scripts_and_with_a_wrong_hash(self):
        self.validate_cube()
        without = Browser(NO_WEBGL)
        self.addCleanup(without.close)
        self.open(browser=without)
        self.assert_shows_a_picture_instead(without)
        page = self.page()
        self.write("none.html", re.sub(r"(?s)<script>.*?</script>", "", page))
        self.assert_shows_a_picture_instead(self.open(name="none.html"))
        hashes = re.findall(r"sha256-[^&]+", page)
        self.assertEqual(len(hashes), 4)
        self.write("wrong.html", page.replace(hashes[3], "sha256-" + "A" * 43 + "="))
        self.assert_shows_a_picture_instead(self.open(name="wrong.html"))
        self.assertIn("Content Security Policy", " ".join(self.browser.console))
        self.write("more.html", page.replace("</main>", "</main><script>document.title = 'evil'</script>"))
        self.assertNotEqual(self.open(name="more.html").value("document.title"), "evil")
        self.assertTrue(self.browser.value(RUNNING))  # control: the viewer itself runs

    def test_the_policy_permits_exactly_the_scripts_of_the_page(self):
        self.validate_cube()
        page = self.page()
        tree = ElementTree.fromstring(page.replace("<!DOCTYPE html>", "", 1))
        policy = next(meta.get("content") for meta in tree.iter(XHTML + "meta")
                      if meta.get("http-equiv") == "Content-Security-Policy")
        self.assertTrue(policy.startswith("default-src 'none'; "))
        self.assertNotIn("unsafe-eval", policy)
        self.assertNotRegex(policy, "script-src[^;]*unsafe")
        scripts = re.findall(r"(?s)<script>(.*?)</script>", page)
        expected = ["'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"
                    for text in scripts]
        self.assertEqual(policy.split("script-src ")[1].split(), expected)

    def test_names_are_text(self):
        name = "<img src=x onerror=document.title='evil'>\"'&.obj"
        shutil.copy(self.model("cube.obj"), self.path(name))
        plan = self.plan_of_cube()
        plan["object"]["file"] = name
        self.write_json("</i><b>'\".json".replace("/", ""), plan)
        self.assert_done("--object", name, "--plan", "<i><b>'\".json", "--output", "result", "--size", "320x240")
        ElementTree.fromstring(self.page().replace("<!DOCTYPE html>", "", 1))
        self.open()
        self.assertEqual(self.browser.console, [])
        self.assertTrue(self.browser.value(RUNNING))
        self.assertEqual(self.browser.value("document.querySelectorAll('img[src=x]').length"), 0)

    def plan_page(self, *more, name="plan.html"):
        self.assert_done("--object", self.model("cube.obj"), "--output", name, *more, program="plan")
        self.open(name=name)
        self.assertEqual(self.browser.console, [])
        self.assertTrue(self.browser.value(RUNNING))
        ElementTree.fromstring(self.page(name).replace("<!DOCTYPE html>", "", 1))

    def test_plan_writes_a_page_of_a_plan_without_a_hand(self):
        ends = ["--start", self.model("cube.start.json"), "--goal", self.model("cube.goal.json"), "--mu", "0.4"]
        name = "<i>\"'&ß.HTML"
        self.plan_page(*ends, name=name)
        self.assertEqual(self.browser.value("document.querySelector('h1').textContent"), name)
        first = self.scene()
        self.browser.press("2")
        self.assertEqual(self.number("step"), 2)
        self.assertGreater(different_pixels(first, self.scene()), 200)
        self.assertIn("not simulated", self.browser.value("document.querySelector('.note').textContent"))
        self.assertEqual(self.browser.value("document.querySelectorAll('.verdict').length"), 0)
        self.assertIn("not replayed", self.browser.value("document.querySelector('.fingers tbody').textContent"))
        # The plan file is that of a run without a page, and the page has the same bytes in each run.
        page = self.page(name)
        both = [*ends, "--object", self.model("cube.obj"), "--output", "plan.json"]
        self.assert_done(*both, program="plan")
        plan = self.read("plan.json")
        self.assert_done(*both, "--output", "other.html", program="plan")
        self.assertEqual(self.read("plan.json"), plan)
        self.assertIn("<h1>plan.json</h1>", self.page("other.html"))
        self.plan_page(*ends, name=name)
        self.assertEqual(self.page(name), page)
        for words, *outputs in (("expected one HTML file", "a.html", "b.htm"), ("expected one plan file", "a.json", "b.json"),
                                ("--output", "a.html", "a.html")):
            self.assert_refused(2, words, *ends, "--object", self.model("cube.obj"),
                                *[word for output in outputs for word in ("-o", output)], program="plan")
        self.write("queries.jsonl", "{}")
        self.assert_refused(2, "expected a JSON Lines file", "--object", self.model("cube.obj"), "--mu", "0.4", "--batch",
                            "queries.jsonl", "-o", "a.html", program="plan")

    def test_plan_writes_a_page_of_a_plan_for_a_hand(self):
        self.plan_page("--hand", self.model("hands/ring5.json"), "--scale", "0.8", "--mu", "0.8", "--turn", "z 30")
        first = self.scene()
        self.browser.value("document.getElementById('viewer').viewer.setTime(1e9)")
        line = self.browser.value("document.querySelector('.status span').textContent")
        self.assertIn("rotated 30.0° of 30.0°", line)
        self.assertIn("not the time of the simulation", line)
        self.assertGreater(different_pixels(first, self.scene()), 2000)

    def test_no_plan_writes_no_page(self):
        done = self.run_program("--object", self.model("cube.obj"), "--mu", "0.05", "--start", self.model("cube.start.json"),
                                "--goal", self.model("cube.goal.json"), "-o", "a.html", "-o", "a.json", program="plan")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(os.listdir(self.folder), [])

    def test_options_decide_which_pages_have_it(self):
        self.validate_cube()
        page = self.page()
        self.assertLess(len(page.encode()), LARGEST_PAGE)
        self.assertEqual(page.count("<script>"), 4)
        self.validate_cube()
        self.assertEqual(self.page(), page)  # the same bytes
        for frames, scripts in (("none", 0), ("all,viewer=none", 0), ("none,viewer=all", 4), ("failed", 0),
                                ("viewer=frames", 4)):
            self.validate_cube("--frames", frames)
            self.assertEqual(self.page().count("<script>"), scripts, frames)
        self.validate_cube("--frames", "none", "--video", "replay.html")
        self.assertEqual(self.page().count("<script>"), 0)
        self.open(name="replay.html")
        self.assertTrue(self.browser.value(RUNNING))
        # In the frame of a notebook the controls are visible without scrolling.
        self.browser.resize(800, 830)
        bottom = "document.querySelector('.viewer .switches').getBoundingClientRect().bottom"
        self.assertLessEqual(self.browser.value(bottom), 830)
        self.assertGreater(self.browser.value("document.querySelector('.viewer .stage').offsetHeight"), 280)
        self.assertEqual(self.browser.console, [])
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--frames", "viewer=some")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--frames viewer", done.stderr)


if __name__ == "__main__":
    program_case.main()
