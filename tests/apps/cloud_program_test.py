"""Point clouds from the scan to the verdict.

All programs create the same solid from a cloud, and contacts can be restricted to its points.
"""

import json
import math

import program_case
from program_case import ProgramCase

POINTS = 1500


def egg():
    """Return points of an egg of a few centimetres, in an XYZ file in metres."""
    lines = []
    for i in range(POINTS):
        z = 1 - (2 * i + 1) / POINTS
        turn = i * math.pi * (3 - math.sqrt(5))
        r = math.sqrt(1 - z * z)
        lines.append(f"{0.03 * r * math.cos(turn):.9g} {0.025 * r * math.sin(turn):.9g} "
                     f"{0.04 * z:.9g}\n")
    return "".join(lines)


class Cloud(ProgramCase):
    program = "plan"

    def setUp(self):
        super().setUp()
        self.write("egg.xyz", egg())

    def plan(self, *more):
        return self.assert_done("--object", "egg.xyz", "--repair", "--mu", "0.6", "--start",
                                "random", "--goal", "random", "--seed", "1", "--output",
                                "plan.json", *more)

    def validate(self, *more, path="egg.xyz"):
        return self.run_program("--object", path, "--plan", "plan.json", "--no-frames", "--out",
                                "result", *more, program="validate")

    def points(self):
        return [tuple(map(float, line.split())) for line in egg().splitlines()]

    def test_contacts_of_a_plan_at_given_points_are_there(self):
        done = self.plan("--contacts", "given")
        self.assertIn("contacts: at given points, at most ", done.stderr)
        plan = json.loads(self.read("plan.json"))
        self.assertEqual(plan["contacts"], "given")
        grasps = [plan["initial"]["contacts"], plan["goal"]["contacts"]]
        for step in plan["steps"]:
            self.assertEqual(step["kind"], "switch")
            grasps.append(step["place"])
        farthest = max(min(math.dist(contact["point"], point) for point in self.points())
                       for grasp in grasps for contact in grasp)
        self.assertLess(farthest, 0.08e-3)
        done = self.validate()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("contacts: at given points, at most ", done.stdout)
        told = self.report()["plan"]["farthest_from_given_point"]
        self.assertAlmostEqual(told, farthest, places=9)

    def test_validate_fails_a_plan_whose_contacts_are_elsewhere(self):
        self.plan("--planner", "roadmap")
        plan = json.loads(self.read("plan.json"))
        self.assertNotIn("contacts", plan)
        self.assertEqual(self.validate().returncode, 0)
        plan["contacts"] = "given"
        self.write_json("plan.json", plan)
        done = self.run_program("--object", "egg.xyz", "--plan", "plan.json", "--no-frames",
                                "--out", "again", program="validate")
        self.assertEqual(done.returncode, 1, done.stderr)
        step = json.loads(self.read("again/report.json"))["steps"][0]
        self.assertEqual(step["reason"], "off-point")

    def test_the_points_are_those_of_the_cloud_and_not_of_the_solid(self):
        self.plan("--contacts", "given")
        self.assert_done("--object", "egg.xyz", "--output", "solid.obj", program="repair")
        done = self.validate(path="solid.obj")
        self.assertEqual(done.returncode, 2)
        self.assertIn("points of egg.xyz", done.stderr)

    def test_only_planners_of_contact_points_keep_to_given_ones(self):
        self.assert_refused(2, "--contacts given: not supported by planner general",
                            "--object", "egg.xyz", "--repair", "--mu", "0.6", "--start", "random",
                            "--goal", "random", "--planner", "general", "--contacts", "given",
                            "--output", "p.json", "--quiet")


if __name__ == "__main__":
    program_case.main()
