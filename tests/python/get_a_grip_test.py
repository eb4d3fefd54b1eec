"""Grasps of Get-a-Grip: NumPy dictionaries of our own in its layout."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import regrasp
from regrasp import _get_a_grip, _poses, formats
from regrasp_case import RegraspCase, grasps_of_a_turn

PROGRAM = os.path.join(os.path.dirname(os.path.dirname(regrasp.__file__)), "regrasp-convert")
HAND = "models/hands/ring4.json"
CUBE = "models/cube.obj"
SCORES = [0.9, 0.5, 0.1]


class Trap:
    """Object whose unpickling has a visible effect."""

    def __reduce__(self):
        return os.mkdir, (os.path.join(tempfile.gettempdir(), "regrasp-unpickled"),)


def orientations(directions):
    """Return rotation matrices whose third columns are unit vectors (…, 3)."""
    side = np.cross(directions, np.roll(directions, 1, axis=-1) + [0.1, 0.2, 0.3])
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    return np.stack([side, np.cross(directions, side), directions], axis=-1)


class GetAGripTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.hand = regrasp.Hand.read(HAND)
        cls.cube = regrasp.Object.read(CUBE)
        grasps = grasps_of_a_turn(cls.cube, cls.hand)
        # One static grasp of a plan, in which at least three fingertips touch, as three grasps.
        cls.positions, cls.quaternions, cls.joints = (
            np.repeat(values[:1], 3, axis=0) for values in (grasps.positions, grasps.quaternions, grasps.joints))
        cls.inward = np.repeat(grasps.touching(cls.hand, cls.cube)[1][:1], 3, axis=0)

    def content(self, **more):
        """Return a dictionary as eval_grasp_config_dict.py saves it, in single precision."""
        arrays = {"trans": self.positions, "rot": _poses.matrices(self.quaternions), "joint_angles": self.joints,
                  "grasp_orientations": orientations(self.inward), "y_PGS": np.array(SCORES), "y_pick": np.ones(3),
                  "y_coll": np.array(SCORES)}
        return {**{key: value.astype(np.float32) for key, value in arrays.items()}, **more}

    def save(self, name="cube_1_0000.npy", without=(), **more):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        np.save(self.path(name), {key: value for key, value in self.content(**more).items() if key not in without})
        return self.path(name)

    def refused(self, words, hand=None, **more):
        with self.assertRaises(regrasp.InputError) as caught:
            formats.read_get_a_grip(self.save(**more), hand)
        self.assertIn(words, str(caught.exception))
        self.assertIn("cube_1_0000.npy", str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def convert(self, *arguments, code=0):
        done = subprocess.run([sys.executable, PROGRAM, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def test_poses_joints_claims_object_and_scale_are_read(self):
        grasps = formats.read_get_a_grip(self.save("core-mug-12_0_0622.npy"), self.hand)
        np.testing.assert_allclose(grasps.positions, self.positions, atol=1e-7)
        np.testing.assert_allclose(_poses.matrices(grasps.quaternions), _poses.matrices(self.quaternions), atol=1e-6)
        np.testing.assert_allclose(grasps.in_order_of(self.hand), self.joints, atol=1e-6)
        np.testing.assert_allclose(grasps.directions, self.inward, atol=1e-6)
        self.assertEqual(grasps.claimed.tolist(), [True, False, False])
        np.testing.assert_allclose(grasps.confidence, SCORES, atol=1e-7)
        self.assertEqual((grasps.objects, grasps.scales.tolist()), (["core-mug-12.obj"] * 3, [0.0622] * 3))
        self.assertEqual(grasps.names[1], "core-mug-12_0_0622_1")
        self.assertEqual(grasps.lost, ["y_coll", "y_pick", "grasp_orientations", "scale, to be given as --scale 0.0622"])
        # A name without scale names no object, and a dictionary without evaluation claims nothing.
        other = formats.read_get_a_grip(self.save("mine.npy", without=["y_PGS"]))
        self.assertEqual((other.objects, other.scales, other.claimed, other.scored, other.joint_names),
                         (None, None, None, False, []))

    def test_joints_and_directions_have_the_order_of_the_data_set(self):
        """The fingers of a hand model can be in another order than those of the data set."""
        for names in _get_a_grip.JOINT_NAMES.values():
            fingers = [sorted(names[4 * i:4 * i + 4]) for i in (3, 0, 2, 1)]
            core = type("Core", (), {"joint_names": fingers})
            hand = type("Hand", (), {"name": "mine", "fingers": list("abcd"), "_core": core,
                                     "joint_names": [joint for finger in fingers for joint in finger]})
            joints = np.tile(np.arange(16.), (3, 1)).astype(np.float32)
            grasps = formats.read_get_a_grip(self.save(joint_angles=joints), hand)
            self.assertEqual(dict(zip(grasps.joint_names, grasps.joints[0])), dict(zip(names, range(16))))
            np.testing.assert_allclose(grasps.directions, self.inward[:, [3, 0, 2, 1]], atol=1e-6)

    def test_targets_move_the_fingertips_along_their_directions(self):
        """The same iteration with derivatives of the loss by differences, as in the code of the project."""
        grasps = formats.with_closing_targets(formats.read_get_a_grip(self.save(), self.hand), self.hand)
        turned = _poses.matrices(self.quaternions[0])
        wanted = self.hand.tips(self.joints[0]) + 0.05 * self.inward[0] @ turned

        def loss(joints):
            return np.square(self.hand.tips(joints) - wanted).sum(axis=(-1, -2))
        joints, step = self.joints[0], 1e-5
        for _ in range(100):
            joints = joints - 5 * (loss(joints + step * np.eye(16)) - loss(joints - step * np.eye(16))) / (2 * step)
        np.testing.assert_allclose(grasps.target.joints[0], joints, atol=1e-3)
        self.assertLess(loss(joints), 0.2 * loss(self.joints[0]))
        # The fingers without contact in the plan have no direction other than this test's.
        moved = (self.hand.tips(grasps.target.joints[0]) - self.hand.tips(self.joints[0])) @ turned.T
        self.assertGreater(np.einsum("fi,fi->f", moved, self.inward[0]).min(), 0.01)
        with self.assertRaisesRegex(regrasp.InputError, "directions, found none"):
            formats.with_closing_targets(formats.read_get_a_grip(self.save(without=["grasp_orientations"]), self.hand), self.hand)

    def test_folders_become_lines_with_targets(self):
        self.save("set/a/cube_1_0000.npy")
        said = self.convert(self.path("set"), "--hand", HAND, "--output", self.path("out.jsonl"))
        self.assertIn("not converted: y_pick", said)
        self.assertNotIn("grasp_orientations", said)
        lines = self.hand_grasps()
        self.assertEqual([(line["id"], line["claimed"]) for line in lines],
                         [("a/cube_1_0000_0", True), ("a/cube_1_0000_1", False), ("a/cube_1_0000_2", False)])
        self.assertEqual((lines[0]["set"], lines[0]["object"]), ("get_a_grip", {"file": "cube.obj", "scale": 1}))
        self.assertNotEqual(lines[0]["target"]["joints"], lines[0]["joints"])
        # The directions are those of the object's frame, whatever the frame of the palm in the root link.
        self.convert(self.path("set"), "--hand", HAND, "--palm", "0,0,0,0,0,0,1", "--output", self.path("turned.jsonl"))
        turned = self.hand_grasps("turned.jsonl")
        changed = formats.read_get_a_grip(self.save(rot=_poses.matrices(_poses.product(
            self.quaternions, np.tile([0, 0, 0, 1.], (3, 1))))), self.hand)
        np.testing.assert_allclose(list(turned[0]["target"]["joints"].values()),
                                   formats.with_closing_targets(changed, self.hand).target.joints[0], atol=1e-4)
        # Without a hand, the joints have no names.
        self.assertIn("--hand is required", self.convert(self.path("set"), "--output", self.path("x.jsonl"), code=2))

    def test_a_convention_that_does_not_fit_is_the_likely_cause(self):
        contacts = ["--hand", HAND, "--object", CUBE, "--output", self.path("a.npz")]
        self.convert(self.save(), *contacts)  # the control
        rotations = _poses.matrices(self.quaternions).astype(np.float32)
        # One fingertip touches by chance, so this is a warning.
        said = self.convert(self.save(rot=np.swapaxes(rotations, 1, 2)), *contacts)
        self.assertIn("warning: no grasp has two fingertips at the surface; likely cause: rotation: with transposed", said)
        for changed, cause in (({"joint_angles": np.degrees(self.joints)}, "degrees"),
                               ({"trans": 1000 * self.positions}, "millimetres")):
            self.assertIn(f"likely cause: {cause}", self.convert(self.save(**changed), *contacts, code=1))
        self.assertIn("likely cause: scale", self.convert(self.save("cube_0_5000.npy"), *contacts, code=1))

    def test_invalid_files_are_one_line(self):
        rotations = _poses.matrices(self.quaternions)
        for words, more in (("trans not found", {"without": ["trans"]}),
                            ("trans must have shape (N, 3)", {"trans": np.zeros((3, 4))}),
                            ("rot must have shape (3, 3, 3)", {"rot": rotations[:2]}),
                            ("rot[0] must be a rotation matrix", {"rot": -rotations}),
                            ("rot[0] must be a rotation matrix", {"rot": 1.1 * rotations}),
                            ("joint_angles must have shape (3, N)", {"joint_angles": np.zeros((2, 16))}),
                            ("joint_angles must have 16 columns for ring4, found 15", {"joint_angles": np.zeros((3, 15)),
                                                                                        "hand": self.hand}),
                            ("grasp_orientations must have 4 fingers for ring4, found 3",
                             {"grasp_orientations": orientations(self.inward[:, :3]), "hand": self.hand}),
                            ("grasp_orientations[0, 0] must be a rotation", {"grasp_orientations": np.zeros((3, 4, 3, 3))}),
                            ("y_PGS must have shape (3,)", {"y_PGS": np.zeros(2)}),
                            ("y_PGS[0] must be finite", {"y_PGS": np.full(3, np.nan)}),
                            ("posix.mkdir", {"other": Trap()})):
            with self.subTest(words=words):
                self.refused(words, **more)
        self.assertFalse(os.path.exists(os.path.join(tempfile.gettempdir(), "regrasp-unpickled")))
        self.assertIn("--object-pose cannot be used", self.convert(
            self.save(), "--hand", HAND, "--object-pose", "0,0,0,1,0,0,0", "--output", self.path("o.jsonl"), code=2))


if __name__ == "__main__":
    unittest.main()
