"""Third-party meshes are planned on, or rejected in one clear line.

They are part of Debian's packages libcgal-demo and assimp-testmodels. The first has scans and
mechanical parts, some of them open or otherwise broken. The second has small files of nearly every
format, many of them without a solid, some of them malformed. The tests of a missing package are
skipped.
"""

import collections
import json
import os
import tarfile
import unittest

import program_case
from program_case import ProgramCase

CGAL_ARCHIVE = "/usr/share/doc/libcgal-dev/data.tar.gz"
ASSIMP_MODELS = "/usr/share/assimp/models"

FRICTION_ANGLE = "20"
QUICK = ("--planner", "roadmap,points=8")  # for tests of the reader only
LARGEST_LOOKED_AT = 300_000  # bytes, of files that are only read
LARGEST_OF_ASSIMP = 60_000

# Closed meshes, and their numbers of triangles.
CLOSED = {
    "oblong.off": 840, "helmet.off": 1000, "anchor.off": 1050, "spool.off": 1294,
    "cube-meshed.off": 1728, "hand.off": 2390, "couplingdown.off": 3714, "elephant.off": 5558,
    "triceratops.off": 5660, "homer.off": 9856, "fandisk.off": 12946, "turbine.off": 18460,
    "bear.off": 27648, "armadillo.off": 52000, "refined_elephant.off": 88928,
}

# Reasons why a closed and consistently oriented surface may not bound a single solid.
REASONS_OF_CLOSED = ("self-intersecting", "several solids", "not manifold", "degenerate",
                     "not planar")
# Formats that assimp rotates, mirrors or scales.
MISREAD = (".3ds", ".ac", ".amf", ".ase", ".dxf", ".x")
# Auxiliary files of the formats, which are not meshes.
NO_MESH = (".jpg", ".png", ".tga", ".bmp", ".txt", ".mtl", ".bin", ".md")


def read_off(path):
    """Return the polygons as lists of points.

    The list is empty if the file does not have one element per line, or has vertex colours.
    """
    with open(path, encoding="utf-8") as file:
        lines = [line.split("#")[0].split() for line in file]
    lines = [line for line in lines if line]
    if lines[0] != ["OFF"]:
        return []
    vertex_count, facet_count = map(int, lines[1][:2])
    points = [tuple(map(float, line)) for line in lines[2:2 + vertex_count]]
    facets = lines[2 + vertex_count:]
    if len(facets) != facet_count:
        return []
    return [[points[int(word)] for word in facet[1:1 + int(facet[0])]] for facet in facets]


def is_closed(facets):
    """Return True if every directed edge occurs once, and its reverse once."""
    edges = collections.Counter(edge for facet in facets
                                for edge in zip(facet, facet[1:] + facet[:1]))
    return all(count == 1 and edges[b, a] == 1 for (a, b), count in edges.items())


class RealMeshes(ProgramCase):
    program = "graph"

    def ask(self, path, *arguments):
        """Expect a result or one line that names the file; return the exit code and the output."""
        done = self.run_program("--object", path, "--friction-angle", FRICTION_ANGLE, *arguments)
        said = f"{path}: {done.returncode}\n{done.stdout}\n{done.stderr}"
        self.assertIn(done.returncode, (0, 2), said)
        if done.returncode == 2:
            self.assertEqual(done.stderr.count("\n"), 1, said)
            self.assertTrue(done.stderr.startswith("graph: error: " + path), said)
            self.assertFalse(done.stdout, said)
        return done


@unittest.skipUnless(os.path.exists(CGAL_ARCHIVE), "libcgal-demo is not installed")
class MeshesOfCgal(RealMeshes):

    def setUp(self):
        super().setUp()
        with tarfile.open(CGAL_ARCHIVE) as archive:
            archive.extractall(self.folder, [member for member in archive.getmembers()
                                             if member.isfile() and "/meshes/" in member.name])
        self.meshes = self.path("data/meshes")

    def test_closed_ones_of_all_sizes_have_a_roadmap(self):
        for name, facets in CLOSED.items():
            with self.subTest(mesh=name):
                path = os.path.join(self.meshes, name)
                self.assertEqual(len(read_off(path)), facets)
                done = self.ask(path, "--planner", "roadmap", "--json", "-")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertGreater(json.loads(done.stdout)["vertices"], 0)

    def test_a_few_are_planned_on(self):
        for name in ("anchor.off", "hand.off", "elephant.off"):
            with self.subTest(mesh=name):
                self.assert_done("--object", os.path.join(self.meshes, name), "--start", "random",
                                 "--goal", "random", "--planner", "roadmap", "--friction-angle",
                                 FRICTION_ANGLE, "--output", "plan.json", program="plan")
                self.assertGreater(len(json.loads(self.read("plan.json"))["steps"]), 0)

    def test_open_ones_are_refused_and_closed_ones_only_for_a_reason(self):
        answers = collections.Counter()
        for name in sorted(os.listdir(self.meshes)):
            path = os.path.join(self.meshes, name)
            if not name.endswith(".off") or os.path.getsize(path) > LARGEST_LOOKED_AT:
                continue
            with self.subTest(mesh=name):
                done = self.ask(path, *QUICK)
                facets = read_off(path)
                if not facets:
                    continue
                closed = is_closed(facets)
                answers[closed, done.returncode] += 1
                if not closed:
                    self.assertEqual(done.returncode, 2, name)
                elif done.returncode == 2:
                    self.assertTrue(any(reason in done.stderr for reason in REASONS_OF_CLOSED),
                                    done.stderr)
        self.assertGreater(answers[True, 0], 40, answers)
        self.assertGreater(answers[False, 2], 30, answers)


@unittest.skipUnless(os.path.isdir(ASSIMP_MODELS), "assimp-testmodels is not installed")
class MeshesOfAssimp(RealMeshes):

    def test_every_format_is_read_or_refused_in_one_line(self):
        formats = collections.Counter()
        refused, unsupported = 0, collections.Counter()
        for folder, _, names in sorted(os.walk(ASSIMP_MODELS)):
            for name in sorted(names):
                path = os.path.join(folder, name)
                ending = os.path.splitext(name)[1].lower()
                if ending in NO_MESH or os.path.getsize(path) > LARGEST_OF_ASSIMP:
                    continue
                with self.subTest(file=path):
                    done = self.ask(path, *QUICK)
                    accepted = done.returncode == 0
                    formats[ending] += accepted
                    refused += not accepted
                    if ending in MISREAD:
                        self.assertIn('format: not supported, expected .obj', done.stderr)
                        self.assertIn(f'found "{ending}"', done.stderr)
                        unsupported[ending] += 1
        self.assertGreater(sum(formats.values()), 25, formats)
        self.assertGreater(sum(count > 0 for count in formats.values()), 7, formats)
        self.assertGreater(refused, 80)
        self.assertEqual(set(unsupported), set(MISREAD))


if __name__ == "__main__":
    program_case.main()
