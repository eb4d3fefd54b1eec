#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace regrasp {

/// What a stream of random numbers is for: streams of one seed are independent of each other, so
/// that drawing more contact points does not change the random start.
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
};

/// Random numbers that are the same on every machine: the engine and its seeding are fixed by the
/// C++ standard, the maps onto intervals, which are not, stand here.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, RandomUse use);
  /// The index-th of many streams of one seed and use: what it gives depends on none of the others.
  RandomStream(std::uint64_t seed, RandomUse use, std::uint64_t index);

  /// Uniform in [0, 1), a multiple of 2⁻⁵³.
  [[nodiscard]] double Uniform();

  /// Normal, of mean 0 and standard deviation 1.
  [[nodiscard]] double Normal();

  /// Uniform in {0, …, count − 1}, without bias. @param count  > 0.
  [[nodiscard]] std::uint64_t Index(std::uint64_t count);

  /// So many different ones of {0, …, count − 1}, each choice as likely as any other, in the order
  /// in which they are drawn. @param drawn  in [0, count].
  [[nodiscard]] std::vector<int> Choose(int count, int drawn);

 private:
  std::mt19937_64 engine_;
};

/// An interval for an unknown share.
struct ShareInterval {
  double lower = 0;
  double upper = 1;
};

/// The exact confidence interval for the share of successes of which `successes` of `trials`
/// independent trials were seen (Clopper and Pearson 1934): each end leaves out no more than
/// (1 − confidence) / 2.
/// @throws std::invalid_argument  not 0 ≤ successes ≤ trials, trials < 1, or the confidence is not
///                                in (0, 1).
[[nodiscard]] ShareInterval ComputeShareInterval(int successes, int trials, double confidence);

}  // namespace regrasp
