"""Objects from files and from arrays."""

import hashlib
import pickle
import types
import unittest

import numpy as np

import regrasp
from regrasp_case import RegraspCase

CORNERS = np.array([[x, y, z] for x in (0., 1) for y in (0., 1) for z in (0., 1)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1], [2, 3, 7],
                  [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


class ObjectsTest(RegraspCase):

    def test_a_unit_cube_of_arrays(self):
        cube = regrasp.Object.from_arrays(CORNERS, FACES, scale=0.1)
        self.assertEqual(cube.face_count, 6)
        self.assertEqual(cube.dimension, 3)
        self.assertEqual(cube.scale, 0.1)
        self.assertAlmostEqual(cube.measure, 1, 14)
        self.assertAlmostEqual(cube.diameter, 3 ** 0.5, 14)
        np.testing.assert_allclose(cube.centroid, [.5, .5, .5], atol=1e-14)
        self.assertEqual(cube.triangles.shape, (12, 3))
        self.assertEqual(cube.vertices.shape, (8, 3))

    def test_arrays_and_the_file_that_is_written_are_one_object(self):
        cube = regrasp.Object.from_arrays(CORNERS / 3, FACES)
        cube.write(self.path("object.obj"))
        with open(self.path("object.obj"), "rb") as file:
            self.assertEqual(hashlib.sha256(file.read()).hexdigest(), cube.sha256)
        read = regrasp.Object.read(self.path("object.obj"))
        self.assertEqual(read.sha256, cube.sha256)
        self.assertEqual(read.name, cube.name)
        np.testing.assert_array_equal(read.vertices, cube.vertices)
        self.assertEqual(read.measure, cube.measure)

    def test_a_pickle_makes_the_object_again(self):
        cube = regrasp.Object.from_arrays(CORNERS / 3, FACES, scale=0.5, name="third.obj")
        square = regrasp.Object.from_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
        cube.write(self.path("file.obj"))
        read = regrasp.Object.read(self.path("file.obj"), scale=0.5)
        for made in (cube, square, read):
            again = pickle.loads(pickle.dumps(made))
            self.assertEqual((again.sha256, again.name, again.scale, again.measure),
                             (made.sha256, made.name, made.scale, made.measure))
            np.testing.assert_array_equal(again.vertices, made.vertices)
        kept = pickle.dumps(read)
        regrasp.Object.from_arrays(CORNERS, FACES).write(self.path("file.obj"))
        with self.assertRaisesRegex(regrasp.InputError, "file.obj: differs from the pickled object"):
            pickle.loads(kept)

    def test_a_mesh_of_trimesh(self):
        mesh = types.SimpleNamespace(vertices=CORNERS, faces=FACES)
        made = regrasp.Object.from_trimesh(mesh, scale=0.1)
        self.assertEqual(made.sha256, regrasp.Object.from_arrays(CORNERS, FACES).sha256)
        with self.assertRaisesRegex(regrasp.InputError, "mesh must have vertices and faces"):
            regrasp.Object.from_trimesh(CORNERS)

    def test_other_kinds_of_arrays(self):
        for vertices, faces in [(CORNERS.astype(np.float32), FACES.astype(np.uint8)),
                                (CORNERS.astype(int).tolist(), FACES.tolist()),
                                (np.asfortranarray(CORNERS), np.asfortranarray(FACES)),
                                (CORNERS.repeat(2, 0)[::2], FACES[::-1])]:
            self.assertEqual(regrasp.Object.from_arrays(vertices, faces).face_count, 6)

    def test_a_polygon_with_a_hole(self):
        ring = regrasp.Object.from_polygon([[0, 0], [3, 0], [3, 3], [0, 3]],
                                           [[[1, 1], [2, 1], [2, 2], [1, 2]]])
        self.assertEqual((ring.dimension, ring.face_count), (2, 8))
        self.assertAlmostEqual(ring.measure, 8, 13)
        self.assertEqual(ring.centroid.shape, (2,))
        self.assertEqual(ring.vertices.shape, (4, 2))
        self.assertEqual(ring.triangles.shape, (0, 3))

    def test_wrong_arrays_are_named(self):
        make = regrasp.Object.from_arrays
        self.refuses(["vertices", "(V, 3)", "(8, 2)"], make, CORNERS[:, :2], FACES)
        self.refuses(["vertices", "<U1"], make, np.full((8, 3), "x"), FACES)
        self.refuses(["vertices", "(V, 3)"], make, [[1, 2, 3], [1, 2]], FACES)
        broken = CORNERS.copy()
        broken[5, 1] = np.nan
        self.refuses(["vertices[5, 1]", "nan"], make, broken, FACES)
        self.refuses(["faces", "(F, 3)", "(12, 2)"], make, CORNERS, FACES[:, :2])
        self.refuses(["faces", "float64"], make, CORNERS, FACES.astype(float))
        self.refuses(["faces[0, 2] must be a vertex from 0 to 7, found 9"], make, CORNERS, [[0, 1, 9]])
        self.refuses(["faces[0, 0]", "found -1"], make, CORNERS, [[-1, 1, 2]])
        self.refuses(["object.obj", "closed"], make, CORNERS, FACES[:-1])
        self.refuses(["vertices", "at least one vertex"], make, np.zeros((0, 3)), np.zeros((0, 3), int))
        self.refuses(["scale", "above 0"], make, CORNERS, FACES, scale=0)
        self.refuses(["scale", "'a'"], make, CORNERS, FACES, scale="a")

    def test_nearest_places_are_on_the_surface_and_nearest(self):
        duck = regrasp.Object.read("models/duck1000.obj")
        rng = np.random.default_rng(3)
        low, high = duck.vertices.min(axis=0), duck.vertices.max(axis=0)
        points = rng.uniform(low - 1.5 * (high - low), high + 1.5 * (high - low), (400, 3))
        places, normals = duck.nearest(points)
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1)
        again, _ = duck.nearest(places)
        np.testing.assert_allclose(again, places, atol=1e-12 * duck.diameter)
        # Neither a corner nor the centroid of a triangle is nearer.
        corners = duck.vertices[duck.triangles]
        others = np.concatenate([duck.vertices, corners.mean(axis=1)])
        least = np.linalg.norm(points[:, None] - others[None], axis=2).min(axis=1)
        distance = np.linalg.norm(points - places, axis=1)
        self.assertTrue((distance <= least * (1 + 1e-12)).all())
        self.assertTrue((distance > 0.9 * least).any())
        # Negative control: the check detects a point that is not the nearest.
        self.assertTrue((np.linalg.norm(points - np.roll(places, 1, axis=0), axis=1) > least).any())
        self.assertEqual(duck.nearest(np.zeros((0, 3)))[0].shape, (0, 3))
        plate = regrasp.Object.from_polygon([[0, 0], [2, 0], [2, 1], [0, 1]])
        place, normal = plate.nearest([[0.5, -3]])
        self.assertEqual((place.tolist(), normal.tolist()), ([[0.5, 0]], [[0, 1]]))
        self.refuses(["points", "(N, 2)", "(1, 3)"], plate.nearest, np.zeros((1, 3)))

    def test_wrong_polygons_are_named(self):
        make = regrasp.Object.from_polygon
        self.refuses(["outline", "(2, 2)"], make, [[0, 0], [1, 1]])
        self.refuses(["holes[0]", "(1, 3)"], make, [[0, 0], [1, 0], [0, 1]], [[[1, 2, 3]]])
        self.refuses(["object.wkt"], make, [[0, 0], [1, 1], [1, 0], [0, 1]])

    def test_wrong_files_are_named(self):
        with self.assertRaises(regrasp.InputError) as caught:
            regrasp.Object.read("models/no-such.obj")
        self.assertIn("models/no-such.obj", str(caught.exception))
        with open(self.path("object.obj"), "w", encoding="utf-8") as file:
            file.write("v 0 0 0\nf 1 2 3\n")
        self.refuses([self.path("object.obj")], regrasp.Object.read, self.path("object.obj"))
        self.refuses(["shells", "did you mean 'union'"], regrasp.Object.read, self.path("object.obj"),
                     shells="unoin")

    def test_only_what_was_made_is_written(self):
        self.refuses(["cube.obj"], regrasp.Object.read("models/cube.obj").write, self.path("object.obj"))
        with self.assertRaises(TypeError):
            regrasp.Object("models/cube.obj")


if __name__ == "__main__":
    unittest.main()
