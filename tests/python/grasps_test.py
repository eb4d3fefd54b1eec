"""Force closure of one grasp and of many grasps."""

import os
import signal
import unittest
import warnings

import numpy as np

import regrasp
from regrasp_case import RegraspCase

# Four fingers at the corners of a tetrahedron, on a sphere of radius 1.
TETRAHEDRON = np.array([[1., 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) / 3 ** 0.5


def random_grasps(count, contacts, seed):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, contacts, 3))
    points /= np.linalg.norm(points, axis=-1, keepdims=True)
    normals = 0.3 * rng.normal(size=points.shape) - points
    return points, normals / np.linalg.norm(normals, axis=-1, keepdims=True)


class GraspsTest(RegraspCase):

    def test_old_names_warn_and_have_the_same_meaning(self):
        points, normals = random_grasps(20, 4, 3)
        mask = np.arange(80).reshape(20, 4) % 5 > 0
        with warnings.catch_warnings():  # Control: the new names do not warn.
            warnings.simplefilter("error")
            found = regrasp.force_closure(points, normals, mu=0.8, active=mask)
            repr(found), found._repr_html_()
        with self.assertWarnsRegex(DeprecationWarning, "ForceClosure.holds is deprecated; use is_force_closure") as caught:
            old = found.holds
        self.assertEqual(caught.filename, __file__)
        np.testing.assert_array_equal(old, found.is_force_closure)
        with self.assertWarnsRegex(DeprecationWarning, "touching is deprecated; use active") as caught:
            again = regrasp.force_closure(points, normals, mu=0.8, touching=mask)
        self.assertEqual(caught.filename, __file__)
        np.testing.assert_array_equal(again.margin, found.margin)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            self.refuses(["active cannot be used with touching"], regrasp.force_closure, points, normals, mu=0.8,
                         active=mask, touching=mask)

    def test_known_answers(self):
        held = regrasp.force_closure(TETRAHEDRON, -TETRAHEDRON, mu=0.5)
        self.assertIs(held.is_force_closure, True)
        self.assertGreater(held.margin, 0)
        self.assertIsNone(held.quality)
        two = regrasp.force_closure(TETRAHEDRON[:2], -TETRAHEDRON[:2], mu=0.5)
        self.assertIs(two.is_force_closure, False)
        # Two fingers hold a square if each is inside the other's cone: at exactly 45° it is too
        # close to call.
        square = [[0., 0.], [1., 1.]], [[1., 0.], [-1., 0.]]
        self.assertTrue(regrasp.force_closure(*square, friction_angle_deg=46).is_force_closure)
        self.assertFalse(regrasp.force_closure(*square, friction_angle_deg=44).is_force_closure)
        border = regrasp.force_closure(*square, friction_angle_deg=45)
        self.assertFalse(border.is_force_closure)
        self.assertTrue(border.too_close)

    def test_soft_fingers_resist_a_turn_about_the_line_between_them(self):
        points, normals = np.array([[-1., 0, 0], [1, .5, 0]]), np.array([[1., 0, 0], [-1, 0, 0]])
        self.assertFalse(regrasp.force_closure(points, normals, mu=0.5).is_force_closure)
        soft = regrasp.force_closure(points, normals, mu=0.5, torsion=0.1, required_angle=True)
        self.assertTrue(soft.is_force_closure)
        self.assertAlmostEqual(soft.required_angle_deg, np.degrees(np.arctan(0.25)), places=5)
        for torsion in (-1, float("nan"), "soft"):
            self.refuses(["torsion"], regrasp.force_closure, points, normals, mu=0.5,
                         torsion=torsion)
        self.refuses(["torsion", "plane"], regrasp.force_closure, points[:, :2], normals[:, :2],
                     mu=0.5, torsion=0.1)

    def test_required_angle_is_the_border(self):
        points, normals = random_grasps(200, 4, 1)
        needed = regrasp.force_closure(points, normals, mu=0.5, required_angle=True)
        known = needed.required_angle_deg
        self.assertTrue((~np.isnan(known)).any())
        for point, normal, angle in zip(points, normals, known):
            if np.isnan(angle) or angle > 89:
                continue
            above = regrasp.force_closure(point, normal, friction_angle_deg=angle + 1e-6)
            below = regrasp.force_closure(point, normal, friction_angle_deg=angle * (1 - 1e-6))
            self.assertTrue(above.is_force_closure)
            self.assertFalse(below.is_force_closure)
        np.testing.assert_array_equal(needed.is_force_closure, known < np.degrees(np.arctan(0.5)))

    def test_many_are_each_as_alone_whatever_the_threads(self):
        points, normals = random_grasps(600, 4, 2)
        cube = regrasp.Object.read("models/cube.obj")
        one = regrasp.force_closure(points, normals, mu=0.6, threads=1)
        three = regrasp.force_closure(points, normals, mu=0.6, threads=3)
        np.testing.assert_array_equal(one.margin, three.margin)
        few = regrasp.force_closure(points[:30], normals[:30], cube, mu=0.6, quality=True)
        np.testing.assert_array_equal(few.margin, one.margin[:30])
        self.assertTrue(few.is_force_closure.any() and not few.is_force_closure.all())
        np.testing.assert_array_equal(few.is_force_closure, few.quality > 0)
        for i in range(0, 30, 10):
            alone = regrasp.force_closure(points[i], normals[i], cube, mu=0.6, quality=True)
            self.assertEqual((alone.is_force_closure, alone.margin, alone.quality),
                             (few.is_force_closure[i], few.margin[i], few.quality[i]))

    def test_many_are_judged_in_parts_between_which_work_may_end(self):
        points, normals = random_grasps(4000, 4, 8)
        told = []
        parts = regrasp.force_closure(points, normals, mu=0.6, threads=1, required_angle=True,
                                      progress=told.append)
        self.assertEqual(told[-1], "tested 4000 of 4000 grasps")
        self.assertEqual(len(told), 3)
        whole = regrasp.force_closure(points, normals, mu=0.6, threads=3, required_angle=True)
        np.testing.assert_array_equal(parts.margin, whole.margin)
        np.testing.assert_array_equal(parts.required_angle_deg, whole.required_angle_deg)

        def stop(text):
            told.append(text)
            os.kill(os.getpid(), signal.SIGINT)
        told.clear()
        with self.assertRaises(KeyboardInterrupt):
            regrasp.force_closure(points, normals, mu=0.6, threads=1, required_angle=True,
                                  progress=stop)
        self.assertEqual(len(told), 1)

    def test_qualities_are_bounded_within_one_percent_and_work_may_end(self):
        cube = regrasp.Object.read("models/cube.obj")
        points, normals = random_grasps(1500, 4, 10)
        told = []
        found = regrasp.force_closure(points, normals, cube, mu=0.6, threads=1, quality=True,
                                      progress=told.append)
        self.assertEqual((len(told), told[-1]), (5, "tested 1500 of 1500 grasps"))
        held = found.is_force_closure
        self.assertGreater(held.sum(), 100)
        np.testing.assert_array_equal(found.quality_upper > 0, held)
        gap = found.quality_upper - found.quality
        self.assertTrue((gap >= 0).all())
        self.assertTrue((gap <= np.maximum(0.01 * found.quality_upper, 1e-6)).all())
        # More friction increases the quality, less decreases it: 20 % exceeds the bounds.
        more = regrasp.force_closure(points[held], normals[held], cube, mu=0.8, quality=True)
        self.assertTrue((more.quality_upper >= found.quality[held]).all())
        self.assertTrue((more.quality > found.quality_upper[held]).mean() > 0.9)

        def stop(text):
            told.append(text)
            os.kill(os.getpid(), signal.SIGINT)
        told.clear()
        with self.assertRaises(KeyboardInterrupt):
            regrasp.force_closure(points, normals, cube, mu=0.6, threads=1, quality=True, progress=stop)
        self.assertEqual(len(told), 1)

    def test_a_contact_very_far_away_is_no_definite_no(self):
        for distance in (1e13, 1e16, 1e200):
            far = np.vstack([TETRAHEDRON, [[distance, 0, 0]]])
            found = regrasp.force_closure(far, np.vstack([-TETRAHEDRON, [[-1, 0, 0]]]), mu=0.5)
            self.assertTrue(found.is_force_closure or found.too_close, distance)
        # Negative control: neighbouring contacts are certainly not force closure.
        near = regrasp.force_closure(TETRAHEDRON[:2], -TETRAHEDRON[:2], mu=0.5)
        self.assertFalse(near.is_force_closure or near.too_close)

    def test_contacts_that_do_not_touch_do_not_count(self):
        points, normals = random_grasps(300, 5, 9)
        touching = np.random.default_rng(1).uniform(size=(300, 5)) < 0.75
        touching[7] = False
        cube = regrasp.Object.read("models/cube.obj")
        given = np.where(touching[..., None], points, np.nan), np.where(touching[..., None], normals, 9)
        found = regrasp.force_closure(*given, cube, mu=0.8, active=touching, required_angle=True)
        self.assertTrue(found.is_force_closure.any() and not found.is_force_closure.all())
        for i in range(0, 300, 7):
            if not touching[i].any():
                self.assertEqual((found.is_force_closure[i], np.isnan(found.margin[i])), (False, True))
                continue
            alone = regrasp.force_closure(points[i][touching[i]], normals[i][touching[i]], cube, mu=0.8,
                                          required_angle=True)
            self.assertEqual((alone.is_force_closure, alone.margin), (found.is_force_closure[i], found.margin[i]))
            np.testing.assert_array_equal(alone.required_angle_deg, found.required_angle_deg[i])
        every = regrasp.force_closure(points, normals, mu=0.8)
        self.assertFalse(np.array_equal(every.is_force_closure, found.is_force_closure))
        np.testing.assert_array_equal(every.margin, regrasp.force_closure(
            points, normals, mu=0.8, active=np.ones((300, 5), bool)).margin)
        nobody = regrasp.force_closure(points, normals, cube, mu=0.8, active=np.zeros((300, 5), bool),
                                       quality=True)
        self.assertFalse(nobody.is_force_closure.any() or nobody.quality.any() or nobody.quality_upper.any())
        self.assertFalse(regrasp.force_closure(points[0], normals[0], mu=0.8, active=[False] * 5).is_force_closure)
        self.refuses(["active", "(300, 5)", "(300, 4)"], regrasp.force_closure, points, normals, mu=1,
                     active=touching[:, :4])
        self.refuses(["active", "float64"], regrasp.force_closure, points, normals, mu=1,
                     active=touching * 1.)
        broken = points.copy()
        broken[np.argwhere(touching)[0][0], np.argwhere(touching)[0][1], 2] = np.nan
        self.refuses(["points[0, ", "nan"], regrasp.force_closure, broken, normals, mu=1,
                     active=touching)

    def test_monotone_in_friction_and_independent_of_the_frame(self):
        points, normals = random_grasps(500, 5, 3)
        before = np.zeros(500, bool)
        for mu in (0.1, 0.3, 0.6, 1, 3):
            holds = regrasp.force_closure(points, normals, mu=mu).is_force_closure
            self.assertFalse((before & ~holds).any())
            before = holds
        turn = np.linalg.qr(np.random.default_rng(4).normal(size=(3, 3)))[0]
        turn *= np.linalg.det(turn)
        moved = regrasp.force_closure(7 * points @ turn.T + 3, normals @ turn.T, mu=0.6)
        np.testing.assert_array_equal(
            moved.is_force_closure, regrasp.force_closure(points, normals, mu=0.6).is_force_closure)

    def test_other_kinds_of_arrays(self):
        points, normals = random_grasps(10, 4, 5)
        expected = regrasp.force_closure(points, normals, mu=0.6).is_force_closure
        for view in (np.asfortranarray, list, lambda a: np.repeat(a, 2, 0)[::2]):
            holds = regrasp.force_closure(view(points), view(normals), mu=0.6).is_force_closure
            np.testing.assert_array_equal(holds, expected)
        none = regrasp.force_closure(np.zeros((0, 4, 3)), np.zeros((0, 4, 3)), mu=0.6)
        self.assertEqual(none.is_force_closure.shape, (0,))

    def test_a_notebook_shows_verdicts(self):
        points, normals = random_grasps(50, 4, 7)
        many = regrasp.force_closure(points, normals, mu=0.6, required_angle=True)
        page = many._repr_html_()
        self.assertIn("of 50 grasps", page)
        self.assertIn(f"<td>{many.is_force_closure.sum()}</td>", page)
        one = regrasp.force_closure(TETRAHEDRON, -TETRAHEDRON, mu=0.5)._repr_html_()
        self.assertIn("<td>force closure</td>", one)
        self.assertNotIn("margin", one)
        self.assertIn("-0.5 or more", regrasp.force_closure(TETRAHEDRON[:2], -TETRAHEDRON[:2], mu=0.5)._repr_html_())

    def test_a_notebook_draws_a_grasp_of_an_object(self):
        cube = regrasp.Object.read("models/cube.obj")
        points = np.array([[.03, 0, 0], [-.03, 0, .01], [0, .03, 0], [0, -.03, 0]])
        normals = -np.eye(3)[[0, 0, 1, 1]] * np.sign(points.sum(axis=1, where=np.abs(points) > .02)
                                                     )[:, None]
        page = regrasp.force_closure(points, normals, cube, mu=0.5)._repr_html_()
        self.assertEqual(page.count("data:image/svg+xml"), 1)
        for other in (regrasp.force_closure(points, normals, mu=0.5),
                      regrasp.force_closure(points + [0, 0, 1], normals, cube, mu=0.5),
                      regrasp.force_closure([points] * 2, [normals] * 2, cube, mu=0.5)):
            self.assertNotIn("<img", other._repr_html_())
        plate = regrasp.Object.from_polygon([[0, 0], [.1, 0], [.1, .04], [0, .04]])
        planar = regrasp.force_closure([[.05, 0], [.05, .04]], [[0, 1], [0, -1]], plate, mu=0.5)
        self.assertIn("<img", planar._repr_html_())

    def test_arguments_that_are_wrong_are_named(self):
        def refuses(words, *arguments, **named):
            self.refuses(words, regrasp.force_closure, *arguments, **named)
        p, n = random_grasps(3, 4, 6)
        cube = regrasp.Object.read("models/cube.obj")
        refuses(["mu", "friction_angle_deg"], p, n)
        refuses(["mu cannot be used with friction_angle_deg"], p, n, mu=0.5, friction_angle_deg=20)
        refuses(["mu", "above 0", "-1"], p, n, mu=-1)
        refuses(["mu", "nan"], p, n, mu=float("nan"))
        refuses(["friction_angle_deg", "between 0 and 90"], p, n, friction_angle_deg=90)
        refuses(["points", "(k, 3)", "(3,)"], [1, 2, 3], n, mu=0.5)
        refuses(["points", "(3, 4, 5)"], np.zeros((3, 4, 5)), np.zeros((3, 4, 5)), mu=0.5)
        refuses(["points", "(3, 0, 3)"], np.zeros((3, 0, 3)), np.zeros((3, 0, 3)), mu=0.5)
        refuses(["normals", "(3, 4, 3)", "(3, 3, 3)"], p, n[:, :3], mu=0.5)
        refuses(["points", "complex128"], p * 1j, n, mu=0.5)
        broken = p.copy()
        broken[1, 2, 0] = np.inf
        refuses(["points[1, 2, 0]", "inf"], broken, n, mu=0.5)
        longer = n.copy()
        longer[2, 3] *= 2
        refuses(["normals[2, 3]", "length 2"], p, longer, mu=0.5)
        refuses(["object", "quality"], p, n, mu=0.5, quality=True)
        refuses(["object", "str"], p, n, "cube.obj", 0.5)
        refuses(["points", "cube.obj", "dimension 3"], p[..., :2], n[..., :2] /
                     np.linalg.norm(n[..., :2], axis=-1, keepdims=True), cube, 0.5)
        refuses(["threads", "-1"], p, n, mu=0.5, threads=-1)
        refuses(["threads", "1.5"], p, n, mu=0.5, threads=1.5)


if __name__ == "__main__":
    unittest.main()
