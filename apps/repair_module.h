#pragma once

#include <filesystem>
#include <string>

#include "planner/object/reading.h"

namespace regrasp::apps {

/// The functions of the module `regrasp_repair.so`, declared as in planner/repair/repair.h.
///
/// Repair takes a sixth of the time to build regrasp and few runs need it, so programs load it at
/// its first use.
struct RepairFunctions {
  object::ObjectFile (*read_repaired)(const std::filesystem::path& path,
                                      const object::RepairOptions& options,
                                      const object::Reading& reading, std::string* text);
  std::string (*repair_hint)(const std::filesystem::path& path, const object::Reading& reading);
};

/// Name of the function of the module that returns its RepairFunctions.
inline constexpr char kRepairEntry[] = "regrasp_repair_functions";

/// Read a file and repair the surface in it (repair::ReadRepaired).
/// @throws EnvironmentError  if the module is not installed.
[[nodiscard]] object::ObjectFile ReadRepaired(const std::filesystem::path& path,
                                              const object::RepairOptions& options,
                                              const object::Reading& reading,
                                              std::string* text = nullptr);

/// Return the end of a refusal: what a repair of the file would yield (repair::RepairHint).
[[nodiscard]] std::string RepairHint(const std::filesystem::path& path,
                                     const object::Reading& reading);

/// Return the SHA-256 of the module's file, which is a part of the program's build; "missing" if it
/// is not installed.
[[nodiscard]] const std::string& RepairModuleDigest();

}  // namespace regrasp::apps
