"""Law: every value of every argument of a public function is accepted, or rejected in one line that
names the argument."""

import inspect
import os
import unittest
import warnings

import numpy as np

import regrasp
from regrasp import formats
from regrasp_case import RegraspCase


class Nameless:
    """Value that is invalid everywhere and whose repr() fails."""

    def __repr__(self):
        raise RuntimeError("cannot be shown")


NONSENSE = [
    None, "", "x", "a\0b", b"x", -1, 0, 2, True, float("nan"), float("inf"), 2**70, 10**400, 1j, [], {},
    (1, 2, 3), [[1, 2], [3]], [1, [2, 3]], Nameless(), lambda *a: None, np.datetime64("now"),
    np.array(["a"]), np.array([None]), np.zeros((2, 2)), np.full((4, 3), np.nan), np.zeros((0, 3)),
    np.zeros((3, 4, 3), complex), np.zeros(3, dtype="f4"), np.zeros((1, 1, 1, 1)), np.ma.masked_all(2),
    np.zeros(2, dtype=[("a", "f8")])]


class ArgumentsTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.cube = regrasp.Object.read("models/cube.obj")
        cls.hand = regrasp.Hand.read("models/hands/ring4.json")
        cls.plan = regrasp.plan(cls.cube, "models/cube.start.json", "models/cube.goal.json", mu=0.4)
        cls.open = {
            "positions": np.zeros((1, 3)), "quaternions": np.array([[1., 0, 0, 0]]), "names": ["open"],
            "joint_names": cls.hand.joint_names, "joints": np.zeros((1, 16)), "confidence": np.ones(1)}

    def outcomes(self, function, **good):
        """Try all values of `NONSENSE`, and return how many of them each argument rejects."""
        refused = dict.fromkeys(good, 0)
        for name in good:
            for value in NONSENSE:
                with self.subTest(function=function.__qualname__, argument=name, value=type(value)):
                    try:
                        function(**{**good, name: value})
                    except (regrasp.NoPlan, TimeoutError, FileNotFoundError):
                        pass
                    except regrasp.InputError as error:
                        said = str(error)
                        refused[name] += 1
                        self.assertNotIn("\n", said)
                        # Messages name a file by its path, and an invalid plan text by the plan's
                        # name.
                        self.assertTrue(name in said or said.startswith(("x: ", "plan.json: ")), said)
        return refused

    def check(self, function, **good):
        for name, count in self.outcomes(function, **good).items():
            self.assertGreater(count, len(NONSENSE) // 4, f"{function.__qualname__}: {name}")

    def setUp(self):
        super().setUp()
        caught = warnings.catch_warnings()
        caught.__enter__()
        self.addCleanup(caught.__exit__, None, None, None)
        warnings.simplefilter("error")
        here = os.getcwd()
        self.addCleanup(os.chdir, here)

    def test_of_grasps(self):
        points = np.random.default_rng(0).normal(size=(3, 4, 3))
        normals = points / np.linalg.norm(points, axis=-1, keepdims=True)
        self.check(regrasp.force_closure, points=points, normals=normals, object=self.cube, mu=0.5,
                   quality=True, required_angle=False, threads=1, progress=None)
        self.check(regrasp.force_closure, points=points, normals=normals, friction_angle_deg=20,
                   active=np.ones((3, 4), bool))

    def test_of_objects(self):
        self.check(regrasp.Object.read, path="models/cube.obj", scale=1, repair=False, shells=None,
                   progress=None)
        self.check(regrasp.Object.from_arrays, vertices=self.cube.vertices,
                   faces=self.cube.triangles, scale=1, name="object.obj")
        self.check(regrasp.Object.from_polygon, outline=[[0, 0], [1, 0], [0, 1]], holes=[], scale=1,
                   name="object.wkt")
        self.check(self.cube.nearest, points=np.zeros((2, 3)))
        self.check(regrasp.Hand.read, path="models/hands/ring4.json")
        self.check(self.hand.tips, joints=np.zeros(16))

    def test_of_plans(self):
        self.check(regrasp.plan, object=self.cube, start="models/cube.start.json",
                   goal="models/cube.goal.json", mu=0.5, planner="auto", optimize="steps",
                   contacts=None, clusters=None, seed=0, min_quality=0, finger_radius=0,
                   time_limit=None, progress=None)
        self.check(regrasp.Plan, text=self.plan.text, name="plan.json")
        self.check(regrasp.Plan.read, path="plan.json")

    def test_of_plans_in_hands(self):
        self.check(regrasp.plan_in_hand, object=self.cube, hand=self.hand, mu=0.8, turn=("z", 5),
                   start=None, goal=None, start_pose=None, rolling=False, robustness="none", clearance=0.001, seed=0,
                   min_quality=0.01, time_limit=0.2, jobs=1, progress=None)

    def test_of_validation(self):
        report = regrasp.validate(self.cube, self.plan)
        self.check(report.frames, size=(320, 240))
        self.check(report.overview, size=(320, 240))
        self.check(regrasp.validate, object=self.cube, plan=self.plan, mu=None, mass=None,
                   grasp_force=None, disturbance=0.01, tolerance=0.001, resisted_wrench=False, hand=None, replay=None,
                   tolerance_mm=2, tolerance_deg=5, feedback=True, progress=None)

    def test_of_formats(self):
        grasps = formats.HandGrasps(**self.open)
        self.check(formats.HandGrasps, **self.open)
        self.check(grasps.touching, hand=self.hand, object=self.cube, tolerance=0.002)
        self.check(grasps.with_palm_at, palm=[0, 0, 0])
        self.check(grasps.in_order_of, hand=self.hand)
        os.chdir(self.folder)
        for reader in (formats.read_isaac_grasp, formats.read_dexgraspbench, formats.read_dexgraspnet,
                       formats.read_graspit, formats.read_bodex, formats.read_hidex,
                       formats.read_trajectory):
            self.check(reader, path="grasps")
        self.check(formats.of_plan, path="plan.json", hand=self.hand)
        self.check(formats.write_isaac_grasp, path="grasps.yaml", grasps=grasps,
                   object_frame="object", gripper_frame="palm")
        self.check(formats.motion_of_plan, path="plan.json", hand=self.hand)
        self.check(self.plan.write, path="plan.json")

    def test_of_fingers_and_motions(self):
        contacts = {"points": np.zeros((1, 3, 3)), "normals": np.zeros((1, 3, 3)), "names": ["a"]}
        self.check(formats.FingerGrasps, **contacts)
        grasps = formats.FingerGrasps(np.array([[[.03, 0, 0]]]), np.array([[[-1., 0, 0]]]), ["a"])
        self.check(grasps.on, object=self.cube, tolerance=0.001)
        self.check(grasps.as_plan, object=self.cube, mu=0.5)
        moves = {"times": [0.], "joint_names": self.hand.joint_names, "joints": np.zeros((1, 16)),
                 "object_poses": [[0, 0, 0, 1., 0, 0, 0]], "control_names": [], "controls": None}
        checked = self.outcomes(formats.HandMotion, **moves)
        self.assertGreater(min(count for name, count in checked.items() if name != "controls"), 8)
        self.check(self.hand.ordered, names=self.hand.joint_names, joints=np.zeros((1, 16)))
        moves["controls"] = np.zeros((1, 0))
        os.chdir(self.folder)
        self.check(grasps.write_npz, path="grasps.npz")
        self.check(formats.write_mcap, path="a.mcap", motion=formats.HandMotion(**moves),
                   hand=self.hand, start_time=0, palm_frame="palm", object_frame="object")

    def test_masked_values_are_never_taken_for_numbers(self):
        def masked(array, place):
            result = np.ma.array(array)
            result[place] = np.ma.masked
            return result
        points = np.random.default_rng(0).normal(size=(3, 4, 3))
        normals = points / np.linalg.norm(points, axis=-1, keepdims=True)
        contacts = {"points": np.zeros((1, 3, 3)), "normals": np.zeros((1, 3, 3)), "names": ["a"]}
        grasps = formats.HandGrasps(**self.open)
        moves = {"times": [0.], "joint_names": self.hand.joint_names, "joints": np.zeros((1, 16)),
                 "object_poses": [[0, 0, 0, 1., 0, 0, 0]]}
        start = np.array([[.03, 0, 0], [-.03, 0, 0], [0, .03, 0], [0, -.03, 0]])
        in_hand = {"object": self.cube, "hand": self.hand, "mu": 0.8}
        for words, function, arguments in [
                (["points[1, 2, 0]"], regrasp.force_closure,
                 {"points": masked(points, (1, 2, 0)), "normals": normals, "mu": 0.5}),
                (["points[0, 0, 0]", "11 more"], regrasp.force_closure,
                 {"points": masked(points, 0), "normals": normals, "mu": 0.5}),
                (["normals[2, 0, 1]"], regrasp.force_closure,
                 {"points": points, "normals": masked(normals, (2, 0, 1)), "mu": 0.5}),
                (["active[0, 1]"], regrasp.force_closure,
                 {"points": points, "normals": normals, "mu": 0.5,
                  "active": masked(np.ones((3, 4), bool), (0, 1))}),
                (["points[1][2, 0]"], regrasp.force_closure,
                 {"points": [points[0], masked(points[1], (2, 0))], "normals": normals[:2], "mu": 0.5}),
                (["points[0][1][2]"], regrasp.force_closure,
                 {"points": [[[0, 0, 0], (1, 1, np.ma.masked)]], "normals": normals[:2], "mu": 0.5}),
                (["mu"], regrasp.force_closure,
                 {"points": points, "normals": normals, "mu": np.ma.array(0.5, mask=True)}),
                (["threads"], regrasp.force_closure,
                 {"points": points, "normals": normals, "mu": .5, "threads": np.ma.array(1, mask=True)}),
                (["vertices[0, 0]"], regrasp.Object.from_arrays,
                 {"vertices": masked(self.cube.vertices, (0, 0)), "faces": self.cube.triangles}),
                (["faces[3, 1]"], regrasp.Object.from_arrays,
                 {"vertices": self.cube.vertices, "faces": masked(self.cube.triangles, (3, 1))}),
                (["outline[1, 0]"], regrasp.Object.from_polygon,
                 {"outline": masked(np.eye(3)[:, :2], (1, 0))}),
                (["holes[0][1, 0]"], regrasp.Object.from_polygon,
                 {"outline": [[0, 0], [9, 0], [0, 9]], "holes": [masked(np.eye(3)[:, :2], (1, 0))]}),
                (["points[0, 2]"], self.cube.nearest, {"points": masked(np.zeros((2, 3)), (0, 2))}),
                (["joints[3]"], self.hand.tips, {"joints": masked(np.zeros(16), 3)}),
                (["start[2, 1]"], regrasp.plan,
                 {"object": self.cube, "start": masked(start, (2, 1)), "goal": start, "mu": 0.5}),
                (["goal[1][0, 0]"], regrasp.plan,
                 {"object": self.cube, "start": start, "goal": (start, masked(-start, (0, 0))), "mu": 0.5}),
                (["start_pose[6]"], regrasp.plan_in_hand,
                 {**in_hand, "start_pose": masked(np.eye(7)[3], 6), "turn": ("z", 5)}),
                (["turn[1]"], regrasp.plan_in_hand, {**in_hand, "turn": ("z", np.ma.masked)}),
                (["positions[0, 1]"], formats.HandGrasps,
                 {**self.open, "positions": masked(np.zeros((1, 3)), (0, 1))}),
                (["joints[0, 9]"], formats.HandGrasps,
                 {**self.open, "joints": masked(np.zeros((1, 16)), (0, 9))}),
                (["scales[0]"], formats.HandGrasps, {**self.open, "scales": masked(np.ones(1), 0)}),
                (["palm[2]"], grasps.with_palm_at, {"palm": masked(np.zeros(3), 2)}),
                (["points[0, 1, 2]"], formats.FingerGrasps,
                 {**contacts, "points": masked(np.zeros((1, 3, 3)), (0, 1, 2))}),
                (["times[0]"], formats.HandMotion, {**moves, "times": masked(np.zeros(1), 0)}),
                (["object_pose[3]"], formats.read_bodex,
                 {"path": "x", "object_pose": masked(np.eye(7)[3], 3)})]:
            with self.subTest(function=function.__qualname__, words=words):
                if function is formats.read_bodex:
                    np.save(self.path("x.npy"), {"robot_pose": np.ones((1, 1, 2, 9)) / 2})
                    arguments["path"] = self.path("x.npy")
                self.refuses([*words, "mask"], function, **arguments)
        # Positive control: a masked array without masked values is an ordinary array.
        plain = regrasp.force_closure(points, normals, mu=0.5)
        free = regrasp.force_closure(np.ma.array(points), list(np.ma.array(normals)), mu=0.5)
        np.testing.assert_array_equal(free.margin, plain.margin)

    def test_a_function_that_does_not_look_is_found(self):
        def sloppy(length, words):
            return length + 1, [word.strip() for word in words]
        self.assertEqual(list(inspect.signature(sloppy).parameters), ["length", "words"])
        with self.assertRaises((TypeError, AttributeError)):
            sloppy(None, None)
        result = unittest.TestResult()

        class Inner(ArgumentsTest):
            def runTest(inner):
                inner.check(sloppy, length=1, words=[])
        Inner().run(result)
        self.assertGreater(len(result.errors), len(NONSENSE) // 2)


if __name__ == "__main__":
    unittest.main()
