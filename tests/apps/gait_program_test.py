"""Plans for a hand: plans of plan --hand pass validate --hand, and broken plans fail it."""

import copy
import csv
import json
import math
import os
import re
import shutil

import xml.etree.ElementTree

import program_case
from npz_file import read_npz
from picture_pixels import count, is_red, png_pixels, webp_durations
from program_case import ARGUMENTS, ProgramCase


SMALL = ("--size", "320x240")


def is_reddish(pixel):
    """Return True for the colour of a link at fault, on white."""
    red, green, blue = pixel
    return red > 120 and green < 0.6 * red and blue < 0.65 * red


class Gait(ProgramCase):
    program = "plan"
    made = None

    def hand(self, name):
        return self.model(os.path.join("hands", name + ".json"))

    def arguments(self, *more, output="plan.json"):
        return ("--object", self.model("cube.obj"), "--scale", "0.8", "--mu", "0.8", "--hand",
                self.hand("ring4"), "--output", output, *more)

    def plan_in_hand(self):
        """Return a plan with in-hand motions and switches, without sliding steps; planned once."""
        seed = 0
        while Gait.made is None:
            seed += 1
            self.assertLess(seed, 20, "no plan of moves and switches")
            self.assert_done(*self.arguments("--turn", "z,200", "--seed", str(seed)))
            plan = json.loads(self.read("plan.json"))
            if {step["kind"] for step in plan["steps"]} == {"move", "switch"}:
                Gait.made = plan
        return copy.deepcopy(Gait.made)

    def validate(self, plan, *more):
        self.write_json("plan.json", plan)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--output",
                                "result", *SMALL, *more, program="validate")
        return done, self.report()

    def test_a_plan_passes_with_its_hand_and_without(self):
        plan = self.plan_in_hand()
        for more in (("--hand", self.hand("ring4")), ("--frames", "none",)):
            done, report = self.validate(plan, *more)
            self.assertEqual((done.returncode, report["verdict"]), (0, "pass"), done.stderr)
        self.assertIn("help: pass --hand ring4.json", done.stderr)
        self.assertEqual([step["kind"] for step in report["steps"]][1:],
                         [step["kind"] for step in plan["steps"]])

    def test_the_hand_itself_carries_a_plan_out(self):
        """Planned with less friction than there is, because the plan neglects that fingertips roll.
        """
        ring5 = self.hand("ring5")
        turn = ("--object", self.model("cube.obj"), "--scale", "0.8333", "--mu", "0.5",
                "--min-quality", "0.06", "--hand", ring5, "--turn", "z,30")
        self.assert_done(*turn, "--output", "plan.json")
        plan = json.loads(self.read("plan.json"))
        by_hand = ("--hand", ring5, "--replay", "hand", "--mu", "0.8")
        done, report = self.validate(plan, *by_hand)
        self.assertEqual((done.returncode, report["verdict"]), (0, "pass"), done.stderr)
        self.assertEqual(report["settings"]["squeeze_source"], "torques")
        self.assertEqual(report["settings"]["hand"]["tolerance_m"], 0.002)
        for step in report["steps"]:
            self.assertLess(step["simulation"]["displacement_m"], 2e-3)
            self.assertLess(step["simulation"]["hand"]["rest_displacement_m"], 1e-3)
            self.assertLess(step["simulation"]["hand"]["torque_share"], 1)
        self.check_trajectory(plan, by_hand)
        self.check_scene(plan, by_hand)
        self.check_trials(plan, by_hand)
        self.check_tips(plan, by_hand)
        # A tolerance of 10 µm is exceeded, the servos yield to a large disturbance, and no hand
        # holds 20 kg.
        for more, reasons in ((("--tolerance", "0.01mm"), ("object-moved",)),
                              (("--disturbance", "0.3"), ("object-moved", "slipped", "contact-lost")),
                              (("--mass", "20"), ("torque-limit", "object-moved", "slipped",
                                                  "contact-lost"))):
            done, report = self.validate(plan, *by_hand, *more)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn([step["reason"] for step in report["steps"] if step["reason"]][0],
                          reasons)
            self.assertIn("limit" if more[0] == "--tolerance" else "verdict", done.stdout)
        # Replay by the hand is the default for a plan with a hand.
        _, by_points = self.validate(plan, "--hand", ring5, "--replay", "points", "--frames", "none")
        self.assertNotIn("hand", by_points["settings"])
        _, usual = self.validate(plan, "--hand", ring5, "--frames", "none")
        self.assertIn("hand", usual["settings"])
        self.check_conditions(plan, by_hand)
        _, both = self.validate(plan, *by_hand, "--engine", "both", "--frames", "none")
        self.assertEqual([(row["engine"], row["verdict"]) for row in both["engines"]],
                         [("MuJoCo", "pass"), ("ODE", "pass")])
        done, slippery = self.validate(plan, "--hand", ring5, "--engine", "ode", "--mu", "0.15", "--frames", "none")
        self.assertEqual((done.returncode, slippery["verdict"]), (1, "fail"))
        points = ("--hand", ring5, "--replay", "points")
        for more, words in ((("--replay", "hand"), "--replay hand: requires --hand"),
                            ((*points, "--replay", "feedback=none"), "--replay feedback: requires --replay hand"),
                            ((*points, "--feedback", "none"), "--feedback: requires --replay hand"),
                            ((*points, "--conditions", "standard"), "--conditions: requires --replay hand"),
                            (("--hand", ring5, "--conditions", "none.json"), "none.json: "),
                            (("--hand", ring5, "--require", "all"),
                             '--require: expected standard or conditions, found "all"'),
                            (("--hand", ring5, "--conditions", "standard,require=2"), "--conditions require: "),
                            (("--hand", ring5, "--require", "standard=2"), "--conditions require: "),
                            (("--hand", ring5, "--conditions", "gone.json", "--require", "conditions=0.5"), "gone.json: "),
                            (("--hand", ring5, "--conditions", "require"),
                             "--conditions require: requires standard or a file of conditions"),
                            (("--hand", ring5, "--feedback", "pose,delay=-1"), "--feedback delay: "),
                            (("--hand", ring5, "--feedback", "late"), "--feedback: "),
                            (("--hand", ring5, "--feedback", "pose,none"), "--feedback: found pose and none"),
                            (("--hand", ring5, "--feedback", "bias-deg=1,none"),
                             "--feedback bias-deg: cannot be used with --feedback none"),
                            (("--hand", ring5, "--feedback", "none,delay=1"),
                             "--feedback delay: cannot be used with --feedback none"),
                            ((*points, "--replay", "tip=geometry"), "--replay tip: requires --replay hand"),
                            (("--hand", ring5, "--replay", "tip=box"), "--replay tip: "),
                            (("--hand", ring5, "--replay"), "--replay"),
                            ((*points, "--trials", "2,joints=1"),
                             "requires --replay hand"),
                            (("--hand", ring5, "--engine", "bullet"), "--engine: "),
                            (("--hand", ring5, "--engine", "ode", "--export-mjcf", "scene"), "--engine"),
                            (("--hand", ring5, "--disturbance", "limits"), "requires --replay points")):
            done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json",
                                    *more, program="validate")
            self.assertEqual(done.returncode, 2)
            self.assertIn(words, done.stderr)

    def goals(self, *goals):
        return {"format": "regrasp-goals", "version": 1, "goals": list(goals)}

    def facing(self, name, axis, direction="up", degrees=30):
        return {"name": name, "facing": {"axis": axis, "direction": direction,
                                         "tolerance_deg": degrees}}

    def quick(self, *more, output="plan.json"):
        return self.arguments("--robustness", "none", *more, output=output)

    def test_a_plan_reaches_its_goal_set(self):
        self.assert_done(*self.quick("--goal-facing", "1,0,1,up,30"))
        plan = json.loads(self.read("plan.json"))
        (goal,) = plan["hand"]["goals"]
        self.assertEqual(goal["step"], len(plan["steps"]))
        self.assertEqual(goal["facing"]["tolerance_deg"], 30)
        by_hand = ("--hand", self.hand("ring4"), "--replay", "points", "--frames", "none")
        done, report = self.validate(plan, *by_hand)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("tolerance", done.stdout)
        (row,) = report["goals"]
        self.assertEqual(row["verdict"], "pass")
        self.assertAlmostEqual(row["tolerance_deg"], 30, delta=1e-9)
        self.assertLessEqual(row["off_deg"], 30)
        # An end outside the set fails.
        goal["facing"]["axis"] = [-1, 0, 0]
        done, report = self.validate(plan, *by_hand)
        self.assertEqual(done.returncode, 1)
        self.assertIn("goal-not-reached", done.stdout)
        self.assertIn("outside its goal set", done.stdout)
        self.assertEqual(report["goals"][0]["verdict"], "fail")
        goal["step"] += 1
        self.write_json("plan.json", plan)
        self.assert_refused(2, "/hand/goals: a goal is marked after step", "--object",
                            self.model("cube.obj"), "--plan", "plan.json", program="validate")

    def test_goals_up_follow_the_direction_of_gravity(self):
        """With little friction no axis turns from down to up, but gravity may act in another direction."""
        self.assert_done(*self.quick("--turn", "z,5"))
        pose = json.loads(self.read("plan.json"))["hand"]["initial"]["pose"]
        w, x, y, z = pose["quaternion"]
        axis = [-2 * (x * z - w * y), -2 * (y * z + w * x), 2 * (x * x + y * y) - 1]
        numbers = ",".join(map(repr, (*pose["position"], *pose["quaternion"])))
        goal = ("--goal-facing=" + ",".join(map(repr, axis)) + ",up,5",)

        def slippery(*more):
            words = list(self.quick(f"--start-pose={numbers}", "--planner", "gait,budget=1", *more))
            words[words.index("--mu") + 1] = "0.15"
            return words
        self.assertEqual(self.run_program(*slippery(*goal)).returncode, 1)
        self.assert_done(*slippery(*goal, "--gravity", "any"))
        hand = json.loads(self.read("plan.json"))["hand"]
        self.assertNotEqual(hand["up"], [0, 0, 1])
        self.assertEqual(hand["goals"][0]["facing"]["direction"], hand["up"])
        self.write_json("goals.json", self.goals(self.facing("a", axis, "up", 5)))
        self.assert_done(*slippery("--goals", "goals.json", "--gravity", "any"))
        self.assertEqual(json.loads(self.read("plan.json"))["hand"]["goals"], [{**hand["goals"][0], "name": "a"}])

    def test_a_list_of_goals_gives_one_plan(self):
        self.write_json("goals.json", self.goals(self.facing("a", [1, 0, 1]),
                                                 self.facing("b", [-1, 0, 1])))
        done = self.assert_done(*self.quick("--goals", "goals.json"))
        self.assertIn("goals: a after step", done.stderr)
        plan = json.loads(self.read("plan.json"))
        self.assertEqual([goal["name"] for goal in plan["hand"]["goals"]], ["a", "b"])
        done, report = self.validate(plan, "--hand", self.hand("ring4"), "--replay", "points",
                                     "--frames", "none")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual([(row["name"], row["verdict"]) for row in report["goals"]],
                         [("a", "pass"), ("b", "pass")])
        page = self.read("result/report.html")
        self.assertIn(b"<h2>Goals</h2>", page)

    def test_a_plan_continues_another_one(self):
        self.assert_done(*self.quick("--turn", "z,30", output="first.json"))
        more = ("--continue", "first.json", "--turn", "z,20")
        self.assert_done(*self.quick(*more, output="second.json"))
        first, second = (json.loads(self.read(name)) for name in ("first.json", "second.json"))
        end = first["steps"][-1]["path"][-1]
        for name, found in second["hand"]["initial"]["pose"].items():
            for value, expected in zip(found, end["pose"][name]):
                self.assertAlmostEqual(value, expected, delta=1e-9)
        for joints, expected in zip(second["hand"]["initial"]["joints"], end["joints"]):
            for value, angle in zip(joints, expected):
                self.assertAlmostEqual(value, angle, delta=1e-9)
        self.assert_refused(2, "the plan is for another hand", "--object", self.model("cube.obj"),
                            "--scale", "0.8", "--mu", "0.8", "--hand", self.hand("ring5"),
                            "--output", "third.json", *more)
        self.assert_refused(2, "must be the scale of the plan", "--object", self.model("cube.obj"),
                            "--scale", "0.7", "--mu", "0.8", "--hand", self.hand("ring4"),
                            "--output", "third.json", *more)
        self.assert_refused(2, "prism.obj", "--object", self.model("prism.obj"),
                            "--scale", "0.8", "--mu", "0.8", "--hand", self.hand("ring4"),
                            "--output", "third.json", *more)
        self.assert_refused(2, "--continue: cannot be used with --start-pose",
                            *self.quick(*more, "--start-pose", "0,0,0.1,1,0,0,0"))

    def test_bad_goals_are_one_line(self):
        facing = self.facing
        cases = {
            "/goals: must not be empty": self.goals(),
            'unknown member "more"': {**self.goals(facing("a", "x")), "more": 1},
            "/goals/1/name: must be unique": self.goals(facing("a", "x"), facing("a", "y")),
            "/goals/0/facing/axis: must not be a zero vector": self.goals(facing("a", [0, 0, 0])),
            "/goals/0/facing/tolerance_deg: must be between": self.goals(facing("a", "x", "up", -1)),
            "/goals/0/facing/direction: expected 3 numbers":
                self.goals(facing("a", "x", "left")),
            "/goals/0: expected either": self.goals({"name": "a"}),
            "/goals/0/pose: member \"quaternion\" not found":
                self.goals({"name": "a", "pose": {"position": [0, 0, 0.1]}}),
        }
        texts = {words: json.dumps(value) for words, value in cases.items()}
        texts["goals.json: "] = json.dumps(self.goals(facing("a", "x"))).replace("30", "NaN")
        texts["goals.json"] = "[" * 10_000_000
        for words, text in texts.items():
            self.write("goals.json", text)
            done = self.run_program(*self.quick("--goals", "goals.json"))
            self.assertEqual(done.returncode, 2, words)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr[:500])
        for more, words in ((("--goal-facing", "x,up"), "--goal-facing: expected an axis"),
                            (("--goal-facing", "0,0,0,up,30"), "zero vector"),
                            (("--goal-facing", "x,up,-1"), "degrees must be between 0.01 and 180"),
                            (("--goal-facing", "x,up,nan"), "--goal-facing: expected an axis"),
                            (("--goal-facing", "x,up,30", "--turn", "z,30"), "cannot be used with --turn"),
                            (("--turn", "z,30", "--goal-tolerance", "5mm,10"), "expected metres and degrees"),
                            (("--turn", "z,30", "--goal-tolerance", "0,10"), "metres must be between"),
                            (("--goal-tolerance", "0.01,10", "--goal-facing", "x,up,30"),
                             "--goal-tolerance: requires --goal-pose or --turn")):
            self.assert_refused(2, words, *self.quick(*more))

    def check_conditions(self, plan, by_hand):
        """Conditions are rows of the report, and decide only if they are required."""
        self.write("conditions.json", json.dumps([{"name": "heavy", "mass_factor": 1.1},
                                                  {"name": "icy", "friction_factor": 0.1}]))
        given = (*by_hand, "--frames", "none", "--conditions", "conditions.json")
        done, report = self.validate(plan, *given, "--junit", "junit.xml")
        self.assertEqual((done.returncode, report["verdict"]), (0, "pass"), done.stderr)
        self.assertIn("verdict: pass under 1 of 2 conditions", done.stdout)
        found = report["conditions"]
        self.assertEqual((found["applicable"], found["passed"], found["required"]), (2, 1, None))
        self.assertEqual([row["verdict"] for row in found["results"]], ["pass", "fail"])
        self.assertEqual(found["results"][1]["changes"], {"friction_factor": 0.1})
        self.assertIn(b'name="condition icy"', self.read("junit.xml"))
        _, other = self.validate(plan, *given, "--jobs", "1")
        self.assertEqual(other["conditions"], found)
        done, report = self.validate(plan, *given, "--conditions", "require")
        self.assertEqual((done.returncode, report["verdict"]), (1, "fail"))
        self.assertIn("conditions-failed: 1 of 2 conditions fail: icy", done.stdout)
        done, _ = self.validate(plan, *given, "--conditions", "require=0.5")
        self.assertEqual(done.returncode, 0, done.stderr)

    def turn(self, hand, degrees):
        return ("--object", self.model("cube.obj"), "--scale", "0.8", "--mu", "0.8", "--hand", hand, "--turn",
                f"z,{degrees}")

    def test_a_plan_under_gravity_in_another_direction(self):
        """A second route: a hand file with that direction gives the same plan."""
        ring5 = self.hand("ring5")
        with open(ring5, encoding="utf-8") as file:
            turned = json.load(file)
        turned["up"] = [0, 0, -1]
        turned["model"] = os.path.join(os.path.dirname(ring5), turned["model"])
        self.write_json("turned.json", turned)
        plans = {}
        for name, hand, more in (("own", ring5, ()), ("same", ring5, ("--gravity=-z",)),
                                 ("other", ring5, ("--gravity", "0,0,2")), ("file", self.path("turned.json"), ())):
            self.assert_done(*self.turn(hand, 45), *more, "--output", name + ".json", program="plan")
            plans[name] = json.loads(self.read(name + ".json"))
        self.assertEqual(plans["same"], plans["own"])
        self.assertEqual(plans["other"]["hand"].pop("up"), [0, 0, -1])
        for key in ("file", "sha256"):
            self.assertNotEqual(plans["other"]["hand"].pop(key), plans["file"]["hand"].pop(key))
        self.assertEqual(plans["other"], plans["file"])
        self.assertNotEqual(plans["other"]["steps"], plans["own"]["steps"])
        offs = {}
        for name, plan in (("other", "other.json"), ("own", "wrong.json")):
            text = json.loads(self.read("other.json"))
            if name == "own":  # negative control: the direction of the hand file
                del text["hand"]["up"]
            self.write_json("wrong.json", text)
            self.run_program("--object", self.model("cube.obj"), "--plan", plan, "--hand", ring5, "--frames", "none",
                             "--output", name, program="validate")
            offs[name] = json.loads(self.read(name + "/report.json"))
        self.assertEqual(offs["other"]["verdict"], "pass")
        moved = [[step["simulation"]["displacement_m"] for step in offs[name]["steps"]] for name in ("other", "own")]
        self.assertNotEqual(*moved)
        text = json.loads(self.read("other.json"))
        for up in ([0, 0, 2], [0, 0], "z", [0, 0, None]):
            text["hand"]["up"] = up
            self.write_json("bad.json", text)
            self.assert_refused(2, ["bad.json", "/hand/up"], "--object", self.model("cube.obj"), "--plan", "bad.json",
                                "--hand", ring5, program="validate")

    def test_the_mass_of_the_object(self):
        """The plan records it, and validate uses it unless another one is given."""
        ring5 = self.hand("ring5")
        self.assert_done(*self.turn(ring5, 45), "--output", "water.json", program="plan")
        self.assertNotIn("mass_kg", json.loads(self.read("water.json"))["hand"])
        self.assert_done(*self.turn(ring5, 45), "--mass", "0.04", "--output", "light.json", program="plan")
        self.assertEqual(json.loads(self.read("light.json"))["hand"]["mass_kg"], 0.04)
        done = self.run_program(*self.turn(ring5, 15), "--continue", "light.json", "--output", "more.json", program="plan")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("40 g", done.stderr)
        self.assertNotIn("density of water", done.stderr)
        self.assertEqual(json.loads(self.read("more.json"))["hand"]["mass_kg"], 0.04)
        for plan, options, mass in (("light.json", (), 0.04), ("light.json", ("--mass", "0.05"), 0.05),
                                    ("light.json", ("--density", "1000"), 0.110592), ("water.json", (), 0.110592),
                                    ("light.json", ("--replay", "points"), 0.04)):
            self.run_program("--object", self.model("cube.obj"), "--plan", plan, "--hand", ring5, "--frames", "none",
                             *options, "--output", "out", program="validate")
            report = json.loads(self.read("out/report.json"))
            self.assertAlmostEqual(report["settings"]["mass_kg"], mass, 5, (plan, options))
        done = self.run_program(*self.turn(ring5, 45), "--mass", "20", "--planner", "gait,budget=20",
                                "--output", "heavy.json", program="plan")
        self.assertEqual(done.returncode, 1)
        self.assertFalse(os.path.exists(self.path("heavy.json")))
        text = json.loads(self.read("light.json"))
        for mass in (0, -1, "1", None):
            text["hand"]["mass_kg"] = mass
            self.write_json("bad.json", text)
            self.assert_refused(2, ["bad.json", "/hand/mass_kg"], "--object", self.model("cube.obj"), "--plan",
                                "bad.json", "--hand", ring5, program="validate")
        self.assert_refused(2, "--mass", *self.turn(ring5, 45), "--mass", "0", "--output", "x.json", program="plan")

    def test_grasps_that_gravity_supports(self):
        """Only a plan that permits them passes; the report counts them."""
        ring4 = self.hand("ring4")
        task = ("--object", self.model("cube.obj"), "--scale", "0.5", "--mu", "0.3", "--hand", ring4, "--turn", "z,20",
                "--min-quality", "0.9", "--robustness", "none")
        self.assert_done(*task, "--closure", "gravity", "--output", "carried.json", program="plan")
        plan = json.loads(self.read("carried.json"))
        self.assertEqual(plan["hand"]["gravity_support"], {"disturbance": 0.1, "force": 9})
        by_hand = ("--object", self.model("cube.obj"), "--hand", ring4, "--frames", "none")
        self.run_program("--plan", "carried.json", *by_hand, "--output", "carried", program="validate")
        report = json.loads(self.read("carried/report.json"))
        supported = [step["force_closure"].get("gravity_supported") for step in report["steps"]
                     if step["force_closure"] is not None]
        self.assertTrue(any(one is not None and one["resistance_weights"] >= 0.1 for one in supported), supported)
        for change in ({"gravity_support": None}, {"up": [0, 0, -1]}):
            worse = json.loads(self.read("carried.json"))
            for key, value in change.items():
                worse["hand"][key] = value
                if value is None:
                    del worse["hand"][key]
            self.write_json("worse.json", worse)
            done = self.run_program("--plan", "worse.json", *by_hand, "--output", "worse", program="validate")
            self.assertEqual(done.returncode, 1, change)
            report = json.loads(self.read("worse/report.json"))
            self.assertEqual(report["steps"][0]["reason"], "not-force-closure", change)
        for key, value in (("disturbance", 0), ("disturbance", 2), ("force", 0.5), ("force", "9")):
            bad = json.loads(self.read("carried.json"))
            bad["hand"]["gravity_support"][key] = value
            self.write_json("bad.json", bad)
            self.assert_refused(2, ["bad.json", "/hand/gravity_support/" + key], "--plan", "bad.json", *by_hand,
                                program="validate")
        del bad["hand"]["up"]
        bad["hand"]["gravity_support"] = {"disturbance": 0.1, "force": 9}
        self.write_json("bad.json", bad)
        self.assert_refused(2, "gravity_support requires up", "--plan", "bad.json", *by_hand, program="validate")

    def test_directions_of_gravity_that_are_refused(self):
        ring5 = self.hand("ring5")
        for more, words in ((("--gravity", "sideways"), '--gravity: expected a direction'),
                            (("--gravity", "0,0,0"), "--gravity: expected a direction"),
                            (("--gravity", "0,0,1,5"), "--gravity: expected a direction"),
                            (("--gravity", "up"), "--gravity: expected a direction")):
            self.assert_refused(2, words, *self.turn(ring5, 45), *more, "--output", "p.json", program="plan")
        self.assert_refused(2, "--continue: cannot be used with --gravity", "--object", self.model("cube.obj"), "--mu",
                            "0.8", "--hand", ring5, "--continue", "p.json", "--gravity", "z", "--goal-facing",
                            "x,up,30", "--output", "q.json", program="plan")

    def check_trajectory(self, plan, by_hand):
        """Both formats have the same content, and begin and end like the plan."""
        for name in ("hand.csv", "hand.npz"):
            done, _ = self.validate(plan, *by_hand, "--frames", "none", "--trajectory", name)
            self.assertEqual(done.returncode, 0, done.stderr)
        with open(self.path("hand.csv"), encoding="utf-8", newline="") as file:
            header, *rows = csv.reader(file)
        arrays = read_npz(self.path("hand.npz"))
        names = arrays["joint_names"] + ["control " + name for name in arrays["control_names"]]
        self.assertEqual(header[1:len(names) + 1], names)
        self.assertEqual(header[0], "time_s")
        self.assertEqual(header[-7:], ["object_" + axis for axis in
                                       ("x_m", "y_m", "z_m", "qw", "qx", "qy", "qz")])
        self.assertGreater(len(rows), 50)
        self.assertEqual(len(arrays["time_s"]), len(rows))
        for i, row in enumerate(rows):
            numbers = [float(field) for field in row]
            self.assertEqual(numbers, [arrays["time_s"][i], *arrays["joints"][i],
                                       *arrays["controls"][i], *arrays["object"][i]])
        steps = [b - a for a, b in zip(arrays["time_s"], arrays["time_s"][1:])]
        self.assertTrue(all(abs(step - 0.01) < 1e-9 for step in steps))
        start, end = plan["hand"]["initial"], plan["steps"][-1]["path"][-1]
        for i, state in ((0, start), (-1, end)):
            for planned, seen in zip(state["pose"]["position"], arrays["object"][i]):
                self.assertAlmostEqual(planned, seen, delta=1e-3)
        # At the start, the fingertips are 2 mm off the object.
        for planned, seen in zip(sum(start["joints"], []), arrays["joints"][0]):
            self.assertAlmostEqual(planned, seen, delta=5e-2)
        # Point fingers have no such file.
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json",
                                "--trajectory", "points.npz", program="validate")
        self.assertEqual(done.returncode, 2)
        self.assertIn("NPZ format requires --replay hand", done.stderr)
        self.assertFalse(os.path.exists(self.path("points.npz")))

    def check_trials(self, plan, by_hand):
        for noise, passed in (("0", 3), ("0.3", 0)):
            done, report = self.validate(plan, *by_hand, "--frames", "none", "--trials", "3",
                                         "--trials", f"position={noise},joints={noise}",
                                         "--trials", "friction=0,mass=0")
            expected = (0, "pass") if passed else (1, "fail")
            self.assertEqual((done.returncode, report["verdict"]), expected, done.stderr)
            self.assertEqual({step["verdict"] for step in report["steps"]}, {"pass"})
            trials = report["trials"]
            self.assertEqual((trials["count"], trials["passed"]), (3, passed))
            self.assertEqual(trials["joint_noise_deg"], float(noise))
            self.assertEqual(sum(trials["reasons"].values()), 3 - passed)
            self.assertIn("noise: initial object pose by " + noise, done.stdout)

    def check_tips(self, plan, by_hand):
        """The model's own fingertips are the spheres of the hand file, and a capsule without
        contact."""
        reports = {}
        for tip in ("ball", "geometry"):
            more = ("--frames", "none", "--replay", "tip=" + tip, "--trials", "2", "--trajectory", tip + ".csv",
                    "--export-mjcf", tip)
            done, report = self.validate(plan, *by_hand, *more)
            self.assertEqual({step["verdict"] for step in report["steps"]}, {"pass"})
            self.assertEqual(done.returncode, 0 if report["trials"]["passed"] == 2 else 1)
            self.assertEqual(report["settings"]["hand"]["tip"], tip)
            self.assertEqual((report["trials"]["count"], report["trials"]["position_noise"]), (2, 0.003))
            reports[tip] = report
            # All contact pairs of the scene refer to its geoms.
            scene = xml.etree.ElementTree.fromstring(self.read(tip + "/scene.xml"))
            geoms = {geom.get("name"): geom for geom in scene.iter("geom")}
            pairs = [geoms[pair.get("geom1")] for pair in scene.findall("contact/pair")]
            self.assertEqual(sorted(geom.get("type", "sphere") for geom in pairs),
                             (["capsule"] * 5 if tip == "geometry" else []) + ["sphere"] * 5)
        for ball, own in zip(reports["ball"]["steps"], reports["geometry"]["steps"]):
            for name in ("displacement_m", "slip_m"):
                self.assertAlmostEqual(ball["simulation"][name], own["simulation"][name],
                                       delta=1e-6)
        _, usual = self.validate(plan, *by_hand, "--frames", "none")
        self.assertEqual(usual["settings"]["hand"]["tip"], "ball")

    def changed_hand(self, *changes):
        """Return ring4 with edited text in its model."""
        with open(self.hand("ring4").replace(".json", ".xml"), encoding="utf-8") as file:
            model = file.read()
        for old, text in changes:
            self.assertIn(old, model)
            model = model.replace(old, text)
        self.write("ring4.xml", model)
        with open(self.hand("ring4"), encoding="utf-8") as file:
            self.write("ring4.json", file.read())

    def test_what_a_verdict_cannot_rely_on_is_warned_of(self):
        cube = ("--object", self.model("cube.obj"), "--hand", "ring4.json")
        turn = ("--scale", "0.8", "--mu", "0.8", "--turn", "z,5", "--robustness", "none", "--output",
                "plan.json")
        for changes, words in (
                ((), None),
                (((' forcerange="-1.0 1.0"', ""),),
                 "warning: ring4.json: force limit of joints finger0_joint0, "),
                ((('<position name="finger2_motor3" joint="finger2_joint3"/>', ""),),
                 "warning: ring4.json: joint finger2_joint3 has no actuator: plans are not "
                 "simulated")):
            self.changed_hand(*changes)
            for program, done in (
                    ("plan", self.assert_done(*cube, *turn)),
                    ("validate", self.assert_done(*cube, "--plan", "plan.json", "--frames", "none",
                                                  "--replay", "points", program="validate"))):
                with self.subTest(program=program, words=words):
                    if words:
                        self.assertIn(words, done.stderr)
                    else:
                        self.assertNotIn("warning", done.stderr)
        done = self.run_program(*cube, "--plan", "plan.json", "--frames", "none", program="validate")
        self.assertEqual(done.returncode, 2)
        self.assertIn("actuator of joint finger2_joint3 not found", done.stderr)

    def test_a_joint_off_its_coupling_fails(self):
        """The model couples joints, but the plan has independent ones."""
        plan = self.plan_in_hand()
        follows = "".join(
            f'<joint joint1="finger{i}_joint3" joint2="finger{i}_joint2" '
            'polycoef="0.2 1.06 0 0 0"/>' for i in range(4))
        self.changed_hand(("<actuator>", f"<equality>{follows}</equality><actuator>"))
        self.assert_refused(2, "ring4.json: /couplings: joints finger0_joint3 and finger0_joint2",
                            "--model", "ring4.json", program="hand")
        self.assert_done("--model", "ring4.xml", "--output", "ring4.json", "--quiet",
                         program="hand")
        self.assert_done("--object", self.model("cube.obj"), "--hand", "ring4.json", "--scale",
                         "0.8", "--mu", "0.8", "--turn", "z,5", "--robustness", "none", "--output",
                         "coupled.json")
        coupled = json.loads(self.read("coupled.json"))
        points = ("--hand", "ring4.json", "--replay", "points", "--frames", "none")
        done, _ = self.validate(coupled, *points)
        self.assertEqual(done.returncode, 0, done.stderr)
        plan["hand"]["sha256"] = coupled["hand"]["sha256"]
        done, report = self.validate(plan, *points)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(report["steps"][0]["reason"], "coupling-violated")
        for words in ("equality constraint of joint finger", "limit 0.0000573°"):
            self.assertIn(words, report["steps"][0]["detail"])

    def test_a_tip_without_collision_geometry_is_one_line(self):
        with open(self.hand("ring5").replace(".json", ".xml"), encoding="utf-8") as file:
            model = xml.etree.ElementTree.fromstring(file.read())
        bare = model.find(".//body[@name='finger3_distal']")
        for geom in bare.findall("geom"):
            geom.set("contype", "0")
            geom.set("conaffinity", "0")
        self.write("ring5.xml", xml.etree.ElementTree.tostring(model).decode())
        with open(self.hand("ring5"), encoding="utf-8") as file:
            self.write("hand.json", file.read())
        cube = ("--object", self.model("cube.obj"), "--hand", "hand.json")
        self.assert_refused(2, "hand.json: /fingers/3/tip: body finger3_distal has no geom that "
                            "collides", *cube, "--scale", "0.8333", "--mu", "0.8", "--turn",
                            "z,20", "--output", "plan.json")
        self.assert_refused(2, "--replay: cannot be used with --export-states", *cube, "--mu", "0.8",
                            "--export-states", "1", "--replay", "tip=geometry", program="validate")

    def check_scene(self, plan, by_hand):
        """The scene has a keyframe for each static grasp, in a new folder, and is the same twice.
        """
        for name in ("new/scene", "again"):
            done, _ = self.validate(plan, *by_hand, "--frames", "none", "--export-mjcf", name)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(os.listdir(self.path("again")), ["scene.xml"])  # no meshes
        text = self.read("again/scene.xml")
        self.assertEqual(text, self.read("new/scene/scene.xml"))
        scene = xml.etree.ElementTree.fromstring(text)
        keys = scene.findall("keyframe/key")
        kinds = ["hold"] + [step["kind"] for step in plan["steps"]]
        self.assertEqual([key.get("name") for key in keys],
                         [f"{i} {kind}" for i, kind in enumerate(kinds)])
        joints = sum(len(finger) for finger in plan["hand"]["initial"]["joints"])
        for key in keys:
            self.assertEqual(len(key.get("qpos").split()), joints + 7)
            self.assertEqual(len(key.get("ctrl").split()), len(scene.find("actuator")))
        tips = [geom for geom in scene.iter("geom")
                if (geom.get("name") or "").startswith("regrasp_tip_")]
        self.assertEqual(len(tips), len(scene.findall("contact/pair")))
        # Elements that later versions of MuJoCo reject are absent.
        self.assertIsNone(scene.find("size"))
        self.assertFalse({name for element in scene.iter("option") for name in element.attrib}
                         - {"timestep", "gravity", "cone", "impratio", "integrator", "tolerance"})
        # A file in place of the folder is kept.
        self.write("taken", "mine")
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json",
                                *by_hand, "--export-mjcf", "taken", program="validate")
        self.assertEqual(done.returncode, 3)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(self.read("taken"), b"mine")

    def test_a_plan_goes_from_given_grasps_and_poses_to_others(self):
        plan = self.plan_in_hand()
        # The goal is the grasp after the plan's first switch.
        _, switch = self.first(plan, "switch")
        left = [contact for contact in plan["initial"]["contacts"]
                if contact["finger"] not in switch["release"]] + switch["place"]

        def pose_of(pose):
            return " ".join(repr(number) for number in pose["position"] + pose["quaternion"])

        def write_grasp(name, contacts):
            return self.write_json(name, {"format": "regrasp-grasp", "version": 1,
                                          "contacts": [{"point": contact["point"],
                                                        "normal": contact["normal"]}
                                                       for contact in contacts]})

        start = write_grasp("start.json", plan["initial"]["contacts"])
        goal = write_grasp("goal.json", left)
        self.assert_done(*self.arguments(
            "--start", start, "--start-pose", pose_of(plan["hand"]["initial"]["pose"]),
            "--goal", goal, "--goal-pose", pose_of(switch["motion"]["place"][0]["pose"]), output="again.json"))
        again = json.loads(self.read("again.json"))
        points = [sorted(contact["point"] for contact in grasp["contacts"])
                  for grasp in (plan["initial"], {"contacts": left}, again["initial"],
                                again["goal"])]
        self.assertEqual(points[:2], points[2:])
        done, report = self.validate(again, "--hand", self.hand("ring4"), "--frames", "none")
        self.assertEqual((done.returncode, report["verdict"]), (0, "pass"), done.stderr)
        self.write_json("two.json", {"format": "regrasp-grasp", "version": 1,
                                     "contacts": json.loads(self.read("goal.json"))["contacts"][:2]})
        self.assert_refused(2, "two.json: /contacts: planner gait requires 3 to 4 contacts, found 2",
                              *self.arguments("--turn", "z,9", "--start", "two.json"))

    def test_the_same_arguments_give_the_same_bytes(self):
        texts = []
        for name, jobs in (("a.json", 1), ("b.json", 1), ("c.json", 3)):
            self.assert_done(*self.arguments("--turn", "z,-120", "--seed", "5", "--jobs", str(jobs),
                                             output=name))
            texts.append(self.read(name))
        self.assertEqual(texts[0], texts[1])
        self.assertEqual(texts[0], texts[2])

    def first(self, plan, kind):
        """Return the index in the report and the step."""
        index = next(i for i, step in enumerate(plan["steps"]) if step["kind"] == kind)
        return index + 1, plan["steps"][index]

    # Each function changes one property of a plan. It returns the failing entry and words of the
    # message.

    def break_hand_jumps(self, plan):
        entry, step = self.first(plan, "switch")
        finger = step["place"][0]["finger"]
        step["motion"]["place"][0]["joints"][finger][2] += 0.05
        return entry, (f"of finger {finger}", "2.86° from its previous ")

    def break_tip_off_contact(self, plan):
        finger = plan["initial"]["contacts"][0]["finger"]
        plan["hand"]["initial"]["joints"][finger][1] += 0.002
        return 0, (f"the fingertip of finger {finger}", "µm from its contact", "limit 1 µm")

    def break_joint_limit(self, plan):
        held = [contact["finger"] for contact in plan["initial"]["contacts"]]
        finger = next(i for i in range(4) if i not in held)
        plan["hand"]["initial"]["joints"][finger][0] = 1.7
        return 0, (f"joint finger{finger}_joint0 of finger {finger}", "97.40°", "52.40° beyond",
                   "-45.00° and 45.00°")

    def break_hand_collides(self, plan):
        entry, step = self.first(plan, "switch")
        finger = step["place"][0]["finger"]
        path = step["motion"]["place"]
        through = copy.deepcopy(path[len(path) // 2])
        through["joints"][finger] = [0, 1.2, 1.2, 1.2]
        path.insert(len(path) // 2 + 1, through)
        return entry, (f"of finger {finger}", "m inside ", "of place")

    def reddish_in_frames(self, report):
        """Return the number of pixels per frame that are as red as a link at fault."""
        return [count(png_pixels(self.read("result/" + step["frame"])), is_reddish)
                for step in report["steps"]]

    def test_what_the_hand_cannot_do_is_told_and_drawn_as_other_failures_are(self):
        more = ("--hand", self.hand("ring4"), "--junit", "junit.xml")
        done, report = self.validate(self.plan_in_hand(), *more)
        self.assertEqual(done.returncode, 0, done.stderr)
        for step in report["steps"]:
            self.assertEqual(count(png_pixels(self.read("result/" + step["frame"])), is_red), 0)
        usual = self.reddish_in_frames(report)
        for reason in ("hand-jumps", "tip-off-contact", "joint-limit", "hand-collides"):
            with self.subTest(reason=reason):
                plan = self.plan_in_hand()
                entry, words = getattr(self, "break_" + reason.replace("-", "_"))(plan)
                done, report = self.validate(plan, *more)
                self.assertEqual(done.returncode, 1, done.stderr)
                step = report["steps"][entry]
                self.assertEqual(step["reason"], reason)
                failure = xml.etree.ElementTree.fromstring(self.read("junit.xml")).find(
                    ".//failure")
                self.assertEqual(failure.get("message"), reason)
                page = self.read("result/report.html").decode()
                for word in words:
                    for text in (step["detail"], done.stdout, page, failure.text):
                        self.assertIn(word, text)
                for text in (done.stdout, failure.text):
                    self.assertIn("help: ", text)
                frame = png_pixels(self.read("result/" + step["frame"]))
                # The heading, and links of the hand, which are slightly transparent.
                self.assertGreater(count(frame, is_red), 20)
                self.assertGreater(count(frame, is_reddish), usual[entry] + 200)

    def test_states_of_another_hand_have_their_frame_too(self):
        """For missing joints the hand is drawn as before, or in the pose of its model."""
        hold = self.plan_in_hand()
        hold["hand"]["initial"]["joints"][2].pop()
        entry, step = self.first(self.plan_in_hand(), "switch")
        path = self.plan_in_hand()
        path["steps"][entry - 1]["motion"]["release"][-1]["joints"].pop()
        # An earlier fault of the contacts in addition.
        both = copy.deepcopy(path)
        place = both["steps"][entry - 1]["place"][0]
        place["point"] = [p - 0.004 * n for p, n in zip(place["point"], place["normal"])]
        _, passing = self.validate(self.plan_in_hand(), "--hand", self.hand("ring4"))
        usual = self.reddish_in_frames(passing)
        for plan, index, reason in ((hold, 0, "hand-jumps"), (path, entry, "hand-jumps"),
                                    (both, entry, "off-surface")):
            done, report = self.validate(plan, "--hand", self.hand("ring4"), "--frames", "animation")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(report["steps"][index]["reason"], reason)
            if reason == "hand-jumps":
                self.assertIn(", expected 4", report["steps"][index]["detail"])
            frame = png_pixels(self.read("result/" + report["steps"][index]["frame"]))
            if plan is not path:  # no finger is at fault in that plan
                self.assertGreater(count(frame, is_reddish), usual[index] + 50)

    def test_a_library_says_it_first_too(self):
        os.makedirs(self.path("plans"))
        plan = self.plan_in_hand()
        _, words = self.break_joint_limit(plan)
        self.write_json("plans/limit.json", plan)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plans", "--hand",
                                self.hand("ring4"), "--output", "library", *SMALL,
                                program="validate")
        self.assertEqual(done.returncode, 1, done.stderr)
        page = self.read("library/index.html").decode()
        for word in ("joint-limit", *words):
            self.assertIn(word.lower(), page.lower())

    def test_the_moving_picture_shows_the_hand_on_its_way(self):
        plan = self.plan_in_hand()
        small = ("--frames", "none", "--size", "animation=64x48")
        self.validate(plan, *small, "--video", "without.webp")
        done, _ = self.validate(plan, *small, "--hand", self.hand("ring4"), "--video", "with.webp")
        self.assertEqual(done.returncode, 0, done.stderr)
        durations = webp_durations(self.read("with.webp"))
        moving = [ms for ms in durations if ms < 240]
        # A rotation of 200°, and fingers that are placed and released, with a pause after each step.
        self.assertGreater(len(moving), 80)
        self.assertGreaterEqual(len(durations) - len(moving), len(plan["steps"]) + 1)
        self.assertLess(sum(durations), 30000)
        # Negative control: plans without intermediate states give fewer frames.
        for step in plan["steps"]:
            for path in (step,) if step["kind"] == "move" else (step["motion"],):
                for name in ("path", "place", "release"):
                    if len(path.get(name, [])) > 2:
                        path[name] = [path[name][0], path[name][-1]]
        done, _ = self.validate(plan, *small, "--hand", self.hand("ring4"), "--video", "cut.webp")
        self.assertLess(len(webp_durations(self.read("cut.webp"))), len(durations))

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
                (off, 0, "tip-off-contact", "from its contact"),
                (jump, move + 1, "hand-jumps", "object begins the step 100"),
                (goal, len(goal["steps"]), "goal-not-reached", "1 mm")):
            done, report = self.validate(broken, "--hand", self.hand("ring4"), "--frames", "none")
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertEqual(report["steps"][step]["reason"], reason)
            self.assertIn(words, report["steps"][step]["detail"])
            # Without the hand the plan passes.
            done, report = self.validate(broken, "--frames", "none")
            self.assertEqual(report["verdict"], "pass", done.stderr)

    def test_more_clearance_than_there_is_fails(self):
        done, report = self.validate(self.plan_in_hand(), "--hand", self.hand("ring4"),
                                     "--clearance", "0.02", "--frames", "none")
        self.assertEqual(done.returncode, 1)
        self.assertIn("hand-collides", [step["reason"] for step in report["steps"]])

    def test_links_keep_the_clearance_that_is_asked_for(self):
        verdicts = []
        for clearance in ("0.0005", "0.008"):
            self.assert_done(*self.arguments("--turn", "z,120", "--robustness", "none", "--clearance",
                                             clearance))
            _, report = self.validate(json.loads(self.read("plan.json")), "--hand",
                                      self.hand("ring4"), "--clearance", "0.008", "--replay",
                                      "points", "--frames", "none")
            verdicts.append(report["verdict"])
        self.assertEqual(verdicts, ["fail", "pass"])

    def test_what_the_motors_do_not_carry_out_is_written_only_where_that_is_asked_for(self):
        # Rolling fingertips slip if the plan has no friction margin.
        turn = ("--object", self.model("cube.obj"), "--mu", "0.3", "--hand", self.hand("ring4"),
                "--turn", "z,90", "--output", "plan.json")
        self.assert_refused(1, ("none executes in simulation", "the best fails at step ",
                                "(slipped)", "limit 1 mm",
                                "help: --robustness preferred writes the best plan anyway"),
                            *turn, "--quiet")
        self.assertIn("the plan does not execute in simulation: it fails at ",
                      self.assert_done(*turn, "--robustness", "preferred").stderr)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json", "--hand",
                                self.hand("ring4"), "--output", "result", "--frames", "none",
                                program="validate")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("slipped", done.stdout)

    def test_bad_usage_is_one_line(self):
        for words, more in (
                ("requires a task, --turn, --goal-pose, --goal-facing, --goals or --goal", ()),
                ('expected an axis and degrees, as in z,90, found "90"', ("--turn", "90")),
                ('found "w,90"', ("--turn", "w,90")),
                ("at most 3600", ("--turn", "z,1e9")),
                ("other than 0", ("--turn", "z,0")),
                ("found random", ("--turn", "z,90", "--start", "random")),
                ("--turn: cannot be used with --goal-pose", ("--turn", "z,90", "--goal-pose", "0,0,0.1,1,0,0,0")),
                ('7 numbers as in 0,0,0.12,1,0,0,0, found "0,0,0.1"', ("--goal-pose", "0,0,0.1")),
                ("length must be 1, found 1.414", ("--goal-pose", "0,0,0.1,1,1,0,0")),
                ("in metres from the palm, found 50 m", ("--goal-pose", "0,0,50,1,0,0,0")),
                ("--goal: with --hand requires --start or --start-pose", ("--goal", "goal.json")),
                ("--hand: not supported by planner general; help: use --planner gait",
                 ("--turn", "z,90", "--planner", "general")),
                ("no planner supports this combination for a solid: --optimize travel (general), --hand (gait)",
                 ("--turn", "z,90", "--optimize", "travel")),
                ("--optimize margin: requires simulated plans",
                 ("--turn", "z,90", "--optimize", "margin", "--robustness", "none"))):
            self.assert_refused(2, words, *self.arguments(*more))
        self.assert_refused(2, "planner gait requires a hand (--hand)", "--object",
                            self.model("cube.obj"), "--mu", "0.5", "--output", "plan.json",
                            "--planner", "gait", "--start", "random", "--goal", "random")
        self.assert_refused(2, "--start is required", "--object", self.model("cube.obj"), "--mu",
                            "0.5", "--output", "plan.json")
        for option, value in (("--turn", "z,90"), ("--goal-pose", "0,0,0.1,1,0,0,0"),
                              ("--start-pose", "0,0,0.1,1,0,0,0"), ("--clearance", "0.002"),
                              ("--robustness", "none")):
            self.assert_refused(2, f"{option} requires --hand", "--object", self.model("cube.obj"),
                                "--mu", "0.5", "--output", "plan.json", option, value)
        self.assert_refused(2, "found a planar object", "--object", self.model("square.wkt"), "--mu",
                            "0.5", "--output", "plan.json", "--hand", self.hand("ring4"), "--turn",
                            "z,90")

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
                ("not found", set_tip("nobody")),
                ("must be a descendant of the palm", lambda bad: bad.update(palm="finger0_base")),
                ("/fingers", lambda bad: bad.update(fingers=[])),
                ("nowhere.xml", lambda bad: bad.update(model="nowhere.xml"))):
            changed(change)
            self.assert_refused(2, words, "--object", self.model("cube.obj"), "--mu", "0.8",
                                "--hand", "hand.json", "--turn", "z,90", "--output", "plan.json")

    def test_a_model_is_told_how_it_becomes_a_hand(self):
        model = self.hand("ring4").replace(".json", ".xml")
        self.assert_refused(2, f"hand --model {model} --output", "--object",
                            self.model("cube.obj"), "--mu", "0.8", "--hand", model, "--turn",
                            "z,90", "--output", "plan.json")

    def test_a_folder_with_an_earlier_run_is_written_again(self):
        plan = self.plan_in_hand()
        for more in ((), ("--hand", self.hand("ring4")), ("--frames", "none",), ()):
            done, _ = self.validate(plan, *more)
            self.assertEqual(done.returncode, 0, done.stderr)
            names = [name for name in os.listdir(self.path("result")) if "_move" in name]
            self.assertEqual(bool(names), more != ("--frames", "none",))

    def test_no_result_is_reused_after_a_change_of_the_hand_or_its_model(self):
        os.mkdir(self.path("hands"))
        os.mkdir(self.path("plans"))
        for name in ("ring4.json", "ring4.xml"):
            shutil.copy(self.model(os.path.join("hands", name)), self.path("hands"))
        plan = self.plan_in_hand()
        self.write_json("plans/one.json", plan)
        self.write("plans.jsonl", json.dumps(plan) + "\n")
        model = self.read("hands/ring4.xml")
        # An additional blank makes it another model, for which the plan was not made.
        for bytes_now, code, word in ((model, 0, "1 pass"), (model, 0, "1 kept"),
                                      (model + b" ", 2, "bad-input"), (model, 0, "1 pass"),
                                      (model, 0, "1 kept")):
            self.write("hands/ring4.xml", bytes_now)
            for plans, out in (("plans", "folder"), ("plans.jsonl", "lines")):
                done = self.run_program(
                    "--object", self.model("cube.obj"), "--plan", plans, "--hand",
                    "hands/ring4.json", "--replay", "points", "--frames", "none", "--output", out,
                    program="validate")
                self.assertEqual(done.returncode, code, done.stderr)
                said = done.stdout.splitlines()[-1] if plans == "plans" else done.stderr
                # Bad input removes the results of a plan in a folder, and replaces those of a line.
                self.assertIn(word, said)
                if code == 2:
                    self.assertNotIn("kept", said)
                    self.assertIn("another version of ring4.json (hand ring4): the hand file, its "
                                  "model or a mesh differs", done.stderr)

    def test_another_hand_is_refused(self):
        self.write_json("plan.json", self.plan_in_hand())
        self.assert_refused(2, "--hand: the plan is for another hand, expected ring4.json (hand ring4), "
                            "found ring5.json (hand ring5)", "--object",
                            self.model("cube.obj"), "--plan", "plan.json", "--hand",
                            self.hand("ring5"), program="validate")

    def test_no_gait_says_what_stopped_it(self):
        done = self.run_program("--object", self.model("cube.obj"), "--scale", "20", "--mu", "0.8",
                                "--hand", self.hand("ring4"), "--turn", "z,90", "--output",
                                "plan.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("0 of 90 degrees", done.stderr)
        self.assertFalse(os.path.exists(self.path("plan.json")))

    def test_the_size_and_mass_are_told_before_the_search(self):
        done = self.assert_done(*self.arguments("--turn", "z,9", "--robustness", "none"))
        # A cube of 60 mm at a scale of 0.8.
        self.assertEqual(done.stderr.splitlines()[0],
                         "plan: cube.obj: 48 × 48 × 48 mm, 8.31 cm across, 111 g at the density of "
                         "water")
        self.assertEqual(done.stderr.count("across"), 1, done.stderr)
        quiet = self.assert_done(*self.arguments("--turn", "z,9", "--robustness", "none", "--quiet"))
        self.assertEqual(quiet.stderr, "")

    def test_an_object_in_millimetres_is_warned_of_with_a_hand_too(self):
        text = re.sub(rb"0\.03", b"30", self.read(self.model("cube.obj")))
        self.write("cube_mm.obj", text.decode())
        for more in ((), ("--quiet",)):
            done = self.run_program("--object", "cube_mm.obj", "--mu", "0.8", "--hand",
                                    self.hand("ring4"), "--turn", "z,90", "--output", "plan.json",
                                    "--planner", "budget=20", *more)
            self.assertEqual(done.returncode, 1, done.stderr)
            self.assertIn("plan: warning: the object is 104 m across, 2.16e+08 kg; help: if the file is in "
                          "millimetres, pass --scale 0.001 (10.4 cm across)\n", done.stderr)
            self.assertEqual("60000 × 60000 × 60000 mm" in done.stderr, not more, done.stderr)

    def test_no_plan_names_the_option_that_may_help(self):
        done = self.run_program("--object", self.model("cube.obj"), "--scale", "20", "--mu", "0.8",
                                "--hand", self.hand("ring4"), "--turn", "z,90", "--output",
                                "plan.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("help: --explain", done.stderr)

    def test_a_pose_out_of_reach_is_refused_with_the_reach(self):
        for option, pose in (("--goal-pose", "1,1,1,1,0,0,0"), ("--goal-pose", "0,0,0.6,1,0,0,0"),
                             ("--start-pose", "0,0.9,0,1,0,0,0")):
            more = ("--turn", "z,90") if option == "--start-pose" else ()
            self.assert_refused(2, "out of reach of every finger, expected at least 3", option,
                                pose, *more, *self.arguments())
        self.assert_refused(2, "m from the first joint of finger finger", "--goal-pose",
                            "1,1,1,1,0,0,0", *self.arguments())
        # Within reach of the finger's base, so that the search runs, regardless of its result.
        done = self.run_program(*self.arguments("--goal-pose", "0,0,0.06,1,0,0,0", "--planner", "budget=2",
                                                "--robustness", "none"))
        self.assertNotEqual(done.returncode, 2, done.stderr)

    def test_thin_rods_of_many_sides_are_turned_as_those_of_few(self):
        for sides in (6, 12, 20):
            corners = [(0.0075 * math.cos(2 * math.pi * i / sides),
                        0.0075 * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
            lines = [f"v {x:.9f} {y:.9f} {z}" for z in (-0.06, 0.06) for x, y in corners]
            lines.append("f " + " ".join(str(i) for i in range(sides, 0, -1)))
            lines.append("f " + " ".join(str(sides + i) for i in range(1, sides + 1)))
            for i in range(sides):
                j = (i + 1) % sides
                lines.append(f"f {i + 1} {j + 1} {sides + j + 1} {sides + i + 1}")
            self.write("rod.obj", "\n".join(lines) + "\n")
            done = self.run_program("--object", "rod.obj", "--mu", "0.8", "--hand",
                                    self.hand("ring4"), "--turn", "z,20", "--robustness", "none",
                                    "--output", "plan.json")
            self.assertEqual(done.returncode, 0, (sides, done.stderr))

    def test_the_budget_is_when_to_give_up(self):
        for budget, code in (("1", 1), ("8000", 0)):
            done = self.run_program(*self.arguments("--turn", "x,500", "--planner", "budget=" + budget))
            self.assertEqual(done.returncode, code, done.stderr)

    def test_explain_says_what_would_do(self):
        done = self.run_program("--object", self.model("cube.obj"), "--scale", "20", "--mu", "0.8",
                                "--hand", self.hand("ring4"), "--turn", "z,90", "--explain",
                                "--time-limit", "1", "--output", "plan.json")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no effect: more friction, another size of the object, a tilt of the "
                      "palm", done.stderr)


if __name__ == "__main__":
    program_case.main()
