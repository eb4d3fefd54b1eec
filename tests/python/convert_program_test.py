"""The program regrasp-convert: help, manual page, completions, and one-line error messages."""

import contextlib
import io
import os
import re
import subprocess
import sys
import unittest

import regrasp
from regrasp import convert
from isaac_text import ISAAC
from regrasp_case import RegraspCase

PROGRAM = os.path.join(os.path.dirname(os.path.dirname(regrasp.__file__)), "regrasp-convert")
OPTIONS = [action.option_strings[-1] for action in convert.parser()._actions
           if action.option_strings and action.dest != "help_as"]


def run(*arguments, code=0):
    done = subprocess.run([sys.executable, PROGRAM, *arguments], capture_output=True, text=True,
                          check=False)
    if done.returncode != code:
        raise AssertionError(f"{done.returncode}: {done.stderr}")
    return done


class ConvertProgramTest(RegraspCase):

    def test_every_text_has_every_option(self):
        self.assertGreater(len(OPTIONS), 10)
        for kind, written in [("man", lambda name: ".B " + name.replace("-", "\\-")),
                              ("bash", str), ("zsh", lambda name: f"'{name}["),
                              ("fish", lambda name: f" -l {name[2:]} "), ("markdown", lambda n: f"- `{n}")]:
            text = run("--help-as", kind).stdout
            for name in OPTIONS:
                self.assertIn(written(name), text, kind)
            self.assertNotIn("help-as", text)
        self.assertIn("regrasp-convert", run("--help").stdout)

    def test_man_finds_no_fault_and_bash_completes(self):
        page = run("--help-as", "man").stdout
        done = subprocess.run(["groff", "-man", "-Tutf8", "-ww"], input=page, capture_output=True,
                              text=True, check=True)
        self.assertEqual(done.stderr, "")
        self.assertIn("--mesh-scale", re.sub("\x1b\\[[0-9;]*m|.\b", "", done.stdout))
        with open(self.path("completion"), "w", encoding="utf-8") as file:
            file.write(run("--help-as", "bash").stdout)
        with open(self.path("a.yaml"), "w", encoding="utf-8"):
            pass

        def complete(*words):
            quoted = " ".join(f"'{word}'" for word in words)
            script = (f"source completion; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; "
                      "_regrasp_convert; printf '%s\\n' \"${COMPREPLY[@]}\"")
            return subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True,
                                  text=True, check=True).stdout.split()
        self.assertEqual(complete("regrasp-convert", "--mes"), ["--mesh-scale"])
        self.assertEqual(complete("regrasp-convert", "a."), ["a.yaml"])
        self.assertEqual(complete("regrasp-convert", "--hand", "a"), ["a.yaml"])
        self.assertEqual(complete("regrasp-convert", "--mu", "a"), [])

    def test_the_documents_have_its_options(self):
        with open("docs/command_convert.md", encoding="utf-8") as file:
            page = file.read()
        self.assertEqual(run("--help-as", "markdown").stdout, page,
                         "command_convert.md is out of date: run scripts/command-pages")

    def test_bad_usage_is_one_line(self):
        for arguments, words in [((), ["required"]), (("a.yaml", "--output"), ["--output"]),
                                 (("a.yaml", "--outptu", "b.yaml"), ["--output"]),
                                 (("--help-as", "html"), ["man", "markdown", "html"]),
                                 (("a.yaml", "--output", "b.yaml", "--mu", "x"), ["--mu", "'x'"])]:
            said = run(*arguments, code=2).stderr
            self.assertEqual(said.count("\n"), 1, said)
            self.assertTrue(said.startswith("regrasp-convert: error: "))
            for word in words:
                self.assertIn(word, said)

    def test_files_are_written_as_a_whole_and_never_over_an_input(self):
        path, linked = self.path("a.yaml"), self.path("link.yaml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(ISAAC)
        os.symlink(path, linked)

        def said(output, code):
            with contextlib.redirect_stderr(io.StringIO()) as stderr:
                self.assertEqual(convert.main([path, "--output", output]), code)
            return stderr.getvalue()
        for output in (path, linked):
            self.assertIn("must not be an input", said(output, 2))
        with open(path, encoding="utf-8") as file:
            self.assertEqual(file.read(), ISAAC)
        self.assertIn("none", said(self.path("none/b.yaml"), 3))
        said(self.path("b.yaml"), 0)
        os.chmod(self.path("b.yaml"), 0o600)
        said(self.path("b.yaml"), 0)
        self.assertEqual(os.stat(self.path("b.yaml")).st_mode & 0o777, 0o600)
        self.assertEqual(sorted(os.listdir(self.folder)), ["a.yaml", "b.yaml", "link.yaml"])


if __name__ == "__main__":
    unittest.main()
