#include "apps/program.h"

#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <new>

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
  PrintMessage(program, "standard output cannot be written");
  return kExitEnvironment;
}

int Run(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    std::cout << app.help();
    return kExitDone;
  } catch (const CLI::CallForVersion& version) {
    std::cout << version.what() << '\n';
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    throw InputError(error.what());
  }
  return run();
}

}  // namespace

void PrintMessage(const std::string& program, std::string_view message) {
  std::cerr << program + ": " + OneLine(message) + "\n";
}

int RunGuarded(const std::string& program, const std::function<int()>& run) {
  try {
    return FlushResults(program, run());
  } catch (const InputError& error) {
    PrintMessage(program, error.what());
    return kExitBadInput;
  } catch (const TimeUp& time_up) {
    PrintMessage(program, time_up.what());
    return kExitNegative;
  } catch (const EnvironmentError& error) {
    PrintMessage(program, error.what());
    return kExitEnvironment;
  } catch (const std::bad_alloc&) {
    PrintMessage(program, "not enough memory");
    return kExitEnvironment;
  } catch (const std::exception& error) {
    PrintMessage(program, std::string("internal error: ") + error.what());
    return kExitEnvironment;
  }
}

std::string ProgramVersion() { return REGRASP_VERSION; }

int RunProgram(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  const std::string program = app.get_name();
  app.set_version_flag("--version", program + " " + ProgramVersion(), "Print the version and exit");
  app.get_help_ptr()->description("Print this text and exit");
  return RunGuarded(program, [&] {
    PrepareProcess();
    return Run(app, argc, argv, run);
  });
}

}  // namespace regrasp::apps
