#include "apps/repair_module.h"

#include <algorithm>
#include <system_error>
#include <vector>

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

}  // namespace regrasp::apps
