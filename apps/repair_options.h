#pragma once

#include <CLI/CLI.hpp>

#include "planner/object/object.h"

namespace regrasp::apps {

/// What is asked of a repair, as the command line gives it.
class RepairOptions {
 public:
  /// Adds --max-deviation, --faces, --part and --solidify.
  void AddTo(CLI::App& app);
  /// Adds --repair too, without which the others are refused.
  void AddWithSwitch(CLI::App& app);

  [[nodiscard]] bool wanted() const { return wanted_; }
  [[nodiscard]] object::RepairOptions Get() const;

 private:
  bool wanted_ = false;
  double max_deviation_percent_ = 100 * object::RepairOptions().max_deviation;
  object::RepairOptions options_;
};

}  // namespace regrasp::apps
