#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace regrasp {

/// Purpose of a stream of random numbers.
/// Streams of one seed with different purposes are independent. For example, the random start does
/// not depend on the number of contact points.
enum class RandomUse : std::uint32_t {
  kContactPoints = 1,
  kStart = 2,
  kGoal = 3,
  kFocusPoints = 4,
  kClusters = 5,
  kTrialWorld = 6,
  kTrialContacts = 7,
  kCandidates = 8,
  kCountedEdges = 9,
  kCountedFaces = 10,
  kHomes = 11,
  kGaits = 12,
  kResetStates = 13,
  kPoseErrors = 14,
  kJointErrors = 15,
  kRolledPaths = 16,
};

/// Random numbers that are identical on all machines.
/// The C++ standard fixes the engine and its seeding. The distributions, which it does not fix, are
/// implemented here.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomUse use);
  /// Construct one of several independent streams of one seed and purpose.
  RandomStream(std::uint64_t seed, RandomUse use, std::uint64_t index);

  /// Draw uniformly from [0, 1): a multiple of 2⁻⁵³.
  [[nodiscard]] double Uniform();

  /// Draw from the normal distribution with mean 0 and standard deviation 1.
  [[nodiscard]] double Normal();

  /// Draw uniformly from {0, …, count − 1}, without bias.
  /// @param count  positive.
  [[nodiscard]] std::uint64_t Index(std::uint64_t count);

  /// Draw distinct numbers of {0, …, count − 1}, uniformly over all choices.
  /// They are in the order of the draws.
  /// @param drawn  number of numbers, in [0, count].
  [[nodiscard]] std::vector<int> Choose(int count, int drawn);

 private:
  std::mt19937_64 engine_;
};

/// Interval of an unknown share.
struct ShareInterval {
  double lower = 0;
  double upper = 1;
};

/// Compute the exact confidence interval of a success rate (Clopper and Pearson 1934).
/// Each end excludes a probability of at most (1 − confidence) / 2.
/// @param successes  number of successes in `trials` independent trials.
/// @throws std::invalid_argument  if not 0 ≤ successes ≤ trials, trials < 1, or the confidence is
///     not in (0, 1).
[[nodiscard]] ShareInterval ComputeShareInterval(int successes, int trials, double confidence);

}  // namespace regrasp
