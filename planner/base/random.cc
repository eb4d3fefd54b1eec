#include "planner/base/random.h"

#include <cassert>

namespace regrasp {

namespace {

constexpr int kDoubleBits = 53;

std::mt19937_64 SeededEngine(std::uint64_t seed, RandomUse use) {
  std::seed_seq sequence = {static_cast<std::uint32_t>(seed),
                            static_cast<std::uint32_t>(seed >> 32),
                            static_cast<std::uint32_t>(use)};
  return std::mt19937_64(sequence);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t seed, RandomUse use) : engine_(SeededEngine(seed, use)) {}

double RandomStream::Uniform() {
  constexpr double kStep = 1.0 / (std::uint64_t{1} << kDoubleBits);
  return static_cast<double>(engine_() >> (64 - kDoubleBits)) * kStep;
}

std::uint64_t RandomStream::Index(std::uint64_t count) {
  assert(count > 0);
  // Draws beyond the last whole multiple of count are thrown away.
  const std::uint64_t rest = (std::mt19937_64::max() % count + 1) % count;
  std::uint64_t draw = engine_();
  while (draw > std::mt19937_64::max() - rest) draw = engine_();
  return draw % count;
}

}  // namespace regrasp
