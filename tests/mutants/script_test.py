"""scripts/mutate, on a project of one function and a program that tests it.

usage: script_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import fcntl
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])

FILES = {
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.25)
project(toy LANGUAGES CXX)
add_executable(sum_test tests/sum/sum_test.cc sum.cc)
set_target_properties(sum_test PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests/sum)
""",
    "CMakePresets.json": """{"version": 6, "configurePresets": [
  {"name": "dev", "generator": "Ninja", "binaryDir": "${sourceDir}/build/dev"}]}
""",
    "sum.cc": """int Sum(int a, int b) {
  while (b < 0) {
    --a;
    ++b;
  }
  return a + b;
}
""",
    # Says what GoogleTest says.
    "tests/sum/sum_test.cc": """#include <cstdio>
int Sum(int a, int b);
#define TEST(suite, name) static bool name()
TEST(Sum, OfTwo) { return Sum(2, 1) == 3; }
TEST(Sum, OfLess) { return Sum(2, -1) == 1; }
static int Report(const char* name, bool (*test)()) {
  std::printf("[ RUN      ] Sum.%s\\n", name);
  std::fflush(stdout);
  const bool passes = test();
  if (!passes) std::printf("[  FAILED  ] Sum.%s (0 ms)\\n", name);
  return !passes;
}
int main() { return Report("OfTwo", OfTwo) || Report("OfLess", OfLess); }
""",
}

MUTANTS = {
    "difference": ("return a + b;", "return a - b;", ""),
    "ended": ("return a + b;", "__builtin_trap();", ""),
    "endless": ("    ++b;", "    ++a;", "hangs = true\n"),
    "endless-unsaid": ("    ++b;", "    --a; ++a;", ""),
    "unnoticed": ("while (b < 0) {", "while (b < -100) {", ""),
    "equivalent": ("return a + b;", "return b + a;", "reason = 'Sums do not depend on the order.'\n"),
    "not-equivalent": ("return a + b;", "return b - a;", "reason = 'It makes no difference.'\n"),
    "no-code": ("return a + b;", "return a +;", ""),
}


class Mutate(unittest.TestCase):
    """One folder for all cases, so that most is built once."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        for name, text in FILES.items():
            cls.write(name, text)
        cls.write("tests/mutants/toy.toml", "\n".join(
            f"[[mutant]]\nname = '{name}'\nfile = 'sum.cc'\nwhat = 'Of the test.'\nold = '{old}'\n"
            f"new = '{new}'\ntests = ['sum Sum.*']\n{more}" for name, (old, new, more) in MUTANTS.items()))
        (cls.folder / "bench" / "tables").mkdir(parents=True)

    @classmethod
    def write(cls, name, text):
        path = cls.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def mutate(self, *names, limit="5"):
        command = [sys.executable, SOURCE / "scripts" / "mutate", "--project", self.folder, "--limit",
                   limit, *(f"--only={name}" for name in names)]
        return subprocess.run(command, capture_output=True, text=True, check=False,
                              env={**os.environ, "CCACHE_DISABLE": "1"})

    def assert_ends(self, code, words, *names):
        done = self.mutate(*names)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertIn(words, done.stdout + done.stderr)
        for name, text in FILES.items():
            self.assertEqual((self.folder / name).read_text(encoding="utf-8"), text, "the tree changed")

    def table(self):
        return (self.folder / "bench" / "tables" / "mutants.md").read_text(encoding="utf-8")

    def test_what_is_caught_is_told_with_the_test_that_fails(self):
        self.assert_ends(0, "difference: Sum.OfTwo", "difference", "equivalent")
        self.assertIn("| Sum.OfTwo |", self.table())
        self.assertIn("survives: Sums do not depend on the order.", self.table())

    def test_a_program_that_crashes_or_does_not_end_has_caught_it(self):
        self.assert_ends(0, "ended: Sum.OfTwo (ends it)", "ended")

    def test_a_test_that_does_not_end_counts_only_where_the_list_says_so(self):
        done = self.mutate("endless", "endless-unsaid", limit="1")
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("endless: the time limit", done.stdout)
        self.assertIn("endless-unsaid: sum Sum.* does not end", done.stderr)

    def test_a_survivor_without_reason_fails(self):
        self.assert_ends(1, "unnoticed: survives: no reason is stated", "unnoticed")

    def test_a_reason_for_what_is_caught_fails(self):
        self.assert_ends(1, "a reason says that nothing can catch it", "not-equivalent")

    def test_what_does_not_compile_is_not_caught(self):
        self.assert_ends(1, "no-code: does not compile", "no-code")
        self.assertNotIn("no-code | `sum.cc` | Of the test. | Sum", self.table())

    def test_tests_that_fail_anyway_catch_nothing(self):
        self.write("sum.cc", FILES["sum.cc"].replace("--a;", "++a;"))
        try:
            done = self.mutate("difference")
        finally:
            self.write("sum.cc", FILES["sum.cc"])
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertIn("without a defect sum Sum.* fails: Sum.OfLess", done.stderr)

    def test_a_second_run_is_refused_while_one_is_at_work(self):
        folder = self.folder / "build" / "mutate"
        folder.mkdir(parents=True, exist_ok=True)
        with open(folder / "lock", "w", encoding="ascii") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            self.assert_ends(1, "another run is at work", "difference")

    def test_an_unknown_name_is_refused_in_one_line(self):
        self.assert_ends(2, "no mutant is called other", "other")

    def test_it_lists_mutants_without_trying_them(self):
        done = subprocess.run([SOURCE / "scripts" / "mutate", "--project", self.folder, "--list"],
                              capture_output=True, text=True, check=True)
        self.assertEqual(done.stdout.count("(sum.cc)"), len(MUTANTS))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
