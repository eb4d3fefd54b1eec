#pragma once

#include <cstdint>
#include <string>

#include "sim/actuation/draw_reset_states.h"

namespace regrasp::sim {

/// What reset states are of.
struct ResetStatesOrigin {
  std::string object;         ///< name of the file
  std::string object_sha256;  ///< of its bytes
  double scale = 1;           ///< metres per unit of it
  std::uint64_t seed = 0;
};

/// Reset states as the bytes of an NPZ file: docs/formats.md has its arrays.
[[nodiscard]] std::string FormatResetStates(const DrawnStates& drawn,
                                            const kinematics::HandModel& hand,
                                            const ResetStateOptions& options,
                                            const ResetStatesOrigin& origin);

}  // namespace regrasp::sim
