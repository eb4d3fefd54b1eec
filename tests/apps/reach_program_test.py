"""Plans for fingers with a radius pass the check with this radius; other plans do not always pass.
"""

import json

import program_case
from program_case import ProgramCase

FRICTION = ("--friction-angle", "15")
# Model, planner, radii in metres, seeds.
CASES = [
    ("cube.obj", "auto", ("0.004", "0.01"), ("1", "2")),
    ("body34.obj", "polyhedron", ("0.004", "0.01"), ("1", "2")),
    ("l_block.obj", "auto", ("0.004", "0.01"), ("1", "2")),
    ("hole_block.obj", "auto", ("0.004", "0.01"), ("1", "2")),
    ("u_channel.obj", "auto", ("0.004",), ("1", "2")),
    ("mug500.obj", "auto", ("0.004", "0.008"), ("1",)),
    ("flask500.obj", "auto", ("0.004",), ("1",)),
    ("polygon_hole.wkt", "auto", ("0.002", "0.004"), ("1", "2")),
    ("polygon15.wkt", "polygon", ("0.002",), ("1", "2")),
    ("gear128.wkt", "contour", ("0.001",), ("1", "2")),
]


class Reach(ProgramCase):
    program = "plan"

    def plan(self, model, planner, seed, *more):
        return self.run_program("--object", self.model(model), *FRICTION, "--planner", planner,
                                "--start", "random", "--goal", "random", "--seed", seed,
                                "--output", "plan.json", "--quiet", *more)

    def validate(self, model, *more):
        done = self.run_program("--object", self.model(model), "--plan", "plan.json", "--output",
                                "out", "--frames", "none", *more, program="validate")
        return done, json.loads(self.read("out/report.json"))

    def reasons(self, report):
        return [step["reason"] for step in report["steps"] if step["reason"]]

    def test_plans_for_a_radius_pass_with_it(self):
        made = passed = 0
        for model, planner, radii, seeds in CASES:
            found = 0
            for radius in radii:
                for seed in seeds:
                    with self.subTest(model=model, planner=planner, radius=radius, seed=seed):
                        done = self.plan(model, planner, seed, "--finger-radius", radius)
                        if done.returncode == 1:
                            # The result may be that there is no sequence, in one line.
                            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                            continue
                        self.assertEqual(done.returncode, 0, done.stderr)
                        plan = json.loads(self.read("plan.json"))
                        self.assertEqual(plan["finger_radius"], float(radius))
                        done, report = self.validate(model)
                        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                        self.assertEqual(report["settings"]["finger_radius"], float(radius))
                        self.assertAlmostEqual(report["settings"]["fingertip_radius_m"],
                                               float(radius), delta=1e-6)
                        found += 1
            self.assertGreater(found, 0, model)
            made += found
            passed += 1
        self.assertEqual(passed, len(CASES))
        self.assertGreaterEqual(made, 18)

    def test_plans_for_points_are_unreachable_for_thick_fingers(self):
        unreachable = 0
        for model in ("hole_block.obj", "u_channel.obj", "polygon_hole.wkt"):
            for seed in ("1", "2"):
                with self.subTest(model=model, seed=seed):
                    done = self.plan(model, "auto", seed)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertNotIn("finger_radius", json.loads(self.read("plan.json")))
                    done, report = self.validate(model, "--finger-radius", "0.004")
                    if done.returncode == 0:
                        continue
                    self.assertEqual(self.reasons(report), ["unreachable"], done.stdout)
                    self.assertIn("finger", done.stdout)
                    unreachable += 1
        self.assertGreater(unreachable, 2)

    def test_a_grasp_alone_is_checked_with_the_radius(self):
        arguments = ("--object", self.model("hole_block.obj"), "--grasp",
                     self.model("hole_block.start.json"), "--friction-angle", "20", "--output", "out",
                     "--frames", "none")
        self.assert_done(*arguments, program="validate")
        done = self.run_program(*arguments, "--finger-radius", "0.002", program="validate")
        self.assertEqual(done.returncode, 1, done.stderr)
        # Finger 1 presses outwards from inside the hole, 5 cm wide.
        self.assertIn("finger 1", done.stdout)
        self.assertIn("0.046 of free path", done.stdout)

    def test_a_given_grasp_that_fingers_cannot_hold_is_bad_input(self):
        self.assert_refused(
            2, ["hole_block.start.json: /contacts", "finger 1", "blocks its path"],
            "--object", self.model("hole_block.obj"), *FRICTION, "--start",
            self.model("hole_block.start.json"), "--goal", self.model("hole_block.goal.json"),
            "--finger-radius", "0.002", "--output", "plan.json")

    def test_a_named_planner_says_that_it_finds_nothing(self):
        # Fingers as thick as the object obstruct each other.
        for model, planner, random, words in (
                ("polygon15.wkt", "polygon", "random-any",
                 ["planner polygon: no sequence for fingers of radius 0.08", "overlap"]),
                ("flask500.obj", "roadmap", "random", ["planner roadmap finds no path over"])):
            with self.subTest(model=model, planner=planner):
                self.assert_refused(1, words, "--object", self.model(model), *FRICTION, "--planner",
                                    planner, "--start", random, "--goal", random, "--seed", "0",
                                    "--output", "plan.json", "--finger-radius", "0.08")

    def write_hollow_cube(self):
        """Write [-3, 3]^3 with the sealed cavity [-1, 1]^3, in centimetres, and grasps of it."""
        corners = [(x, y, z) for z in (-1, 1) for y in (-1, 1) for x in (-1, 1)]
        facets = [(1, 3, 4, 2), (5, 6, 8, 7), (1, 2, 6, 5), (2, 4, 8, 6), (4, 3, 7, 8), (3, 1, 5, 7)]
        lines = [f"v {s * x} {s * y} {s * z}" for s in (0.03, 0.01) for x, y, z in corners]
        lines += ["f " + " ".join(map(str, facet)) for facet in facets]
        lines += ["f " + " ".join(str(corner + 8) for corner in reversed(facet))
                  for facet in facets]
        self.write("hollow.obj", "\n".join(lines) + "\n")
        for name, distance, sign in (("outside", 0.03, -1), ("inside", 0.01, 1)):
            directions = [(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0)]
            self.write_json(name + ".json", {
                "format": "regrasp-grasp", "version": 1,
                "contacts": [{"point": [distance * x for x in d], "normal": [sign * x for x in d]}
                             for d in directions]})

    def test_nothing_grasps_a_body_from_its_sealed_cavity(self):
        self.write_hollow_cube()
        hollow = ("--object", "hollow.obj", *FRICTION)
        for name, code in (("outside", 0), ("inside", 1)):
            done = self.run_program(*hollow, "--grasp", name + ".json", "--output", name,
                                    "--frames", "none", program="validate")
            self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        entry = json.loads(self.read("inside/report.json"))["steps"][0]
        self.assertEqual(entry["reason"], "unreachable")
        self.assertIn("finger 0: its contact is in a sealed cavity", entry["detail"])
        for planner in ("auto", "general", "polyhedron", "roadmap"):
            with self.subTest(planner=planner):
                self.assert_refused(
                    2, ["inside.json: /contacts", "sealed cavity"], *hollow, "--planner", planner,
                    "--start", "outside.json", "--goal", "inside.json", "--output", "plan.json")

    def test_plans_stay_outside_a_sealed_cavity(self):
        self.write_hollow_cube()
        for planner in ("general", "roadmap"):
            with self.subTest(planner=planner):
                self.assert_done("--object", "hollow.obj", *FRICTION, "--planner", planner,
                                 "--start", "random-any", "--goal", "random", "--seed", "3",
                                 "--output", "plan.json", "--quiet")
                plan = json.loads(self.read("plan.json"))
                grasps = [plan["initial"]["contacts"], plan["goal"]["contacts"]]
                for step in plan["steps"]:
                    grasps.append(step.get("place", []))
                    grasps += [w["contacts"] for w in step.get("waypoints", [])]
                for contact in sum(grasps, []):
                    self.assertAlmostEqual(max(map(abs, contact["point"])), 0.03, delta=1e-9)
                self.assert_done("--object", "hollow.obj", "--plan", "plan.json", "--output", "out",
                                 "--frames", "none", "--quiet", program="validate")

    def test_bad_radii_are_refused(self):
        cube = ("--object", self.model("cube.obj"), *FRICTION, "--start",
                self.model("cube.start.json"), "--goal", self.model("cube.goal.json"),
                "--output", "plan.json")
        for radius in ("0", "-1", "nan", "1e999", "wide"):
            with self.subTest(radius=radius):
                self.assert_refused(2, "--finger-radius", *cube, "--finger-radius", radius)
        self.assert_refused(2, ["--finger-radius: must be at most the object's diameter of 0.10"],
                            *cube, "--finger-radius", "4")


if __name__ == "__main__":
    program_case.main()
