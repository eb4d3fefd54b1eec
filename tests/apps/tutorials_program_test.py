"""The commands of docs/tutorials.md, run one after the other in a folder that has the models."""

import os
import re
import subprocess

import program_case
from program_case import ProgramCase


def commands_of(page):
    """The page's shell blocks; what a comment says has exit code 1 must have it."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    return [re.sub(r"^(#.* Exit code 1\.\n)(.*)$", r"\1code=0; \2 || code=$?; [ $code -eq 1 ]", block,
                   flags=re.MULTILINE) for block in blocks]


class Tutorials(ProgramCase):
    def run_block(self, block):
        path = os.pathsep.join((program_case.ARGUMENTS.programs, os.environ["PATH"]))
        return subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=self.folder, text=True,
                              capture_output=True, check=False, env={**os.environ, "PATH": path},
                              timeout=program_case.HANG_SECONDS)

    def test_every_command_runs_and_leaves_what_the_page_says(self):
        os.symlink(self.model(""), self.path("models"))
        page = os.path.join(program_case.ARGUMENTS.source, "docs", "tutorials.md")
        with open(page, encoding="utf-8") as file:
            blocks = commands_of(file.read())
        self.assertGreater(len(blocks), 4)
        for block in blocks:
            done = self.run_block(block)
            self.assertEqual(done.returncode, 0, block + done.stderr)
        for left in ("out/plan/report.html", "out/junit.xml", "out/plans/summary.json",
                     "out/plans/index.html", "figures/sheet.pdf", "out/weak/report.json"):
            self.assertTrue(os.path.exists(self.path(left)), left)

    def test_a_command_that_fails_or_does_not_fail_as_said_is_found(self):
        for text, code in (("true", 0), ("false", 1), ("# Fails. Exit code 1.\nfalse", 0),
                           ("# Fails. Exit code 1.\ntrue", 1), ("# Exit code 1.\n(exit 2)", 1)):
            block, = commands_of(f"```sh\n{text}\n```\n")
            self.assertEqual(self.run_block(block).returncode, code, block)


if __name__ == "__main__":
    program_case.main()
