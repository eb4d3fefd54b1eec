"""regrasp-convert writes hand grasps for evaluate: each format, whole folders, bad input."""

import json
import os
import subprocess
import sys
import unittest
import unittest.mock

import numpy as np

import regrasp
from isaac_text import ISAAC
from regrasp import _multigrippergrasp, _poses, convert, formats
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
        entry, = self.hand_grasps()
        self.assertEqual((entry["id"], entry["set"], entry["object"], entry["claimed"]),
                         ("0_0", "dexgraspbench", {"file": "bottle.obj", "scale": 0.06}, False))
        self.assertNotIn("score", entry)
        for part, joint in ((entry, 0.1), (entry["pregrasp"], 0.05), (entry["target"], 0.15)):
            self.assert_pose(part["palm"], PALM)
            self.assertEqual(part["joints"], {"a": joint, "b": 2 * joint})
        # The palm is a point of another body: all configurations move.
        self.convert("0.npy", "--output", "moved.jsonl", "--palm", "0,0,0.5")
        moved, = self.hand_grasps("moved.jsonl")
        place = PALM[:3] + _poses.matrices(PALM[3:]) @ [0, 0, 0.5]
        for part in moved, moved["pregrasp"], moved["target"]:
            np.testing.assert_allclose(part["palm"]["position"], place, atol=1e-15)

    def test_a_squeeze_that_is_not_one_is_reported(self):
        self.save_dexgraspbench("0.npy", squeeze_qpos=0)
        self.assertIn("not converted: squeeze_qpos", self.convert("0.npy", "--output", "out.jsonl"))
        self.assertNotIn("target", self.hand_grasps()[0])

    def test_bodex(self):
        stage = np.concatenate([in_world(PALM), [0.1, 0.2]])
        stages = np.stack([stage, stage + 0, stage + 0])
        stages[:, 7] += [-0.05, 0, 0.05]
        np.save(self.path("cup_grasp.npy"), {"robot_pose": stages[None, None], "obj_pose": OBJECT, "obj_scale": 0.06,
                                             "joint_names": ["a", "b"]})
        self.assertIn("--object", self.convert("cup_grasp.npy", "--output", "out.jsonl", code=2))
        self.convert("cup_grasp.npy", "--object", "cup.obj", "--output", "out.jsonl")
        entry, = self.hand_grasps()
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
        first, second = self.hand_grasps()
        self.assertEqual((first["id"], first["object"], second["object"]["scale"], first["claimed"]),
                         ("sem-Bottle_0", {"file": "sem-Bottle.obj", "scale": 0.08}, 0.1, True))
        self.assertEqual(first["joints"], {"robot0:FFJ3": 0.25})
        self.assert_pose(first["palm"], np.array([1, 2, 3, np.sqrt(0.5), np.sqrt(0.5), 0, 0]))
        # Grasps with the energies of the generator are not validated: no claim.
        self.save_dexgraspnet("raw.npy", E_pen=0.1)
        self.convert("raw.npy", "--output", "raw.jsonl")
        self.assertNotIn("claimed", self.hand_grasps("raw.jsonl")[0])

    def test_isaac_grasp(self):
        with open(self.path("a.yaml"), "w", encoding="utf-8") as file:
            file.write(ISAAC)
        self.convert("a.yaml", "--object", "/x/mug.obj", "--scale", "0.01", "--output", "out.jsonl")
        first, second = self.hand_grasps()
        self.assertEqual((first["id"], first["score"], second["joints"], first["object"]),
                         ("first", 0.5, {"a": 4, "b": 5}, {"file": "mug.obj", "scale": 0.01}))
        self.assertNotIn("claimed", first)

    def multigrippergrasp(self, **more):
        pose = [[0.01, 0.02, 0.3, 0.6, 0, 0.8, 0], [0, 0, 0.1, 1, 0, 0, 0]]
        return {"gripper": "franka_panda", "object_id": "Mug", "pose": pose, "dofs": [[0.02, 0.03], [0.04, 0.04]],
                "result": [1, 0], **more}

    def save_json(self, name, content):
        os.makedirs(os.path.dirname(self.path(name)), exist_ok=True)
        with open(self.path(name), "w", encoding="utf-8") as file:
            json.dump(content, file)

    def test_multigrippergrasp(self):
        self.save_json("panda-Mug.json", self.multigrippergrasp(final_dofs=[[0, 0], [0, 0]]))
        said = self.convert("panda-Mug.json", "--output", "out.jsonl")
        self.assertEqual(said, "regrasp-convert: note: not converted: final_dofs\n")
        first, second = self.hand_grasps()
        self.assertEqual((first["id"], first["set"], first["object"], first["claimed"], second["claimed"]),
                         ("panda-Mug_0", "multigrippergrasp", {"file": "Mug.obj", "scale": 1.0}, True, False))
        self.assertEqual(first["joints"], {"panda_finger_joint1": 0.02, "panda_finger_joint2": 0.03})
        self.assert_pose(first["palm"], PALM)
        self.assertEqual(first["closing"], {"panda_finger_joint1": -1, "panda_finger_joint2": -1})
        # Files of the older version have the time until the object fell.
        older = self.multigrippergrasp(fall_time=[3, 2.9], test_duration=3)
        del older["result"]
        self.save_json("older.json", older)
        self.convert("older.json", "--output", "older.jsonl")
        self.assertEqual([entry["claimed"] for entry in self.hand_grasps("older.jsonl")], [True, False])

    def test_the_joint_order_of_isaac_sim_is_known(self):
        self.save_json("a.json", self.multigrippergrasp(gripper="Allegro", dofs=np.arange(32.).reshape(2, 16).tolist()))
        self.convert("a.json", "--output", "out.jsonl")
        joints = self.hand_grasps()[0]["joints"]
        self.assertEqual((joints["joint_0_0"], joints["joint_12_0"], joints["joint_1_0"], joints["joint_11_0"]), (0, 1, 4, 15))
        self.assertEqual(len(joints), 16)
        self.assertEqual(self.hand_grasps()[0]["closing"], {"joint_12_0": 0.5, "joint_1_0": 1, "joint_5_0": 1, "joint_9_0": 1,
                                                      "joint_14_0": 1})
        for gripper, factors in _multigrippergrasp._CLOSING.items():
            self.assertEqual(len(factors), len(_multigrippergrasp.JOINT_NAMES[gripper]), gripper)
        for names in _multigrippergrasp.JOINT_NAMES.values():
            self.assertEqual(len(set(names)), len(names))
        # The joints of another gripper have no names.
        self.save_json("b.json", self.multigrippergrasp(gripper="mine"))
        self.assertIn("--hand is required", self.convert("b.json", "--output", "x.jsonl", code=2))

    def test_names_with_other_punctuation_are_those_of_the_hand(self):
        self.save_json("a.json", self.multigrippergrasp(gripper="Allegro", dofs=np.arange(32.).reshape(2, 16).tolist()))
        grasps = formats.read_multigrippergrasp(self.path("a.json"))
        hand = unittest.mock.Mock(joint_names=[f"joint_{i}.0" for i in range(16)])
        self.assertEqual(convert._with_names_of(hand, grasps).joint_names[:3], ["joint_0.0", "joint_12.0", "joint_4.0"])
        self.assertEqual(convert._with_names_of(hand, grasps).closing["joint_12.0"], 0.5)
        hand.joint_names = ["other"]
        self.assertEqual(convert._with_names_of(hand, grasps).joint_names, grasps.joint_names)
        hand.joint_names = ["joint_0.0", "joint_0 0"]  # ambiguous
        self.assertEqual(convert._with_names_of(hand, grasps).joint_names, grasps.joint_names)

    def test_hostile_files_of_multigrippergrasp_are_one_line(self):
        for more, words in (({"pose": [[0, 0, 0, 1, 0, 0]] * 2}, "pose must have shape (N, 7)"),
                            ({"pose": [[0, 0, 0, 0, 0, 0, 0]] * 2}, "pose"),
                            ({"pose": [[float("nan")] * 7] * 2}, "must be finite"),
                            ({"pose": [[0, 0, 0, 1, 0, 0, 0]]}, "dofs must have 1 rows"),
                            ({"dofs": [[0.1]] * 2}, "dofs must have 2 joints for 'franka_panda', found 1"),
                            ({"dofs": [[0.1, 0.2], [0.1]]}, "dofs"),
                            ({"result": [1]}, "result must have 2 numbers"),
                            ({"result": "yes"}, "result"), ({"gripper": 3}, "gripper")):
            self.save_json("a.json", self.multigrippergrasp(**more))
            said = self.convert("a.json", "--output", "x.jsonl", code=2)
            self.assertIn(words, said)
            self.assertEqual(said.count("\n"), 1, said)
        for text in ('{"gripper": ', '["gripper"]', '{"gripper": ' + "[" * 100000):
            with open(self.path("a.json"), "w", encoding="utf-8") as file:
                file.write(text)
            self.assertEqual(self.convert("a.json", "--output", "x.jsonl", code=2).count("\n"), 1, text[:20])

    def test_other_json_files_in_a_folder_are_not_read(self):
        self.save_json("set/Mug.json", self.multigrippergrasp())
        self.save_json("set/info.json", {"mass": 1})
        self.convert("set", "--output", "out.jsonl")
        self.assertEqual([entry["id"] for entry in self.hand_grasps()], ["Mug_0", "Mug_1"])

    def test_a_folder_has_a_name_per_grasp(self):
        for name in ("set/cup/0.npy", "set/cup/1.npy", "set/can/0.npy"):
            self.save_dexgraspbench(name)
        self.convert("set", "--output", "out.jsonl")
        self.assertEqual([entry["id"] for entry in self.hand_grasps()], ["can/0_0", "cup/0_0", "cup/1_0"])
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
        self.assertEqual(self.hand_grasps()[0]["id"], "p/0_0")


if __name__ == "__main__":
    unittest.main()
