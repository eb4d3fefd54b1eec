"""Randomly damaged third-party files are read or rejected in one line, whatever their content."""

import os
import unittest

import numpy as np

import regrasp
from regrasp import formats
from isaac_text import ISAAC
from regrasp_case import RegraspCase

POSE = "<transform><fullTransform>(+1 +0 +0 +0)[+1 +2 +3]</fullTransform></transform>"

FILES = {
    "yaml": (formats.read_isaac_grasp, ISAAC.encode()),
    "xml": (formats.read_graspit, (
        f"<?xml version='1.0' ?><world><graspableBody>{POSE}</graspableBody><robot><dofValues>+0.1 +0.2 "
        f"</dofValues>{POSE}</robot></world>").encode()),
    "csv": (formats.read_hidex, b".03, 0, .01, -1, 0, 0, nan, nan, nan, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1\n" * 3),
    "npz": (formats.read_trajectory, None),
    "npy": (formats.read_dexgraspbench, None),
}

# Words with a meaning in one of the formats.
WORDS = [b"{", b"[", b"]", b"~", b"null", b"!!", b"1e999", b"nan", b"&a ", b"*a", b"<a>", b"0x", b"1_0", b":",
         b",", b"\n", b"\xff"]


def damaged(data, rng):
    """Return data with one to three changes: a flipped bit, a gap, letters or a word."""
    data = bytearray(data)
    for _ in range(rng.integers(1, 4)):
        at = int(rng.integers(len(data)))
        match rng.integers(4):
            case 0: data[at] ^= 1 << int(rng.integers(8))
            case 1: del data[at:at + int(rng.integers(1, 8))]
            case 2: data[at:at] = rng.integers(32, 127, rng.integers(1, 5), dtype=np.uint8).tobytes()
            case _: data[at:at] = WORDS[rng.integers(len(WORDS))]
    return bytes(data)


class DamagedFilesTest(RegraspCase):

    def whole(self, ending):
        path = self.path("whole." + ending)
        if ending == "npz":
            np.savez(path, time_s=np.arange(2.), joint_names=["a"], joints=np.zeros((2, 1)),
                     object=[[0, 0, 0, 1., 0, 0, 0]] * 2, control_names=["b"], controls=np.zeros((2, 1)))
        elif ending == "npy":
            np.save(path, {"obj_pose": np.array([0, 0, 0, 1., 0, 0, 0]), "joint_names": ["a", "b"],
                           "grasp_qpos": np.array([[0, 0, 0, 1., 0, 0, 0, 3, 4]])})
        else:
            with open(path, "wb") as file:
                file.write(FILES[ending][1])
        with open(path, "rb") as file:
            return file.read()

    def test_damaged_files_are_read_or_refused(self):
        rng = np.random.default_rng(7)
        for ending, (reader, _) in FILES.items():
            data, path = self.whole(ending), self.path("damaged." + ending)
            self.assertTrue(len(reader(self.path("whole." + ending))))
            refused = 0
            for _ in range(400):
                changed = damaged(data, rng)
                with open(path, "wb") as file:
                    file.write(changed)
                with self.subTest(ending=ending, data=changed):
                    try:
                        reader(path)
                    except regrasp.InputError as error:
                        self.assertNotIn("\n", str(error))
                        self.assertTrue(str(error).startswith((path, "frame: ")), str(error))
                        refused += 1
            self.assertGreater(refused, 100, ending)
            self.assertLess(refused, 400, ending)

    def test_what_is_no_file_is_told(self):
        os.mkdir(self.path("folder"))
        for reader, _ in FILES.values():
            for name in ("none", "folder"):
                with self.assertRaises((OSError, regrasp.InputError)) as caught:
                    reader(self.path(name))
                self.assertIn(name, str(caught.exception))


if __name__ == "__main__":
    unittest.main()
