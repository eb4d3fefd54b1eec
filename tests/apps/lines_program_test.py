"""Many plans in JSON Lines files: plan --batch, validate of its output, and merge."""

import hashlib
import json
import os
import shutil
import signal
import subprocess
import time

import jsonschema

import program_case
from program_case import ProgramCase

ENDS = ("--mu", "0.5", "--start", "random", "--goal", "random")


class Lines(ProgramCase):
    program = "plan"

    def write_lines(self, name, values):
        return self.write(name, "".join(
            (value if isinstance(value, str) else json.dumps(value)) + "\n" for value in values))

    def queries(self, count=30):
        """Return queries for three objects, one of them planar."""
        objects = ["cube.obj", "square.wkt", "stone.obj"]
        return [{"object": {"file": objects[len(objects) * i // count]}, "seed": i}
                for i in range(count)]

    def lines(self, name):
        return [json.loads(line) for line in self.read(name).decode().splitlines()]

    def plan(self, output, *options, queries="queries.jsonl", code=0):
        done = self.run_program("--object", self.model(""), "--batch", queries, *ENDS, "--output",
                                output, *options, program="plan")
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def validate(self, plans, out, *options, code=0):
        done = self.run_program("--object", self.model(""), "--plan", plans, "--output", out, *options,
                                program="validate")
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def unseal(self, line):
        """Remove the fields that identify a run."""
        for key in ("inputs_sha256", "line_sha256"):
            self.assertRegex(line.pop(key), "^[0-9a-f]{64}$")

    def copy_objects(self):
        """Copy the objects of the queries to a folder that may be changed."""
        os.mkdir(self.path("objects"))
        for name in ("cube.obj", "square.wkt", "stone.obj"):
            shutil.copy(self.model(name), self.path("objects"))

    def validate_copies(self, plans, *options, code=0):
        done = self.run_program("--object", "objects", "--plan", plans, "--output", "out", *options,
                                program="validate")
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def merge(self, output, *shards):
        return self.assert_done("--shards", *shards, "--output", output, program="merge")

    def check_schema(self, name, value):
        path = os.path.join(program_case.ARGUMENTS.source, "docs", name + ".schema.json")
        with open(path, encoding="utf-8") as file:
            jsonschema.validate(value, json.load(file))

    def test_a_line_is_what_a_run_of_its_own_gives(self):
        self.write_lines("queries.jsonl", self.queries(6))
        done = self.plan("plans.jsonl")
        self.assertIn("plan: plans.jsonl: 6 entries: 6 plan", done.stderr)
        self.validate("plans.jsonl", "all")
        self.assertEqual(os.listdir(self.path("all")), ["reports.jsonl"])
        header, *plans = self.lines("plans.jsonl")
        report_header, *reports = self.lines("all/reports.jsonl")
        for head, content in ((header, "plans"), (report_header, "reports")):
            self.check_schema("lines", head)
            self.assertEqual((head["content"], head["entries"]), (content, 6))
        for i, query in enumerate(self.queries(6)):
            self.check_schema("query", query)
            self.check_schema("plan", plans[i])
            self.check_schema("report", reports[i])
            self.assert_done("--object", self.model(query["object"]["file"]), *ENDS, "--seed", str(i),
                             "--output", "one.json", program="plan")
            self.assertEqual(plans[i].pop("query"), i + 1)
            plans[i].pop("warnings", None)
            self.unseal(plans[i])
            self.assertEqual(plans[i], json.loads(self.read("one.json")))
            self.assert_done("--object", self.model(""), "--plan", "one.json", "--frames", "none", "--output",
                             "one", program="validate")
            one = json.loads(self.read("one/report.json"))
            self.assertEqual(reports[i].pop("query"), i + 1)
            self.unseal(reports[i])
            self.assertEqual(reports[i]["steps"], one["steps"])
            self.assertEqual({**reports[i], "plan": None},
                             {**{k: v for k, v in one.items() if k != "run"}, "plan": None})

    def test_jobs_and_shards_change_no_byte(self):
        self.write_lines("queries.jsonl", self.queries())
        self.plan("plans.jsonl", "--jobs", "1")
        self.validate("plans.jsonl", "whole", "--jobs", "3")
        for i in (1, 2, 3):
            self.plan(f"p{i}.jsonl", "--shard", f"{i}/3", "--jobs", str(i))
            self.validate(f"p{i}.jsonl", f"shard{i}", "--jobs", str(i))
            self.validate("plans.jsonl", f"again{i}", "--shard", f"{i}/3")
        self.merge("merged.jsonl", "p3.jsonl", "p1.jsonl", "p2.jsonl")
        self.assertEqual(self.read("merged.jsonl"), self.read("plans.jsonl"))
        for kind in ("shard", "again"):
            self.merge(f"{kind}.jsonl", *(f"{kind}{i}/reports.jsonl" for i in (1, 2, 3)))
            self.assertEqual(self.read(f"{kind}.jsonl"), self.read("whole/reports.jsonl"))
        # Negative control: a different option gives different bytes.
        self.plan("other.jsonl", "--min-quality", "0.02")
        self.assertNotEqual(self.read("other.jsonl"), self.read("plans.jsonl"))

    def test_a_run_that_is_killed_goes_on_where_it_was(self):
        self.write_lines("queries.jsonl", self.queries(60))
        self.plan("plans.jsonl")
        self.validate("plans.jsonl", "whole")
        command = [os.path.join(program_case.ARGUMENTS.programs, "validate"), "--object",
                   self.model(""), "--plan", "plans.jsonl", "--output", "killed", "--jobs", "1"]
        part = self.path("killed/reports.jsonl.part")
        for end in (signal.SIGKILL, signal.SIGTERM):
            before = os.path.getsize(part) if os.path.exists(part) else 0
            with subprocess.Popen(command, cwd=self.folder, stderr=subprocess.DEVNULL) as run:
                while not (os.path.exists(part) and os.path.getsize(part) > max(before, 500)):
                    self.assertIsNone(run.poll())
                    time.sleep(0.01)
                run.send_signal(end)
                self.assertEqual(run.wait(), -end)
            self.assertEqual(os.listdir(self.path("killed")), ["reports.jsonl.part"])
        done = self.validate("plans.jsonl", "killed")
        self.assertRegex(done.stderr, r"60 entries: 60 pass; [0-9]+ kept from an earlier run")
        self.assertEqual(self.read("killed/reports.jsonl"), self.read("whole/reports.jsonl"))
        # All results exist now; an edited result is computed again.
        self.assertIn("60 kept", self.validate("plans.jsonl", "killed").stderr)
        self.write("killed/reports.jsonl", self.read("whole/reports.jsonl")[:-1])
        self.assertIn("59 kept", self.validate("plans.jsonl", "killed").stderr)
        self.assertEqual(self.read("killed/reports.jsonl"), self.read("whole/reports.jsonl"))

    def test_only_what_is_the_same_is_reused(self):
        self.copy_objects()
        self.write_lines("queries.jsonl", self.queries(12))
        self.plan("plans.jsonl")
        self.assertIn("12 pass; ", self.validate_copies("plans.jsonl").stderr)

        def check(kept, counts, *options, plans="plans.jsonl", code=0):
            said = self.validate_copies(plans, *options, code=code).stderr.splitlines()[-1]
            self.assertIn(counts, said)
            if kept:
                self.assertIn(f"; {kept} kept from an earlier run", said)
            else:
                self.assertNotIn("kept", said)
            fresh = self.read("out/reports.jsonl")
            self.run_program("--object", "objects", "--plan", plans, "--output", "fresh", "--restart",
                             *options, program="validate")
            self.assertEqual(fresh, self.read("fresh/reports.jsonl"))

        check(12, "12 pass")
        whole = self.read("plans.jsonl")
        # Edit a line so that it fails, and keep the header.
        lines = whole.splitlines(keepends=True)
        plan = json.loads(lines[5])
        plan["friction"]["half_angle_deg"] = 0.5
        lines[5] = (json.dumps(plan) + "\n").encode()
        self.write("plans.jsonl", b"".join(lines))
        check(11, "11 pass, 1 fail", code=1)
        check(12, "11 pass, 1 fail", code=1)
        self.write("plans.jsonl", whole)
        check(11, "12 pass")
        # A blank at the end makes it a different line.
        lines = whole.splitlines()
        lines[7] += b" "
        self.write("plans.jsonl", b"\n".join(lines) + b"\n")
        check(11, "12 pass")
        self.write("plans.jsonl", whole)
        check(11, "12 pass")
        # If an object is changed or missing, its plans are bad input in every run.
        cube = self.read("objects/cube.obj")
        for _ in range(2):
            self.write("objects/cube.obj", cube.replace(b"v ", b"v  ", 1))
            check(8, "8 pass, 4 bad-input", code=2)
        os.remove(self.path("objects/cube.obj"))
        check(8, "8 pass, 4 bad-input", code=2)
        self.write("objects/cube.obj", cube)
        check(8, "12 pass")
        # All results depend on the options.
        check(0, "12 pass", "--density", "900")
        check(12, "12 pass", "--density", "900", "--jobs", "1")
        check(0, "12 pass", "--density", "900.0")
        check(0, "12 pass")
        # Windows line ends.
        self.write("plans.jsonl", whole.replace(b"\n", b"\r\n"))
        check(12, "12 pass")

    def test_another_build_reuses_nothing(self):
        self.write_lines("queries.jsonl", self.queries(3))
        self.plan("plans.jsonl")
        self.validate("plans.jsonl", "out")
        with open(os.path.join(program_case.ARGUMENTS.programs, "validate"), "rb") as file:
            program = bytearray(file.read())
        # First byte of the build id, after the header of its note: sizes, type and owner.
        program[program.index(b"\x04\0\0\0\x14\0\0\0\x03\0\0\0GNU\0") + 16] ^= 1
        os.chmod(self.write("validate", bytes(program)), 0o755)
        for kept in (False, True):
            done = subprocess.run(
                [self.path("validate"), "--object", self.model(""), "--plan", "plans.jsonl", "--output",
                 "out"], cwd=self.folder, capture_output=True, text=True, check=True,
                timeout=program_case.HANG_SECONDS)
            self.assertEqual("3 kept" in done.stderr, kept, done.stderr)

    def test_results_that_were_edited_are_made_again(self):
        self.write_lines("queries.jsonl", self.queries(6))
        self.plan("plans.jsonl")
        self.validate("plans.jsonl", "out")
        whole = self.read("out/reports.jsonl")
        lines = whole.splitlines(keepends=True)
        for name, edited, kept in (
                ("a verdict", lines[3].replace(b'"pass"', b'"fail"', 1), 5),
                ("a number", lines[3].replace(b'"required_half_angle_deg":', b'"required_half_angle_deg":1', 1), 5),
                ("a digest", lines[3].replace(b'"inputs_sha256":"', b'"inputs_sha256":"0'), 5),
                ("cut", lines[3][:-9], 4), ("twice", lines[3] + lines[3], 6),
                ("nothing", b"", 5), ("another entry's", lines[2], 5), ("zeros", bytes(64) + b"\n", 5)):
            self.write("out/reports.jsonl", b"".join([*lines[:3], edited, *lines[4:]]))
            done = self.validate("plans.jsonl", "out")
            with self.subTest(name=name):
                self.assertEqual(self.read("out/reports.jsonl"), whole)
                self.assertIn("6 pass", done.stderr)
                self.assertIn(f"; {kept} kept", done.stderr)
        self.assertEqual(os.listdir(self.path("out")), ["reports.jsonl"])

    def test_a_corrected_command_answers_nothing_from_the_wrong_one(self):
        self.write_lines("queries.jsonl", self.queries(15))
        base = ("--object", self.model(""), "--batch", "queries.jsonl", "--mu", "0.5", "--output",
                "plans.jsonl", "--jobs", "2")
        seen = set()
        start = ["--start", "random"]
        goal = ["--goal", "random"]
        for ends, code, counts in (
                ([], 2, "15 bad-input"), (start, 2, "15 bad-input"), ([*start, *goal], 0, "15 plan"),
                (["--start", "random-any", *goal], 0, "15 plan"),
                ([*start, "--goal", "random-any"], 0, "15 plan"),
                (["--start", "randm", *goal], 2, "15 bad-input"), ([*start, *goal], 0, "15 plan")):
            done = self.run_program(*base, *ends)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(counts, done.stderr.splitlines()[-1])
            self.assertNotIn("kept", done.stderr)
            seen.add(self.lines("plans.jsonl")[0]["run"])
            self.validate("plans.jsonl", "out")
            last = self.lines("out/reports.jsonl")
            self.assertEqual({line.get("verdict") for line in last[1:]},
                             {"pass" if counts == "15 plan" else "no-plan"})
        self.assertEqual(len(seen), 6, "the first and the last of two equal commands have one run")
        self.assertIn("15 kept", self.run_program(*base, *start, *goal).stderr)

    def test_failures_that_are_reused_are_printed_again(self):
        self.write_lines("queries.jsonl", self.queries(6))
        self.plan("plans.jsonl")
        _, *plans = self.lines("plans.jsonl")
        for plan in plans[::2]:
            plan["friction"]["half_angle_deg"] = 0.5
        self.write_lines("plans.jsonl", [*plans, "{"])
        said = [sorted(self.validate("plans.jsonl", "out", *more, code=2).stderr.splitlines())
                for more in ((), (), ("--quiet",))]
        failures = [line for line in said[0] if "fails: " in line]
        self.assertEqual(len(failures), 3)
        self.assertIn("6 kept", "".join(said[1]))
        for again in said[1:]:
            self.assertEqual([line for line in again if ": line " in line],
                             [line for line in said[0] if ": line " in line])

    def test_a_part_of_another_run_is_not_touched(self):
        self.write_lines("queries.jsonl", self.queries(3))
        self.plan("plans.jsonl")
        self.write("other.jsonl.part", self.read("plans.jsonl"))
        done = self.plan("other.jsonl", "--min-quality", "0.02", code=2)
        self.assertIn("other.jsonl.part: line 1: belongs to an interrupted run with different input", done.stderr)
        self.assertEqual(self.read("other.jsonl.part"), self.read("plans.jsonl"))
        self.plan("other.jsonl", "--min-quality", "0.02", "--restart")
        self.assertEqual(sorted(os.listdir(self.folder)),
                         ["other.jsonl", "plans.jsonl", "queries.jsonl"])

    def test_a_bad_line_is_named_and_stops_no_other(self):
        good = {"object": {"file": "cube.obj"}, "seed": 1, "note": "a member of the user's own"}
        bad = [("{", "not valid JSON"), ("", "not valid JSON"), ("[1]", "expected a JSON object"),
               ({"object": "cube.obj"}, "/object: expected a JSON object that names the file, found "
                '"cube.obj"; help: write {"object": {"file": "cube.obj"}}'),
               ({"object": 7}, "/object: expected a JSON object that names the file, found 7"),
               ({"seed": 1}, "/object/file: "),
               ({"object": {"file": "gone.obj"}}, '/object/file: "gone.obj" not found'),
               ({**good, "seed": -1}, "/seed"),
               ({**good, "friction": {}}, "/friction: expected half_angle_deg or mu"),
               ({**good, "friction": {"mu": 0}}, "/friction/mu: must be positive, found 0"),
               ({**good, "friction": {"half_angle_deg": 90}}, "must be between 0 and 90, found 90"),
               ({**good, "scale": 0}, "/scale: must be positive, found 0"),
               ({**good, "min_quality": -1}, "/min_quality: must not be negative, found -1"),
               ({**good, "start": "anywhere"}, "/start"),
               ({**good, "fricton": {"mu": 0.8}}, "unknown member fricton; similar: friction"),
               ({**good, "turn": "z,10"}, "unknown member turn: a query cannot have the option --turn"),
               ({**good, "friction_angle": 20},
                "unknown member friction_angle: a query cannot have the option --friction-angle"),
               ({"object": {"fil": "cube.obj"}},
                "/object: unknown member fil; similar: file"),
               ({**good, "start": {"format": "regrasp-grasp"}}, '/start: member "version" not found'),
               ({"object": {"file": "cube.obj", "sha256": "0" * 64}},
                f"/object/sha256: the query is for another file, expected cube.obj (SHA-256 "
                f"{'0' * 12}…), found ")]
        self.write_lines("queries.jsonl", [good, *(query for query, _ in bad), good])
        done = self.plan("plans.jsonl", code=2)
        said = done.stderr.splitlines()
        self.assertEqual(len(said), len(bad) + 1)
        _, first, *nothing, last = self.lines("plans.jsonl")
        self.assertEqual(first["format"], last["format"], "regrasp-plan")
        self.assertEqual(len(nothing), len(bad))
        for i, (_, words) in enumerate(bad):
            self.check_schema("lines", nothing[i])
            self.assertEqual((nothing[i]["query"], nothing[i]["verdict"]), (i + 2, "bad-input"))
            self.assertIn(f"queries.jsonl: line {i + 2}: ", nothing[i]["message"])
            self.assertIn(words, nothing[i]["message"])
            self.assertIn("plan: " + nothing[i]["message"], said)
        self.assertIn(f"2 plan, {len(bad)} bad-input", said[-1])
        # Entries without a plan are passed on and do not count as failures.
        self.assertIn(f"2 pass, {len(bad)} no-plan", self.validate("plans.jsonl", "out").stderr)

    def test_messages_of_many_bad_lines_are_few(self):
        self.write_lines("queries.jsonl", ["{"] * 100)
        said = self.plan("plans.jsonl", code=2).stderr.splitlines()
        self.assertEqual(len(said), 22)
        self.assertIn("80 more messages", said[20])

    def test_where_there_is_no_sequence_the_line_says_so(self):
        self.write_lines("queries.jsonl", [
            {"object": {"file": "stone.obj"}, "friction": {"half_angle_deg": 0.01}},
            {"object": {"file": "cube.obj"}, "friction": {"mu": 0.5}}])
        self.plan("plans.jsonl", code=1)
        _, none, plan = self.lines("plans.jsonl")
        self.assertEqual((none["format"], none["verdict"]), ("regrasp-none", "no-plan"))
        self.assertEqual(plan["format"], "regrasp-plan")

    def test_a_time_limit_is_that_of_each_query(self):
        self.write_lines("queries.jsonl", self.queries(3))
        done = self.plan("plans.jsonl", "--time-limit", "0.000001", code=1)
        self.assertIn("3 entries: 3 no-plan", done.stderr)
        for none in self.lines("plans.jsonl")[1:]:
            self.assertIn("time limit reached", none["message"])
        # Longer than one query takes, and shorter than all queries together.
        self.write_lines("queries.jsonl", self.queries(3) * 30)
        self.plan("more.jsonl", "--time-limit", "60")

    def test_queries_say_start_and_goal_themselves(self):
        ends = {}
        for end in ("start", "goal"):
            with open(self.model(f"cube.{end}.json"), encoding="utf-8") as file:
                ends[end] = json.load(file)
        query = {"object": {"file": "cube.obj"}, "friction": {"half_angle_deg": 20}, **ends}
        self.write_lines("queries.jsonl", [query])
        self.assert_done("--object", self.model(""), "--batch", "queries.jsonl", "--output",
                         "plans.jsonl")
        self.assert_done("--object", self.model("cube.obj"), "--friction-angle", "20", "--start",
                         self.model("cube.start.json"), "--goal", self.model("cube.goal.json"),
                         "--output", "one.json")
        plan = self.lines("plans.jsonl")[1]
        plan.pop("query")
        self.unseal(plan)
        self.assertEqual(plan, json.loads(self.read("one.json")))

    def test_objects_are_found_by_their_digests(self):
        os.mkdir(self.path("objects"))
        shutil.copy(self.model("cube.obj"), self.path("objects/renamed.obj"))
        with open(self.model("cube.obj"), "rb") as file:
            sha256 = hashlib.sha256(file.read()).hexdigest()
        query = {"object": {"file": "cube.obj", "sha256": sha256}}
        self.write_lines("queries.jsonl", [query])
        self.assert_done("--object", "objects", "--batch", "queries.jsonl", *ENDS, "--output",
                         "plans.jsonl")
        plan = self.lines("plans.jsonl")[1]
        self.assertEqual(plan["object"]["sha256"], sha256)
        os.rename(self.path("objects/renamed.obj"), self.path("objects/again.obj"))
        self.assert_done("--object", "objects", "--plan", "plans.jsonl", "--output", "out",
                         program="validate")
        # A plan is a bad line if no file has its digest.
        plan["object"]["sha256"] = "0" * 64
        plan["object"]["file"] = "again.obj"
        self.write_lines("bad.jsonl", [plan])
        done = self.run_program("--object", "objects", "--plan", "bad.jsonl", "--output", "bad",
                                program="validate")
        self.assertEqual(done.returncode, 2)
        self.assertIn("validate: bad.jsonl: line 1: /object/sha256: the plan is for another object "
                      "file, expected again.obj (SHA-256 000000000000…), found objects", done.stderr)

    def test_failing_plans_have_frames_where_that_is_asked(self):
        self.write_lines("queries.jsonl", self.queries(3))
        self.plan("plans.jsonl")
        header, *plans = self.lines("plans.jsonl")
        self.assertEqual(header["entries"], 3)
        plans[1]["friction"]["half_angle_deg"] = 0.5
        self.write_lines("plans.jsonl", plans)
        for frames, folders in (([], []), (["--frames", "failed"], ["0000002"])):
            done = self.validate("plans.jsonl", "out", *frames, "--restart", code=1)
            self.assertIn("plans.jsonl: line 2: step 0 (hold) fails", done.stderr)
            self.assertIn("2 pass, 1 fail", done.stderr)
            self.assertEqual(sorted(os.listdir(self.path("out"))), [*folders, "reports.jsonl"])
        left = os.listdir(self.path("out/0000002"))
        self.assertLessEqual({"plan.json", "report.json", "report.html", "000_hold.png"}, set(left))
        # The same for a plan in its own file.
        for plan, pictures in ((plans[0], False), (plans[1], True)):
            self.write_json("one.json", plan)
            self.run_program("--object", self.model(""), "--plan", "one.json", "--output", "one",
                             "--frames", "failed", program="validate")
            self.assertEqual(os.path.exists(self.path("one/000_hold.png")), pictures)

    def test_a_file_that_was_cut_is_refused(self):
        self.write_lines("queries.jsonl", self.queries(3))
        self.plan("plans.jsonl")
        whole = self.read("plans.jsonl")
        for cut, words in ((whole[:-1], "truncated inside line 4"),
                           (whole[:whole.rfind(b"\n", 0, -1) + 1], "expected 3 entries as in the header, found 2"),
                           (whole[:50], "line 1")):
            self.write("cut.jsonl", cut)
            done = self.validate("cut.jsonl", "out", code=2)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertIn(f"validate: error: cut.jsonl: {words}", done.stderr)

    def test_shards_that_do_not_fit_are_not_merged(self):
        self.write_lines("queries.jsonl", self.queries(6))
        for shard in ("1/2", "2/2", "2/3"):
            self.plan(shard.replace("/", "of"), "--shard", shard)
        self.write("cut", self.read("2of2")[:-1])
        for words, shards in (("1 of 2 shards not found: numbers 2", ["1of2"]),
                              ("2of2: line 1: shard 2 of 2 must be given once, found it in 2of2 too",
                               ["1of2", "2of2", "2of2"]),
                              ("2of3: line 1: expected a shard of 2, found shard 2 of 3; the first shard is 1of2", ["1of2", "2of3"]),
                              ("cut: line 4: truncated", ["1of2", "cut"]),
                              ("queries.jsonl: line 1: expected a header", ["queries.jsonl"]),
                              ("gone: no such file", ["gone"]),
                              ("--output: 1of2", ["2of2"])):
            output = "1of2" if words.startswith("--output") else "merged"
            words = words if output == "merged" else "1of2"
            inputs = shards if output == "merged" else ["1of2", "2of2"]
            self.assert_refused(2, words, "--shards", *inputs, "--output", output, program="merge")
        self.merge("merged", "1of2", "2of2")

    def test_options_that_do_not_go_together_are_refused(self):
        self.write_lines("queries.jsonl", self.queries(3))
        one = ("--object", self.model("cube.obj"), *ENDS)
        for option in (["--jobs", "2"], ["--shard", "1/2"], ["--restart"]):
            self.assert_refused(2, f"{option[0]} requires --batch", *one, "--output", "o", *option)
        many = (*one, "--batch", "queries.jsonl")
        for words, rest in (("--shard: expected I/N", ["--output", "o", "--shard", "3/2"]),
                            ("--output: with --batch must be a file", ["--output", "-"]),
                            ("queries.jsonl", ["--output", "queries.jsonl"])):
            self.assert_refused(2, words, *many, *rest)
        self.assert_refused(2, "gone.jsonl: no such file", *one, "--batch", "gone.jsonl", "--output", "o")
        self.plan("plans.jsonl")
        plans = ("--object", self.model(""), "--plan", "plans.jsonl")
        for option in (["--junit", "j"], ["--json", "-"], ["--trajectory", "t"]):
            self.assert_refused(2, f"{option[0]}: cannot be used with a file of plans", *plans, *option,
                                program="validate")
        self.assert_refused(2, "--frames animation: cannot be used with a file of plans", *plans, "--frames",
                            "animation", program="validate")
        self.write_json("plan.json", self.lines("plans.jsonl")[1])
        self.assert_refused(2, "--shard: requires a file of plans", "--object", self.model(""),
                            "--plan", "plan.json", "--shard", "1/2", program="validate")


if __name__ == "__main__":
    program_case.main()
