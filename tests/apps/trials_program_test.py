"""validate --trials and --align from the shell: what is repeated, what is said, and bad input."""

import os

import program_case
from program_case import ProgramCase


class Trials(ProgramCase):
    program = "validate"

    def arguments(self, *more):
        plan = os.path.join(program_case.ARGUMENTS.source, "tests/data/plans/plan_good",
                            "cube_switches_and_align.json")
        return ["--object", self.model("cube.obj"), "--plan", plan, "--out", "result",
                "--no-frames", *more]

    def run_trials(self, *more):
        done = self.assert_done(*self.arguments(*more))
        return done, self.report()

    def test_without_noise_all_trials_pass(self):
        done, report = self.run_trials(
            "--trials", "3", "--position-noise", "0", "--friction-error", "0", "--mass-error", "0")
        trials = report["trials"]
        self.assertEqual((trials["count"], trials["passed"], trials["share"]), (3, 3, 1))
        self.assertEqual((trials["reasons"], trials["steps"]), ({}, []))
        # The lower end p of 3 of 3: p^3 = 0.025.
        self.assertAlmostEqual(trials["interval"][0], 0.025 ** (1 / 3), 12)
        self.assertEqual(trials["interval"][1], 1)
        self.assertIn("trials: 3 of 3 pass: 100 %", done.stdout)

    def test_with_much_noise_some_fail_and_the_verdict_is_that_of_the_replay_without(self):
        done, report = self.run_trials("--trials", "12", "--seed", "5", "--position-noise", "0.1",
                                       "--friction-error", "0.6")
        trials = report["trials"]
        self.assertEqual(report["verdict"], "pass")
        self.assertLess(trials["passed"], 12)
        failed = 12 - trials["passed"]
        self.assertEqual(sum(trials["reasons"].values()), failed)
        self.assertEqual(sum(step["failed"] for step in trials["steps"]), failed)
        self.assertEqual((trials["seed"], trials["friction_error"]), (5, 0.6))
        for words in ["trials that fail: ", "first in step ", "verdict: pass"]:
            self.assertIn(words, done.stdout)
        page = self.read("result/report.html").decode("utf-8")
        self.assertIn(f"{trials['passed']} of 12 pass", page)
        first = self.read("result/report.json")
        _, again = self.run_trials("--trials", "12", "--seed", "5", "--position-noise", "0.1",
                                   "--friction-error", "0.6")
        self.assertEqual(self.read("result/report.json"), first)
        self.assertEqual(again, report)

    def test_a_plan_that_fails_has_no_trials(self):
        done = self.run_program(*self.arguments("--trials", "3", "--friction-angle", "1"))
        self.assertEqual(done.returncode, 1)
        self.assertIn("no trials", done.stderr)
        self.assertNotIn("trials", self.report())

    def test_refuses_trials_that_make_no_sense(self):
        for option, value in [("--trials", "0"), ("--trials", "few"), ("--position-noise", "-1"),
                              ("--friction-error", "1.5"), ("--mass-error", "nan"),
                              ("--seed", "x")]:
            with self.subTest(option=option, value=value):
                more = [] if option == "--trials" else ["--trials", "2"]
                self.assert_refused(2, option, *self.arguments(*more, option, value))
        self.assert_refused(2, "--trials", *self.arguments("--position-noise", "0.1"))

    def test_aligns_are_imitated_or_slid_as_asked(self):
        shares = {}
        for choice in ["imitate", "slide"]:
            _, report = self.run_trials("--align", choice)
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
        self.assert_refused(2, "--align", *self.arguments("--align", "fly"))


if __name__ == "__main__":
    program_case.main()
