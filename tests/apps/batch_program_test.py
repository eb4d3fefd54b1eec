"""The program validate on many plans: results, isolation, resumption, and invalid input."""

import errno
import fcntl
import json
import os
import re
import shutil
import signal
import subprocess
import tempfile
import time
import urllib.parse
import xml.etree.ElementTree as ElementTree

import jsonschema

import program_case
from program_case import HANG_SECONDS, ProgramCase

# Models that are quick to plan and to replay.
MODELS = ["triangle.wkt", "square.wkt", "polygon15.wkt"]
SEEDS = range(11)

# Longer than the validation of one of these plans, even with sanitizers.
LIMIT_SECONDS = "20"


def wait_until(what, seconds=HANG_SECONDS):
    """Return the first true value of `what()`; fail if there is none within the time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        value = what()
        if value:
            return value
        time.sleep(0.01)
    raise AssertionError("it never came")


def children_of(process):
    try:
        with open(f"/proc/{process}/task/{process}/children", encoding="ascii") as file:
            return [int(word) for word in file.read().split()]
    except FileNotFoundError:
        return []


def is_alive(process):
    """Return True if a process runs; a zombie does not."""
    try:
        with open(f"/proc/{process}/stat", encoding="ascii") as file:
            return file.read().rsplit(")", 1)[1].split()[0] not in "ZX"
    except FileNotFoundError:
        return False


def tree(folder):
    """Return all files of a folder, by their relative paths."""
    found = {}
    for parent, _, names in os.walk(folder):
        for name in names:
            path = os.path.join(parent, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, folder)] = file.read()
    return found


def without_times(junit):
    """Return the part of a JUnit file that is the same in every run."""
    return re.sub(rb' time="\d+\.\d{3}"', b"", junit)


def without_weak(errors):
    """Return the messages except for the failure of the plan weak, which may be missing."""
    return "".join(line for line in errors.splitlines(keepends=True)
                   if not line.startswith("validate: weak: step 0 (hold) fails: "))


class Batch(ProgramCase):
    program = "validate"
    plans = None  # text by file name

    def setUp(self):
        super().setUp()
        if Batch.plans is None:
            Batch.plans = self.make_plans()
        os.mkdir(self.path("plans"))

    def make_plans(self):
        plans = {}
        for model in MODELS:
            for seed in SEEDS:
                self.assert_done(
                    "--object", self.model(model), "--friction-angle", "20", "--start", "random",
                    "--goal", "random", "--seed", str(seed), "--output", "made.json", "--quiet",
                    program="plan")
                plans[f"{model[:-4]}_{seed:02}.json"] = self.read("made.json")
                os.remove(self.path("made.json"))
        self.assertGreaterEqual(len(plans), 30)
        return plans

    def use(self, names):
        for name in names:
            self.write("plans/" + name, Batch.plans[name])
        return names

    def use_few(self):
        """Use one plan of each model, and one that fails because of its friction."""
        names = self.use(["polygon15_03.json", "square_01.json", "triangle_00.json"])
        weak = json.loads(Batch.plans["square_02.json"])
        weak["friction"]["half_angle_deg"] = 1.0
        self.write_json("plans/weak.json", weak)
        return names

    def arguments(self, *more, out="result"):
        return ["--object", program_case.ARGUMENTS.source + "/models", "--plan", "plans", "--output",
                out, "--frames", "none", *more]

    def run_batch(self, code, *more, out="result"):
        done = self.run_program(*self.arguments(*more, out=out))
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def summary(self, out="result"):
        """Return the summary, which must follow its schema, like all reports that it names."""
        docs = os.path.join(program_case.ARGUMENTS.source, "docs")
        schemas = {}
        for name in ("summary", "report"):
            with open(f"{docs}/{name}.schema.json", encoding="utf-8") as file:
                schemas[name] = json.load(file)
        summary = json.loads(self.read(out + "/summary.json"))
        jsonschema.validate(summary, schemas["summary"])
        for plan in summary["plans"]:
            if plan["report"]:
                report = json.loads(self.read(f"{out}/{plan['report']}"))
                jsonschema.validate(report, schemas["report"])
        return summary

    def verdicts(self, out="result"):
        return {plan["name"]: plan["verdict"] for plan in self.summary(out)["plans"]}

    def start_hanging(self, *more, before=(), **options):
        """Start a batch whose last plan square.json never ends, and wait until all other plans are
        done.

        Returns the batch and the process of that plan.
        """
        os.makedirs(self.path("hanging"), exist_ok=True)
        pipe = self.path("hanging/square.json")
        if not os.path.exists(pipe):
            os.mkfifo(pipe)
        batch = subprocess.Popen(
            [*before, os.path.join(program_case.ARGUMENTS.programs, "validate"),
             *self.arguments("--jobs", "1", "--plan", "hanging/square.json", *more)],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            cwd=self.folder, **options)
        self.addCleanup(self.end, batch)

        def opened():
            """Return the write end; None until a process waits at the other end."""
            try:
                return os.open(pipe, os.O_WRONLY | os.O_NONBLOCK)
            except OSError as error:
                self.assertEqual(error.errno, errno.ENXIO)
                return None

        self.addCleanup(os.close, wait_until(opened))
        children = children_of(batch.pid)
        self.assertEqual(len(children), 1)
        return batch, children[0]

    @staticmethod
    def end(batch):
        if batch.poll() is None:
            batch.kill()
        batch.communicate()

    # Results.

    def test_a_library_gives_the_same_bytes_with_any_number_of_jobs(self):
        names = self.use(sorted(Batch.plans))
        one = self.run_batch(0, "--jobs", "1", "--junit", "one.xml", out="one")
        many = self.run_batch(0, "--jobs", "7", "--junit", "many.xml", out="many")
        self.assertEqual(one.stdout, many.stdout.replace("files: many/", "files: one/"))
        self.assertEqual(without_times(self.read("one.xml")),
                         without_times(self.read("many.xml")))
        self.assertEqual(tree(self.path("one")), tree(self.path("many")))
        lines = one.stdout.splitlines()
        self.assertEqual(len(lines), len(names) + 3)
        self.assertEqual([line.split()[0] for line in lines[1:-2]], [name[:-5] for name in names])
        self.assertEqual(lines[-2],
                         "files: one/index.html, summary.json, and a folder for each plan")
        self.assertEqual(lines[-1],
                         f"{len(names)} plans: {len(names)} pass, 0 fail, 0 bad-input, 0 error")
        summary = self.summary("one")
        self.assertEqual([plan["name"] for plan in summary["plans"]], [name[:-5] for name in names])

    def comparable(self, folder):
        """Return the results of a plan without links to the index page and without digests."""
        files = tree(self.path(folder))
        page = files["report.html"]
        files["report.html"], links = re.subn(rb'(?s)<nav class="links">.*?</nav>\n', b"", page)
        report = json.loads(files["report.json"])
        del report["run"]
        files["report.json"] = report
        return files, links

    def test_each_plan_has_what_a_single_run_writes(self):
        names = self.use_few()
        self.run_program("--object", program_case.ARGUMENTS.source + "/models", "--plan", "plans",
                         "--output", "result", "--size", "160x120")
        for name in names:
            plan = "plans/" + name
            model = self.model(name.split("_")[0] + ".wkt")
            self.assert_done("--object", model, "--plan", plan, "--output", "single", "--size",
                             "160x120")
            single, links = self.comparable("single")
            self.assertIn("000_hold.png", single)
            self.assertEqual(links, 0)
            self.assertEqual((single, 1), self.comparable("result/" + name[:-5]))
            shutil.rmtree(self.path("single"))

    def test_junit_has_a_suite_for_each_plan(self):
        self.use_few()
        self.write("plans/broken.json", "{")
        self.run_batch(2, "--junit", "junit.xml")
        root = ElementTree.parse(self.path("junit.xml")).getroot()
        suites = {suite.get("name"): suite for suite in root}
        for name in ("tests", "failures", "errors", "skipped"):
            self.assertEqual(int(root.get(name)), sum(int(suite.get(name)) for suite in root))
        self.assertEqual(len(suites), 5)
        for plan in self.summary()["plans"]:
            suite = suites[plan["file"]]
            cases = 1 if plan["steps"] is None else plan["steps"] + 1
            self.assertEqual(len(suite.findall("testcase")), cases)
        self.assertEqual(suites["weak.json"].get("failures"), "1")
        self.assertEqual(suites["broken.json"].get("errors"), "1")
        self.assertEqual(suites["square_01.json"].get("failures"), "0")
        self.assertNotIn(b" time=", without_times(self.read("junit.xml")))

    def test_ci_servers_find_the_frame_of_what_failed_from_where_the_run_was(self):
        self.use_few()
        outside = tempfile.TemporaryDirectory()
        self.addCleanup(outside.cleanup)
        for out, folder in (("result", "result"), (self.path("result"), "result"),
                            (outside.name, outside.name)):
            for plan, frame in (("plans", "weak/000_hold.png"),
                                ("plans/weak.json", "000_hold.png")):
                self.run_program("--object", program_case.ARGUMENTS.source + "/models", "--plan",
                                 plan, "--output", out, "--size", "160x120", "--junit", "junit.xml")
                attached = [case.find("system-out").text for case in
                            ElementTree.parse(self.path("junit.xml")).iter("testcase")
                            if case.find("system-out") is not None]
                self.assertEqual(attached, [f"[[ATTACHMENT|{folder}/{frame}]]"])
                self.assertTrue(os.path.isfile(os.path.join(self.folder, folder, frame)))
                shutil.rmtree(self.path(out))
        self.run_batch(1, "--junit", "junit.xml")
        self.assertNotIn(b"ATTACHMENT", self.read("junit.xml"))

    def times(self, *more):
        """Return the times of square_01 in JUnit: that of its suite and those of its cases."""
        self.run_batch(0, "--junit", "junit.xml", *more)
        suite = ElementTree.parse(self.path("junit.xml")).getroot()[0]
        return float(suite.get("time")), [float(case.get("time")) for case in suite]

    def test_junit_has_the_times_of_what_this_run_did(self):
        self.use(["square_01.json"])
        suite, cases = self.times()
        self.assertGreater(len(cases), 1)
        self.assertGreater(sum(cases), 0)
        self.assertGreaterEqual(suite, sum(cases) - 0.001 * len(cases))  # times are rounded
        # Reused results are not replayed.
        self.assertEqual(set(self.times()[1]), {0})
        self.assertGreater(sum(self.times("--restart")[1]), 0)

    def links(self):
        """Return the sources of the images and the targets of the links in index.html."""
        page = ElementTree.fromstring(self.read("result/index.html").split(b"\n", 1)[1])
        space = "{http://www.w3.org/1999/xhtml}"
        return ([urllib.parse.unquote(image.get("src")) for image in page.iter(space + "img")],
                [urllib.parse.unquote(link.get("href")) for link in page.iter(space + "a")])

    def test_the_page_of_all_plans_shows_what_failed_first_and_every_link_leads_to_a_file(self):
        self.use_few()
        os.rename(self.path("plans/square_01.json"), self.path("plans/a: 100% #1?<b>.json"))
        self.write("plans/broken.json", "{")
        arguments = ["--object", program_case.ARGUMENTS.source + "/models", "--plan", "plans",
                     "--output", "result", "--size", "64x48"]
        for kept in ("", "4 kept"):
            done = self.run_program(*arguments)
            self.assertIn(kept, done.stdout)
            pictures, links = self.links()
            self.assertEqual([picture.split("/")[0] for picture in pictures],
                             ["weak", "a: 100% #1?<b>", "polygon15_03", "triangle_00"])
            self.assertEqual(pictures[0], "weak/000_hold.png")
            self.assertEqual(len(links), 2 * 4)
            for file in pictures + links:
                self.assertTrue(os.path.isfile(self.path("result/" + file)), file)
            page = self.read("result/index.html").decode()
            self.assertIn("3 pass, 1 fail, 1 bad-input, 0 error.", page)
            self.assertLess(page.index(">broken<"), page.index(">weak<"))
            self.assertLess(page.index(">weak<"), page.index(">a: 100% #1?&lt;b&gt;<"))

    def test_a_page_of_others_stays_and_an_own_one_is_replaced(self):
        self.use(["square_01.json"])
        os.mkdir(self.path("result"))
        self.write("result/index.html", "mine")
        done = self.run_program(*self.arguments())
        self.assertEqual(done.returncode, 2)
        self.assertIn("result/index.html: cannot overwrite", done.stderr)
        self.assertEqual(tree(self.path("result")), {"index.html": b"mine"})
        os.remove(self.path("result/index.html"))
        self.run_batch(0)
        page = self.read("result/index.html")
        self.write("result/index.html", page[:-300])
        self.run_batch(0)
        self.assertEqual(self.read("result/index.html"), page)
        # Without a summary that names it, the page counts as a foreign file.
        os.remove(self.path("result/summary.json"))
        self.assertEqual(self.run_program(*self.arguments()).returncode, 2)
        self.assertEqual(self.read("result/index.html"), page)

    def test_the_folder_is_named_after_the_plans_where_none_is_given(self):
        self.use_few()
        models = ["--object", program_case.ARGUMENTS.source + "/models", "--frames", "none", "--quiet"]
        self.run_program("--plan", "plans/", *models)
        self.assertTrue(os.path.exists(self.path("out/plans/summary.json")))
        self.run_program("--plan", "plans/weak.json", "plans/square_01.json", *models)
        self.assertEqual(list(self.verdicts("out/batch")), ["weak", "square_01"])

    def test_quiet_prints_nothing_and_one_object_serves_all_plans(self):
        self.use(["square_01.json", "square_02.json"])
        done = self.assert_done("--object", self.model("square.wkt"), "--plan", "plans", "--quiet",
                                "--frames", "none", "--output", "result")
        self.assertEqual(done.stdout + done.stderr, "")
        self.assertEqual(len(self.verdicts()), 2)

    def test_one_plan_finds_its_object_in_a_folder_too(self):
        self.use(["square_01.json"])
        self.assert_done("--object", program_case.ARGUMENTS.source + "/models", "--plan",
                         "plans/square_01.json", "--frames", "none", "--output", "result")
        self.assertEqual(json.loads(self.read("result/report.json"))["object"]["file"],
                         "square.wkt")

    def test_files_of_a_folder_that_are_no_plans_are_skipped_and_named(self):
        self.use_few()
        shutil.copy(self.model("square.start.json"), self.path("plans"))
        self.write("plans/readme.txt", "nothing")
        done = self.run_batch(1)
        self.assertIn("skipped: square.start.json is a regrasp-grasp file\n", done.stdout)
        self.assertEqual(self.summary()["skipped"],
                         [{"file": "square.start.json", "why": "is a regrasp-grasp file"}])

    def test_progress_is_shown_on_a_terminal_and_gone_at_the_end(self):
        self.use(["square_01.json", "square_02.json"])
        for quiet in ([], ["--quiet"]):
            master, terminal = os.openpty()
            self.addCleanup(os.close, master)
            done = subprocess.run(
                [os.path.join(program_case.ARGUMENTS.programs, "validate"),
                 *self.arguments("--restart", *quiet)],
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=terminal,
                cwd=self.folder, timeout=HANG_SECONDS, check=False)
            os.close(terminal)
            self.assertEqual(done.returncode, 0)
            os.set_blocking(master, False)
            try:
                shown = os.read(master, 1 << 16).decode()
            except OSError:
                shown = ""
            if quiet:
                self.assertEqual(shown, "")
            else:
                self.assertIn("1 of 2 plans, 0 not passed", shown)
                self.assertTrue(shown.endswith("\r\x1b[K"), repr(shown))

    # Faults of a single plan.

    def test_bad_plans_stop_no_other(self):
        names = self.use_few()
        other = json.loads(Batch.plans["square_02.json"])
        other["object"]["sha256"] = "0" * 64
        self.write_json("plans/other_object.json", other)
        other["object"]["file"] = "../../../../etc/passwd"
        self.write_json("plans/no_object.json", other)
        other["object"]["file"] = ".."
        self.write_json("plans/no_name.json", other)
        self.write("plans/not_json.json", b"\xff\x00{")
        self.write("plans/empty.json", "")
        self.write("plans/deep.json", "[" * 100000)
        self.write_json("plans/only_format.json", {"format": "regrasp-plan"})
        done = self.run_batch(2)
        verdicts = self.verdicts()
        bad = ["deep", "empty", "no_name", "no_object", "not_json", "only_format", "other_object"]
        self.assertEqual([name for name, verdict in verdicts.items() if verdict == "bad-input"], bad)
        self.assertEqual(verdicts["weak"], "fail")
        for name in names:
            self.assertEqual(verdicts[name[:-5]], "pass")
        messages = {plan["name"]: plan["message"] for plan in self.summary()["plans"]}
        self.assertIn("/object/sha256", messages["other_object"])
        self.assertIn('"passwd" not found', messages["no_object"])
        for name in bad:
            self.assertIn(f"validate: {name}: {messages[name]}\n", done.stderr)
            self.assertFalse(os.path.exists(self.path("result/" + name)))
        self.assertIn("validate: weak: step 0 (hold) fails: not-force-closure: ", done.stderr)
        self.assertEqual(done.stderr.count("\n"), len(bad) + 1)

    def test_the_exit_code_is_the_worst(self):
        self.use(["square_01.json"])
        self.run_batch(0)
        self.use_few()
        self.run_batch(1)
        self.write("plans/broken.json", "{")
        self.run_batch(2)
        shutil.rmtree(self.path("result/weak"))
        self.write("result/weak", "in the way of a folder")
        self.run_batch(3)
        self.assertEqual(self.verdicts()["weak"], "error")
        self.assertEqual(self.verdicts()["square_01"], "pass")

    def test_a_plan_without_end_is_stopped_at_the_time_limit(self):
        names = self.use_few()
        os.mkdir(self.path("hanging"))
        os.mkfifo(self.path("hanging/square.json"))
        done = self.run_batch(3, "--plan", "hanging/square.json", "--time-limit", LIMIT_SECONDS,
                              "--jobs", "2")
        verdicts = self.verdicts()
        self.assertEqual(verdicts.pop("square"), "error")
        self.assertEqual(verdicts.pop("weak"), "fail")
        self.assertEqual(verdicts, {name[:-5]: "pass" for name in names})
        self.assertIn(f"validate: square: exceeded --time-limit {LIMIT_SECONDS}\n",
                      done.stderr)

    def test_a_plan_whose_process_crashes_is_an_error_of_that_plan(self):
        self.use_few()
        batch, child = self.start_hanging()
        os.kill(child, signal.SIGKILL)
        _, errors = batch.communicate(timeout=HANG_SECONDS)
        self.assertEqual(batch.returncode, 3, errors)
        self.assertEqual(without_weak(errors), "validate: square: crashed: Killed\n")
        self.assertEqual(self.verdicts(), {"polygon15_03": "pass", "square": "error",
                                           "square_01": "pass", "triangle_00": "pass",
                                           "weak": "fail"})

    # Interruption and resumption.

    def test_a_killed_batch_goes_on_where_it_was_and_comes_to_the_same(self):
        done_before = [f"polygon15_{seed:02}.json" for seed in range(4)]
        names = done_before + [f"square_{seed:02}.json" for seed in range(4)]
        self.use(names)
        self.run_batch(0, out="whole")
        for name in names[4:]:
            os.remove(self.path("plans/" + name))
        batch, child = self.start_hanging()
        batch.kill()
        batch.communicate()
        wait_until(lambda: not is_alive(child))
        self.use(names)
        self.assertEqual(sorted(os.listdir(self.path("result"))),
                         [".regrasp-run", *[name[:-5] for name in done_before]])
        # Leave one result like that of a process killed while writing, and truncate another.
        os.rename(self.path("result/polygon15_01/report.json"),
                  self.path("result/polygon15_01/report.json.tmp0123456789abcdef"))
        self.write("result/polygon15_01/.regrasp-run", "regrasp: process 7 on elsewhere\n"
                   "regrasp: writes report.json\nregrasp: writes report.html\n")
        self.write("result/polygon15_02/report.json",
                   self.read("result/polygon15_02/report.json")[:-1000])
        done = self.run_batch(0, "--jobs", "2")
        self.assertIn("8 plans: 8 pass, 0 fail, 0 bad-input, 0 error; 2 kept from an earlier run",
                      done.stdout)
        self.assertEqual(tree(self.path("result")), tree(self.path("whole")))

    def test_only_what_is_the_same_is_kept(self):
        names = self.use_few()
        kept = " kept from an earlier run"

        def count(code, *more):
            last = self.run_batch(code, *more).stdout.splitlines()[-1]
            return int(last.split("; ")[1].split()[0]) if kept in last else 0

        self.assertEqual(count(1), 0)
        self.assertEqual(count(1), 4)
        self.assertEqual(count(1, "--jobs", "3", "--time-limit", LIMIT_SECONDS), 4)
        self.assertEqual(count(1, "--restart"), 0)
        # An option that changes results, and back again: only the last results are kept.
        self.assertEqual(count(1, "--disturbance", "0.005"), 0)
        self.assertEqual(count(1, "--disturbance", "0.005"), 4)
        self.assertEqual(count(1), 0)
        # The same plan with different bytes.
        plan = json.loads(Batch.plans[names[0]])
        self.write_json("plans/" + names[0], plan)
        self.assertEqual(count(1), 3)
        # A missing result file.
        os.remove(self.path("result/weak/report.html"))
        self.assertEqual(count(1), 3)
        self.assertEqual(count(1), 4)

    def test_failures_that_are_kept_are_printed_as_new_ones(self):
        self.use_few()
        said = [sorted(line for line in self.run_batch(1, *more).stderr.splitlines()
                       if " fails: " in line) for more in ((), (), ("--quiet",), ("--restart",))]
        self.assertTrue(said[0])
        self.assertRegex(said[0][0], r"^validate: \w+: step \d+ .* fails: .*; why: .*; help: ")
        for again in said[1:]:
            self.assertEqual(again, said[0])

    def test_plans_in_subfolders_are_named_and_not_validated(self):
        self.use(["square_01.json", "square_02.json"])
        os.mkdir(self.path("plans/more"))
        os.rename(self.path("plans/square_02.json"), self.path("plans/more/square_02.json"))
        done = self.run_batch(0)
        self.assertIn("skipped: more/ is a subfolder with 1 plan; subfolders are not searched",
                      done.stdout)
        os.remove(self.path("plans/square_01.json"))
        self.assert_refused(2, ["plans: no plan found", "more/ is a subfolder with 1 plan",
                                "; help: give --plan plans/more"],
                            "--object", self.model(""), "--plan", "plans", "--output", "none")

    def test_no_result_that_was_edited_is_kept(self):
        self.use(["square_01.json"])
        arguments = ["--object", self.model("square.wkt"), "--plan", "plans", "--output", "result",
                     "--size", "64x48"]
        self.assert_done(*arguments)
        results = tree(self.path("result/square_01"))
        self.assertGreater(len(results), 3)
        report = results["report.json"]
        edits = [("report.json", report.replace(b'"verdict": "pass"', b'"verdict": "fail"', 1)),
                 ("report.json", report.replace(b"\n}", b"\n }")),
                 ("report.json", report[:-300]),
                 ("report.json", report.replace(b'"sha256": "', b'"sha256": "0', 1)),
                 ("report.html", results["report.html"][:-300])]
        for name, text in results.items():
            middle = len(text) // 2
            edits.append((name, text[:middle] + bytes([text[middle] ^ 1]) + text[middle + 1:]))
        for name, text in edits:
            self.assertNotEqual(text, results[name])
            self.write("result/square_01/" + name, text)
            self.assertNotIn("kept", self.assert_done(*arguments).stdout, name)
            self.assertEqual(tree(self.path("result/square_01")), results)
        self.assertIn("1 kept", self.assert_done(*arguments).stdout)

    def test_another_build_of_the_program_keeps_nothing(self):
        self.use(["square_01.json"])
        self.run_batch(0)
        before = json.loads(self.read("result/square_01/report.json"))
        with open(os.path.join(program_case.ARGUMENTS.programs, "validate"), "rb") as file:
            program = bytearray(file.read())
        # First byte of the build id, after the header of its note: sizes, type and owner.
        note = program.index(b"\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0") + 16
        program[note] ^= 1
        os.chmod(self.write("validate", bytes(program)), 0o755)
        other = [self.path("validate"), *self.arguments()]
        for kept in (False, True):
            done = subprocess.run(other, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                                  cwd=self.folder, timeout=HANG_SECONDS, check=True)
            self.assertEqual("kept" in done.stdout, kept)
        after = json.loads(self.read("result/square_01/report.json"))
        self.assertNotEqual(before.pop("run"), after.pop("run"))
        self.assertEqual(before, after)

    def test_pictures_are_part_of_what_is_kept(self):
        self.use(["square_01.json"])
        arguments = ["--object", self.model("square.wkt"), "--plan", "plans", "--output", "result",
                     "--size", "160x120"]
        self.run_batch(0)
        self.assertNotIn("kept", self.assert_done(*arguments).stdout)
        self.assertIn("1 kept", self.assert_done(*arguments).stdout)
        for name in ("000_hold.png", "overview.png"):
            os.remove(self.path("result/square_01/" + name))
            self.assertNotIn("kept", self.assert_done(*arguments).stdout)
            self.assertTrue(os.path.exists(self.path("result/square_01/" + name)))

    def test_an_object_that_changed_is_validated_again(self):
        self.use(["square_01.json", "square_02.json"])
        shutil.copy(self.model("square.wkt"), self.path("square.wkt"))
        arguments = ["--object", "square.wkt", "--plan", "plans", "--output", "result", "--frames", "none",
                     "--allow", "object-change"]
        self.assert_done(*arguments)
        self.assertIn("2 kept", self.assert_done(*arguments).stdout)
        with open(self.path("square.wkt"), "a", encoding="ascii") as file:
            file.write("\n")
        self.assertNotIn("kept", self.assert_done(*arguments).stdout)

    def test_an_interrupt_stops_the_children(self):
        self.use_few()
        for stop in (signal.SIGINT, signal.SIGTERM):
            batch, child = self.start_hanging("--restart")
            batch.send_signal(stop)
            batch.communicate(timeout=HANG_SECONDS)
            self.assertEqual(batch.returncode, -stop)
            wait_until(lambda: not is_alive(child))
            shutil.rmtree(self.path("result"))

    def test_a_stop_that_the_kernel_does_not_carry_out_still_ends_the_batch(self):
        self.use_few()
        batch, child = self.start_hanging("--junit", "junit.xml", preexec_fn=lambda:
                                          signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM}))
        batch.send_signal(signal.SIGTERM)
        output, errors = batch.communicate(timeout=HANG_SECONDS)
        self.assertEqual(batch.returncode, 128 + signal.SIGTERM, errors)
        self.assertEqual(output + without_weak(errors), "")
        wait_until(lambda: not is_alive(child))
        self.assertFalse(os.path.exists(self.path("result/summary.json")))
        self.assertFalse(os.path.exists(self.path("junit.xml")))

    def test_a_stopped_container_writes_no_summary(self):
        space = ["unshare", "--pid", "--fork", "--kill-child", "--mount-proc"]
        try:
            subprocess.run([*space, "true"], check=True, capture_output=True)
        except (OSError, subprocess.CalledProcessError) as error:
            self.skipTest(f"no process namespace can be made here: {error}")
        self.use_few()
        outside, _ = self.start_hanging("--junit", "junit.xml", before=space)
        first = children_of(outside.pid)[0]
        os.kill(first, signal.SIGTERM)
        output, errors = outside.communicate(timeout=HANG_SECONDS)
        self.assertEqual(outside.returncode, 128 + signal.SIGTERM, errors)
        self.assertEqual(output + without_weak(errors), "")
        self.assertFalse(os.path.exists(self.path("result/summary.json")))
        self.assertFalse(os.path.exists(self.path("junit.xml")))

    # Other files in the folder of results.

    def test_a_second_run_into_the_folder_is_told_of_the_first(self):
        self.use_few()
        batch, child = self.start_hanging()
        before = tree(self.path("result"))
        for arguments in (self.arguments(), self.arguments("--restart")):
            done = self.run_program(*arguments)
            self.assertEqual(done.returncode, 3)
            self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
            self.assertIn(f"result: process {batch.pid} on ", done.stderr)
            self.assertEqual(done.stdout, "")
        self.assertEqual(tree(self.path("result")), before)
        os.kill(child, signal.SIGKILL)
        _, errors = batch.communicate(timeout=HANG_SECONDS)
        self.assertEqual(without_weak(errors), "validate: square: crashed: Killed\n")
        self.run_batch(1)

    def test_a_plan_whose_folder_another_run_holds_is_an_error(self):
        self.use_few()
        os.makedirs(self.path("result/square_01"))
        path = self.write("result/square_01/.regrasp-run", "regrasp: process 7 on elsewhere\n")
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            done = self.run_batch(3)
        self.assertIn("validate: square_01: error: result/square_01: process 7 on elsewhere", done.stderr)
        self.assertEqual(self.verdicts()["square_01"], "error")
        self.assertEqual(self.verdicts()["triangle_00"], "pass")
        self.run_batch(1)
        self.assertEqual(self.verdicts()["square_01"], "pass")

    def test_a_plan_that_has_the_name_of_the_summary_stays(self):
        self.write("summary.json", Batch.plans["square_01.json"])
        self.use_few()
        for words, plans in [("summary.json: --output must not overwrite the file of --plan", "."),
                             ("summary.json: cannot overwrite", "plans")]:
            self.assert_refused(2, words, "--object", self.model("square.wkt"), "--plan", plans,
                                "--output", ".", "--frames", "none")
            self.assertEqual(self.read("summary.json"), Batch.plans["square_01.json"])
        # A summary of an earlier run is replaced.
        self.run_batch(1)
        self.write("result/summary.json", self.read("result/summary.json").replace(b"fail", b"pass"))
        self.run_batch(1)
        self.assertEqual(self.verdicts()["weak"], "fail")

    def test_files_of_others_stay_and_are_named_where_they_are_in_the_way(self):
        self.use(["square_01.json", "square_02.json"])
        arguments = ["--object", self.model("square.wkt"), "--plan", "plans", "--output", "result",
                     "--size", "64x48"]
        os.makedirs(self.path("result/square_01/123_align.png"))
        others = {"notes.txt": b"mine", "017_align.png": b"my picture", "replay.webp": b"film"}
        for name, text in others.items():
            self.write("result/square_01/" + name, text)
        self.assert_done(*arguments)
        refused = 0
        for name in ("report.json", "report.html", "overview.png", "000_hold.png"):
            self.write("result/square_02/" + name, b"mine, too")
            for own in tree(self.path("result/square_02")):
                if own != name:
                    os.remove(self.path("result/square_02/" + own))
            done = self.run_program(*arguments)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn(f"result/square_02/{name}: cannot overwrite", done.stderr)
            self.assertEqual(tree(self.path("result/square_02")), {name: b"mine, too"})
            self.assertEqual(self.verdicts(), {"square_01": "pass", "square_02": "bad-input"})
            refused += 1
            os.remove(self.path("result/square_02/" + name))
            self.assert_done(*arguments)
        self.assertEqual(refused, 4)
        # A folder is not a result, even if a report names a file like it.
        os.remove(self.path("result/square_02/overview.png"))
        os.mkdir(self.path("result/square_02/overview.png"))
        self.assertEqual(self.run_program(*arguments).returncode, 2)
        self.assertTrue(os.path.isdir(self.path("result/square_02/overview.png")))
        self.assertTrue(os.path.isdir(self.path("result/square_01/123_align.png")))
        for name, text in others.items():
            self.assertEqual(self.read("result/square_01/" + name), text)

    def test_no_output_is_an_input(self):
        self.use_few()
        shutil.copytree(program_case.ARGUMENTS.source + "/models", self.path("models"))
        os.makedirs(self.path("result/triangle_00"))
        self.write("result/triangle_00/report.json", Batch.plans["triangle_00.json"])
        before = tree(self.folder)
        refused = 0
        for words, *arguments in [
                ["weak.json: --junit must not overwrite the file of --plan", "--junit", "plans/weak.json"],
                ["square.wkt: --junit must not overwrite the file of --object", "--junit",
                 "models/square.wkt"],
                ["report.json: --output must not overwrite the file of --plan", "--plan",
                 "result/triangle_00/report.json"],
        ]:
            self.assert_refused(2, words, "--object", "models", "--plan", "plans", "--output",
                                "result", "--frames", "none", *arguments)
            refused += 1
        self.assertEqual(refused, 3)
        self.assertEqual(tree(self.folder), before)

    def test_an_unwritable_junit_is_found_before_the_plans(self):
        self.use_few()
        self.assert_refused(3, "missing/junit.xml", *self.arguments("--junit", "missing/junit.xml"))

    def test_results_that_vanished_meanwhile_are_errors(self):
        self.use_few()
        batch, child = self.start_hanging()
        shutil.rmtree(self.path("result/square_01"))
        os.remove(self.path("result/weak/report.html"))
        os.kill(child, signal.SIGKILL)
        _, errors = batch.communicate(timeout=HANG_SECONDS)
        self.assertEqual(batch.returncode, 3, errors)
        self.assertEqual(self.verdicts(), {"polygon15_03": "pass", "square": "error",
                                           "square_01": "error", "triangle_00": "pass",
                                           "weak": "error"})
        self.assertIn("validate: square_01: report.json was removed during the run", errors)
        self.assertIn("validate: weak: report.html was removed during the run", errors)

    # Invalid usage.

    def test_refuses_what_makes_no_sense_for_a_library(self):
        self.use_few()
        os.mkdir(self.path("other"))
        shutil.copy(self.path("plans/weak.json"), self.path("other"))
        models = ["--object", program_case.ARGUMENTS.source + "/models"]
        library = [*models, "--plan", "plans"]
        refused = 0
        for words, arguments in [
                ("must have different names", [*models, "--plan", "plans", "other"]),
                ("must have different names", [*models, "--plan", "plans/weak.json", "other/weak.json"]),
                ("--trajectory: requires a single plan", [*library, "--trajectory", "t.csv"]),
                ("--export-mjcf: requires a single plan", [*library, "--export-mjcf", "s.xml"]),
                ("--verify: requires a single plan", [*library, "--verify", "report.json"]),
                ("--grasp", [*library, "--grasp", self.model("square.start.json")]),
                ("--jobs", [*library, "--jobs", "0"]),
                ("--jobs", [*library, "--jobs", "two"]),
                ("--time-limit", [*library, "--time-limit", "0"]),
                ("--time-limit", [*library, "--time-limit", "1e9"]),
                ("--jobs: requires several plans", [*models, "--plan", "plans/weak.json", "--jobs",
                                                    "2"]),
                ("--restart: requires several plans", [*models, "--plan", "plans/weak.json",
                                                     "--restart"]),
                ("found a folder", [*models, "--grasp", self.model("square.start.json"), "--mu", "1"]),
        ]:
            with self.subTest(arguments=arguments):
                self.assert_refused(2, words, *arguments)
                refused += 1
        os.mkdir(self.path("nothing"))
        self.assert_refused(2, "nothing: no plan found", *models, "--plan", "nothing")
        self.assertGreater(refused, 10)

    def test_says_when_the_folder_cannot_be_written(self):
        self.use_few()
        self.write("file", "")
        self.assert_refused(3, "file", *self.arguments(out="file/result"))


if __name__ == "__main__":
    program_case.main()
