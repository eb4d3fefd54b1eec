"""Grasp files without contacts: regrasp-convert writes no file, and names the likely cause."""

import contextlib
import io
import os
import re
import unittest

import numpy as np

import regrasp
from regrasp import _poses, convert, formats
from regrasp_case import RegraspCase, grasps_of_a_turn

HAND = "models/hands/ring4.json"
CUBE = "models/cube.obj"
WORLD = np.array([0.3, -0.2, 0.1, 0.5, 0.1, -0.7, 0.5])
WORLD[3:] /= np.linalg.norm(WORLD[3:])


class MisreadTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.hand = regrasp.Hand.read(HAND)
        cls.cube = regrasp.Object.read(CUBE)
        cls.grasps = grasps_of_a_turn(cls.cube, cls.hand)

    def write(self, *, palms=None, joints=None, object_pose=WORLD, change=lambda pose: pose, **more):
        """Write a dictionary of DexGraspBench with the plan's grasps.

        Args:
            palms: Positions and quaternions in the object's frame. Default: those of the plan.
            change: Function that changes the poses of palms and object before they are written.
        """
        positions, quaternions = palms or (self.grasps.positions, self.grasps.quaternions)
        turn = _poses.matrices(object_pose[3:])
        world = np.concatenate([
            positions @ turn.T + object_pose[:3],
            _poses.product(np.broadcast_to(object_pose[3:], quaternions.shape), quaternions)], axis=1)
        joints = self.grasps.joints if joints is None else joints
        np.save(self.path("grasps.npy"), {
            "obj_pose": change(object_pose[None])[0], "joint_names": self.hand.joint_names,
            "grasp_qpos": np.concatenate([change(world), joints], axis=1), **more})

    def convert(self, *options, code, object=CUBE):
        """Return the program's output on standard error; it must write a file exactly if the exit
        code is 0."""
        output = self.path("contacts.npz")
        with contextlib.redirect_stderr(io.StringIO()) as said:
            found = convert.main([self.path("grasps.npy"), "--hand", HAND, "--object", object,
                                  "--output", output, *options])
        self.assertEqual(found, code, said.getvalue())
        self.assertEqual(os.path.exists(output), code == 0)
        if code == 0:
            os.remove(output)
        else:
            self.assertEqual(said.getvalue().count("\n"), 1)
        return said.getvalue()

    def assert_cause(self, kind, *words, options=(), **named):
        said = self.convert(*options, code=1, **named)
        self.assertTrue(said.startswith("regrasp-convert: no contacts found: "), said)
        for finger in self.hand.fingers:
            self.assertRegex(said, rf"{finger} [+-]\d")
        self.assertIn("in mm", said)
        self.assertIn(f"likely cause: {kind}", said)
        for word in words:
            self.assertIn(word, said)
        return said

    def test_the_control_a_file_that_is_read_rightly_is_converted(self):
        self.write()
        self.assertNotIn("cause", self.convert(code=0))

    def test_distances_are_signed(self):
        # Independent formula of a rounded box: the cube's faces are 30 mm from its centre.
        tips = self.hand.tips(self.grasps.joints)
        turns = _poses.matrices(self.grasps.quaternions)
        for shift in ([0, 0, 0], [0.02, 0.01, 0], [0, 0, 0.05]):
            centres = (tips @ np.swapaxes(turns, 1, 2) + self.grasps.positions[:, None]) + shift
            over = np.abs(centres) - 0.03
            outside = np.linalg.norm(np.maximum(over, 0), axis=-1)
            expected = outside + np.minimum(over.max(axis=-1), 0) - self.hand.radii
            moved = formats.HandGrasps(self.grasps.positions + shift, self.grasps.quaternions,
                                       self.grasps.joint_names, self.grasps.joints, self.grasps.names,
                                       self.grasps.confidence)
            gaps = moved.gaps(self.hand, self.cube)[2]
            np.testing.assert_allclose(gaps, expected, atol=1e-9)
        self.assertTrue((expected > 0.002).any() and (expected < 0.05).all())

    def test_quaternions_as_x_y_z_w(self):
        def last(pose):
            return np.concatenate([pose[:, :3], np.roll(pose[:, 3:], -1, axis=1)], axis=1)
        self.write(change=last)
        self.assert_cause("quaternion order", "x, y, z, w")
        # Only the palms are affected: the object is not rotated.
        origin = np.array([0, 0, 0, 1., 0, 0, 0])
        self.write(object_pose=origin, change=lambda pose: last(pose) if len(pose) > 1 else pose)
        self.assert_cause("quaternion order")

    def test_joints_in_degrees(self):
        self.write(joints=np.degrees(self.grasps.joints))
        self.assert_cause("degrees", "radians")

    def test_lengths_in_millimetres(self):
        def long(pose):
            return np.concatenate([1000 * pose[:, :3], pose[:, 3:]], axis=1)
        self.write(change=long)
        self.assert_cause("millimetres", "positions", "in metres")
        self.write()
        regrasp.Object.from_arrays(1000 * self.cube.vertices, self.cube.triangles,
                                   name="large.obj").write(self.path("large.obj"))
        said = self.assert_cause("millimetres", "--scale 0.001", object=self.path("large.obj"))
        self.assertIn("large.obj", said)
        self.convert("--scale", "0.001", code=0, object=self.path("large.obj"))

    def test_poses_of_another_body_than_the_palm(self):
        half = 0.5 ** 0.5
        for palm in ([0, 0, 0.054, 1, 0, 0, 0], [0.01, -0.02, 0.12, half, 0, 0, half],
                     [0.03, 0, 0.05, 0.5, 0.5, 0.5, 0.5]):
            back = _poses.inverse(np.array(palm[:3]), np.array(palm[3:]))
            other = self.grasps.with_palm_at([*back[0], *back[1]])
            self.write(palms=(other.positions, other.quaternions))
            said = self.assert_cause("palm frame", "--palm=")
            option = re.search(r"--palm=[-\d.,e]+", said).group()
            self.convert(option, code=0)
        # Poses of the object in the palm frame.
        self.write(palms=_poses.inverse(self.grasps.positions, self.grasps.quaternions))
        self.assert_cause("palm frame", "of the object in the palm's frame")

    def test_single_fingers_that_touch_by_chance_are_a_warning(self):
        back = _poses.inverse(np.array([0, 0, 0.034]), np.array([1., 0, 0, 0]))
        other = self.grasps.with_palm_at([*back[0], *back[1]])
        self.assertEqual(other.touching(self.hand, self.cube)[2].sum(axis=1).max(), 1)
        self.write(palms=(other.positions, other.quaternions))
        said = self.convert(code=0)
        self.assertIn("warning: no grasp has two fingertips at the surface; likely cause: palm frame", said)

    def test_a_scale_that_does_not_fit(self):
        self.write(obj_scale=0.06)
        self.assert_cause("scale", "--scale 1")
        self.convert("--scale", "1", code=0)
        self.write(obj_scale=1)
        self.assert_cause("scale", "leave --scale out", options=("--scale", "0.5"))

    def test_no_cause_is_named_where_no_reading_helps(self):
        rng = np.random.default_rng(3)
        count = 12
        quaternions = _poses.unit("", (lambda q: q / np.linalg.norm(q, axis=1)[:, None])(
            rng.normal(size=(count, 4))))
        self.write(palms=(rng.uniform(1, 2, (count, 3)), quaternions),
                   joints=rng.uniform(-0.3, 0.3, (count, 16)))
        said = self.convert(code=1)
        self.assertNotIn("likely cause", said)
        for kind in ("quaternion order", "degrees", "millimetres", "palm frame"):
            self.assertIn(kind, said)

    def test_fingers_that_never_touch_together(self):
        self.write()
        touching = self.grasps.touching(self.hand, self.cube)[2]
        idle = [name for name, held in zip(self.hand.fingers, touching.T) if not held.any()]
        self.assertTrue(idle)
        said = self.convert("--fingers", idle[0], code=1)
        self.assertRegex(said, rf"{idle[0]} [+-]\d")


if __name__ == "__main__":
    unittest.main()
