#include "planner/sets/polygon/concurrent.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace regrasp::polygon {

namespace {

/// Clip a region to a square of side 2 · `reach` about a point.
void ClipToSquare(const Eigen::Vector2d& centre, double reach, ConvexRegion<Exact>& region) {
  const Exact x(centre.x());
  const Exact y(centre.y());
  const Exact one(1);
  const Exact zero(0);
  const Exact r(reach);
  region.Clip({one, zero, r - x});
  region.Clip({-one, zero, r + x});
  region.Clip({zero, one, r - y});
  region.Clip({zero, -one, r + y});
}

double Quotient(const Exact& numerator, const Exact& denominator) {
  const Interval quotient =
      Interval(CGAL::to_interval(numerator)) / Interval(CGAL::to_interval(denominator));
  return (quotient.inf() + quotient.sup()) / 2;
}

}  // namespace

std::vector<std::vector<Eigen::Vector2d>> FocusCell(const object::Polygon& polygon,
                                                    const GraspSet& set) {
  if (set.type != GraspType::kConcurrent || set.edges.size() != 3) {
    throw std::invalid_argument("a focus cell requires a concurrent set");
  }
  const Eigen::Vector2d centre = polygon.mass_properties().centroid.head<2>();
  const double reach = kFarthestFocus * polygon.diameter();
  const IntervalScope scope;
  const EdgeTable edges(polygon, set.tangent);
  const ConcurrentCandidate candidate = {{set.edges[0], set.edges[1], set.edges[2]}, set.tangent};
  std::vector<std::vector<Eigen::Vector2d>> parts;
  for (const FocusComponent& component : ConcurrentCellFinder(edges).Find(candidate)) {
    for (const FocusPart& part : component.parts) {
      if (std::find(set.parts.begin(), set.parts.end(), part.sides) == set.parts.end()) continue;
      ConvexRegion<Exact> region = part.region.exact();
      {
        const ExactScope exact;
        ClipToSquare(centre, reach, region);
      }
      std::vector<Eigen::Vector2d> corners;
      for (const auto& side : region.sides()) {
        corners.emplace_back(Quotient(side.from.x, side.from.w),
                             Quotient(side.from.y, side.from.w));
      }
      parts.push_back(std::move(corners));
    }
  }
  return parts;
}

