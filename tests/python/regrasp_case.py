"""What the tests of the module share; the folder of the built programs is in REGRASP_PROGRAMS."""

import os
import tempfile
import unittest

import regrasp

PROGRAMS = os.environ["REGRASP_PROGRAMS"]


class RegraspCase(unittest.TestCase):
    """A folder of its own for each test, and what every error promises."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def refuses(self, words, function, *arguments, **named):
        """That bad input is an InputError of one line that has all the words."""
        with self.assertRaises(regrasp.InputError) as caught:
            function(*arguments, **named)
        self.assertNotIn("\n", str(caught.exception))
        for word in words:
            self.assertIn(word, str(caught.exception))
