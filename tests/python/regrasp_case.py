"""Base of the tests of the Python module. REGRASP_PROGRAMS is the folder of the built programs."""

import os
import tempfile
import unittest

import regrasp

PROGRAMS = os.environ["REGRASP_PROGRAMS"]


class RegraspCase(unittest.TestCase):
    """Test case with its own folder, and the common properties of all errors."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def refuses(self, words, function, *arguments, **named):
        """Expect that invalid input is an InputError with one line that contains all the words."""
        with self.assertRaises(regrasp.InputError) as caught:
            function(*arguments, **named)
        self.assertNotIn("\n", str(caught.exception))
        for word in words:
            self.assertIn(word, str(caught.exception))
