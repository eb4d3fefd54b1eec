"""Grasps of ACRONYM: HDF5 files of our own in its layout."""

import json
import os
import subprocess
import sys
import unittest
from unittest import mock

import jsonschema
import numpy as np

import regrasp
from regrasp import _poses, formats
from regrasp_case import RegraspCase

try:
    import h5py
except ImportError:
    h5py = None

PROGRAM = os.path.join(os.path.dirname(os.path.dirname(regrasp.__file__)), "regrasp-convert")

# Rotations by more and less than 90° about several axes, and two by 180°.
QUATERNIONS = np.array([[1, 0, 0, 0], [0.6, 0, 0.8, 0], [0.1, 0.7, -0.5, 0.5], [0, 0, 1, 0], [0, 0, 0, 1]])
QUATERNIONS /= np.linalg.norm(QUATERNIONS, axis=1, keepdims=True)
POSITIONS = np.arange(15.).reshape(5, 3) / 100
CLAIMS = [1, 0, 1, 1, 0]


class MissingH5pyTest(RegraspCase):

    def test_a_missing_module_is_one_line(self):
        with mock.patch.dict(sys.modules, {"h5py": None}):
            with self.assertRaisesRegex(regrasp.InputError, "mug.h5: cannot be read without .* h5py; help: install"):
                formats.read_acronym(self.path("mug.h5"))


