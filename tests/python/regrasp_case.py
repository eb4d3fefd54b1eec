"""Base of the tests of the Python module. REGRASP_PROGRAMS is the folder of the built programs."""

import json
import os
import tempfile
import unittest

import jsonschema

import regrasp
from regrasp import formats

PROGRAMS = os.environ["REGRASP_PROGRAMS"]


def grasps_of_a_turn(object, hand):
    """Return the hand grasps of a plan that rotates an object by 30 degrees."""
    plan = regrasp.plan_in_hand(object, hand, mu=0.8, turn=("z", 30))
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "plan.json")
        plan.write(path)
        return formats.of_plan(path, hand)


class RegraspCase(unittest.TestCase):
    """Test case with its own folder, and the common properties of all errors."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def hand_grasps(self, name="out.jsonl"):
        """Return the hand grasps of a file in JSON Lines, which must follow their schema."""
        with open("docs/hand_grasp.schema.json", encoding="utf-8") as file:
            schema = json.load(file)
        with open(self.path(name), encoding="utf-8") as file:
            entries = [json.loads(line) for line in file]
        for entry in entries:
            jsonschema.validate(entry, schema)
        return entries

    def refuses(self, words, function, *arguments, **named):
        """Expect that invalid input is an InputError with one line that contains all the words."""
        with self.assertRaises(regrasp.InputError) as caught:
            function(*arguments, **named)
        self.assertNotIn("\n", str(caught.exception))
        for word in words:
            self.assertIn(word, str(caught.exception))
