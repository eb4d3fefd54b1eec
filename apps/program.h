#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// What a program's exit says.
enum ExitCode : int {
  kExitDone = 0,         ///< done; for `validate`: pass
  kExitNegative = 1,     ///< a negative answer: no sequence, or the plan failed
  kExitBadInput = 2,     ///< bad usage or bad input
  kExitEnvironment = 3,  ///< the environment failed
};

/// The body of every main(): parses the command line, runs the program and turns what is thrown
/// into one line on standard error, "plan: cube.obj: …", and an exit code.
///
/// Bad usage and InputError give 2. EnvironmentError, exhausted memory, an unwritable standard
/// output and unexpected errors give 3. -h, --help, --help-all and --version print to standard
/// output and give 0, and so does `--help-as man|bash|zsh|fish|markdown`, which the build uses.
/// Called as "regrasp plan", by `regrasp`, usage and messages contain that name. Old names of
/// options (renamed_options.h) are accepted; if the program returns, a note on standard error names
/// the new one. Unknown options are reported first, with a similar one. Closed standard streams are
/// opened, so that no file gets their number; SIGXFSZ is ignored, so that the file size limit is an
/// error.
/// @param app  with all its options; its name is the program's. --version is added here.
/// @param run  called after parsing; returns the exit code.
int RunProgram(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run);

/// The part of RunProgram after parsing: runs, and turns what is thrown into a line and an exit
/// code.
int RunGuarded(const std::string& program, const std::function<int()>& run);

/// The project's version, as --version prints it.
[[nodiscard]] std::string ProgramVersion();

/// Prints "name: message" as exactly one line on standard error, whatever bytes the message has.
/// On a terminal a warning is coloured.
void PrintMessage(const std::string& program, std::string_view message);

/// The same for what went wrong: on a terminal the message is red.
void PrintError(const std::string& program, std::string_view message);

/// Prints a table with verdicts on standard output, on a terminal with colours (colour.h), and
/// before its last line where its files are.
void PrintTable(const std::string& table, const std::string& files);

}  // namespace regrasp::apps
