"""The program inhand from the shell: a run, its tables, third-party plans, and invalid input."""

import json
import os

import program_case
from program_case import ProgramCase


class InHand(ProgramCase):
    program = "inhand"

    def hand(self, name="ring4"):
        return self.model(os.path.join("hands", name + ".json"))

    def plan(self):
        return self.path(os.path.join("plans", "ring4", "turn-cube-50-z90.json"))

    def test_a_run_a_table_and_plans_that_are_judged(self):
        page = self.write("page.md", "above\n<!-- scoreboard: begin -->\n"
                                     "<!-- scoreboard: end -->\nbelow\n")
        self.assert_done("--only", "turn/cube-50/z90", "--limit", "600", "--results",
                         self.path("rows.jsonl"), "--plans", self.path("plans"), "--table", page,
                         self.hand())
        row = json.loads(self.read("rows.jsonl"))
        self.assertTrue(row["found"] and row["passed"], row)
        text = self.read("page.md").decode()
        self.assertIn("| ring4 | 1 of 1 | 1 of 1 |", text)
        self.assertIn("| turn/cube-50/z90 | pass |", text)
        self.assertTrue(text.startswith("above\n") and text.endswith("below\n"), text)
        self.judge_plans(row)

    def judge_plans(self, row):
        judged = json.loads(self.assert_done("--task", "turn/cube-50/z90", "--plan", self.plan(),
                                             self.hand()).stdout)
        for name in ("passed", "plan_sha256", "moves", "switches", "error_mm"):
            self.assertEqual(judged[name], row[name], name)
        self.assertIsNone(judged["seconds"])
        self.assert_refused(2, ["not a plan for turn/cube-50/x90", "degrees from its goal"],
                            "--task", "turn/cube-50/x90", "--plan", self.plan(), self.hand())
        self.assert_refused(2, ["/hand/sha256", "ring5"], "--task", "turn/cube-50/z90", "--plan",
                            self.plan(), self.hand("ring5"))
        with open(self.plan(), encoding="utf-8") as file:
            plan = json.load(file)
        plan["planner"] = "third party"
        plan["hand"]["initial"]["joints"][0][0] += 1
        failing = self.write_json("failing.json", plan)
        done = self.run_program("--task", "turn/cube-50/z90", "--plan", failing, "--results",
                                self.path("rows.jsonl"), "--table", self.path("page.md"),
                                self.hand())
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertFalse(json.loads(done.stdout)["passed"])
        self.assertIn("| ring4, third party | 1 of 1 | 0 of 1 |", self.read("page.md").decode())

    def test_bodies_are_files_for_other_planners(self):
        listed = self.assert_done("--list", "--bodies", self.path("bodies")).stdout
        self.assertIn("turn/cube-50/z90\n", listed)
        for name in ("cube.obj", "banana.obj", "cylinder-60.obj", "screwdriver.obj"):
            self.assertIn(name + " times ", listed)
            self.assertIn(name, os.listdir(self.path("bodies")))

    def test_bad_input_is_refused_with_one_line(self):
        results = ("--results", self.path("rows.jsonl"))
        self.assert_refused(2, ["--list or --bodies is required"])
        self.assert_refused(2, ["--results"], self.hand())
        self.assert_refused(2, ["--only"], "--only", "turn/none/*", *results, self.hand())
        self.assert_refused(2, ["--task", "--plan"], "--task", "turn/cube-50/z90", self.hand())
        self.assert_refused(2, ["there is no task t"], "--task", "t", "--plan", "p", self.hand())
        self.assert_refused(2, ["--bih", "--meshes"], "--bih", "sheet.csv", *results, self.hand())
        self.assert_refused(2, ["--limit"], "--limit", "0", *results, self.hand())
        self.assert_refused(2, ["nowhere.json"], *results, "nowhere.json")
        page = self.write("page.md", "no markers\n")
        self.assert_refused(2, ["page.md", "scoreboard: begin"], *results, "--table", page)
        tasks = self.write("tasks.csv", "name,group,body,after,turn,move_mm\na,g,none,,z 90,\n")
        self.assert_refused(2, ["no body none"], "--tasks", tasks, "--list")


if __name__ == "__main__":
    program_case.main()
