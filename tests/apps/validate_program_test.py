"""The program validate from the shell: verdicts, outputs, and invalid input."""

import copy
import csv
import fcntl
import hashlib
import json
import math
import os
import re
import shutil
import subprocess
import threading
import xml.etree.ElementTree as ElementTree

import program_case
from picture_pixels import png_rows, png_size
from program_case import ProgramCase

XHTML = "{http://www.w3.org/1999/xhtml}"
SVG = "{http://www.w3.org/2000/svg}"

# Time limit, s, far above the time that the browser needs for a page.
BROWSER_SECONDS = 120


def inked_rows(data):
    """Return the number of PNG rows with several colours: more than their first filtered pixel is
    nonzero."""
    return sum(len(set(row[5:])) > 2 for row in png_rows(data))


class Validate(ProgramCase):
    program = "validate"

    def setUp(self):
        super().setUp()
        self.plan = self.plan_of_cube()
        self.write_plan()

    def test_a_terminal_is_told_what_is_done_from_the_first_moment(self):
        arguments = self.arguments("--frames", "none")
        done, shown = self.run_on_terminal(*arguments)
        self.assertEqual(done.returncode, 0, shown)
        self.assert_stages(shown, "reading ", "checking 6 facets", "preparing 6 faces",
                           "checking the plan")
        self.assertEqual(self.run_on_terminal(*arguments, "--quiet")[1], "")

    def on_terminal(self, columns, code, *more, **environment):
        done, shown = self.run_on_terminal(*self.arguments("--frames", "none", *more), stream="stdout", columns=columns,
                                           environment=environment)
        self.assertEqual(done.returncode, code, shown)
        return shown.replace("\r\n", "\n")

    def test_a_terminal_has_the_verdict_first_and_wrapped_reasons(self):
        shown = self.on_terminal(60, 1, "--friction-angle", "6")
        colour = re.compile("\x1b\\[[0-9;]*m")
        plain = colour.sub("", shown)
        lines = plain.splitlines()
        self.assertTrue(shown.startswith("verdict: \x1b[31mfail\x1b[0m\nstep 0 (hold) fails: "
                                         .replace("step", "\x1b[31mstep")), repr(shown[:80]))
        self.assertTrue(lines[-1].startswith("files: "), lines)
        self.assertTrue(any(line.startswith("  why: ") for line in lines[:6]), lines)
        prose = [line for line in lines if "  " not in line.strip()]
        self.assertLessEqual(max(map(len, prose)), 60, prose)
        self.assertGreater(len(plain.splitlines()), 12)
        # The same words, in a different order, as without a terminal.
        piped = self.run_program(*self.arguments("--frames", "none", "--friction-angle", "6"))
        self.assertNotIn("\x1b", piped.stdout)
        self.assertTrue(piped.stdout.splitlines()[-1].startswith("verdict: fail, step 0 (hold) fails: "))
        self.assertLessEqual(set(plain.split()), set(piped.stdout.split()) | {"fail"})
        self.assertGreater(max(map(len, piped.stdout.splitlines())), 120)
        self.assertTrue(self.on_terminal(0, 0).startswith("verdict: \x1b[32mpass\x1b[0m\n"))

    def test_colour_can_be_disabled(self):
        for environment in ({"NO_COLOR": "1"}, {"TERM": "dumb"}, {"CLICOLOR": "0"}):
            shown = self.on_terminal(80, 0, **environment)
            self.assertTrue(shown.startswith("verdict: pass\n"), environment)
            self.assertNotIn("\x1b", shown)
        self.assertIn("\x1b", self.on_terminal(80, 0, NO_COLOR="", CLICOLOR="1"))  # control

    def write_plan(self):
        self.write_json("plan.json", self.plan)

    def arguments(self, *more, **changes):
        options = {"--object": self.model("cube.obj"), "--plan": "plan.json", "--output": "result"}
        options.update({"--" + key.replace("_", "-"): value for key, value in changes.items()})
        return [word for key, value in options.items() if value is not None
                for word in (key, value)] + list(more)

    def frames(self):
        return sorted(name for name in os.listdir(self.path("result"))
                      if name.endswith(".png") and name != "overview.png")

    def page(self, folder="result"):
        """Return the report page as an element tree: it is also well-formed XML."""
        text = self.read(folder + "/report.html").decode("utf-8")
        return ElementTree.fromstring(text.replace("<!DOCTYPE html>", "", 1))

    def page_text(self, folder="result"):
        return " ".join("".join(self.page(folder).find(f"{XHTML}body").itertext()).split())

    def screenshot(self, name):
        """Return the screenshot of a page in headless Chromium, which must be installed."""
        browser = shutil.which("chromium")
        self.assertIsNotNone(browser, "chromium is not installed: run scripts/setup --test")
        picture = self.path("page.png")
        done = subprocess.run(
            [browser, "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
             "--user-data-dir=" + self.path("browser"), "--window-size=1000,1400",
             "--screenshot=" + picture, "file://" + self.path(name)],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=BROWSER_SECONDS, check=False)
        self.assertTrue(os.path.exists(picture), done.stdout)
        return self.read("page.png")

    def assert_passes(self, *more, **changes):
        done = self.assert_done(*self.arguments(*more, **changes))
        report = self.report()
        self.assertEqual(report["verdict"], "pass")
        return done, report

    def assert_fails(self, index, reason, *more, **changes):
        """Expect exit code 1 and this reason at this step; earlier steps pass and later steps are
        skipped."""
        done = self.run_program(*self.arguments("--frames", "none", *more, **changes))
        self.assertEqual(done.returncode, 1, done.stderr)
        report = self.report()
        verdicts = [step["verdict"] for step in report["steps"]]
        reasons = [step["reason"] for step in report["steps"]]
        after = len(report["steps"]) - index - 1
        self.assertEqual(report["verdict"], "fail")
        self.assertEqual(verdicts, ["pass"] * index + ["fail"] + ["skipped"] * after, reasons)
        self.assertEqual(reasons, [None] * index + [reason] + [None] * after)
        return report

    def refuse(self, words, *more, code=2, **changes):
        return self.assert_refused(code, words, *self.arguments(*more, **changes))

    # Valid plan.

    def test_passes_a_good_plan_with_a_frame_for_each_step(self):
        done, report = self.assert_passes(size="320x240")
        steps = report["steps"]
        self.assertEqual(len(steps), len(self.plan["steps"]) + 1)
        self.assertEqual([step["index"] for step in steps], list(range(len(steps))))
        self.assertEqual([step["kind"] for step in steps],
                         ["hold"] + [step["kind"] for step in self.plan["steps"]])
        self.assertEqual(self.frames(), [step["frame"] for step in steps])
        self.assertEqual(self.frames()[:2], ["000_hold.png", "001_switch.png"])
        for step in steps:
            self.assertTrue(step["force_closure"]["holds"])
            self.assertLess(step["force_closure"]["required_half_angle_deg"], 20)
            self.assertLess(step["simulation"]["displacement_m"], 1e-4)
            self.assertEqual(png_size(self.read("result/" + step["frame"])), (320, 240))
        self.assertIn("weakest: step", done.stdout)
        self.assertIn("verdict: pass", done.stdout)
        self.assertEqual(done.stderr, "")

    def test_both_protocols_are_told_apart_and_the_adapted_one_decides(self):
        done, report = self.assert_passes("--frames", "none", disturbance="both")
        self.assertIn("fixed_force", done.stdout)
        for step in report["steps"]:
            self.assertEqual(set(step["protocols"]), {"adapted", "fixed"})
            self.assertEqual(step["simulation"]["motion_m"],
                             step["protocols"]["adapted"]["motion_m"])
        done, report = self.assert_passes("--frames", "none", disturbance="both,0.06")
        disagreements = [step for step in report["steps"] if step["cause"]]
        self.assertTrue(disagreements)
        for step in disagreements:
            self.assertEqual(step["cause"]["between"], "fixed-fails")
            self.assertEqual(step["protocols"]["fixed"]["verdict"], "fail")
            self.assertIn(step["cause"]["text"], done.stdout)
        self.assertIn("Likely cause", self.page_text())
        first = disagreements[0]["index"]
        failed = self.assert_fails(first, disagreements[0]["protocols"]["fixed"]["reason"],
                                   disturbance="fixed,0.06")
        self.assertEqual(set(failed["steps"][first]["protocols"]), {"fixed"})
        self.assertNotIn("fixed_force", self.assert_passes("--frames", "none")[0].stdout)
        self.refuse("--disturbance: ", disturbance="loose")
        self.refuse("--disturbance: found adapted and fixed, expected one of them",
                    disturbance="adapted,0.01,fixed")

    def test_a_second_engine_judges_the_same_plan(self):
        done, report = self.assert_passes("--frames", "none", engine="ode")
        self.assertEqual(report["settings"]["engine"], "ode")
        mujoco = self.assert_passes("--frames", "none")[1]
        self.assertEqual(mujoco["settings"]["engine"], "mujoco")
        for one, other in zip(report["steps"], mujoco["steps"], strict=True):
            self.assertNotEqual(one["simulation"]["motion_m"], other["simulation"]["motion_m"])
        done, both = self.assert_passes("--frames", "none", engine="both")
        self.assertIn(f"engines: MuJoCo and ODE agree on {len(both['steps'])} steps", done.stdout)
        for step, by_mujoco, by_ode in zip(both["steps"], mujoco["steps"], report["steps"],
                                           strict=True):
            engines = step["engines"]
            self.assertIsNone(engines["cause"])
            self.assertEqual(engines["mujoco"]["motion_m"], by_mujoco["simulation"]["motion_m"])
            self.assertEqual(engines["ode"]["motion_m"], by_ode["simulation"]["motion_m"])
        # A failure in one engine is a failure in the other, too.
        failed = self.assert_fails(0, "contact-lost", engine="both", disturbance="0.6")
        self.assertEqual(failed["steps"][0]["engines"]["ode"]["verdict"], "fail")
        self.assert_fails(0, failed["steps"][0]["engines"]["ode"]["reason"], engine="ode",
                          disturbance="0.6")
        self.refuse('--engine: expected one of mujoco, ode, both, found "bullet"', engine="bullet")
        self.refuse("--engine", "--engine")

    def test_stress_finds_the_largest_push_by_two_routes(self):
        done, report = self.assert_passes("--frames", "none", "--disturbance", "limits")
        self.assertIn("largest resisted disturbance", done.stdout)
        self.assertIn("Largest disturbance", self.page_text())
        checked = 0
        for step in report["steps"]:
            self.assertEqual(len({push["direction"] for push in step["stress"]}), 12)
            for push in step["stress"]:
                self.assertAlmostEqual(push["replay"], push["analysis"],
                                       delta=0.03 * push["analysis"])
                checked += 1
        self.assertEqual(checked, 12 * len(report["steps"]))
        least = report["margins"]["stress"]
        self.assertEqual(least["replay"], min(push["replay"] for step in report["steps"]
                                              for push in step["stress"]))
        self.assertNotIn("stress", self.assert_passes("--frames", "none")[1]["steps"][0])

    def test_quiet_prints_nothing(self):
        done, _ = self.assert_passes("--quiet", "--frames", "none")
        self.assertEqual(done.stdout + done.stderr, "")

    def test_a_failed_plan_prints_first_what_failed_why_and_help(self):
        contact = self.plan["initial"]["contacts"][0]
        contact["point"][0] += 0.004
        self.write_plan()
        done = self.run_program(*self.arguments("--frames", "none"))
        said = done.stdout.splitlines()
        self.assertRegex(said[0], r"^step 0 \(hold\) fails: off-surface: finger \d is 4 mm off the "
                                  r"surface$")
        self.assertRegex(said[1], r"^  why: a contact must be on the surface to within 0\.0001 % of ")
        self.assertRegex(said[2], r"^  help: .*surface")
        self.assertEqual(said[3], "  more: regrasp validate --explain off-surface")
        self.assertEqual(said[-1], "verdict: fail, " + said[0])
        self.assertEqual(said[-2], "files: result/report.html, report.json")
        self.assertNotIn("weakest", done.stdout)
        quiet = self.run_program(*self.arguments("--frames", "none", "--quiet"))
        self.assertEqual((quiet.returncode, quiet.stdout), (1, ""))
        self.assertTrue(quiet.stderr.startswith("validate: " + said[0]), quiet.stderr)
        self.assertEqual(quiet.stderr.count("\n"), 1)

    def test_terminal_quiet_page_report_and_junit_say_a_failure_in_the_same_words(self):
        arguments = self.arguments("--frames", "none", "--junit", "junit.xml", tolerance="1e-12")
        headline, why, mend = self.run_program(*arguments).stdout.splitlines()[:3]
        why, mend = why.removeprefix("  why: "), mend.removeprefix("  help: ")
        self.assertRegex(headline, r"slipped: finger \d slips [\d.]+ .m ")
        failed = self.report()["steps"][0]
        self.assertTrue(headline.endswith(": slipped: " + failed["detail"]), headline)
        self.assertEqual((failed["why"], failed["mend"]), (why, mend))
        self.assertNotIn("why", self.report()["steps"][1])
        case = ElementTree.fromstring(self.read("junit.xml")).find("testsuite/testcase/failure")
        self.assertEqual(case.text, f"{failed['detail']}\nwhy: {why}\nhelp: {mend}")
        for words in (failed["detail"][1:], why, mend):
            self.assertIn(words, self.page_text())
        quiet = self.run_program(*arguments, "--quiet").stderr
        self.assertEqual(quiet, f"validate: {headline}; why: {why}; help: {mend}\n")

    def test_the_friction_that_a_failed_plan_asks_for_passes_the_analytic_check(self):
        done = self.run_program(*self.arguments("--frames", "none", friction_angle="2"))
        self.assertEqual(done.returncode, 1)
        asked = re.search(r"--friction-angle (\S+) or --mu", done.stdout)[1]
        self.run_program(*self.arguments("--frames", "none", friction_angle=asked))
        step = self.report()["steps"][0]
        self.assertTrue(step["force_closure"]["holds"])
        self.run_program(*self.arguments("--frames", "none", friction_angle=str(float(asked) - 0.02)))
        self.assertFalse(self.report()["steps"][0]["force_closure"]["holds"])

    def test_a_realistic_squeeze_is_what_a_hand_applies(self):
        weight = 0.216 * 9.81
        done, report = self.assert_passes("--frames", "none", grasp_force="realistic")
        self.assertEqual(report["settings"]["squeeze_source"], "hand")
        self.assertLess(weight, report["settings"]["squeeze_N"])
        self.assertLess(report["settings"]["squeeze_N"], 50 * weight)
        self.assertIn("2 × what the weight requires", done.stdout)
        report = self.assert_passes("--frames", "none")[1]
        self.assertEqual(report["settings"]["squeeze_source"], "shake")
        self.assertAlmostEqual(report["settings"]["squeeze_N"], 1000 * weight, places=6)
        # A hand drops an object of 50 kg, which the default grasp force of the disturbance test
        # holds.
        self.assert_passes("--frames", "none", mass="50")
        heavy = ["--frames", "none", "--mass", "50", "--grasp-force", "realistic"]
        done = self.run_program(*self.arguments(*heavy))
        self.assertEqual((done.returncode, self.report()["settings"]["squeeze_N"]), (1, 200))
        self.assertEqual(self.report()["steps"][0]["cause"]["cause"], "weight")
        self.assertIn("200 N, 0.4077 × weight: largest grasp force of a hand", done.stdout)

    def test_says_how_large_and_heavy_the_object_is_and_warns_of_what_no_hand_holds(self):
        done, _ = self.assert_passes("--frames", "none")
        self.assertIn("object: 10.4 cm across, 216 g\n", done.stdout)
        for scale, size in ((1000, "104 m across, 2.16e+08 kg"), (0.01, "1.04 mm across, 216 µg")):
            self.plan["object"]["scale"] = scale
            self.write_plan()
            done = self.run_program(*self.arguments("--frames", "none"))
            self.assertIn(f"object: {size}\n", done.stdout)
            self.assertRegex(done.stderr, f"validate: warning: the object is {re.escape(size)}.*"
                                          "--scale")

    def test_bodies_of_all_sizes_get_the_same_verdicts_for_the_same_reasons(self):
        def replayed(scale, *options):
            self.plan["object"]["scale"] = scale
            self.write_plan()
            done = self.run_program(*self.arguments("--frames", "none", *options))
            self.assertIn(done.returncode, (0, 1), done.stderr)
            return done.returncode, self.report()["steps"]

        for options, code in ((), 0), (("--disturbance", "0.6"), 1):
            expected = replayed(1, *options)
            self.assertEqual(expected[0], code)
            for scale in (1e-6, 1e-4, 1e3, 1e6):
                with self.subTest(scale=scale, options=options):
                    got = replayed(scale, *options)
                    self.assertEqual(got[0], code)
                    self.assertEqual(len(got[1]), len(expected[1]))
                    for one, other in zip(expected[1], got[1]):
                        self.assertEqual((one["verdict"], one["reason"]),
                                         (other["verdict"], other["reason"]))
                        if one["simulation"] is None:
                            self.assertIsNone(other["simulation"])
                            continue
                        moved = one["simulation"]["displacement_m"]
                        self.assertLess(abs(other["simulation"]["displacement_m"] / scale - moved),
                                        0.01 * moved + 1e-9)

    def test_a_plan_comes_by_standard_input_and_the_report_goes_to_standard_output(self):
        arguments = self.arguments("--frames", "none", "--json", "-", plan="-", output=None)
        done = subprocess.run(
            [os.path.join(program_case.ARGUMENTS.programs, "validate"), *arguments],
            input=json.dumps(self.plan), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            cwd=self.folder, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(json.loads(done.stdout)["verdict"], "pass")
        self.assertEqual(done.stdout.encode(), self.read("out/plan/report.json"))
        # No plan there, and two plans.
        self.refuse("validate: error: -: line 1, column 1: not valid JSON, expected a value, found end of input", plan="-", output="none")
        self.refuse("--plan -: requires a single plan", "--plan", "plan.json", plan="-")

    def test_a_failed_plan_is_on_standard_output_too_and_json_goes_to_files(self):
        done = self.run_program(*self.arguments("--frames", "none", "--json", "-", friction_angle="1"))
        self.assertEqual((done.returncode, json.loads(done.stdout)["verdict"]), (1, "fail"))
        self.assert_passes("--frames", "none", json="copy.json")
        self.assertEqual(self.read("copy.json"), self.read("result/report.json"))

    def test_the_folder_is_named_after_the_plan_where_none_is_given(self):
        self.assert_done(*self.arguments("--frames", "none", output=None))
        self.assertEqual(json.loads(self.read("out/plan/report.json"))["verdict"], "pass")

    def test_the_same_plan_gives_the_same_bytes(self):
        self.assert_passes(size="200x150")
        first = {name: self.read("result/" + name) for name in os.listdir(self.path("result"))}
        self.assert_passes(size="200x150", output="again")
        self.assertGreater(len(first), 3)
        for name, content in first.items():
            self.assertEqual(self.read("again/" + name), content, name)

    def test_frames_of_an_earlier_run_do_not_stay(self):
        self.assert_passes(size="64x48")
        self.write("result/017_align.png", b"of another")
        self.write("result/mine.png", b"kept")
        self.assertIn("000_hold.png", self.frames())
        _, report = self.assert_passes("--frames", "none")
        self.assertEqual(self.frames(), ["017_align.png", "mine.png"])
        self.assertTrue(all(step["frame"] is None for step in report["steps"]))

    def test_the_report_tells_what_stands_beside_it(self):
        _, report = self.assert_passes(size="64x48")
        files = {file["file"]: file["sha256"] for file in report["run"]["files"]}
        self.assertEqual(sorted([*files, "report.json"]), sorted(os.listdir(self.path("result"))))
        for name, digest in files.items():
            self.assertEqual(hashlib.sha256(self.read("result/" + name)).hexdigest(), digest)

    def test_files_of_others_are_not_replaced(self):
        os.mkdir(self.path("result"))
        for name in ("report.json", "overview.png", "report.html"):
            self.write("result/" + name, b"mine")
            self.refuse(f"result/{name}: cannot overwrite")
            self.assertEqual(os.listdir(self.path("result")), [name])
            self.assertEqual(self.read("result/" + name), b"mine")
            os.remove(self.path("result/" + name))

    def test_a_folder_that_another_run_holds_is_refused(self):
        os.mkdir(self.path("result"))
        path = self.write("result/.regrasp-run", "regrasp: process 7 on elsewhere\n")
        with open(path, "rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX)
            self.assert_refused(3, "result: process 7 on elsewhere writes into this folder",
                                *self.arguments("--frames", "none"))
        self.assert_passes("--frames", "none")
        self.assertFalse(os.path.exists(path))

    def test_start_and_goal_files_are_those_of_the_plan(self):
        self.assert_passes("--frames", "none", start=self.model("cube.start.json"),
                           goal=self.model("cube.goal.json"))
        self.assert_fails(0, "start-differs", start=self.model("cube.goal.json"))
        self.assert_fails(len(self.plan["steps"]), "goal-not-reached",
                          goal=self.model("cube.start.json"))

    def test_every_input_is_read_once(self):
        """Results and digests are of the same bytes, because each input is read once: a pipe has
        one reader."""
        contents = {"cube.obj": self.model("cube.obj"), "start.json": self.model("cube.start.json"),
                    "goal.json": self.model("cube.goal.json"), "plan.json": self.path("plan.json")}
        os.mkdir(self.path("pipes"))
        for name, source in contents.items():
            with open(source, "rb") as file:
                content = file.read()
            os.mkfifo(self.path("pipes/" + name))
            threading.Thread(target=self.write, args=("pipes/" + name, content),
                             daemon=True).start()
        pipes = {"object": "pipes/cube.obj", "plan": "pipes/plan.json",
                 "start": "pipes/start.json", "goal": "pipes/goal.json"}
        _, report = self.assert_passes("--frames", "none", **pipes)
        plain = {name: path.replace("pipes", "files") for name, path in pipes.items()}
        os.mkdir(self.path("files"))
        for name, source in contents.items():
            shutil.copy(source, self.path("files/" + name))
        _, again = self.assert_passes("--frames", "none", **plain)
        self.assertEqual(report["object"], again["object"])
        self.assertEqual(report["plan"], again["plan"])

    def test_an_align_is_replayed_and_says_how(self):
        before = [dict(contact) for contact in self.plan["initial"]["contacts"]]
        after = [dict(contact) for contact in before]
        # A small motion along the face: 2 mm perpendicular to the normal.
        axis = next(i for i in range(3) if abs(after[0]["normal"][i]) < 0.5)
        after[0]["point"] = list(after[0]["point"])
        after[0]["point"][axis] -= 0.002 if after[0]["point"][axis] > 0 else -0.002
        self.plan["steps"] = [{"kind": "align",
                               "waypoints": [{"contacts": before}, {"contacts": after}]}]
        self.plan["goal"] = {"contacts": after}
        self.write_plan()
        _, report = self.assert_passes(size="64x48")
        self.assertIn(report["steps"][1]["align_mode"], ["imitated", "slid"])
        self.assertEqual(self.frames(), ["000_hold.png", "001_align.png"])

    # Planar objects.

    def write_planar_plan(self):
        """Write a plan on the square: a switch of two fingers for two, the reverse, and a sliding
        step."""
        square = self.model("square.wkt")
        with open(square, "rb") as file:
            digest = hashlib.sha256(file.read()).hexdigest()

        def contact(finger, x, y):
            normal = [-x / 0.03, 0] if abs(x) == 0.03 else [0, -y / 0.03]
            return {"finger": finger, "point": [x, y], "normal": normal}

        left_right = [contact(0, 0.03, 0.001), contact(1, -0.03, 0)]
        below_above = [contact(2, 0.002, -0.03), contact(3, 0, 0.03)]
        triple = [contact(2, 0.002, -0.03), contact(3, -0.009, 0.03), contact(0, 0.012, 0.03)]
        self.plan = {
            "format": "regrasp-plan", "version": 1,
            "object": {"file": "square.wkt", "sha256": digest, "scale": 1.0, "dimension": 2},
            "friction": {"half_angle_deg": 15.0}, "fingers": 4, "planner": "polygon",
            "initial": {"contacts": left_right},
            "steps": [
                {"kind": "switch", "place": below_above, "release": [0, 1]},
                {"kind": "switch", "place": [triple[2]], "release": []},
                {"kind": "align", "waypoints": [{"contacts": below_above + [triple[2]]},
                                                {"contacts": triple}]}],
            "goal": {"contacts": triple}}
        self.write_plan()
        return square

    def test_passes_a_planar_plan_with_a_frame_for_each_step(self):
        square = self.write_planar_plan()
        done, report = self.assert_passes(size="320x240", object=square)
        self.assertEqual(done.stderr, "")
        self.assertEqual(self.frames(), ["000_hold.png", "001_switch.png", "002_switch.png",
                                         "003_align.png"])
        self.assertEqual(len(set(self.read("result/" + name) for name in self.frames())), 4)
        self.assertEqual(report["object"]["dimension"], 2)
        self.assertEqual(report["steps"][3]["align_mode"], "imitated")
        settings = report["settings"]
        self.assertAlmostEqual(settings["thickness_m"], 0.25 * 0.06 * 2 ** 0.5)
        self.assertAlmostEqual(settings["mass_kg"], 1000 * 0.06 ** 2 * settings["thickness_m"])
        self.assertEqual(settings["gravity_m_s2"], 0)

    def test_measures_the_contact_region_of_a_switch_between_two_finger_grasps(self):
        square = self.write_planar_plan()
        done, report = self.assert_passes("--frames", "none", object=square)
        # The weaker grasp is 2 mm off the normal over 60 mm; contacts displaced by h each tilt the
        # line by 2 h more.
        expected = (0.06 * math.tan(math.radians(15)) - 0.002) / 2
        region = report["steps"][1]["region"]
        self.assertAlmostEqual(region["half_width"], expected, delta=1e-7)
        self.assertEqual((region["claimed"], region["holds"]), (None, True))
        self.assertEqual(["region" in step for step in report["steps"]],
                         [False, True, False, False])
        self.assertIn("region", done.stdout.splitlines()[0])
        self.assertEqual(done.stderr, "")

    def test_warns_of_a_contact_region_that_is_smaller_than_claimed_and_still_passes(self):
        square = self.write_planar_plan()
        for claimed, holds in ((0.007, True), (0.008, False)):
            with self.subTest(claimed=claimed):
                self.plan["steps"][0]["place"][0]["region"] = 0.02
                self.plan["steps"][0]["place"][1]["region"] = claimed
                self.write_plan()
                done, report = self.assert_passes("--frames", "none", object=square)
                region = report["steps"][1]["region"]
                self.assertEqual((region["claimed"], region["holds"]), (claimed, holds))
                self.assertEqual(len(done.stderr.splitlines()), 0 if holds else 1)
                if not holds:
                    self.assertIn("warning: step 1: contact region: expected 0.008",
                                  done.stderr)

    def test_refuses_a_contact_region_that_is_no_length(self):
        square = self.write_planar_plan()
        self.plan["steps"][0]["place"][1]["region"] = -0.001
        self.write_plan()
        self.refuse(["plan.json", "/steps/0/place/1/region", "-0.001"], object=square)

    def test_fails_a_planar_plan_below_its_friction(self):
        # The first pair is 1 mm off the normal over 60 mm: 0.955 degrees.
        square = self.write_planar_plan()
        self.assert_fails(0, "not-force-closure", object=square, friction_angle="0.9")

    def test_a_planar_plan_has_the_thickness_that_is_asked_for(self):
        square = self.write_planar_plan()
        _, report = self.assert_passes("--frames", "none", object=square, thickness="0.002",
                                       trajectory="fingers.csv", export_mjcf="scene.xml")
        self.assertEqual(report["settings"]["thickness_m"], 0.002)
        self.assertAlmostEqual(report["settings"]["mass_kg"], 0.0072)
        with open(self.path("fingers.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 100)
        self.assertEqual({row["finger"] for row in rows}, {"0", "1", "2", "3"})
        self.assertTrue(all(float(row["contact_z_m"]) == 0 for row in rows))
        scene = ElementTree.fromstring(self.read("scene.xml"))
        joints = [joint.get("type") for joint in scene.findall("worldbody/body/joint")]
        self.assertEqual(joints[:3], ["slide", "slide", "hinge"])

    def test_refuses_a_thickness_that_makes_no_sense(self):
        self.refuse(["--thickness", "solid"], thickness="0.01")
        square = self.write_planar_plan()
        for value in ["0", "-1", "nan", "x"]:
            self.refuse("--thickness", thickness=value, object=square)
        self.refuse("thickness", thickness="1e9", object=square)

    # Further outputs.

    def test_what_is_not_proved_does_not_pass_unless_that_is_allowed(self):
        self.plan.update(program_case.align_past_a_finger())
        self.write_plan()
        report = self.assert_fails(1, "not-proved", junit="junit.xml")
        step = report["steps"][1]
        self.assertEqual(step["force_closure"], {"holds": False, "required_half_angle_deg": None})
        self.assertGreater(step["undecided"], 0)
        self.assertIn("force closure is not proved near 0.4286 of the path", step["detail"])
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        self.assertEqual(suite.find("testcase/failure").get("message"), "not-proved")
        self.assertIn("not-proved", self.page_text())
        self.run_program(*self.arguments("--frames", "none", "--allow", "undecided"))
        step = self.report()["steps"][1]
        self.assertTrue(step["force_closure"]["holds"])
        self.assertGreater(step["undecided"], 0)
        self.assertNotEqual(step["reason"], "not-proved")

    def test_junit_is_well_formed_and_has_a_case_for_each_step(self):
        self.assert_passes("--frames", "none", junit="junit.xml")
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        self.assertEqual(len(suite.findall("testcase")), len(self.plan["steps"]) + 1)
        self.assertEqual(suite.get("failures"), "0")
        self.assert_fails(0, "not-force-closure", friction_angle="0.5", junit="junit.xml")
        suite = ElementTree.fromstring(self.read("junit.xml")).find("testsuite")
        self.assertEqual(suite.get("failures"), "1")
        self.assertEqual(suite.find("testcase/failure").get("message"), "not-force-closure")
        self.assertEqual(len(suite.findall("testcase/skipped")), len(self.plan["steps"]))

    def test_the_scene_is_exported_as_mjcf(self):
        self.assert_passes("--frames", "none", export_mjcf="scene.xml")
        scene = ElementTree.fromstring(self.read("scene.xml"))
        self.assertEqual(scene.tag, "mujoco")
        self.assertIsNotNone(scene.find("worldbody/body"))

    def test_the_trajectory_has_a_row_for_each_finger_and_instant(self):
        self.assert_passes("--frames", "none", trajectory="fingers.csv")
        with open(self.path("fingers.csv"), encoding="utf-8", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertGreater(len(rows), 100)
        self.assertEqual({row["finger"] for row in rows}, {"0", "1", "2", "3", "4"})
        times = [float(row["time_s"]) for row in rows]
        self.assertEqual(times, sorted(times))
        self.assertTrue(any(abs(float(row["force_x_N"])) > 0 for row in rows))

    # Report page and overview images.

    def verdicts_on(self, page):
        """Return the verdicts in the table of steps; rows of other tables have no verdict."""
        rows = page.findall(f".//{XHTML}tbody/{XHTML}tr")
        return [row.get("class") for row in rows if row.get("class")]

    def test_the_report_page_is_one_file_with_a_line_and_a_picture_for_each_step(self):
        _, report = self.assert_passes(size="320x240")
        page = self.page()
        verdicts = self.verdicts_on(page)
        self.assertEqual(verdicts, ["pass"] * len(report["steps"]))
        images = page.findall(f".//{XHTML}img")
        self.assertEqual(len(images), len(report["steps"]))
        for image in images:
            self.assertTrue(image.get("src").startswith("data:image/webp;base64,UklGR"))
        self.assertEqual(len(page.findall(f".//{SVG}svg")), 2)
        text = self.page_text()
        for words in ["Pass", "plan.json", "cube.obj", "20.00°", report["plan"]["sha256"]]:
            self.assertIn(words, text)
        for tag in ["link", "iframe", "object"]:
            self.assertEqual(page.findall(f".//{XHTML}{tag}"), [], tag)
        for script in page.findall(f".//{XHTML}script"):
            self.assertIsNone(script.get("src"))

    def test_the_report_page_of_a_long_plan_can_be_mailed(self):
        # Twenty steps: the plan and its reverse, repeated, at the default image size.
        forth = self.plan["steps"][0]
        released = next(contact for contact in self.plan["initial"]["contacts"]
                        if contact["finger"] == forth["release"][0])
        back = {"kind": "switch", "place": [released],
                "release": [contact["finger"] for contact in forth["place"]]}
        self.plan["steps"] = [forth, back] * 10
        self.plan["goal"] = {"contacts": self.plan["initial"]["contacts"]}
        self.write_plan()
        _, report = self.assert_passes()
        self.assertEqual(len(report["steps"]), 21)
        self.assertLess(len(self.read("result/report.html")), 3e6)

    def test_the_report_page_of_a_failed_plan_says_why_and_needs_no_frames(self):
        self.assert_fails(0, "slipped", tolerance="1e-12")
        page = self.page()
        self.assertEqual(page.findall(f".//{XHTML}img"), [])
        self.assertEqual(self.verdicts_on(page),
                         ["fail"] + ["skipped"] * len(self.plan["steps"]))
        self.assertIn("Fail At the hold: slipped.", self.page_text())

    def test_file_names_cannot_break_the_report_page(self):
        name = "<b>&\"'</b><script>alert(1)</script>"  # a slash would be a folder
        name = name.replace("/", "")
        os.rename(self.path("plan.json"), self.path(name + ".json"))
        self.assert_passes("--frames", "none", plan=name + ".json")
        page = self.page()
        self.assertEqual(page.find(f".//{XHTML}h1").text, name + ".json")
        self.assertEqual(page.findall(f".//{XHTML}script"), [])
        raw = os.fsencode(self.path("")) + b"\xff<.json"
        os.rename(self.path(name + ".json"), raw)
        self.assert_passes("--frames", "none", plan=os.fsdecode(raw))
        self.assertEqual(self.page().find(f".//{XHTML}h1").text, "\ufffd<.json")

    def test_a_browser_shows_the_report_page(self):
        self.assert_passes(size="320x240")
        shown = self.screenshot("result/report.html")
        self.assertEqual(png_size(shown)[0], 1000)
        self.assertGreater(inked_rows(shown), 500)
        self.write("blank.html", "<!DOCTYPE html><title>nothing</title>")
        self.assertLess(inked_rows(self.screenshot("blank.html")), 10)

    def test_the_contact_sheet_shows_all_frames(self):
        self.assert_passes(size="320x240")
        sheet = self.read("result/overview.png")
        width, height = png_size(sheet)
        self.assertGreater(width, 2 * 320)
        self.assertGreater(height, 240)
        self.assertGreater(inked_rows(sheet), height // 2)
        self.assert_passes("--frames", "none")
        self.assertFalse(os.path.exists(self.path("result/overview.png")))

    # Single grasp.

    def grasp_arguments(self, **changes):
        options = {"plan": None, "grasp": self.model("cube.start.json"), "friction_angle": "20"}
        return {**options, **changes}

    def test_answers_for_a_single_grasp(self):
        done, report = self.assert_passes(size="320x240", **self.grasp_arguments())
        self.assertIsNone(report["plan"])
        self.assertEqual([step["kind"] for step in report["steps"]], ["hold"])
        self.assertEqual(self.frames(), ["000_hold.png"])
        grasp = report["grasp"]
        self.assertEqual(grasp["file"], "cube.start.json")
        self.assertGreater(grasp["quality"], 0.01)
        self.assertLess(grasp["quality"], grasp["quality_at_most"])
        self.assertLess(grasp["quality_at_most"], 1.02 * grasp["quality"])
        self.assertEqual([finger["finger"] for finger in grasp["fingers"]], [0, 1, 2, 3])
        for finger in grasp["fingers"]:
            self.assertAlmostEqual(finger["required_half_angle_deg"] + finger["margin_deg"], 20)
        self.assertIn(grasp["weakest_finger"], range(4))
        for words in ["quality: ", "weakest: finger", "verdict: pass"]:
            self.assertIn(words, done.stdout)
        self.assertIn("Validation of a grasp", self.page_text())

    def test_the_weakest_finger_needs_most_of_its_own_friction(self):
        # Two fingers on the square, of which only the normal of the second is inclined.
        grasp = {"format": "regrasp-grasp", "version": 1, "contacts": [
            {"point": [0.03, 0.004], "normal": [-1, 0]},
            {"point": [-0.03, 0.0], "normal": [1, 0]}]}
        self.write_json("grasp.json", grasp)
        angle = math.degrees(math.atan2(0.004, 0.06))
        _, report = self.assert_passes("--frames", "none", object=self.model("square.wkt"), plan=None,
                                       grasp="grasp.json", mu="0.3")
        fingers = report["grasp"]["fingers"]
        self.assertEqual(len(fingers), 2)
        for finger in fingers:
            self.assertTrue(finger["needed"])
            self.assertIsNone(finger["without_half_angle_deg"])
            self.assertAlmostEqual(finger["required_half_angle_deg"], angle, places=5)
        self.assertEqual(report["grasp"]["weakest_finger"], 0)
        self.assertAlmostEqual(report["settings"]["mu"], 0.3)

    def test_fails_a_single_grasp_that_is_not_force_closure(self):
        done = self.run_program(*self.arguments("--frames", "none",
                                                **self.grasp_arguments(friction_angle="4")))
        self.assertEqual(done.returncode, 1, done.stderr)
        report = self.report()
        self.assertEqual(report["verdict"], "fail")
        self.assertEqual([step["reason"] for step in report["steps"]], ["not-force-closure"])
        self.assertGreater(report["steps"][0]["force_closure"]["required_half_angle_deg"], 4)
        self.assertEqual((report["grasp"]["quality"], report["grasp"]["weakest_finger"]), (0, None))
        self.assertEqual(report["grasp"]["fingers"], [])

    def test_fails_a_single_grasp_whose_fingers_coincide(self):
        grasp = json.loads(self.read(self.model("cube.start.json")))
        grasp["contacts"].append(grasp["contacts"][0])
        self.write_json("grasp.json", grasp)
        self.assert_fails(0, "coincident-fingers", **self.grasp_arguments(grasp="grasp.json"))

    def test_refuses_a_single_grasp_that_cannot_be_read(self):
        good = json.loads(self.read(self.model("cube.start.json")))
        off = copy.deepcopy(good)
        off["contacts"][1]["point"] = [0.0, 0.0, 0.0]
        cases = {"off the surface": (off, "/contacts/1"),
                 "no contacts": ({**good, "contacts": []}, "contacts"),
                 "a plan": (self.plan, "grasp.json"),
                 "no object": ([], "grasp.json")}
        for name, (content, word) in cases.items():
            with self.subTest(name):
                self.write_json("grasp.json", content)
                self.refuse(["grasp.json", word], **self.grasp_arguments(grasp="grasp.json"))
        self.refuse("missing.json", **self.grasp_arguments(grasp="missing.json"))

    def test_refuses_a_single_grasp_beside_what_belongs_to_a_plan(self):
        self.refuse("--grasp", **self.grasp_arguments(plan="plan.json"))
        self.refuse("--friction-angle", **self.grasp_arguments(friction_angle=None))
        self.refuse("--start", **self.grasp_arguments(start=self.model("cube.start.json")))
        self.refuse("--goal", **self.grasp_arguments(goal=self.model("cube.start.json")))
        self.refuse("--allow object-change", "--allow", "object-change", **self.grasp_arguments())
        self.refuse("--grasp", plan=None)

    # Proofs.

    def test_a_hand_may_have_many_more_fingers_than_touch(self):
        self.plan["fingers"] = 64
        self.write_plan()
        _, report = self.assert_passes("--frames", "none")
        # Result is independent of the finger numbers.
        grasps = [self.plan["initial"]["contacts"]]
        for step in self.plan["steps"]:
            step["release"] = [63 - 9 * finger for finger in step["release"]]
            grasps.append(step["place"])
        for contact in sum(grasps, []):
            contact["finger"] = 63 - 9 * contact["finger"]
        self.write_plan()
        _, renumbered = self.assert_passes("--frames", "none")
        for before, after in zip(report["steps"], renumbered["steps"]):
            self.assertAlmostEqual(before["simulation"]["displacement_m"],
                                   after["simulation"]["displacement_m"], delta=1e-6)

    def test_proofs_in_the_report_hold_exactly(self):
        _, report = self.assert_passes("--certificates", "--frames", "none")
        self.assertEqual(len(report["steps"]), len(self.plan["steps"]) + 1)
        self.assertTrue(all("forces" in step["proof"]["rest"] for step in report["steps"]))
        done = self.assert_done(*self.arguments(verify="result/report.json", output=None))
        entries = len(report["steps"])
        self.assertIn(f"{entries} of {entries} steps proved", done.stdout)
        self.assertIn("\nproved: contacts on the surface", done.stdout)

    def test_proofs_at_another_friction_prove_nothing_about_the_plan(self):
        _, report = self.assert_passes("--certificates", "--frames", "none", friction_angle="40")
        at_40 = self.arguments(verify="result/report.json", output=None)
        self.refuse(["report.json: /settings/friction_half_angle_deg: expected 20° as of the plan", "found 40°"],
                    verify="result/report.json")
        self.refuse(["expected 30°", "found 40°"], verify="result/report.json",
                    friction_angle="30")
        done = self.assert_done(*at_40, "--friction-angle", "40")
        self.assertIn("friction angle 40°", done.stdout)
        # Lower the plan's own friction, and change the report accordingly.
        self.plan["friction"]["half_angle_deg"] = 1
        self.forge(report)
        self.refuse("found 40°", verify="forged.json")
        report["settings"]["friction_half_angle_deg"] = 1
        self.forge(report)
        done = self.run_program(*self.arguments(verify="forged.json", output=None))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("\n0 of", done.stdout)

    def forge(self, report):
        """Write the current plan, and a report with this plan's digest."""
        self.write_plan()
        report = copy.deepcopy(report)
        report["plan"]["sha256"] = hashlib.sha256(self.read("plan.json")).hexdigest()
        self.write_json("forged.json", report)

    def assert_not_proved(self, report, entry, words):
        """Expect that the plan is not proved, although all proofs of the report are valid."""
        self.forge(report)
        done = self.run_program(*self.arguments(verify="forged.json", output=None))
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        line = done.stdout.splitlines()[entry]
        self.assertTrue(line.startswith(f"{entry} "), done.stdout)
        self.assertIn("fails: " + words, line)
        self.assertIn(f"\nnot proved: the plan fails the analytic check at step {entry}\n", done.stdout)

    def test_proofs_do_not_make_up_for_a_plan_that_is_none(self):
        _, report = self.assert_passes("--certificates", "--frames", "none")
        good = copy.deepcopy(self.plan)
        last = len(good["steps"])

        def contacts_of(plan):
            lists = [plan["initial"]["contacts"], plan["goal"]["contacts"]]
            return sum([step["place"] for step in plan["steps"]], sum(lists, []))

        # At twice the size, off the object, the same forces balance.
        for contact in contacts_of(self.plan):
            contact["point"] = [2 * x for x in contact["point"]]
        self.assert_not_proved(report, 0, "off-surface")
        self.plan = copy.deepcopy(good)
        self.plan["initial"]["contacts"][1]["finger"] = self.plan["initial"]["contacts"][0]["finger"]
        self.assert_not_proved(report, 0, "finger-not-free")
        self.plan = copy.deepcopy(good)
        self.plan["goal"]["contacts"] = self.plan["initial"]["contacts"]
        self.assert_not_proved(report, last, "goal-not-reached")
        self.plan = copy.deepcopy(good)
        self.plan["fingers"] = 4
        self.assert_not_proved(report, 1, "too-many-fingers")
        self.plan = good
        self.forge(report)
        self.assert_done(*self.arguments(verify="forged.json", output=None))
        done = self.run_program(*self.arguments(verify="forged.json", output=None,
                                                start=self.model("cube.goal.json")))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("0 hold  fails: start-differs", done.stdout)

    def test_proofs_do_not_make_up_for_an_align_that_starts_elsewhere(self):
        def grasp(shift):
            # Opposite pairs, which are force closure at any height.
            directions = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0))
            return {"contacts": [
                {"finger": k, "point": [0.03 * x for x in d[:2]] + [shift],
                 "normal": [-x for x in d]} for k, d in enumerate(directions)]}

        self.plan["initial"] = grasp(0.01)
        self.plan["steps"] = [{"kind": "align", "waypoints": [grasp(0.01), grasp(0)]}]
        self.plan["goal"] = grasp(0)
        self.write_plan()
        _, report = self.assert_passes("--certificates", "--frames", "none")
        # The same forces are a proof for the same grasp at another height.
        self.plan["initial"] = grasp(0.005)
        self.assert_not_proved(report, 1, "discontinuous")

    def test_proofs_that_were_tampered_with_prove_nothing(self):
        _, report = self.assert_passes("--certificates", "--frames", "none")
        # Change all forces, because the exact balance could compensate the error of one with the
        # others.
        forces = report["steps"][1]["proof"]["rest"]["forces"]
        forces[:] = [[-x for x in force] for force in forces]
        self.write_json("tampered.json", report)
        done = self.run_program(*self.arguments(verify="tampered.json", output=None))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("1 switch  not proved", done.stdout)
        self.assertIn("\nnot proved: a step has no valid proof", done.stdout)
        del report["steps"][1:]
        self.write_json("tampered.json", report)
        done = self.run_program(*self.arguments(verify="tampered.json", output=None))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("1 switch  not proved: proof not found in the report", done.stdout)

    def test_a_lost_object_is_refuted(self):
        report = self.assert_fails(0, "not-force-closure", "--certificates", friction_angle="2")
        self.assertTrue(set(report["steps"][0]["proof"]["rest"]) & {"twist", "line"})
        self.assertNotIn("proof", report["steps"][1])
        done = self.run_program(*self.arguments(verify="result/report.json", output=None,
                                                friction_angle="2"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("0 hold  refuted", done.stdout)

    def write_plan_with_align(self):
        """Write a plan whose last step slides two fingers along the surface, with the proof of
        `plan`."""
        done = self.assert_done(
            "--object", self.model("body24.obj"), "--start", self.model("body24.start.json"),
            "--goal", self.model("body24.goal.json"), "--friction-angle", "20", "--planner",
            "polyhedron", "--output", "plan.json", program="plan")
        self.assertIn("align", done.stderr)
        self.plan = json.loads(self.read("plan.json"))
        aligns = [k for k, step in enumerate(self.plan["steps"]) if step["kind"] == "align"]
        self.assertTrue(aligns)
        return self.model("body24.obj"), aligns

    def test_certificates_that_a_plan_gives_hold(self):
        solid, aligns = self.write_plan_with_align()
        for index in aligns:
            self.assertIn("certificate", self.plan["steps"][index])
        done, report = self.assert_passes("--certificates", "--frames", "none", object=solid)
        self.assertEqual(done.stderr, "")
        for index, step in enumerate(report["steps"]):
            expected = "holds" if index - 1 in aligns else None
            self.assertEqual(step["certificate"], expected, index)
        for index in aligns:
            self.assertEqual(report["steps"][index + 1]["proof"]["ways"],
                             self.plan["steps"][index]["certificate"])
        self.assert_done(*self.arguments(object=solid, verify="result/report.json", output=None))

    def test_warns_of_a_certificate_that_does_not_hold_and_still_passes(self):
        solid, aligns = self.write_plan_with_align()
        index = aligns[0]
        for force in self.plan["steps"][index]["certificate"][0][0]["start"]:
            force[:] = [-x for x in force]
        self.write_plan()
        done, report = self.assert_passes("--certificates", "--frames", "none", object=solid)
        self.assertEqual(report["steps"][index + 1]["certificate"], "does-not-hold")
        self.assertEqual(len(done.stderr.splitlines()), 1)
        self.assertIn(f"warning: step {index + 1}: invalid certificate in the plan: from "
                      "waypoint 0 on, the force at contact", done.stderr)
        # The report has its own proof.
        self.assert_done(*self.arguments(object=solid, verify="result/report.json", output=None))

    def test_refuses_a_certificate_that_is_none(self):
        solid, aligns = self.write_plan_with_align()
        place = f"/steps/{aligns[0]}/certificate"
        self.plan["steps"][aligns[0]]["certificate"][0][0]["end"].pop()
        self.write_plan()
        self.refuse(["plan.json", place + "/0/0/end", "expected 4 forces"], object=solid)
        self.plan["steps"][aligns[0]]["certificate"] = "sure"
        self.write_plan()
        self.refuse(["plan.json", place, "expected a JSON array"], object=solid)

    def test_refuses_reports_that_cannot_be_verified(self):
        _, report = self.assert_passes("--frames", "none")
        self.refuse("proofs not found", verify="result/report.json")
        self.refuse("no such file", verify="nothing.json")
        report["plan"]["sha256"] = "0" * 64
        self.write_json("other.json", report)
        self.refuse("another plan", verify="other.json")
        self.write_json("broken.json", {"format": "regrasp-report"})
        self.refuse("version", verify="broken.json")

    # Plans that fail.

    def test_fails_a_contact_off_the_surface(self):
        contact = self.plan["steps"][1]["place"][0]
        contact["point"] = [p - 0.001 * n for p, n in zip(contact["point"], contact["normal"])]
        self.write_plan()
        report = self.assert_fails(2, "off-surface")
        self.assertIsNone(report["steps"][2]["simulation"])
        self.assertIsNone(report["steps"][2]["frame"])
        self.assertIsNotNone(report["steps"][1]["simulation"])

    def test_fails_a_wrong_normal(self):
        contact = self.plan["initial"]["contacts"][0]
        contact["normal"] = [-n for n in contact["normal"]]
        self.write_plan()
        self.assert_fails(0, "wrong-normal")

    def test_fails_a_finger_that_is_placed_while_it_holds(self):
        self.plan["steps"][0]["place"][0]["finger"] = self.plan["steps"][0]["release"][0]
        self.write_plan()
        self.assert_fails(1, "finger-not-free")

    def test_fails_a_finger_released_that_does_not_hold(self):
        step = self.plan["steps"][0]
        holding = {contact["finger"] for contact in self.plan["initial"]["contacts"]}
        step["place"], step["release"] = [], list({0, 1, 2, 3, 4} - holding)
        self.write_plan()
        self.assert_fails(1, "finger-not-holding")

    def test_fails_a_finger_outside_the_hand(self):
        self.plan["steps"][0]["place"][0]["finger"] = 7
        self.write_plan()
        self.assert_fails(1, "too-many-fingers")

    def test_fails_a_release_that_loses_the_object(self):
        holding = [contact["finger"] for contact in self.plan["initial"]["contacts"]]
        self.plan["steps"][0] = {"kind": "switch", "place": [], "release": holding[:3]}
        self.write_plan()
        self.assert_fails(1, "not-force-closure")

    def test_fails_a_plan_that_stops_before_its_goal(self):
        self.plan["steps"].pop()
        self.write_plan()
        self.assert_fails(len(self.plan["steps"]), "goal-not-reached")

    def test_fails_friction_below_what_the_plan_needs(self):
        _, report = self.assert_passes("--frames", "none")
        angles = [step["force_closure"]["required_half_angle_deg"] for step in report["steps"]]
        index = next(i for i, angle in enumerate(angles) if angle > 0.9 * max(angles))
        self.assert_fails(index, "not-force-closure", friction_angle=str(0.9 * max(angles)))

    def test_a_tolerance_that_nothing_meets_fails_in_the_replay(self):
        # Fingertips creep before the object does, and the first reason counts.
        report = self.assert_fails(0, "slipped", tolerance="1e-12")
        self.assertIsNotNone(report["steps"][0]["simulation"])

    def test_a_step_that_fails_in_the_replay_has_a_frame_and_no_later_one_has(self):
        done = self.run_program(*self.arguments(tolerance="1e-12", size="64x48"))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(self.frames(), ["000_hold.png"])

    # Invalid input.

    def test_refuses_another_object_unless_allowed(self):
        other = self.path("other.obj")
        shutil.copy(self.model("cube.obj"), other)
        with open(other, "a", encoding="utf-8") as file:
            file.write("# another byte\n")
        self.refuse(["plan.json", "sha256", "other.obj"], object=other)
        self.assert_passes("--frames", "none", "--allow", "object-change", object=other)

    def test_refuses_plans_that_cannot_be_read(self):
        text = json.dumps(self.plan)
        cases = {
            "empty": "",
            "truncated": text[:len(text) // 2],
            "binary": bytes(range(256)) * 8,
            "deep": "[" * 100000,
            "deep value": text[:-1] + ', "x": ' + "[" * 5000 + "]" * 5000 + "}",
            "not a number": text.replace("20.0", "NaN"),
            "repeated key": text[:-1] + ', "fingers": 5}',
            "wrong version": text.replace('"version": 1', '"version": 2'),
            "wrong type": text.replace('"fingers": 5', '"fingers": "five"'),
            "huge number": text.replace('"fingers": 5', '"fingers": 1e400'),
        }
        for name, content in cases.items():
            with self.subTest(name):
                self.assertNotEqual(content, text)
                self.write("plan.json", content)
                self.refuse("plan.json")
        self.assertEqual(len(cases), 10)

    def test_refuses_plans_with_a_missing_member(self):
        checked = 0
        for name in self.plan_of_cube():
            with self.subTest(name):
                self.plan = self.plan_of_cube()
                del self.plan[name]
                self.write_plan()
                self.refuse(["plan.json"])
                checked += 1
        self.assertGreaterEqual(checked, 9)

    def test_refuses_files_that_are_not_there(self):
        self.refuse("missing.json", plan="missing.json")
        self.refuse("missing.obj", object="missing.obj")
        self.refuse("missing.json", start="missing.json")

    def test_refuses_a_dimension_that_is_not_the_objects(self):
        square = self.model("square.wkt")
        self.refuse(["plan.json", "dimension", "square.wkt"], object=square)

    def test_refuses_bad_usage(self):
        self.refuse("--scale 2", scale="2")
        self.refuse("--size", size="12")
        self.refuse("--size", size="10x10")
        self.refuse("--size", size="640x1e3")
        self.refuse("--friction-angle", friction_angle="20", mu="0.3")
        self.refuse("--mu", mu="0")
        self.refuse("--mass", mass="1", density="1000")
        self.refuse("--grasp-force", grasp_force="-1")
        self.refuse("--tolerance", tolerance="nan")
        self.refuse("--plan", plan=None)
        self.refuse("--unknown", "--unknown")

    def test_accepts_the_scale_of_the_plan(self):
        self.assert_passes("--frames", "none", scale="1")

    def test_says_when_the_folder_cannot_be_written(self):
        self.write("file", "in the way")
        self.refuse("file", code=3, output="file/result")
        self.refuse("file", code=3, output="file")
        done = self.run_program(*self.arguments("--frames", "none", junit="nowhere/junit.xml"))
        self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
        self.assertIn("nowhere", done.stderr)

    def test_help_names_units_and_version_names_the_program(self):
        text = self.assert_done("--help").stdout
        for word in ["kg", "newtons", "degrees", "pixels", "diameters", "--grasp-force"]:
            self.assertIn(word, text)
        self.assertIn("validate", self.assert_done("--version").stdout)


if __name__ == "__main__":
    program_case.main()
