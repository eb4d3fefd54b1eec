#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/Mpzf.h>
#include <CGAL/number_utils.h>

namespace regrasp::polygon {

/// Predicates are written once, as templates over the number type, and evaluated with intervals of
/// doubles first. Where an interval cannot tell the sign, CGAL throws, and the exact type decides.
/// All of them are polynomials in doubles, so no division is needed.
using Interval = CGAL::Interval_nt<false>;
using Exact = CGAL::Mpzf;

/// While one of these lives, the processor rounds upward, as Interval needs.
class IntervalScope {
 private:
  CGAL::Protect_FPU_rounding<true> upward_;
};

/// While one of these lives inside an IntervalScope, the processor rounds to nearest again.
class ExactScope {
 public:
  ExactScope() : nearest_(CGAL_FE_TONEAREST) {}

 private:
  CGAL::Protect_FPU_rounding<true> nearest_;
};

/// The sign of a number: −1, 0 or 1.
/// @throws CGAL::Uncertain_conversion_exception  an interval about 0.
template <class NT>
int Sign(const NT& x) {
  return static_cast<int>(static_cast<CGAL::Sign>(CGAL::sign(x)));
}

/// `predicate(NT())` by intervals, or exactly where they cannot tell. Inside an IntervalScope.
template <class Predicate>
auto DecideFiltered(const Predicate& predicate) {
  try {
    return predicate(Interval());
  } catch (const CGAL::Uncertain_conversion_exception&) {
  }
  const ExactScope exact;
  return predicate(Exact());
}

}  // namespace regrasp::polygon
