"""Plans for hands, and their validation with the hand."""

import json
import os
import pickle
import shutil
import signal
import subprocess
import threading
import unittest

import numpy as np

import regrasp
from regrasp import formats
from regrasp_case import PROGRAMS, RegraspCase


class HandsTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.cube = regrasp.Object.read("models/cube.obj")
        cls.hand = regrasp.Hand.read("models/hands/ring4.json")
        cls.points_plan = regrasp.plan(cls.cube, "models/cube.start.json", "models/cube.goal.json",
                                       mu=0.4)

    def test_a_plan_for_a_hand_and_its_validation_are_those_of_the_programs(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30))
        command = [f"{PROGRAMS}/plan", "--object", "models/cube.obj", "--hand",
                   "models/hands/ring4.json", "--mu", "0.8", "--turn", "z,30", "--quiet",
                   "--output", self.path("plan.json")]
        subprocess.run(command, check=True)
        with open(self.path("plan.json"), encoding="utf-8") as file:
            self.assertEqual(plan.text, file.read())
        for replay in ("points", "hand"):
            subprocess.run([f"{PROGRAMS}/validate", "--object", "models/cube.obj", "--plan",
                            self.path("plan.json"), "--hand", "models/hands/ring4.json", "--replay",
                            replay, "--size", "320x240", "--output", self.path(replay), "--quiet"],
                           check=False, capture_output=True)
            with open(self.path(f"{replay}/report.json"), encoding="utf-8") as file:
                told = json.load(file)
            told.pop("run")
            report = regrasp.validate(self.cube, plan, hand=self.hand, replay=replay)
            for step in told["steps"]:
                step["frame"] = None
            self.assertEqual(report.data, told)
            with open(self.path(f"{replay}/000_hold.png"), "rb") as file:
                self.assertEqual(regrasp._regrasp.encode_png(report.frames((320, 240))[0]),
                                 file.read())
        # The model's own fingertips are these spheres.
        own = regrasp.validate(self.cube, plan, hand=self.hand, tip="geometry")
        self.assertEqual(own.data["settings"]["hand"]["tip"], "geometry")
        self.assertEqual(own.passed, report.passed)
        # A plan cannot be used with another hand.
        other = regrasp.Hand.read("models/hands/ring5.json")
        with self.assertRaises(regrasp.InputError):
            regrasp.validate(self.cube, plan, hand=other)

    def test_a_hand_regrasps_from_where_it_holds(self):
        first = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30))
        pose = first.data["hand"]["initial"]["pose"]
        start_pose = [*pose["position"], *pose["quaternion"]]
        again = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, start_pose=start_pose,
                                     turn=("z", 10), robustness="none")
        np.testing.assert_allclose(again.data["hand"]["initial"]["pose"]["position"],
                                   start_pose[:3], atol=1e-12)
        with self.assertRaisesRegex(regrasp.InputError, "goal pose: .* out of reach of every"):
            regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, start_pose=start_pose,
                                 goal_pose=[5, 0, 0, 1, 0, 0, 0], robustness="none")

    def test_a_plan_starts_and_ends_at_hand_grasps(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30))
        plan.write(self.path("plan.json"))
        grasps = formats.of_plan(self.path("plan.json"), self.hand)
        formats.write_hand_grasps(self.path("set.jsonl"), [("", grasps)], object_file="cube.obj")
        with open(self.path("set.jsonl"), encoding="utf-8") as file:
            lines = [json.loads(line) for line in file]
        first, last = lines[0], lines[-1]
        between = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, start=first, goal=last, robustness="none")
        self.assertEqual([step["kind"] for step in between.data["steps"]], ["move"])
        np.testing.assert_allclose(between.data["hand"]["initial"]["joints"], plan.data["hand"]["initial"]["joints"],
                                   atol=1e-6)
        np.testing.assert_allclose(between.data["hand"]["goal"]["position"], plan.data["hand"]["goal"]["position"],
                                   atol=1e-9)
        shifted = {**first, "palm": {**first["palm"], "position": [0.5, 0, 0]}}
        for arguments, words in (({"start": shifted, "goal": last}, "start: expected at least 3 fingertips"),
                                 ({"start": first, "goal": {**last, "id": ""}}, "goal: /id"),
                                 ({"start": first, "start_pose": [0, 0, 0.1, 1, 0, 0, 0], "turn": ("z", 9)}, "start_pose"),
                                 ({"goal": last, "turn": ("z", 9)}, "goal: a hand grasp states the pose")):
            with self.assertRaisesRegex(regrasp.InputError, words):
                regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, **arguments)

    def test_goals_are_marked_in_the_plan_and_in_the_report(self):
        goals = [{"name": name, "facing": {"axis": axis, "direction": "up", "tolerance_deg": 30}}
                 for name, axis in (("a", [1, 0, 1]), ("b", [-1, 0, 1]))]
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, goals=goals)
        marks = plan.data["hand"]["goals"]
        self.assertEqual([mark["name"] for mark in marks], ["a", "b"])
        self.assertEqual(marks[-1]["step"], len(plan.steps))
        report = regrasp.validate(self.cube, plan, hand=self.hand)
        self.assertTrue(report.passed, report)
        self.assertEqual([row["verdict"] for row in report.data["goals"]], ["pass", "pass"])

    def test_the_second_engine_replays_the_hand(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 20))
        report = regrasp.validate(self.cube, plan, hand=self.hand, engine="ode")
        self.assertTrue(report.passed, report)
        self.assertEqual(report.data["settings"]["engine"], "ode")

    def test_fingertips_roll_if_required(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 45), rolling=True)
        moves = [step for step in plan.steps if step["kind"] == "move"]
        self.assertTrue(moves)
        for move in moves:
            self.assertEqual(len(move["contacts"]), len(move["path"]))
        self.assertTrue(regrasp.validate(self.cube, plan, hand=self.hand).passed)
        with self.assertRaisesRegex(regrasp.InputError, "help: pass --hand ring4.json"):
            regrasp.validate(self.cube, plan)
        with self.assertRaisesRegex(regrasp.InputError, "rolling cannot be used with closure"):
            regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 45), rolling=True, closure="gravity")

    def test_any_number_of_searches_at_a_time_finds_the_same_plan(self):
        told = []
        plans = [regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 120), jobs=jobs,
                                      progress=told.append).text for jobs in (1, 3)]
        self.assertEqual(plans[0], plans[1])
        self.assertTrue(told)

    def test_ctrl_c_ends_several_searches(self):
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        told = []

        def begin(text):
            if not told:
                timer.start()
            told.append(text)
        with self.assertRaises(KeyboardInterrupt):
            regrasp.plan_in_hand(self.cube, self.hand, mu=0.25, turn=("z", 3600), jobs=3,
                                 progress=begin)
            timer.join()
        self.assertTrue(told)

    def test_what_the_progress_function_raises_ends_several_searches(self):
        def stop(text):
            raise KeyError(text)
        with self.assertRaises(KeyError):
            regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 120), jobs=3,
                                 progress=stop)

    def test_what_the_motors_do_not_carry_out_is_no_plan_and_says_what_fails(self):
        with self.assertRaises(regrasp.NoPlan) as caught:
            regrasp.plan_in_hand(self.cube, self.hand, mu=0.3, turn=("z", 90))
        self.assertIn("(slipped): finger", str(caught.exception))

    def test_gravity_of_the_plan(self):
        """The programs find and write the same plan."""
        for given, option in (([0, 0, 2.0], "0,0,2"), ("any", "any")):
            plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30), gravity=given)
            subprocess.run([f"{PROGRAMS}/plan", "--object", "models/cube.obj", "--hand", "models/hands/ring4.json",
                            "--mu", "0.8", "--turn", "z,30", f"--gravity={option}", "--quiet", "--output",
                            self.path("plan.json")], check=True)
            with open(self.path("plan.json"), encoding="utf-8") as file:
                self.assertEqual(plan.text, file.read())
            self.assertEqual(plan.data["hand"].get("up"), None if given == "any" else [0, 0, -1])
            self.assertTrue(regrasp.validate(self.cube, plan, hand=self.hand).passed)

    def test_mass_of_the_plan(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30), mass=0.06)
        self.assertEqual(plan.data["hand"]["mass_kg"], 0.06)
        masses = [regrasp.validate(self.cube, plan, hand=self.hand, mass=mass).data["settings"]["mass_kg"]
                  for mass in (None, 0.07)]
        self.assertEqual(masses, [0.06, 0.07])

    def test_closure_of_the_plan(self):
        plan = regrasp.plan_in_hand(self.cube, self.hand, mu=0.8, turn=("z", 30), closure="gravity")
        support = plan.data["hand"]["gravity_support"]
        self.assertEqual(support, {"disturbance": 0.1, "force": 9.0})
        self.assertTrue(regrasp.validate(self.cube, plan, hand=self.hand).passed)

    def test_a_pickle_of_a_hand(self):
        again = pickle.loads(pickle.dumps(self.hand))
        self.assertEqual((again.name, again.joint_names), (self.hand.name, self.hand.joint_names))
        for name in ("ring4.json", "ring4.xml"):
            shutil.copy(os.path.join("models/hands", name), self.path(name))
        kept = pickle.dumps(regrasp.Hand.read(self.path("ring4.json")))
        with open(self.path("ring4.xml"), "a", encoding="utf-8") as file:
            file.write("<!-- changed -->")
        self.refuses(["ring4.json", "differs from the pickled hand"], lambda: pickle.loads(kept))

    def test_arguments_about_hands_that_are_wrong_are_named(self):
        gear = regrasp.Object.read("models/gear128.wkt")

        def plan(*words, object=self.cube, hand=self.hand, **named):
            self.refuses(words, lambda: regrasp.plan_in_hand(object, hand, mu=0.8, **named))
        plan("turn", "goal_pose, goals or goal")
        plan("/goals", "must not be empty", goals=[])
        plan("goals", "cannot read none.json", goals="none.json")
        plan("goals", "list of dictionaries", goals=3)
        plan("goals", "cannot be used with turn", goals=[], turn=("z", 9))
        plan("hand", "str", "Hand.read", hand="ring4.json", turn=("z", 90))
        plan("gear128.wkt", "polygon", object=gear, turn=("z", 90))
        plan("mass", "above 0", turn=("z", 9), mass=0)
        plan("turn", "axis and degrees", turn="z90 now")
        plan("turn[0]", "'w'", turn=("w", 90))
        plan("turn[1]", "must not be 0", turn=("z", 0))
        plan("turn[1]", "3600", turn=("z", 1e9))
        plan("goal_pose", "7 numbers", goal_pose=[0, 0, 0])
        plan("start_pose", "unit quaternion", start_pose=[0, 0, 0, 2, 0, 0, 0], turn=("z", 9))
        plan("turn", "cannot be used with goal_pose", goal_pose=[0, 0, 0.1, 1, 0, 0, 0], turn=("z", 9))
        plan("start", "file random not found", start="random", turn=("z", 9))
        plan("start", "3 to 4 contacts", "found 2", turn=("z", 9),
             start=[[.03, 0, 0], [-.03, 0, 0]])
        plan("robustness", "'preferred'", robustness="prefered", turn=("z", 9))
        plan("gravity", "zero", gravity=[0, 0, 0], turn=("z", 9))
        plan("gravity", "'any'", gravity="up", turn=("z", 9))
        plan("closure", "'gravity'", closure="form", turn=("z", 9))
        plan("optimize", "'margin'", optimize="travel", turn=("z", 9))
        plan("clearance", "0.05", clearance=1, turn=("z", 9))
        plan("jobs", "from 1 to 1024", jobs=0, turn=("z", 9))
        self.refuses(["hand", "not a plan for a hand"], lambda: regrasp.validate(
            self.cube, self.points_plan, hand=self.hand))
        self.refuses(["hand", "required"], lambda: regrasp.validate(
            self.cube, self.points_plan, replay="hand"))
        self.refuses(["tip", "'box'", "geometry"], lambda: regrasp.validate(
            self.cube, self.points_plan, tip="box"))
        self.refuses(["tip", 'replay="hand"'], lambda: regrasp.validate(
            self.cube, self.points_plan, tip="ball"))


if __name__ == "__main__":
    unittest.main()
