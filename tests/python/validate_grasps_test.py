"""validate_grasps: grasps by a whole hand from Python, compared with the program evaluate."""

import json
import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import regrasp
from regrasp.formats import HandConfigurations, HandGrasps, write_hand_grasps
from regrasp_case import RegraspCase

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "apps"))
import hand_grasp_files  # noqa: E402

JOINTS = ["left_slide", "right_slide"]


class ValidateGraspsTest(RegraspCase):
    @classmethod
    def setUpClass(cls):
        cls.files = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.files.cleanup)
        hand_grasp_files.write_hand(cls.files.name)
        cls.hand = os.path.join(cls.files.name, "gripper.json")
        cls.box = regrasp.Object.read(os.path.join(cls.files.name, "objects/box.obj"))

    def grasps(self, *positions, **more):
        count = len(positions)
        return HandGrasps(np.tile([0, 0, -0.05], (count, 1)), np.tile([1., 0, 0, 0], (count, 1)), JOINTS,
                          np.repeat(np.array(positions, dtype=float), 2).reshape(count, 2),
                          [f"g{i}" for i in range(count)], np.ones(count), objects=["box.obj"] * count, **more)

    def closed(self, count):
        """Return targets inside the box for grasps."""
        return HandConfigurations(np.tile([0, 0, -0.05], (count, 1)), np.tile([1., 0, 0, 0], (count, 1)),
                                  np.full((count, 2), 0.04))

    def test_known_grasps_have_their_verdicts(self):
        found = regrasp.validate_grasps(self.box, self.hand, self.grasps(hand_grasp_files.TOUCH, 0., 0.03))
        self.assertEqual(found.passed.tolist(), [True, False, False])
        self.assertEqual(found.reasons, ["", "no-contact", "penetrates"])
        self.assertEqual(found.protocol_reasons.tolist(), [[""], ["no-contact"], ["penetrates"]])
        np.testing.assert_allclose(found.distance_mm, [0, 25, -5], atol=0.06)
        contacts = dict(zip(found.links, found.contacts.T.tolist()))
        self.assertEqual(contacts, {"palm": [0, 0, 0], "left": [4, 0, 4], "right": [4, 0, 4]})
        self.assertGreater(found.quality[0], 0)
        self.assertTrue(np.isnan(found.quality[1:]).all())
        self.assertTrue(np.isnan(found.held_s).all())
        self.assertIn("1 of 3 grasps pass", found._repr_html_())

    def test_values_are_those_of_the_program(self):
        grasps = self.grasps(hand_grasp_files.TOUCH, 0., 0.0249, target=self.closed(3))
        protocols = ("fall", "analytic", "disturbance", "dexgraspbench")
        found = regrasp.validate_grasps(self.box, self.hand, grasps, protocols=protocols, mu=0.5, mass_kg=0.2)
        write_hand_grasps(os.path.join(self.files.name, "g.jsonl"), [("", grasps)])
        program = os.path.join(os.environ["REGRASP_PROGRAMS"], "evaluate")
        subprocess.run([program, "--grasps", "g.jsonl", "--hand", "gripper.json", "--object", "objects", "-q", "--mu", "0.5",
                        "--mass", "0.2", "--protocol", ",".join(protocols), "-o", "r.jsonl", "--restart"],
                       cwd=self.files.name, check=False)
        with open(os.path.join(self.files.name, "r.jsonl"), encoding="utf-8") as file:
            reports = [json.loads(line) for line in file][1:]
        self.assertEqual(len(reports), 3)
        self.assertEqual(found.passed.tolist(), [report["verdict"] == "pass" for report in reports])
        self.assertEqual(found.reasons, [report.get("reason", "") for report in reports])
        for i, report in enumerate(reports):
            self.assertAlmostEqual(found.distance_mm[i], report["distance_mm"], places=3)
            results = {result["protocol"]: result for result in report["protocols"]}
            self.assertEqual(found.protocol_reasons[i].tolist(), [results[name].get("reason", "") for name in protocols])
            for array, name, key in ((found.moved_mm, "dexgraspbench", "moved_mm"), (found.held_s, "fall", "seconds"),
                                     (found.resisted_N, "disturbance", "resisted_N")):
                expected = [np.nan if value is None else value for value in np.atleast_1d(results[name].get(key, np.nan))]
                row = np.atleast_1d(array[i])[:len(expected)].astype(float)
                np.testing.assert_allclose(row, np.array(expected, dtype=float), atol=1e-3)

    def test_scales_of_grasps_replace_that_of_the_object(self):
        half = regrasp.Object.read(os.path.join(self.files.name, "objects/box.obj"), scale=0.5)
        self.assertEqual(regrasp.validate_grasps(half, self.hand, self.grasps(hand_grasp_files.TOUCH)).reasons, ["no-contact"])
        found = regrasp.validate_grasps(half, self.hand, self.grasps(0.025, 0.035, 0.025, scales=np.array([1., 0.5, 0.5])))
        self.assertEqual(found.reasons, ["", "", "no-contact"])

    def test_pieces_hold_like_their_object(self):
        corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * hand_grasp_files.HALF
        halves = [np.where(corners * side > 0, corners, corners * [1, 0, 1])
                  for side in (np.array([1, 1, 1]), np.array([1, -1, 1]))]
        halves = [np.column_stack([corners[:, 0], half[:, 1], corners[:, 2]]) for half in halves]
        grasps = self.grasps(hand_grasp_files.TOUCH, target=self.closed(1))
        for pieces in (), halves:
            found = regrasp.validate_grasps(self.box, self.hand, grasps, protocols=["fall"], pieces=pieces)
            self.assertEqual(found.passed.tolist(), [True])

    def test_no_grasps_give_empty_arrays(self):
        found = regrasp.validate_grasps(self.box, self.hand, self.grasps())
        self.assertEqual((len(found), found.reasons, found.contacts.shape, found.held_s.shape), (0, [], (0, 3), (0, 6)))

    def test_progress_and_exceptions_from_it(self):
        lines = []
        many = self.grasps(*[0.] * 2000)
        regrasp.validate_grasps(self.box, self.hand, many, progress=lines.append)
        self.assertTrue(all(line.startswith("tested ") and line.endswith(" of 2000 grasps") for line in lines), lines)

        def stop(line):
            raise KeyboardInterrupt
        with self.assertRaises(KeyboardInterrupt):
            regrasp.validate_grasps(self.box, self.hand, self.grasps(*[0.025] * 5), protocols=["fall"], progress=stop)

    def test_bad_arguments_are_refused(self):
        good = self.grasps(0.025, 0.025)
        self.refuses(["protocols", "'drop'"], regrasp.validate_grasps, self.box, self.hand, good, protocols=["drop"])
        self.refuses(["protocols must be different names"], regrasp.validate_grasps, self.box, self.hand, good, protocols=[])
        self.refuses(["mu"], regrasp.validate_grasps, self.box, self.hand, good, mu=0)
        self.refuses(["mass_kg"], regrasp.validate_grasps, self.box, self.hand, good, mass_kg=float("nan"))
        self.refuses(["pieces[0] must have shape (V, 3)"], regrasp.validate_grasps, self.box, self.hand, good,
                     pieces=[[[1, 2]]])
        wrong = self.grasps(0.025, 0.025)
        wrong.joint_names = ["left_slide", "thumb"]
        self.refuses(['grasps[0]: joints: unknown joint "thumb"'], regrasp.validate_grasps, self.box, self.hand, wrong)
        far = self.grasps(0.025, 0.025)
        far.positions[1] *= 1000
        self.refuses(["grasps[1]", "millimetres"], regrasp.validate_grasps, self.box, self.hand, far)
        unnamed = self.grasps(0.025)
        unnamed.joint_names = []
        self.refuses(["joint_names"], regrasp.validate_grasps, self.box, self.hand, unnamed)
        self.refuses(["gone.json"], regrasp.validate_grasps, self.box, "gone.json", good)
        square = regrasp.Object.from_polygon([[0, 0], [1, 0], [1, 1], [0, 1]])
        self.refuses(["object must be a solid"], regrasp.validate_grasps, square, self.hand, good)


if __name__ == "__main__":
    unittest.main()
