"""Plans for a hand: what plan --hand finds, validate --hand passes, and what is broken it fails."""

import copy
import json
import os

import program_case
from program_case import ARGUMENTS, ProgramCase


class Gait(ProgramCase):
    program = "plan"
    made = None

    def hand(self, name):
        return self.model(os.path.join("hands", name + ".json"))

    def arguments(self, *more, output="plan.json"):
        return ("--object", self.model("cube.obj"), "--scale", "0.8", "--mu", "0.8", "--hand",
                self.hand("ring4"), "--output", output, *more)

    def plan_in_hand(self):
        """With moves and switches; planned once."""
        if Gait.made is None:
            self.assert_done(*self.arguments("--turn", "z 200", "--seed", "1"))
            Gait.made = json.loads(self.read("plan.json"))
            kinds = {step["kind"] for step in Gait.made["steps"]}
            self.assertEqual(kinds, {"move", "switch"})
        return copy.deepcopy(Gait.made)

    def validate(self, plan, *more):
        self.write_json("plan.json", plan)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--out",
                                "result", *more, program="validate")
        return done, self.report()

    def test_a_plan_passes_with_its_hand_and_without(self):
        plan = self.plan_in_hand()
        for more in (("--hand", self.hand("ring4")), ("--no-frames",)):
            done, report = self.validate(plan, *more)
            self.assertEqual((done.returncode, report["verdict"]), (0, "pass"), done.stderr)
        self.assertIn("--hand ring4.json checks its joints", done.stderr)
        self.assertEqual([step["kind"] for step in report["steps"]][1:],
                         [step["kind"] for step in plan["steps"]])

    def test_the_same_arguments_give_the_same_bytes(self):
        texts = []
        for name in ("a.json", "b.json"):
            self.assert_done(*self.arguments("--turn", "z -120", "--seed", "5", output=name))
            texts.append(self.read(name))
        self.assertEqual(texts[0], texts[1])

    def test_what_the_hand_cannot_do_fails_where_it_is(self):
        plan = self.plan_in_hand()
        held = plan["initial"]["contacts"][0]["finger"]
        move = next(i for i, step in enumerate(plan["steps"]) if step["kind"] == "move")
        plan["hand"]["initial"]["joints"][held][1] += 0.01
        off = copy.deepcopy(plan)
        plan = self.plan_in_hand()
        plan["steps"][move]["path"][0]["pose"]["position"][0] += 1e-4
        jump = copy.deepcopy(plan)
        plan = self.plan_in_hand()
        plan["hand"]["goal"]["position"][2] += 0.001
        goal = plan
        for broken, step, reason, words in (
                (off, 0, "tip-off-contact", "from where it touches its contact"),
                (jump, move + 1, "hand-jumps", "object begins the step 100"),
                (goal, len(goal["steps"]), "goal-not-reached", "1 mm")):
            done, report = self.validate(broken, "--hand", self.hand("ring4"), "--no-frames")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(report["steps"][step]["reason"], reason)
            self.assertIn(words, report["steps"][step]["detail"])
            done, report = self.validate(broken, "--hand", self.hand("ring4"))
            self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--hand",
                             self.hand("ring4"), "--out", reason, program="validate")
            frame = json.loads(self.read(reason + "/report.json"))["steps"][step]["frame"]
            self.assertGreater(len(self.read(os.path.join(reason, frame))), 10000)
            # Without the hand nothing is wrong.
            done, report = self.validate(broken, "--no-frames")
            self.assertEqual(report["verdict"], "pass", done.stderr)

    def test_more_clearance_than_there_is_fails(self):
        done, report = self.validate(self.plan_in_hand(), "--hand", self.hand("ring4"),
                                     "--clearance", "0.02", "--no-frames")
        self.assertEqual(done.returncode, 1)
        self.assertIn("hand-collides", [step["reason"] for step in report["steps"]])

    def test_bad_usage_is_one_line(self):
        for words, more in (
                ("--turn says what the hand is to do", ()),
                ('expected an axis and degrees, as in "z 90", found "90"', ("--turn", "90")),
                ('found "w 90"', ("--turn", "w 90")),
                ("at most 3600", ("--turn", "z 1e9")),
                ("other than 0", ("--turn", "z 0")),
                ("grasps are chosen by the program", ("--turn", "z 90", "--start", "random")),
                ("plans for fingers without a hand", ("--turn", "z 90", "--planner", "general")),
                ("--effort: no option of plans for a hand", ("--turn", "z 90", "--effort", "9"))):
            self.assert_refused(2, words, *self.arguments(*more))
        self.assert_refused(2, "--start is required", "--object", self.model("cube.obj"), "--mu",
                            "0.5", "--output", "plan.json")
        self.assert_refused(2, "no planar objects", "--object", self.model("square.wkt"), "--mu",
                            "0.5", "--output", "plan.json", "--hand", self.hand("ring4"), "--turn",
                            "z 90")

    def test_hands_that_are_none_are_one_line(self):
        with open(self.hand("ring4"), encoding="utf-8") as file:
            hand = json.load(file)
        model = os.path.join(ARGUMENTS.source, "models", "hands", "ring4.xml")
        hand["model"] = os.path.relpath(model, os.path.realpath(self.folder))

        def changed(change):
            bad = copy.deepcopy(hand)
            change(bad)
            return self.write_json("hand.json", bad)

        def set_tip(value):
            return lambda bad: bad["fingers"][0]["tip"].update(body=value)

        for words, change in (
                ("no body", set_tip("nobody")),
                ("not below the palm", lambda bad: bad.update(palm="finger0_base")),
                ("/fingers", lambda bad: bad.update(fingers=[])),
                ("nowhere.xml", lambda bad: bad.update(model="nowhere.xml"))):
            changed(change)
            self.assert_refused(2, words, "--object", self.model("cube.obj"), "--mu", "0.8",
                                "--hand", "hand.json", "--turn", "z 90", "--output", "plan.json")

    def test_a_model_is_told_how_it_becomes_a_hand(self):
        model = self.hand("ring4").replace(".json", ".xml")
        self.assert_refused(2, f"hand --model {model} --output", "--object",
                            self.model("cube.obj"), "--mu", "0.8", "--hand", model, "--turn",
                            "z 90", "--output", "plan.json")

    def test_a_folder_with_an_earlier_run_is_written_again(self):
        plan = self.plan_in_hand()
        for more in ((), ("--hand", self.hand("ring4")), ("--no-frames",), ()):
            done, _ = self.validate(plan, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            names = [name for name in os.listdir(self.path("result")) if "_move" in name]
            self.assertEqual(bool(names), more != ("--no-frames",))

    def test_another_hand_is_refused(self):
        self.write_json("plan.json", self.plan_in_hand())
        self.assert_refused(2, "the plan was made for a hand with digest", "--object",
                            self.model("cube.obj"), "--plan", "plan.json", "--hand",
                            self.hand("ring5"), program="validate")

    def test_no_gait_says_what_stopped_it(self):
        done = self.run_program("--object", self.model("cube.obj"), "--scale", "20", "--mu", "0.8",
                                "--hand", self.hand("ring4"), "--turn", "z 90", "--output",
                                "plan.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("0 of 90 degrees", done.stderr)
        self.assertFalse(os.path.exists(self.path("plan.json")))


if __name__ == "__main__":
    program_case.main()
