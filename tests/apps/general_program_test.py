"""The planner general from the shell: plans on bodies of every kind, and their replay."""

import json
import re

import program_case
from program_case import ProgramCase

BODIES = ("cube.obj", "prism.obj", "l_block.obj", "hole_block.obj", "duck500.obj",
          "polygon20.wkt", "polygon_hole.wkt")


class General(ProgramCase):
    program = "plan"

    def arguments(self, body, seed, *more, degrees="10", planner="general"):
        return ["--object", self.model(body), "--planner", planner, "--friction-angle", degrees,
                "--start", "random", "--goal", "random", "--seed", str(seed),
                "--output", self.path("plan.json"), *more]

    def plan(self, *arguments, **options):
        done = self.assert_done(*self.arguments(*arguments, **options))
        with open(self.path("plan.json"), encoding="utf-8") as file:
            return json.load(file), done

    def kinds(self, plan):
        return [step["kind"] for step in plan["steps"]]

    def test_plans_pass_the_replay_and_some_have_aligns(self):
        aligns = 0
        for body in BODIES:
            for seed in (1, 2):
                plan, _ = self.plan(body, seed)
                self.assertEqual(plan["planner"], "general")
                self.assertEqual(plan["fingers"], 4 if body.endswith("wkt") else 5)
                aligns += self.kinds(plan).count("align")
                replay = self.run_program(
                    "--object", self.model(body), "--plan", self.path("plan.json"),
                    "--no-frames", "--out", self.path("out"), program="validate")
                self.assertEqual(replay.returncode, 0, f"{body} {seed}\n{replay.stdout}")
        self.assertGreater(aligns, 0)

    def test_every_align_carries_a_certificate_that_holds(self):
        aligns = 0
        for seed in range(6):
            plan, _ = self.plan("prism.obj", seed, "--min-quality", "0")
            for step in plan["steps"]:
                if step["kind"] == "align":
                    aligns += 1
                    self.assertIn("certificate", step)
        self.assertGreater(aligns, 0)

    def gain(self, done, pattern):
        self.assertRegex(done.stderr, pattern)
        return [float(number) for number in re.search(pattern, done.stderr).groups()]

    def test_the_summary_says_what_was_gained(self):
        for aim in ("steps", "margin", "travel"):
            _, done = self.plan("cube.obj", 3, "--optimize", aim, degrees="25")
            before, after = self.gain(done, r"steps: (\S+) at first, (\S+) now")
            self.assertLessEqual(after, before)
            before, after = self.gain(done, r"grasp: (\S+)° at first, (\S+)° now")
            if aim != "travel":
                self.assertGreaterEqual(after, before)
            before, after = self.gain(done, r"together: (\S+) at first, (\S+) now")
            if aim == "travel":
                self.assertLessEqual(after, before)
        margin, _ = self.plan("cube.obj", 3, "--optimize", "margin", degrees="25")
        steps, _ = self.plan("cube.obj", 3, "--optimize", "steps", degrees="25")
        self.assertLessEqual(len(steps["steps"]), len(margin["steps"]))

    def test_says_what_was_reached_where_nothing_is_found(self):
        # Two grasps of five contacts that need aligns, and next to no effort.
        for seed in range(40):
            done = self.run_program(*self.arguments("pyramid.obj", seed, "--effort", "1",
                                                    "--min-quality", "0", degrees="5"))
            if done.returncode == 1:
                break
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("were reached from the start", done.stderr)

    def test_refuses_options_of_other_planners(self):
        for words, arguments in (
                ("--explain", self.arguments("cube.obj", 0, "--explain", planner="roadmap")),
                ("--time-limit", self.arguments("cube.obj", 0, "--time-limit", "1",
                                                planner="polyhedron")),
                ("--clusters", self.arguments("cube.obj", 0, "--clusters", "20")),
                ("--optimize regions", self.arguments("cube.obj", 0, "--optimize", "regions")),
                ("--effort", self.arguments("cube.obj", 0, "--effort", "0")),
                ("--time-limit", self.arguments("cube.obj", 0, "--time-limit", "-1"))):
            self.assert_refused(2, words, *arguments)

    def test_has_no_graph(self):
        done = self.run_program("--object", self.model("cube.obj"), "--friction-angle", "25",
                                "--planner", "general", program="graph")
        self.assertEqual(done.returncode, 2)
        self.assertIn("--planner general", done.stderr)


if __name__ == "__main__":
    program_case.main()
