#include "planner/base/random.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cassert>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace regrasp {

namespace {

constexpr int kDoubleBits = 53;

std::mt19937_64 SeededEngine(std::uint64_t seed, RandomUse use) {
  std::seed_seq sequence = {static_cast<std::uint32_t>(seed),
                            static_cast<std::uint32_t>(seed >> 32),
                            static_cast<std::uint32_t>(use)};
  return std::mt19937_64(sequence);
}

std::mt19937_64 SeededEngine(std::uint64_t seed, RandomUse use, std::uint64_t index) {
  std::seed_seq sequence = {static_cast<std::uint32_t>(seed),
                            static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(use),
                            static_cast<std::uint32_t>(index),
                            static_cast<std::uint32_t>(index >> 32)};
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, RandomUse use) : engine_(SeededEngine(seed, use)) {}

RandomStream::RandomStream(std::uint64_t seed, RandomUse use, std::uint64_t index)
    : engine_(SeededEngine(seed, use, index)) {}

double RandomStream::Uniform() {
  constexpr double kStep = 1.0 / (std::uint64_t{1} << kDoubleBits);
  return static_cast<double>(engine_() >> (64 - kDoubleBits)) * kStep;
}

double RandomStream::Normal() {
  double share = Uniform();
  while (share == 0) share = Uniform();
  return boost::math::quantile(boost::math::normal(), share);
}

std::uint64_t RandomStream::Index(std::uint64_t count) {
  assert(count > 0);
  // Draws beyond the last whole multiple of `count` are rejected.
  const std::uint64_t rest = (std::mt19937_64::max() % count + 1) % count;
  std::uint64_t draw = engine_();
  while (draw > std::mt19937_64::max() - rest) draw = engine_();
  return draw % count;
}

std::vector<int> RandomStream::Choose(int count, int drawn) {
  std::vector<int> chosen(count);
  std::iota(chosen.begin(), chosen.end(), 0);
  for (int k = 0; k < drawn; ++k) std::swap(chosen[k], chosen[k + Index(count - k)]);
  chosen.resize(drawn);
  return chosen;
}

ShareInterval ComputeShareInterval(int successes, int trials, double confidence) {
  if (trials < 1 || successes < 0 || successes > trials) {
    throw std::invalid_argument("ComputeShareInterval: not 0 <= successes <= trials");
  }
  if (!(confidence > 0 && confidence < 1)) {
    throw std::invalid_argument("ComputeShareInterval: the confidence must be between 0 and 1");
  }
  using Binomial = boost::math::binomial_distribution<double>;
  const double left_out = (1 - confidence) / 2;
  return {Binomial::find_lower_bound_on_p(trials, successes, left_out),
          Binomial::find_upper_bound_on_p(trials, successes, left_out)};
}

}  // namespace regrasp
