"""How frames of `validate` look: where they are taken from, edges, true fingers."""

import os

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
        """The frames, by name, and the report's words on the run."""
        self.assert_done("--object", self.model("cube.obj"), "--plan", "plan.json", "--out", out,
                         "--size", "320x240", *options)
        return {name: self.read(f"{out}/{name}") for name in os.listdir(self.path(out))
                if name.endswith(".png")}

    def test_each_option_of_the_view_changes_every_frame_and_nothing_else(self):
        usual = self.draw(out="usual")
        self.assertEqual(self.draw(out="again"), usual)
        for options in (["--view", "30,20"], ["--zoom", "1.5"], ["--orthographic"],
                        ["--edges", "none"], ["--finger-radius", "0.004"]):
            with self.subTest(options=options):
                frames = self.draw(*options)
                self.assertEqual(sorted(frames), sorted(usual))
                for name, picture in frames.items():
                    self.assertNotEqual(picture, usual[name], name)

    def test_edges_of_a_cube_are_all_creases(self):
        self.assertEqual(self.draw("--edges", "all", out="all"), self.draw("--edges", "crease"))
        self.assertNotEqual(self.draw("--crease-angle", "91", out="smooth"), self.draw())

    def test_a_whole_turn_is_no_turn(self):
        self.assertEqual(self.draw("--view=-330,20", out="a"), self.draw("--view", "30,20"))

    def test_refuses_views_that_are_none(self):
        files = ["--object", self.model("cube.obj"), "--plan", "plan.json", "--out", "result"]
        for options, words in ((["--view", "30"], ["--view", '"30"', "30,20"]),
                               (["--view", "30,91"], ["--view", "91"]),
                               (["--view", "a,b"], ["--view", "a"]),
                               (["--zoom", "0"], ["--zoom", "0"]),
                               (["--edges", "some"], ["--edges", "some"]),
                               (["--crease-angle", "181"], ["--crease-angle", "181"])):
            with self.subTest(options=options):
                self.assert_refused(2, words, *files, *options)


if __name__ == "__main__":
    program_case.main()
