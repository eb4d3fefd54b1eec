#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "planner/object/object.h"

namespace regrasp::apps {

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
