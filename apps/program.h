#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>

namespace regrasp::apps {

/// Exit codes of the programs.
enum ExitCode : int {
  kExitDone = 0,         ///< success; for `validate`: pass
  kExitNegative = 1,     ///< negative result: no plan found, or the plan fails
  kExitBadInput = 2,     ///< bad usage or bad input
  kExitEnvironment = 3,  ///< failure of the environment
};

/// Parse the command line, run a program and return its exit code.
/// This is the body of every main(). An exception becomes one line on standard error, "plan: error:
/// cube.obj: …", and an exit code:
///
/// - TimeUp returns 1.
/// - Bad usage and InputError return 2.
/// - EnvironmentError, exhausted memory, an unwritable standard output and unexpected errors return
///   3.
/// - -h, --help, --help-all and --version print to standard output and return 0. So does `--help-as
///   man|bash|zsh|fish|markdown`, which the build uses.
///
/// If `regrasp` calls the program, usage and messages contain the name "regrasp plan". Old names of
/// options (renamed_options.h) are accepted. If the program returns, a note on standard error names
/// the new one. Unknown options are reported first, with a similar one.
///
/// Closed standard streams are opened, so that no file gets their number. SIGXFSZ is ignored, so
/// that writing beyond the file size limit is an error.
/// @param app  command line with all options; its name is the program's name. --version is added
///     here.
/// @param run  function that is called after parsing; returns the exit code.
int RunProgram(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run);

/// Run a program after parsing.
/// Exceptions become a line on standard error and an exit code, as in RunProgram.
int RunGuarded(const std::string& program, const std::function<int()>& run);

/// Return the project's version, as --version prints it.
[[nodiscard]] std::string ProgramVersion();

/// Print "name: message" as exactly one line on standard error, for any bytes.
/// On a terminal the line is wrapped, and a warning is coloured.
void PrintMessage(const std::string& program, std::string_view message);

/// Print an error like PrintMessage; the line is red on a terminal.
void PrintError(const std::string& program, std::string_view message);

/// Print a table with verdicts on standard output.
/// A line with the paths of its files is inserted before the last line, which has the verdict. On a
/// terminal the verdict is first, with colours (ArrangeForTerminal).
void PrintTable(const std::string& table, const std::string& files);

/// Return the linker's digest of the running program, hexadecimal.
/// It is the ELF note NT_GNU_BUILD_ID. Builds from different sources, by a different compiler or
/// with different options have different digests. If the linker wrote none, it is the SHA-256 of
/// the program's file.
[[nodiscard]] std::string BuildId();

/// Return the date of the results in UTC: "2026-11-23".
/// If the environment variable SOURCE_DATE_EPOCH is set, it replaces the clock. It is the number of
/// seconds since 1970, as for reproducible builds. The same results can then be made on another
/// day.
/// @throws InputError  if the variable is not a number of seconds up to the year 9999.
[[nodiscard]] std::string RunDate();

/// Return whether text on a stream may have colour.
/// The stream must be a terminal that is not dumb, NO_COLOR must be unset or empty (no-color.org),
/// and CLICOLOR must not be 0.
/// @param stream  STDOUT_FILENO or STDERR_FILENO.
[[nodiscard]] bool TakesColour(int stream);

enum class Ink { kRed = 31, kGreen = 32, kYellow = 33, kFaint = 2 };

/// Return text in a colour (ECMA-48 SGR).
[[nodiscard]] std::string Paint(const std::string& text, Ink ink);

/// Colour the verdicts of a table: pass green, fail and error red, skipped faint.
[[nodiscard]] std::string PaintVerdicts(const std::string& table);

}  // namespace regrasp::apps
