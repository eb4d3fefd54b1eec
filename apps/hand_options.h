#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "planner/base/deadline.h"
#include "planner/gait/find_gait.h"
#include "planner/gait/home.h"

namespace regrasp::apps {

/// The options of `plan` that are about a hand.
struct HandOptions {
  std::string hand;  ///< its file; empty: fingers without a hand
  std::string turn;
  double clearance_m = 1e-3;

  void AddTo(CLI::App& app);

  [[nodiscard]] bool given() const { return !hand.empty(); }
  /// "z 90" as a turn.
  /// @throws InputError  it is something else.
  [[nodiscard]] gait::Turn ParseTurn() const;
};

}  // namespace regrasp::apps
