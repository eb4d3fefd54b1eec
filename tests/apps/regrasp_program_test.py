"""The programs as subcommands of `regrasp`."""

import os
import shutil
import signal
import subprocess
import time

import program_case
from program_case import ProgramCase

COMMANDS = ("plan", "validate", "graph", "figure", "repair", "merge", "evaluate", "hand")


class Regrasp(ProgramCase):
    program = "regrasp"

    def test_help_lists_every_command_with_what_its_own_help_begins_with(self):
        text = self.assert_done("--help", environment={"COLUMNS": "100"}).stdout
        self.assertIn("regrasp COMMAND [options]", text)
        shown = " ".join(text.split())
        for command in COMMANDS:
            own = self.assert_done("--help", program=command).stdout.split("\n\n")[0]
            self.assertIn(f" {command} {' '.join(own.split())} ", shown)
        self.assertNotIn("Commands:", self.assert_done("--help", program="plan").stdout)

    def test_a_commands_help_says_how_it_was_called(self):
        for command in COMMANDS:
            called = self.assert_done(command, "--help").stdout
            alone = self.assert_done("--help", program=command).stdout
            self.assertIn(f"\nUsage:\n  regrasp {command} ", called)
            self.assertIn(f"\nUsage:\n  {command} ", alone)
            for text in called, alone:
                self.assertIn("\nGeneral:\n", text)
        self.program = "plan"
        self.assert_refused(2, "(plan --help-all lists all)", "--objct", "x")
        done = self.run_program("plan", "--objct", "x", program="regrasp")
        self.assertEqual((done.returncode, done.stderr), (
            2, "plan: error: unknown option --objct; similar: --object (regrasp plan --help-all lists all)\n"))

    def test_help_of_a_command_is_the_commands_own(self):
        self.assertEqual(self.assert_done("help").stdout, self.assert_done("--help").stdout)
        for command in COMMANDS:
            self.assertEqual(self.assert_done("help", command).stdout,
                             self.assert_done(command, "--help").stdout)
        self.assert_refused(2, "unknown command paln; similar: plan (", "help", "paln")
        self.assert_refused(2, "unknown command help", "help", "help")

    def test_versions(self):
        version = self.assert_done("--version").stdout
        self.assertRegex(version, r"^regrasp \d+\.\d+\.\d+\n$")
        self.assertEqual(self.assert_done("graph", "--version").stdout,
                         version.replace("regrasp", "graph"))

    def test_a_wrong_command_is_refused_with_the_one_that_was_meant(self):
        self.assert_refused(2, "unknown command paln; similar: plan (", "paln")
        self.assert_refused(2, "unknown command val; similar: validate (", "val", "--help")
        self.assert_refused(2, "unknown command frobnicate (regrasp --help", "frobnicate")
        self.assert_refused(2, "unknown command ../apps/plan", "../apps/plan")
        self.assert_refused(2, "unknown command", "")
        self.assert_refused(2, "a command is required")
        self.assert_refused(2, "unknown option --quiet", "--quiet", "plan")

    def test_a_program_that_does_not_stand_beside_it_is_told(self):
        alone = os.path.join(self.folder, "regrasp")
        shutil.copy(os.path.join(program_case.ARGUMENTS.programs, "regrasp"), alone)
        done = subprocess.run([alone, "plan"], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1))
        self.assertIn("/plan cannot be started: No such file", done.stderr)
        # Started through a link, it finds the programs next to the link's target.
        os.remove(alone)
        os.symlink(os.path.join(program_case.ARGUMENTS.programs, "regrasp"), alone)
        subprocess.run([alone, "plan", "--version"], stdout=subprocess.PIPE, check=True)

    def test_results_streams_and_exit_codes_are_those_of_the_program(self):
        cube = self.model("cube.obj")
        ends = ["--object", cube, "--start", self.model("cube.start.json"), "--goal",
                self.model("cube.goal.json"), "--friction-angle", "20", "--output", "-"]
        alone = self.assert_done(*ends, program="plan")
        called = self.assert_done("plan", *ends)
        self.assertEqual(called.stdout, alone.stdout)
        # The message ends with the run time.
        self.assertEqual(called.stderr.rsplit(";", 1)[0], alone.stderr.rsplit(";", 1)[0])
        self.write("plan.json", called.stdout)
        check = ["validate", "--object", cube, "--plan", "plan.json", "--frames", "none", "--quiet"]
        self.assertEqual(self.run_program(*check).returncode, 0)
        weak = self.run_program(*check, "--friction-angle", "3")
        self.assertEqual(weak.returncode, 1, weak.stderr)
        self.assertEqual(self.run_program("plan", *ends[2:]).returncode, 2)

    def test_a_signal_ends_the_program_itself(self):
        # The program waits for the plan on standard input.
        command = [os.path.join(program_case.ARGUMENTS.programs, "regrasp"), "validate", "--object",
                   self.model("cube.obj"), "--plan", "-", "--frames", "none"]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, cwd=self.folder) as process:
            while os.path.basename(os.readlink(f"/proc/{process.pid}/exe")) != "validate":
                time.sleep(0.01)
            process.send_signal(signal.SIGTERM)
            self.assertEqual(process.wait(60), -signal.SIGTERM)

    def complete(self, *words):
        """Return bash's completions, with the completion files as installed."""
        for command in ("regrasp", *COMMANDS):
            self.write(command, self.assert_done("--help-as", "bash", program=command).stdout)
        script = (f". ./regrasp; COMP_WORDS=(regrasp {' '.join(words)}); COMP_CWORD={len(words)}\n"
                  "_regrasp_regrasp; printf '%s\\n' \"${COMPREPLY[@]}\"\n")
        done = subprocess.run(["bash", "-c", script], capture_output=True, text=True,
                              cwd=self.folder, check=True)
        self.assertEqual(done.stderr, "")
        return done.stdout.split()

    def test_bash_completes_commands_and_then_their_options_and_words(self):
        self.assertEqual(self.complete("pl"), ["plan"])
        self.assertEqual(self.complete("--he"), ["--help"])
        self.assertEqual(self.complete("plan", "--optim"), ["--optimize"])
        self.assertEqual(self.complete("plan", "--optimize", "m"), ["margin"])
        self.assertEqual(self.complete("frobnicate", "--spann"), [])

    def test_every_text_names_every_command(self):
        for kind in ("man", "bash", "zsh", "fish"):
            text = self.assert_done("--help-as", kind).stdout
            for command in COMMANDS:
                self.assertIn(command, text, kind)
        page = self.assert_done("--help-as", "man").stdout
        done = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-P-cbou"], input=page,
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertRegex(done.stdout, r"(?m)^COMMANDS$")


if __name__ == "__main__":
    program_case.main()
