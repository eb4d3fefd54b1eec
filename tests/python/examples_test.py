"""Every example of every docstring runs, and everything public has a docstring."""

import doctest
import inspect
import os
import unittest

import regrasp
from regrasp import formats, grasps, hands, objects, plans, reports

MODULES = [regrasp, formats, grasps, hands, objects, plans, reports]


class ExamplesTest(unittest.TestCase):

    def test_examples_hold(self):
        attempted = 0
        for module in MODULES:
            with self.subTest(module=module.__name__):
                result = doctest.testmod(module)
                self.assertEqual(result.failed, 0)
                attempted += result.attempted
        self.assertGreater(attempted, 20)

    def test_the_page_holds(self):
        result = doctest.testfile(os.path.join(os.getcwd(), "docs/python.md"),
                                  module_relative=False, optionflags=doctest.ELLIPSIS)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 15)

    def test_all_that_is_public_is_described(self):
        for name in regrasp.__all__:
            item = getattr(regrasp, name)
            self.assertTrue(inspect.getdoc(item), name)
            if not inspect.isclass(item) or issubclass(item, Exception):
                continue
            for member, value in vars(item).items():
                if member.startswith("_") or not (callable(value) or isinstance(value, property)):
                    continue
                self.assertTrue(inspect.getdoc(getattr(item, member)), f"{name}.{member}")

    def test_functions_have_type_hints(self):
        for function in (regrasp.force_closure, regrasp.Object.read, regrasp.Object.from_arrays):
            self.assertIn("return", inspect.get_annotations(function))


if __name__ == "__main__":
    unittest.main()
