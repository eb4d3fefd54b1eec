"""Where all programs write, and what they leave alone there."""

import os
import shutil
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

    # Inputs stay.

    def assert_unharmed(self, words, program, *arguments):
        """Refused as bad usage, with everything in the folder as it was."""
        def state():
            paths = [os.path.join(folder, name)
                     for folder, _, names in os.walk(self.folder) for name in names]
            return {path: self.read(path) for path in paths if os.path.exists(path)}
        before = state()
        self.program = program
        self.assert_refused(2, words, *arguments)
        self.assertEqual(state(), before)

    def make_inputs(self):
        """A plan with its object and grasps, all in the test's folder."""
        for name in ("square.wkt", "square.start.json", "square.goal.json"):
            shutil.copy(self.model(name), self.path(name))
        self.assert_done(*self.plan_arguments("plan.json"), program="plan")
        os.link(self.path("plan.json"), self.path("hard.json"))
        os.symlink("plan.json", self.path("link.json"))

    def test_plan_and_graph_never_write_onto_their_inputs(self):
        self.make_inputs()
        inputs = {"object": "square.wkt", "start": "square.start.json", "goal": "square.goal.json"}
        for option, name in inputs.items():
            os.link(self.path(name), self.path("hard_" + name))
            for output in (name, "./" + name, "hard_" + name):
                self.assert_unharmed([output, f"is the file of --{option}, and --output"], "plan",
                                     *self.plan_arguments(output, **inputs))
        self.assert_unharmed("is the file of --object, and --json", "graph", "--object",
                             "square.wkt", "--friction-angle", "20", "--json", "square.wkt")

    def test_a_grasp_that_is_drawn_is_no_file(self):
        self.write("random", "")
        self.assert_done(*self.plan_arguments("random", start="random"))
        self.assertIn(b"regrasp-plan", self.read("random"))

    def test_validate_never_writes_onto_its_inputs(self):
        self.make_inputs()
        common = ["--object", "square.wkt", "--no-frames", "--start", "square.start.json",
                  "--goal", "square.goal.json"]
        plan = [*common, "--plan", "plan.json", "--out", "result"]
        for option in ("--junit", "--trajectory", "--export-mjcf"):
            for output in ("plan.json", "hard.json", "link.json"):
                self.assert_unharmed([output, f"is the file of --plan, and {option}"], "validate",
                                     *plan, option, output)
            self.assert_unharmed("is the file of --object", "validate", *plan, option, "square.wkt")
            self.assert_unharmed("is the file of --start", "validate", *plan, option,
                                 "square.start.json")
            self.assert_unharmed("is the file of --goal", "validate", *plan, option,
                                 "square.goal.json")
            self.assert_unharmed("is the file of --grasp", "validate", "--object", "square.wkt",
                                 "--mu", "0.4", "--no-frames", "--grasp", "square.start.json",
                                 option, "square.start.json")
            # Which file it is, only the plan tells.
            self.assert_unharmed("is the file of --object", "validate", "--object", ".", "--plan",
                                 "plan.json", "--out", "result", option, "square.wkt")

    def test_files_in_the_output_folder_that_are_inputs_stay(self):
        self.make_inputs()
        for name in ("report.json", "report.html", "overview.png", "replay.webp", "000_hold.png"):
            os.rename(self.path("plan.json"), self.path(name))
            for link in (name, "link.json"):
                os.remove(self.path("link.json"))
                os.symlink(name, self.path("link.json"))
                self.assert_unharmed([name, "is the file of --plan, and --out"], "validate",
                                     "--object", "square.wkt", "--plan", link, "--out", ".")
            os.rename(self.path(name), self.path("plan.json"))
        os.rename(self.path("square.wkt"), self.path("report.html"))
        self.assert_unharmed("is the file of --object, and --out", "validate", "--object",
                             "report.html", "--plan", "plan.json", "--out", ".")
        os.rename(self.path("report.html"), self.path("square.wkt"))
        for name in ("sheet.svg", "000_hold.svg", "contact_space_001.svg"):
            os.rename(self.path("plan.json"), self.path(name))
            self.assert_unharmed([name, "is the file of --plan, and --out"], "figure",
                                 "--object", "square.wkt", "--plan", name, "--out", ".")
            os.rename(self.path(name), self.path("plan.json"))

    def test_two_outputs_are_two_files(self):
        self.make_inputs()
        plan = ["--object", "square.wkt", "--plan", "plan.json", "--out", "result", "--no-frames"]
        self.assert_unharmed("--junit and --trajectory would both", "validate", *plan, "--junit",
                             "new", "--trajectory", "./new")
        self.assert_unharmed("--junit and --out would both", "validate", *plan, "--junit",
                             "result/report.json")
        self.assert_unharmed("--export-mjcf and --out would both", "validate", *plan,
                             "--export-mjcf", "result/003_align.png")
        self.assert_done(*plan, "--junit", "result/junit.xml", program="validate")

    # What cannot be written is found first.

    def test_what_cannot_be_written_is_found_before_anything_is_read(self):
        self.make_inputs()
        self.write("taken", "")
        broken = self.write("broken", "no object")
        for output in ("missing/x", "taken/x", "/proc/x", "."):
            words = [output, "cannot be written"]
            self.program = "plan"
            self.assert_refused(3, words, *self.plan_arguments(output, object=broken))
            self.program = "graph"
            self.assert_refused(3, words, "--object", broken, "--mu", "1", "--json", output)
            self.program = "validate"
            for option in ("--junit", "--trajectory", "--export-mjcf"):
                self.assert_refused(3, words, "--object", broken, "--plan", broken, option, output)
        for program in ("validate", "figure"):
            self.program = program
            for out in ("taken", "taken/x", "/proc/x/y"):
                self.assert_refused(3, [out, "cannot be written"], "--object", broken, "--plan",
                                    broken, "--out", out)
        self.assertEqual(self.read("taken"), b"")


if __name__ == "__main__":
    program_case.main()
