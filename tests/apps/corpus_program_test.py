"""Regression test of third-party meshes: the files of Debian's packages libcgal-demo and
assimp-testmodels.

tests/data/corpus.tsv has the expected outcome of each file, one per line: package, file, and
"accepted", "repaired STAGE" or "refused WORDS". `python3 tests/apps/corpus_program_test.py
--programs DIR --source DIR --write` writes it again; read the difference before you commit it. The
files of a missing package are skipped.

The files in SLOW take most of the repair time. Only the reader is tested on them ("as it is").
`--slow` repairs them too, like `--write`. `--table FILE` selects another table, for example to
compare the tables of two versions.
"""

import concurrent.futures
import json
import os
import subprocess
import sys
import tarfile
import tempfile
import unittest

import program_case
from program_case import ProgramCase

CGAL_ARCHIVE = "/usr/share/doc/libcgal-demo/data.tar.gz"
ASSIMP_MODELS = "/usr/share/assimp/models"
SURFACES = (".3mf", ".dae", ".glb", ".gltf", ".obj", ".off", ".pcd", ".ply", ".pwn", ".stl", ".xyz")
# More than eight seconds each, and together as long as all other files.
SLOW = {
    "data/meshes/b9.ply", "data/meshes/b9_mesh.off", "data/meshes/polygon_mesh.off",
    "data/points_3/b9_training.ply", "data/points_3/building.ply",
    "data/points_3/point_set_3.xyz", "data/points_3/radar.xyz",
    "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"}
AS_IT_IS = " as it is"
REPAIRS_SLOW = False
TABLE = None  # path of a table other than that in tests/data


def surfaces(folder):
    """Return the paths of surface files below a folder, in order."""
    found = [os.path.join(base, name) for base, _, names in os.walk(folder) for name in names]
    return sorted(os.path.relpath(path, folder) for path in found
                  if path.lower().endswith(SURFACES))


def outcome_of(path):
    """Return the outcome of `repair` for a file, without numbers that may change."""
    try:
        return repaired_outcome_of(path)
    except subprocess.TimeoutExpired:
        return "not in time"


def repaired_outcome_of(path):
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        done = subprocess.run(
            [os.path.join(program_case.ARGUMENTS.programs, "repair"), "--quiet", "--object", path,
             "--output", os.path.join(folder, "solid.obj"), "--report", report],
            capture_output=True, text=True, timeout=program_case.HANG_SECONDS, check=False)
        if done.returncode == 0:
            with open(report, encoding="utf-8") as file:
                stage = json.load(file)["stages"][-1]["stage"]
            return "accepted" if stage == "read" else "repaired " + stage
        if done.returncode != 2:
            return f"exit {done.returncode}: {done.stderr.strip()}"
        return "refused " + reason_in(done.stderr.strip().split(path + ": ")[-1])


def outcome_as_it_is(path):
    """Return the outcome of `validate` for a file without a grasp: for a solid, a missing grasp."""
    with tempfile.TemporaryDirectory() as folder:
        grasp = os.path.join(folder, "none.json")
        done = subprocess.run(
            [os.path.join(program_case.ARGUMENTS.programs, "validate"), "--quiet", "--object", path,
             "--grasp", grasp, "--mu", "0.5", "--output", os.path.join(folder, "out")],
            capture_output=True, text=True, timeout=program_case.HANG_SECONDS, check=False)
        if done.returncode == 2 and grasp in done.stderr:
            return "accepted"
        return "refused " + reason_in(done.stderr.strip().split(path + ": ")[-1])


def rows_of(package, name, path):
    """Return the rows of a file, by package and name: unrepaired, repaired, or both."""
    rows = {}
    if name in SLOW:
        rows[package, name + AS_IT_IS] = outcome_as_it_is(path)
    if name not in SLOW or REPAIRS_SLOW:
        rows[package, name] = outcome_of(path)
    return rows


def reason_in(message):
    """Return the words of an error message before its first number."""
    words = []
    for word in message.split():
        if any(character.isdigit() for character in word):
            break
        words.append(word)
    return " ".join(words)[:60].rstrip(":;, ")


class Corpus(ProgramCase):
    program = "repair"

    def folders(self):
        found = {}
        if os.path.exists(CGAL_ARCHIVE):
            with tarfile.open(CGAL_ARCHIVE) as archive:
                archive.extractall(self.folder)
            found["libcgal-demo"] = self.folder
        if os.path.isdir(ASSIMP_MODELS):
            found["assimp-testmodels"] = ASSIMP_MODELS
        if not found:
            self.skipTest("neither libcgal-demo nor assimp-testmodels is installed")
        return found

    def outcomes(self):
        files = [(package, name, os.path.join(folder, name))
                 for package, folder in self.folders().items() for name in surfaces(folder)]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            found = pool.map(lambda file: rows_of(*file), files)
            return {key: outcome for rows in found for key, outcome in rows.items()}

    def table(self):
        return TABLE or os.path.join(program_case.ARGUMENTS.source, "tests", "data", "corpus.tsv")

    def test_every_file_ends_as_expected(self):
        with open(self.table(), encoding="utf-8") as file:
            lines = [line.rstrip("\n").split("\t") for line in file]
        found = self.outcomes()
        packages = {package for package, _ in found}
        expected = {(package, name): outcome for package, name, outcome in lines
                    if package in packages and (REPAIRS_SLOW or name not in SLOW)}
        self.maxDiff = None
        self.assertEqual(found, expected)
        self.assertGreater(len(found), 100)
        self.assertTrue(SLOW <= {name.removesuffix(AS_IT_IS) for _, name in found} or
                        len(packages) < 2, "a file that is slow is not there any more")


class Write(Corpus):
    """Not a test: writes the table."""

    def test_every_file_ends_as_expected(self):
        with open(self.table(), "w", encoding="utf-8") as file:
            for (package, name), outcome in sorted(self.outcomes().items()):
                file.write(f"{package}\t{name}\t{outcome}\n")


def take_option(name):
    """Return the value of an option of this script, and remove it from the arguments."""
    if name not in sys.argv:
        return None
    at = sys.argv.index(name)
    value = sys.argv[at + 1]
    del sys.argv[at:at + 2]
    return value


if __name__ == "__main__":
    REPAIRS_SLOW = "--slow" in sys.argv or "--write" in sys.argv
    sys.argv = [word for word in sys.argv if word != "--slow"]
    TABLE = take_option("--table")
    if "--write" in sys.argv:
        sys.argv.remove("--write")
        sys.argv.append("Write")
    else:
        sys.argv.append("Corpus")
    program_case.main()
