"""Every example of every docstring runs, and every public name has a docstring."""

import doctest
import inspect
import os
import unittest

import regrasp
from regrasp import formats, grasps, hand_grasps, hands, objects, plans, reports

MODULES = [regrasp, formats, grasps, hand_grasps, hands, objects, plans, reports]


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
        for module, name in [(m, n) for m in (regrasp, formats) for n in m.__all__]:
            item = getattr(module, name)
            self.assertTrue(inspect.getdoc(item), name)
            if not inspect.isclass(item) or issubclass(item, Exception):
                continue
            for member, value in vars(item).items():
                if member.startswith("_") or not (callable(value) or isinstance(value, property)):
                    continue
                self.assertTrue(inspect.getdoc(getattr(item, member)), f"{name}.{member}")

    def test_what_is_public_has_type_hints(self):
        checked = 0
        for module, name in [(m, n) for m in (regrasp, formats) for n in m.__all__]:
            item = getattr(module, name)
            if inspect.isclass(item):
                functions = [f for key, f in inspect.getmembers(item, inspect.isroutine)
                             if not key.startswith("_") and key in vars(item)]
                functions += [p.fget for p in vars(item).values() if isinstance(p, property)]
            else:
                functions = [item]
            for function in functions:
                function = getattr(function, "__func__", function)
                hints = inspect.get_annotations(function)
                arguments = [argument for argument in inspect.signature(function).parameters
                             if argument not in ("self", "cls")]
                self.assertEqual(set(hints), {*arguments, "return"}, function.__qualname__)
                checked += 1
        self.assertGreater(checked, 40)


if __name__ == "__main__":
    unittest.main()
