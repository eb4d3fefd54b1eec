"""The namespace of a source file is its folder's name, and each type has one definition.

Two types of the same name in different files would make a program whose behaviour is undefined (the one-definition
rule), and neither compiler nor linker reports them. `scripts/check-names` compares also types that macros define, by
a link of all programs at once.

usage: names_test.py SOURCE_FOLDER [unittest's own arguments]
"""

import collections
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv[1])
TOP_FOLDERS = ("planner", "sim", "render", "report", "apps")
ALL_FOLDERS = TOP_FOLDERS + ("python", "bench", "tests", "examples")


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
    """The namespaces that a file opens outside its own; a forward declaration does not count."""
    own = namespace_of(folders)
    text = re.sub(r"namespace [\w:]+ \{\n((class|struct|enum class) \w+;[^\n]*\n)+\}", "", text)
    opened = re.findall(r"^namespace (regrasp[\w:]*) \{", text, re.MULTILINE)
    return [name for name in opened if name != own and not name.startswith(own + "::")]


def types_in(text):
    """The types that a formatted source defines in namespaces, with their full names; not those of unnamed namespaces."""
    found, scopes = [], []
    for line in text.split("\n"):
        if opening := re.match(r"(?:inline )?namespace ?([\w:]*) ?\{$", line):
            scopes.append(opening.group(1))
        elif line.startswith("}  // namespace"):
            scopes.pop()
        elif "" not in scopes and (definition := re.match(
                r"(?:template <.*> )?(?:struct|class|union|enum class|enum) (?:alignas\(.*?\) )?(\w+)(?: final)?"
                r"(?: :(?!:) [^;{]*(?:\{.*)?| \{.*|)$", line)):
            found.append("::".join([*scopes, definition.group(1)]))
    return found


def sources(folders=TOP_FOLDERS):
    for top in folders:
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

    def test_each_type_has_one_definition(self):
        files = collections.defaultdict(list)
        for file, text in sources(ALL_FOLDERS):
            for name in types_in(text):
                files[name].append(str(file))
        self.assertGreater(len(files), 500)
        self.assertEqual({name: where for name, where in files.items() if len(where) > 1}, {})

    def test_types_are_found_with_their_full_names(self):
        text = "\n".join([
            "namespace regrasp::plan {", "class Plan;", "struct Step {", "  struct Inner {", "  };", "};",
            "namespace {", "struct Hidden {", "};", "}  // namespace", "namespace detail {",
            "template <typename T> class Of final : public Base<T> {", "};", "}  // namespace detail",
            "enum class Kind : char { kA };", "struct Outer::Impl {", "};", "struct Empty {};", "template <>",
            "struct Hash<Step> {", "};", "class Long", "    : public Base {", "};", "}  // namespace regrasp::plan"])
        self.assertEqual(types_in(text), ["regrasp::plan::Step", "regrasp::plan::detail::Of", "regrasp::plan::Kind",
                                          "regrasp::plan::Empty", "regrasp::plan::Long"])

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
