"""Output paths of all programs, and the files there that they must not change."""

import os
import shutil
import subprocess
import time

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

    def graph_arguments(self, output):
        return ["--object", self.model("square.wkt"), "--friction-angle", "20", "--json", output]

    # Existing files at the output path.

    # Links made by the test, like /dev/stdout: a program that replaced the real one would harm the
    # machine.

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

    # Inputs are kept.

    def assert_unharmed(self, words, program, *arguments):
        """Expect a usage error, and an unchanged folder."""
        def state():
            paths = [os.path.join(folder, name)
                     for folder, _, names in os.walk(self.folder) for name in names]
            return {path: self.read(path) for path in paths if os.path.exists(path)}
        before = state()
        self.program = program
        self.assert_refused(2, words, *arguments)
        self.assertEqual(state(), before)

    def make_inputs(self):
        """Write a plan with its object and grasps into the test's folder."""
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
                self.assert_unharmed([output, f"--output must not overwrite the file of --{option}"], "plan",
                                     *self.plan_arguments(output, **inputs))
        self.assert_unharmed("--json must not overwrite the file of --object", "graph", "--object",
                             "square.wkt", "--friction-angle", "20", "--json", "square.wkt")

    def test_a_grasp_that_is_drawn_is_no_file(self):
        self.write("random", "")
        self.assert_done(*self.plan_arguments("random", start="random"))
        self.assertIn(b"regrasp-plan", self.read("random"))

    def test_validate_never_writes_onto_its_inputs(self):
        self.make_inputs()
        common = ["--object", "square.wkt", "--frames", "none", "--start", "square.start.json",
                  "--goal", "square.goal.json"]
        plan = [*common, "--plan", "plan.json", "--output", "result"]
        for option in ("--junit", "--trajectory", "--export-mjcf"):
            for output in ("plan.json", "hard.json", "link.json"):
                self.assert_unharmed([output, f"{option} must not overwrite the file of --plan"], "validate",
                                     *plan, option, output)
            self.assert_unharmed("must not overwrite the file of --object", "validate", *plan, option, "square.wkt")
            self.assert_unharmed("must not overwrite the file of --start", "validate", *plan, option,
                                 "square.start.json")
            self.assert_unharmed("must not overwrite the file of --goal", "validate", *plan, option,
                                 "square.goal.json")
            self.assert_unharmed("must not overwrite the file of --grasp", "validate", "--object", "square.wkt",
                                 "--mu", "0.4", "--frames", "none", "--grasp", "square.start.json",
                                 option, "square.start.json")
            # The name of the file depends on the plan.
            self.assert_unharmed("must not overwrite the file of --object", "validate", "--object", ".", "--plan",
                                 "plan.json", "--output", "result", option, "square.wkt")

    def test_files_in_the_output_folder_that_are_inputs_stay(self):
        self.make_inputs()
        for name in ("report.json", "report.html", "overview.png", "replay.webp", "000_hold.png"):
            os.rename(self.path("plan.json"), self.path(name))
            for link in (name, "link.json"):
                os.remove(self.path("link.json"))
                os.symlink(name, self.path("link.json"))
                self.assert_unharmed([name, "--output must not overwrite the file of --plan"], "validate",
                                     "--object", "square.wkt", "--plan", link, "--output", ".")
            os.rename(self.path(name), self.path("plan.json"))
        os.rename(self.path("square.wkt"), self.path("report.html"))
        self.assert_unharmed("--output must not overwrite the file of --object", "validate", "--object",
                             "report.html", "--plan", "plan.json", "--output", ".")
        os.rename(self.path("report.html"), self.path("square.wkt"))
        for name in ("sheet.svg", "000_hold.svg", "contact_space_001.svg"):
            os.rename(self.path("plan.json"), self.path(name))
            self.assert_unharmed([name, "--output must not overwrite the file of --plan"], "figure",
                                 "--object", "square.wkt", "--plan", name, "--output", ".")
            os.rename(self.path(name), self.path("plan.json"))

    def test_two_outputs_are_two_files(self):
        self.make_inputs()
        plan = ["--object", "square.wkt", "--plan", "plan.json", "--output", "result", "--frames", "none"]
        self.assert_unharmed("--trajectory must not be the file of --junit", "validate", *plan, "--junit",
                             "new", "--trajectory", "./new")
        self.assert_unharmed("--output must not be the file of --junit", "validate", *plan, "--junit",
                             "result/report.json")
        self.assert_unharmed("--output must not be the file of --export-mjcf", "validate", *plan,
                             "--export-mjcf", "result/003_align.png")
        self.assert_done(*plan, "--junit", "result/junit.xml", program="validate")

    def test_standard_output_is_refused_for_files_that_cannot_go_there(self):
        self.make_inputs()
        plan = ["--object", "square.wkt", "--plan", "plan.json", "--frames", "none"]
        for option in ("--junit", "--trajectory", "--export-mjcf", "--output"):
            self.assert_unharmed(f"{option}: - (standard output) is not supported", "validate", *plan, option, "-")
            self.assertFalse(os.path.exists(self.path("-")))
        self.assert_done(*plan, "--json", "-", program="validate")

    # Unwritable outputs are detected first.

    def test_an_empty_value_as_of_an_undefined_variable_is_refused(self):
        self.assert_refused(2, "--output: must not be empty, expected FILE", *self.plan_arguments(""))
        self.assert_refused(2, "--output: must not be empty", *self.plan_arguments("plan.json"), "--output=")
        self.assert_refused(2, "--json: must not be empty", *self.graph_arguments(""), program="graph")
        self.assert_done(*self.plan_arguments("plan.json"))
        for option in ("--json", "--junit", "--output"):
            self.assert_refused(2, option + ": must not be empty", "--object", self.model("square.wkt"), "--plan",
                                "plan.json", option, "", program="validate")
        self.assertEqual(os.listdir(self.folder), ["plan.json"])

    def test_values_of_any_length_are_refused_in_a_line_of_bounded_length(self):
        done = self.assert_refused(2, "no such file", *self.plan_arguments("p.json", start="a" * 300))
        self.assertNotIn("internal", done.stderr)
        done = self.assert_refused(2, "--friction-angle", *self.plan_arguments("p.json", **{"friction-angle": "9" * 100000}))
        self.assertLess(len(done.stderr), 7000)

    def test_numbers_out_of_any_range_are_refused(self):
        self.assert_refused(2, "diameter of the object: expected 1e-09 to 1e+07 m",
                            *self.plan_arguments("p.json", scale="1e300"))
        cube = ["--object", self.model("cube.obj"), "--start", self.model("cube.start.json"), "--goal",
                self.model("cube.goal.json"), "--friction-angle", "20", "--output", "p.json"]
        self.assert_refused(2, "--torsion: must be at most the object's diameter", *cube, "--torsion", "1e300")
        self.assert_done(*cube)
        self.assert_refused(2, "grasp force: expected 1e-30 to 1e+36 N, found 1e+300 N; help: check --grasp-force",
                            "--object", self.model("cube.obj"), "--plan", "p.json", "--frames", "none",
                            "--grasp-force", "1e300", program="validate")

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
                                    broken, "--output", out)
        self.assertEqual(self.read("taken"), b"")

    def test_a_folder_that_vanished_during_the_run_is_an_error(self):
        self.make_inputs()
        os.mkfifo(self.path("pipe"))
        for made_again in (False, True):
            # The program waits for a reader of its pipe, when only the report remains to be
            # written.
            run = subprocess.Popen(
                [os.path.join(program_case.ARGUMENTS.programs, "validate"), "--object",
                 "square.wkt", "--plan", "plan.json", "--output", "result", "--frames", "none",
                 "--trajectory", "pipe"], cwd=self.folder, stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            while run.poll() is None and not os.path.exists(self.path("result/report.html")):
                time.sleep(0.01)
            shutil.rmtree(self.path("result"))
            if made_again:
                os.mkdir(self.path("result"))
            self.read("pipe")
            _, errors = run.communicate(timeout=program_case.HANG_SECONDS)
            self.assertEqual(run.returncode, 3, errors)
            self.assertIn("result/report.html: was removed during the run", errors)
            self.assertFalse(os.path.exists(self.path("result/report.json")))

    # The process and its environment.

    def shell(self, program, arguments, ending, before=""):
        """Run a program through the shell, with shell words before and after the command."""
        command = " ".join([before, os.path.join(program_case.ARGUMENTS.programs, program),
                            *arguments, ending])
        return subprocess.run(["bash", "-c", command], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, timeout=program_case.HANG_SECONDS,
                              check=False)

    def test_closed_streams_get_into_no_file(self):
        self.make_inputs()
        plan = self.read("plan.json")
        os.remove(self.path("plan.json"))
        closed = "<&- >&- 2>&-"
        done = self.shell("plan", self.plan_arguments("plan.json"), closed)
        self.assertEqual((done.returncode, self.read("plan.json")), (0, plan))
        done = self.shell("plan", self.plan_arguments("-"), ">&-")
        self.assertEqual(done.returncode, 3)
        self.assertIn(b"standard output", done.stderr)
        os.mkdir(self.path("plans"))
        shutil.copy(self.path("plan.json"), self.path("plans/good.json"))
        self.write("plans/bad.json", plan[:-100])
        # Messages of child processes use pipes.
        batch = ["--object", "square.wkt", "--plan", "plans", "--frames", "none", "--output"]
        self.assertEqual(self.shell("validate", [*batch, "open"], "").returncode, 2)
        for streams, code in (("<&-", 2), ("2>&-", 2), (">&-", 3), (">&- 2>&-", 3), (closed, 3)):
            done = self.shell("validate", [*batch, "result"], streams)
            self.assertEqual(self.read("result/summary.json"), self.read("open/summary.json"),
                             streams)
            self.assertEqual(done.returncode, code, (streams, done.stderr))
            shutil.rmtree(self.path("result"))

    def test_a_limit_on_files_is_an_error_that_leaves_nothing(self):
        before = sorted(os.listdir(self.folder))
        done = self.shell("plan", self.plan_arguments("plan.json"), "", "ulimit -f 1;")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertEqual(done.stderr, b"plan: error: plan.json: cannot be written: File too large\n")
        self.assertEqual(sorted(os.listdir(self.folder)), before)

    def test_the_rendering_library_keeps_nothing(self):
        self.make_inputs()
        # The cache folder that it would use; it gets the home folder itself from the system.
        cache = self.path("cache")
        os.mkdir(cache)
        self.assert_done(
            "--object", "square.wkt", "--plan", "plan.json", "--size", "160x120",
            program="validate", environment={
                "XDG_CACHE_HOME": cache, "MESA_SHADER_CACHE_DIR": None,
                "MESA_SHADER_CACHE_DISABLE": None, "MESA_GLSL_CACHE_DISABLE": None})
        self.assertNotIn("mesa_shader_cache", os.listdir(cache))


if __name__ == "__main__":
    program_case.main()
