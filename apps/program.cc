#include "apps/program.h"

#include <elf.h>
#include <fcntl.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <regex>
#include <span>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "apps/help.h"
#include "apps/options.h"
#include "apps/renamed_options.h"
#include "apps/terminal_text.h"
#include "planner/base/deadline.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/text_table.h"

namespace regrasp::apps {

namespace {

/// Open standard streams that are closed.
/// Otherwise a file would get their number, and the program's output would be written into it. The
/// streams are opened for the wrong direction, so that they remain unusable.
void TakeClosedStreams() {
  const auto take = [](int stream, int flags) {
    if (fcntl(stream, F_GETFD) >= 0) return;
    // open returns the lowest free number, which is that of this stream.
    if (open("/dev/null", flags) != stream) throw EnvironmentError("/dev/null cannot be opened");
  };
  take(STDIN_FILENO, O_WRONLY);
  take(STDOUT_FILENO, O_RDONLY);
  take(STDERR_FILENO, O_RDONLY);
}

/// Prepare standard streams and signals.
/// Without SIGXFSZ, writing beyond the file size limit (ulimit -f) fails like on a full disk.
void PrepareProcess() {
  TakeClosedStreams();
  std::signal(SIGXFSZ, SIG_IGN);
}

/// Flush standard output and return the exit code.
/// A full disk must not result in an exit code for success.
int FlushResults(const std::string& program, int exit_code) {
  std::cout.flush();
  if (std::cout) return exit_code;
  PrintError(program, "error: standard output cannot be written");
  return kExitEnvironment;
}

/// Option by which the build makes manual pages and completions.
constexpr char kHelpAs[] = "--help-as";
constexpr char kHelpAll[] = "--help-all";

/// @throws InputError  that an option has an empty value, as of an undefined shell variable.
[[noreturn]] void FailEmpty(const OptionHelp& option) {
  throw InputError(option.name + ": must not be empty, expected " + option.type);
}

/// Check the number of words that follow an option.
/// @param words  words between an option and the next one.
/// @throws InputError  if the option has no value, an empty one, or several words instead of one
///     list.
void CheckValue(const OptionHelp& option, std::span<const std::string> words) {
  if (!option.type.empty() && words.empty() && !option.value_optional) {
    throw InputError(option.name + ": requires a value, as in " + option.name + " " + option.type);
  }
  if (std::ranges::any_of(words, &std::string::empty)) FailEmpty(option);
  if (option.type.find(',') == std::string::npos || words.size() < 2) return;
  std::string value;
  for (const std::string& word : words) value += (value.empty() ? "" : ",") + word;
  throw InputError(option.name + ": expected one list with commas, found " +
                   std::to_string(words.size()) + " words; help: " + option.name + " " + value);
}

/// Return whether a word is like "-j4".
/// Only this short name can be followed by its value without a space.
bool IsShortNumber(const std::string& word) {
  return word.size() > 2 && word.starts_with("-j") &&
         word.find_first_not_of("0123456789", 2) == std::string::npos;
}

/// Return whether a word is like "-z" or "-y,up,30": a direction, and not an option.
bool IsDirection(const std::string& word) {
  return word.size() > 1 && word[0] == '-' && word[1] >= 'x' && word[1] <= 'z' &&
         (word.size() == 2 || word[2] == ',');
}

/// Check the names of options before CLI11 reports missing ones.
/// @throws InputError  if an option is unknown, if its value is a direction with a leading minus
///     sign, or as CheckValue.
void CheckOptions(const CLI::App& app, std::span<const std::string> words) {
  std::vector<OptionHelp> options;
  std::vector<std::string> names;
  for (const HelpGroup& group : HelpGroups(app)) {
    for (const OptionHelp& option : group.options) {
      options.push_back(option);
      names.push_back(option.name);
    }
  }
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& given = words[i];
    if (given == "--") return;
    const std::string name = given.substr(0, given.find('='));
    if (!IsOption(name) || name == kHelpAs || IsShortNumber(name)) continue;
    const auto known = std::ranges::find_if(options, [&](const OptionHelp& option) {
      return option.name == name || option.short_name == name;
    });
    if (known != options.end()) {
      const auto rest = words.subspan(i + 1);
      const auto next = std::ranges::find_if(rest, IsOption) - rest.begin();
      if (name == given && !known->type.empty() && !rest.empty() && IsDirection(rest.front())) {
        throw InputError(name + ": a value with a leading minus sign requires " + name + "=" +
                         rest.front());
      }
      if (name == given) CheckValue(*known, rest.first(next));
      if (given.size() == name.size() + 1) FailEmpty(*known);  // "--output="
      continue;
    }
    // "-object" is read as "--object".
    const std::string meant = name[1] == '-' ? name : "-" + name;
    throw InputError("unknown option " + name + SimilarWord(meant, names) + " (" + app.get_name() +
                     " --help-all lists all)");
  }
}

/// Return the level of help that is requested first; nullopt if none is.
std::optional<HelpLevel> RequestedHelp(std::span<const std::string> words) {
  for (const std::string& word : words) {
    if (word == "--") return std::nullopt;
    if (word == "-h") return HelpLevel::kShort;
    if (word == "--help") return HelpLevel::kFull;
    if (word == kHelpAll) return HelpLevel::kAll;
  }
  return std::nullopt;
}

/// Report old names of options, unless --quiet is given.
void PrintNotes(const std::string& program, const RenamedWords& renamed) {
  for (const char* quiet : {"-q", "--quiet"}) {
    if (std::ranges::find(renamed.words, quiet) != renamed.words.end()) return;
  }
  for (const std::string& note : renamed.notes) PrintMessage(program, "note: " + note);
}

/// Return the text of an error of the command line, reworded if an option is repeated.
std::string ParseErrorText(const CLI::ParseError& error) {
  const std::string text = error.what();
  const auto repeated = text.find(": At Most 1 required");
  return repeated == std::string::npos ? text : text.substr(0, repeated) + ": must be given once";
}

int Run(CLI::App& app, std::vector<std::string> words, const std::string& called,
        const std::function<int()>& run) {
  if (words.size() == 2 && words[0] == kHelpAs) {
    std::cout << FormatHelpAs(words[1], app);
    return kExitDone;
  }
  const std::string program = app.get_name();
  // Messages on the command line contain the program's name as it was called.
  if (called == "regrasp " + program) app.name(called);
  const RenamedWords renamed = RenameOptions(program, words);
  CheckOptions(app, renamed.words);
  if (const auto help = RequestedHelp(renamed.words)) {
    std::cout << HelpText(app, HelpWidth(), *help);
    return kExitDone;
  }
  try {
    app.parse(std::vector<std::string>(renamed.words.rbegin(), renamed.words.rend()));
  } catch (const CLI::Success& text) {
    // --version, --explain
    std::cout << text.what() << '\n';
    return kExitDone;
  } catch (const CLI::ParseError& error) {
    throw InputError(ParseErrorText(error) + " (" + app.get_name() + " --help lists all)");
  }
  const int code = run();
  // Bad input prints a single line. Notes are printed only for command lines that work.
  if (code <= kExitNegative) PrintNotes(program, renamed);
  return code;
}

}  // namespace

