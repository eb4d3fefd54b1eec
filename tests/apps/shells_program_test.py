"""Files of several closed shells: --shells of plan, validate, graph and repair."""

import json

import program_case
from program_case import ProgramCase


def box(x, size, first):
    """Return a cube as OBJ, with a corner at (x, 0, 0); `first` is the number of its first vertex.
    """
    text = "".join(f"v {x + size * (i & 1)} {size * (i >> 1 & 1)} {size * (i >> 2 & 1)}\n"
                   for i in range(8))
    for facet in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7),
                  (2, 0, 4, 6)):
        text += "f " + " ".join(str(first + corner) for corner in facet) + "\n"
    return text


class ShellsTest(ProgramCase):
    program = "plan"

    def setUp(self):
        super().setUp()
        self.write("beside.obj", box(0, 0.03, 1) + box(0.05, 0.02, 9))
        self.write("overlap.obj", box(0, 0.03, 1) + box(0.02, 0.02, 9))

    def asked(self, name, *more, seed="4"):
        return ["--object", name, "--mu", "0.8", "--start", "random", "--goal", "random",
                "--seed", seed, "--output", "plan.json", *more]

    def validated(self, name, *more):
        return self.run_program("--object", name, "--plan", "plan.json", "--frames", "none", "--output",
                                "result", *more, program="validate")

    def contacts(self):
        plan = json.loads(self.read("plan.json"))
        return [contact["point"] for grasp in (plan["initial"], plan["goal"])
                for contact in grasp["contacts"]]

    def test_without_a_choice_the_refusal_says_which_there_are(self):
        words = ["2 closed shells", "77.1 %, 22.9 %", "--shells union", "--shells largest"]
        self.assert_refused(2, words, *self.asked("beside.obj"))

    def test_two_solids_beside_each_other_are_held_as_one_body(self):
        held_by_both = 0
        for seed in ("1", "2", "3", "4", "5", "6"):
            done = self.assert_done(*self.asked("beside.obj", "--shells", "union", seed=seed))
            self.assertIn("2 closed shells form one body", done.stderr)
            self.assertEqual(json.loads(self.read("plan.json"))["object"]["shells"], "union")
            sides = {x > 0.04 for x, _, _ in self.contacts()}
            held_by_both += len(sides) == 2
            done = self.validated("beside.obj")
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        self.assertGreater(held_by_both, 0, "no plan has fingers on both")
        done = self.validated("beside.obj", "--shells", "union")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_plan_is_held_to_the_body_that_it_is_for(self):
        self.assert_done(*self.asked("beside.obj", "--shells", "union"))
        plan = json.loads(self.read("plan.json"))
        self.assert_refused(2, "/object/shells", "--object", "beside.obj", "--plan", "plan.json",
                            "--shells", "largest", "--output", "result", program="validate")
        del plan["object"]["shells"]
        self.write_json("plan.json", plan)
        self.assert_refused(2, "several solids", "--object", "beside.obj", "--plan", "plan.json",
                            "--output", "result", program="validate")
        plan["object"]["shells"] = "some"
        self.write_json("plan.json", plan)
        self.assert_refused(2, "/object/shells", "--object", "beside.obj", "--plan", "plan.json",
                            "--output", "result", program="validate")

    def test_fingers_on_a_shell_that_is_left_out_are_off_the_surface(self):
        """Uses the plan for the union, some of whose fingers are on the smaller solid."""
        for seed in ("1", "2", "3", "4", "5", "6"):
            self.assert_done(*self.asked("beside.obj", "--shells", "union", seed=seed))
            if any(x > 0.04 for x, _, _ in self.contacts()):
                break
        plan = json.loads(self.read("plan.json"))
        plan["object"]["shells"] = "largest"
        self.write_json("plan.json", plan)
        done = self.validated("beside.obj")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("off-surface", {step["reason"] for step in self.report()["steps"]})

    def test_the_largest_is_the_object_and_the_others_are_left_out(self):
        for name, left_out in (("beside.obj", "1 with 22.9 %"), ("overlap.obj", "1 with 22.9 %")):
            done = self.assert_done(*self.asked(name, "--shells", "largest"))
            self.assertIn(left_out, done.stderr)
            self.assertTrue(all(x <= 0.03 + 1e-9 for x, _, _ in self.contacts()))
            done = self.validated(name)
            self.assertEqual(done.returncode, 0, done.stderr + done.stdout)

    def test_shells_that_meet_are_united_by_a_repair(self):
        self.assert_refused(2, "--repair", *self.asked("overlap.obj", "--shells", "union"))
        self.assert_done(*self.asked("overlap.obj", "--shells", "union", "--repair"))
        self.assertEqual(self.validated("overlap.obj").returncode, 0)

    def test_a_repair_keeps_solids_beside_each_other_where_that_is_asked(self):
        open_box = "\n".join(box(0.05, 0.02, 9).splitlines()[:-1]) + "\n"
        self.write("open.obj", box(0, 0.03, 1) + open_box)
        repair = ["--object", "open.obj", "--output", "solid.obj"]
        self.assert_refused(2, ["--repair part", "--shells union"], *repair, program="repair")
        self.assert_done(*repair, "--shells", "union", program="repair")
        self.assert_done(*self.asked("solid.obj", "--shells", "union"))
        self.assert_done(*self.asked("open.obj", "--shells", "union", "--repair"))
        # Repaired again from the file, and read from the output of the repair.
        for name in ("open.obj", "solid.obj"):
            done = self.validated(name)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_done(*repair, "--shells", "largest", "--report", "r.json", program="repair")
        self.assertAlmostEqual(json.loads(self.read("r.json"))["volume"], 0.03**3)

    def test_graph_and_a_single_grasp_take_the_choice(self):
        self.assert_done("--object", "beside.obj", "--shells", "union", "--mu", "0.8", "--planner",
                         "roadmap,points=20", program="graph")
        self.assert_done(*self.asked("beside.obj", "--shells", "union"))
        plan = json.loads(self.read("plan.json"))
        places = [{key: contact[key] for key in ("point", "normal")}
                  for contact in plan["goal"]["contacts"]]
        grasp = {"format": "regrasp-grasp", "version": 1, "contacts": places}
        self.write_json("grasp.json", grasp)
        self.assert_done("--object", "beside.obj", "--shells", "union", "--mu", "0.8", "--grasp",
                         "grasp.json", "--frames", "none", "--output", "grasp", program="validate")

    def test_a_polygon_has_no_shells(self):
        self.write("square.wkt", "POLYGON((0 0, 1 0, 1 1, 0 1))\n")
        self.assert_refused(2, "--shells", *self.asked("square.wkt", "--shells", "union"))

    def test_a_choice_that_is_none_is_refused(self):
        self.assert_refused(2, "union", *self.asked("beside.obj", "--shells", "all"))


if __name__ == "__main__":
    program_case.main()
