"""Plans of HiDex, in the documented file format: contacts of fingers and the object's pose."""

import contextlib
import io
import os
import subprocess
import unittest

import numpy as np

import regrasp
from regrasp import _poses, convert, formats
from regrasp_case import PROGRAMS, RegraspCase

NAN = float("nan")
CUBE = "models/cube.obj"  # side 0.06

# Fingers 0 and 1 pinch the cube, 2 and 3 hold it alternately: 3 takes over from 2, then 0 moves.
POINTS = np.array([
    [[.03, 0, .01], [-.03, 0, .01], [0, .03, 0], [NAN] * 3],
    [[.03, 0, .01], [-.03, 0, .01], [NAN] * 3, [0, -.03, 0]],
    [[.03, .01, 0], [-.03, 0, .01], [0, .03, 0], [0, -.03, 0]]])
OUT = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]])
HOLDS = ~np.isnan(POINTS[..., 0])
NORMALS = np.where(HOLDS[..., None], -OUT, 0.)


class HidexTest(RegraspCase):

    def setUp(self):
        super().setUp()
        rng = np.random.default_rng(1)
        # The object moves during the first grasp, which therefore has two rows.
        self.order = [0, 0, 1, 2]
        turns = rng.normal(size=(4, 4))
        self.poses = np.hstack([rng.normal(size=(4, 3)),
                                turns / np.linalg.norm(turns, axis=1, keepdims=True)])

    def rows(self, world=False, scale=1.):
        rows = []
        for grasp, pose in zip(self.order, self.poses):
            points, normals = scale * POINTS[grasp], NORMALS[grasp]
            if world:
                turn = _poses.matrices(pose[3:])
                points, normals = points @ turn.T + pose[:3], normals @ turn.T
                points[~HOLDS[grasp]] = -7777
            rows.append([np.hstack([points, normals]).ravel(), pose[[0, 1, 2, 4, 5, 6, 3]]])
        return rows

    def write(self, lines, name="plan.csv"):
        with open(self.path(name), "w", encoding="utf-8") as file:
            for line in lines:
                file.write(", ".join(repr(float(x)) for x in line) + "\n")
        return self.path(name)

    def assert_read(self, found, tolerance=1e-12):
        np.testing.assert_allclose(found.points, POINTS, atol=tolerance)
        np.testing.assert_array_equal(found.active, HOLDS)
        with self.assertWarnsRegex(DeprecationWarning, "FingerGrasps.holds is deprecated; use active"):
            np.testing.assert_array_equal(found.holds, HOLDS)
        np.testing.assert_allclose(found.normals, np.where(HOLDS[..., None], NORMALS, NAN),
                                   atol=tolerance)

    def test_contacts_in_the_object_s_frame(self):
        found = formats.read_hidex(self.write(np.concatenate(row) for row in self.rows()))
        self.assert_read(found, 0)
        self.assertEqual(found.names, ["row_1", "row_3", "row_4"])
        self.assertEqual(found.lost, ["the object's poses"])

    def test_a_notebook_shows_which_fingers_touch(self):
        page = formats.FingerGrasps(POINTS, NORMALS, ["a", "b", "<c>"], ["poses"])._repr_html_()
        self.assertIn("<td>b</td><td>0, 1, 3</td>", page)
        self.assertIn("not converted: poses", page)
        self.assertNotIn("<c>", page)

    def test_contacts_in_the_world(self):
        path = self.write(np.concatenate(row) for row in self.rows(world=True))
        self.assert_read(formats.read_hidex(path))
        # In the object frame the contacts would move, and every row would be a grasp.
        self.assertEqual(len(formats.read_hidex(path, frame="object")), 4)

    def test_with_the_number_of_fingers_and_contacts_of_the_surroundings(self):
        rows = [np.concatenate([pose, contacts, [1.] * 7 * i])
                for i, (contacts, pose) in enumerate(self.rows())]
        found = formats.read_hidex(self.write([[4], *rows]))
        self.assert_read(found, 0)
        self.assertEqual(found.names[1], "row_4")
        self.assertIn("contacts with the surroundings", found.lost)

    def test_a_file_in_which_all_fingers_touch_does_not_tell(self):
        self.order = [2, 2, 2, 2]
        path = self.write(np.concatenate(row) for row in self.rows())
        self.refuses([path, "frame", '"object"'], formats.read_hidex, path)
        self.assertEqual(len(formats.read_hidex(path, frame="object")), 1)

    def test_the_mesh_may_be_scaled(self):
        path = self.write(np.concatenate(row) for row in self.rows(scale=25))
        self.assert_read(formats.read_hidex(path, mesh_scale=25), 1e-9)
        cube = regrasp.Object.read(CUBE)
        self.refuses(["points[0, 0]", "row_1", "mm from the surface of cube.obj"], formats.read_hidex(path).on, cube)

    def test_what_is_wrong_is_named(self):
        good = [list(np.concatenate(row)) for row in self.rows()]
        nowhere = [list(row) for row in good]
        nowhere[2][-1] = NAN
        turned = [list(row) for row in good]
        turned[1][-4:] = [0, 0, 0, 2]
        for lines, words in [([], ["at least one row"]), ([[4]], ["at least one row"]), ([good[0][:-1]], ["row 1", "30"]),
                             ([good[0], good[1][:-1]], ["row 2", "31", "30"]),
                             ([[2.5], good[0]], ["row 1"]), (nowhere, ["row 3", "pose"]),
                             (turned, ["pose must be a unit quaternion"])]:
            with self.subTest(words=words):
                path = self.write(lines)
                self.refuses([path, *words], formats.read_hidex, path)
        with open(self.path("plan.csv"), "w", encoding="utf-8") as file:
            file.write("1, two, 3\n")
        self.refuses(["row 1", "two'"], formats.read_hidex, self.path("plan.csv"))
        with open(self.path("plan.csv"), "wb") as file:
            file.write(b"\xff\xfe")
        self.refuses(["not a CSV file"], formats.read_hidex, self.path("plan.csv"))

    def test_a_normal_that_points_out_is_named(self):
        cube = regrasp.Object.read(CUBE)
        grasps = formats.FingerGrasps(POINTS, NORMALS, ["a", "b", "c"])
        self.assertEqual(len(grasps.on(cube)), 3)
        turned = NORMALS.copy()
        turned[1, 0] *= -1
        self.refuses(["normals[1, 0]", "grasp b, finger 0", "1 in total"],
                     formats.FingerGrasps(POINTS, turned, ["a", "b", "c"]).on, cube)
        self.refuses(["normals", "(3, 4, 3)"], formats.FingerGrasps, POINTS, NORMALS[:, :3],
                     ["a", "b", "c"])

    def test_switches_lead_from_grasp_to_grasp(self):
        cube = regrasp.Object.read(CUBE)
        grasps = formats.read_hidex(self.write(np.concatenate(row) for row in self.rows())).on(cube)
        plan = grasps.as_plan(cube, mu=0.9)
        steps = [([c["finger"] for c in step["place"]], step["release"]) for step in plan.steps]
        self.assertEqual(steps, [([3], [2]), ([2], []), ([], [0]), ([0], [])])
        report = regrasp.validate(cube, plan)
        self.assertTrue(report.passed, report.failure)
        self.assertFalse(regrasp.validate(cube, plan, mu=0.1).passed)

    def convert(self, *arguments, code=0):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(convert.main(list(arguments)), code, said.getvalue())
        return said.getvalue()

    def test_the_program_makes_a_plan_and_grasps_of_it(self):
        path = self.write(np.concatenate(row) for row in self.rows(world=True))
        said = self.convert(path, "--object", CUBE, "--mu", "0.9", "--output", self.path("plan.json"))
        self.assertEqual(said, "regrasp-convert: note: not converted: the object's poses\n")
        done = subprocess.run([f"{PROGRAMS}/validate", "--object", CUBE, "--plan",
                               self.path("plan.json"), "--frames", "none", "--output", self.path("out")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.convert(path, "--object", CUBE, "--output", self.path("grasps.npz"))
        subprocess.run([f"{PROGRAMS}/validate", "--object", CUBE, "--grasps", self.path("grasps.npz"),
                        "--mu", "0.9", "--output", self.path("out"), "--quiet"], check=True)
        with np.load(self.path("out/verdicts.npz")) as verdicts:
            self.assertEqual(list(verdicts["valid"]), [True] * 3)
        for words, arguments in [(["--mu"], [path, "--object", CUBE, "--output", "x.json"]),
                                 (["--object"], [path, "--output", "x.npz"]),
                                 (["must be .npz or .json"], [path, "--output", "x.yaml"]),
                                 (["the only input"], [path, path, "--object", CUBE, "--output", "x.npz"])]:
            said = self.convert(*arguments, code=2)
            self.assertEqual(said.count("\n"), 1)
            for word in words:
                self.assertIn(word, said)
        self.assertFalse(os.path.exists("x.npz"))


if __name__ == "__main__":
    unittest.main()
