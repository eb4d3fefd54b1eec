"""Every model equals its generator's output and has a plan from its start to its goal grasp.

The plan passes the validation, including the replay.
"""

import json
import math
import os
import re
import subprocess
import sys

import program_case
from program_case import ProgramCase

FRICTION_ANGLE = "20"
SEEDS_OF_RANDOM_PLANS = ("1", "2")
SMALLEST_REQUIRED = 0.1  # degrees
MANY_EDGES = 100  # above this, random grasps are two-finger grasps of the whole boundary
SHORTEST_EDGE = 0.004  # over the diameter
REGIONS = ("--optimize", "regions")
MANY_FACES = ("body14", "body24", "body34", "body36", "body38", "body40", "body42", "body47",
              "body67")
# Models with many focus cells; there are fewer with little friction and uniform spanning.
CONCURRENT = ("--planner", "polyhedron,spanning=uniform")
FRICTION_OF_MANY_FACES = "10"


class Models(ProgramCase):
    program = "plan"

    def names(self):
        ending = ".start.json"
        names = sorted(name[:-len(ending)] for name in os.listdir(self.model(""))
                       if name.endswith(ending)
                       and name[:-len(ending)] not in MANY_FACES)
        solids = [name for name in names if os.path.exists(self.model(name + ".obj"))]
        self.assertGreaterEqual(len(solids), 7, solids)
        self.assertGreaterEqual(len(names) - len(solids), 14, names)
        return names

    def body(self, name):
        solid = self.model(name + ".obj")
        return solid if os.path.exists(solid) else self.model(name + ".wkt")

    def rings(self, name):
        """Return the rings of a polygon; empty for a solid."""
        if self.body(name).endswith(".obj"):
            return []
        with open(self.body(name), encoding="utf-8") as wkt:
            rings = re.findall(r"\(([^()]*)\)", wkt.read())
        return [[tuple(map(float, point.split())) for point in ring.split(",")] for ring in rings]

    def names_of_many_edges(self):
        names = [name for name in self.names()
                 if sum(len(ring) - 1 for ring in self.rings(name)) > MANY_EDGES]
        self.assertGreaterEqual(len(names), 5, names)
        return names

    def plan(self, name, start, goal, *more):
        friction = FRICTION_OF_MANY_FACES if name in MANY_FACES else FRICTION_ANGLE
        self.assert_done("--object", self.body(name), "--start", start, "--goal", goal,
                         "--friction-angle", friction, "--output", "plan.json", *more)
        return json.loads(self.read("plan.json"))

    def validate(self, name, *more):
        """Return exit code and report; the image tests check the frames."""
        done = self.run_program("--object", self.body(name), "--plan", "plan.json",
                                "--output", "out", "--frames", "none", *more, program="validate")
        return done, json.loads(self.read("out/report.json"))

    def test_models_are_as_the_generator_writes_them(self):
        subprocess.run([sys.executable,
                        os.path.join(program_case.ARGUMENTS.source, "scripts", "make-models"),
                        "--out", self.folder], check=True)
        written = sorted(os.listdir(self.folder))
        self.assertGreaterEqual(len(written), 19, written)
        for name in written:
            with self.subTest(file=name):
                with open(self.model(name), "rb") as committed:
                    self.assertEqual(self.read(name), committed.read())

    def test_every_model_plans_and_validates(self):
        for name in self.names():
            with self.subTest(model=name):
                plan = self.plan(name, self.model(name + ".start.json"),
                                 self.model(name + ".goal.json"))
                done, report = self.validate(name, "--start", self.model(name + ".start.json"),
                                             "--goal", self.model(name + ".goal.json"))
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(report["verdict"], "pass")
                self.assertEqual(len(report["steps"]), len(plan["steps"]) + 1)

    def test_outlines_have_as_many_edges_as_their_names_say_and_none_that_is_tiny(self):
        for name in self.names_of_many_edges():
            with self.subTest(model=name):
                rings = self.rings(name)
                edges = [edge for ring in rings for edge in zip(ring, ring[1:])]
                self.assertEqual(len(edges), int(re.search(r"\d+$", name).group()))
                diameter = max(math.dist(p, q) for p in rings[0] for q in rings[0])
                self.assertTrue(0.1 < diameter < 0.15, diameter)
                self.assertGreater(min(math.dist(*edge) for edge in edges),
                                   SHORTEST_EDGE * diameter)

    def test_every_outline_of_many_edges_is_planned_with_the_largest_regions(self):
        switches = 0
        for name in self.names_of_many_edges():
            with self.subTest(model=name):
                start, goal = self.model(name + ".start.json"), self.model(name + ".goal.json")
                plan = self.plan(name, start, goal, *REGIONS)
                self.assertEqual(plan["planner"], "contour")
                placed = [contact for step in plan["steps"] for contact in step.get("place", [])]
                self.assertTrue(all(contact["region"] > 0 for contact in placed), placed)
                switches += len(placed)
                done, _ = self.validate(name, "--start", start, "--goal", goal)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreaterEqual(switches, 20)

    def test_random_grasps_plan_and_validate(self):
        many_edges = self.names_of_many_edges()
        for name in self.names():
            planner = ("roadmap" if self.body(name).endswith(".obj") else
                       "contour" if name in many_edges else "polygon")
            for seed in SEEDS_OF_RANDOM_PLANS:
                with self.subTest(model=name, seed=seed):
                    # Models with many edges exercise both methods of choosing the switches.
                    aim = REGIONS if name in many_edges and seed == "2" else ()
                    self.plan(name, "random", "random", "--planner", planner, "--seed", seed, *aim)
                    done, _ = self.validate(name)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_solids_of_many_faces_plan_with_aligns_and_switches_and_validate(self):
        for name in MANY_FACES:
            with self.subTest(model=name):
                start, goal = self.model(name + ".start.json"), self.model(name + ".goal.json")
                plan = self.plan(name, start, goal, *CONCURRENT)
                self.assertEqual({step["kind"] for step in plan["steps"]}, {"align", "switch"})
                done, report = self.validate(name, "--start", start, "--goal", goal)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertEqual(len(report["steps"]), len(plan["steps"]) + 1)
                # The same plan with less friction than its weakest grasp requires.
                weakest = max(step["force_closure"]["required_half_angle_deg"]
                              for step in report["steps"])
                done, report = self.validate(name, "--friction-angle", str(weakest - 0.01))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                self.assertEqual(report["verdict"], "fail")

    def test_random_grasps_of_solids_of_many_faces_plan_and_validate(self):
        aligns = 0
        for name in MANY_FACES:
            for seed in SEEDS_OF_RANDOM_PLANS:
                with self.subTest(model=name, seed=seed):
                    plan = self.plan(name, "random", "random", *CONCURRENT, "--seed", seed)
                    aligns += sum(step["kind"] == "align" for step in plan["steps"])
                    done, _ = self.validate(name)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(aligns, 0)

    def test_every_model_fails_below_the_friction_that_its_plan_requires(self):
        analytic_failures = 0
        for name in self.names():
            with self.subTest(model=name):
                self.plan(name, self.model(name + ".start.json"), self.model(name + ".goal.json"))
                _, report = self.validate(name)
                required = [step["force_closure"]["required_half_angle_deg"]
                            for step in report["steps"]]
                weakest = required.index(max(required))
                if max(required) < SMALLEST_REQUIRED:
                    continue  # opposed contacts have no smaller friction
                done, report = self.validate(name, "--friction-angle", str(max(required) - 0.01))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                failed = [step for step in report["steps"] if step["reason"]]
                self.assertEqual(len(failed), 1)
                # An earlier step with a slightly larger friction margin may fail the disturbance
                # test.
                self.assertLessEqual(failed[0]["index"], weakest)
                if failed[0]["index"] == weakest:
                    self.assertEqual(failed[0]["reason"], "not-force-closure")
                    analytic_failures += 1
        self.assertGreater(analytic_failures, 0)


if __name__ == "__main__":
    program_case.main()
