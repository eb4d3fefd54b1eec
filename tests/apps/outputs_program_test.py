"""Where all programs write, and what they leave alone there."""

import os
import subprocess

import program_case
from program_case import ProgramCase


class Outputs(ProgramCase):
    program = "plan"

    def plan_arguments(self, output, **changes):
        options = {"--object": self.model("square.wkt"),
                   "--start": self.model("square.start.json"),
                   "--goal": self.model("square.goal.json"),
                   "--output": output, "--friction-angle": "20"}
        options.update({"--" + key: value for key, value in changes.items()})
        return [word for pair in options.items() for word in pair]

    def graph_arguments(self, json):
        return ["--object", self.model("square.wkt"), "--friction-angle", "20", "--json", json]

    # What stands at the path.

    # Links of our own, as /dev/stdout is one: a program that replaced it would harm the machine.

    def test_standard_output_by_its_name_goes_on_behind_what_is_there(self):
        os.symlink("/proc/self/fd/1", self.path("stdout"))
        self.assert_done(*self.plan_arguments("plan.json"))
        plan = self.read("plan.json")
        piped = self.assert_done(*self.plan_arguments("stdout"))
        self.assertEqual(piped.stdout.encode(), plan)
        with open(self.path("log"), "wb") as log:
            log.write(b"before\n")
            log.flush()
            self.assert_done(*self.plan_arguments("stdout"), stdout=log)
        self.assertEqual(self.read("log"), b"before\n" + plan)

    def test_a_pipe_of_the_shell_is_written_to(self):
        self.assert_done(*self.plan_arguments("plan.json"))
        plan = os.path.join(program_case.ARGUMENTS.programs, "plan")
        words = " ".join(f"'{word}'" for word in self.plan_arguments("PIPE"))
        done = subprocess.run(["bash", "-c", f"{plan} {words} | cat".replace("'PIPE'", ">(cat)")],
                              cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              timeout=program_case.HANG_SECONDS, check=True)
        self.assertEqual(done.stdout, self.read("plan.json"))

    def test_a_link_stays_a_link_and_its_file_keeps_its_mode(self):
        self.write("kept.json", "old")
        os.chmod(self.path("kept.json"), 0o600)
        os.symlink("kept.json", self.path("link.json"))
        self.assert_done(*self.graph_arguments("link.json"), program="graph")
        self.assertTrue(os.path.islink(self.path("link.json")))
        self.assertEqual(os.stat(self.path("kept.json")).st_mode & 0o777, 0o600)
        self.assertIn(b"regrasp-graph", self.read("kept.json"))


if __name__ == "__main__":
    program_case.main()
