"""Frames of `validate`: their views, edges, and actual fingers."""

import os
import struct

import program_case
from program_case import ProgramCase


class Frames(ProgramCase):
    program = "validate"

    def setUp(self):
        super().setUp()
        self.assert_done("--object", self.model("cube.obj"), "--start",
                         self.model("cube.start.json"), "--goal", self.model("cube.goal.json"),
                         "--friction-angle", "20", "--output", "plan.json", program="plan")

    def draw(self, *options, out="result"):
        """Return the frames by name, and the report's description of the run."""
        self.assert_done("--object", self.model("cube.obj"), "--plan", "plan.json", "--output", out,
                         "--size", "320x240", *options)
        return {name: self.read(f"{out}/{name}") for name in os.listdir(self.path(out))
                if name.endswith(".png")}

    def test_each_option_of_the_view_changes_every_frame_and_nothing_else(self):
        usual = self.draw(out="usual")
        self.assertEqual(self.draw(out="again"), usual)
        for options in (["--view", "30,20"], ["--view", "zoom=1.5"], ["--view", "orthographic"],
                        ["--edges", "none"], ["--finger-radius", "0.004"],
                        ["--frames", "all,object=glass"]):
            with self.subTest(options=options):
                frames = self.draw(*options)
                self.assertEqual(sorted(frames), sorted(usual))
                for name, picture in frames.items():
                    self.assertNotEqual(picture, usual[name], name)

    def test_edges_of_a_cube_are_all_creases(self):
        self.assertEqual(self.draw("--edges", "all", out="all"), self.draw("--edges", "crease"))
        self.assertNotEqual(self.draw("--edges", "angle=91", out="smooth"), self.draw())

    def size_of(self, path):
        """Return width and height of a PNG file, and whether it has an alpha channel."""
        header = self.read(path)[16:26]
        return struct.unpack(">II", header[:8]) + (header[9] == 6,)

    def test_without_a_size_frames_are_cropped_to_what_is_drawn(self):
        files = ["--object", self.model("cube.obj"), "--plan", "plan.json", "--output"]
        self.assert_done(*files, "cropped", "--view", "0,0")
        width, height, _ = self.size_of("cropped/000_hold.png")
        self.assertLess(width, 1280)
        self.assertEqual(height, 960)
        self.assert_done(*files, "whole", "--size", "1280x960", "--view", "0,0")
        self.assertEqual(self.size_of("whole/000_hold.png"), (1280, 960, False))

    def test_the_sheet_has_the_width_that_is_asked_for(self):
        for width in (300, 600):
            self.draw("--size", f"overview={width}")
            found, _, _ = self.size_of("result/overview.png")
            self.assertTrue(0.95 * width <= found <= width, found)

    def test_frames_stand_on_what_is_asked_for(self):
        usual = self.draw(out="usual")
        dark = self.draw("--background", "dark", out="dark")
        clear = self.draw("--background", "transparent", out="clear")
        for name in usual:
            self.assertNotEqual(dark[name], usual[name], name)
            self.assertEqual(self.size_of(f"clear/{name}")[2], name != "overview.png", name)
            self.assertFalse(self.size_of(f"usual/{name}")[2])
        self.assertEqual(clear["overview.png"], usual["overview.png"])

    def views_of(self, model, *options):
        """Return the number of frames with a different view, as reported by the page."""
        self.assert_done("--object", self.model(f"{model}.obj"), "--start",
                         self.model(f"{model}.start.json"), "--goal",
                         self.model(f"{model}.goal.json"), "--friction-angle", "20", "--output",
                         f"{model}.json", program="plan")
        self.assert_done("--object", self.model(f"{model}.obj"), "--plan", f"{model}.json",
                         "--output", model, "--size", "320x240", *options)
        return self.read(f"{model}/report.html").count(b"seen from another side")

    def test_a_frame_in_which_a_finger_is_hidden_has_a_view_of_its_own_and_the_page_says_so(self):
        self.assertGreater(self.views_of("l_block"), 0)
        self.assertEqual(self.views_of("cube"), 0)
        self.assertEqual(self.views_of("l_block", "--view", "30,20"), 0)

    def test_a_whole_turn_is_no_turn(self):
        self.assertEqual(self.draw("--view=-330,20", out="a"), self.draw("--view", "30,20"))

    def test_refuses_views_that_are_none(self):
        files = ["--object", self.model("cube.obj"), "--plan", "plan.json", "--output", "result"]
        for options, words in ((["--view", "30"], ["--view", '"30"', "30,20"]),
                               (["--view", "30,91"], ["--view", "91"]),
                               (["--view", "a,b"], ["--view", "a"]),
                               (["--view", "zoom=0"], ["--view zoom", "0"]),
                               (["--background", "blue"], ["--background", "blue"]),
                               (["--size", "overview=10"], ["--size overview", "10"]),
                               (["--edges", "some"], ["--edges", "some"]),
                               (["--edges", "angle=181"], ["--edges angle", "181"])):
            with self.subTest(options=options):
                self.assert_refused(2, words, *files, *options)


if __name__ == "__main__":
    program_case.main()
