"""docs/python_api.md is what scripts/python-reference writes, and each public name is on it.

usage: python_reference_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1])


def reference(folder):
    """Return the page that the script of a folder writes."""
    return subprocess.run([sys.executable, folder / "scripts" / "python-reference"], capture_output=True, text=True,
                          check=True).stdout


class PythonReference(unittest.TestCase):
    def test_the_page_is_up_to_date(self):
        self.assertEqual((SOURCE / "docs" / "python_api.md").read_text(encoding="utf-8"), reference(SOURCE),
                         "run scripts/python-reference > docs/python_api.md")

    def test_each_public_name_has_a_section(self):
        package = (SOURCE / "python" / "regrasp" / "__init__.py").read_text(encoding="utf-8")
        names = re.findall(r'^    "(\w+)",$', package, re.MULTILINE)
        self.assertGreater(len(names), 8)
        page = reference(SOURCE)
        missing = [name for name in names if f"\n## {name}\n" not in page]
        self.assertEqual(missing, ["InputError"])  # a class of the extension module; the first section explains it

    def test_a_changed_docstring_changes_the_page(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            shutil.copytree(SOURCE / "python" / "regrasp", folder / "python" / "regrasp")
            (folder / "scripts").mkdir()
            shutil.copy(SOURCE / "scripts" / "python-reference", folder / "scripts")
            self.assertEqual(reference(folder), reference(SOURCE))
            plans = folder / "python" / "regrasp" / "plans.py"
            plans.write_text(plans.read_text(encoding="utf-8").replace("Read a plan file.", "Read a file."),
                             encoding="utf-8")
            self.assertNotEqual(reference(folder), reference(SOURCE))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
