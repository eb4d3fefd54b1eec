#include "apps/program.h"

#include <exception>
#include <iostream>
#include <new>

#include "planner/base/error.h"

namespace regrasp {

namespace {

/// File names and CLI11's messages may hold line breaks; scripts count on one line.
std::string OneLine(std::string_view message) {
  std::string line;
  for (const char c : message) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    line += control ? ' ' : c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
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

int RunProgram(CLI::App& app, int argc, const char* const* argv, const std::function<int()>& run) {
  const std::string program = app.get_name();
  app.set_version_flag("--version", program + " " REGRASP_VERSION, "Print the version and exit");
  app.get_help_ptr()->description("Print this text and exit");
  try {
    return FlushResults(program, Run(app, argc, argv, run));
  } catch (const InputError& error) {
    PrintMessage(program, error.what());
    return kExitBadInput;
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

}  // namespace regrasp
