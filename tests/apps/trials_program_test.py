"""validate --trials and --replay align from the shell: repetition, output, and invalid input."""

import json
import os
import shutil

import program_case
from program_case import ProgramCase


class Trials(ProgramCase):
    program = "validate"

    def arguments(self, *more):
        plan = os.path.join(program_case.ARGUMENTS.source, "tests/data/plans/plan_good",
                            "cube_switches_and_align.json")
        return ["--object", self.model("cube.obj"), "--plan", plan, "--output", "result",
                "--frames", "none", *more]

    def run_trials(self, *more, code=0):
        done = self.run_program(*self.arguments(*more))
        self.assertEqual(done.returncode, code, done.stderr)
        return done, self.report()

    def test_without_noise_all_trials_pass(self):
        done, report = self.run_trials(
            "--trials", "3,position=0,friction=0,mass=0")
        trials = report["trials"]
        self.assertEqual((trials["count"], trials["passed"], trials["share"]), (3, 3, 1))
        self.assertEqual((trials["reasons"], trials["steps"]), ({}, []))
        # Lower end p of the interval for 3 of 3: p^3 = 0.025.
        self.assertAlmostEqual(trials["interval"][0], 0.025 ** (1 / 3), 12)
        self.assertEqual(trials["interval"][1], 1)
        self.assertIn("trials: 3 of 3 pass: 100 %", done.stdout)
        self.assertEqual(done.stdout.splitlines()[-1], "verdict: pass in 3 of 3 trials")

    def test_contacts_of_points_are_off_by_a_hundredth_of_the_diameter_by_default(self):
        self.run_program(*self.arguments("--trials", "1"))
        self.assertEqual(self.report()["trials"]["position_noise"], 0.01)

    NOISE = ("--trials", "12,position=0.1,friction=0.6", "--seed", "5")

    def test_with_much_noise_some_fail_and_with_them_the_plan(self):
        done, report = self.run_trials(*self.NOISE, code=1)
        trials = report["trials"]
        self.assertEqual((report["verdict"], trials["verdict"]), ("fail", "fail"))
        self.assertEqual({step["verdict"] for step in report["steps"]}, {"pass"})
        self.assertLess(trials["passed"], 12)
        self.assertGreater(trials["passed"], 0)
        failed = 12 - trials["passed"]
        self.assertEqual(sum(trials["reasons"].values()), failed)
        self.assertEqual(sum(step["failed"] for step in trials["steps"]), failed)
        self.assertEqual((trials["seed"], trials["friction_error"]), (5, 0.6))
        for words in ["trials that fail: ", "first in step ",
                      f"verdict: fail, trials-failed: {failed} of 12 trials with noise fail"]:
            self.assertIn(words, done.stdout)
        page = self.read("result/report.html").decode("utf-8")
        self.assertIn(f"{trials['passed']} of 12 pass", page)
        self.assertIn(f"<title>Fail in {failed} of 12 trials", page)
        first = self.read("result/report.json")
        _, again = self.run_trials(*self.NOISE, code=1)
        self.assertEqual(self.read("result/report.json"), first)
        self.assertEqual(again, report)

    def test_the_share_that_must_pass_is_an_option_and_no_pass_hides_the_rate(self):
        _, report = self.run_trials(*self.NOISE, code=1)
        passed = report["trials"]["passed"]
        for rate, code in ((passed / 12, 0), (passed / 12 + 1e-9, 1), (1e-6, 0), (1, 1)):
            done, report = self.run_trials(*self.NOISE, "--trials", f"min-pass-rate={rate!r}", code=code)
            self.assertEqual(report["verdict"], "fail" if code else "pass")
            self.assertEqual(report["trials"]["min_pass_rate"], rate)
            last = done.stdout.splitlines()[-1]
            page = self.read("result/report.html").decode("utf-8")
            if code == 0:
                self.assertEqual(last, f"verdict: pass in {passed} of 12 trials")
                self.assertIn(f"<strong>Pass in {passed} of 12 trials</strong>", page)
            else:
                self.assertIn("verdict: fail, trials-failed", last)
                self.assertNotIn("<strong>Pass", page)
            quiet = self.run_program(*self.arguments(*self.NOISE, "--trials", f"min-pass-rate={rate!r}",
                                                     "--quiet"))
            self.assertEqual((quiet.returncode, "trials-failed" in quiet.stderr), (code, code == 1))

    def test_a_batch_and_lines_report_the_rate_too(self):
        plan = self.arguments()[3]
        shutil.copy(plan, self.path("one.json"))
        shutil.copy(plan, self.path("two.json"))
        files = ("--object", self.model("cube.obj"), "--plan", "one.json", "two.json", "--output",
                 "batch", "--frames", "none", *self.NOISE, "--junit", "junit.xml")
        with open(plan, encoding="utf-8") as file:
            self.write("plans.jsonl", json.dumps(json.load(file)) + "\n")
        lines = ("--object", self.model("cube.obj"), "--plan", "plans.jsonl", "--output", "lines",
                 *self.NOISE)
        for more, code in (((), 1), (("--trials", "min-pass-rate=0.01"), 0)):
            said = []
            for _ in range(2):
                done = self.run_program(*files, *more)
                self.assertEqual(done.returncode, code, done.stderr)
                said.append(sorted(line for line in done.stderr.splitlines() if "trials" in line))
                words = ("passes in", "of 12 trials") if code == 0 else ("trials-failed", "0 pass")
                for word in words:
                    self.assertIn(word, done.stdout)
                summary = json.loads(self.read("batch/summary.json"))
                self.assertEqual([plan["verdict"] for plan in summary["plans"]],
                                 ["fail" if code else "pass"] * 2)
                self.assertEqual(summary["plans"][0]["trials"]["count"], 12)
                self.assertNotIn(b"<strong>Pass</strong> The hold", self.read("batch/index.html"))
            self.assertEqual(said[0], said[1])
            self.assertEqual(len(said[0]), 2 * code)
            said = []
            for _ in range(2):
                done = self.run_program(*lines, *more)
                self.assertEqual(done.returncode, code, done.stderr)
                said.append(done.stderr.splitlines()[0])
            self.assertEqual(said[0], said[1])
            self.assertRegex(said[0], "line 1: trials-failed: " if code
                             else r"line 1: pass in \d+ of 12 trials")

    def test_a_plan_that_fails_has_no_trials(self):
        done = self.run_program(*self.arguments("--trials", "3", "--friction-angle", "1"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("trials skipped", done.stderr)
        self.assertNotIn("trials", self.report())

    def test_refuses_trials_that_make_no_sense(self):
        for option, value in [("--trials", "0"), ("--trials", "few"), ("--trials", "position=-1"),
                              ("--trials", "friction=1.5"), ("--trials", "mass=nan"),
                              ("--seed", "x"), ("--trials", "min-pass-rate=0"),
                              ("--trials", "min-pass-rate=1.1"), ("--trials", "min-pass-rate=nan")]:
            with self.subTest(option=option, value=value):
                more = [] if option == "--trials" else ["--trials", "2"]
                self.assert_refused(2, option, *self.arguments(*more, option, value))
        self.assert_refused(2, "--trials", *self.arguments("--trials", "position=0.1"))
        self.assert_refused(2, "--trials", *self.arguments("--trials", "min-pass-rate=0.5"))

    def test_aligns_are_imitated_or_slid_as_asked(self):
        shares = {}
        for choice in ["imitate", "slide"]:
            _, report = self.run_trials("--replay", "align=" + choice)
            self.assertEqual(report["settings"]["align"], choice)
            aligns = [step for step in report["steps"] if step["kind"] == "align"]
            self.assertTrue(aligns)
            for step in aligns:
                self.assertAlmostEqual(sum(step["align_shares"].values()), 1, 9)
            self.assertIsNone(report["steps"][0]["align_shares"])
            shares[choice] = aligns[0]["align_shares"]
        self.assertEqual(shares["imitate"]["imitated"], 1)
        _, usual = self.run_trials()
        self.assertEqual(usual["settings"]["align"], "imitate")
        self.assert_refused(2, "--replay align", *self.arguments("--replay", "align=fly"))


if __name__ == "__main__":
    program_case.main()
