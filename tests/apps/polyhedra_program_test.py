"""Solids of many faces equal their generator's output and have the number of faces in their names.

The tests also check that the generator cuts solids exactly.
"""

from fractions import Fraction
import json
import math
import os
import re
import subprocess
import sys

import program_case
from program_case import ProgramCase

FACES = (14, 24, 34, 36, 38, 40, 42, 47, 67)
HALF_ANGLE = 10  # degrees
PLANAR = 1e-9  # metres
BENT = 1e-6  # radians; coplanar polygons differ by rounding only, other neighbours by degrees


def minus(u, v):
    return tuple(a - b for a, b in zip(u, v))


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def area_vector(points):
    """Return the area times the normal, computed about the first point."""
    total = (0, 0, 0)
    for p, q in zip(points[1:], points[2:]):
        spanned = cross(minus(p, points[0]), minus(q, points[0]))
        total = tuple(t + s / 2 for t, s in zip(total, spanned))
    return total


def volume(facets):
    return sum(dot(points[0], area_vector(points)) for points in facets) / 3


class Bodies(ProgramCase):
    program = "graph"

    def name(self, faces):
        return f"body{faces}.obj"

    def facets(self, faces):
        """Return the polygons as lists of points."""
        with open(self.model(self.name(faces)), encoding="utf-8") as obj:
            lines = [line.split() for line in obj]
        points = [tuple(map(float, line[1:])) for line in lines if line[0] == "v"]
        return [[points[int(i) - 1] for i in line[1:]] for line in lines if line[0] == "f"]

    def test_bodies_are_as_the_generator_writes_them(self):
        generator = os.path.join(program_case.ARGUMENTS.source, "scripts", "make-polyhedra")
        subprocess.run([sys.executable, generator, "--out", self.folder], check=True)
        self.assertEqual(sorted(os.listdir(self.folder)), sorted(map(self.name, FACES)))
        for faces in FACES:
            with self.subTest(faces=faces):
                with open(self.model(self.name(faces)), "rb") as committed:
                    self.assertEqual(self.read(self.name(faces)), committed.read())

    def test_bodies_have_as_many_faces_as_their_names_say_and_tens_of_focus_cells_or_more(self):
        for faces in FACES:
            with self.subTest(faces=faces):
                self.assert_done("--object", self.model(self.name(faces)), "--friction-angle",
                                 str(HALF_ANGLE), "--planner", "polyhedron,spanning=uniform", "--json", "graph.json")
                graph = json.loads(self.read("graph.json"))
                self.assertEqual(graph["faces"], faces)
                self.assertGreaterEqual(graph["vertices"], 20 if faces < 34 else 400)

    def test_facets_are_planar_and_bodies_of_the_size_of_a_hand(self):
        corners = 0
        for faces in FACES:
            with self.subTest(faces=faces):
                facets = self.facets(faces)
                for points in facets:
                    area = area_vector(points)
                    normal = tuple(x / math.hypot(*area) for x in area)
                    for p in points:
                        self.assertLess(abs(dot(normal, minus(p, points[0]))), PLANAR)
                        corners += 1
                points = {p for facet in facets for p in facet}
                diameter = max(math.dist(p, q) for p in points for q in points)
                self.assertTrue(0.08 < diameter < 0.15, diameter)
                self.assertGreater(volume(facets), 0)
        self.assertGreater(corners, 1000)

    def reflex_edges(self, facets):
        """Return the number of concave edges, counted from both sides."""
        across = {edge: points for points in facets
                  for edge in zip(points, points[1:] + points[:1])}
        reflex = 0
        for (p, q), points in across.items():
            here, there = area_vector(points), area_vector(across[q, p])
            here, there = ((tuple(x / math.hypot(*n) for x in n)) for n in (here, there))
            reflex += dot(cross(here, there), minus(q, p)) < -BENT * math.dist(p, q)
        return reflex

    def test_all_bodies_but_the_first_have_edges_that_are_not_convex(self):
        for faces in FACES:
            with self.subTest(faces=faces):
                reflex = self.reflex_edges(self.facets(faces))
                self.assertEqual(reflex > 0, faces > 14, reflex)


