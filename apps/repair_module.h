#pragma once

#include <filesystem>
#include <string>

#include "planner/object/object.h"

namespace regrasp::apps {

/// Functions of the module `regrasp_repair.so` (planner/repair/repair.h).
///
/// Repair takes a sixth of the time to build regrasp and few runs need it. Therefore programs load
/// it at its first use.
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

/// Return the end of an error message: the expected result of a repair.
/// See repair::RepairHint.
[[nodiscard]] std::string RepairHint(const std::filesystem::path& path,
                                     const object::Reading& reading);

/// Return the SHA-256 of the module's file, a part of the program's build.
/// It is "missing" if the module is not installed.
[[nodiscard]] const std::string& RepairModuleDigest();

}  // namespace regrasp::apps
