"""Lists of mutants in tests/mutants/*.toml, and the table of their results, for scripts/mutate.

A list has an array `mutant` of tables with

  name    unique; words joined by hyphens
  file    changed file, relative to the project's folder
  what    one sentence that describes the defect
  old     text that occurs once in the file; literal strings ('…', or '''…''' for lines) need no escapes
  new     replacement of this text
  tests   tests that should fail: "FOLDER NAMES", the folder of a test program below tests/ and a filter
          of GoogleTest without "-", or "FOLDER/SCRIPT.py CLASS.TEST" of a program's test
  hangs   (optional) true: a test that exceeds the time limit has caught the mutant
  reason  (optional) reason why no test can distinguish it from the original code
"""

import dataclasses
import fnmatch
import pathlib
import re
import tomllib

TEST = re.compile(r"^TEST(?:_F)?\(\s*(\w+),\s*(\w+)\s*\)", re.MULTILINE)
HEAD = "| mutant | file | defect | caught by |"
SURVIVES = "survives: "


class ListError(Exception):
    """Outdated or malformed list; the message names file and mutant."""


@dataclasses.dataclass(frozen=True)
class Mutant:
    name: str
    file: str
    what: str
    old: str
    new: str
    tests: tuple
    hangs: bool = False
    reason: str = ""


def read_list(path):
    """Return the mutants of one list."""
    fields = {field.name: field for field in dataclasses.fields(Mutant)}
    required = [name for name, field in fields.items() if field.default is dataclasses.MISSING]
    try:
        entries = tomllib.loads(path.read_text(encoding="utf-8"))["mutant"]
    except (tomllib.TOMLDecodeError, KeyError) as error:
        raise ListError(f"{path}: no list of mutants: {error}") from None
    mutants = []
    for entry in entries:
        name = f"{path}: {entry.get('name', 'a mutant without name')}"
        if missing := [field for field in required if not entry.get(field) and field != "new"]:
            raise ListError(f"{name}: lacks {', '.join(missing)}")
        if unknown := [field for field in entry if field not in fields]:
            raise ListError(f"{name}: unknown: {', '.join(unknown)}")
        mutants.append(Mutant(**{"new": "", **entry, "tests": tuple(entry["tests"])}))
    return mutants


def read_lists(folder):
    """Return the mutants of a folder by list name, in the order of names."""
    lists = {path.stem: read_list(path) for path in sorted(pathlib.Path(folder).glob("*.toml"))}
    names = [mutant.name for mutants in lists.values() for mutant in mutants]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise ListError(f"{folder}: more than one mutant is called {', '.join(twice)}")
    if not names:
        raise ListError(f"{folder}: no mutants")
    return lists


def mutated(mutant, text):
    """Return the file's text with the defect."""
    found = text.count(mutant.old)
    if found != 1:
        raise ListError(f"{mutant.name}: its old text stands {found} times in {mutant.file}, not once")
    if mutant.old == mutant.new:
        raise ListError(f"{mutant.name}: its new text is the old one")
    return text.replace(mutant.old, mutant.new)


def split_test(test):
    """Return the folder or script of a test, and the names."""
    place, _, names = test.partition(" ")
    return place, names


def check_tests(mutant, source):
    """Check that the named tests exist in the sources."""
    for test in mutant.tests:
        place, names = split_test(test)
        path = source / "tests" / place
        if place.endswith(".py"):
            text = path.read_text(encoding="utf-8") if path.is_file() else ""
            parts = names.split(".")
            found = bool(names) and all(re.search(rf"^ *(class|def) {part}\b", text, re.MULTILINE)
                                        for part in parts)
            missing = [] if found else [names]
        else:
            known = [".".join(match) for file in sorted(path.glob("*.cc"))
                     for match in TEST.findall(file.read_text(encoding="utf-8"))]
            missing = [name for name in names.split(":") if not fnmatch.filter(known, name)]
        if missing:
            raise ListError(f"{mutant.name}: {place} has no test {', '.join(missing)}")


def check(mutant, source):
    """Check that a mutant applies to the sources and that its tests exist."""
    path = source / mutant.file
    if not path.is_file():
        raise ListError(f"{mutant.name}: there is no file {mutant.file}")
    mutated(mutant, path.read_text(encoding="utf-8"))
    check_tests(mutant, source)


def read_table(text):
    """Return the results of mutants in a table, by name."""
    rows = [line.strip("| ").split(" | ") for line in text.splitlines() if line.startswith("| ")]
    return {row[0]: row[3] for row in rows if len(row) == 4 and row[0] not in ("mutant", "---")}


def format_table(lists, became):
    """Return the table of all mutants, with a section for each list; `became` has the results by
    name."""
    text = ("Small defects of our own code, by `scripts/mutate`: each is made by itself in a copy of the\n"
            "sources, and a test has to fail. The lists with the exact changes are `tests/mutants/*.toml`.\n\n")
    said = [became.get(mutant.name, "not run") for mutants in lists.values() for mutant in mutants]
    survivors = sum(one.startswith(SURVIVES) for one in said)
    not_run = said.count("not run")
    caught = len(said) - survivors - not_run
    text += f"{len(said)} mutants: {caught} caught, {survivors} survive with a reason"
    text += f", {not_run} not run.\n" if not_run else ".\n"
    for title, mutants in lists.items():
        text += f"\n## {title.capitalize()}\n\n{HEAD}\n| --- | --- | --- | --- |\n"
        for mutant in mutants:
            outcome = became.get(mutant.name, "not run")
            cells = [mutant.name, f"`{mutant.file}`", mutant.what, outcome]
            text += "| " + " | ".join(cells) + " |\n"
    return text
