"""The notebook of the documents: all cells run, and show what its text announces."""

import json
import os
import unittest

import regrasp
from regrasp_case import RegraspCase


def cells():
    """Return the code of the notebook's cells, in order."""
    with open("docs/first_regrasp.ipynb", encoding="utf-8") as file:
        notebook = json.load(file)
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]


def run(code, names):
    """Run a cell as a notebook does.

    Returns:
        The value of its last line if that is an expression, otherwise None.
    """
    *lines, last = code.rstrip().split("\n")
    try:
        expression = compile(last, "cell", "eval")
    except SyntaxError:
        exec(compile(code, "cell", "exec"), names)  # pylint: disable=exec-used
        return None
    exec(compile("\n".join(lines), "cell", "exec"), names)  # pylint: disable=exec-used
    return eval(expression, names)  # pylint: disable=eval-used


class NotebookTest(RegraspCase):

    def test_all_cells_run(self):
        names, shown = {"__name__": "notebook"}, []
        folder = os.getcwd()
        self.addCleanup(os.chdir, folder)
        code = cells()
        os.chdir("docs")
        for cell in code:
            # The grasps are many; a share of them has the same code.
            shown.append(run(cell.replace("1_000_000", "20_000"), names))
        html = [value._repr_html_() if hasattr(value, "_repr_html_") else "" for value in shown]
        self.assertEqual(sum(isinstance(value, regrasp.Plan) for value in shown), 2)
        self.assertEqual([value.passed for value in shown if isinstance(value, regrasp.Report)], [True, True])
        self.assertEqual(len(names["rows"]), len(names["report"].steps))
        self.assertTrue(any("<th>kind</th>" in text for text in html))
        self.assertIn("not-force-closure", names["weak"].failure)
        self.assertEqual(len(names["wedge"].vertices), 6)
        # More friction, more force closure.
        self.assertEqual(names["shares"], sorted(names["shares"]))
        self.assertLess(names["shares"][0] + 0.1, names["shares"][-1])
        self.assertTrue(any(text.count("<rect ") == len(names["frictions"]) for text in html))

    def test_an_error_in_a_cell_is_found(self):
        with self.assertRaises(NameError):
            run("x = 1\nmissing + x", {})
        self.assertEqual(run("x = 1\nx + 1", {}), 2)
        self.assertIsNone(run("x = 1", {}))


if __name__ == "__main__":
    unittest.main()
