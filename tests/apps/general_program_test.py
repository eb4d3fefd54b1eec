"""The planner general from the shell: plans on objects of every kind, and their replay."""

import json
import math
import re

import program_case
from program_case import ProgramCase

BODIES = ("cube.obj", "prism.obj", "l_block.obj", "hole_block.obj", "duck500.obj",
          "polygon20.wkt", "polygon_hole.wkt")

# Grasps with all fingers of a hand, none of which can be lifted at 10 degrees.
NEEDS_ALL = {
    "square.wkt": ((0.03, 0.0278), (0.0116, 0.03), (-0.03, 0.004), (-0.0118, -0.03)),
    "cube.obj": ((-0.02963, -0.03, -0.01778),
                 (-0.03, 0.007751, 0.020926),
                 (0.00272, -0.010241, 0.03),
                 (0.03, 0.009617, -0.00386),
                 (0.016154, -0.027091, -0.03)),
}


def turns(step):
    """Return the number of rotations of normals between two waypoints of a sliding step."""
    count = 0
    for before, after in zip(step["waypoints"], step["waypoints"][1:]):
        normals = {held["finger"]: held["normal"] for held in after["contacts"]}
        count += sum(math.dist(held["normal"], normals[held["finger"]]) > 1e-3
                     for held in before["contacts"])
    return count


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
                    "--frames", "none", "--output", self.path("out"), program="validate")
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

    def validate(self, body, align):
        """Replay the plan and return the report."""
        replay = self.run_program(
            "--object", self.model(body), "--plan", self.path("plan.json"), "--replay", "align=" + align,
            "--frames", "none", "--output", self.path("out"), program="validate")
        self.assertEqual(replay.returncode, 0, f"{body} {align}\n{replay.stdout}")
        with open(self.path("out/report.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_aligns_across_edges_pass_the_replay_in_space_and_in_the_plane(self):
        for body, degrees, seeds in (("cube.obj", "25", range(1, 5)),
                                     ("prism.obj", "25", range(1, 5)),
                                     ("square.wkt", "10", range(1, 13))):
            across = 0
            for seed in seeds:
                plan, _ = self.plan(body, seed, degrees=degrees)
                if not any(turns(step) for step in plan["steps"] if step["kind"] == "align"):
                    continue
                across += 1
                for align in ("imitate", "slide"):
                    for step in self.validate(body, align)["steps"]:
                        if step["kind"] == "align":
                            self.assertEqual(step["certificate"], "holds")
            self.assertGreater(across, 0, body)

    def test_hands_that_need_all_their_fingers_walk_round_an_edge(self):
        for body, points in NEEDS_ALL.items():
            start = self.write_json("start.json", {
                "format": "regrasp-grasp", "version": 1,
                "contacts": [{"point": point} for point in points]})
            for seed in range(40):
                self.assert_done("--object", self.model(body), "--planner", "general",
                                 "--friction-angle", "10", "--start", start, "--goal", "random",
                                 "--seed", str(seed), "--output", self.path("plan.json"))
                with open(self.path("plan.json"), encoding="utf-8") as file:
                    first = json.load(file)["steps"][0]
                self.assertEqual(first["kind"], "align", "no finger can be lifted")
                self.assertEqual(len(first["waypoints"][0]["contacts"]), len(points))
                if turns(first) > 0:
                    break
            self.assertGreater(turns(first), 0, body)
            self.validate(body, "imitate")

    def test_the_summary_says_what_was_gained(self):
        _, done = self.plan("cube.obj", 3, "--optimize", "travel", degrees="25")
        before, after = self.gain(done, r"first sequence has a total finger travel of "
                                        r"(\S+) diameters, the improved one .* of (\S+) diameters")
        self.assertLessEqual(after, before)
        _, done = self.plan("cube.obj", 3, "--optimize", "margin", degrees="25")
        before, after = self.gain(done, r"has a friction margin of (\S+)°, the improved one a .* of (\S+)°")
        self.assertGreaterEqual(after, before)
        needed, given = self.gain(done, r"friction angle of (\S+) of (\S+) degrees")
        self.assertAlmostEqual(given - needed, after, delta=0.011)  # difference of two rounded numbers
        _, done = self.plan("cube.obj", 3, "--optimize", "steps", degrees="25")
        self.assertNotIn("the first sequence", done.stderr)
        margin, _ = self.plan("cube.obj", 3, "--optimize", "margin", degrees="25")
        steps, _ = self.plan("cube.obj", 3, "--optimize", "steps", degrees="25")
        self.assertLessEqual(len(steps["steps"]), len(margin["steps"]))

    def test_says_what_was_reached_where_nothing_is_found(self):
        # Two grasps of five contacts that require sliding steps, with almost no search budget.
        for seed in range(40):
            done = self.run_program(*self.arguments("pyramid.obj", seed, "--planner", "budget=1",
                                                    "--min-quality", "0", degrees="5"))
            if done.returncode == 1:
                break
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn(" from the start and ", done.stderr)

    def test_refuses_options_of_other_planners(self):
        for words, arguments in (
                ("--explain", self.arguments("cube.obj", 0, "--explain", planner="roadmap")),
                ("--planner clusters", self.arguments("cube.obj", 0, "--planner", "clusters=20")),
                ("--optimize regions", self.arguments("cube.obj", 0, "--optimize", "regions")),
                ("--planner budget", self.arguments("cube.obj", 0, "--planner", "budget=0")),
                ("--time-limit", self.arguments("cube.obj", 0, "--time-limit", "-1"))):
            self.assert_refused(2, words, *arguments)

    def test_the_time_limit_holds_for_every_planner_and_while_the_object_is_read(self):
        for planner, model in (("auto", "cube.obj"), ("auto", "square.wkt"),
                               ("general", "cube.obj"), ("roadmap", "cube.obj"),
                               ("polyhedron", "cube.obj"), ("polygon", "square.wkt"),
                               ("contour", "square.wkt")):
            self.assert_refused(1, [model, "time limit reached while reading"],
                                *self.arguments(model, 0, "--time-limit", "1e-9", planner=planner))
            done = self.run_program(*self.arguments(model, 0, "--time-limit", "1e300",
                                                    planner=planner))
            self.assertIn(done.returncode, (0, 1), done.stderr)
            self.assertNotIn("time limit reached", done.stderr)

    def test_has_no_graph(self):
        done = self.run_program("--object", self.model("cube.obj"), "--friction-angle", "25",
                                "--planner", "general", program="graph")
        self.assertEqual(done.returncode, 2)
        self.assertIn("planner general: graph not supported", done.stderr)


if __name__ == "__main__":
    program_case.main()
