"""Options of all programs: help texts, manual page, completions, lists, old names and mistyped ones."""

import os
import re
import shlex
import shutil
import subprocess

import program_case
from program_case import ProgramCase

PROGRAMS = ("plan", "validate", "graph", "figure", "repair", "merge", "evaluate", "hand")

# Longest summary of an option in a shell with 100 columns, and longest line of -h.
SUMMARY_LENGTH = 72
SHORT_LINE = 120


# Most options that `validate --help` lists, and that all programs have together.
MOST_OF_VALIDATE, MOST_OF_ALL = 44, 148


# An option in a list of a page.
LISTED = r"^- `(?:-[a-zA-Z], )?(--[a-z-]+)"

# The options that all programs have.
GENERAL = ("--help", "--help-all", "--quiet", "--version")


def options_in(text):
    """Return the options that a help text lists: each starts a line, indented by two."""
    text = re.sub(r"Usage:\n(?:  .*\n)+", "", text)
    return re.findall(r"^  (?:-[a-zA-Z], )?(--[a-z-]+)", text, re.MULTILINE)


def is_first_clause(summary, text):
    """Return True if the summary is the text up to a punctuation mark."""
    rest = text.removeprefix(summary)
    return rest != text and (not rest or rest == " (required)" or
                             re.match(r"[;:.](?: |$)| \[default", rest) is not None)


