"""Animations of the replay: validate --frames animation and --video."""

import base64
import copy
import os
import re
import xml.etree.ElementTree

import program_case
from picture_pixels import webp_durations
from program_case import ProgramCase

XHTML = "{http://www.w3.org/1999/xhtml}"
SMALL = ["--size", "128x96,animation=64x48"]

# Duration of the last frame of a plan, ms.
PASSED_REST, FAILED_REST = 1500, 3000


def webp_size(data):
    assert data[12:16] == b"VP8X"
    return tuple(1 + int.from_bytes(data[at:at + 3], "little") for at in (24, 27))


def gif_size(data):
    return tuple(int.from_bytes(data[at:at + 2], "little") for at in (6, 8))


def gif_colours(data):
    assert data[:6] == b"GIF89a" and data[10] & 0x80, "a table of colours for all pictures"
    table = data[13:13 + 3 * 2 ** (1 + (data[10] & 7))]
    return {tuple(table[i:i + 3]) for i in range(0, len(table), 3)}


def is_red(colour):
    """Return True for the red of faults; no finger has this colour."""
    red, green, blue = colour
    return red > 180 and green < 0.22 * red and blue < 0.35 * red


class Animation(ProgramCase):
    program = "validate"

    def setUp(self):
        super().setUp()
        self.plan = self.plan_of_cube()

    def of_plan(self, *more):
        self.write_json("plan.json", self.plan)
        return ["--object", self.model("cube.obj"), "--plan", "plan.json", "--output", "result",
                *more]

    def of_grasp(self, *more):
        return ["--object", self.model("cube.obj"), "--grasp", self.model("cube.start.json"),
                "--friction-angle", "20", "--output", "result", *more]

    def replay(self):
        return self.read("result/replay.webp")

    def test_a_replay_is_animated_where_asked(self):
        self.plan["steps"] = self.plan["steps"][:1]
        self.plan["goal"] = {"contacts": [
            {key: contact[key] for key in ("point", "normal")} for contact in
            self.contacts_after_a_switch()]}
        self.assert_done(*self.of_plan("--frames", "animation", *SMALL))
        self.assertEqual(webp_size(self.replay()), (64, 48))
        durations = webp_durations(self.replay())
        self.assertGreater(len(durations), 16)
        # Equal frames before it are merged with it.
        self.assertGreaterEqual(durations[-1], PASSED_REST)
        self.assertLess(durations[-1], FAILED_REST)
        page = self.read("result/report.html").decode()
        self.assertEqual(page.count('<div class="replay">'), 1)
        self.assertEqual(page.count("<img "), 3)
        self.assert_done(*self.of_plan("--frames", "none"))
        self.assertFalse(os.path.exists(self.path("result/replay.webp")))
        self.assertNotIn('<div class="replay">', self.read("result/report.html").decode())

    def contacts_after_a_switch(self):
        step = self.plan["steps"][0]
        return [contact for contact in self.plan["initial"]["contacts"] + step["place"]
                if contact["finger"] not in step["release"]]

    def test_options_that_do_not_go_together_are_refused(self):
        self.assert_refused(2, "--size animation: requires --frames animation or --video",
                            *self.of_grasp("--size", "animation=96x64"))
        self.assert_refused(2, "--size animation: expected WxH",
                            *self.of_grasp("--frames", "animation", "--size", "animation=1x1"))
        for name in ("film.avi", "film", "-", "film.mp4.txt"):
            self.assert_refused(2, ["--video", f'"{name}"', ".mp4, .gif, .webp or .html"],
                                *self.of_grasp("--video", name))
        self.write_json("plan.json", self.plan)
        self.assert_refused(2, "--video: requires a single plan", "--object",
                            self.model("cube.obj"), "--plan", "plan.json", "plan.json", "--output",
                            "result", "--video", "film.mp4")
        self.write("plan.gif", self.read("plan.json"))
        self.assert_refused(2, ["plan.gif", "--plan", "--video"], "--object",
                            self.model("cube.obj"), "--plan", "plan.gif", "--output", "result",
                            "--video", "plan.gif")
        self.assert_refused(3, "nowhere", *self.of_grasp("--video", "nowhere/film.mp4"))

    def test_a_video_has_the_format_of_its_name_and_its_size(self):
        for name in ("film.gif", "film.mp4", "film.webp"):
            self.assert_done(*self.of_grasp("--frames", "none", "--size", "130x98,animation=65x49",
                                            "--video", name))
        self.assertEqual(gif_size(self.read("film.gif")), (65, 49))
        self.assertEqual(webp_size(self.read("film.webp")), (65, 49))
        film = self.read("film.mp4")
        self.assertEqual(film[4:8], b"ftyp")
        header = film.index(b"tkhd") - 4
        sides = film[header + int.from_bytes(film[header:header + 4], "big") - 8:][:8]
        self.assertEqual([int.from_bytes(sides[at:at + 2], "big") for at in (0, 4)], [66, 50])
        self.assertEqual(sorted(os.listdir(self.folder)),
                         ["film.gif", "film.mp4", "film.webp", "result"])
        self.assertFalse(os.path.exists(self.path("result/replay.webp")))

    def replay_on_page(self):
        """Return the element of the report page with the replay, and its embedded bytes."""
        page = xml.etree.ElementTree.fromstring(self.read("result/report.html"))
        replays = page.findall(f".//{XHTML}div[@class='replay']")
        if not replays:
            return None, b""
        self.assertEqual(len(replays), 1)
        shown = [element for element in replays[0].iter() if element.get("src")]
        self.assertEqual(len(shown), 1)
        head, body = shown[0].get("src").split(";base64,")
        return shown[0].tag.removeprefix(XHTML) + " " + head, base64.b64decode(body)

    def test_a_video_alone_is_on_the_page_too(self):
        for ending, element in (("gif", "img data:image/gif"), ("mp4", "video data:video/mp4"),
                                ("webp", "img data:image/webp")):
            name = "film." + ending
            self.assert_done(*self.of_grasp("--frames", "none", *SMALL, "--video", name))
            self.assertEqual(self.replay_on_page(), (element, self.read(name)))
            self.assertIn(b"media-src data:;", self.read("result/report.html"))
        self.assert_done(*self.of_grasp(*SMALL, "--frames", "animation", "--video", "film.mp4"))
        self.assertEqual(self.replay_on_page(), ("video data:video/mp4", self.read("film.mp4")))
        self.assert_done(*self.of_grasp("--frames", "none"))
        self.assertEqual(self.replay_on_page(), (None, b""))

    def test_the_same_plan_gives_the_same_bytes_on_one_core_as_on_all(self):
        formats = ("gif", "mp4", "webp")
        for ending in formats:
            self.assert_done(*self.of_grasp("--frames", "animation", *SMALL, "--video", "all." + ending))
        replay = self.replay()
        cores = os.sched_getaffinity(0)
        os.sched_setaffinity(0, {min(cores)})
        self.addCleanup(os.sched_setaffinity, 0, cores)
        for ending in formats:
            self.assert_done(*self.of_grasp("--frames", "animation", *SMALL, "--video", "one." + ending))
            self.assertEqual(self.read("one." + ending), self.read("all." + ending))
        self.assertEqual(self.replay(), replay)
        self.assertEqual(self.read("one.webp"), replay)

    def test_it_is_seen_as_the_frames_are(self):
        self.assert_done(*self.of_grasp("--frames", "animation", *SMALL))
        usual = self.replay()
        for option in (["--view", "200,50"], ["--view", "zoom=1.3"], ["--view", "orthographic"],
                       ["--edges", "none"], ["--finger-radius", "0.004"]):
            self.assert_done(*self.of_grasp("--frames", "animation", *SMALL, *option))
            self.assertNotEqual(self.replay(), usual, option)

    def test_the_last_rest_shows_what_failed(self):
        self.plan["steps"] = self.plan["steps"][:1]
        self.plan["goal"] = {"contacts": [
            {key: contact[key] for key in ("point", "normal")} for contact in
            self.contacts_after_a_switch()]}
        self.assert_done(*self.of_plan("--frames", "none", "--video", "good.gif"))
        self.assertFalse(any(map(is_red, gif_colours(self.read("good.gif")))))
        # Failures in the replay, in the check of a step, and in that of the initial grasp.
        bad = copy.deepcopy(self.plan)
        contact = bad["steps"][0]["place"][0]
        contact["point"] = [p - 0.004 * n for p, n in zip(contact["point"], contact["normal"])]
        hold = copy.deepcopy(self.plan)
        contact = hold["initial"]["contacts"][0]
        contact["point"] = [p - 0.004 * n for p, n in zip(contact["point"], contact["normal"])]
        for plan, more in ((self.plan, ["--disturbance", "0.5"]), (bad, []), (hold, [])):
            self.plan = plan
            done = self.run_program(*self.of_plan(*SMALL, "--frames", "animation", "--video", "bad.gif", *more))
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertTrue(any(map(is_red, gif_colours(self.read("bad.gif")))))
            if plan is hold:  # one frame is not an animation
                continue
            self.assertEqual(webp_durations(self.replay())[-1], FAILED_REST)

    def test_a_terminal_is_told_how_many_frames_are_drawn(self):
        done, shown = self.run_on_terminal(*self.of_grasp("--frames", "animation", *SMALL))
        self.assertEqual(done.returncode, 0, shown)
        count = int(re.findall(r"drawing the animation: frame 1 of (\d+)", shown)[0])
        self.assertGreater(count, 8)
        self.assert_stages(shown, "reading ", "drawing frames: frame 1 of 1",
                           "drawing the animation: frame 1 of",
                           f"drawing the animation: frame {count} of {count}")
        self.assertEqual(shown.count("drawing the animation: frame"), count)

    def test_the_trajectory_is_the_same_with_an_animation(self):
        self.assert_done(*self.of_grasp("--frames", "none", "--trajectory", "alone.csv"))
        self.assert_done(*self.of_grasp("--frames", "animation", *SMALL, "--trajectory", "beside.csv"))
        self.assertEqual(self.read("alone.csv"), self.read("beside.csv"))


if __name__ == "__main__":
    program_case.main()