namespace {

/// Largest length of a message, bytes. A message repeats wrong values, of any length.
constexpr std::size_t kMostMessage = 6000;

/// Return a text without its middle if it is longer than a message.
std::string Shortened(const std::string& text) {
  if (text.size() <= kMostMessage) return text;
  const auto begins_character = [&](std::size_t at) { return (text[at] & 0xc0) != 0x80; };
  std::size_t head = kMostMessage / 2, tail = text.size() - kMostMessage / 2;
  while (!begins_character(head)) --head;
  while (!begins_character(tail)) ++tail;
  return text.substr(0, head) + " … " + text.substr(tail);
}

/// Print a line on standard error, wrapped on a terminal.
/// @param start  start of the line's text that is coloured.
void PrintLine(const std::string& program, const std::string& line, std::size_t start, Ink ink) {
  std::string text = program + ": " + Shortened(line);
  if (isatty(STDERR_FILENO) != 1) {
    std::cerr << text + "\n";
    return;
  }
  text = WrapForTerminal(text, TextWidth(STDERR_FILENO));
  text.pop_back();
  if (start > 0 && TakesColour(STDERR_FILENO)) {
    const std::size_t begin = program.size() + 2;
    text = text.substr(0, begin) + Paint(text.substr(begin, start), ink) +
           (start < text.size() - begin ? text.substr(begin + start) : "");
  }
  std::cerr << text + "\n";
}

}  // namespace

void PrintMessage(const std::string& program, std::string_view message) {
  const std::string_view warning = "warning:";
  PrintLine(program, OneLine(message), message.starts_with(warning) ? warning.size() : 0,
            Ink::kYellow);
}

void PrintError(const std::string& program, std::string_view message) {
  PrintLine(program, OneLine(message), std::string::npos, Ink::kRed);
}

void PrintTable(const std::string& table, const std::string& files) {
  // Scripts read the last line, which has the verdict.
  std::string text = table;
  text.insert(text.rfind('\n', text.size() - 2) + 1, OneLine("files: " + files) + "\n");
  if (isatty(STDOUT_FILENO) == 1) text = ArrangeForTerminal(text, TextWidth(STDOUT_FILENO));
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
  app.set_version_flag("-V,--version", program + " " + ProgramVersion(), "Print the version")
      ->group(kGeneralGroup);
  app.get_help_ptr()->description("Print help. -h prints one line per option");
  app.add_flag_callback(
         kHelpAll, [] {}, "Print help with rare options")
      ->group(kGeneralGroup);
  return RunGuarded(program, [&] {
    PrepareProcess();
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    return Run(app, words, argc > 0 ? argv[0] : "", run);
  });
}

