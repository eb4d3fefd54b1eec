#include "apps/output_files.h"

#include <sys/stat.h>

#include <algorithm>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/kinematics/hand_file.h"

namespace regrasp::apps {

namespace {

namespace fs = std::filesystem;

using FileId = std::pair<dev_t, ino_t>;

/// Return the identity of a regular file after links; nullopt for other files.
std::optional<FileId> IdOf(const fs::path& path) {
  struct stat status;
  if (stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return FileId(status.st_dev, status.st_ino);
}

/// Return one path for all paths to the same place, also if no file exists there.
fs::path PlaceOf(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(EndOfLinks(path), error);
  const fs::path place = fs::weakly_canonical(whole, error);
  const fs::path& found = error ? whole : place;
  return found.has_filename() ? found : found.parent_path();
}

bool IsInside(const fs::path& folder, const fs::path& place) {
  return std::mismatch(folder.begin(), folder.end(), place.begin(), place.end()).first ==
         folder.end();
}

/// Option of a hand file, whose model and meshes are inputs too.
constexpr std::string_view kHandOption = "--hand";

/// Files that a program reads or writes.
class KnownFiles {
 public:
  explicit KnownFiles(const std::vector<NamedFile>& inputs) {
    for (const NamedFile& input : inputs) {
      AddInput(input.option, input.path);
      if (input.option != kHandOption || input.path.empty()) continue;
      for (const fs::path& file : kinematics::FilesOfHand(input.path)) {
        AddInput(input.option, file);
      }
    }
  }

  /// Refuse an output that is an input.
  /// @throws InputError  if the file is an input.
  void RefuseInput(const std::string& option, const fs::path& path) const {
    const auto id = IdOf(path);
    const auto input = id ? inputs_.find(*id) : inputs_.end();
    if (input == inputs_.end()) return;
    throw InputError(path.string() + ": " + option + " must not overwrite the file of " +
                     input->second);
  }

  /// Add an output file.
  /// @throws InputError  if it is an input or another output.
  void AddOutput(const NamedFile& output) {
    RefuseInput(output.option, output.path);
    std::error_code error;
    const fs::file_type type = fs::status(output.path, error).type();
    if (type != fs::file_type::regular && type != fs::file_type::not_found) return;
    const auto id = IdOf(output.path);
    RefuseTwice(output.path, output.option,
                id ? ids_.emplace(*id, output.option).first->second
                   : places_.emplace(PlaceOf(output.path), output.option).first->second);
  }

  /// Add an output folder. All single files must be added before.
  /// @throws InputError  if a file in it is an input or another output.
  void AddFolder(const OutputFolder& folder) {
    std::error_code error;
    for (fs::directory_iterator entry(folder.path, error), end; !error && entry != end;
         entry.increment(error)) {
      if (!folder.takes(entry->path().filename().string())) continue;
      RefuseInput(folder.option, entry->path());
      const auto id = IdOf(entry->path());
      const auto output = id ? ids_.find(*id) : ids_.end();
      if (output != ids_.end()) RefuseTwice(entry->path(), folder.option, output->second);
    }
    const fs::path place = PlaceOf(folder.path);
    for (const auto& [file, option] : places_) {
      if (file.parent_path() == place && folder.takes(file.filename().string())) {
        RefuseTwice(file, folder.option, option);
      }
    }
  }

 private:
  void AddInput(const std::string& option, const fs::path& path) {
    if (const auto id = IdOf(path)) inputs_.emplace(*id, option);
  }

  static void RefuseTwice(const fs::path& path, const std::string& option,
                          const std::string& other) {
    if (option == other) return;
    throw InputError(path.string() + ": " + option + " must not be the file of " + other);
  }

  std::map<FileId, std::string> inputs_;
  std::map<FileId, std::string> ids_;       ///< options of outputs that exist
  std::map<fs::path, std::string> places_;  ///< options of outputs that do not exist yet
};

}  // namespace

void OutputFiles::Add(const std::string& option, const std::string& path) {
  if (!path.empty()) files.push_back({option, path});
}

namespace {

/// @throws InputError  if an output is named - (standard output), which only some options support.
void RefuseStandardOutput(const OutputFiles& outputs) {
  const auto refuse = [](const std::string& option, const fs::path& path, const char* expected) {
    if (path != "-") return;
    throw InputError(option + ": - (standard output) is not supported, expected a " + expected);
  };
  for (const NamedFile& file : outputs.files) refuse(file.option, file.path, "file");
  for (const OutputFolder& folder : outputs.folders) refuse(folder.option, folder.path, "folder");
}

}  // namespace

void CheckOutputsDiffer(const std::vector<NamedFile>& inputs, const OutputFiles& outputs) {
  RefuseStandardOutput(outputs);
  KnownFiles known(inputs);
  for (const NamedFile& file : outputs.files) known.AddOutput(file);
  for (const OutputFolder& folder : outputs.folders) known.AddFolder(folder);
}

void CheckOutputsWritable(const OutputFiles& outputs) {
  for (const OutputFolder& folder : outputs.folders) CheckFolderWritable(folder.path);
  for (const NamedFile& file : outputs.files) {
    const fs::path parent = PlaceOf(file.path).parent_path();
    std::error_code error;
    const bool to_be_made = !fs::exists(parent, error) &&
                            std::ranges::any_of(outputs.folders, [&](const OutputFolder& folder) {
                              return IsInside(parent, PlaceOf(folder.path));
                            });
    if (!to_be_made) CheckWritable(file.path);
  }
}

bool IsHtmlFile(const std::string& file) {
  const std::string suffix = LowerSuffix(file);
  return suffix == ".html" || suffix == ".htm";
}

fs::path PathForCi(const fs::path& path) {
  const fs::path here = fs::current_path();
  const fs::path absolute = (here / path).lexically_normal();
  const fs::path relative = absolute.lexically_relative(here);
  return relative.empty() || *relative.begin() == ".." ? absolute : relative;
}

std::string ReadOutput(const fs::path& path) {
  try {
    return ReadFile(path);
  } catch (const InputError& error) {
    throw EnvironmentError(error.what());
  }
}

namespace {

constexpr std::size_t kEntryDigits = 3;

/// Return all kinds of entries.
std::vector<std::string> EntryKinds() {
  static_assert(std::variant_size_v<plan::Step> == 3, "a kind of step is missing below");
  return {"hold", plan::StepKind(plan::Switch()), plan::StepKind(plan::Align()),
          plan::StepKind(plan::Move())};
}

}  // namespace

std::string EntryNumber(plan::EntryIndex index) {
  const std::string number = std::to_string(index);
  return std::string(kEntryDigits - std::min(kEntryDigits, number.size()), '0') + number;
}

std::optional<std::string> AfterEntryNumber(const std::string& name) {
  const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
  if (digits < kEntryDigits) return std::nullopt;
  return name.substr(digits);
}

std::string EntryFileName(plan::EntryIndex index, const std::string& kind,
                          const std::string& ending) {
  return EntryNumber(index) + "_" + kind + "." + ending;
}

bool IsEntryFileName(const std::string& name, const std::string& ending) {
  const auto rest = AfterEntryNumber(name);
  if (!rest) return false;
  return std::ranges::any_of(
      EntryKinds(), [&](const std::string& kind) { return *rest == "_" + kind + "." + ending; });
}

}  // namespace regrasp::apps
