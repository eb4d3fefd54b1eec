"""Malicious files are rejected in one line, before they affect memory, time or the interpreter."""

import os
import pickle
import struct
import unittest

import numpy as np

import regrasp
from regrasp import formats
from isaac_text import ISAAC
from regrasp_case import RegraspCase

POSE = np.array([0, 0, 0, 1., 0, 0, 0])
ROW = ".03,0,.01,-1,0,0,nan,nan,nan,0,0,0,0,0,0,0,0,0,1\n"


def nested(times):
    """Return nested lists of nine references to the same list."""
    value = ["x"]
    for _ in range(times):
        value = [value] * 9
    return value


def nested_yaml(times):
    lines = ["a0: &a0 [x, x, x, x, x, x, x, x, x]"]
    for i in range(times):
        lines.append(f"a{i + 1}: &a{i + 1} [" + ", ".join([f"*a{i}"] * 9) + "]")
    return "\n".join(lines) + "\n"


class _Call:
    """Object that is pickled as a function call."""

    def __init__(self, function, *arguments):
        self._reduced = function, arguments

    def __reduce__(self):
        return self._reduced


class HostileFilesTest(RegraspCase):

    def file(self, name, content):
        path = self.path(name)
        with open(path, "wb") as file:
            file.write(content if isinstance(content, bytes) else content.encode())
        return path

    def pickled(self, value):
        """Return an NPY file of objects, one of which is this value."""
        header = b"{'descr':'|O','fortran_order':False,'shape':()}\n"
        return self.file("a.npy", b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header
                         + pickle.dumps(value))

    def test_yaml(self):
        whole = formats.read_isaac_grasp(self.file("a.yaml", ISAAC))
        self.assertGreater(len(whole), 0)
        for text, words in [
                ("[" * 20000, ["nested"]), (nested_yaml(12) + ISAAC, ["more than"]),
                ("&a {format: isaac_grasp, grasps: *a}", ["nested"]), (ISAAC + "x: 2001-99-99\n", ["month"]),
                (ISAAC + "x: 0x_\n", ["not a YAML file"]), (ISAAC + "x: !!int q\n", ["not a YAML file"]),
                (ISAAC + "x: !!timestamp q\n", ["not a YAML file"]), (ISAAC + "x: " + "9" * 5000, ["not a YAML file"]),
                (ISAAC + "format: isaac_grasp\n", ["'format'", "repeated", "line"]),
                ("format: " + "x" * 100000, ["xxx..."])]:
            self.refuses(["a.yaml", *words], formats.read_isaac_grasp, self.file("a.yaml", text))

    def test_aliases_that_stand_for_little_are_read(self):
        text = ("format: isaac_grasp\ngrasps:\n"
                "  a: {position: &p [0, 0, 1e-05], orientation: {w: 1, xyz: [0, 0, 0]}}\n"
                "  b: {position: *p, orientation: {w: 1e0, xyz: [0, 0, 0]}}\n")
        grasps = formats.read_isaac_grasp(self.file("a.yaml", text))
        self.assertEqual(grasps.positions.tolist(), [[0, 0, 1e-5]] * 2)

    def test_pickles(self):
        good = {"grasp_qpos": np.array([[0, 0, 0, 1., 0, 0, 0, 3, 4]]), "obj_pose": POSE}
        self.assertEqual(len(formats.read_dexgraspbench(self.pickled(good))), 1)
        itself = {}
        itself["grasp_qpos"] = [itself]
        array = np.empty(1, object)
        array[0] = nested(14)
        rebuild = np.core.multiarray._reconstruct
        for value, words in [
                (_Call(os.mkdir, self.path("made")), ["mkdir"]),
                ({**good, "joint_names": nested(14)}, ["more than"]),
                ({**good, "joint_names": array}, ["more than"]),
                ({**good, "grasp_qpos": nested(14)}, ["more than"]),
                (itself, ["nested"]),
                ({**good, "grasp_qpos": _Call(rebuild, np.ndarray, (2 * 10**9,), b"d")},
                 ["NumPy did not write"]),
                ({**good, "grasp_qpos": _Call(np.ndarray, (2 * 10**9,))}, ["no arguments"])]:
            self.refuses(["a.npy", *words], formats.read_dexgraspbench, self.pickled(value))
        self.assertFalse(os.path.exists(self.path("made")))

    def test_xml_in_an_encoding_that_is_none(self):
        for encoding in ("foo", "utf-7"):
            path = self.file("a.xml", f"<?xml version='1.0' encoding='{encoding}'?><world/>")
            self.refuses(["a.xml", "not an XML file"], formats.read_graspit, path)

    def test_csv(self):
        self.assertEqual(len(formats.read_hidex(self.file("a.csv", ROW))), 1)
        for text, words in [("nan\n" + ROW, ["row 1", "nan"]), ("inf\n" + ROW, ["row 1", "inf"]),
                            (ROW + ROW.replace(".03", "inf"), ["row 2", "infinite"]),
                            ("a" * 10000 + "," + ROW, ["row 1", "aaa..."])]:
            self.refuses(["a.csv", *words], formats.read_hidex, self.file("a.csv", text))

    def test_trajectories(self):
        arrays = {"time_s": np.arange(2.), "joint_names": ["a"], "joints": np.zeros((2, 1)),
                  "object": [POSE] * 2, "control_names": [], "controls": np.zeros((2, 0))}
        path, out = self.path("a.npz"), self.path("a.mcap")

        def convert(**others):
            np.savez(path, **{**arrays, **others})
            formats.write_mcap(out, formats.read_trajectory(path))
        convert()
        os.remove(out)
        for others, words in [({"time_s": np.array([0, 3e9])}, ["times", "3e+09"]),
                              ({"time_s": np.array([0, 1e300])}, ["times"]),
                              ({"joint_names": ["a\0b"]}, ["joint_names", "printable"]),
                              ({"joint_names": [""]}, ["joint_names", "''"])]:
            self.refuses(words, convert, **others)
            self.assertFalse(os.path.exists(out))
        self.refuses(["a.npz", "ZIP"], formats.read_trajectory, self.file("a.npz", b""))


if __name__ == "__main__":
    unittest.main()
