#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
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

/// Options for reading a surface that is not a closed solid.
class RepairOptions {
 public:
  /// Add --shells and --repair, the settings of the program `repair`.
  void AddTo(CLI::App& app);
  /// Add --shells and --repair [SETTINGS], which requests a repair.
  void AddWithSwitch(CLI::App& app);

  [[nodiscard]] bool wanted() const { return switch_ != nullptr && switch_->count() > 0; }
  [[nodiscard]] object::RepairOptions Get() const;
  /// Selection of closed shells, used with and without a repair.
  [[nodiscard]] std::optional<object::Shells> shells() const { return shells_; }

 private:
  void AddShells(CLI::App& app);
  CLI::Option* AddRepair(CLI::App& app, const std::string& purpose, bool value_optional);

  const CLI::Option* switch_ = nullptr;  ///< option that requests a repair
  double max_deviation_percent_ = 100 * object::RepairOptions().max_deviation;
  object::RepairOptions options_;
  std::optional<object::Shells> shells_;
};

}  // namespace regrasp::apps
