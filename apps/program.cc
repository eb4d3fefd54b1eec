#include "apps/program.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <exception>
#include <iostream>
#include <new>
#include <span>

#include "apps/colour.h"
#include "apps/help.h"
#include "apps/nearest_word.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/text_table.h"

namespace regrasp::apps {

namespace {

/// A file that is opened while a standard stream is closed would get its number, and with it what
/// is printed. Opened the wrong way round, they stay as good as closed.
void TakeClosedStreams() {
  const auto take = [](int stream, int flags) {
    if (fcntl(stream, F_GETFD) >= 0) return;
    // The lowest free number is this one.
    if (open("/dev/null", flags) != stream) throw EnvironmentError("/dev/null cannot be opened");
  };
  take(STDIN_FILENO, O_WRONLY);
  take(STDOUT_FILENO, O_RDONLY);
  take(STDERR_FILENO, O_RDONLY);
}

/// At the limit of a file's size (ulimit -f) writing then fails like on a full disk.
void PrepareProcess() {
  TakeClosedStreams();
  std::signal(SIGXFSZ, SIG_IGN);
}

/// A full disk behind standard output must not look like success.
int FlushResults(const std::string& program, int exit_code) {
  std::cout.flush();
  if (std::cout) return exit_code;
  PrintError(program, "error: standard output cannot be written");
  return kExitEnvironment;
}

/// What the build makes manual pages and completions with.
constexpr char kHelpAs[] = "--help-as";

/// Whether a word is an option: no negative number, and not "-", which is standard input or output.
bool IsOption(std::string_view word) {
  return word.starts_with("-") && word.size() > 1 &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

/// @param words  all that follows an option up to the next one.
/// @throws InputError  it has no value, or one of several words that are no single argument.
void CheckValue(const OptionHelp& option, std::span<const char* const> words) {
  if (!option.type.empty() && words.empty()) {
    throw InputError(option.name + ": its value is missing: " + option.name + " " + option.type);
  }
  if (!option.type.starts_with('"') || words.size() < 2) return;
  std::string value;
  for (const char* word : words) value += (value.empty() ? "" : " ") + std::string(word);
  throw InputError(option.name + ": its words are one argument, in quotes: " + option.name + " \"" +
                   value + "\"");
}

/// What is mistyped is told before what is missing.
/// @throws InputError  there is no such option, or as CheckValue.
void CheckOptions(const CLI::App& app, int argc, const char* const* argv) {
  std::vector<OptionHelp> options;
  std::vector<std::string> names;
  for (const HelpGroup& group : HelpGroups(app)) {
    for (const OptionHelp& option : group.options) {
      options.push_back(option);
      names.push_back(option.name);
    }
  }
  const std::span<const char* const> words(argv, argc);
  for (int i = 1; i < argc; ++i) {
    const std::string given = argv[i];
    if (given == "--") return;
    const std::string name = given.substr(0, given.find('='));
    if (!IsOption(name) || name == "-h" || name == kHelpAs) continue;
    const auto known = std::ranges::find(options, name, &OptionHelp::name);
    if (known != options.end()) {
      const auto rest = words.subspan(i + 1);
      const auto next = std::ranges::find_if(rest, IsOption) - rest.begin();
      if (name == given) CheckValue(*known, rest.first(next));
      continue;
    }
    // "-object" is taken for "--object".
    const std::string meant = name[1] == '-' ? name : "-" + name;
    throw InputError("unknown option " + name + DidYouMean(meant, names) + " (" + app.get_name() +
                     " --help lists all)");
  }
}

int Run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  if (argc == 3 && argv[1] == std::string(kHelpAs)) {
    std::cout << FormatHelpAs(argv[2], app);
    return kExitDone;
  }
  // What is said of the command line names the program as it was called.
  const std::string called = "regrasp " + app.get_name();
  if (argc > 0 && argv[0] == called) app.name(called);
  CheckOptions(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << HelpText(app, HelpWidth());
    return kExitDone;
  } catch (const CLI::Success& text) {
    // --version, --explain
    std::cout << text.what() << '\n';
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + " (" + app.get_name() + " --help lists all)");
  }
  return run();
}

}  // namespace

void PrintMessage(const std::string& program, std::string_view message) {
  std::string line = OneLine(message);
  const std::string warning = "warning:";
  if (line.starts_with(warning) && TakesColour(STDERR_FILENO)) {
    line = Paint(warning, Ink::kYellow) + line.substr(warning.size());
  }
  std::cerr << program + ": " + line + "\n";
}

void PrintError(const std::string& program, std::string_view message) {
  const std::string line = OneLine(message);
  std::cerr << program + ": " + (TakesColour(STDERR_FILENO) ? Paint(line, Ink::kRed) : line) + "\n";
}

void PrintTable(const std::string& table, const std::string& files) {
  // Scripts take the last line, which says how it went.
  std::string text = table;
  text.insert(text.rfind('\n', text.size() - 2) + 1, OneLine("files: " + files) + "\n");
  std::cout << (TakesColour(STDOUT_FILENO) ? PaintVerdicts(text) : text);
}

int RunGuarded(const std::string& program, const std::function<int()>& run) {
  try {
    return FlushResults(program, run());
  } catch (const InputError& error) {
    PrintError(program, std::string("error: ") + error.what());
    return kExitBadInput;
  } catch (const TimeUp& time_up) {
    PrintError(program, time_up.what());
    return kExitNegative;
  } catch (const EnvironmentError& error) {
    PrintError(program, std::string("error: ") + error.what());
    return kExitEnvironment;
  } catch (const std::bad_alloc&) {
    PrintError(program, "error: not enough memory");
    return kExitEnvironment;
  } catch (const std::exception& error) {
    PrintError(program, std::string("error: internal error: ") + error.what());
    return kExitEnvironment;
  }
}

std::string ProgramVersion() { return REGRASP_VERSION; }

int RunProgram(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  const std::string program = app.get_name();
  app.set_version_flag("--version", program + " " + ProgramVersion(), "Print the version and exit")
      ->group(kGeneralGroup);
  app.get_help_ptr()->description("Print this text and exit");
  return RunGuarded(program, [&] {
    PrepareProcess();
    return Run(app, argc, argv, run);
  });
}

}  // namespace regrasp::apps
