#pragma once

#include <mujoco/mjxmacro.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace regrasp::sim {

/// Return true if two arrays have equal numbers up to `tolerance` of the larger number of each
/// pair.
template <typename T>
bool AreSameNumbers(const T* a, const T* b, std::ptrdiff_t count, double tolerance) {
  return std::equal(a, a + count, b, [tolerance](T x, T y) {
    const auto p = static_cast<double>(x);
    const auto q = static_cast<double>(y);
    return p == q || std::abs(p - q) <= tolerance * std::max(std::abs(p), std::abs(q));
  });
}

/// Return the names of the different arrays of two models of the same sizes, and of the different
/// members of their statistics.
/// @param prefixes  prefixes of the compared names; empty: all names.
inline std::vector<std::string> DifferentFields(const mjModel& a, const mjModel& b,
                                                double tolerance,
                                                const std::vector<std::string>& prefixes = {}) {
  std::vector<std::string> different;
  const auto add = [&](const std::string& name, bool same) {
    const bool counts = prefixes.empty() || std::ranges::any_of(prefixes, [&](const auto& prefix) {
                          return name.starts_with(prefix);
                        });
    if (counts && !same) different.push_back(name);
  };
  const mjModel* m = &a;
  MJMODEL_POINTERS_PREAMBLE(m)
#define X(type, name, rows, columns) \
  add(#name, AreSameNumbers(a.name, b.name, std::ptrdiff_t{a.rows} * (columns), tolerance));
  MJMODEL_POINTERS
#undef X
  add("stat.meaninertia", AreSameNumbers(&a.stat.meaninertia, &b.stat.meaninertia, 1, tolerance));
  add("stat.meanmass", AreSameNumbers(&a.stat.meanmass, &b.stat.meanmass, 1, tolerance));
  add("stat.meansize", AreSameNumbers(&a.stat.meansize, &b.stat.meansize, 1, tolerance));
  add("stat.extent", AreSameNumbers(&a.stat.extent, &b.stat.extent, 1, tolerance));
  return different;
}

/// Return the names of the different options of two models.
inline std::vector<std::string> DifferentOptions(const mjOption& a, const mjOption& b,
                                                 double tolerance) {
  std::vector<std::string> different;
#define X(type, name) \
  if (!AreSameNumbers(&a.name, &b.name, 1, tolerance)) different.push_back(#name);
  MJOPTION_FLOATS
  MJOPTION_INTS
#undef X
#define X(name, count) \
  if (!AreSameNumbers(a.name, b.name, count, tolerance)) different.push_back(#name);
  MJOPTION_VECTORS
#undef X
  return different;
}

}  // namespace regrasp::sim