class Sequences(ProgramCase):
    """Output of plan if there is no sequence."""

    program = "plan"
    body = "body24.obj"  # its focus cells form several components

    def arguments(self, start, goal, seed="1", planner="polyhedron", output="plan.json"):
        spanning = ("--planner", "spanning=uniform") if planner == "polyhedron" else ()
        return ("--object", self.model(self.body), "--friction-angle", str(HALF_ANGLE),
                "--planner", planner, *spanning, "--start", start, "--goal", goal,
                "--seed", seed, "--output", output)

    def drawn_grasp(self, name, kind, planner, seed):
        """Write the random start grasp of a seed."""
        self.assert_done(*self.arguments(kind, kind, seed, planner, "drawn.json"))
        drawn = json.loads(self.read("drawn.json"))["initial"]["contacts"]
        for contact in drawn:
            del contact["finger"]
        self.write(name, json.dumps({"format": "regrasp-grasp", "version": 1,
                                     "contacts": drawn}))

    def test_a_grasp_whose_contacts_are_not_concurrent_is_named(self):
        self.drawn_grasp("apart.json", "random-any", "roadmap", "1")
        self.drawn_grasp("concurrent.json", "random", "polyhedron", "1")
        words = ["apart.json: force closure, but in none of the 99 focus cells", "not concurrent"]
        self.assert_refused(1, words, *self.arguments("apart.json", "concurrent.json"))
        self.assert_refused(1, words, *self.arguments("concurrent.json", "apart.json"))
        self.assert_refused(1, ["--start random-any: force closure, but in none of the 99"],
                            *self.arguments("random-any", "random"))

    def test_grasps_of_other_components_are_told_from_joined_ones(self):
        seeds = [str(seed) for seed in range(1, 13)]
        for seed in seeds:
            self.drawn_grasp(f"grasp{seed}.json", "random", "polyhedron", seed)
        joined, apart = 0, 0
        for seed in seeds[1:]:
            pair = self.arguments("grasp1.json", f"grasp{seed}.json", output=f"plan{seed}.json")
            if self.run_program(*pair).returncode == 0:
                joined += 1
                continue
            apart += 1
            said = self.assert_refused(1, ["no sequence of switches and sliding steps", "99 focus cells"],
                                       *pair).stderr
            sizes = re.search(r"start's component has (\d+), the goal's (\d+)", said)
            self.assertIsNotNone(sizes, said)
            self.assertLessEqual(sum(map(int, sizes.groups())), 99, said)
        self.assertGreater(joined, 0)
        self.assertGreater(apart, 0)


class CutSolids(ProgramCase):
    """Tests of scripts/cut_solid.py on solids with known faces and volumes."""

    program = "graph"
    cube = [(tuple(s if i == axis else 0 for i in range(3)), 3) for axis in range(3)
            for s in (1, -1)]
    hole = [((1, 0, 0), 1), ((-1, 0, 0), 1), ((0, 1, 0), 1), ((0, -1, 0), 1)]

    def setUp(self):
        super().setUp()
        scripts = os.path.join(program_case.ARGUMENTS.source, "scripts")
        sys.path.insert(0, scripts)
        self.addCleanup(sys.path.remove, scripts)
        import cut_solid
        self.cut_solid = cut_solid

    def exact(self, *solids):
        return [[(tuple(map(Fraction, normal)), Fraction(d)) for normal, d in solid]
                for solid in solids]

    def assert_cut(self, faces, enclosed, *cutters):
        body, *rest = self.exact(self.cube, *cutters)
        outlines = self.cut_solid.cut(body, rest)
        vertices, facets = self.cut_solid.facets_of(outlines)
        self.assertEqual(len(outlines), faces)
        self.assertEqual(volume([[vertices[i] for i in facet] for facet in facets]), enclosed)
        self.write("solid.obj", "".join("v " + " ".join(str(float(x)) for x in p) + "\n"
                                        for p in vertices)
                   + "".join("f " + " ".join(str(i + 1) for i in facet) + "\n"
                             for facet in facets))
        self.assert_done("--object", "solid.obj", "--friction-angle", "20", "--planner",
                         "polyhedron", "--json", "graph.json")
        self.assertEqual(json.loads(self.read("graph.json"))["faces"], faces)
        return outlines

    def test_a_cutter_that_misses_the_cube_changes_nothing(self):
        far = [((-1, 0, 0), -4)]
        self.assert_cut(6, 216)
        self.assert_cut(6, 216, far)

    def test_a_hole_leaves_two_faces_with_a_hole_and_adds_its_walls(self):
        outlines = self.assert_cut(10, 216 - 24, self.hole)
        self.assertEqual(sorted(map(len, outlines)), [1] * 8 + [2] * 2)

    def test_two_holes_through_one_face_leave_it_one_face(self):
        holes = [[((1, 0, 0), x + Fraction(1, 2)), ((-1, 0, 0), Fraction(1, 2) - x), *self.hole[2:]]
                 for x in (-2, 1)]
        outlines = self.assert_cut(14, 216 - 24, *holes)
        self.assertEqual(sorted(map(len, outlines)), [1] * 12 + [3] * 2)

    def test_a_step_leaves_faces_with_the_shape_of_an_l(self):
        outlines = self.assert_cut(8, 216 - 6 * 4, [((-1, 0, 0), -1), ((0, -1, 0), -1)])
        self.assertEqual(sorted(len(rings[0]) for rings in outlines), [4] * 6 + [6] * 2)

    def test_a_groove_across_a_hole_divides_its_walls_and_the_top(self):
        groove = [((0, 1, 0), Fraction(1, 2)), ((0, -1, 0), Fraction(1, 2)), ((0, 0, -1), -2)]
        self.assert_cut(6 + 4 + 1 + 6, 216 - 24 - 4, self.hole, groove)

    def test_a_body_that_is_not_in_general_position_is_refused(self):
        flush = [((1, 0, 0), 3), ((-1, 0, 0), -2)]
        for words, body, cutter in (("in the plane of another", self.cube, flush),
                                    ("cuts nothing", self.cube + [((1, 1, 1), 10)], self.hole)):
            with self.subTest(words=words), self.assertRaisesRegex(ValueError, re.escape(words)):
                self.cut_solid.cut(self.exact(body)[0], self.exact(cutter))


if __name__ == "__main__":
    program_case.main()
