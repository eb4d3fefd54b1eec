"""Every test is labelled fast or slow, and every name in the list of slow ones is that of a test.

usage: labels_test.py CTEST BUILD_FOLDER "SLOW_NAME;SLOW_NAME;..." [unittest's own arguments]
"""

import fnmatch
import json
import subprocess
import sys
import unittest

CTEST, BUILD, SLOW = sys.argv[1:4]


def ctest_tests():
    """The labels of every test, by its name."""
    listed = subprocess.run([CTEST, "--test-dir", BUILD, "--show-only=json-v1"],
                            check=True, capture_output=True, text=True)
    return {test["name"]: labels_of(test) for test in json.loads(listed.stdout)["tests"]}


def labels_of(test):
    return [label for item in test.get("properties", []) if item["name"] == "LABELS"
            for label in item["value"]]


def without_speed(tests):
    """The tests that are not labelled with one of the two speeds."""
    return [name for name, labels in tests.items()
            if len([label for label in labels if label in ("fast", "slow")]) != 1]


def out_of_date(slow, tests):
    """The names in the list of slow tests that no slow test has, with or without its package."""
    names = [name for name, labels in tests.items() if "slow" in labels]
    names += [name.split(".", 1)[1] for name in names if "." in name]
    return [pattern for pattern in slow if not fnmatch.filter(names, pattern)]


class Labels(unittest.TestCase):
    def test_every_test_is_fast_or_slow(self):
        tests = ctest_tests()
        self.assertGreater(len(tests), 1000)
        self.assertEqual(without_speed(tests), [], "is everything built?")

    def test_every_slow_name_is_that_of_a_slow_test(self):
        self.assertEqual(out_of_date(SLOW.split(";"), ctest_tests()), [])

    def test_a_test_without_speed_or_with_two_is_found(self):
        tests = {"a": ["fast", "sim"], "b": ["sim"], "c": ["fast", "slow"], "d": []}
        self.assertEqual(without_speed(tests), ["b", "c", "d"])

    def test_a_name_that_no_slow_test_has_is_found(self):
        tests = {"sim.Replay.Holds": ["fast"], "sim.Set/Stress.Is/case1": ["slow"],
                 "fuzz.obj": ["slow"]}
        slow = ["*/Stress.Is*", "fuzz.obj", "Replay.*", "Stress.*"]
        self.assertEqual(out_of_date(slow, tests), ["Replay.*", "Stress.*"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
