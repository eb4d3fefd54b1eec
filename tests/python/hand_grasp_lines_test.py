"""regrasp-convert writes hand grasps for evaluate: each format, whole folders, bad input."""

import json
import os
import subprocess
import sys
import unittest

import jsonschema
import numpy as np

import regrasp
from isaac_text import ISAAC
from regrasp import _poses, formats
from regrasp_case import RegraspCase

PROGRAM = os.path.join(os.path.dirname(os.path.dirname(regrasp.__file__)), "regrasp-convert")

# A pose of the object in the world, and the palm in the frame of the object, as position and quaternion w, x, y, z.
OBJECT = np.array([0.3, -0.2, 0.1, 0.5, 0.5, -0.5, 0.5])
PALM = np.array([0.01, 0.02, 0.3, 0.6, 0, 0.8, 0])


def in_world(palm):
    """Return a palm pose in the world in which the object has the pose OBJECT."""
    return np.concatenate([_poses.matrices(OBJECT[3:]) @ palm[:3] + OBJECT[:3], _poses.product(OBJECT[3:], palm[3:])])


class HandGraspLinesTest(RegraspCase):

    def convert(self, *arguments, code=0):
        done = subprocess.run([sys.executable, PROGRAM, *arguments], capture_output=True, text=True, check=False,
                              cwd=self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stderr

    def lines(self, name="out.jsonl"):
        with open("docs/hand_grasp.schema.json", encoding="utf-8") as file:
            schema = json.load(file)
        with open(self.path(name), encoding="utf-8") as file:
            entries = [json.loads(line) for line in file]
        for entry in entries:
            jsonschema.validate(entry, schema)
        return entries

    def assert_pose(self, pose, expected):
        np.testing.assert_allclose(pose["position"], expected[:3], atol=1e-15)
        np.testing.assert_allclose(pose["quaternion"], expected[3:], atol=1e-15)

    def save_dexgraspbench(self, name, **more):
        def sequence(joint):
            return np.concatenate([in_world(PALM), [joint, 2 * joint]])
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        np.save(self.path(name), {"grasp_qpos": sequence(0.1), "pregrasp_qpos": sequence(0.05),
                                  "squeeze_qpos": sequence(0.15), "obj_pose": OBJECT, "obj_scale": 0.06,
                                  "obj_path": "assets/bottle", "joint_names": ["a", "b"], **more})

    def test_dexgraspbench(self):
        self.save_dexgraspbench("0.npy", succ_flag=np.bool_(False))
        said = self.convert("0.npy", "--output", "out.jsonl")
        self.assertEqual(said, "")
        entry, = self.lines()
        self.assertEqual((entry["id"], entry["set"], entry["object"], entry["claimed"]),
                         ("0_0", "dexgraspbench", {"file": "bottle.obj", "scale": 0.06}, False))
        self.assertNotIn("score", entry)
        for part, joint in ((entry, 0.1), (entry["pregrasp"], 0.05), (entry["target"], 0.15)):
            self.assert_pose(part["palm"], PALM)
            self.assertEqual(part["joints"], {"a": joint, "b": 2 * joint})
        # The palm is a point of another body: all configurations move.
        self.convert("0.npy", "--output", "moved.jsonl", "--palm", "0,0,0.5")
        moved, = self.lines("moved.jsonl")
        place = PALM[:3] + _poses.matrices(PALM[3:]) @ [0, 0, 0.5]
        for part in moved, moved["pregrasp"], moved["target"]:
            np.testing.assert_allclose(part["palm"]["position"], place, atol=1e-15)

    def test_a_squeeze_that_is_not_one_is_reported(self):
        self.save_dexgraspbench("0.npy", squeeze_qpos=0)
        self.assertIn("not converted: squeeze_qpos", self.convert("0.npy", "--output", "out.jsonl"))
        self.assertNotIn("target", self.lines()[0])

    def test_bodex(self):
        stage = np.concatenate([in_world(PALM), [0.1, 0.2]])
        stages = np.stack([stage, stage + 0, stage + 0])
        stages[:, 7] += [-0.05, 0, 0.05]
        np.save(self.path("cup_grasp.npy"), {"robot_pose": stages[None, None], "obj_pose": OBJECT, "obj_scale": 0.06,
                                             "joint_names": ["a", "b"]})
        self.assertIn("--object", self.convert("cup_grasp.npy", "--output", "out.jsonl", code=2))
        self.convert("cup_grasp.npy", "--object", "cup.obj", "--output", "out.jsonl")
        entry, = self.lines()
        self.assertEqual((entry["set"], entry["object"]["file"]), ("bodex", "cup.obj"))
        np.testing.assert_allclose([part["joints"]["a"] for part in (entry["pregrasp"], entry, entry["target"])],
                                   [0.05, 0.1, 0.15])

    def save_dexgraspnet(self, name, **more):
        qpos = {"WRJTx": 1., "WRJTy": 2., "WRJTz": 3., "WRJRx": np.pi / 2, "WRJRy": 0., "WRJRz": 0., "robot0:FFJ3": 0.25}
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        np.save(self.path(name), [{"qpos": qpos, "scale": 0.08, **more}, {"qpos": qpos, "scale": 0.1, **more}])

    def test_dexgraspnet(self):
        self.save_dexgraspnet("sem-Bottle.npy")
        self.assertEqual(self.convert("sem-Bottle.npy", "--output", "out.jsonl"), "")
        first, second = self.lines()
        self.assertEqual((first["id"], first["object"], second["object"]["scale"], first["claimed"]),
                         ("sem-Bottle_0", {"file": "sem-Bottle.obj", "scale": 0.08}, 0.1, True))
        self.assertEqual(first["joints"], {"robot0:FFJ3": 0.25})
        self.assert_pose(first["palm"], np.array([1, 2, 3, np.sqrt(0.5), np.sqrt(0.5), 0, 0]))
        # Grasps with the energies of the generator are not validated: no claim.
        self.save_dexgraspnet("raw.npy", E_pen=0.1)
        self.convert("raw.npy", "--output", "raw.jsonl")
        self.assertNotIn("claimed", self.lines("raw.jsonl")[0])

    def test_isaac_grasp(self):
        with open(self.path("a.yaml"), "w", encoding="utf-8") as file:
            file.write(ISAAC)
        self.convert("a.yaml", "--object", "/x/mug.obj", "--scale", "0.01", "--output", "out.jsonl")
        first, second = self.lines()
        self.assertEqual((first["id"], first["score"], second["joints"], first["object"]),
                         ("first", 0.5, {"a": 4, "b": 5}, {"file": "mug.obj", "scale": 0.01}))
        self.assertNotIn("claimed", first)

    def test_a_folder_has_a_name_per_grasp(self):
        for name in ("set/cup/0.npy", "set/cup/1.npy", "set/can/0.npy"):
            self.save_dexgraspbench(name)
        self.convert("set", "--output", "out.jsonl")
        self.assertEqual([entry["id"] for entry in self.lines()], ["can/0_0", "cup/0_0", "cup/1_0"])
        self.assertIn("found twice", self.convert("set/cup/0.npy", "set/can/0.npy", "--output", "x.jsonl", code=2))
        self.assertFalse(os.path.exists(self.path("x.jsonl")))
        os.makedirs(self.path("empty"))
        self.assertIn("no grasps found", self.convert("empty", "--output", "x.jsonl", code=2))

    def test_joints_without_names_require_a_hand(self):
        self.save_dexgraspbench("0.npy", joint_names=[])
        said = self.convert("0.npy", "--output", "x.jsonl", code=2)
        self.assertIn("--hand is required, because the joints have no names", said)
        self.assertEqual(said.count("\n"), 1)

    def test_python_writes_them_too(self):
        self.save_dexgraspbench("0.npy")
        grasps = formats.read_dexgraspbench(self.path("0.npy"))
        formats.write_hand_grasps(self.path("out.jsonl"), [("p/", grasps)])
        self.assertEqual(self.lines()[0]["id"], "p/0_0")


if __name__ == "__main__":
    unittest.main()