namespace {

constexpr std::string_view kOwner{ELF_NOTE_GNU, sizeof ELF_NOTE_GNU};

/// Return the build ID in the notes of an ELF segment; empty if there is none.
/// @param notes  consecutive notes: header, name of the owner and content, each padded.
std::string FindBuildId(std::string_view notes, std::size_t alignment) {
  const auto padded = [alignment](std::size_t size) {
    return (size + alignment - 1) / alignment * alignment;
  };
  ElfW(Nhdr) header;
  while (notes.size() >= sizeof header) {
    std::memcpy(&header, notes.data(), sizeof header);
    const std::size_t content = sizeof header + padded(header.n_namesz);
    const std::size_t end = content + padded(header.n_descsz);
    if (end > notes.size()) break;
    const bool is_id =
        header.n_type == NT_GNU_BUILD_ID && notes.substr(sizeof header, header.n_namesz) == kOwner;
    if (is_id) return Hexadecimal(notes.substr(content, header.n_descsz));
    notes.remove_prefix(end);
  }
  return "";
}

/// Take the build ID of the first object, which is the program, and stop.
int TakeProgram(dl_phdr_info* object, std::size_t /*size*/, void* id) {
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const ElfW(Phdr)& part = object->dlpi_phdr[i];
    if (part.p_type != PT_NOTE) continue;
    const auto* notes = reinterpret_cast<const char*>(object->dlpi_addr + part.p_vaddr);
    // Notes are padded to 4 bytes, or to 8 if their segment is aligned to 8.
    const std::string found = FindBuildId({notes, part.p_memsz}, part.p_align == 8 ? 8 : 4);
    if (!found.empty()) *static_cast<std::string*>(id) = found;
  }
  return 1;
}

}  // namespace

std::string BuildId() {
  std::string id;
  dl_iterate_phdr(TakeProgram, &id);
  // Different builds must not have the same ID.
  return id.empty() ? Sha256(ReadFile("/proc/self/exe")) : id;
}

namespace {

constexpr const char* kVariable = "SOURCE_DATE_EPOCH";
constexpr std::time_t kLatest = 253402300799;  // last second of the year 9999

std::time_t Seconds() {
  const char* value = std::getenv(kVariable);
  if (value == nullptr || *value == '\0') {
    return std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  }
  const std::string_view text = value;
  std::time_t seconds = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  if (error != std::errc() || end != text.data() + text.size() || seconds < 0 ||
      seconds > kLatest) {
    throw InputError(std::string(kVariable) +
                     ": must be seconds since 1970-01-01 (date +%s), found \"" + value + "\"");
  }
  return seconds;
}

}  // namespace

std::string RunDate() {
  const std::time_t seconds = Seconds();
  std::tm day = {};
  gmtime_r(&seconds, &day);
  std::array<char, sizeof "2026-11-23"> text = {};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%d", &day);
  return {text.data(), size};
}

namespace {

Ink InkOf(std::string_view verdict) {
  if (verdict.starts_with("pass")) return Ink::kGreen;
  return verdict == "skipped" ? Ink::kFaint : Ink::kRed;
}

std::string PaintLine(const std::string& line) {
  // "verdict: fail, …", and the first line of a failed plan.
  static const std::regex kWhole("(verdict: )(.*)|()(step \\d+ \\(\\w+\\) fails: .*)");
  // A cell of a table.
  static const std::regex kCell("(.*?  )(pass|fail(: \\S+)?|skipped|bad-input|error)((  .*)?)");
  std::smatch found;
  if (std::regex_match(line, found, kWhole)) {
    const std::string said = found[2].matched ? found[2].str() : found[4].str();
    return found[1].str() + Paint(said, InkOf(said));
  }
  if (std::regex_match(line, found, kCell)) {
    return found[1].str() + Paint(found[2].str(), InkOf(found[2].str())) + found[4].str();
  }
  return line;
}

}  // namespace

bool TakesColour(int stream) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  return variable("NO_COLOR").empty() && variable("CLICOLOR") != "0" &&
         variable("TERM") != "dumb" && isatty(stream) == 1;
}

std::string Paint(const std::string& text, Ink ink) {
  return "\x1b[" + std::to_string(static_cast<int>(ink)) + "m" + text + "\x1b[0m";
}

std::string PaintVerdicts(const std::string& table) {
  std::string painted;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) painted += PaintLine(line) + "\n";
  return painted;
}

}  // namespace regrasp::apps
