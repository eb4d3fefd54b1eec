"""Tests of scripts/check-language: every rule with a positive and a negative control, budgets, links.

usage: language_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import contextlib
import importlib.machinery
import importlib.util
import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import types
import unittest

SCRIPT = pathlib.Path(sys.argv[1]) / "scripts" / "check-language"


def load():
    """Return the script as a module."""
    loader = importlib.machinery.SourceFileLoader("check_language", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_language", loader))
    loader.exec_module(module)
    return module


CHECK = load()

# rule: (texts that it finds, texts that it does not find)
CONTROLS = {
    "where-if": (["It fails where no hand holds that.", "a file where there is one"], ["The folder in which it is", "see where"]),
    "free-what": (["What fails has rolled.", "It prints what is missing."], ["What is a grasp?", "Print the missing file."]),
    "free-who": (["Whoever has hands needs time.", "arrays for who trains"], ["users who train policies", "Who is it?"]),
    "three-that": (["a grasp that a hand that turns that holds"], ["a grasp that holds, that is all"]),
    "as-because": (["As tips roll. As they roll, it fails.", "It fails, as the contacts roll."],
                   ["the same as the plan", "written as the first line", "As in the plane, it holds."]),
    "is-no": (["It is no NPZ file.", "a value is none of these"], ["There is no plan.", "is not a file", "is no longer used"]),
    "personified": (["the message says so", "it looks for a plan"], ["the message states it", "the look of it"]),
    "carry-out": (["motors carry the plan out", "it comes to a stop", "fingers stand on it"], ["execute the plan", "a stand"]),
    "to-spare": (["friction to spare", "plans with reserve"], ["in-hand motions", "use --robustness none"]),
    "asked": (["is asked for", "ask for less"], ["is requested", "a task"]),
    "ways": (["finds no way", "two ways"], ["one-way", "always", "a path"]),
    "distributive-a": (["17 plans a second", "a line a query", "one a core"], ["17 plans per second", "a core", "1. On a piece"]),
    "so-many": (["by so many points"], ["by N points", "so that many"]),
    "fronted-of": (["Of each finger, it prints one.", "It ends. Of two, one."], ["one of each", "Of course", "three; of them two"]),
    "beside": (["beside the plan", "besides, it works"], ["next to the plan"]),
    "goes-with": (["--jobs goes with --batch", "the run goes on"], ["--jobs requires --batch", "it goes to B"]),
    "is-to": (["the body is to be within 1 mm", "has to be closed"], ["must be within 1 mm", "needs to be"]),
    "of-others": (["formats of others are read", "a finger from the other.", "those of others", "the other one"], ["third-party formats", "of other users", "unlike those of MuJoCo"]),
    "vague-passive": (["it is told in a line", "was tried"], ["is printed", "is tested"]),
    "semicolons": (["one; two; three"], ["one; two. Three; four", "one, two"]),
    "idiom": (["closed all along", "At first it holds.", "in the end"], ["throughout", "at the end", "first"]),
    "else": (["or else it fails"], ["otherwise it fails", "elsewhere"]),
    "history": (["Since then it is fast.", "Now it is fast."], ["It is fast now.", "NOW"]),
    "vague": (["some 500 files", "hardly any"], ["about 500 files", "some files"]),
    "metaphor": (["the ladder", "It keeps its promise."], ["the stages", "keeps its value"]),
    "term-half-angle": (["the friction half-angle"], ["the friction angle", "half the angle"]),
    "term-motor": (["the hand's motors", "Motors turn."], ["the actuators", "motorised"]),
    "term-rest": (["in each rest", "an object at rest"], ["the rest of the file", "in a static grasp"]),
    "term-squeeze": (["the squeeze is large"], ["use --grasp-force realistic", "grasp force"]),
    "term-shake": (["it is shaken", "a shake"], ["--disturbance 0", "the disturbance test"]),
    "term-push": (["largest push"], ["push_limit", "the disturbance force"]),
    "term-joint": (["a hinge", "the posture"], ["a revolute joint"]),
    "term-lever": (["times their levers"], ["moment arms", "leverage"]),
    "term-facet": (["200 facets"], ["200 triangles", "facet-wise"]),
    "term-invented": (["invented surface"], ["filled surface", "--allow filled"]),
    "term-tip": (["the tips roll"], ["the fingertips roll", "--tip geometry"]),
    "term-picture": (["Picture of a plan", "a moving picture", "the contact sheet"], ["an animation", "--picture FILE"]),
    "term-aligns": (["two aligns", "an align"], ["it aligns the axes", "the step `align`"]),
    "term-thing": (["a thing"], ["nothing", "an object"]),
    "term-judge": (["it judges plans"], ["it evaluates plans"]),
    "term-effort": (["with more effort"], ["--planner budget=N", "search budget"]),
    "term-natural-time": (["its natural time"], ["its characteristic time"]),
    "term-person": (["hands like a person's"], ["anthropomorphic hands"]),
    "term-lines": (["a file of lines"], ["a JSON Lines file"]),
    "message-verb": (["a text is needed", "the file is spoilt"], ["must be a str", "the file is corrupt"]),
}

LONG = " ".join(["word"] * 31)


def rules(name, text):
    """Return the rules that find something in a file of that name."""
    return [finding.rule for finding in CHECK.findings(name, text)]


class Rules(unittest.TestCase):
    def test_every_rule_has_controls(self):
        self.assertEqual(sorted(CONTROLS), sorted(CHECK.RULES))
        self.assertGreater(len(CONTROLS), 40)

    def test_every_rule_finds_its_positive_control_and_not_its_negative_one(self):
        for rule, (bad, good) in CONTROLS.items():
            self.assertTrue(bad and good)
            for text in bad:
                self.assertIn(rule, rules("a.md", text + "\n"), text)
                self.assertIn(rule, rules("a.h", f"/// {text}\n"), text)
                self.assertIn(rule, rules("a.cc", f'  Print("{text}");\n'), text)
                self.assertIn(rule, rules("a.py", f'print("{text}")  # ok\n'), text)
            for text in good:
                self.assertNotIn(rule, rules("a.md", text + "\n"), text)
                self.assertNotIn(rule, rules("a.cc", f"// {text}\n"), text)

    def test_a_long_sentence_is_found_in_prose_only(self):
        self.assertEqual(rules("a.md", LONG + ".\n"), ["long-sentence"])
        self.assertEqual(rules("a.md", LONG[5:] + ".\n"), [])
        self.assertEqual(rules("a.md", "Short one. " * 20 + "\n"), [])
        self.assertEqual(rules("a.md", f"- {LONG[:80]}\n- {LONG[80:]}\n"), [])
        self.assertEqual(rules("a.md", f"| a | b |\n| --- | --- |\n| {LONG} | x |\n"), [])
        self.assertEqual(rules("a.h", f"/// {LONG}\n"), [])

    def test_a_comment_that_is_the_rest_of_a_sentence_is_found(self):
        self.assertEqual(rules("a.h", "/// Where it fails.\nint a;\n"), ["dangling"])
        self.assertEqual(rules("a.h", "int a;  ///< Those in a file.\n"), ["dangling"])
        self.assertEqual(rules("a.h", "/// Return the\n/// Those.\nint a;\n"), [])
        self.assertEqual(rules("a.cc", 'Print("Where?");\n'), [])


class Texts(unittest.TestCase):
    def test_code_in_markdown_is_not_read(self):
        self.assertEqual(rules("a.md", "```sh\nmotors\n```\n\n    motors\n\n`motors` and ``motors`` "
                               "<!-- motors -->[a](motors.md)\n"), [])
        self.assertEqual(rules("a.md", "| `motors` |\n| --- |\n| motors |\n"), ["term-motor"])

    def test_code_in_sources_is_not_read(self):
        self.assertEqual(rules("a.cc", "int motors = 1;  // `motors`\nchar c = '\"'; int motors;\n"), [])
        self.assertEqual(rules("a.py", "motors = 1\n"), [])
        self.assertEqual(rules("a.cc", 'Key("motor"); Format("<motor name='"'x'/>"'");\n'), [])
        self.assertEqual(rules("a.cc", 'Print("a " "motor");\n'), ["term-motor"])
        self.assertEqual(rules("a.py", 'd["motor"] = 1\n'), [])
        self.assertEqual(rules("a.py", '"""Return it.\n\n>>> motors\nmotors\n\nDone."""\n'), [])
        self.assertEqual(rules("a.py", '"""Return it.\n\nthe motors\n"""\n'), ["term-motor"])

    def test_settings_of_options_are_not_read(self):
        self.assertEqual(rules("a.cc", 'f("use --tip geometry here");'), [])
        self.assertNotEqual(rules("a.cc", 'f("use the tip of geometry here");'), [])

    def test_phrases_are_found_across_lines_with_their_line(self):
        for name, text in (("a.md", "One\n\nthe natural\ntime\n"), ("a.h", "int a;\n\n// the natural\n// time\n"),
                           ("a.cc", '\n\nf("the natural "\n  "time");\n'), ("a.py", '\n\n# the natural\n# time\n')):
            found = CHECK.findings(name, text)
            self.assertEqual([(f.line, f.rule) for f in found], [(3, "term-natural-time")], name)


class Project(unittest.TestCase):
    """A folder of files to check."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        self.write("scripts/x.md", "")

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def budget(self, **counts):
        self.write(CHECK.BUDGET, json.dumps({f"{name}.md": count for name, count in counts.items()}))

    def read_budget(self):
        with open(os.path.join(self.folder, CHECK.BUDGET), encoding="utf-8") as file:
            return json.load(file)

    def run_script(self, *arguments):
        """Run the script in this process; return its exit code and output."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = CHECK.main(["--root", self.folder, *arguments])
        return types.SimpleNamespace(returncode=code, stdout=out.getvalue(), stderr=err.getvalue())

    def git(self, *arguments):
        subprocess.run(["git", "-C", self.folder, "-c", "user.name=A", "-c", "user.email=a@b.c", *arguments], check=True,
                       capture_output=True)

    def assert_error(self, *parts, arguments=()):
        done = self.run_script(*arguments)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)

    def assert_good(self, *arguments):
        done = self.run_script(*arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)


class Budgets(Project):
    def test_a_file_may_have_as_many_findings_as_its_budget(self):
        self.write("a.md", "two motors, one motor\n")
        self.budget(a=2)
        self.assert_good()
        self.budget(a=1)
        self.assert_error("a.md: 2 findings, budget 1")

    def test_a_new_file_has_budget_0(self):
        self.budget(a=2)
        self.write("b.md", "an actuator\n")
        self.assert_good()
        self.write("b.md", "a motor\n")
        self.assert_error("b.md: 1 findings, budget 0")

    def test_update_lowers_budgets_and_raises_none(self):
        self.write("a.md", "motor\n")
        self.write("b.md", "motor motor motor\n")
        self.write("c.md", "motor\n")
        self.budget(a=4, b=2, gone=3)
        self.assert_error("b.md: 3 findings, budget 2", "c.md: 1 findings, budget 0", arguments=["--update"])
        self.assertEqual(self.read_budget(), {"a.md": 1, "b.md": 2})

    def test_update_without_a_budget_file_writes_the_first_one(self):
        self.write("a.md", "motor motor\n")
        self.write("b.md", "actuator\n")
        self.assert_good("--update")
        self.assertEqual(self.read_budget(), {"a.md": 2})
        self.assert_good()

    def test_a_raised_budget_is_refused(self):
        self.write("a.md", "motor\n")
        self.budget(a=1)
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "one")
        self.assert_good()
        self.write("a.md", "motor motor\n")
        self.budget(a=2)
        self.assert_error("a.md: budget 2 is higher than 1 in HEAD")
        self.git("commit", "-q", "-a", "-m", "two")
        self.assert_error("a.md: budget 2 is higher than 1 in HEAD^1")
        self.git("commit", "-q", "--allow-empty", "-m", "three")
        self.assert_good()
        self.assert_error("a.md: budget 2 is higher than 1 in HEAD~2", arguments=["--base", "HEAD~2"])

    def test_a_budget_for_a_new_file_is_refused(self):
        self.write("a.md", "motor\n")
        self.budget(a=1)
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "one")
        self.write("b.md", "motor\n")
        self.budget(b=1)
        self.assert_error("b.md: budget 1 is higher than 0 in HEAD")

    def test_a_file_may_have_the_budgets_of_removed_files_of_its_folder(self):
        self.write("a.md", "motor\n")
        self.write("b.md", "motor motor\n")
        self.write("c.md", "motor\n")
        self.budget(a=1, b=2, c=1)
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "one")
        os.remove(os.path.join(self.folder, "b.md"))
        self.write("a.md", "motor motor motor\n")
        self.budget(a=3, c=1)
        self.assert_good()
        self.write("c.md", "motor motor\n")
        self.budget(a=3, c=2)
        self.assert_error("c.md: budget 2 is higher than 1 in HEAD")

    def test_a_bad_budget_file_or_argument_is_refused_in_one_line(self):
        for text in ("{", "[1]", '{"a.md": -1}', '{"a.md": "1"}', '{"a.md": true}'):
            self.write(CHECK.BUDGET, text)
            done = self.run_script()
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), text + done.stderr)
            self.assertTrue(done.stderr.startswith(f"check-language: error: {CHECK.BUDGET}: "), done.stderr)
        self.budget()
        for arguments in (["none.md"], ["--update", "scripts/x.md"]):
            self.assertEqual(self.run_script(*arguments).returncode, 2)

    def test_the_program_ends_with_the_exit_code(self):
        self.write("a.md", "motor\n")
        for budget, code in ((1, 0), (0, 1)):
            self.budget(a=budget)
            done = subprocess.run([sys.executable, str(SCRIPT), "--root", self.folder], text=True, capture_output=True,
                                  check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (code, code), done.stderr)

    def test_findings_are_listed_and_counted(self):
        self.write("a.md", "# One\n\nmotor\n")
        self.budget(a=1)
        self.assertEqual(self.run_script("--list", "a.md").stdout,
                         'a.md:3: term-motor: "motor": write actuator\n')
        self.assertIn("| term-motor | 1 | 0 | 0 | 0 |", self.run_script("--count").stdout)

    def test_data_and_build_folders_are_not_read(self):
        for folder in ("tests/data", "build/x", "bench/tables", "a/data"):
            self.write(f"{folder}/a.md", "motor\n")
        self.budget()
        self.assert_good()


class Links(Project):
    def test_dead_links_are_errors_whatever_the_budget_is(self):
        self.budget(a=99)
        self.write("b.md", "# The map\n\n## A `code` (x)\n\n```\n# no heading\n```\n")
        self.write("a.md", "[1](b.md) [2](b.md#the-map) [3](https://x.org/none) [4](#here) [5](b.md#a-code-x)\n\n# Here\n\n"
                   "`[6](c.md)`\n")
        self.assert_good()
        for link, problem in (("c.md", "file not found"), ("b.md#the-maps", "anchor not found"),
                              ("#there", "anchor not found"), ("b.md#no-heading", "anchor not found")):
            self.write("a.md", f"# Here\n\n[1]({link})\n")
            self.assert_error(f"a.md:3: dead link {link}: {problem}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
