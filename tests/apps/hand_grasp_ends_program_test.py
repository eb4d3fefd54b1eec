"""Plans of `plan --hand` between hand grasps: the ends of a known plan are the grasps."""

import copy
import json

from gait_program_test import SMALL
from program_case import ProgramCase, main

PLAN = ("--mu", "0.8", "--scale", "0.8")


def inverse(pose):
    """Return the inverse of a pose in the form of a hand grasp's palm."""
    w, x, y, z = pose["quaternion"]
    rows = [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]
    position = [-sum(rows[k][i] * pose["position"][k] for k in range(3)) for i in range(3)]
    return {"position": position, "quaternion": [w, -x, -y, -z]}


def last_state(step):
    """Return the state of the hand after a step."""
    path = step["path"] if step["kind"] == "move" else step["motion"]["release"] or step["motion"]["place"]
    return path[-1]


def contacts_after(plan):
    """Return the contacts after the last step, by finger."""
    held = {contact["finger"]: contact for contact in plan["initial"]["contacts"]}
    for step in plan["steps"]:
        if step["kind"] == "switch":
            held = {finger: contact for finger, contact in held.items() if finger not in step["release"]}
            held.update({contact["finger"]: contact for contact in step["place"]})
    return held


class HandGraspEnds(ProgramCase):
    program = "plan"
    made = None

    def setUp(self):
        super().setUp()
        self.ring = self.model("hands/ring4.json")
        if HandGraspEnds.made is None:
            self.assert_done(*self.arguments("--turn", "z,130", "--seed", "2"))
            HandGraspEnds.made = json.loads(self.read("plan.json"))
        plan = HandGraspEnds.made
        self.assertIn("switch", [step["kind"] for step in plan["steps"]])
        self.assertNotIn("align", [step["kind"] for step in plan["steps"]])
        self.first, self.last = plan["hand"]["initial"], last_state(plan["steps"][-1])
        self.write_grasps(self.grasp("first", self.first), self.grasp("last", self.last))

    def arguments(self, *more, output="plan.json"):
        return ("--object", self.model("cube.obj"), *PLAN, "--hand", self.ring, "--output", output, *more)

    def grasp(self, name, state, **more):
        joints = {f"finger{finger}_joint{joint}": angle for finger, angles in enumerate(state["joints"])
                  for joint, angle in enumerate(angles)}
        return {"format": "regrasp-hand-grasp", "version": 1, "id": name,
                "object": {"file": "cube.obj", "scale": 0.8}, "palm": inverse(state["pose"]), "joints": joints, **more}

    def write_grasps(self, *grasps, name="set.jsonl"):
        self.write(name, "".join(json.dumps(grasp) + "\n" for grasp in grasps))

    def refused(self, grasp, *words, code=2):
        self.write_grasps(grasp, name="one.jsonl")
        return self.assert_refused(code, words, *self.arguments("--start", "one.jsonl", "--turn", "z,10",
                                                                "--robustness", "none", output="new.json"))

    def test_a_plan_between_two_grasps_passes_validation(self):
        self.assert_done(*self.arguments("--start", "set.jsonl:first", "--goal", "set.jsonl:last",
                                         output="between.json"))
        plan = json.loads(self.read("between.json"))
        for angles, given in zip(plan["hand"]["initial"]["joints"], self.first["joints"]):
            for angle, wanted in zip(angles, given):
                self.assertAlmostEqual(angle, wanted, delta=1e-5)
        end, wanted = last_state(plan["steps"][-1])["pose"], self.last["pose"]
        for value, given in zip(end["position"], wanted["position"]):
            self.assertAlmostEqual(value, given, delta=1e-3)
        reached, given = contacts_after(plan), contacts_after(HandGraspEnds.made)
        self.assertEqual(sorted(reached), sorted(given))
        for finger, contact in given.items():
            for value, expected in zip(reached[finger]["point"], contact["point"]):
                self.assertAlmostEqual(value, expected, delta=1e-6)
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "between.json", "--hand", self.ring,
                                "--output", "result", "--frames", "none", *SMALL, program="validate")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_same_contacts_in_another_pose_need_no_finger_switch(self):
        """Contacts of two grasps differ by rounding, or by less than the tolerance."""
        self.assert_done(*self.arguments("--turn", "z,30", "--robustness", "none"))
        plan = json.loads(self.read("plan.json"))
        self.assertEqual([step["kind"] for step in plan["steps"]], ["move"])
        last = self.grasp("last", last_state(plan["steps"][-1]))
        for shift, kinds in ((0, ["move"]), (3e-4, ["move"])):
            last["palm"]["position"][2] += shift
            self.write_grasps(self.grasp("first", plan["hand"]["initial"]), last, name="same.jsonl")
            self.assert_done(*self.arguments("--start", "same.jsonl:first", "--goal", "same.jsonl:last", "--robustness",
                                             "none", output="same.json"))
            self.assertEqual([step["kind"] for step in json.loads(self.read("same.json"))["steps"]], kinds)

    def test_fingers_near_the_surface_are_moved_onto_it(self):
        near = self.grasp("near", self.first)
        near["joints"]["finger0_joint2"] += 0.01
        self.write_grasps(near, name="one.jsonl")
        self.assert_done(*self.arguments("--start", "one.jsonl", "--turn", "z,10", output="new.json"))
        plan = json.loads(self.read("new.json"))
        moved = plan["hand"]["initial"]["joints"]
        self.assertNotAlmostEqual(moved[0][2], near["joints"]["finger0_joint2"], delta=1e-3)
        self.assertAlmostEqual(moved[1][2], near["joints"]["finger1_joint2"], delta=1e-3)
        self.assert_done("--object", self.model("cube.obj"), "--plan", "new.json", "--hand", self.ring, "--output",
                         "result", "--frames", "none", program="validate")

    def test_grasps_that_are_not_fingertip_grasps_are_refused(self):
        good = self.grasp("good", self.first)
        far = copy.deepcopy(good)
        far["palm"]["position"][0] += 0.01
        self.refused(far, "at least 3 fingertips within 2 mm of the surface, found 1; the next fingertip is at 1 cm")
        deep = copy.deepcopy(good)
        deep["palm"]["position"][0] += 0.003
        self.refused(deep, "finger finger2 is too deep in the object, expected at most 2 mm, found 3 mm")
        away = copy.deepcopy(good)
        away["palm"]["position"][2] -= 0.2
        self.refused(away, "at least 3 fingertips within 2 mm of the surface, found 0")
        other = copy.deepcopy(good)
        other["joints"]["index_joint"] = 0
        self.refused(other, "/joints/index_joint: unknown joint, the grasp is for another hand than ring4")
        missing = copy.deepcopy(good)
        del missing["joints"]["finger2_joint1"]
        self.refused(missing, "/joints: joint finger2_joint1 not found")
        outside = copy.deepcopy(good)
        outside["joints"]["finger2_joint1"] = -1
        self.refused(outside, "/joints/finger2_joint1: outside its range, expected -0.6109", "found -1")
        scaled = {**good, "object": {"file": "cube.obj", "scale": 0.9}}
        self.refused(scaled, "/object/scale: must be that of the plan, expected 0.8, found 0.9")
        self.refused({**good, "object": {"file": "mug.obj", "scale": 0.8}}, "expected cube.obj, found mug.obj")
        self.refused({**good, "palm": {"position": [0, 0, 0], "quaternion": [1, 0, 0, 1]}}, "must be a unit quaternion")

    def test_links_that_are_too_near_are_refused(self):
        """The idle finger is moved to the object, to another finger and to the palm."""
        held = {contact["finger"] for contact in HandGraspEnds.made["initial"]["contacts"]}
        idle, = set(range(4)) - held
        self.assertEqual(idle, 1, "the angles below are those of finger 1")
        for angle, words in ((0, "link finger1_distal is too near to the object, requires 1.5 mm; only fingertips"),
                             (-0.3, "fingers finger1 and finger2 are too near to each other, requires 1.5 mm"),
                             (1.2, "finger finger1 is too near to the palm or to itself")):
            near = self.grasp("near", self.first)
            near["joints"].update({"finger1_joint0": 0, "finger1_joint1": angle, "finger1_joint2": 1})
            self.refused(near, "one.jsonl: line 1: " + words)

    def test_a_grasp_without_force_closure_is_refused(self):
        self.write_grasps(self.grasp("first", self.first), name="one.jsonl")
        self.assert_refused(2, "one.jsonl: line 1: /contacts: not force closure", "--object", self.model("cube.obj"),
                            "--mu", "0.01", "--scale", "0.8", "--hand", self.ring, "--output", "new.json", "--start",
                            "one.jsonl", "--turn", "z,10")

    def test_options_that_contradict_a_grasp_are_refused(self):
        cases = [(("--start", "set.jsonl", "--turn", "z,10"), "--start: set.jsonl: expected FILE:NAME"),
                 (("--start", "set.jsonl:none", "--turn", "z,10"), "set.jsonl: grasp none not found"),
                 (("--start", "set.jsonl:first"), "requires a task"),
                 (("--start", "set.jsonl:first", "--start-pose", "0,0,0.1,1,0,0,0", "--turn", "z,10"), "--start-pose"),
                 (("--goal", "set.jsonl:last", "--turn", "z,10"), "--goal: a hand grasp states the pose"),
                 (("--start", "missing.jsonl:first", "--turn", "z,10"), "missing.jsonl:first")]
        for given, words in cases:
            self.assert_refused(2, words, *self.arguments(*given, output="new.json"))
        self.assert_refused(2, "--start: a hand grasp requires --hand", "--object", self.model("cube.obj"), *PLAN,
                            "--start", "set.jsonl:first", "--goal", "set.jsonl:last", "--output", "new.json")

    def test_no_plan_is_a_negative_result(self):
        self.assert_done(*self.arguments("--turn", "z,200", "--seed", "1", "--robustness", "none"))
        plan = json.loads(self.read("plan.json"))
        self.write_grasps(self.grasp("first", plan["hand"]["initial"]), self.grasp("last", last_state(plan["steps"][-1])))
        done = self.run_program(*self.arguments("--start", "set.jsonl:first", "--goal", "set.jsonl:last", "--planner",
                                                "budget=1", "--robustness", "none", output="new.json"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("plan: no plan found: ", done.stderr)

    def test_queries_have_grasps_of_a_set(self):
        first, last = self.grasp("first", self.first), self.grasp("last", self.last)
        queries = [{"start": first, "goal": last}, {"start": last, "goal": first},
                   {"start": {**first, "object": {"file": "cube.obj", "scale": 2}}, "goal": last}]
        self.write_grasps(*queries, name="queries.jsonl")
        done = self.run_program(*self.arguments("--batch", "queries.jsonl", "--robustness", "none", output="plans.jsonl"))
        self.assertEqual(done.returncode, 2, done.stderr)
        plans = [json.loads(line) for line in self.read("plans.jsonl").splitlines()][1:]
        self.assertEqual([plan["format"] for plan in plans], ["regrasp-plan", "regrasp-plan", "regrasp-none"])
        self.assertIn("queries.jsonl: line 3: /start: /object/scale", plans[2]["message"])


if __name__ == "__main__":
    main()
