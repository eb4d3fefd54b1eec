#pragma once

#include <CLI/CLI.hpp>
#include <optional>

#include "planner/object/object.h"

namespace regrasp::apps {

/// What is made of a surface that is no solid, as the command line asks it.
class RepairOptions {
 public:
  /// Adds --shells, --max-deviation, --faces, --part and --solidify.
  void AddTo(CLI::App& app);
  /// Adds --repair too, without which all but --shells are refused.
  void AddWithSwitch(CLI::App& app);

  [[nodiscard]] bool wanted() const { return wanted_; }
  [[nodiscard]] object::RepairOptions Get() const;
  /// With and without a repair.
  [[nodiscard]] std::optional<object::Shells> shells() const { return shells_; }

 private:
  bool wanted_ = false;
  double max_deviation_percent_ = 100 * object::RepairOptions().max_deviation;
  object::RepairOptions options_;
  std::optional<object::Shells> shells_;
};

}  // namespace regrasp::apps
