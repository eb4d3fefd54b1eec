#include "apps/repair_module.h"

#include <algorithm>
#include <system_error>
#include <vector>

#include "apps/list_option.h"
#include "apps/options.h"
#include "planner/base/error.h"
#include "planner/base/file.h"
#include "planner/base/shared_library.h"

namespace regrasp::apps {

namespace {

/// Return the possible paths of the module.
/// In a build folder it is in the folder of the program. If installed, it is in REGRASP_MODULES,
/// relative to that folder.
std::vector<std::string> ModulePlaces() {
  std::error_code unknown;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  constexpr char kFile[] = "regrasp_repair.so";
  return {folder / kFile, folder / REGRASP_MODULES / kFile};
}

const RepairFunctions& Functions() {
  static const RepairFunctions functions = [] {
    const RepairFunctions* (*entry)() = nullptr;
    SharedLibrary(ModulePlaces()).Find(kRepairEntry, entry);
    return *entry();
  }();
  return functions;
}

}  // namespace

object::ObjectFile ReadRepaired(const std::filesystem::path& path,
                                const object::RepairOptions& options,
                                const object::Reading& reading, std::string* text) {
  try {
    (void)Functions();
  } catch (const EnvironmentError& error) {
    throw EnvironmentError("repair is not built: " + std::string(error.what()) +
                           "; help: build the target repair_module");
  }
  return Functions().read_repaired(path, options, reading, text);
}

std::string RepairHint(const std::filesystem::path& path, const object::Reading& reading) {
  try {
    (void)Functions();
  } catch (const EnvironmentError&) {
    return "; the program repair may make a solid of it";
  }
  return Functions().repair_hint(path, reading);
}

const std::string& RepairModuleDigest() {
  static const std::string digest = [] {
    const std::vector<std::string> places = ModulePlaces();
    const auto found = std::ranges::find_if(places, [](const std::string& place) {
      std::error_code error;
      return std::filesystem::is_regular_file(place, error);
    });
    return found == places.end() ? "missing" : Sha256(ReadFile(*found));
  }();
  return digest;
}

namespace {

constexpr int kFewestFacets = 4;
constexpr int kMostFacets = 1'000'000;
constexpr int kMostParts = 100'000;

}  // namespace

void RepairOptions::AddShells(CLI::App& app) {
  AddChoice<std::optional<object::Shells>>(
      app, "--shells", shells_,
      {{"union", object::Shells::kUnion}, {"largest", object::Shells::kLargest}},
      "Treatment of several closed shells. By default only one solid with cavities is accepted\n"
      "union: all shells are one rigid body\n"
      "largest: keep the shell of largest volume and its cavities");
}

CLI::Option* RepairOptions::AddRepair(CLI::App& app, const std::string& purpose,
                                      bool value_optional) {
  ListOption list("--repair");
  list.Key("max-deviation", NumberParser(max_deviation_percent_, NumberRange::Positive()))
      .Key("max-triangles", IntegerParser(options_.facets, kFewestFacets, kMostFacets))
      .Key("part", IntegerParser(options_.part, 1, kMostParts))
      .Key("wall", NumberParser(options_.thickness, NumberRange::Positive()));
  const std::string text =
      purpose +
      ".\nmax-deviation=PERCENT: largest deviation of 95 % of the visible surface, relative to the "
      "object's diameter [default: 1]\n"
      "max-triangles=N: simplify to at most N triangles\n"
      "part=K: keep the solid of K-th largest volume\n"
      "wall=T: replace an open sheet by a wall of thickness T, object units";
  return value_optional ? list.AddOptionalTo(app, "[KEY=VALUE,…]", text)
                        : list.AddTo(app, "KEY=VALUE,…", text);
}

void RepairOptions::AddTo(CLI::App& app) {
  AddShells(app);
  AddRepair(app, "Settings of the repair", false);
}

void RepairOptions::AddWithSwitch(CLI::App& app) {
  AddShells(app);
  switch_ = AddRepair(app, "Repair a scan or broken mesh. Planners avoid filled surface", true);
}

object::RepairOptions RepairOptions::Get() const {
  object::RepairOptions options = options_;
  options.max_deviation = max_deviation_percent_ / 100;
  return options;
}

}  // namespace regrasp::apps
