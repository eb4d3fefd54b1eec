"""`validate --grasps`, from NPZ to NPZ."""

import json
import os
import subprocess
import unittest

import numpy as np

import regrasp
from regrasp_case import PROGRAMS, RegraspCase


def on_cube(count, contacts, seed):
    """Return grasps on the faces of models/cube.obj, whose side is 0.06."""
    rng = np.random.default_rng(seed)
    face = rng.integers(0, 6, size=(count, contacts))
    axis, side = face % 3, np.where(face < 3, 1., -1.)
    points = rng.uniform(-.029, .029, size=(count, contacts, 3))
    normals = np.zeros_like(points)
    grasp, contact = np.indices((count, contacts))
    points[grasp, contact, axis] = .03 * side
    normals[grasp, contact, axis] = -side
    return points, normals


class GraspFilesTest(RegraspCase):

    def setUp(self):
        super().setUp()
        self.points, self.normals = on_cube(400, 4, 1)

    def judge(self, *options, code, object="models/cube.obj", save=np.savez, **arrays):
        save(self.path("grasps.npz"), **arrays)
        before = os.path.exists(self.path("out/verdicts.npz"))
        done = subprocess.run(
            [f"{PROGRAMS}/validate", "--object", object, "--grasps", self.path("grasps.npz"),
             "--output", self.path("out"), *options], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        if code == 2:
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertEqual(os.path.exists(self.path("out/verdicts.npz")), before)
            return done.stderr
        self.said = done.stdout
        with np.load(self.path("out/verdicts.npz")) as verdicts:
            return {name: verdicts[name] for name in verdicts}

    def test_verdicts_are_those_of_the_module(self):
        found = self.judge("--mu", "0.5", "--compute", "required-angle", code=1, points=self.points,
                           normals=self.normals)
        expected = regrasp.force_closure(self.points, self.normals, mu=0.5, required_angle=True)
        self.assertEqual(found["valid"].dtype, bool)
        self.assertTrue(expected.is_force_closure.any() and not expected.is_force_closure.all())
        np.testing.assert_array_equal(found["valid"], expected.is_force_closure)
        np.testing.assert_array_equal(found["required_angle_deg"], expected.required_angle_deg)
        self.assertNotIn("quality", found)
        self.assertIn(f"pass                     {expected.is_force_closure.sum()}\n", self.said)
        words = found["reasons"][found["reason"].astype(int)]
        np.testing.assert_array_equal(words == "", found["valid"])
        self.assertEqual(set(words[~found["valid"]]), {"not-force-closure"})

    def test_verdicts_are_those_on_single_grasps(self):
        found = self.judge("--mu", "0.5", "--compute", "quality", code=1, points=self.points[:12],
                           normals=self.normals[:12])
        for i in range(12):
            report = self.report_of(self.points[i], self.normals[i], "--mu", "0.5")
            self.assertEqual(report["steps"][0]["force_closure"]["holds"], found["valid"][i])
            if found["valid"][i]:
                self.assertEqual(report["grasp"]["quality"], found["quality"][i])

    def test_verdicts_have_the_format_version_and_tell_force_closure_from_the_verdict(self):
        points, normals = self.points[:40], self.normals[:40]
        found = self.judge("--mu", "0.4", code=1, points=points, normals=normals)
        self.assertEqual(found["format_version"], 2)
        self.assertNotIn("holds", found)
        np.testing.assert_array_equal(found["valid"], found["is_force_closure"])
        replayed = self.judge("--mu", "0.4", "--disturbance", "0.02", "--replay", "points", code=1, points=points,
                              normals=normals)
        np.testing.assert_array_equal(replayed["is_force_closure"], found["is_force_closure"])
        lost = replayed["is_force_closure"] & ~replayed["valid"]
        self.assertTrue(lost.any() and replayed["valid"].any())
        self.assertFalse((replayed["valid"] & ~replayed["is_force_closure"]).any())

    def test_a_mask_of_version_1_is_read(self):
        mask = np.random.default_rng(2).uniform(size=(400, 4)) < 0.8
        arrays = {"points": self.points, "normals": self.normals}
        margin = self.judge("--mu", "0.9", code=1, active=mask, **arrays)["margin"]
        for old in ({"holds": mask}, {"holds": mask, "format_version": np.array(1)},
                    {"active": mask, "format_version": np.array(2)},
                    # In version 2 an array named holds is ignored.
                    {"active": mask, "holds": ~mask, "format_version": np.array(2)}):
            np.testing.assert_array_equal(self.judge("--mu", "0.9", code=1, **old, **arrays)["margin"], margin)
        # Negative controls: without the mask the margins differ, and also if the mask is ignored.
        for other in ({}, {"holds": mask, "format_version": np.array(2)}):
            again = self.judge("--mu", "0.9", code=1, **other, **arrays)["margin"]
            self.assertFalse(np.array_equal(again, margin))
        for wrong, words in (({"active": mask, "holds": mask}, "active: cannot be used with holds"),
                             ({"format_version": np.array(3)}, "format_version: not supported, expected 1 or 2, found 3"),
                             ({"format_version": np.array([1, 2])}, "found an array of shape (2)")):
            self.assertIn(words, self.judge("--mu", "0.9", code=2, **wrong, **arrays))

    def test_contacts_that_are_not_active_do_not_count(self):
        active = np.random.default_rng(2).uniform(size=(400, 4)) < 0.8
        active[5] = False
        found = self.judge("--mu", "0.9", code=1, points=self.points, normals=self.normals, active=active)
        counts = active.sum(axis=1)
        self.assertTrue({0, 2, 3, 4} <= set(counts))
        for k in (1, 2, 3, 4):
            chosen = np.flatnonzero(counts == k)
            kept = active[chosen]
            alone = self.judge("--mu", "0.9", code=1, points=self.points[chosen][kept].reshape(-1, k, 3),
                               normals=self.normals[chosen][kept].reshape(-1, k, 3))
            for name in ("valid", "is_force_closure", "margin", "reason"):
                np.testing.assert_array_equal(found[name][chosen], alone[name])
        self.assertTrue(found["valid"][counts == 3].any())
        self.assertFalse(found["valid"][counts == 0].any())
        words = found["reasons"][found["reason"].astype(int)]
        self.assertEqual(set(words[counts == 0]), {"not-force-closure"})
        # The point of an inactive contact is ignored, if it is a number.
        points = np.where(active[..., None], self.points, 7)
        again = self.judge("--mu", "0.9", code=1, points=points, normals=self.normals, active=active)
        np.testing.assert_array_equal(again["margin"], found["margin"])
        all_active = self.judge("--mu", "0.9", code=1, points=self.points, normals=self.normals,
                              active=np.ones((400, 4), bool))
        self.assertFalse(np.array_equal(all_active["valid"], found["valid"]))

    def test_a_contact_off_the_surface_is_named_with_its_distance_and_the_tolerance(self):
        points = self.points.copy()
        for grasp, contact in ((7, 2), (7, 3), (3, 1), (11, 0)):
            axis = np.flatnonzero(self.normals[grasp, contact])[0]
            points[grasp, contact, axis] *= 1 + 2e-5 * (1 + contact)  # at 30 mm from the centre
        arrays = {"points": points, "normals": self.normals}
        self.judge("--mu", "0.5", code=1, **arrays)
        line, = [line for line in self.said.splitlines() if line.startswith("off-surface: ")]
        self.assertIn("grasp 3, contact 1 (the first): off the surface, expected at most 0.0001 % of the object's "
                      "diameter, ", line)
        self.assertIn("(0.0000012 in the object file's unit)", line)
        # The index is that in the file, regardless of inactive contacts.
        active = np.ones((400, 4), bool)
        active[3, 1] = active[7, 0] = active[7, 2] = False
        self.judge("--mu", "0.5", code=1, active=active, **arrays)
        self.assertIn("grasp 7, contact 3 (the first): off the surface, ", self.said)
        # Negative control: on the surface there is no such line.
        self.judge("--mu", "0.5", code=1, points=self.points, normals=self.normals)
        self.assertNotIn("off-surface", self.said)

    def test_single_precision_three_metres_from_the_origin_is_on_the_surface(self):
        cube = regrasp.Object.read("models/cube.obj")
        offset = np.array([3, -2.5, 0.7])
        far = self.path("far.obj")
        regrasp.Object.from_arrays(cube.vertices + offset, cube.triangles, name="far.obj").write(far)
        points = (self.points + offset).astype(np.float32)
        found = self.judge("--mu", "0.5", code=1, object=far, points=points,
                           normals=self.normals.astype(np.float32))
        near = self.judge("--mu", "0.5", code=1, points=self.points, normals=self.normals)
        self.assertNotIn("off-surface", found["reasons"][found["reason"].astype(int)])
        np.testing.assert_array_equal(found["valid"], near["valid"])
        # Negative control: a point 0.1 mm off is rejected, with the reason for the tolerance.
        points[5, 1] += 1e-4 * -self.normals[5, 1].astype(np.float32)
        self.judge("--mu", "0.5", code=1, object=far, points=points, normals=self.normals)
        self.assertIn("grasp 5, contact 1 (the first): ", self.said)
        self.assertIn("float32", self.said)

    def test_replays_are_those_of_single_grasps(self):
        chosen = np.flatnonzero(self.judge("--mu", "0.4", code=1, points=self.points)["valid"])[:12]
        points, normals = self.points[chosen], self.normals[chosen]
        points[3, 1] += 1
        options = ["--mu", "0.4", "--disturbance", "0.02"]
        found = self.judge(*options, "--replay", "points", code=1, points=points, normals=normals)
        words = found["reasons"][found["reason"].astype(int)]
        self.assertEqual(words[3], "off-surface")
        np.testing.assert_array_equal(found["replayed"], np.arange(12) != 3)
        self.assertEqual(set(found["valid"]), {True, False})
        for i in np.flatnonzero(found["replayed"])[:6]:
            report = self.report_of(points[i], normals[i], *options)
            self.assertEqual(report["verdict"] == "pass", found["valid"][i])
            self.assertEqual(report["steps"][0]["reason"] or "", words[i])
        # All grasps on the object pass if there is only the analysis.
        self.assertEqual(self.judge("--mu", "0.4", code=1, points=points)["valid"].sum(), 11)

    def report_of(self, points, normals, *options):
        contacts = [{"point": p, "normal": n} for p, n in zip(points.tolist(), normals.tolist())]
        with open(self.path("grasp.json"), "w", encoding="utf-8") as file:
            json.dump({"format": "regrasp-grasp", "version": 1, "contacts": contacts}, file)
        subprocess.run([f"{PROGRAMS}/validate", "--object", "models/cube.obj", "--grasp",
                        self.path("grasp.json"), "--frames", "none", "--quiet", "--output",
                        self.path("single"), *options], check=False, capture_output=True)
        with open(self.path("single/report.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_what_cannot_be_held_is_told_apart(self):
        points, normals = self.points.copy(), self.normals.copy()
        points[3, 1] += 1
        normals[5, 2] *= -1
        points[7, 3], normals[7, 3] = points[7, 0], normals[7, 0]
        found = self.judge("--mu", "9", code=1, points=points, normals=normals)
        words = found["reasons"][found["reason"].astype(int)]
        self.assertEqual(list(words[[3, 5, 7]]),
                         ["off-surface", "wrong-normal", "coincident-fingers"])
        self.assertTrue(np.isnan(found["margin"][[3, 5, 7]]).all())
        self.assertFalse(found["valid"][[3, 5, 7]].any())

    def test_normals_may_be_left_out_and_files_be_packed(self):
        found = self.judge("--mu", "0.5", code=1, points=self.points, normals=self.normals)
        for save, arrays in [(np.savez, {"points": self.points}),
                             (np.savez_compressed, {"points": np.asfortranarray(self.points)}),
                             (np.savez_compressed, {"points": self.points.astype(">f8"),
                                                    "normals": self.normals.astype("i1"),
                                                    "labels": np.array(["a", "b"])})]:
            again = self.judge("--mu", "0.5", code=1, save=save, **arrays)
            np.testing.assert_array_equal(again["margin"], found["margin"])

    def test_all_that_pass_are_a_pass(self):
        valid = self.judge("--mu", "0.5", code=1, points=self.points)["valid"]
        self.judge("--friction-angle", "26.6", code=0, points=self.points[valid])
        self.assertTrue(self.said.endswith("verdict: pass\n"))
        # A file without grasps does not pass.
        self.assertIn("at least one grasp", self.judge("--mu", "0.5", code=2, points=np.zeros((0, 4, 3))))

    def test_grasps_in_the_plane(self):
        points = np.array([[[-1, 0.], [1, 0.]], [[-1, 0.9], [1, -0.9]]])
        found = self.judge("--mu", "0.5", code=1, object=self.square(), points=points)
        self.assertEqual(list(found["valid"]), [True, False])

    def square(self):
        with open(self.path("square.wkt"), "w", encoding="utf-8") as file:
            file.write("POLYGON((-1 -1, 1 -1, 1 1, -1 1, -1 -1))")
        return self.path("square.wkt")

    def test_files_that_are_wrong_are_named(self):
        broken = self.points.copy()
        broken[2, 1, 0] = np.nan
        for words, options, arrays in [
                (["points", "(N, k, 3)"], [], {"normals": self.normals}),
                (["points", "(N, k, 3)", "(400, 12)"], [], {"points": self.points.reshape(400, 12)}),
                (["normals", "(400, 4, 3)", "(400, 3, 3)"], [],
                 {"points": self.points, "normals": self.normals[:, :3]}),
                (["points[2, 1, 0]", "must be finite, found "], [], {"points": broken}),
                (["points", "objects"], [], {"points": np.array([None])}),
                (["points", "U1"], [], {"points": np.array(["x"])}),
                (["active", "(400, 4)", "(400, 3)"], [],
                 {"points": self.points, "active": np.ones((400, 3), bool)}),
                (["--replay hand", "plan"], ["--replay", "hand"], {"points": self.points}),
                (["--disturbance", "--replay points"], ["--disturbance", "0.1"], {"points": self.points}),
                (["--trajectory", "--grasps"], ["--trajectory", self.path("t.csv")],
                 {"points": self.points})]:
            said = self.judge("--mu", "0.5", *options, code=2, **arrays)
            for word in words:
                self.assertIn(word, said)
        self.assertIn("--mu", self.judge(code=2, points=self.points))
        with open(self.path("grasps.npz"), "wb") as file:
            file.write(b"PK\x03\x04 nothing")
        self.assertIn("not a ZIP archive", self.judge("--mu", "1", code=2, save=lambda *_: None))


if __name__ == "__main__":
    unittest.main()
