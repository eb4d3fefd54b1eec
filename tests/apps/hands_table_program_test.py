"""scripts/hands-table, on the hands of the project and on models that `hand` refuses."""

import json
import os
import shutil
import subprocess
import sys

import program_case
from program_case import ProgramCase

LOOP = """<mujoco><worldbody><body name="palm"><geom size="0.02"/>
  <body name="a"><joint name="a"/><geom size="0.01"/></body></body></worldbody>
  <equality><connect body1="palm" body2="a" anchor="0 0 0"/></equality>
  <actuator><motor joint="a"/></actuator></mujoco>"""


class HandsTable(ProgramCase):
    def setUp(self):
        super().setUp()
        shutil.copytree(self.model("hands"), self.path("own/rings"))
        self.write("own/rings/cut.xml", "<mujoco>\n<worldbody>")
        self.write("own/rings/loop.xml", LOOP)

    def table(self, *models, programs=None, **options):
        """Run the script on models of the stub repository; return the finished process."""
        self.write_json("list.json", [{"name": name, "repository": "own/rings", "commit": "0123456789", "licence": "MIT",
                                       "model": name + ".xml", **options} for name in models])
        script = os.path.join(program_case.ARGUMENTS.source, "scripts", "hands-table")
        return subprocess.run([sys.executable, script, programs or program_case.ARGUMENTS.programs, self.folder,
                               self.path("out"), "--list", self.path("list.json")],
                              capture_output=True, text=True, check=False)

    def cells(self, table, name):
        """Return the cells of each row of a model."""
        rows = [line for line in table.splitlines() if line.startswith(f"| {name} ")]
        return [[cell.strip() for cell in line.split(" | ")][1:] for line in rows]

    def test_the_hands_of_the_project_solve_a_quarter_turn(self):
        done = self.table("ring4", "ring5")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, fingers in (("ring4", 4), ("ring5", 5)):
            model, result = self.cells(done.stdout, name)
            self.assertEqual(model, ["`" + name + ".xml` [1]", "MIT", f"{4 * fingers}; {4 * fingers}", "none |"])
            self.assertEqual(result[0], f"{fingers}; 4")
            self.assertEqual(result[2], "50 mm")
            self.assertTrue(result[3].startswith("yes, "), result)
        self.assertIn("| 1 | own/rings | 01234567 |", done.stdout)

    def test_existing_results_are_used_again(self):
        self.table("ring4", edges_mm=[500])
        row = json.loads(self.read("out/ring4.json"))
        self.assertIsNone(row["grasp_edge_mm"])
        row["grasp_edge_mm"], row["turn"] = 77, {"found": False, "seconds": 60}
        self.write_json("out/ring4.json", row)
        self.assertEqual(self.cells(self.table("ring4").stdout, "ring4")[1][2:4], ["77 mm", "no, 60.0 s"])

    def test_a_hand_without_a_grasp_of_the_object_has_a_message(self):
        done = self.table("ring4", edges_mm=[500])
        self.assertEqual(done.returncode, 0, done.stderr)
        _, result, message = self.cells(done.stdout, "ring4")
        self.assertEqual(result[2:4], ["no", "–"])
        self.assertEqual(message[0], "static grasp")
        self.assertNotIn(self.folder, done.stdout)

    def test_refused_models_have_a_row_with_the_message(self):
        done = self.table("cut", "loop", "missing")
        self.assertEqual(done.returncode, 0, done.stderr)
        for name, counts, couplings, words in (("cut", "–; –", "none |", "cut.xml: line 2"),
                                               ("loop", "1; 1", "1 equality connect |", "loop.xml: "),
                                               ("missing", "–; –", "none |", "missing.xml: ")):
            model, result, message = self.cells(done.stdout, name)
            self.assertEqual(model[2:], [counts, couplings])
            self.assertEqual(result, ["refused", "–", "–", "–", "– |"])
            self.assertTrue(message[1].startswith("`" + words), message)

    def test_a_program_that_crashes_has_a_row_with_its_exit_code(self):
        os.mkdir(self.path("programs"))
        os.chmod(self.write("programs/hand", "#!/bin/sh\necho hand: last words >&2; kill -SEGV $$\n"), 0o755)
        done = self.table("ring4", "ring5", programs=self.path("programs"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.cells(done.stdout, "ring5")[1][0], "refused")
        self.assertIn("| ring4, ring5 | hand | `exit code -11: last words` |", done.stdout)

    def test_each_model_of_the_list_is_on_the_page(self):
        source = program_case.ARGUMENTS.source
        with open(os.path.join(source, "bench", "hand_models.json"), encoding="utf-8") as file:
            models = json.load(file)
        with open(os.path.join(source, "docs", "hand_models.md"), encoding="utf-8") as file:
            page = file.read()
        self.assertEqual(len({model["name"] for model in models}), len(models))
        for model in models:
            self.assertRegex(model["commit"], "^[0-9a-f]{40}$")
            row, result = self.cells(page, model["name"])[:2]
            self.assertTrue(row[0].startswith(f"`{model['model']}` ["), row)
            self.assertEqual(row[1], model["licence"])
            self.assertEqual(len(result), 5)
            self.assertIn(f"| {model['repository']} | {model['commit'][:8]} |", page)

    def test_a_list_without_a_member_is_refused(self):
        done = self.table("ring4", licence=None)
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("list.json: /0/licence must be a string, found null", done.stderr)


if __name__ == "__main__":
    program_case.main()
