"""The program repair from the shell, and plans on repaired objects."""

import json
import os

import program_case
from program_case import ProgramCase

# A box of 6 × 4 × 4 cm without its bottom.
OPEN_BOX = """v 0 0 0
v 0.06 0 0
v 0.06 0.04 0
v 0 0.04 0
v 0 0 0.04
v 0.06 0 0.04
v 0.06 0.04 0.04
v 0 0.04 0.04
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
"""


class Repair(ProgramCase):
    program = "repair"

    def setUp(self):
        super().setUp()
        self.write("open.obj", OPEN_BOX)

    def repair(self, *more):
        return self.assert_done("--object", "open.obj", "--output", "solid.obj", *more)

    def test_a_hole_is_filled_and_the_report_says_so(self):
        done = self.repair("--report", "repair.json")
        self.assertIn("fill-holes", done.stderr)
        # 3/16 of it, rounded.
        self.assertRegex(done.stderr, r"18\.[78] % of the surface filled in")
        report = json.loads(self.read("repair.json"))
        self.assertEqual(report["stages"][-1]["outcome"], "solid")
        self.assertAlmostEqual(report["volume"], 0.06 * 0.04 * 0.04)
        self.assertIn(b"g invented", self.read("solid.obj"))

    def test_the_same_input_gives_the_same_bytes_and_nothing_is_overwritten(self):
        self.repair()
        first = self.read("solid.obj")
        self.repair()
        self.assertEqual(self.read("solid.obj"), first)
        self.assert_refused(2, "open.obj", "--object", "open.obj", "--output", "open.obj")

    def test_a_sheet_is_refused_with_what_would_help(self):
        self.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        self.assert_refused(2, "--repair wall", "--object", "sheet.obj", "--output", "s.obj")
        self.assert_done("--object", "sheet.obj", "--output", "s.obj", "--repair", "wall=0.05")

    def test_a_refusal_writes_its_report_and_no_solid(self):
        self.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        done = self.run_program("--object", "sheet.obj", "--output", "s.obj", "--report",
                                "sheet.json")
        self.assertEqual(done.returncode, 2)
        report = json.loads(self.read("sheet.json"))
        self.assertEqual(report["verdict"], "refused")
        self.assertIn("wall=", report["reason"])
        self.assertEqual(done.stderr, f"repair: error: {report['reason']}\n")
        self.assertEqual(report["stages"][0]["stage"], "read")
        self.assertIn("not closed", report["stages"][0]["outcome"])
        self.assertFalse(os.path.exists(self.path("s.obj")))

    def plan(self, *more, output="plan.json"):
        seed = [] if "--seed" in more else ["--seed", "3"]
        return self.assert_done("--object", "open.obj", "--mu", "0.6", "--start", "random",
                                "--goal", "random", *seed, "--output", output, *more,
                                program="plan")

    def test_a_plan_on_a_repaired_object_is_validated_on_it(self):
        done = self.plan("--repair")
        self.assertIn("fill-holes", done.stderr)
        plan = json.loads(self.read("plan.json"))
        self.assertEqual(set(plan["object"]["repair"]), {"sha256", "max_deviation"})
        for grasp in (plan["initial"], plan["goal"]):
            for contact in grasp["contacts"]:
                self.assertGreater(contact["point"][2], 0, "a finger on the invented bottom")
        validate = ["--plan", "plan.json", "--frames", "none", "--output", "result"]
        self.assert_done("--object", "open.obj", *validate, program="validate")
        self.assert_done("--object", "open.obj", "--repair", *validate, program="validate")
        # The plan also passes on the solid itself.
        self.repair()
        self.assert_done("--object", "solid.obj", *validate, program="validate")

    def contacts_below(self):
        """Return the number of contacts of plan.json on the filled bottom of the box."""
        plan = json.loads(self.read("plan.json"))
        grasps = [plan["initial"], plan["goal"]]
        return sum(contact["point"][2] < 1e-9 for grasp in grasps for contact in grasp["contacts"])

    def test_fingers_stand_on_invented_surface_only_where_that_is_allowed(self):
        strict, allowed, warned = 0, 0, 0
        for seed in ("1", "2", "3", "4"):
            self.plan("--repair", "--seed", seed)
            strict += self.contacts_below()
            done = self.plan("--repair", "--seed", seed, "--allow", "filled")
            allowed += self.contacts_below()
            warned += self.contacts_below() > 0 and "filled" in done.stderr
        self.assertEqual(strict, 0)
        self.assertGreater(allowed, 0)
        self.assertGreater(warned, 0)

    def test_a_plan_says_which_patches_its_grasps_hold_with(self):
        self.plan("--repair")
        size = (0.06**2 + 2 * 0.04**2) ** 0.5
        self.assertAlmostEqual(json.loads(self.read("plan.json"))["patch_radius"], 0.02 * size)
        self.plan("--repair", "--patch", "0.003")
        self.assertEqual(json.loads(self.read("plan.json"))["patch_radius"], 0.003)
        self.plan("--repair", "--patch", "0")
        self.assertNotIn("patch_radius", json.loads(self.read("plan.json")))

    def test_validate_judges_grasps_with_the_normals_of_patches(self):
        self.repair()
        reasons = []
        for seed in ("1", "2", "3", "4", "5", "6"):
            self.plan("--repair", "--patch", "0", "--seed", seed)
            plan = json.loads(self.read("plan.json"))
            # As large as the box: the patch contains all of its faces, with which few grasps pass.
            plan["patch_radius"] = 0.07
            self.write_json("plan.json", plan)
            self.run_program("--object", "open.obj", "--plan", "plan.json", "--frames", "none",
                             "--output", "result", program="validate")
            for step in json.loads(self.read("result/report.json"))["steps"]:
                if step["reason"] is None:
                    continue
                reasons.append(step["reason"])
                self.assertIn("mean normals within 7 cm", step["detail"])
        self.assertIn("not-force-closure", reasons)

    def test_a_plan_for_another_repair_is_refused(self):
        self.plan("--repair")
        plan = json.loads(self.read("plan.json"))
        plan["object"]["repair"]["sha256"] = "0" * 64
        self.write_json("plan.json", plan)
        self.assert_refused(2, "/object/repair/sha256", "--object", "open.obj", "--plan",
                            "plan.json", "--output", "result", program="validate")

    def test_a_plan_that_was_made_without_repair_is_not_validated_with_it(self):
        self.write_json("cube_plan.json", self.plan_of_cube())
        self.assert_refused(2, "a plan for an unrepaired object", "--object",
                            self.model("cube.obj"), "--plan", "cube_plan.json", "--repair",
                            "--output", "result", program="validate")

    def test_a_refusal_says_what_a_repair_would_make_of_it(self):
        words = ["1 border", "--repair produces a solid", "fill-holes", "deviation 0 %"]
        self.assert_refused(2, words, "--object", "open.obj", "--mu", "0.6", "--start", "random",
                            "--goal", "random", "--output", "p.json", program="plan")

    def test_a_refusal_says_what_else_would_help_where_no_repair_does(self):
        self.write("sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n")
        words = ["--repair does not produce a solid", "open sheet", "--repair wall=T"]
        self.assert_refused(2, words, "--object", "sheet.obj", "--mu", "0.6", "--start", "random",
                            "--goal", "random", "--output", "p.json", program="plan")


if __name__ == "__main__":
    program_case.main()