namespace {

/// Half-planes of the region that sees an edge from one side, counter-clockwise.
///
/// The order is the edge's line, the first ray, the line at infinity (omitted), the second ray.
/// Tags contain the polygon's vertices on each border; the edge's line has the id `id`.
template <class NT>
struct SightRegion {
  std::array<HalfPlane<NT>, 3> half_planes;
  std::array<SideTag, 3> tags;
};

template <class NT>
SightRegion<NT> MakeSightRegion(const EdgeFrame<NT>& e, const std::array<int, 2>& vertices,
                                bool outer, int id) {
  const auto [a, b] = vertices;
  if (outer) {
    return {{-LeftOf(e.along, e.a), LeftOf(-e.right, e.a), LeftOf(e.left, e.b)},
            {SideTag{id, {a, b}}, {-1, {a, -1}}, {-1, {b, -1}}}};
  }
  return {{LeftOf(e.along, e.a), LeftOf(e.right, e.b), LeftOf(-e.left, e.a)},
          {SideTag{id, {a, b}}, {-1, {b, -1}}, {-1, {a, -1}}}};
}

template <class NT>
SightRegion<NT> MakeSightRegion(const EdgeTable& edges, const ConcurrentCandidate& candidate,
                                int sides, int k) {
  const FaceIndex edge = candidate.edges[k];
  return MakeSightRegion(edges.frame<NT>(edge, candidate.tangent), edges.vertices(edge),
                         IsOuter(sides, k), k);
}

template <class NT>
void Clip(const SightRegion<NT>& sight, ConvexRegion<NT>& region) {
  for (int i = 0; i < 3 && !region.empty(); ++i) region.Clip(sight.half_planes[i], sight.tags[i]);
}

template <class NT>
ConvexRegion<NT> MakeSeeingFirstTwo(const EdgeTable& edges, const ConcurrentCandidate& candidate,
                                    int sides) {
  const auto first = MakeSightRegion<NT>(edges, candidate, sides, 0);
  const HalfPlane<NT> infinity = {NT(0), NT(0), NT(1)};
  ConvexRegion<NT> region(
      {first.half_planes[0], first.half_planes[1], infinity, first.half_planes[2]},
      {first.tags[0], first.tags[1], SideTag(), first.tags[2]});
  Clip(MakeSightRegion<NT>(edges, candidate, sides, 1), region);
  return region;
}

template <class NT>
ConvexRegion<NT> MakeFocusPart(const EdgeTable& edges, const ConcurrentCandidate& candidate,
                               int sides) {
  auto part = MakeSeeingFirstTwo<NT>(edges, candidate, sides);
  Clip(MakeSightRegion<NT>(edges, candidate, sides, 2), part);
  return part;
}

/// Half-plane whose border moves with contacts. Its third coefficient is constant + Σ rate · u.
template <class NT>
struct MovingHalfPlane {
  Vector2<NT> normal;
  NT constant;
  std::array<NT, 2> rate = {NT(0), NT(0)};
};

/// Return the cone of a contact that moves along its edge, on the inner or outer side.
template <class NT>
std::array<MovingHalfPlane<NT>, 2> MakeMovingCone(const EdgeFrame<NT>& e, bool outer,
                                                  int parameter) {
  const auto left_of = [&](const Vector2<NT>& direction) {
    MovingHalfPlane<NT> h;
    h.normal = {-direction.y, direction.x};
    h.constant = -Dot(h.normal, e.a);
    h.rate[parameter] = -Dot(h.normal, e.along);
    return h;
  };
  return outer ? std::array{left_of(-e.right), left_of(e.left)}
               : std::array{left_of(e.right), left_of(-e.left)};
}

/// Add λ · h to a half-plane of the parameters.
template <class NT>
void AddWeighted(const NT& weight, const MovingHalfPlane<NT>& h, HalfPlane<NT>& sum) {
  sum.a = sum.a + weight * h.rate[0];
  sum.b = sum.b + weight * h.rate[1];
  sum.c = sum.c + weight * h.constant;
}

/// Clip `region` to parameters for which every two and every three of the half-planes intersect.
template <class NT>
void ClipToCommonPoints(const std::vector<MovingHalfPlane<NT>>& h, ConvexRegion<NT>& region) {
  const int n = static_cast<int>(h.size());
  std::vector<std::vector<NT>> cross(n, std::vector<NT>(n));
  std::vector<std::vector<int>> turn(n, std::vector<int>(n, 0));
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      cross[i][j] = Cross(h[i].normal, h[j].normal);
      cross[j][i] = -cross[i][j];
      turn[i][j] = Sign(cross[i][j]);
      turn[j][i] = -turn[i][j];
      if (turn[i][j] != 0 || Sign(Dot(h[i].normal, h[j].normal)) > 0) continue;
      HalfPlane<NT> sum;
      AddWeighted(Dot(h[j].normal, h[j].normal), h[i], sum);
      AddWeighted(NT(-Dot(h[i].normal, h[j].normal)), h[j], sum);
      region.Clip(sum);
    }
  }
  for (int i = 0; i < n; ++i) {
    for (int j = i + 1; j < n; ++j) {
      for (int k = j + 1; k < n; ++k) {
        // Three normals balance iff consecutive ones turn in the same direction.
        if (turn[i][j] == 0 || turn[i][j] != turn[j][k] || turn[j][k] != turn[k][i]) continue;
        HalfPlane<NT> sum;
        const bool positive = turn[i][j] > 0;
        AddWeighted(positive ? cross[j][k] : cross[k][j], h[i], sum);
        AddWeighted(positive ? cross[k][i] : cross[i][k], h[j], sum);
        AddWeighted(positive ? cross[i][j] : cross[j][i], h[k], sum);
        region.Clip(sum);
      }
    }
  }
}

template <class NT>
ConvexRegion<NT> MakeContactPairs(const EdgeTable& edges, const ConcurrentCandidate& candidate,
                                  int sides, int k, int l) {
  std::vector<MovingHalfPlane<NT>> half_planes;
  for (const auto& [position, parameter] : {std::pair(k, 0), std::pair(l, 1)}) {
    const EdgeFrame<NT> frame = edges.frame<NT>(candidate.edges[position], candidate.tangent);
    for (const auto& h : MakeMovingCone(frame, IsOuter(sides, position), parameter)) {
      half_planes.push_back(h);
    }
  }
  const int third = 3 - k - l;
  const FaceIndex edge = candidate.edges[third];
  const SightRegion<NT> sight = MakeSightRegion(edges.frame<NT>(edge, candidate.tangent),
                                                edges.vertices(edge), IsOuter(sides, third), third);
  for (const HalfPlane<NT>& h : sight.half_planes) half_planes.push_back({{h.a, h.b}, h.c, {}});
  auto region = ConvexRegion<NT>::UnitSquare();
  ClipToCommonPoints(half_planes, region);
  return region;
}

/// Return the contacts on an edge that a part with known corners sees.
template <class NT>
ContactRange<NT> MakeContactRange(const EdgeFrame<NT>& e, const ConvexRegion<NT>& part,
                                  bool outer) {
  // A focus point x sees the contacts between the feet of two rays through it. The foot of the ray
  // along a border v of the cone is cross(x − a, v) / |b − a|².
  const NT squared = Dot(e.along, e.along);
  const auto foot = [&](const HomogeneousPoint<NT>& x, const Vector2<NT>& v) {
    const Vector2<NT> from_a = {x.x - x.w * e.a.x, x.y - x.w * e.a.y};
    return Ratio<NT>::Make(Cross(from_a, v), x.w * squared);
  };
  std::optional<ContactRange<NT>> range;
  for (const auto& side : part.sides()) {
    const ContactRange<NT> seen = {foot(side.from, outer ? e.left : e.right),
                                   foot(side.from, outer ? e.right : e.left)};
    range = range ? range->Join(seen) : seen;
  }
  return ContactRange<NT>::OnEdge(range->low, range->high);
}

