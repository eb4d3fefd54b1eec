#pragma once

namespace regrasp::sampling {

/// How many contacts a grasp has.
struct ContactLimits {
  int least = 0;
  int most = 0;
};

}  // namespace regrasp::sampling
