"""Plans whose fingertips roll: plan --rolling on, and validate."""

import copy
import json
import os

import jsonschema

from program_case import ARGUMENTS, ProgramCase, main

BODY = ("--scale", "0.8", "--mu", "0.8")


def distance(a, b):
    """Return the distance of two points."""
    return sum((x - y) ** 2 for x, y in zip(a, b)) ** 0.5


class Rolling(ProgramCase):
    program = "plan"
    made = None

    def setUp(self):
        super().setUp()
        self.ring = self.model("hands/ring4.json")

    def arguments(self, *more, output="plan.json"):
        return ("--object", self.model("cube.obj"), *BODY, "--hand", self.ring, "--output", output, *more)

    def rolling_plan(self):
        """Return a plan with rolling and finger switches; planned once."""
        if Rolling.made is None:
            self.assert_done(*self.arguments("--turn", "z,200", "--rolling", "on"))
            Rolling.made = json.loads(self.read("plan.json"))
        return copy.deepcopy(Rolling.made)

    def validate(self, plan, *more):
        self.write_json("plan.json", plan)
        return self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--output", "result",
                                "--frames", "none", *more, program="validate")

    def test_a_plan_follows_the_schema_and_its_contacts_move(self):
        plan = self.rolling_plan()
        with open(os.path.join(ARGUMENTS.source, "docs", "plan.schema.json"), encoding="utf-8") as file:
            jsonschema.validate(plan, json.load(file))
        kinds = {step["kind"] for step in plan["steps"]}
        self.assertEqual(kinds, {"move", "switch"})
        farthest = 0
        for step in plan["steps"]:
            if step["kind"] != "move":
                continue
            self.assertEqual(len(step["contacts"]), len(step["path"]))
            for first, last in zip(step["contacts"][0], step["contacts"][-1]):
                farthest = max(farthest, plan["object"]["scale"] * distance(first["point"], last["point"]))
        self.assertGreater(farthest, 1e-3)

    def test_a_plan_that_ends_on_an_edge_is_not_continued(self):
        """A contact with a normal between those of two faces of the cube is refused."""
        arguments = ("--object", self.model("cube.obj"), "--mu", "0.8", "--hand", self.ring)
        for seed in range(3, 12):
            self.assert_done(*arguments, "--turn", "x,60", "--rolling", "on", "--seed", str(seed), "--output", "edge.json")
            contacts = json.loads(self.read("edge.json"))["steps"][-1]["contacts"][-1]
            if any(max(map(abs, contact["normal"])) < 0.99 for contact in contacts):
                break
        else:
            self.fail("no plan ends on an edge")
        self.assert_refused(2, "edge.json: the plan ends with a rolled contact on an edge of the object", *arguments,
                            "--turn", "z,10", "--continue", "edge.json", "--quiet", "--output", "more.json")

    def test_actual_contacts_are_those_of_the_plan(self):
        """MuJoCo rolls the fingertips without using the contacts of the plan."""
        largest = {}
        for rolling in ("on", "off"):
            self.assert_done(*self.arguments("--turn", "z,90", "--rolling", rolling))
            done = self.validate(json.loads(self.read("plan.json")), "--hand", self.ring)
            self.assertEqual(done.returncode, 0, done.stderr)
            largest[rolling] = max(step["simulation"]["hand"]["contact_off_m"] for step in self.report()["steps"])
        self.assertLess(largest["on"], 1e-3)
        self.assertGreater(largest["off"], 3e-3)

    def test_a_plan_passes_with_its_hand_only(self):
        plan = self.rolling_plan()
        done = self.validate(plan, "--hand", self.ring)
        self.assertEqual(done.returncode, 0, done.stderr)
        for more in ((), ("--hand", self.ring, "--replay", "points")):
            done = self.validate(plan, *more)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
            self.assertIn("pass --hand ring4.json", done.stderr)

    def test_a_fingertip_next_to_its_contact_fails(self):
        """Contacts of one state are shifted by 0.1 mm times the scale, in the unit of the file."""
        plan = self.rolling_plan()
        first = next(step for step in plan["steps"] if step["kind"] == "move")
        for contact in first["contacts"][1]:
            contact["point"][2] += 1e-4
        done = self.validate(plan, "--hand", self.ring)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(self.report()["steps"][1]["reason"], ("tip-off-contact", "off-surface"))

    def test_a_plan_can_be_continued(self):
        self.write_json("first.json", self.rolling_plan())
        self.assert_done(*self.arguments("--turn", "z,30", "--rolling", "on", "--continue", "first.json"))
        done = self.validate(json.loads(self.read("plan.json")), "--hand", self.ring)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_options_that_exclude_each_other_are_bad_input(self):
        turn = ("--turn", "z,90", "--rolling", "on")
        self.assert_refused(2, "cannot be used with --closure gravity", *self.arguments(*turn, "--closure", "gravity"))
        self.assert_refused(2, "because contacts roll away",
                            *self.arguments(*turn, "--goal", self.model("cube.goal.json")))
        self.assert_refused(2, "--rolling requires --hand", "--object", self.model("cube.obj"), "--mu", "0.8",
                            "--rolling", "on", "--output", "plan.json")

    def test_contacts_that_do_not_fit_the_path_are_bad_input(self):
        plan = self.rolling_plan()
        next(step for step in plan["steps"] if step["kind"] == "move")["contacts"].pop()
        done = self.validate(plan, "--hand", self.ring)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn("expected one grasp for each of the", done.stderr)


if __name__ == "__main__":
    main()
