"""Inputs of plan and validate for hands: files that must not be overwritten, and inputs that are refused."""

import json
import os
import shutil
import xml.etree.ElementTree

import program_case
from program_case import ARGUMENTS, ProgramCase


class HandInputs(ProgramCase):
    program = "plan"

    def setUp(self):
        """Copy the hand ring4 to the folder of the test."""
        super().setUp()
        for name in ("ring4.json", "ring4.xml"):
            shutil.copy(os.path.join(ARGUMENTS.source, "models", "hands", name), self.path(name))

    def plan(self, *more, output="plan.json"):
        return ("--object", self.model("cube.obj"), "--scale", "0.8", "--mu", "0.8", "--hand", self.path("ring4.json"),
                "--output", output, "--quiet", *more)

    def turn(self, degrees, *more, output="plan.json"):
        return self.plan("--turn", f"z,{degrees}", *more, output=output)

    def cases_of(self, junit):
        """Return the test cases of a JUnit file by name."""
        root = xml.etree.ElementTree.fromstring(self.read(junit))
        return {case.get("name"): case for case in root.iter("testcase")}

    def replay(self, plan, *more):
        return ("--object", self.model("cube.obj"), "--plan", plan, "--hand", self.path("ring4.json"), "--frames",
                "none", *more)

    def test_no_output_replaces_an_input(self):
        arguments = self.turn(10)
        self.assert_done(*arguments)
        model = self.read("ring4.xml")
        self.assert_refused(2, "ring4.xml: --output must not overwrite the file of --hand",
                            *self.turn(10, output=self.path("ring4.xml")))
        self.assert_refused(2, "ring4.xml: --junit must not overwrite the file of --hand",
                            *self.replay("plan.json", "--junit", "ring4.xml"), program="validate")
        self.assertEqual(self.read("ring4.xml"), model)
        self.write_json("conditions.json", [{"name": "a", "mass_factor": 1.01}])
        conditions = self.read("conditions.json")
        self.assert_refused(2, "conditions.json: --json must not overwrite the file of --conditions",
                            *self.replay("plan.json", "--conditions", "conditions.json", "--json", "conditions.json"),
                            program="validate")
        self.assertEqual(self.read("conditions.json"), conditions)

    def test_a_hand_that_cannot_be_simulated_is_refused(self):
        """An actuator in one direction only. Without simulation the plan is written."""
        model = self.read("ring4.xml").decode()
        named = '<position name="finger1_motor1"'
        self.assertIn(named, model)
        self.write("ring4.xml", model.replace(named, named + ' forcelimited="true" forcerange="0 1"'))
        self.assert_refused(2, "range of actuator finger1_motor1", *self.turn(10))
        self.assertFalse(os.path.exists(self.path("plan.json")))
        self.assert_done(*self.turn(10, "--robustness", "none"))

    def test_a_mass_too_small_to_simulate_is_refused(self):
        self.assert_refused(2, "the object's mass of 0.001 µg is too small to simulate",
                            *self.turn(10, "--mass", "1e-12"))
        self.assert_done(*self.turn(10))
        self.assert_refused(2, "is too small to simulate", *self.replay("plan.json", "--density", "1e-30"),
                            program="validate")

    def test_only_a_plan_that_the_hand_executes_is_continued(self):
        self.assert_done(*self.turn(20))
        plan = json.loads(self.read("plan.json"))

        def end():
            return plan["steps"][-1]["path"][-1]

        def turn_joint():
            end()["joints"][0][0] += 0.01

        for words, change in (("(tip-off-contact)", turn_joint),
                              ("a state has 3 fingers, expected 4", lambda: end()["joints"].pop())):
            change()
            self.write_json("edited.json", plan)
            self.assert_refused(2, ["edited.json: step 1 fails the hand check", words],
                                *self.turn(10, "--continue", "edited.json", output="more.json"))

    def test_a_plan_file_that_its_schema_refuses_is_refused_in_one_line(self):
        goal = {"step": 1, "facing": {"axis": [0, 0, 1], "direction": [0, 0, 1], "tolerance_deg": 180}}
        self.assert_done(*self.turn(10))
        plan = json.loads(self.read("plan.json"))
        hand = plan["hand"]

        def check(words, **changes):
            self.write_json("edited.json", {**plan, **changes})
            self.assert_refused(2, ["edited.json: " + words], *self.replay("edited.json"), program="validate")

        check("/hand/goals: must not be empty", hand={**hand, "goals": []})
        named = {**goal, "facing": {**goal["facing"], "axis": "z"}}
        check('/hand/goals/0/facing/axis: expected 3 numbers, found "z"', hand={**hand, "goals": [named]})
        twice = [{**goal, "name": "a"}, {**goal, "name": "a"}]
        check('/hand/goals/1/name: must be unique, found "a" again', hand={**hand, "goals": twice})
        check("/hand/initial/joints: expected 5 lists of joint angles, one per finger, found 4", fingers=5)

    def test_an_object_in_the_palm_is_refused(self):
        inside, above = "0,0,0.01,1,0,0,0", "0,0,0.1,1,0,0,0"
        for option, poses in (("start pose", ("--turn", "z,10", "--start-pose", inside)),
                              ("goal pose", ("--start-pose", above, "--goal-pose", inside))):
            self.assert_refused(2, f"{option}: the object collides with the palm", *self.plan(*poses))
        goal = {"name": "low", "pose": {"position": [0, 0, 0.01], "quaternion": [1, 0, 0, 0]}}
        self.write_json("goals.json", {"format": "regrasp-goals", "version": 1, "goals": [goal]})
        self.assert_refused(2, "goal 1 (low): goal pose: the object collides with the palm",
                            *self.plan("--goals", "goals.json"))

    def test_names_have_no_control_characters(self):
        facing = {"axis": "x", "direction": "up", "tolerance_deg": 30}
        goals = [{"name": "a\u001b[31m", "facing": facing}]
        self.write_json("goals.json", {"format": "regrasp-goals", "version": 1, "goals": goals})
        self.assert_refused(2, "/goals/0/name: expected a name without control characters",
                            *self.plan("--goals", "goals.json"))

    def test_a_leading_minus_sign_requires_an_equals_sign(self):
        for option, value in (("--gravity", "-z"), ("--turn", "-z,30"), ("--goal-facing", "-y,up,30")):
            self.assert_refused(2, f"{option}: a value with a leading minus sign requires {option}={value}",
                                *self.plan(option, value))

    def test_a_rated_plan_requires_time(self):
        command = [word for word in self.turn(30, "--optimize", "margin", "--time-limit", "3") if word != "--quiet"]
        done = self.assert_done(*command)
        unrated = "time limit reached before a plan was simulated under the standard conditions" in done.stderr
        self.assertNotEqual(unrated, "the plan passes" in done.stderr, done.stderr)

    def test_conditions_without_a_required_share_are_skipped_cases(self):
        self.assert_done(*self.turn(20))
        conditions = [{"name": "heavy", "mass_factor": 10}, {"name": "same", "mass_factor": 1}]
        self.write_json("conditions.json", conditions)
        self.run_program(*self.replay("plan.json", "--conditions", "conditions.json", "--junit", "junit.xml"),
                         program="validate")
        cases = self.cases_of("junit.xml")
        skipped = cases["condition heavy"].find("skipped")
        self.assertIsNotNone(skipped)
        self.assertIn(skipped.get("message"), ("slipped", "displaced", "contact-lost", "torque-limit"))
        self.assertEqual(len(cases["condition same"]), 0)
        os.mkdir(self.path("plans"))
        shutil.copy(self.path("plan.json"), self.path("plans/plan.json"))
        self.run_program(*self.replay("plans", "--conditions", "conditions.json", "--junit", "all.xml"),
                         program="validate")
        cases = self.cases_of("all.xml")
        skipped = cases["conditions"].find("skipped")
        self.assertIsNotNone(skipped)
        self.assertEqual(skipped.get("message"), "1 of 2 conditions pass, none is required")


if __name__ == "__main__":
    program_case.main()
