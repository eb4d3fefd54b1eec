"""Every model is as its generator writes it and plans from its start to its goal grasp, and the
plan validates, replay included."""

import json
import os
import subprocess
import sys

import program_case
from program_case import ProgramCase

FRICTION_ANGLE = "20"
SEEDS_OF_RANDOM_PLANS = ("1", "2")
SMALLEST_REQUIRED = 0.1  # degrees


class Models(ProgramCase):
    program = "plan"

    def names(self):
        ending = ".start.json"
        names = sorted(name[:-len(ending)] for name in os.listdir(self.model(""))
                       if name.endswith(ending))
        solids = [name for name in names if os.path.exists(self.model(name + ".obj"))]
        self.assertGreaterEqual(len(solids), 7, solids)
        self.assertGreaterEqual(len(names) - len(solids), 9, names)
        return names

    def body(self, name):
        solid = self.model(name + ".obj")
        return solid if os.path.exists(solid) else self.model(name + ".wkt")

    def plan(self, name, start, goal, *more):
        self.assert_done("--object", self.body(name), "--start", start, "--goal", goal,
                         "--friction-angle", FRICTION_ANGLE, "--output", "plan.json", *more)
        return json.loads(self.read("plan.json"))

    def validate(self, name, *more):
        """Exit code and report; frames are left to the tests of the pictures."""
        done = self.run_program("--object", self.body(name), "--plan", "plan.json",
                                "--out", "out", "--no-frames", *more, program="validate")
        return done, json.loads(self.read("out/report.json"))

    def test_models_are_as_the_generator_writes_them(self):
        subprocess.run([sys.executable,
                        os.path.join(program_case.ARGUMENTS.source, "scripts", "make-models"),
                        "--out", self.folder], check=True)
        written = sorted(os.listdir(self.folder))
        self.assertGreaterEqual(len(written), 14, written)
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

    def test_random_grasps_plan_and_validate(self):
        for name in self.names():
            for seed in SEEDS_OF_RANDOM_PLANS:
                with self.subTest(model=name, seed=seed):
                    planner = "roadmap" if self.body(name).endswith(".obj") else "polygon"
                    self.plan(name, "random", "random", "--planner", planner, "--seed", seed)
                    done, _ = self.validate(name)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

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
                    continue  # opposed contacts: there is no smaller friction
                done, report = self.validate(name, "--friction-angle", str(max(required) - 0.01))
                self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
                failed = [step for step in report["steps"] if step["reason"]]
                self.assertEqual(len(failed), 1)
                # An earlier step that has hardly more friction to spare may not stand the shake.
                self.assertLessEqual(failed[0]["index"], weakest)
                if failed[0]["index"] == weakest:
                    self.assertEqual(failed[0]["reason"], "not-force-closure")
                    analytic_failures += 1
        self.assertGreater(analytic_failures, 0)


if __name__ == "__main__":
    program_case.main()