class Help(ProgramCase):
    def help(self, program, level="--help-all", **environment):
        return self.assert_done(level, program=program,
                                environment={"COLUMNS": None, **environment}).stdout

    def help_as(self, kind, program):
        return self.assert_done("--help-as", kind, program=program).stdout

    def test_help_has_every_option_in_a_group_and_fits_into_the_line(self):
        for program in PROGRAMS:
            texts = {width: self.help(program, COLUMNS=str(width)) for width in (60, 80, 100)}
            self.assertEqual(self.help(program), texts[80])
            for width, text in texts.items():
                lines = text.split("Examples:")[0].splitlines()
                longest = max(map(len, lines))
                self.assertLessEqual(longest, width, [line for line in lines if len(line) > width])
                self.assertGreater(longest, width - 20)
                self.assertEqual(options_in(text), options_in(texts[80]))
            self.assertIn("--quiet", options_in(texts[80]))
            self.assertRegex(texts[80], r"\nGeneral:\n")
            text = texts[80]
            self.assertEqual(text.split("Examples:\n")[1].count("  " + program + " --"), 2)

    def page(self, name):
        with open(os.path.join(program_case.ARGUMENTS.source, "docs", name + ".md"), encoding="utf-8") as file:
            return file.read()

    def test_each_command_has_a_page_that_lists_every_option_and_no_other(self):
        for program in PROGRAMS:
            page = self.page("command_" + program)
            listed = re.findall(LISTED, page, re.M)
            self.assertEqual(listed, options_in(self.help(program)))
            self.assertEqual(page, self.help_as("markdown", program),
                             f"command_{program}.md is out of date: run scripts/command-pages")
            self.assertTrue(page.startswith(f"# regrasp {program}\n"))
            # Negative controls: a missing option, and one that the program does not have.
            self.assertNotEqual(listed[1:], options_in(self.help(program)))
            self.assertNotIn("--gone", options_in(self.help(program)))

    def test_there_are_few_options(self):
        usual = options_in(self.help("validate", "--help"))
        self.assertLessEqual(len(usual), MOST_OF_VALIDATE)
        self.assertGreater(len(options_in(self.help("validate"))), len(usual))
        # The options of all programs, such as --help, count once.
        listed = [option for program in PROGRAMS for option in re.findall(LISTED, self.page("command_" + program), re.M)
                  if option not in GENERAL]
        self.assertLessEqual(len(listed) + len(GENERAL) + len(re.findall(
            LISTED, self.page("command_convert"), re.M)), MOST_OF_ALL)

    def test_the_short_help_has_one_line_per_option(self):
        for program in PROGRAMS:
            text = self.help(program, "-h")
            self.assertEqual(options_in(text), options_in(self.help(program, "--help")))
            self.assertNotIn("Examples:", text)
            lines = text.split("\n\n", 2)[2].splitlines()
            names = [line for line in lines if re.match("  -", line)]
            self.assertEqual(len(names), len(options_in(text)))
            for line in lines:
                self.assertTrue(not line or re.match(r"  -|[A-Z]|--help-all also|options", line),
                                line)
                self.assertLessEqual(len(line), SHORT_LINE, line)

    def test_short_names_are_those_of_long_ones(self):
        self.assertEqual(self.assert_done("-V", program="plan").stdout,
                         self.assert_done("--version", program="plan").stdout)
        ends = ["--object", self.model("cube.obj"), "--start", "random", "--goal", "random", "--mu",
                "0.5", "-o", "plan.json"]
        self.assertEqual(self.assert_done("-q", *ends, program="plan").stderr, "")
        self.assertTrue(os.path.exists(self.path("plan.json")))
        for jobs in (["-j", "2"], ["-j2"]):
            self.assert_refused(2, "--jobs requires --batch or --hand", *ends, *jobs, program="plan")
        self.assert_refused(2, "unknown option -x (", *ends, "-x", program="plan")

    def test_the_page_of_commands_links_to_all_of_them(self):
        page = self.page("commands")
        self.assertEqual(page, self.help_as("markdown", "regrasp"),
                         "commands.md is out of date: run scripts/command-pages")
        # regrasp-convert is a Python program, tested in tests/python.
        self.assertEqual(re.findall(r"\]\(command_(\w+)\.md\)", page), [*PROGRAMS, "convert"])
        pages = os.listdir(os.path.join(program_case.ARGUMENTS.source, "docs"))
        self.assertEqual(sorted(name[8:-3] for name in pages if name.startswith("command_")),
                         sorted([*PROGRAMS, "convert"]))

    def test_a_mistyped_option_is_told_before_a_missing_one(self):
        for self.program in PROGRAMS:
            right = {"hand": "--model", "merge": "--shards"}.get(self.program, "--object")
            wrong = right[:-2] + right[-1]
            for typed, words in ((wrong, [wrong, "x"]), (wrong, [wrong + "=x"]),
                                 (right[1:], [right[1:], "x"])):
                self.assert_refused(2, f"unknown option {typed}; similar: {right} (", *words)
            self.assert_refused(2, "unknown option --frobnicate (", "--frobnicate")
            # The correct option is reported as missing, and not as unknown.
            missing = "--grasps" if self.program == "evaluate" else right
            self.assert_refused(2, f"{missing} is required ({self.program} --help lists all)")

    def test_a_mistyped_word_is_told_with_the_one_that_was_meant(self):
        ends = ["--start", "random", "--goal", "random", "--output", "plan.json", "--mu", "0.3",
                "--object", self.model("cube.obj")]
        for program, words, more in (
                ("plan", "similar: uniform", ["--planner", "spanning=unifrom", *ends]),
                ("plan", "similar: margin", ["--optimize", "marign", *ends]),
                ("plan", "similar: roadmap", ["--planner", "raodmap", *ends]),
                ("plan", "similar: random", [*ends[2:], "--start", "randm"]),
                ("graph", "similar: adaptive", ["--planner", "spanning=adaptiv", *ends[6:]]),
                ("figure", "similar: svg",
                 ["--format", "sgv", "--plan", "plan.json", "--output", "figures", *ends[8:]]),
                ("validate", "similar: slide",
                 ["--replay", "align=slid", "--plan", "plan.json", *ends[8:]])):
            self.program = program
            self.assert_refused(2, words, *more)

    def test_words_instead_of_a_list_are_told_with_it(self):
        hand = ["--hand", "no.json", "--object", "no.obj", "--mu", "0.8", "--output", "plan.json"]
        for typed, right in ((["--turn", "z", "90"], "--turn z,90"),
                             (["--goal-pose", "0", "0", "-0.1", "1", "0", "0", "0"],
                              "--goal-pose 0,0,-0.1,1,0,0,0")):
            self.program = "plan"
            self.assert_refused(2, f"{typed[0]}: expected one list with commas, found "
                                f"{len(typed) - 1} words; help: {right}", *hand[:2], *typed, *hand[2:])
            # With commas, and with spaces in quotes, it is accepted: the file is not found.
            for separator in ",", " ":
                self.assert_refused(2, "no.json: no such file", *hand, typed[0],
                                    separator.join(typed[1:]))

    def test_settings_of_lists_are_checked(self):
        """The message starts with the option's name and states the error in its list."""
        rest = ["--object", "no.obj", "--mu", "0.3"]
        plan = [*rest, "--start", "random", "--goal", "random", "--output", "plan.json"]
        validate = [*rest, "--plan", "no.json"]
        for self.program, more, option, value, words in (
                ("plan", plan, "--planner", "roadmap,cluster=9", ': unknown setting "cluster", expected '
                 "one of spanning=, points=, clusters=, fallback=, budget=; similar: clusters="),
                ("plan", plan, "--planner", "roadmap,clusters=9,clusters=9", " clusters: found twice"),
                ("plan", plan, "--planner", "roadmap,general", ': expected one of spanning='),
                ("plan", plan, "--planner", "roadmap,", ': expected one of spanning='),
                ("plan", plan, "--repair", "part=0", " part: expected an integer from 1"),
                ("plan", plan, "--allow", "fill", ': expected one of filled, large-graph, found "fill"; '
                 "similar: filled"),
                ("validate", validate, "--view", "30", ': expected AZIMUTH,ELEVATION, as in 30,20'),
                ("validate", validate, "--view", "30,20,10", ': expected one of orthographic, zoom='),
                ("validate", validate, "--tolerance", "2cm", ": expected a number, or one with the unit"),
                ("validate", validate, "--tolerance", "2mm,3mm", ": found two tolerances of one kind"),
                ("validate", validate, "--replay", "points,hand", ": found points and hand"),
                ("validate", validate, "--trials", "min-pass-rate=1", ": the number of trials is required"),
                ("figure", ["--object", "no.obj", "--plan", "no.json", "-o", "out"], "--size", "85",
                 ': expected one of width=, sheet=, font=, family=, captions=, found "85"')):
            self.assert_refused(2, f"error: {option}{words}", *more, option, value)
            # Negative control: the rest of the command line is right.
            self.assert_refused(2, ("no.obj", "no.json")[self.program != "plan"], *more)

    def old_names(self):
        """The renamed options in apps/renamed_options.cc: programs, old and new name, new value."""
        path = os.path.join(program_case.ARGUMENTS.source, "apps", "renamed_options.cc")
        with open(path, encoding="utf-8") as file:
            table = file.read()
        named = {name: value for name, value in re.findall(r'char (k\w+)\[\] = "([^"]*)"', table)}
        rows = re.findall(r'^    \{(\w+|"[^"]*"), "(--[^"]+)", "(--[^"]+)", "([^"]*)"\},$', table, re.M)
        return [(program, old, new, value) for programs, old, new, value in rows
                for program in named.get(programs, programs.strip('"')).split()]

    def test_every_old_name_is_accepted_unlisted(self):
        """A command with an old name and one with the new name end with the same error, of a file
        that does not exist."""
        usual = {"plan": ["--object", "no.obj", "--mu", "0.3", "--start", "random", "--goal", "random",
                          "--output", "plan.json"],
                 "graph": ["--object", "no.obj", "--mu", "0.3"],
                 "validate": ["--object", "no.obj", "--plan", "no.json"],
                 "figure": ["--object", "no.obj", "--plan", "no.json", "--output", "out"],
                 "repair": ["--object", "no.obj", "--output", "out.obj"],
                 "merge": ["--shards", "no.jsonl", "--output", "out.jsonl"]}
        # Other required options, and values other than 5.
        states = ["--object", "no.obj", "--mu", "0.3", "--hand", "no.json", "--export-states", "2"]
        grasps = ["--object", "no.obj", "--mu", "0.3", "--grasps", "no.npz"]
        by_hand = [*usual["validate"], "--hand", "no.json"]
        other = {"--required-angle": grasps, "--quality": grasps, "--min-quality": states,
                 "--tip": by_hand, "--tolerance-mm": by_hand,
                 "--tolerance-deg": by_hand, "--joint-noise": [*by_hand, "--trials", "2"],
                 "--reserve": [*usual["plan"][:4], "--output", "plan.json", "--hand", "no.json",
                               "--turn", "z,90"],
                 "--animate-size": [*usual["validate"], "--frames", "animation"]}
        values = {"--spanning": "uniform", "--align": "slide",
                  "--tip": "geometry", "--animate-size": "64x64", "--reserve": "none",
                  "--out": "out", "--min-pass-rate": "0.5", "--min-quality": "0.5",
                  "--sheet-width": "500", "--width": "85"}
        for name in ("--position-noise", "--friction-error", "--mass-error"):
            other[name], values[name] = [*usual["validate"], "--trials", "2"], "0.5"
        other["--noise"], values["--noise"] = [*usual["validate"], "--trials", "2"], "mass=0.1"
        other["--min-pass-rate"] = [*usual["validate"], "--trials", "2"]
        flags = ("--fresh",)
        rows = self.old_names()
        self.assertGreater(len(rows), 50)
        for program, old, new, item in rows:
            rest = other.get(old, usual[program])
            if old == "--out":
                rest = [word for word in rest if word not in ("--output", "out")]
            if old == "--fresh" and program != "merge":
                rest = {"plan": [*rest, "--batch", "no.jsonl"],
                        "validate": [*rest, "no_2.json"]}[program]
            if old == "--compare":
                rest = [*rest, "--planner", "sampling=9"]
            if old == "--queries":
                rest = [*rest, "--planner", "clusters=9"]
            if (program, old) == ("graph", "--no-lazy"):
                rest = [*rest, "--planner", "queries=9"]
            value = values.get(old, "5")
            took = [value] if "*" in item or (not item and old not in flags) else []
            now = [new, item.replace("*", value)] if item else [new, *took]
            with self.subTest(program=program, old=old):
                expected = self.run_program(*rest, *now, program=program)
                self.assertEqual(expected.returncode, 2, expected.stderr)
                self.assertRegex(expected.stderr, r"\bno(_2)?\.(obj|json|jsonl|npz)")
                self.assertNotIn("unknown", expected.stderr)
                for words in ([old, *took], *([[f"{old}={value}"]] if took else [])):
                    done = self.run_program(*rest, *words, program=program)
                    self.assertEqual(done.returncode, 2)
                    # Results of several plans are printed in the order in which they end.
                    self.assertEqual(sorted(done.stderr.split("\n")), sorted(expected.stderr.split("\n")))
                listed = options_in(self.help(program))
                self.assertIn(new, listed)
                self.assertNotIn(old, listed)

    def test_an_old_name_is_noted_once_it_has_worked(self):
        words = ["--object", self.model("cube.obj"), "--start", "random", "--goal", "random", "--mu",
                 "0.5", "--output", "plan.json"]
        self.program = "plan"
        notes = [line for line in self.assert_done(*words, "--planner", "roadmap", "--contacts", "20",
                                                   "--contact", "hard").stderr.splitlines()
                 if "note:" in line]
        self.assertEqual(notes, ["plan: note: --contacts 20 is now --planner points=20",
                                 "plan: note: --contact hard is now --torsion 0"])
        first = self.read("plan.json")
        now = ["--planner", "roadmap,points=20", "--torsion", "0"]
        self.assertNotIn("note:", self.assert_done(*words, *now).stderr)
        self.assertEqual(self.read("plan.json"), first)
        self.assertEqual(self.assert_done(*words, "--planner", "roadmap", "--contacts", "20",
                                          "--quiet").stderr, "")

    def test_a_missing_value_is_told_and_not_taken_from_the_next_option(self):
        rest = ["--object", "no.obj", "--mu", "0.3", "--output", "plan.json"]
        self.program = "plan"
        for words in (["--start", *rest], [*rest, "--start"]):
            self.assert_refused(2, "--start: requires a value, as in --start FILE|random", *words)
        # A word that only begins like an option is a value.
        self.assert_refused(2, "found \"-1\"", *rest[:2], "--mu", "-1", *rest[4:])

    def test_completions_have_every_option(self):
        for program in PROGRAMS:
            options = options_in(self.help(program))
            self.assertGreater(len(options), 5)
            for kind in ("bash", "zsh", "fish"):
                text = self.help_as(kind, program)
                for option in options:
                    word = "-l " + option[2:] + " " if kind == "fish" else option
                    self.assertIn(word, text, kind)

    def texts(self, program):
        """Return the text of --help for each option, on one line."""
        texts, option = {}, None
        for line in self.help(program, COLUMNS="120").split("Examples:")[0].splitlines():
            head = re.match(r"""  (?:-[a-zA-Z], )?(--[a-z-]+)(?: \S+)?(?:  +(.*))?$""", line)
            if head:
                option = head[1]
                texts[option] = head[2] or ""
            elif line.startswith(" " * 26):
                texts[option] = (texts[option] + " " + line.strip()).strip()
        return texts

    def test_shells_show_the_first_clause_of_an_options_text_whole_and_in_a_line(self):
        self.assertFalse(is_first_clause("Write time", "Write time (s) and place (m); as CSV"))
        self.assertFalse(is_first_clause("The sheet overview", "The sheet overview.png, pixels"))
        self.assertFalse(is_first_clause("The plans grasp", "The plan's grasp"))
        for program in PROGRAMS:
            texts = self.texts(program)
            zsh = {word.split("[")[0]: word[word.index("[") + 1:word.rindex("]")]
                   for word in shlex.split(self.help_as("zsh", program).split("_arguments")[1])
                   if word.startswith("--")}
            # fish writes a quote within quotes as \', a POSIX shell as '\''.
            lines = self.help_as("fish", program).replace("\\'", "'\\''").splitlines()
            fish = {"--" + words[words.index("-l") + 1]: words[words.index("-d") + 1]
                    for words in map(shlex.split, lines)}
            self.assertEqual(zsh, fish)
            self.assertEqual(sorted(zsh), sorted(texts))
            for option, summary in zsh.items():
                self.assertTrue(is_first_clause(summary, texts[option]), (summary, texts[option]))
                self.assertLessEqual(len(summary), SUMMARY_LENGTH, summary)

    def test_fish_is_never_told_to_complete_files_and_not_to(self):
        offered = 0
        for program in PROGRAMS:
            for line in self.help_as("fish", program).splitlines():
                words = line.split(" -d ")[0].split()
                self.assertEqual(("-f" in words) + ("-F" in words), 1, line)
                offered += "-F" in words
        self.assertGreater(offered, len(PROGRAMS))

    def test_bash_completes_options_and_their_words(self):
        def complete(program, *words):
            script = self.help_as("bash", program) + (
                f"COMP_WORDS=({' '.join((program, *words))}); COMP_CWORD={len(words)}\n"
                f"_regrasp_{program}\nprintf '%s\\n' \"${{COMPREPLY[@]}}\"\n")
            done = subprocess.run(["bash", "-c", script], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, cwd=self.folder, check=True)
            self.assertEqual(done.stderr, "")
            return done.stdout.split()
        self.write("some plan.json", "")
        self.assertEqual(complete("plan", "--optim"), ["--optimize"])
        self.assertEqual(complete("plan", "--optimize", "m"), ["margin"])
        self.assertEqual(complete("validate", "--plan", "so"), ["some", "plan.json"])
        self.assertEqual(complete("validate", "--mass", ""), [])

    def test_the_manual_page_is_rendered_without_a_warning_and_has_every_option(self):
        self.assertIsNotNone(shutil.which("groff"), "groff is not installed: run scripts/setup --test")
        for program in PROGRAMS:
            page = self.help_as("man", program)
            done = subprocess.run(["groff", "-ww", "-man", "-Tutf8", "-P-cbou"], input=page,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  check=True)
            self.assertEqual(done.stderr, "")
            for option in options_in(self.help(program)):
                self.assertRegex(done.stdout, r"(?m)^ +" + option + r"\b")
            self.assertIn("EXIT STATUS", done.stdout)
        # Characters beyond ASCII are preserved.
        self.assertIn("kg/m^3", self.help_as("man", "validate"))

    def test_another_kind_of_help_is_bad_usage(self):
        for self.program in PROGRAMS:
            self.assert_refused(2, "man, bash, zsh, fish or markdown", "--help-as", "html")

    def test_errors_and_warnings_have_colour_on_a_terminal_alone(self):
        self.program = "plan"
        red = "\x1b[31m"
        self.assertIn(red, self.run_on_terminal("--objct")[1])
        self.assertNotIn(red, self.run_on_terminal("--objct", environment={"NO_COLOR": "1"})[1])
        self.assertNotIn(red, self.run_on_terminal("--objct", environment={"TERM": "dumb"})[1])
        self.assertNotIn("\x1b", self.run_program("--objct").stderr)


if __name__ == "__main__":
    program_case.main()
