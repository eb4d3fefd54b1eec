"""action.yml: its last step, run like a CI job."""

import os
import re
import subprocess
import textwrap

import program_case
from program_case import ProgramCase


def last_step(action):
    """Return the shell commands, and the input of each environment variable."""
    step = action[action.rindex("- shell: bash"):]
    commands, variables = re.search(r"run: \|\n(.*?)\n +env:\n(.*)", step, re.DOTALL).groups()
    return textwrap.dedent(commands), dict(re.findall(r"(\w+): \$\{\{ inputs\.(\w+) \}\}", variables))


class Action(ProgramCase):
    def run_action(self, **inputs):
        path = os.path.join(program_case.ARGUMENTS.source, "action.yml")
        with open(path, encoding="utf-8") as file:
            action = file.read()
        commands, variables = last_step(action)
        for name in variables.values():
            self.assertRegex(action, rf"(?m)^  {name}:$")
        environment = {variable: inputs[name] for variable, name in variables.items()}
        programs = os.pathsep.join((program_case.ARGUMENTS.programs, os.environ["PATH"]))
        # Same bash options as in CI runners.
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", commands], cwd=self.folder,
            capture_output=True, text=True, check=False, timeout=program_case.HANG_SECONDS,
            env={**os.environ, **environment, "PATH": programs})

    def test_a_library_passes_until_one_of_its_plans_fails(self):
        folder = "plans with spaces"
        os.mkdir(self.path(folder))
        plan = self.plan_of_cube()
        self.write_json(f"{folder}/good.json", plan)
        inputs = {"objects": self.model(""), "plans": folder, "out": "out/some where"}
        done = self.run_action(**inputs)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(b"<testsuite", self.read("out/some where/junit.xml"))
        plan["friction"]["half_angle_deg"] = 3
        self.write_json(f"{folder}/weak.json", plan)
        done = self.run_action(**inputs)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(b"<failure", self.read("out/some where/junit.xml"))

    def test_a_folder_without_plans_is_refused(self):
        os.mkdir(self.path("none"))
        done = self.run_action(objects=self.model(""), plans="none", out="out")
        self.assertEqual(done.returncode, 2, done.stderr)


if __name__ == "__main__":
    program_case.main()
