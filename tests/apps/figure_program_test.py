"""The program figure from the shell: images of plans, and invalid input."""

import copy
import hashlib
import json
import os
import shutil
import struct
import xml.etree.ElementTree as ElementTree

import program_case
from program_case import ProgramCase

SVG = "{http://www.w3.org/2000/svg}"

# Colours of fingers 0 to 3 (render/picture/image.cc), as Cairo writes them in an SVG.
COLOURS = ("rgb(0%,39.607843%,64.705882%)", "rgb(94.117647%,69.019608%,0%)",
           "rgb(23.921569%,70.196078%,61.960784%)", "rgb(53.333333%,13.333333%,33.333333%)")


def opaque_fills(svg, colour):
    """Return the paths with an opaque fill of this colour: markers and arrow heads."""
    styles = [path.get("style", "").replace(" ", "")
              for path in ElementTree.fromstring(svg).iter(SVG + "path")]
    return sum(";fill:" + colour + ";fill-opacity:1;" in ";" + style for style in styles)


class Figure(ProgramCase):
    program = "figure"

    def setUp(self):
        super().setUp()
        self.plan = json.loads(self.data("plan_good", "square_parallel_and_two_finger.json"))
        self.write_plan()

    def data(self, *names):
        path = os.path.join(program_case.ARGUMENTS.source, "tests", "data", "plans", *names)
        with open(path, encoding="utf-8") as file:
            return file.read()

    def write_plan(self):
        self.write_json("plan.json", self.plan)

    def arguments(self, *more, **changes):
        options = {"--object": self.model("square.wkt"), "--plan": "plan.json", "--output": "result"}
        options.update({"--" + key: value for key, value in changes.items()})
        return [word for key, value in options.items() if value is not None
                for word in (key, value)] + list(more)

    def draw(self, *more, **changes):
        self.assert_done(*self.arguments(*more, **changes))
        return sorted(os.listdir(self.path(changes.get("output", "result"))))

    def refuse(self, words, *more, code=2, **changes):
        return self.assert_refused(code, words, *self.arguments(*more, **changes))

    def test_a_plan_for_a_hand_is_drawn_with_its_hand_and_with_no_other(self):
        cube, hand = self.model("cube.obj"), self.model(os.path.join("hands", "ring4.json"))
        self.assert_done("--object", cube, "--scale", "0.8", "--mu", "0.8",
                         "--hand", hand, "--turn", "z,90", "--robustness", "none", "--output",
                         "hand_plan.json", program="plan")
        self.refuse("hand_plan.json: a plan with a hand requires --hand; help: pass --hand ring4.json",
                    object=cube, plan="hand_plan.json")
        self.refuse(["--hand", "expected ring4.json", "found", "ring5.json"], object=cube,
                    plan="hand_plan.json", hand=self.model(os.path.join("hands", "ring5.json")))
        self.assertFalse(os.path.exists(self.path("result")))
        for output in ("first", "second"):
            names = self.draw(object=cube, plan="hand_plan.json", hand=hand, output=output)
        steps = json.loads(self.read("hand_plan.json"))["steps"]
        self.assertEqual(len(names), len(steps) + 2)
        for name in names:
            self.assertEqual(self.read("first/" + name), self.read("second/" + name))
            self.assertLess(len(self.read("first/" + name)), 500_000 * len(names))

    def test_a_hand_requires_a_plan_with_a_hand(self):
        self.refuse(["--hand", "plan.json", "without a hand"],
                    hand=self.model(os.path.join("hands", "ring4.json")))

    def test_the_font_family_must_be_installed(self):
        usual = self.draw()
        self.draw("--size", "family=monospace", output="other")
        self.assertNotEqual(self.read("result/sheet.svg"), self.read("other/sheet.svg"))
        self.assertEqual(usual, sorted(os.listdir(self.path("other"))))
        for name in ("No such family", "<b>&", ""):
            self.refuse(["--size family", "not found"], "--size", "family=" + name, output="none")

    def test_captions_are_drawn_unless_none_are_wanted(self):
        self.draw(format="png", output="usual")
        self.draw("--size", "captions=none", format="png", output="bare")
        for name in ("000_hold.png", "sheet.png"):
            usual, bare = (struct.unpack(">II", self.read(f"{folder}/{name}")[16:24])
                           for folder in ("usual", "bare"))
            self.assertEqual(usual[0], bare[0])
            self.assertGreater(usual[1], bare[1] + 20)
        self.refuse(["--size captions", "above"], "--size", "captions=above")

    def test_a_terminal_is_told_what_is_done_from_the_first_moment(self):
        done, shown = self.run_on_terminal(*self.arguments())
        self.assertEqual(done.returncode, 0, shown)
        self.assert_stages(shown, "reading ", "checking the plan", "figure 1 of 5")
        self.assertEqual(self.run_on_terminal(*self.arguments("--quiet"))[1], "")

    def names(self, ending):
        return [name + "." + ending for name in
                ("000_hold", "001_align", "002_switch", "003_switch", "004_align", "sheet")]

    # Valid plans.

    def test_draws_a_figure_of_each_step_and_a_sheet(self):
        self.assertEqual(self.draw(), self.names("svg"))

    def test_every_svg_is_xml_with_a_marker_for_each_finger(self):
        self.draw()
        holding = {"000_hold": (0, 1, 2), "001_align": (1, 2), "002_switch": (1, 2),
                   "003_switch": (3,)}
        for name, fingers in holding.items():
            svg = self.read("result/" + name + ".svg")
            for finger in fingers:
                with self.subTest(figure=name, finger=finger):
                    self.assertEqual(opaque_fills(svg, COLOURS[finger]), 1)
        self.assertEqual(opaque_fills(self.read("result/000_hold.svg"), COLOURS[3]), 0)
        sheet = self.read("result/sheet.svg")
        for colour in COLOURS:
            self.assertGreater(opaque_fills(sheet, colour), 1)

    def test_svg_has_the_size_of_print(self):
        self.draw()
        column = ElementTree.fromstring(self.read("result/000_hold.svg")).get("width")
        sheet = ElementTree.fromstring(self.read("result/sheet.svg")).get("width")
        points_per_millimetre = 72 / 25.4
        self.assertTrue(column.endswith("pt") and sheet.endswith("pt"), (column, sheet))
        self.assertAlmostEqual(float(column[:-2]), 85 * points_per_millimetre, places=3)
        self.assertAlmostEqual(float(sheet[:-2]), 174 * points_per_millimetre, places=3)

    def test_draws_pdf(self):
        self.assertEqual(self.draw(format="pdf"), self.names("pdf"))
        for name in self.names("pdf"):
            pdf = self.read("result/" + name)
            self.assertTrue(pdf.startswith(b"%PDF-"), name)
            self.assertTrue(pdf.rstrip().endswith(b"%%EOF"), name)

    def test_draws_png(self):
        self.assertEqual(self.draw(format="png"), self.names("png"))
        for name in self.names("png"):
            png = self.read("result/" + name)
            self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n", name)
            width = struct.unpack(">I", png[16:20])[0]
            self.assertEqual(width, 2055 if name == "sheet.png" else 1004, name)

    def test_draws_the_same_bytes_twice(self):
        for ending in ("svg", "pdf", "png"):
            names = self.draw(format=ending, output="first")
            self.draw(format=ending, output="second")
            self.assertEqual(names, self.names(ending))
            for name in names:
                self.assertEqual(self.read("first/" + name), self.read("second/" + name), name)
            shutil.rmtree(self.path("first"))
        self.assertNotEqual(self.read("second/000_hold.svg"), self.read("second/001_align.svg"))

    def test_draws_concurrent_grasps(self):
        self.write("plan.json", self.data("plan_good", "triangle_concurrent.json"))
        names = self.draw(object=self.model("triangle.wkt"))
        self.assertEqual(names, ["000_hold.svg", "001_align.svg", "002_switch.svg", "sheet.svg"])

    def test_a_plan_without_steps_has_the_hold(self):
        del self.plan["steps"][:]
        self.plan["goal"] = self.plan["initial"]
        self.write_plan()
        self.assertEqual(self.draw(), ["000_hold.svg", "sheet.svg"])

    def test_replaces_the_figures_of_an_earlier_run_and_nothing_else(self):
        self.draw()
        self.draw(format="pdf")
        self.write("result/notes.txt", "mine")
        self.write("result/006_align.svg", "<?xml version=\"1.0\"?>\n<svg/>\n")
        # A file that cannot be read is kept too; here it is larger than the input limit.
        with open(self.path("result/005_align.svg"), "wb") as large:
            large.truncate(2 ** 30 + 1)
        # An earlier run creates no folders and no links, so these are kept.
        os.mkdir(self.path("result/007_align.svg"))
        os.symlink("notes.txt", self.path("result/008_align.svg"))
        del self.plan["steps"][2:]
        self.plan["goal"]["contacts"] = [
            self.plan["initial"]["contacts"][1], self.plan["initial"]["contacts"][2],
            self.plan["steps"][1]["place"][0]]
        self.write_plan()
        names = self.names("svg")
        self.assertEqual(self.draw(),
                         sorted(names[:3] + names[-1:] + self.names("pdf") +
                                ["notes.txt", "005_align.svg", "006_align.svg", "007_align.svg",
                                 "008_align.svg"]))

    def test_says_nothing_when_all_is_well(self):
        done = self.assert_done(*self.arguments())
        self.assertEqual((done.stdout, done.stderr), ("", ""))

    # Contact space.

    def use_two_finger_plan(self):
        """Use a plan on a fork: both sides are held, then its right prong; in between a contact
        moves."""
        fork = "POLYGON((0 0, 10 0, 10 10, 7 10, 7 3, 3 3, 3 10, 0 10, 0 0))\n"
        self.write("fork.wkt", fork)

        def at(finger, x, y):
            return {"finger": finger, "point": [x, y], "normal": [-1 if x == 10 else 1, 0]}

        goal = [at(0, 10, 7), at(2, 7, 8)]
        self.plan = {
            "format": "regrasp-plan", "version": 1,
            "object": {"file": "fork.wkt", "scale": 1.0, "dimension": 2,
                       "sha256": hashlib.sha256(fork.encode()).hexdigest()},
            "friction": {"half_angle_deg": 20.0}, "fingers": 3, "planner": "contour",
            "initial": {"contacts": [at(0, 10, 8), at(1, 0, 8)]},
            "steps": [
                {"kind": "switch", "place": [at(2, 7, 8)], "release": [1]},
                {"kind": "align", "waypoints": [{"contacts": [at(0, 10, 8), at(2, 7, 8)]},
                                                {"contacts": goal}]}],
            "goal": {"contacts": [{"point": c["point"], "normal": c["normal"]} for c in goal]}}
        self.write_plan()
        return self.path("fork.wkt")

    def test_draws_the_contact_space_and_every_switch_on_request(self):
        fork = self.use_two_finger_plan()
        steps = ["000_hold", "001_switch", "002_align"]
        for ending in ("svg", "pdf", "png"):
            names = self.draw("--contact-space", object=fork, format=ending, output=ending)
            self.assertEqual(names, [name + "." + ending for name in
                                     steps + ["contact_space", "contact_space_001", "sheet"]])
        svg = ElementTree.fromstring(self.read("svg/contact_space_001.svg"))
        self.assertAlmostEqual(float(svg.get("width")[:-2]), 174 * 72 / 25.4, places=3)
        self.assertTrue(self.read("pdf/contact_space.pdf").startswith(b"%PDF-"))
        self.assertEqual(struct.unpack(">I", self.read("png/contact_space.png")[16:20])[0], 1004)

    def test_draws_no_contact_space_unless_told_and_removes_that_of_an_earlier_run(self):
        fork = self.use_two_finger_plan()
        self.draw("--contact-space", object=fork)
        self.write("result/contact_space_12.svg", "mine")
        self.write("result/contact_space_001.txt", "mine")
        names = ["000_hold.svg", "001_switch.svg", "002_align.svg", "contact_space_001.txt",
                 "contact_space_12.svg", "sheet.svg"]
        self.assertEqual(self.draw(object=fork), names)

    def test_draws_the_same_contact_space_twice(self):
        fork = self.use_two_finger_plan()
        for out in ("first", "second"):
            self.draw("--contact-space", object=fork, output=out)
        for name in ("contact_space.svg", "contact_space_001.svg"):
            self.assertEqual(self.read("first/" + name), self.read("second/" + name), name)
        self.assertNotEqual(self.read("first/contact_space.svg"),
                            self.read("first/contact_space_001.svg"))

    def test_a_switch_of_both_contacts_is_in_the_overview_only(self):
        self.write("plan.json", self.data("plan_good", "square_two_for_two.json"))
        square = self.write("square.wkt", "POLYGON((-1 -1, 1 -1, 1 1, -1 1, -1 -1))")
        names = self.draw("--contact-space", "--allow", "object-change", object=square)
        self.assertIn("contact_space.svg", names)
        self.assertEqual([name for name in names if name.startswith("contact_space_")], [])

    def test_refuses_the_contact_space_of_other_than_two_contacts(self):
        self.refuse(["plan.json", "initial grasp", "3 contacts", "--format contact-space"],
                    "--format", "contact-space")
        fork = self.use_two_finger_plan()
        self.plan["steps"][0]["release"] = []
        self.plan["steps"][1]["waypoints"] = [
            {"contacts": self.plan["initial"]["contacts"] + self.plan["steps"][0]["place"]}] * 2
        goal = self.plan["steps"][1]["waypoints"][1]["contacts"]
        self.plan["goal"]["contacts"] = goal
        self.write_plan()
        self.refuse(["plan.json", "step 1", "3 contacts", "contact-space"], "--format", "contact-space",
                    object=fork)

    # Invalid usage.

    def test_refuses_missing_options(self):
        for name in ("object", "plan", "output"):
            self.refuse("--" + name, **{name: None})

    def test_refuses_other_formats(self):
        self.refuse(["--format", "bmp"], format="bmp")

    def test_draws_each_step_of_a_solid_in_every_format(self):
        self.assert_done("--object", self.model("cube.obj"), "--start",
                         self.model("cube.start.json"), "--goal", self.model("cube.goal.json"),
                         "--friction-angle", "20", "--output", "plan.json", program="plan")
        steps = json.loads(self.read("plan.json"))["steps"]
        kinds = ["hold"] + [step["kind"] for step in steps]
        for file_format in ("svg", "pdf", "png"):
            names = [f"{i:03d}_{kind}.{file_format}" for i, kind in enumerate(kinds)]
            self.assertEqual(self.draw(object=self.model("cube.obj"), format=file_format,
                                       output=file_format), sorted(names + ["sheet." + file_format]))
        usual = self.read("svg/000_hold.svg")
        for options in (["--view", "30,20"], ["--edges", "none"]):
            self.draw(*options, object=self.model("cube.obj"), output="other")
            self.assertNotEqual(self.read("other/000_hold.svg"), usual)

    def test_scenes_are_written_where_asked_and_do_not_stay(self):
        scenes = [name[:-3] + "glb" for name in self.names("svg") if name[0] == "0"]
        self.assertEqual(self.draw("--format", "gltf"), sorted(self.names("svg") + scenes))
        for name in scenes:
            data = self.read("result/" + name)
            self.assertEqual(struct.unpack("<4sII", data[:12]), (b"glTF", 2, len(data)))
        self.write("result/003_switch.glb", b"glTF of somebody else")
        self.assertEqual(self.draw(), sorted(self.names("svg") + ["003_switch.glb"]))

    def test_widths_text_and_panels_are_as_asked(self):
        self.draw(format="png", output="usual")
        self.draw("--size", "width=42.5,font=5", "--panels", "0,2-3", format="png",
                  output="other")
        size = {name: struct.unpack(">II", self.read(name)[16:24])
                for name in ("usual/000_hold.png", "other/000_hold.png", "usual/sheet.png",
                             "other/sheet.png")}
        self.assertAlmostEqual(size["usual/000_hold.png"][0], 2 * size["other/000_hold.png"][0],
                               delta=2)
        self.assertLess(size["other/sheet.png"][0], size["usual/sheet.png"][0])

    def test_refuses_panels_and_sizes_that_are_none(self):
        for options in (["--panels", "5"], ["--panels", "3-1"], ["--panels", "a"],
                        ["--panels", "1,"], ["--size", "width=1"], ["--size", "font=0"]):
            with self.subTest(options=options):
                self.refuse(options[0], *options)

    def test_help_names_the_formats(self):
        done = self.assert_done("--help")
        self.assertIn("svg|pdf|png", done.stdout)

    # Invalid input.

    def test_refuses_files_that_are_not_there(self):
        self.refuse("nowhere.wkt", object="nowhere.wkt")
        self.refuse("nowhere.json", plan="nowhere.json")

    def test_refuses_for_solids_what_only_planar_objects_have_and_the_reverse(self):
        self.write("plan.json", self.data("plan_good", "cube_no_steps.json"))
        self.refuse(["--format contact-space", "cube.obj", "solid"], "--format", "contact-space",
                    object=self.model("cube.obj"))
        self.write_plan()
        self.refuse(["--view", "square.wkt", "planar"], "--view", "30,20")

    def test_refuses_the_plan_of_a_solid(self):
        self.write("plan.json", self.data("plan_good", "cube_no_steps.json"))
        self.refuse(["plan.json", "dimension"])

    def test_refuses_the_plan_of_another_object_unless_told(self):
        square = "POLYGON((-0.03 -0.03, 0.03 -0.03, 0.03 0.03, -0.03 0.03, -0.03 -0.03))"
        self.write("other.wkt", square + " \n")
        self.refuse(["plan.json", "sha256", "other.wkt"], object="other.wkt")
        self.assertEqual(self.draw("--allow", "object-change", object="other.wkt"), self.names("svg"))

    def test_refuses_another_scale(self):
        self.refuse("--scale", "--scale", "2")
        self.assertEqual(self.draw("--scale", "1"), self.names("svg"))

    def test_refuses_illegal_plans_and_names_the_step(self):
        def off_surface(plan):
            plan["initial"]["contacts"][0]["point"][1] -= 0.01

        def busy_finger(plan):
            plan["steps"][1]["place"][0]["finger"] = 1

        def little_friction(plan):
            plan["friction"]["half_angle_deg"] = 0.5

        def other_goal(plan):
            plan["goal"]["contacts"][0]["point"][0] += 0.001

        cases = ((off_surface, "step 0", "off-surface"), (busy_finger, "step 2", "finger-not-free"),
                 (little_friction, "step 4", "not-force-closure"),
                 (other_goal, "step 4", "goal-not-reached"))
        good = copy.deepcopy(self.plan)
        for spoil, step, reason in cases:
            with self.subTest(reason=reason):
                self.plan = copy.deepcopy(good)
                spoil(self.plan)
                self.write_plan()
                self.refuse(["plan.json", step, reason])

    def test_refuses_every_bad_plan_file(self):
        folder = os.path.join(program_case.ARGUMENTS.source, "tests", "data", "plans", "plan_bad")
        checked = 0
        for name in sorted(os.listdir(folder)):
            with self.subTest(plan=name):
                self.refuse(name, plan=os.path.join(folder, name))
                checked += 1
        self.assertGreater(checked, 20)

    # Environment.

    def test_a_folder_that_cannot_be_written_is_not_bad_input(self):
        self.write("taken", "a file, not a folder")
        self.refuse("taken", output="taken", code=3)
        self.refuse("taken", output="taken/below", code=3)
        self.assertEqual(self.read("taken"), b"a file, not a folder")


if __name__ == "__main__":
    program_case.main()
