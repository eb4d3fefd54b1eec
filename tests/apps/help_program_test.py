"""Help on options in all programs: --help, manual page, completions, and mistyped options."""

import os
import re
import shlex
import shutil
import subprocess

import program_case
from program_case import ProgramCase

PROGRAMS = ("plan", "validate", "graph", "figure", "repair", "merge", "hand")

# Maximum length of the summary that shells show next to an option, on a terminal of 100 columns.
SUMMARY_LENGTH = 72


def options_in(text):
    """Return the options that --help lists: each begins a line, indented by two."""
    return re.findall(r"^  (--[a-z-]+)", text, re.MULTILINE)


def is_first_clause(summary, text):
    """Return True if the summary is the text up to a punctuation mark."""
    rest = text.removeprefix(summary)
    return rest != text and (not rest or rest == " (required)" or
                             re.match(r"[;:.] | \(default", rest) is not None)


class Help(ProgramCase):
    def help(self, program, **environment):
        return self.assert_done("--help", program=program,
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
            listed = re.findall(r"^- `(--[a-z-]+)", page, re.M)
            self.assertEqual(listed, options_in(self.help(program)))
            self.assertEqual(page, self.help_as("markdown", program),
                             f"command_{program}.md is out of date: run scripts/command-pages")
            self.assertTrue(page.startswith(f"# regrasp {program}\n"))
            # Negative controls: a missing option, and one that the program does not have.
            self.assertNotEqual(listed[1:], options_in(self.help(program)))
            self.assertNotEqual(["--gone", *listed], options_in(self.help(program)))

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
                self.assert_refused(2, f"unknown option {typed}; did you mean {right}? (", *words)
            self.assert_refused(2, "unknown option --frobnicate (", "--frobnicate")
            # The correct option is reported as missing, and not as unknown.
            self.assert_refused(2, f"{right} is required ({self.program} --help lists all)")

    def test_a_mistyped_word_is_told_with_the_one_that_was_meant(self):
        ends = ["--start", "random", "--goal", "random", "--output", "plan.json", "--mu", "0.3",
                "--object", self.model("cube.obj")]
        for program, words, more in (
                ("plan", "did you mean uniform?", ["--spanning", "unifrom", *ends]),
                ("plan", "did you mean margin?", ["--optimize", "marign", *ends]),
                ("plan", "did you mean roadmap?", ["--planner", "raodmap", *ends]),
                ("plan", "did you mean random?", [*ends[2:], "--start", "randm"]),
                ("graph", "did you mean adaptive?", ["--spanning", "adaptiv", *ends[6:]]),
                ("figure", "did you mean svg?",
                 ["--format", "sgv", "--plan", "plan.json", "--out", "figures", *ends[8:]]),
                ("validate", "did you mean slide?",
                 ["--align", "slid", "--plan", "plan.json", *ends[8:]])):
            self.program = program
            self.assert_refused(2, words, *more)

    def test_words_without_quotes_are_told_with_them(self):
        hand = ["--hand", "no.json", "--object", "no.obj", "--mu", "0.8", "--output", "plan.json"]
        for typed, right in ((["--turn", "z", "90"], '--turn "z 90"'),
                             (["--goal-pose", "0", "0", "-0.1", "1", "0", "0", "0"],
                              '--goal-pose "0 0 -0.1 1 0 0 0"')):
            self.program = "plan"
            self.assert_refused(2, f"{typed[0]}: its words are one argument, in quotes: {right}",
                                *hand[:2], *typed, *hand[2:])
            # In quotes the words are accepted; the next error is the file.
            self.assert_refused(2, "no.json: no such file", *hand, typed[0], " ".join(typed[1:]))

    def test_a_missing_value_is_told_and_not_taken_from_the_next_option(self):
        rest = ["--object", "no.obj", "--mu", "0.3", "--output", "plan.json"]
        self.program = "plan"
        for words in (["--start", *rest], [*rest, "--start"]):
            self.assert_refused(2, "--start: its value is missing: --start FILE|random", *words)
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
            head = re.match(r"""  (--[a-z-]+)(?: "[^"]*"| \S+)?(?:  +(.*))?$""", line)
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
        self.assertEqual(complete("plan", "--spann"), ["--spanning"])
        self.assertEqual(complete("plan", "--spanning", "u"), ["uniform"])
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
