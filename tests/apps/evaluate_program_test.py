"""evaluate tests grasps by a whole hand: known answers, bad input, interrupted runs."""

import json
import os
import re
import signal
import subprocess
import time

import hand_grasp_files
import program_case
from hand_grasp_files import TARGET, grasp
from program_case import ProgramCase

ALL = "analytic,dexgraspbench,fall,disturbance"


class Evaluate(ProgramCase):
    program = "evaluate"

    def setUp(self):
        super().setUp()
        hand_grasp_files.write_hand(self.folder)

    def arguments(self, name="grasps.jsonl", output="reports.jsonl", protocol=ALL):
        return ["--grasps", name, "--hand", "gripper.json", "--object", "objects", "--protocol", protocol,
                "--output", output]

    def judged(self, grasps, *more, code, output="reports.jsonl", protocol=ALL):
        """Return the reports of the grasps by id."""
        self.write("grasps.jsonl", hand_grasp_files.lines(grasps))
        done = self.run_program(*self.arguments(output=output, protocol=protocol), "--restart", *more)
        self.assertEqual(done.returncode, code, done.stderr)
        entries = [json.loads(line) for line in self.read(output).splitlines()]
        return {entry["id"]: entry for entry in entries if "id" in entry}

    def result(self, report, protocol):
        return next(result for result in report["protocols"] if result["protocol"] == protocol)

    def test_known_grasps_have_their_verdicts(self):
        reports = self.judged([grasp("hold", target=TARGET), grasp("derived"), grasp("open", 0.0),
                               grasp("deep", hand_grasp_files.TOUCH + 0.005)], code=1)
        for name in "hold", "derived":
            report = reports[name]
            self.assertEqual(report["verdict"], "pass", report)
            self.assertEqual({link["link"]: link["contacts"] for link in report["links"]}, {"left": 4, "right": 4})
            self.assertEqual(self.result(report, "fall")["seconds"], [3] * 6)
            self.assertLess(self.result(report, "dexgraspbench")["moved_mm"], 5)
            # Two pads of 10 N at friction 0.6 resist at most 12 N.
            resisted = self.result(report, "disturbance")["resisted_N"]
            self.assertGreater(min(resisted), 1)
            self.assertLess(max(resisted), 12)
        self.assertEqual((reports["open"]["verdict"], reports["open"]["reason"]), ("fail", "no-contact"))
        self.assertEqual(reports["open"]["links"], [])
        self.assertAlmostEqual(reports["open"]["distance_mm"], 25)
        self.assertEqual(reports["deep"]["reason"], "penetrates")
        self.assertAlmostEqual(reports["deep"]["distance_mm"], -5, delta=0.06)

    def test_every_reason_is_explained(self):
        with open(os.path.join(program_case.ARGUMENTS.source, "sim/hand_grasps/grasp_protocols.cc"), encoding="utf-8") as file:
            names = re.search(r"kNames = \{\s*\"none\",(.*?)\}", file.read(), re.DOTALL).group(1)
        names = re.findall(r'"([a-z-]+)"', names)
        self.assertIn("dropped", names)
        text = self.assert_done("--explain", "all").stdout
        self.assertEqual(re.findall(r"^### `(.*)`$", text, re.MULTILINE), names)

    def test_low_friction_drops_the_object(self):
        """Negative control: the same grasp without friction fails each test."""
        held = [grasp("hold", target=TARGET)]
        self.assertEqual(self.judged(held, code=0)["hold"]["verdict"], "pass")
        report = self.judged(held, "--mu", "0.05", code=1)["hold"]
        reasons = {result["protocol"]: result.get("reason") for result in report["protocols"]}
        self.assertEqual(reasons, {"analytic": None, "dexgraspbench": "object-moved", "fall": "dropped",
                                   "disturbance": "force-not-resisted"})
        self.assertEqual(report["reason"], "object-moved")

    def test_more_friction_resists_more(self):
        least = []
        for mu in ("0.05", "0.3", "0.6", "0.9"):
            report = self.judged([grasp("hold", target=TARGET)], "--mu", mu,
                                 code=1 if mu == "0.05" else 0, protocol="disturbance")["hold"]
            least.append(min(self.result(report, "disturbance")["resisted_N"]))
        self.assertEqual(least, sorted(least))
        self.assertLess(least[0], least[-1])

    def test_order_of_grasps_and_number_of_processes_change_no_report(self):
        grasps = [grasp("hold", target=TARGET), grasp("open", 0.0), grasp("half", 0.025, palm={
            "position": [0, 0, -0.05], "quaternion": [0, 0, 0, 1]}), grasp("deep", 0.03)]

        def contents(reports):
            return {name: {key: value for key, value in report.items() if not key.endswith("sha256") and
                           key != "query"} for name, report in reports.items()}
        first = contents(self.judged(grasps, "-j", "1", code=1, protocol="analytic,fall"))
        self.assertEqual(contents(self.judged(grasps[::-1], "-j", "3", code=1, protocol="analytic,fall")), first)
        self.assertEqual({report["verdict"] for report in first.values()}, {"pass", "fail"})

    def test_table_compares_claims_with_verdicts(self):
        self.write("grasps.jsonl", hand_grasp_files.lines([
            grasp("a", claimed=True), grasp("b", 0.0, claimed=True), grasp("c", 0.0, claimed=False), grasp("d")]))
        done = self.run_program(*self.arguments(protocol="analytic"))
        self.assertEqual(done.returncode, 1)
        rows = [line.split() for line in done.stdout.splitlines()]
        self.assertIn(["box.obj", "1", "1", "0", "1", "1", "0"], rows)
        self.assertIn(["no-contact", "2"], rows)
        header = "object   claimed success: pass  fail  claimed failure: pass  fail  no claim: pass  fail"
        self.assertIn(header.split(), rows)

    def test_table_omits_claims_that_no_grasp_makes(self):
        self.write("grasps.jsonl", hand_grasp_files.lines([grasp("a"), grasp("b", 0.0)]))
        done = self.run_program(*self.arguments(protocol="analytic"))
        self.assertNotIn("claimed", done.stdout)
        self.assertIn(["box.obj", "1", "1"], [line.split() for line in done.stdout.splitlines()])
        self.write("grasps.jsonl", "{}\n")
        done = self.run_program(*self.arguments("--restart", protocol="analytic"))
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_violated_conventions_are_named(self):
        cases = [
            (grasp("x", palm={"position": [0, 0, -0.05], "quaternion": [1, 1, 0, 0]}),
             "/palm/quaternion: must be a unit quaternion w, x, y, z, found length 1.414"),
            (grasp("x", joints={"left_slide": 0.02, "thumb": 0.02}), 'unknown joint "thumb", expected left_slide, right_slide'),
            (grasp("x", joints={"left_slide": 0.02}), 'joint "right_slide" not found'),
            (grasp("x", object={"file": "box.obj", "scale": 1000}), "a scale of 1 gives"),
            (grasp("x", object={"file": "box.obj", "scale": 0.001}), "a scale of 1 gives"),
            (grasp("x", palm={"position": [0, 0, -50], "quaternion": [1, 0, 0, 0]}), "convert millimetres to metres"),
            (grasp("x", object={"file": "gone.obj", "scale": 1}), "gone.obj"),
            (grasp("x", closing={"thumb": 1}), '/closing: unknown joint "thumb"'),
            (grasp("x", target=TARGET, closing={"left_slide": 1}), "/closing: cannot be used with target"),
            (grasp("x", closing={"left_slide": "1"}), "/closing/left_slide"),
            (grasp("x", pregrap={}), 'unknown member "pregrap"')]
        self.write("grasps.jsonl", hand_grasp_files.lines([bad for bad, _ in cases] + [grasp("good")]))
        done = self.run_program(*self.arguments(protocol="analytic"), "-q")
        self.assertEqual(done.returncode, 2, done.stderr)
        entries = [json.loads(line) for line in self.read("reports.jsonl").splitlines()][1:]
        for (_, words), entry in zip(cases, entries):
            self.assertEqual(entry["verdict"], "bad-input", words)
            self.assertIn(words, entry["message"])
        self.assertEqual(entries[-1]["verdict"], "pass")
        self.assertEqual(len(done.stderr.splitlines()), len(cases), done.stderr)

    def test_degrees_are_named(self):
        self.write("gripper.xml", hand_grasp_files.GRIPPER.replace('type="slide" range="0 0.05"',
                                                                   'range="0 1.5"'))
        self.write("grasps.jsonl", hand_grasp_files.lines([grasp("x", 45)]))
        done = self.run_program(*self.arguments(protocol="analytic"), "-q")
        self.assertEqual(done.returncode, 2)
        self.assertIn("/joints/left_slide: outside its range, expected 0 to 1.5 rad, found 45; help: convert degrees",
                      done.stderr)

    def test_quaternions_with_the_scalar_last_are_a_likely_cause(self):
        # A half turn about z in the order x, y, z, w is the pose (0, 0, 1, 0): upside down.
        wrong = grasp("x", palm={"position": [0, 0, -0.05], "quaternion": [0, 0, 1, 0]})
        report = self.judged([wrong], code=1, protocol="analytic")["x"]
        self.assertEqual(report["reason"], "no-contact")
        self.assertEqual(report["likely_cause"], "quaternions in the order x, y, z, w")
        self.assertNotIn("likely_cause", self.judged([grasp("open", 0.0)], code=1, protocol="analytic")["open"])

    def test_hostile_lines_are_bad_input_and_others_are_judged(self):
        text = json.dumps(grasp("x"))
        bad = [text.replace("-0.05", "NaN"), text.replace('[1, 0, 0, 0]', '"w"'), text[:-20], "[]", "{}",
               text.replace('"joints": {', '"joints": [') .replace('0.025}', '0.025]'), text.replace("0.025", "1e999"),
               text.replace('"version": 1', '"version": 2'), text.replace('"scale": 1', '"scale": -1'),
               text.replace('"x"', json.dumps("x" * 100000)), "[" * 100000, "\x00", text.replace("box.obj", "../../etc/passwd"),
               json.dumps(grasp("x", joints={f"j{i}": 0 for i in range(100000)}))]
        self.write("grasps.jsonl", "\n".join([*bad, text]) + "\n")
        done = self.run_program(*self.arguments(protocol="analytic"), "-q")
        self.assertEqual(done.returncode, 2, done.stderr)
        entries = [json.loads(line) for line in self.read("reports.jsonl").splitlines()][1:]
        self.assertEqual([entry["verdict"] for entry in entries], ["bad-input"] * len(bad) + ["pass"])

    def test_bad_files_are_one_line(self):
        self.write("grasps.jsonl", hand_grasp_files.lines([grasp("x")]))
        for name, text, words in (("gripper.json", "{}", 'member "format" not found'),
                                  ("gripper.json", json.dumps({"format": "regrasp-hand", "version": 1, "name": "g",
                                                               "model": "gripper.xml", "palm": "hand"}),
                                   '/palm: body "hand" not found in the model')):
            kept = self.read(name)
            self.write(name, text)
            self.assert_refused(2, words, *self.arguments())
            self.write(name, kept)
        self.assert_refused(2, "gone.jsonl", *self.arguments("gone.jsonl"))
        self.assert_refused(2, 'found "drop"', *self.arguments(protocol="drop"))
        self.assert_refused(2, "--output", *self.arguments(output="grasps.jsonl"))

    def test_pieces_of_an_object_are_inputs(self):
        self.write("grasps.jsonl", hand_grasp_files.lines([grasp("a"), grasp("b")]))
        os.makedirs(self.path("objects/box_pieces"))
        self.write("objects/box_pieces/0.obj", hand_grasp_files.box())
        self.assertNotIn("kept", self.assert_done(*self.arguments(protocol="fall")).stderr)
        self.assertIn("2 kept", self.assert_done(*self.arguments(protocol="fall")).stderr)
        self.write("objects/box_pieces/0.obj", "no mesh")
        done = self.run_program(*self.arguments(protocol="fall"), "-q")
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("box_pieces/0.obj"), 2, done.stderr)

    def test_a_killed_run_continues_with_the_same_bytes(self):
        grasps = [grasp(f"g{i}", 0.025 if i % 3 else 0.0) for i in range(12)]
        self.write("grasps.jsonl", hand_grasp_files.lines(grasps))
        self.run_program(*self.arguments(output="whole.jsonl", protocol="fall"))
        command = [os.path.join(program_case.ARGUMENTS.programs, "evaluate"), *self.arguments(protocol="fall"), "-j", "1"]
        with subprocess.Popen(command, cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as run:
            part = self.path("reports.jsonl.part")
            while run.poll() is None and not (os.path.exists(part) and self.read("reports.jsonl.part").count(b"\n") > 3):
                time.sleep(0.01)
            run.send_signal(signal.SIGKILL)
        self.assertTrue(os.path.exists(part), "the run ended before it was killed")
        done = self.run_program(*self.arguments(protocol="fall"))
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"[1-9]\d* kept from an earlier run")
        self.assertEqual(self.read("reports.jsonl"), self.read("whole.jsonl"))

    def test_shards_join_to_the_whole(self):
        grasps = [grasp(f"g{i}", 0.025 if i % 2 else 0.0) for i in range(5)]
        self.write("grasps.jsonl", hand_grasp_files.lines(grasps))
        self.run_program(*self.arguments(output="whole.jsonl", protocol="analytic"))
        for shard in "1/2", "2/2":
            self.run_program(*self.arguments(output=f"part{shard[0]}.jsonl", protocol="analytic"), "--shard", shard)
        self.assert_done("--shards", "part2.jsonl", "part1.jsonl", "--output", "joined.jsonl", program="merge")
        self.assertEqual(self.read("joined.jsonl"), self.read("whole.jsonl"))


if __name__ == "__main__":
    program_case.main()
