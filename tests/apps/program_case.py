"""Run a built program like a user, and check the common properties of all programs.

A test script takes `--programs DIR` (the folder of the built programs) and `--source DIR` (the
project), then unittest's own arguments.
"""

import argparse
import copy
import fcntl
import json
import os
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import unittest

import jsonschema

ARGUMENTS = argparse.Namespace(programs="", source="")

# Time limit, s, far above the need of any case: a program that hangs fails instead of blocking the
# run.
HANG_SECONDS = 300


def align_past_a_finger():
    """Return a sliding step on the cube that is neither proved nor refuted.

    Finger 2 passes the contact of finger 1. At that instant all fingers are on one line.
    """
    def grasp(y):
        places = [([-0.03, 0, 0], [1, 0, 0]), ([0.03, 0, 0], [-1, 0, 0]),
                  ([0.03, y, 0], [-1, 0, 0])]
        return {"contacts": [{"finger": finger, "point": point, "normal": normal}
                             for finger, (point, normal) in enumerate(places)]}
    waypoints = [grasp(-0.009), grasp(0.012)]
    return {"initial": waypoints[0], "goal": waypoints[1],
            "steps": [{"kind": "align", "waypoints": waypoints}]}


class ProgramCase(unittest.TestCase):
    """Test case with its own folder, and the programs' common properties as assertions."""

    program = ""
    cube_plan = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def model(self, name):
        return os.path.join(ARGUMENTS.source, "models", name)

    def write(self, name, content):
        path = self.path(name)
        mode = "wb" if isinstance(content, bytes) else "w"
        with open(path, mode) as file:
            file.write(content)
        return path

    def write_json(self, name, value):
        return self.write(name, json.dumps(value))

    def plan_of_cube(self):
        """Return a plan that passes: models/cube.obj between its own grasps, at 20 degrees. It is
        planned once."""
        if ProgramCase.cube_plan is None:
            self.assert_done(
                "--object", self.model("cube.obj"), "--start", self.model("cube.start.json"),
                "--goal", self.model("cube.goal.json"), "--friction-angle", "20", "--planner",
                "points=30", "--output", "plan.json", program="plan")
            ProgramCase.cube_plan = json.loads(self.read("plan.json"))
        return copy.deepcopy(ProgramCase.cube_plan)

    def read(self, name):
        with open(self.path(name), "rb") as file:
            return file.read()

    def report(self):
        """Return the report of validate --output result, which must follow its schema."""
        report = json.loads(self.read("result/report.json"))
        schema = os.path.join(ARGUMENTS.source, "docs", "report.schema.json")
        with open(schema, encoding="utf-8") as file:
            jsonschema.validate(report, json.load(file))
        return report

    def run_program(self, *arguments, program=None, environment=None, stdout=subprocess.PIPE):
        command = [os.path.join(ARGUMENTS.programs, program or self.program), *arguments]
        return subprocess.run(
            command, stdin=subprocess.DEVNULL, stdout=stdout, stderr=subprocess.PIPE, text=True,
            cwd=self.folder, timeout=HANG_SECONDS, check=False,
            env={name: value for name, value in dict(os.environ, **(environment or {})).items()
                 if value is not None})

    def run_on_terminal(self, *arguments, environment=None, stream="stderr", columns=0):
        """Run with a terminal as standard error or standard output; return the finished process and
        the terminal's text. 0 columns means that the width is unknown."""
        without_no_color = {name: value for name, value in os.environ.items()
                            if name not in ("NO_COLOR", "TERM", "CLICOLOR", "COLUMNS")}
        master, terminal = os.openpty()
        fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
        self.addCleanup(os.close, master)
        command = [os.path.join(ARGUMENTS.programs, self.program), *arguments]
        shown = []

        def watch():
            try:
                while text := os.read(master, 1 << 16):
                    shown.append(text)
            except OSError:
                pass  # the other end is closed

        watcher = threading.Thread(target=watch)
        watcher.start()
        try:
            streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, stream: terminal}
            done = subprocess.run(command, stdin=subprocess.DEVNULL, **streams, cwd=self.folder,
                                  timeout=HANG_SECONDS, check=False, env={"TERM": "xterm", **without_no_color,
                                                    **(environment or {})})
        finally:
            os.close(terminal)
            watcher.join()
        return done, b"".join(shown).decode()

    def assert_stages(self, shown, *stages):
        """Expect that the terminal showed these stages one after the other, the first of them
        immediately."""
        erase = "\r\x1b[K"
        self.assertTrue(shown.startswith(erase + stages[0]), repr(shown))
        places = [shown.find(erase + stage) for stage in stages]
        self.assertNotIn(-1, places, repr(shown))
        self.assertEqual(places, sorted(places), repr(shown))

    def assert_done(self, *arguments, **options):
        """Expect exit code 0; return the finished process."""
        done = self.run_program(*arguments, **options)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def assert_refused(self, code, words, *arguments, **options):
        """Expect this exit code, one line on standard error with these words, and no remaining
        file."""
        before = sorted(os.listdir(self.folder))
        done = self.run_program(*arguments, **options)
        said = f"{arguments}\nstdout: {done.stdout}\nstderr: {done.stderr}"
        self.assertEqual(done.returncode, code, said)
        self.assertEqual(done.stderr.count("\n"), 1, said)
        self.assertTrue(done.stderr.endswith("\n"), said)
        level = "error: " if code in (2, 3) else ""
        self.assertTrue(
            done.stderr.startswith(options.get("program", self.program) + ": " + level), said)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, done.stderr, said)
        self.assertFalse(done.stdout, said)
        self.assertEqual(sorted(os.listdir(self.folder)), before, said)
        return done


def main():
    """Run the tests; called at the end of a test script."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    _, rest = parser.parse_known_args(namespace=ARGUMENTS)
    ARGUMENTS.programs = os.path.abspath(ARGUMENTS.programs)
    ARGUMENTS.source = os.path.abspath(ARGUMENTS.source)
    unittest.main(argv=[sys.argv[0], *rest])
