"""The program validate from the shell: verdicts, outputs, and bad input."""

import copy
import csv
import hashlib
import json
import math
import os
import shutil
import struct
import xml.etree.ElementTree as ElementTree

import jsonschema

import program_case
from program_case import ProgramCase


def png_size(data):
    """Width and height in the header of a PNG file."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", data[16:24])


class Validate(ProgramCase):
    program = "validate"
    good_plan = None

    def setUp(self):
        super().setUp()
        if Validate.good_plan is None:
            self.assert_done(
                "--object", self.model("cube.obj"), "--start", self.model("cube.start.json"),
                "--goal", self.model("cube.goal.json"), "--friction-angle", "20", "--contacts",
                "30", "--output", "plan.json", program="plan")
            Validate.good_plan = json.loads(self.read("plan.json"))
        self.plan = copy.deepcopy(Validate.good_plan)
        self.write_plan()

    def write_plan(self):
        self.write_json("plan.json", self.plan)

    def arguments(self, *more, **changes):
        options = {"--object": self.model("cube.obj"), "--plan": "plan.json", "--out": "result"}
        options.update({"--" + key.replace("_", "-"): value for key, value in changes.items()})
        return [word for key, value in options.items() if value is not None
                for word in (key, value)] + list(more)

    def report(self):
        """The report, which always follows its schema."""
        report = json.loads(self.read("result/report.json"))
        schema = os.path.join(program_case.ARGUMENTS.source, "docs", "report.schema.json")
        with open(schema, encoding="utf-8") as file:
            jsonschema.validate(report, json.load(file))
        return report

    def frames(self):
        return sorted(name for name in os.listdir(self.path("result")) if name.endswith(".png"))

    def assert_passes(self, *more, **changes):
        done = self.assert_done(*self.arguments(*more, **changes))
        report = self.report()
        self.assertEqual(report["verdict"], "pass")
        return done, report

    def assert_fails(self, index, reason, *more, **changes):
        """Exit code 1, this reason at this step, those before passed and those after skipped."""
        done = self.run_program(*self.arguments("--no-frames", *more, **changes))
        self.assertEqual(done.returncode, 1, done.stderr)
        report = self.report()
        verdicts = [step["verdict"] for step in report["steps"]]
        reasons = [step["reason"] for step in report["steps"]]
        after = len(report["steps"]) - index - 1
        self.assertEqual(report["verdict"], "fail")
        self.assertEqual(verdicts, ["pass"] * index + ["fail"] + ["skipped"] * after, reasons)
        self.assertEqual(reasons, [None] * index + [reason] + [None] * after)
        return report

    def refuse(self, words, *more, code=2, **changes):
        return self.assert_refused(code, words, *self.arguments(*more, **changes))

    # A good plan.

    def test_passes_a_good_plan_with_a_frame_for_each_step(self):
        done, report = self.assert_passes(size="320x240")
        steps = report["steps"]
        self.assertEqual(len(steps), len(self.plan["steps"]) + 1)
        self.assertEqual([step["index"] for step in steps], list(range(len(steps))))
        self.assertEqual([step["kind"] for step in steps],
                         ["hold"] + [step["kind"] for step in self.plan["steps"]])
        self.assertEqual(self.frames(), [step["frame"] for step in steps])
        self.assertEqual(self.frames()[:2], ["000_hold.png", "001_switch.png"])
        for step in steps:
            self.assertTrue(step["force_closure"]["holds"])
            self.assertLess(step["force_closure"]["required_half_angle_deg"], 20)
            self.assertLess(step["simulation"]["displacement_m"], 1e-4)
            self.assertEqual(png_size(self.read("result/" + step["frame"])), (320, 240))
        self.assertIn("weakest: step", done.stdout)
        self.assertIn("verdict: pass", done.stdout)
        self.assertEqual(done.stderr, "")

    def test_quiet_prints_nothing(self):
        done, _ = self.assert_passes("--quiet", "--no-frames")
        self.assertEqual(done.stdout + done.stderr, "")

    def test_the_folder_is_named_after_the_plan_where_none_is_given(self):
        self.assert_done(*self.arguments("--no-frames", out=None))
        self.assertEqual(json.loads(self.read("out/plan/report.json"))["verdict"], "pass")

    def test_the_same_plan_gives_the_same_bytes(self):
        self.assert_passes(size="200x150")
        first = {name: self.read("result/" + name) for name in os.listdir(self.path("result"))}
        self.assert_passes(size="200x150", out="again")
        self.assertGreater(len(first), 3)
        for name, content in first.items():
            self.assertEqual(self.read("again/" + name), content, name)

    def test_frames_of_an_earlier_run_do_not_stay(self):
        self.assert_passes(size="64x48")
        self.write("result/017_align.png", b"old")
        self.write("result/mine.png", b"kept")
        self.assertIn("000_hold.png", self.frames())
        _, report = self.assert_passes("--no-frames")
        self.assertEqual(self.frames(), ["mine.png"])
        self.assertTrue(all(step["frame"] is None for step in report["steps"]))

    def test_start_and_goal_files_are_those_of_the_plan(self):
        self.assert_passes("--no-frames", start=self.model("cube.start.json"),
                           goal=self.model("cube.goal.json"))
        self.assert_fails(0, "start-differs", start=self.model("cube.goal.json"))
        self.assert_fails(len(self.plan["steps"]), "goal-not-reached",
                          goal=self.model("cube.start.json"))

    def test_an_align_is_replayed_and_says_how(self):
        before = [dict(contact) for contact in self.plan["initial"]["contacts"]]
        after = [dict(contact) for contact in before]
        # A small move along the face: 2 mm at right angles to the normal.
        axis = next(i for i in range(3) if abs(after[0]["normal"][i]) < 0.5)
        after[0]["point"] = list(after[0]["point"])
        after[0]["point"][axis] -= 0.002 if after[0]["point"][axis] > 0 else -0.002
        self.plan["steps"] = [{"kind": "align",
                               "waypoints": [{"contacts": before}, {"contacts": after}]}]
        self.plan["goal"] = {"contacts": after}
        self.write_plan()
        _, report = self.assert_passes(size="64x48")
        self.assertIn(report["steps"][1]["align_mode"], ["imitated", "slid"])
        self.assertEqual(self.frames(), ["000_hold.png", "001_align.png"])

    # Planar objects.

    def write_planar_plan(self):
        """A switch of two fingers for two, one back, and an align, on the square."""
        square = self.model("square.wkt")
        with open(square, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()

        def contact(finger, x, y):
            normal = [-x / 0.03, 0] if abs(x) == 0.03 else [0, -y / 0.03]
            return {"finger": finger, "point": [x, y], "normal": normal}

        left_right = [contact(0, 0.03, 0.001), contact(1, -0.03, 0)]
        below_above = [contact(2, 0.002, -0.03), contact(3, 0, 0.03)]
        triple = [contact(2, 0.002, -0.03), contact(3, -0.009, 0.03), contact(0, 0.012, 0.03)]
        self.plan = {
            "format": "regrasp-plan", "version": 1,
            "object": {"file": "square.wkt", "sha256": digest, "scale": 1.0, "dimension": 2},
            "friction": {"half_angle_deg": 15.0}, "fingers": 4, "planner": "polygon",
            "initial": {"contacts": left_right},
            "steps": [
                {"kind": "switch", "place": below_above, "release": [0, 1]},
                {"kind": "switch", "place": [triple[2]], "release": []},
                {"kind": "align", "waypoints": [{"contacts": below_above + [triple[2]]},
                                                {"contacts": triple}]}],
            "goal": {"contacts": triple}}
        self.write_plan()
        return square

    def test_passes_a_planar_plan_with_a_frame_for_each_step(self):
        square = self.write_planar_plan()
        done, report = self.assert_passes(size="320x240", object=square)
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.frames(), ["000_hold.png", "001_switch.png", "002_switch.png",
                                         "003_align.png"])
        self.assertEqual(len(set(self.read("result/" + name) for name in self.frames())), 4)
        self.assertEqual(report["object"]["dimension"], 2)
        self.assertEqual(report["steps"][3]["align_mode"], "imitated")
        settings = report["settings"]
        self.assertAlmostEqual(settings["thickness_m"], 0.25 * 0.06 * 2 ** 0.5)
        self.assertAlmostEqual(settings["mass_kg"], 1000 * 0.06 ** 2 * settings["thickness_m"])
        self.assertEqual(settings["gravity_m_s2"], 0)

    def test_measures_the_contact_region_of_a_switch_between_two_finger_grasps(self):
        square = self.write_planar_plan()
        done, report = self.assert_passes("--no-frames", object=square)
        # The worse grasp is 2 mm of 60 off the normal; contacts off by h each tilt it by 2 h more.
        expected = (0.06 * math.tan(math.radians(15)) - 0.002) / 2
        region = report["steps"][1]["region"]
        self.assertAlmostEqual(region["half_width"], expected, delta=1e-7)
        self.assertEqual((region["claimed"], region["holds"]), (None, True))
        self.assertEqual(["region" in step for step in report["steps"]],
                         [False, True, False, False])
        self.assertIn("region", done.stdout.splitlines()[0])
        self.assertEqual(done.stderr, "")

    def test_warns_of_a_contact_region_that_is_smaller_than_claimed_and_still_passes(self):
        square = self.write_planar_plan()
        for claimed, holds in ((0.007, True), (0.008, False)):
            with self.subTest(claimed=claimed):
                self.plan["steps"][0]["place"][0]["region"] = 0.02
                self.plan["steps"][0]["place"][1]["region"] = claimed
                self.write_plan()
                done, report = self.assert_passes("--no-frames", object=square)
                region = report["steps"][1]["region"]
                self.assertEqual((region["claimed"], region["holds"]), (claimed, holds))
                self.assertEqual(len(done.stderr.splitlines()), 0 if holds else 1)
                if not holds:
                    self.assertIn("warning: step 1: the plan claims a contact region of 0.008",
                                  done.stderr)

    def test_refuses_a_contact_region_that_is_no_length(self):
        square = self.write_planar_plan()
        self.plan["steps"][0]["place"][1]["region"] = -0.001
        self.write_plan()
        self.refuse(["plan.json", "/steps/0/place/1/region", "-0.001"], object=square)

    def test_fails_a_planar_plan_below_its_friction(self):
        # The first pair is 1 mm of 60 off the normal: 0.955 degrees.
        square = self.write_planar_plan()
        self.assert_fails(0, "not-force-closure", object=square, friction_angle="0.9")

    def test_a_planar_plan_has_the_thickness_that_is_asked_for(self):
        square = self.write_planar_plan()
        _, report = self.assert_passes("--no-frames", object=square, thickness="0.002",
                                       trajectory="fingers.csv", export_mjcf="scene.xml")
        self.assertEqual(report["settings"]["thickness_m"], 0.002)
        self.assertAlmostEqual(report["settings"]["mass_kg"], 0.0072)
        with open(self.path("fingers.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 100)
        self.assertEqual({row["finger"] for row in rows}, {"0", "1", "2", "3"})
        self.assertTrue(all(float(row["contact_z_m"]) == 0 for row in rows))
        scene = ElementTree.fromstring(self.read("scene.xml"))
        joints = [joint.get("type") for joint in scene.findall("worldbody/body/joint")]
        self.assertEqual(joints[:3], ["slide", "slide", "hinge"])

    def test_refuses_a_thickness_that_makes_no_sense(self):
        self.refuse(["--thickness", "solid"], thickness="0.01")
        square = self.write_planar_plan()
        for value in ["0", "-1", "nan", "x"]:
            self.refuse("--thickness", thickness=value, object=square)
        self.refuse("thickness", thickness="1e9", object=square)

    # Further outputs.

    def test_junit_is_well_formed_and_has_a_case_for_each_step(self):
        self.assert_passes("--no-frames", junit="junit.xml")
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        self.assertEqual(len(suite.findall("testcase")), len(self.plan["steps"]) + 1)
        self.assertEqual(suite.get("failures"), "0")
        self.assert_fails(0, "not-force-closure", friction_angle="0.5", junit="junit.xml")
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        self.assertEqual(suite.get("failures"), "1")
        self.assertEqual(suite.find("testcase/failure").get("message"), "not-force-closure")
        self.assertEqual(len(suite.findall("testcase/skipped")), len(self.plan["steps"]))

    def test_the_scene_is_exported_as_mjcf(self):
        self.assert_passes("--no-frames", export_mjcf="scene.xml")
        scene = ElementTree.fromstring(self.read("scene.xml"))
        self.assertEqual(scene.tag, "mujoco")
        self.assertIsNotNone(scene.find("worldbody/body"))

    def test_the_trajectory_has_a_row_for_each_finger_and_instant(self):
        self.assert_passes("--no-frames", trajectory="fingers.csv")
        with open(self.path("fingers.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 100)
        self.assertEqual({row["finger"] for row in rows}, {"0", "1", "2", "3", "4"})
        times = [float(row["time_s"]) for row in rows]
        self.assertEqual(times, sorted(times))
        self.assertTrue(any(abs(float(row["force_x_N"])) > 0 for row in rows))

    # Plans that fail.

    def test_fails_a_contact_off_the_surface(self):
        contact = self.plan["steps"][1]["place"][0]
        contact["point"] = [p - 0.001 * n for p, n in zip(contact["point"], contact["normal"])]
        self.write_plan()
        report = self.assert_fails(2, "off-surface")
        self.assertIsNone(report["steps"][2]["simulation"])
        self.assertIsNone(report["steps"][2]["frame"])
        self.assertIsNotNone(report["steps"][1]["simulation"])

    def test_fails_a_wrong_normal(self):
        contact = self.plan["initial"]["contacts"][0]
        contact["normal"] = [-n for n in contact["normal"]]
        self.write_plan()
        self.assert_fails(0, "wrong-normal")

    def test_fails_a_finger_that_is_placed_while_it_holds(self):
        self.plan["steps"][0]["place"][0]["finger"] = self.plan["steps"][0]["release"][0]
        self.write_plan()
        self.assert_fails(1, "finger-not-free")

    def test_fails_a_finger_released_that_does_not_hold(self):
        step = self.plan["steps"][0]
        holding = {contact["finger"] for contact in self.plan["initial"]["contacts"]}
        step["place"], step["release"] = [], list({0, 1, 2, 3, 4} - holding)
        self.write_plan()
        self.assert_fails(1, "finger-not-holding")

    def test_fails_a_finger_outside_the_hand(self):
        self.plan["steps"][0]["place"][0]["finger"] = 7
        self.write_plan()
        self.assert_fails(1, "too-many-fingers")

    def test_fails_a_release_that_loses_the_object(self):
        holding = [contact["finger"] for contact in self.plan["initial"]["contacts"]]
        self.plan["steps"][0] = {"kind": "switch", "place": [], "release": holding[:3]}
        self.write_plan()
        self.assert_fails(1, "not-force-closure")

    def test_fails_a_plan_that_stops_before_its_goal(self):
        self.plan["steps"].pop()
        self.write_plan()
        self.assert_fails(len(self.plan["steps"]), "goal-not-reached")

    def test_fails_friction_below_what_the_plan_needs(self):
        _, report = self.assert_passes("--no-frames")
        angles = [step["force_closure"]["required_half_angle_deg"] for step in report["steps"]]
        index = next(i for i, angle in enumerate(angles) if angle > 0.9 * max(angles))
        self.assert_fails(index, "not-force-closure", friction_angle=str(0.9 * max(angles)))

    def test_a_tolerance_that_nothing_meets_fails_in_the_replay(self):
        # Fingertips creep before the object does, and the first reason counts.
        report = self.assert_fails(0, "slipped", tolerance="1e-12")
        self.assertIsNotNone(report["steps"][0]["simulation"])

    def test_a_step_that_fails_in_the_replay_has_a_frame_and_no_later_one_has(self):
        done = self.run_program(*self.arguments(tolerance="1e-12", size="64x48"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.frames(), ["000_hold.png"])

    # Bad input.

    def test_refuses_another_object_unless_allowed(self):
        other = self.path("other.obj")
        shutil.copy(self.model("cube.obj"), other)
        with open(other, "a", encoding="utf-8") as file:
            file.write("# another byte\n")
        self.refuse(["plan.json", "sha256", "other.obj"], object=other)
        self.assert_passes("--no-frames", "--allow-object-change", object=other)

    def test_refuses_plans_that_cannot_be_read(self):
        text = json.dumps(self.plan)
        cases = {
            "empty": "",
            "truncated": text[:len(text) // 2],
            "binary": bytes(range(256)) * 8,
            "deep": "[" * 100000,
            "deep value": text[:-1] + ', "x": ' + "[" * 5000 + "]" * 5000 + "}",
            "not a number": text.replace("20.0", "NaN"),
            "repeated key": text[:-1] + ', "fingers": 5}',
            "wrong version": text.replace('"version": 1', '"version": 2'),
            "wrong type": text.replace('"fingers": 5', '"fingers": "five"'),
            "huge number": text.replace('"fingers": 5', '"fingers": 1e400'),
        }
        for name, content in cases.items():
            with self.subTest(name):
                self.assertNotEqual(content, text)
                self.write("plan.json", content)
                self.refuse("plan.json")
        self.assertEqual(len(cases), 10)

    def test_refuses_plans_with_a_missing_member(self):
        checked = 0
        for name in Validate.good_plan:
            with self.subTest(name):
                self.plan = copy.deepcopy(Validate.good_plan)
                del self.plan[name]
                self.write_plan()
                self.refuse(["plan.json"])
                checked += 1
        self.assertGreaterEqual(checked, 9)

    def test_refuses_files_that_are_not_there(self):
        self.refuse("missing.json", plan="missing.json")
        self.refuse("missing.obj", object="missing.obj")
        self.refuse("missing.json", start="missing.json")

    def test_refuses_a_dimension_that_is_not_the_objects(self):
        square = self.model("square.wkt")
        self.refuse(["plan.json", "dimension", "square.wkt"], object=square)

    def test_refuses_bad_usage(self):
        self.refuse("--scale 2", scale="2")
        self.refuse("--size", size="12")
        self.refuse("--size", size="10x10")
        self.refuse("--size", size="640x1e3")
        self.refuse("--friction-angle", friction_angle="20", mu="0.3")
        self.refuse("--mu", mu="0")
        self.refuse("--mass", mass="1", density="1000")
        self.refuse("--squeeze", squeeze="-1")
        self.refuse("--tolerance", tolerance="nan")
        self.refuse("--plan", plan=None)
        self.refuse("--unknown", "--unknown")

    def test_accepts_the_scale_of_the_plan(self):
        self.assert_passes("--no-frames", scale="1")

    def test_says_when_the_folder_cannot_be_written(self):
        self.write("file", "in the way")
        self.refuse("file", code=3, out="file/result")
        self.refuse("file", code=3, out="file")
        done = self.run_program(*self.arguments("--no-frames", junit="nowhere/junit.xml"))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
        self.assertIn("nowhere", done.stderr)

    def test_help_names_units_and_version_names_the_program(self):
        text = self.assert_done("--help").stdout
        for word in ["kg", "newtons", "degrees", "pixels", "diameters", "--squeeze"]:
            self.assertIn(word, text)
        self.assertIn("validate", self.assert_done("--version").stdout)


if __name__ == "__main__":
    program_case.main()
