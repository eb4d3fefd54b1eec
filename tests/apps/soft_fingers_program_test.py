"""Soft fingers from the shell: planning, validation and replay, and errors for unsupported options.
"""

import json
import math

import program_case
from program_case import ProgramCase


class SoftFingers(ProgramCase):
    program = "validate"
    soft = ("--torsion", "0.01")

    def pair(self, name, axis, off=0.0):
        """Write a grasp file of two fingers on opposite faces of models/cube.obj."""
        contacts = []
        for side in (-1, 1):
            point = [off if side > 0 else 0.0] * 3
            point[axis] = 0.03 * side
            normal = [0.0, 0.0, 0.0]
            normal[axis] = -side
            contacts.append({"point": point, "normal": normal})
        self.write_json(name, {"format": "regrasp-grasp", "version": 1, "contacts": contacts})
        return name

    def validate(self, *more, angle="25"):
        return ["--object", self.model("cube.obj"), "--grasp", self.pair("grasp.json", 0),
                "--friction-angle", angle, "--frames", "none", "--output", "result", *more]

    def plan(self, *more):
        return ["--object", self.model("cube.obj"), "--start", self.pair("start.json", 0),
                "--goal", self.pair("goal.json", 1), "--friction-angle", "25",
                "--output", "plan.json", *more]

    def test_two_fingers_hold_a_cube_and_hard_points_do_not(self):
        self.assert_done(*self.validate(*self.soft))
        report = self.report()
        self.assertEqual(report["verdict"], "pass")
        self.assertEqual(report["settings"]["torsion"], 0.01)
        # The resistance about their line is mu torsion over half the diameter.
        quality = math.tan(math.radians(25)) * 0.01 / (0.03 * math.sqrt(3))
        self.assertLessEqual(report["grasp"]["quality"], quality * (1 + 1e-6))
        self.assertGreaterEqual(report["grasp"]["quality_at_most"], quality * (1 - 1e-6))
        for hard in ([], ["--torsion", "0"]):
            done = self.run_program(*self.validate(*hard))
            self.assertEqual(done.returncode, 1)
            report = self.report()
            self.assertEqual(report["steps"][0]["reason"], "not-force-closure")
            self.assertNotIn("torsion", report["settings"])

    def test_a_torsion_below_the_shake_loses_the_cube_in_the_replay(self):
        # The torque of the disturbance is 0.01 of the grasp force times half the diameter.
        torsion = 0.8 * 0.01 * 0.03 * math.sqrt(3) / math.tan(math.radians(25))
        done = self.run_program(*self.validate("--torsion", repr(torsion)))
        self.assertEqual(done.returncode, 1)
        step = self.report()["steps"][0]
        self.assertTrue(step["force_closure"]["holds"])
        self.assertNotEqual(step["reason"], "not-force-closure")

    def test_two_fingers_take_over_from_two(self):
        self.assert_done(*self.plan(*self.soft), program="plan")
        plan = json.loads(self.read("plan.json"))
        self.assertEqual(plan["torsion"], 0.01)
        plan_arguments = ["--object", self.model("cube.obj"), "--plan", "plan.json", "--frames", "none",
                          "--output", "result"]
        self.assert_done(*plan_arguments)
        self.assertEqual(self.report()["settings"]["torsion"], 0.01)
        # As hard contacts, and with a different torsion than that of the plan.
        self.assertEqual(self.run_program(*plan_arguments, "--torsion", "0").returncode, 1)
        self.assert_done(*plan_arguments, "--torsion", "0.02")
        self.assertEqual(self.report()["settings"]["torsion"], 0.02)
        # Two hard contacts are rejected as a start grasp.
        self.assert_refused(2, ["start.json", "found 2"], *self.plan(), program="plan")

    def test_proofs_have_torques_and_hold_exactly(self):
        self.assert_done(*self.plan(*self.soft), program="plan")
        plan = ["--object", self.model("cube.obj"), "--plan", "plan.json"]
        self.assert_done(*plan, "--frames", "none", "--output", "result", "--certificates")
        report = self.report()
        self.assertEqual(len(report["steps"][0]["proof"]["rest"]["torques"]), 2)
        verify = [*plan, "--verify", "result/report.json"]
        self.assertIn("force closure at every instant", self.assert_done(*verify).stdout)
        # The proofs are invalid for hard contacts, and with a torque beyond the torsional friction.
        self.assert_refused(2, ["report.json", "torsion"], *verify, "--torsion", "0")
        report["steps"][0]["proof"]["rest"]["torques"] = [1, 1]
        self.write_json("result/report.json", report)
        self.assertEqual(self.run_program(*verify).returncode, 1)

    def test_hard_points_are_the_default_to_the_byte(self):
        plan = ["--object", self.model("cube.obj"), "--start", self.model("cube.start.json"),
                "--goal", self.model("cube.goal.json"), "--friction-angle", "20", "--output"]
        self.assert_done(*plan, "plain.json", program="plan")
        self.assert_done(*plan, "hard.json", "--torsion", "0", program="plan")
        self.assertEqual(self.read("plain.json"), self.read("hard.json"))
        self.assertNotIn(b"torsion", self.read("hard.json"))

    def test_what_is_not_known_of_soft_fingers_is_refused(self):
        self.assert_refused(2, ["--torsion", "polyhedron"],
                            *self.plan(*self.soft, "--planner", "polyhedron"), program="plan")
        self.assert_refused(
            2, ["--torsion", "planar"], "--object", self.model("polygon15.wkt"), "--grasp",
            self.model("polygon15.start.json"), "--mu", "0.4", "--output", "result", *self.soft)
        self.assert_refused(
            2, ["--torsion"], "--object", self.model("cube.obj"), "--hand",
            self.model("hands/ring5.json"), "--turn", "z,90", "--mu", "0.8", "--output", "plan.json",
            *self.soft, program="plan")

    def test_bad_arguments_get_one_line(self):
        for arguments, words in (
                (["--torsion", "-1"], ["--torsion"]),
                (["--torsion", "thick"], ["--torsion", "thick"]),
                # The names of one version ago.
                (["--contact", "soft"], ["--contact soft", "requires --torsion"]),
                (["--contact", "hard", "--torsion", "0.01"], ["--torsion", "--contact hard"]),
                (["--contact", "rubber"], ["--contact", "rubber"])):
            with self.subTest(arguments):
                self.assert_refused(2, words, *self.validate(*arguments))


if __name__ == "__main__":
    program_case.main()