/// Return for each part the lowest part of its connected component.
template <class Parts>
std::array<int, kSidePatterns> JoinParts(const Parts& parts) {
  std::array<int, kSidePatterns> component;
  std::iota(component.begin(), component.end(), 0);
  for (int sides = 0; sides < kSidePatterns; ++sides) {
    if (!parts[sides]) continue;
    for (int k = 0; k < 3; ++k) {
      // If a segment of the edge borders the part on one side, the part on the other side borders
      // it, too.
      if (!parts[sides]->region().HasSide(k)) continue;
      const int from = component[sides];
      const int to = component[sides ^ (1 << k)];
      std::ranges::replace(component, std::max(from, to), std::min(from, to));
    }
  }
  return component;
}

}  // namespace

void ConcurrentCellFinder::SeeFirstTwo(const ConcurrentCandidate& candidate) {
  const std::array first_two = {candidate.edges[0], candidate.edges[1]};
  if (first_two == first_two_ && candidate.tangent == tangent_) return;
  first_two_ = first_two;
  tangent_ = candidate.tangent;
  for (int sides = 0; sides < kSidePatterns / 2; ++sides) {
    try {
      seeing_two_[sides] = MakeSeeingFirstTwo<Interval>(edges_, candidate, sides);
    } catch (const CGAL::Uncertain_conversion_exception&) {
      seeing_two_[sides].reset();
    }
  }
}

std::vector<FocusComponent> ConcurrentCellFinder::Find(const ConcurrentCandidate& candidate) {
  Parts parts = MakeParts(candidate);
  const std::array<int, kSidePatterns> component = JoinParts(parts);
  std::vector<FocusComponent> components;
  for (int first = 0; first < kSidePatterns; ++first) {
    FocusComponent found;
    for (int sides = first; sides < kSidePatterns; ++sides) {
      if (component[sides] != first || !parts[sides]) continue;
      found.parts.push_back({sides, std::move(*parts[sides])});
    }
    if (!found.parts.empty()) components.push_back(std::move(found));
  }
  return components;
}

ConcurrentCellFinder::Parts ConcurrentCellFinder::MakeParts(const ConcurrentCandidate& candidate) {
  SeeFirstTwo(candidate);
  std::array<std::optional<SightRegion<Interval>>, 2> seeing_third;
  Parts parts;
  for (int sides = 0; sides < kSidePatterns; ++sides) {
    const auto& seeing_two = seeing_two_[sides % (kSidePatterns / 2)];
    if (seeing_two && seeing_two->empty()) continue;
    const auto recipe = [&edges = edges_, candidate, sides](auto zero) {
      return MakeFocusPart<decltype(zero)>(edges, candidate, sides);
    };
    if (!seeing_two) {
      parts[sides] = FilteredRegion::Make(recipe);
      continue;
    }
    parts[sides] = FilteredRegion::Make(recipe, [&] {
      auto& sight = seeing_third[IsOuter(sides, 2) ? 1 : 0];
      if (!sight) sight = MakeSightRegion<Interval>(edges_, candidate, sides, 2);
      ConvexRegion<Interval> part = *seeing_two;
      Clip(*sight, part);
      return part;
    });
  }
  return parts;
}

bool FocusCellsOverlap(const FocusComponent& a, const FocusComponent& b,
                       std::span<const std::pair<int, int>> common) {
  for (const FocusPart& part : a.parts) {
    for (const FocusPart& other : b.parts) {
      const bool same_sides = std::all_of(common.begin(), common.end(), [&](const auto& edge) {
        return IsOuter(part.sides, edge.first) == IsOuter(other.sides, edge.second);
      });
      if (same_sides && FilteredRegion::Overlap(part.region, other.region)) return true;
    }
  }
  return false;
}

FilteredRange FocusContactRange(const EdgeTable& edges, const ConcurrentCandidate& candidate,
                                const FocusComponent& component, int k) {
  return FilteredRange([&edges, &component, candidate, k](auto zero) {
    using NT = decltype(zero);
    const EdgeFrame<NT> frame = edges.frame<NT>(candidate.edges[k], candidate.tangent);
    std::optional<ContactRange<NT>> range;
    for (const FocusPart& part : component.parts) {
      const auto seen = MakeContactRange(frame, part.region.as<NT>(), IsOuter(part.sides, k));
      range = range ? range->Join(seen) : seen;
    }
    return *range;
  });
}

std::vector<FilteredRegion> FocusContactPairs(const EdgeTable& edges,
                                              const ConcurrentCandidate& candidate,
                                              const FocusComponent& component, int k, int l) {
  std::vector<FilteredRegion> pairs;
  for (const FocusPart& part : component.parts) {
    auto region = FilteredRegion::Make([&edges, candidate, sides = part.sides, k, l](auto zero) {
      return MakeContactPairs<decltype(zero)>(edges, candidate, sides, k, l);
    });
    if (region) pairs.push_back(std::move(*region));
  }
  return pairs;
}

}  // namespace regrasp::polygon
