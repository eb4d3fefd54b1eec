"""The namespace of a source file is its folder's name.

usage: names_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
TOP_FOLDERS = ("planner", "sim", "render", "report", "apps")


def namespace_of(folders):
    """The namespace that belongs to a path of folders below the top."""
    # All replays share a namespace; validation, which calls them, has its own.
    if folders == ("sim", "validation"):
        return "regrasp::validation"
    if folders[0] != "planner":
        return f"regrasp::{folders[0]}"
    package = folders[-1] if folders[1] == "sets" else folders[1]
    return "regrasp" if package == "base" else f"regrasp::{package}"


def foreign_names(folders, text):
    """The namespaces that a file opens outside its own; a forward declaration is no opening."""
    own = namespace_of(folders)
    text = re.sub(r"namespace [\w:]+ \{\n((class|struct|enum class) \w+;[^\n]*\n)+\}", "", text)
    opened = re.findall(r"^namespace (regrasp[\w:]*) \{", text, re.MULTILINE)
    return [name for name in opened if name != own and not name.startswith(own + "::")]


def sources():
    for top in TOP_FOLDERS:
        for file in sorted((SOURCE / top).rglob("*")):
            if file.suffix in (".h", ".cc"):
                yield file.relative_to(SOURCE), file.read_text()


class Names(unittest.TestCase):
    def test_the_namespace_of_a_file_is_its_folder(self):
        looked_at, wrong = 0, {}
        for file, text in sources():
            looked_at += 1
            if foreign := foreign_names(file.parts[:-1], text):
                wrong[str(file)] = foreign
        self.assertGreater(looked_at, 500)
        self.assertEqual(wrong, {})

    def test_a_file_in_the_namespace_of_another_folder_is_found(self):
        text = "namespace regrasp::plan {\n}\nnamespace regrasp {\nnamespace {\n"
        self.assertEqual(foreign_names(("planner", "grasp"), text), ["regrasp::plan", "regrasp"])
        self.assertEqual(foreign_names(("sim", "validation"), "namespace regrasp::sim {\n}\n"),
                         ["regrasp::sim"])
        self.assertEqual(foreign_names(("sim", "scene"), "namespace regrasp::scene {\n"),
                         ["regrasp::scene"])

    def test_its_own_namespaces_and_what_it_declares_forward_pass(self):
        text = ("namespace regrasp::plan {\nclass Plan;\nenum class Reason;\n}\n"
                "namespace regrasp::motion::exact {\n")
        self.assertEqual(foreign_names(("planner", "motion"), text), [])
        for folders, own in ((("planner", "base"), "regrasp"), (("sim", "scene"), "regrasp::sim"),
                             (("planner", "sets"), "regrasp::sets"),
                             (("planner", "sets", "polygon"), "regrasp::polygon")):
            self.assertEqual(foreign_names(folders, f"namespace {own} {{\n"), [])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:])