@unittest.skipUnless(h5py, "requires h5py")
class AcronymTest(RegraspCase):

    def save(self, name="Mug_1_0.5.h5", without=(), **more):
        """Write a file; `more` replaces or adds members, with two underscores for a slash."""
        poses = np.zeros((5, 4, 4))
        poses[:, :3, :3], poses[:, :3, 3], poses[:, 3, 3] = _poses.matrices(QUATERNIONS), POSITIONS, 1
        content = {"grasps__transforms": poses, "grasps__qualities__flex__object_in_gripper": np.array(CLAIMS),
                   "grasps__qualities__flex__object_motion_during_shaking_linear": np.zeros(5),
                   "gripper__configuration": np.array([0.04]), "gripper__type": "panda",
                   "object__file": "meshes/Mug/1.obj", "object__scale": 0.5, "object__mass": 0.1, **more}
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with h5py.File(self.path(name), "w") as file:
            for key, value in content.items():
                if key not in without:
                    file[key.replace("__", "/")] = value
        return self.path(name)

    def refused(self, words, **more):
        with self.assertRaises(regrasp.InputError) as caught:
            formats.read_acronym(self.save(**more))
        self.assertIn(words, str(caught.exception))
        self.assertNotIn("\n", str(caught.exception))

    def test_poses_claims_object_and_scale_are_read(self):
        grasps = formats.read_acronym(self.save())
        np.testing.assert_allclose(grasps.positions, POSITIONS)
        np.testing.assert_allclose(_poses.matrices(grasps.quaternions), _poses.matrices(QUATERNIONS), atol=1e-15)
        self.assertEqual(grasps.claimed.tolist(), [True, False, True, True, False])
        self.assertEqual((grasps.objects, grasps.scales.tolist()), (["1.obj"] * 5, [0.5] * 5))
        self.assertEqual(grasps.joint_names, ["panda_finger_joint1", "panda_finger_joint2"])
        self.assertEqual((grasps.joints.tolist(), grasps.target.joints.tolist()), ([[0.04, 0.04]] * 5, [[0, 0]] * 5))
        self.assertEqual(grasps.names[1], "Mug_1_0.5_1")
        self.assertEqual(grasps.lost, ["grasps/qualities/flex/object_motion_during_shaking_linear", "object/mass"])
        self.assertIsNone(formats.read_acronym(self.save(without=["grasps__qualities__flex__object_in_gripper"])).claimed)

    def test_lines_fit_the_schema(self):
        self.save("set/Mug_1_0.5.h5")
        done = subprocess.run([sys.executable, PROGRAM, "set", "--palm", "0,0,0,0.70711,0,0,0.70711", "--output",
                               "out.jsonl"], capture_output=True, text=True, check=False, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("docs/hand_grasp.schema.json", encoding="utf-8") as file:
            schema = json.load(file)
        with open(self.path("out.jsonl"), encoding="utf-8") as file:
            lines = [json.loads(line) for line in file]
        self.assertEqual(len(lines), 5)
        for line in lines:
            jsonschema.validate(line, schema)
        self.assertEqual((lines[0]["set"], lines[0]["object"], lines[0]["claimed"], lines[1]["claimed"]),
                         ("acronym", {"file": "1.obj", "scale": 0.5}, True, False))
        np.testing.assert_allclose(lines[0]["palm"]["quaternion"], [np.sqrt(0.5), 0, 0, np.sqrt(0.5)], atol=1e-5)
        self.assertEqual(lines[0]["target"]["joints"], {"panda_finger_joint1": 0, "panda_finger_joint2": 0})

    def test_joints_of_another_gripper_have_no_names(self):
        grasps = formats.read_acronym(self.save(gripper__type="mine", gripper__configuration=np.array([0.1, 0.2, 0.3])))
        self.assertEqual((grasps.joint_names, grasps.joints[4].tolist()), ([], [0.1, 0.2, 0.3]))
        self.refused("gripper/configuration must have 1 or 2 numbers for 'panda', found 3", gripper__configuration=np.zeros(3))

    def test_invalid_files_are_one_line(self):
        mirrored = np.tile(np.diag([1., 1, -1, 1]), (5, 1, 1))
        for words, more in (("grasps/transforms not found", {"without": ["grasps__transforms"]}),
                            ("object/scale not found", {"without": ["object__scale"]}),
                            ("grasps/transforms must be numbers of shape (N, 4, 4)", {"grasps__transforms": np.zeros((5, 3, 4))}),
                            ("grasps/transforms[0] must be a homogeneous matrix", {"grasps__transforms": mirrored}),
                            ("grasps/transforms[0] must be", {"grasps__transforms": np.zeros((5, 4, 4))}),
                            ("must be finite", {"grasps__transforms": np.full((5, 4, 4), np.nan)}),
                            ("object_in_gripper must be numbers of shape (5)",
                             {"grasps__qualities__flex__object_in_gripper": np.zeros(4)}),
                            ("object/scale must be", {"object__scale": -1.0}),
                            ("object/file must be a text", {"object__file": 3}),
                            ("object/file must be a text", {"object__file": "x" * 20000}),
                            ("expected the name of a file", {"object__file": "meshes/"})):
            self.refused(words, **more)
        with open(self.path("text.h5"), "w", encoding="utf-8") as file:
            file.write("text")
        with self.assertRaisesRegex(regrasp.InputError, "text.h5: not an HDF5 file"):
            formats.read_acronym(self.path("text.h5"))
        with self.assertRaises(FileNotFoundError):
            formats.read_acronym(self.path("missing.h5"))

    def test_files_cannot_refer_to_other_files(self):
        other = self.save("other.h5")
        path = self.save("links.h5", without=["object__file"])
        with h5py.File(path, "a") as file:
            file["object/file"] = h5py.ExternalLink(other, "object/file")
        with self.assertRaisesRegex(regrasp.InputError, "object/file not found"):
            formats.read_acronym(path)
        with open(self.path("secret"), "wb") as file:
            file.write(b"\0" * 8)
        path = self.save("stored.h5", without=["object__scale"])
        with h5py.File(path, "a") as file:
            file.create_dataset("object/scale", shape=(1,), dtype="<f8", external=[(self.path("secret"), 0, 8)])
        with self.assertRaisesRegex(regrasp.InputError, "object/scale must be a dataset with values in this file"):
            formats.read_acronym(path)

    def test_huge_shapes_are_refused_before_they_are_read(self):
        path = self.save("huge.h5", without=["grasps__transforms"])
        with h5py.File(path, "a") as file:
            file.create_dataset("grasps/transforms", shape=(10**9, 4, 4), dtype="<f8", chunks=(1000, 4, 4))
        with self.assertRaisesRegex(regrasp.InputError, "grasps/transforms must be numbers of shape"):
            formats.read_acronym(path)


if __name__ == "__main__":
    unittest.main()
