"""validate --explain REASON and evaluate --explain REASON: the reference of failure reasons, on the terminal and as a page."""

import json
import os

import program_case
from program_case import ProgramCase


def reasons_and_causes(schema):
    """Return the names that a report's schema allows for `reason` and for a likely `cause`."""
    found = {"reason": set(), "cause": set()}

    def walk(node):
        if isinstance(node, list):
            for value in node:
                walk(value)
        elif isinstance(node, dict):
            for name in found:
                choices = node.get("properties", {}).get(name, {})
                for allowed in [choices, *choices.get("anyOf", choices.get("oneOf", []))]:
                    found[name] |= {word for word in allowed.get("enum", []) if word}
            for value in node.values():
                walk(value)
    walk(schema)
    return found["reason"], found["cause"]


class Explain(ProgramCase):
    program = "validate"

    def source(self, name):
        with open(os.path.join(program_case.ARGUMENTS.source, "docs", name), encoding="utf-8") as file:
            return file.read()

    def test_a_reason_is_explained_without_any_other_argument(self):
        said = self.assert_done("--explain", "torque-limit").stdout
        self.assertTrue(said.startswith("torque-limit (replay)\n\nWith --replay hand: "), said)
        for words in ("\n\nUsual causes:\n  - The grasp force is", "\n\nRemedies:\n  - Use a smaller",
                      "\nDocumentation: docs/failure_reasons.md#torque-limit\n"):
            self.assertIn(words, said)
        self.assertEqual(self.assert_done("validate", "--explain", "torque-limit", program="regrasp").stdout, said)
        # The position of the option does not matter, and no markup remains.
        self.assertEqual(self.assert_done("--object", "no.obj", "--explain=torque-limit").stdout, said)
        self.assertNotRegex(self.assert_done("--explain", "slipped").stdout, r"[`\[\]]")

    def test_lines_fit_into_the_terminal(self):
        for width in (60, 90):
            lines = self.assert_done("--explain", "contact-lost",
                                     environment={"COLUMNS": str(width)}).stdout.splitlines()
            self.assertLessEqual(max(map(len, lines)), width)
            self.assertGreater(max(map(len, lines)), width - 20)

    def test_every_reason_and_cause_of_a_report_is_explained(self):
        reasons, causes = reasons_and_causes(json.loads(self.source("report.schema.json")))
        self.assertLess({"slipped", "off-surface", "goal-not-reached"}, reasons)
        self.assertLess({"no-room", "unknown"}, causes)
        for name in sorted(reasons | causes):
            said = self.assert_done("--explain", name).stdout
            self.assertTrue(said.startswith(name + " ("), said)
            self.assertEqual("(likely cause)" in said, name in causes, said)

    def test_an_unknown_reason_is_refused_with_the_list(self):
        self.assert_refused(2, ['--explain: failure reason not found, expected one of all, off-surface, ',
                                ", slipped, ", ", unknown", ', found "slippd"'], "--explain", "slippd")
        self.assert_refused(2, "--explain: must not be empty, expected REASON", "--explain", "")
        self.assert_refused(2, "--explain", "--explain")

    def test_the_pages_of_the_documents_have_the_same_text(self):
        reasons, heading, causes = self.assert_done("--explain", "all").stdout.partition("\n## Likely causes\n")
        for page, made in (("failure_reasons.md", "\n" + reasons), ("likely_causes.md", heading + causes)):
            text = self.source(page)
            self.assertTrue(text.endswith(made), f"{page} is out of date: run scripts/command-pages")
            # Negative control: an entry of another program version is found.
            self.assertFalse(text.replace("friction", "traction").endswith(made))

    def test_reasons_of_evaluate_are_explained_by_evaluate(self):
        said = self.assert_done("--explain", "dropped", program="evaluate").stdout
        self.assertTrue(said.startswith("dropped (evaluation of a hand grasp)\n\nNo link touches the object"), said)
        self.assertTrue(said.endswith("\nDocumentation: docs/grasp_failure_reasons.md#dropped\n"), said)
        self.assert_refused(2, ["--explain: failure reason not found, expected one of all, joints-out-of-range, ",
                                ', found "slipped"'], "--explain", "slipped", program="evaluate")
        made = self.assert_done("--explain", "all", program="evaluate").stdout
        text = self.source("grasp_failure_reasons.md")
        self.assertTrue(text.endswith("\n" + made), "grasp_failure_reasons.md is out of date: run scripts/command-pages")
        self.assertFalse(text.replace("friction", "traction").endswith(made))


if __name__ == "__main__":
    program_case.main()
