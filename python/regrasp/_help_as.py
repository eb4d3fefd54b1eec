"""Manual page, shell completions and Markdown help of regrasp-convert, generated from its parser.

The output has the form of the other programs' output.
"""

from __future__ import annotations

import argparse
import re

from ._regrasp import InputError, version

# Options of all programs, which the page lists once.
_GENERAL = ("--help", "--version")

KINDS = ["man", "bash", "zsh", "fish", "markdown"]


def help_as(parser: argparse.ArgumentParser, kind: str) -> str:
    """Return the help in one of the formats of `KINDS`.

    Raises:
        InputError: If there is no such format.
    """
    if kind not in KINDS:
        raise InputError(f"--help-as must be {', '.join(KINDS[:-1])} or {KINDS[-1]}, found \"{kind}\"")
    return {"man": _man, "bash": _bash, "zsh": _zsh, "fish": _fish, "markdown": _markdown}[kind](parser)


def _options(parser) -> list[tuple[str, str, str, bool]]:
    """Return name, value name (empty: no value), help text and required flag of each option."""
    found = []
    for action in parser._actions:
        if not action.option_strings or action.help == argparse.SUPPRESS:
            continue
        value = "" if action.nargs == 0 else action.metavar or "|".join(action.choices)
        found.append((action.option_strings[-1], value, action.help, action.required))
    return found


def _first_clause(text: str) -> str:
    return re.split(r"[;:.]( |$)", text)[0]


def _usage(parser) -> str:
    required = " ".join(f"{name} {value}" for name, value, _, needed in _options(parser) if needed)
    return f"{parser.prog} INPUT… {required} [options]"


def _man(parser) -> str:
    def escaped(text):
        text = text.replace("\\", "\\e").replace("-", "\\-").replace("…", "...")
        return "\\&" + text if text.startswith((".", "'")) else text  # prevents a macro
    lines = [f'.TH {parser.prog.upper()} 1 "" "regrasp {version}" "regrasp"', ".SH NAME",
             f"{parser.prog} \\- {escaped(parser.description)}", ".SH SYNOPSIS",
             escaped(_usage(parser)), ".SH DESCRIPTION", escaped(" ".join(parser.epilog.split())),
             ".SH OPTIONS"]
    for name, value, text, needed in _options(parser):
        called = f" \\fI{escaped(value)}\\fR" if value else ""
        lines += [".TP", f".B {escaped(name)}{called}",
                  escaped(text) + (" (required)" if needed else "")]
    lines += [".SH EXIT STATUS"]
    for code, meaning in [(0, "success"), (2, "bad usage or bad input: one line with the file, the "
                                              "element and the problem"), (3, "error of the environment")]:
        lines += [".TP", f".B {code}", meaning]
    return "\n".join(lines) + "\n"


def _bash(parser) -> str:
    options = _options(parser)
    files = "|".join(name for name, value, *_ in options if value == "FILE")
    others = "|".join(name for name, value, *_ in options if value and value != "FILE")
    names = " ".join(name for name, *_ in options)
    return f"""# bash completion of {parser.prog}
_regrasp_convert() {{
  local word=${{COMP_WORDS[COMP_CWORD]}}
  case ${{COMP_WORDS[COMP_CWORD-1]}} in
    {files}) mapfile -t COMPREPLY < <(compgen -f -- "$word"); return ;;
    {others}) return ;;
  esac
  case $word in
    -*) mapfile -t COMPREPLY < <(compgen -W '{names}' -- "$word") ;;
    *) mapfile -t COMPREPLY < <(compgen -f -- "$word") ;;
  esac
}}
complete -o filenames -F _regrasp_convert {parser.prog}
"""


def _zsh(parser) -> str:
    lines = [f"#compdef {parser.prog}", "_arguments \\"]
    for name, value, text, _ in _options(parser):
        said = _first_clause(text).replace("'", "'\\''").replace("[", "\\[").replace("]", "\\]")
        after = f":{name[2:]}:" + ("_files" if value == "FILE" else "") if value else ""
        lines.append(f"  '{name}[{said}]{after}' \\")
    return "\n".join([*lines, "  '*:input:_files'"]) + "\n"


def _fish(parser) -> str:
    lines = []
    for name, value, text, _ in _options(parser):
        said = _first_clause(text).replace("\\", "\\\\").replace("'", "\\'")
        lines.append(f"complete -c {parser.prog} {'-F' if value == 'FILE' else '-f'} -l {name[2:]} "
                     + ("-r " if value else "") + f"-d '{said}'")
    return "\n".join(lines) + "\n"


def _markdown(parser) -> str:
    lines = [f"# {parser.prog}", "", f"This page is the reference of `{parser.prog}`. `{parser.prog} --help` prints "
             "the same text. [Exit codes](exit_codes.md) are those of all commands.", "",
             parser.description + " " + " ".join(parser.epilog.split()), "", "```", _usage(parser), "```", "",
             "## Options", ""]
    for name, value, text, needed in _options(parser):
        if name in _GENERAL:
            continue
        lines.append(f"- `{name}{' ' + value if value else ''}`{' (required)' if needed else ''} "
                     f"{text[:1].upper() + text[1:]}")
    return "\n".join(lines) + "\n"
