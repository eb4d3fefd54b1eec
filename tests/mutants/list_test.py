"""The mutants of scripts/mutate apply to the sources, and the table says of each what became of it.

usage: list_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import pathlib
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])
sys.path.insert(0, str(SOURCE / "scripts"))
import mutants

LISTS = mutants.read_lists(SOURCE / "tests" / "mutants")
ALL = [mutant for listed in LISTS.values() for mutant in listed]
TABLE = SOURCE / "bench" / "tables" / "mutants.md"

ENTRY = """[[mutant]]
name = "sum-as-difference"
file = "sum.cc"
what = "A sum is a difference."
old = 'a + b'
new = 'a - b'
tests = ["sum Sum.*"]
"""


def refusal(call, *arguments):
    """What a call refuses; empty where it does not."""
    try:
        call(*arguments)
    except mutants.ListError as error:
        return str(error)
    return ""


class ListOfMutants(unittest.TestCase):
    def test_every_mutant_applies_once_and_its_tests_are_there(self):
        self.assertGreaterEqual(len(ALL), 30)
        refused = {mutant.name: why for mutant in ALL if (why := refusal(mutants.check, mutant, SOURCE))}
        self.assertEqual(refused, {})

    def test_the_checker_the_replay_and_the_judges_have_mutants(self):
        self.assertEqual(sorted(LISTS), ["checker", "judge", "replay"])

    def test_the_table_is_that_of_the_lists_and_of_all_of_them(self):
        text = TABLE.read_text(encoding="utf-8")
        became = mutants.read_table(text)
        self.assertEqual(sorted(became), sorted(mutant.name for mutant in ALL),
                         "scripts/mutate --only NAME writes a row")
        self.assertNotIn("not run", became.values(), "scripts/mutate --only NAME runs one")
        self.assertEqual(text, mutants.format_table(LISTS, became))

    def test_what_survives_in_the_table_has_its_reason_in_the_list_and_nothing_else_has_one(self):
        became = mutants.read_table(TABLE.read_text(encoding="utf-8"))
        for mutant in ALL:
            survives = became[mutant.name].startswith(mutants.SURVIVES)
            self.assertEqual(survives, bool(mutant.reason), mutant.name)


class ReadMutants(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        (self.folder / "tests" / "sum").mkdir(parents=True)
        self.write("sum.cc", "int Sum(int a, int b) { return a + b; }\n")
        self.write("tests/sum/sum_test.cc", "TEST(Sum, OfTwoNumbers) {}\n")

    def write(self, name, text):
        (self.folder / name).write_text(text, encoding="utf-8")

    def read(self, text):
        self.write("list.toml", text)
        return mutants.read_list(self.folder / "list.toml")

    def why(self, text=ENTRY):
        return refusal(mutants.check, self.read(text)[0], self.folder)

    def test_a_mutant_that_applies_is_made(self):
        self.assertEqual(self.why(), "")
        self.assertEqual(mutants.mutated(self.read(ENTRY)[0], "return a + b;"), "return a - b;")

    def test_a_mutant_that_applies_nowhere_or_twice_is_named(self):
        self.write("sum.cc", "int Sum(int a, int b) { return b + a; }\n")
        self.assertIn("sum-as-difference: its old text stands 0 times", self.why())
        self.write("sum.cc", "a + b + (a + b)\n")
        self.assertIn("sum-as-difference: its old text stands 2 times", self.why())
        (self.folder / "sum.cc").unlink()
        self.assertIn("sum-as-difference: there is no file sum.cc", self.why())

    def test_a_test_that_is_not_there_is_named(self):
        for tests in ("sum Difference.*", "sum Sum.*:Sum.OfThree", "difference *", "sum/no.py Sum"):
            self.assertIn("sum-as-difference: ", self.why(ENTRY.replace("sum Sum.*", tests)), tests)

    def test_malformed_lists_are_refused(self):
        for text, words in ((ENTRY.replace("what", "why"), "lacks what"),
                            (ENTRY + "hang = true\n", "unknown: hang"),
                            (ENTRY.replace('"sum Sum.*"', ""), "lacks tests"),
                            ("[[mutant", "no list of mutants"), ("", "no list of mutants")):
            self.assertIn(words, refusal(self.read, text))
        self.read(ENTRY + ENTRY)
        self.assertIn("more than one", refusal(mutants.read_lists, self.folder))

    def test_a_table_is_read_as_it_was_written(self):
        lists = {"list": self.read(ENTRY)}
        became = {"sum-as-difference": "Sum.OfTwoNumbers"}
        self.assertEqual(mutants.read_table(mutants.format_table(lists, became)), became)
        self.assertIn("1 mutants: 1 caught, 0 survive", mutants.format_table(lists, became))
        self.assertIn("1 not run", mutants.format_table(lists, {}))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
