#include "planner/sets/polygon/parallel.h"

#include <algorithm>
#include <cassert>

#include "planner/sets/polygon/plane.h"

namespace regrasp::polygon {

namespace {

/// Function f(u_a, u_x) = constant + rate_a u_a + rate_x u_x, with negative rates.
template <class NT>
struct SideOfCone {
  NT constant;
  NT rate_a;
  NT rate_x;

  [[nodiscard]] NT At(int u_a, int u_x) const {
    NT value = constant;
    if (u_a != 0) value = value + rate_a;
    if (u_x != 0) value = value + rate_x;
    return value;
  }
};

/// The functions f_0 and f_1 of one outer contact.
template <class NT>
using Sides = std::array<SideOfCone<NT>, 2>;

/// Parallel grasps of one centre, over either number type.
template <class NT>
struct CentredSet {
  std::array<int, 2> outer;        ///< positions of b and c, ascending
  std::array<Sides<NT>, 2> sides;  ///< functions of b and c
};

template <class NT>
Sides<NT> MakeSides(const DirectionCone<NT>& cone, const EdgeFrame<NT>& a, const EdgeFrame<NT>& x) {
  const auto side = [&](const Vector2<NT>& w) {
    return SideOfCone<NT>{Cross(w, x.a - a.a), -Cross(w, a.along), Cross(w, x.along)};
  };
  return {side(cone.right), side(cone.left)};
}

template <class NT>
CentredSet<NT> MakeCentredSet(const EdgeTable& edges, const EdgeTriple& triple, int centre) {
  CentredSet<NT> set;
  set.outer = OuterOf(centre);
  const EdgeFrame<NT> a = edges.frame<NT>(triple[centre]);
  const EdgeFrame<NT> b = edges.frame<NT>(triple[set.outer[0]]);
  const EdgeFrame<NT> c = edges.frame<NT>(triple[set.outer[1]]);
  const auto cone = CommonCone(a, b, c);
  assert(cone.has_value());
  set.sides = {MakeSides(*cone, a, b), MakeSides(*cone, a, c)};
  return set;
}

/// Return whether both f of a contact are >= 0 (sign 1) or <= 0 (sign −1), for a contact and a
/// centre at ends of their edges.
template <class NT>
bool BothAt(const Sides<NT>& sides, int u_a, int u_x, int sign) {
  return std::all_of(sides.begin(), sides.end(),
                     [&](const SideOfCone<NT>& f) { return Sign(f.At(u_a, u_x)) * sign >= 0; });
}

template <class NT>
bool IsEmpty(const CentredSet<NT>& set) {
  const auto all = [&](int u, int sign) {
    return BothAt(set.sides[0], u, u, sign) && BothAt(set.sides[1], u, u, sign);
  };
  return all(1, 1) || all(0, -1);
}

/// Return the root of f in one parameter; the second parameter is 0 or 1.
template <class NT>
Ratio<NT> RootOverCentre(const SideOfCone<NT>& f, int u_x) {
  return Ratio<NT>::Make(f.At(0, u_x), -f.rate_a);
}
template <class NT>
Ratio<NT> RootOverOuter(const SideOfCone<NT>& f, int u_a) {
  return Ratio<NT>::Make(f.At(u_a, 0), -f.rate_x);
}

/// Return the parameters of the centre for which some b and c are outside L, and some outside R.
template <class NT>
ContactRange<NT> CentreRange(const CentredSet<NT>& set) {
  const auto& [b, c] = set.sides;
  const auto low = [&](const Sides<NT>& x) {
    return Smaller(RootOverCentre(x[0], 1), RootOverCentre(x[1], 1));
  };
  const auto high = [&](const Sides<NT>& x) {
    return Larger(RootOverCentre(x[0], 0), RootOverCentre(x[1], 0));
  };
  return ContactRange<NT>::OnEdge(Smaller(low(b), low(c)), Larger(high(b), high(c)));
}

/// Return the parameters of an outer contact outside L for the centre at its far end, and outside R
/// for the centre at its near end.
template <class NT>
ContactRange<NT> BetweenCorners(const Sides<NT>& x) {
  return {Smaller(RootOverOuter(x[0], 1), RootOverOuter(x[1], 1)),
          Larger(RootOverOuter(x[0], 0), RootOverOuter(x[1], 0))};
}

/// Return the parameters of one outer contact; `other` belongs to the second one.
template <class NT>
ContactRange<NT> OuterRange(const Sides<NT>& x, const Sides<NT>& other) {
  const ContactRange<NT> between = BetweenCorners(x);
  const Ratio<NT> zero = Ratio<NT>::Make(NT(0), NT(1));
  const Ratio<NT> one = Ratio<NT>::Make(NT(1), NT(1));
  return ContactRange<NT>::OnEdge(BothAt(other, 1, 1, 1) ? between.low : zero,
                                  BothAt(other, 0, 0, -1) ? between.high : one);
}

template <class NT>
ContactRange<NT> RangeOf(const CentredSet<NT>& set, int centre, int k) {
  if (k == centre) return CentreRange(set);
  const bool first = k == set.outer[0];
  return OuterRange(set.sides[first ? 0 : 1], set.sides[first ? 1 : 0]);
}

/// Return the half-plane of parameters above or below a ratio on an axis.
HalfPlane<Interval> Beyond(const Ratio<Interval>& bound, int axis, bool above) {
  const Interval side(above ? 1 : -1);
  HalfPlane<Interval> h;
  (axis == 0 ? h.a : h.b) = side;
  h.c = -side * bound.value;
  return h;
}
HalfPlane<Exact> Beyond(const Ratio<Exact>& bound, int axis, bool above) {
  const Exact side(above ? 1 : -1);
  HalfPlane<Exact> h;
  (axis == 0 ? h.a : h.b) = side * bound.denominator;
  h.c = -side * bound.numerator;
  return h;
}

/// Return f as a half-plane of two parameters, with the centre on the axis `centre_axis`.
template <class NT>
HalfPlane<NT> AsHalfPlane(const SideOfCone<NT>& f, int centre_axis) {
  return centre_axis == 0 ? HalfPlane<NT>{f.rate_a, f.rate_x, f.constant}
                          : HalfPlane<NT>{f.rate_x, f.rate_a, f.constant};
}

template <class NT>
using Cuts = std::array<HalfPlane<NT>, 2>;

constexpr int kCentrePairRegions = 6;

/// Return the cuts of one region of pairs of the centre and an outer contact x.
///
/// Either x is inside the common cone. Or x is not in R, and the centre is beyond the bound up to
/// which the other outer contact must be in L. Or x is not in L, and the centre is before the bound
/// beyond which the other outer contact must be in R.
template <class NT>
Cuts<NT> CutsOfCentrePair(const CentredSet<NT>& set, int x, int centre_axis, int region) {
  const HalfPlane<NT> f0 = AsHalfPlane(set.sides[x][0], centre_axis);
  const HalfPlane<NT> f1 = AsHalfPlane(set.sides[x][1], centre_axis);
  const Sides<NT>& other = set.sides[1 - x];
  const auto above = [&] {
    return Beyond(Smaller(RootOverCentre(other[0], 1), RootOverCentre(other[1], 1)), centre_axis,
                  true);
  };
  const auto below = [&] {
    return Beyond(Larger(RootOverCentre(other[0], 0), RootOverCentre(other[1], 0)), centre_axis,
                  false);
  };
  switch (region) {
    case 0:
      return {f0, -f1};
    case 1:
      return {-f0, f1};
    case 2:
      return {f0, above()};
    case 3:
      return {f1, above()};
    case 4:
      return {-f0, below()};
    default:
      return {-f1, below()};
  }
}

constexpr int kOuterPairRegions = 4;

/// Return the cuts of one region of pairs of outer contacts: the unit square without a rectangle at
/// either end.
template <class NT>
Cuts<NT> CutsOfOuterPair(const CentredSet<NT>& set, int region) {
  const ContactRange<NT> b = BetweenCorners(set.sides[0]);
  const ContactRange<NT> c = BetweenCorners(set.sides[1]);
  switch (region) {
    case 0:
      return {Beyond(b.low, 0, true), Beyond(b.high, 0, false)};
    case 1:
      return {Beyond(b.low, 0, true), Beyond(c.high, 1, false)};
    case 2:
      return {Beyond(c.low, 1, true), Beyond(b.high, 0, false)};
    default:
      return {Beyond(c.low, 1, true), Beyond(c.high, 1, false)};
  }
}

template <class NT>
ConvexRegion<NT> MakeCentredPairs(const CentredSet<NT>& set, int centre, int k, int l, int region) {
  const int outer = k == centre ? l : k;
  const Cuts<NT> cuts =
      k == centre || l == centre
          ? CutsOfCentrePair(set, outer == set.outer[0] ? 0 : 1, k == centre ? 0 : 1, region)
          : CutsOfOuterPair(set, region);
  auto square = ConvexRegion<NT>::UnitSquare();
  for (const HalfPlane<NT>& cut : cuts) square.Clip(cut);
  return square;
}

void AddContactPairs(const EdgeTable& edges, const EdgeTriple& triple, int centre, int k, int l,
                     std::vector<FilteredRegion>& pairs) {
  std::optional<CentredSet<Interval>> by_intervals;
  try {
    by_intervals = MakeCentredSet<Interval>(edges, triple, centre);
  } catch (const CGAL::Uncertain_conversion_exception&) {
    // Each region is then computed exactly.
  }
  const int count = k == centre || l == centre ? kCentrePairRegions : kOuterPairRegions;
  for (int region = 0; region < count; ++region) {
    const auto recipe = [&edges, triple, centre, k, l, region](auto zero) {
      const auto set = MakeCentredSet<decltype(zero)>(edges, triple, centre);
      return MakeCentredPairs(set, centre, k, l, region);
    };
    auto made =
        by_intervals
            ? FilteredRegion::Make(
                  recipe, [&] { return MakeCentredPairs(*by_intervals, centre, k, l, region); })
            : FilteredRegion::Make(recipe);
    if (made) pairs.push_back(std::move(*made));
  }
}

/// Return whether f >= 0 (sign 1) or f <= 0 (sign −1) on a union of regions.
bool HasSignOn(const EdgeTable& edges, const EdgeTriple& triple, int centre, int x, int i, int sign,
               const std::vector<FilteredRegion>& regions) {
  return std::all_of(regions.begin(), regions.end(), [&](const FilteredRegion& region) {
    return DecideFiltered([&](auto zero) {
      using NT = decltype(zero);
      const CentredSet<NT> set = MakeCentredSet<NT>(edges, triple, centre);
      const HalfPlane<NT> f = AsHalfPlane(set.sides[x][i], centre < set.outer[x] ? 0 : 1);
      return std::ranges::all_of(region.as<NT>().sides(), [&](const auto& side) {
        return Sign(Evaluate(f, side.from)) * sign >= 0;
      });
    });
  });
}

PairProjections ProjectOnPairs(const EdgeTable& edges, const EdgeTriple& triple,
                               const ParallelComponent& component) {
  PairProjections projections;
  for (int k = 0; k < 3; ++k) {
    for (int l = k + 1; l < 3; ++l) {
      projections[k][l] = ParallelContactPairs(edges, triple, component, k, l);
    }
  }
  return projections;
}

/// Join the sets of single centres that share grasps.
std::vector<ParallelComponent> JoinMeeting(const EdgeTable& edges, const EdgeTriple& triple,
                                           const std::vector<ParallelComponent>& single) {
  std::vector<ParallelComponent> joined;
  for (const ParallelComponent& next : single) {
    const PairProjections projections = ProjectOnPairs(edges, triple, next);
    const auto apart = std::stable_partition(
        joined.begin(), joined.end(), [&](const ParallelComponent& component) {
          return std::none_of(component.centres.begin(), component.centres.end(), [&](int centre) {
            return SharesGrasps(edges, triple, centre, projections);
          });
        });
    ParallelComponent all;
    for (auto met = apart; met != joined.end(); ++met) {
      all.centres.insert(all.centres.end(), met->centres.begin(), met->centres.end());
    }
    all.centres.push_back(next.centres.front());
    joined.erase(apart, joined.end());
    std::sort(all.centres.begin(), all.centres.end());
    joined.push_back(all);
  }
  std::sort(joined.begin(), joined.end(),
            [](const auto& a, const auto& b) { return a.centres < b.centres; });
  return joined;
}

}  // namespace

std::vector<ParallelComponent> FindParallelSets(const EdgeTable& edges,
                                                const ParallelCandidate& candidate) {
  const EdgeTriple& triple = candidate.edges;
  std::vector<ParallelComponent> components;
  for (const int centre : candidate.centres) {
    const bool empty = DecideFiltered(
        [&](auto zero) { return IsEmpty(MakeCentredSet<decltype(zero)>(edges, triple, centre)); });
    if (!empty) components.push_back({{centre}});
  }
  return components.size() < 2 ? components : JoinMeeting(edges, triple, components);
}

FilteredRange ParallelContactRange(const EdgeTable& edges, const EdgeTriple& triple,
                                   const ParallelComponent& component, int k) {
  return FilteredRange([&edges, triple, centres = component.centres, k](auto zero) {
    using NT = decltype(zero);
    std::optional<ContactRange<NT>> range;
    for (const int centre : centres) {
      const auto one = RangeOf(MakeCentredSet<NT>(edges, triple, centre), centre, k);
      range = range ? range->Join(one) : one;
    }
    return *range;
  });
}

std::vector<FilteredRegion> ParallelContactPairs(const EdgeTable& edges, const EdgeTriple& triple,
                                                 const ParallelComponent& component, int k, int l) {
  std::vector<FilteredRegion> pairs;
  for (const int centre : component.centres) AddContactPairs(edges, triple, centre, k, l, pairs);
  return pairs;
}

bool SharesGrasps(const EdgeTable& edges, const EdgeTriple& triple, int centre,
                  const PairProjections& other) {
  for (const int sign : {1, -1}) {
    bool inside_corner = true;
    for (int x = 0; x < 2 && inside_corner; ++x) {
      const int outer = OuterOf(centre)[x];
      const auto& pairs = other[std::min(centre, outer)][std::max(centre, outer)];
      for (int i = 0; i < 2 && inside_corner; ++i) {
        inside_corner = HasSignOn(edges, triple, centre, x, i, sign, pairs);
      }
    }
    if (inside_corner) return false;
  }
  return true;
}

}  // namespace regrasp::polygon
