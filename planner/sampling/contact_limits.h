#pragma once

namespace regrasp {

/// How many contacts a grasp has.
struct ContactLimits {
  int least = 0;
  int most = 0;
};

}  // namespace regrasp
