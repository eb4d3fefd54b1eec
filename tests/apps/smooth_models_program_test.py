"""The smooth models have the properties stated in models/README.md."""

import itertools
import json
import math
import re

import program_case
from program_case import ProgramCase

BODIES = ("duck", "ellipsoid", "flask", "mug", "spanner", "star")
TRIANGLES = (500, 1000)
HOLES = {"mug": 1, "spanner": 1}  # through the handle, through the ring

SMALLEST_ANGLE = 30  # degrees
LARGEST_OF_MEDIAN = 3  # area of a triangle
SMALLEST_OF_MEDIAN = 0.2
COPLANAR = 1e-4  # radians; neighbouring triangles within this angle are one face
MOST_COPLANAR = 2  # pairs in a mesh
OFF_CENTRE = 1e-6  # metres, with nine decimals in the file


def subtract(p, q):
    return tuple(a - b for a, b in zip(p, q))


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def angle(u, v):
    return math.atan2(math.hypot(*cross(u, v)), dot(u, v))


def angles(corners):
    for at, left, right in (corners[i:] + corners[:i] for i in range(3)):
        u, v = subtract(left, at), subtract(right, at)
        yield math.degrees(angle(u, v))


def area(corners):
    a, b, c = corners
    return math.hypot(*cross(subtract(b, a), subtract(c, a))) / 2


def coplanar_pairs(points, facets):
    normals = [cross(subtract(points[b], points[a]), subtract(points[c], points[a]))
               for a, b, c in facets]
    beside = {edge: i for i, facet in enumerate(facets)
              for edge in zip(facet, facet[1:] + facet[:1])}
    return sum(angle(normals[i], normals[beside[b, a]]) <= COPLANAR
               for (a, b), i in beside.items() if a < b)


def centre_of_mass(triangles):
    """Return the centre of mass of the tetrahedra from the origin to the triangles."""
    volumes = [dot(a, cross(b, c)) / 6 for a, b, c in triangles]
    return [sum(volume * sum(p[i] for p in corners) / 4
                for volume, corners in zip(volumes, triangles)) / sum(volumes) for i in range(3)]


class SmoothModels(ProgramCase):
    program = "graph"

    def read_model(self, name):
        with open(self.model(name + ".obj"), encoding="utf-8") as file:
            text = file.read()
        points = [tuple(map(float, p.split())) for p in re.findall(r"^v (.*)$", text, re.M)]
        facets = [[int(i) - 1 for i in f.split()] for f in re.findall(r"^f (.*)$", text, re.M)]
        return points, facets

    def test_they_have_as_many_even_triangles_as_their_names_say(self):
        for body, count in itertools.product(BODIES, TRIANGLES):
            with self.subTest(model=body + str(count)):
                points, facets = self.read_model(body + str(count))
                self.assertEqual(len(facets), count)
                # Euler: V - E + F = 2 - 2 g, and 2 E = 3 F.
                self.assertEqual(len(points) - count // 2, 2 - 2 * HOLES.get(body, 0))
                triangles = [[points[i] for i in facet] for facet in facets]
                self.assertGreaterEqual(min(min(angles(t)) for t in triangles), SMALLEST_ANGLE)
                areas = sorted(map(area, triangles))
                median = areas[count // 2]
                self.assertLess(areas[-1], LARGEST_OF_MEDIAN * median)
                self.assertGreater(areas[0], SMALLEST_OF_MEDIAN * median)

    def test_they_are_as_large_as_a_hand_holds_and_centred(self):
        for body, count in itertools.product(BODIES, TRIANGLES):
            with self.subTest(model=body + str(count)):
                points, facets = self.read_model(body + str(count))
                diameter = max(math.dist(p, q) for p, q in itertools.combinations(points, 2))
                self.assertTrue(0.09 < diameter < 0.13, diameter)
                centre = centre_of_mass([[points[i] for i in facet] for facet in facets])
                self.assertLess(math.hypot(*centre), OFF_CENTRE)

    def test_nearly_every_triangle_is_a_face_of_its_own(self):
        for body, count in itertools.product(BODIES, TRIANGLES):
            with self.subTest(model=body + str(count)):
                self.assertLessEqual(coplanar_pairs(*self.read_model(body + str(count))),
                                     MOST_COPLANAR)
        # Negative control: the two sides of a square, each divided into two triangles.
        square = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        self.assertEqual(coplanar_pairs(square, [[0, 1, 2], [0, 2, 3], [1, 0, 3], [1, 3, 2]]), 2)

    def test_their_contact_points_are_as_many_as_their_triangles(self):
        for body, count in itertools.product(BODIES, TRIANGLES):
            with self.subTest(model=body + str(count)):
                done = self.assert_done("--object", self.model(f"{body}{count}.obj"), "--planner",
                                        "roadmap,clusters=10", "--friction-angle", "20",
                                        "--json", "-")
                self.assertEqual(json.loads(done.stdout)["faces"], count)


if __name__ == "__main__":
    program_case.main()
