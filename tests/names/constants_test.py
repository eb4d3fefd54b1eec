"""Every constant of planner/gait is in a table of docs/gait_constants.md, and the tables have no others.

usage: constants_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
# Sentinels, texts, the layout of seeds and the measurements of failure causes are no parameters of the method.
NO_PARAMETERS = {"kContained", "kFewestGrasps", "kGripSamples", "kMostlyColliding", "kMostlyLost",
                 "kMeasuredExpanded", "kMeasuredTurn", "kNone", "kNoNode", "kRating",
                 "kReachSteps", "kRollingShift", "kSimulating", "kStreamShift"}


def defined(text):
    """The names of the constants that a source defines."""
    return set(re.findall(r"\bconstexpr [^;=(]*?\b(k[A-Z]\w*) =", text))


def documented(text):
    """The names in the first column of the tables of a page."""
    rows = re.findall(r"^\| (`k[^|]*)\|", text, re.MULTILINE)
    return {name for row in rows for name in re.findall(r"`(k\w+)`", row)}


class Constants(unittest.TestCase):
    def test_the_page_has_the_constants_of_the_sources(self):
        names = set()
        for file in (SOURCE / "planner" / "gait").glob("*.*"):
            names |= defined(file.read_text())
        self.assertGreater(len(names), 50)
        self.assertEqual(documented((SOURCE / "docs" / "gait_constants.md").read_text()),
                         names - NO_PARAMETERS)

    def test_a_constant_that_is_missing_on_one_side_is_found(self):
        source = "constexpr int kOne = 1;\ninline constexpr std::array kTwo = {1, 2};\nint kNo = 3;\n"
        page = "| constant |\n| --- |\n| `kOne`, `kThree` | 1, 3 |\nThe text names `kFour`.\n"
        self.assertEqual(defined(source), {"kOne", "kTwo"})
        self.assertEqual(documented(page), {"kOne", "kThree"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
