#include "planner/polyhedron/focus_cells.h"

#include <algorithm>
#include <cmath>

#include "planner/graph/components.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Focus points are looked for within so many diameters of the centroid. Cells of normals that
/// φ-positively span with little to spare reach far; what is beyond has contacts on a vanishing
/// part of its faces.
constexpr double kReach = 100;

/// A point this near to a vertex or an edge, over the diameter, is at it: minima that are zero are
/// found to about the square root of roundings.
constexpr double kAtBorder = 1e-6;

std::vector<UnionVolume::Shape> ShapesOf(const std::vector<FacePart>& parts) {
  return {parts.begin(), parts.end()};
}

/// The largest cut of some volumes and of a flat part's sides, on the part's plane: none of them
/// depends on the height over it.
Cut LargestOnPart(std::span<const UnionVolume> volumes, const UnionVolume::Shape& part,
                  const Vector3d& x) {
  const double height = part.normal.dot(x - part.origin);
  const Vector3d foot = x - height * part.normal;
  Cut largest;
  largest.offset = -std::numeric_limits<double>::infinity();
  const auto consider = [&](Cut cut) {
    // The same on the plane, and constant across it.
    const double value = cut.At(foot);
    cut.gradient -= cut.gradient.dot(part.normal) * part.normal;
    cut.offset = value - cut.gradient.dot(foot);
    if (value > largest.At(foot)) largest = cut;
  };
  for (const UnionVolume& volume : volumes) consider(volume.CutAt(foot));
  for (const auto& side : part.sides) {
    const Vector3d outward = side.outward.x() * part.u + side.outward.y() * part.v;
    consider({outward, -outward.dot(part.origin) - side.outward.dot(side.from)});
  }
  return largest;
}

}  // namespace

FocusCellFinder::FocusCellFinder(const Polyhedron& solid, double tangent)
    : solid_(solid),
      parts_(SplitFaces(solid)),
      shapes_(ShapesOf(parts_.parts)),
      tangent_(tangent),
      min_max_(solid.mass_properties().centroid, kReach * solid.diameter()),
      meet_(4 * shapes_.size() * shapes_.size(), Known::kNotYet) {}

bool FocusCellFinder::Decide(const MinMaxResult& result, std::span<const int> halves) {
  const bool unclear = result.overlap == Overlap::kUnclear;
  if (unclear && !IsAtSharedBorder(result.point, halves)) ++unclear_;
  return result.overlap == Overlap::kSome;
}

bool FocusCellFinder::IsAtSharedBorder(const Vector3d& point, std::span<const int> halves) const {
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t j = i + 1; j < halves.size(); ++j) {
      const std::vector<int> shared = SharedCorners(halves[i] / 2, halves[j] / 2);
      for (const int a : shared) {
        for (const int b : shared) {
          const Vector3d& from = solid_.vertices()[a];
          const Vector3d along = solid_.vertices()[b] - from;
          const double share =
              a == b ? 0 : std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
          const double distance = (point - from - share * along).norm();
          if (distance <= kAtBorder * solid_.diameter()) return true;
        }
      }
    }
  }
  return false;
}

/// False only where two halves, with cones of half-angle θ, certainly do not meet: a piece needs
/// all six pairs. Two inner halves nearly always meet, and are not asked.
bool FocusCellFinder::MayMeet(int half, int other) {
  if (half % 2 == 0 && other % 2 == 0) return true;
  Known& known = meet_[half * 2 * shapes_.size() + other];
  if (known == Known::kNotYet) {
    const std::array volumes = {VolumeOf(half, tangent_), VolumeOf(other, tangent_)};
    min_max_.Restart();
    const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kSign);
    known = result.overlap == Overlap::kSome ? Known::kYes : Known::kNo;
    if (result.overlap == Overlap::kUnclear && SharedCorners(half / 2, other / 2).empty()) {
      ++unclear_;
    }
    meet_[other * 2 * shapes_.size() + half] = known;
  }
  return known == Known::kYes;
}

/// The vertices that two parts have in common: the ends of a common edge, or a corner.
std::vector<int> FocusCellFinder::SharedCorners(int part, int other) const {
  std::vector<int> shared;
  const std::vector<int>& corners = parts_.parts[part].corners;
  for (const int vertex : parts_.parts[other].corners) {
    if (std::ranges::count(corners, vertex) > 0) shared.push_back(vertex);
  }
  return shared;
}

std::vector<FocusCell> FocusCellFinder::Find(const QuadrupleCandidate& candidate) {
  std::vector<FocusPiece> pieces;
  std::array<int, 4> halves;
  FindPieces(candidate, 0, halves, pieces);
  if (pieces.size() < 2) {
    if (pieces.empty()) return {};
    return {{candidate.faces, candidate.tangent, std::move(pieces)}};
  }
  const int count = static_cast<int>(pieces.size());
  std::vector<std::array<int, 2>> joins;
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      if (FindJunction(candidate.tangent, pieces[i], pieces[j])) joins.push_back({i, j});
    }
  }
  const Components components = FindComponents(
      count, static_cast<int>(joins.size()), [&](int i) { return std::span<const int>(joins[i]); });
  std::vector<FocusCell> cells(components.count(), {candidate.faces, candidate.tangent, {}});
  for (int i = 0; i < count; ++i) {
    cells[components.of_vertex[i]].pieces.push_back(std::move(pieces[i]));
  }
  return cells;
}

void FocusCellFinder::FindPieces(const QuadrupleCandidate& candidate, std::size_t depth,
                                 std::array<int, 4>& halves, std::vector<FocusPiece>& pieces) {
  if (depth < halves.size()) {
    const int face = candidate.faces[depth];
    for (int half = 2 * parts_.first[face]; half < 2 * parts_.first[face + 1]; ++half) {
      const bool may = std::all_of(halves.begin(), halves.begin() + depth,
                                   [&](int other) { return MayMeet(other, half); });
      if (!may) continue;
      halves[depth] = half;
      FindPieces(candidate, depth + 1, halves, pieces);
    }
    return;
  }
  const std::array volumes = {
      VolumeOf(halves[0], candidate.tangent), VolumeOf(halves[1], candidate.tangent),
      VolumeOf(halves[2], candidate.tangent), VolumeOf(halves[3], candidate.tangent)};
  min_max_.Restart();
  const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kSign);
  if (Decide(result, halves)) pieces.push_back({halves, result.point, min_max_.basis()});
}

/// One goes from one piece to the other while three contacts stay on their parts: through the face,
/// or over a joint of its parts.
std::optional<FocusCellFinder::Junction> FocusCellFinder::FindJunction(double tangent,
                                                                       const FocusPiece& a,
                                                                       const FocusPiece& b) {
  std::vector<UnionVolume> common;
  std::size_t changed = 0;
  for (std::size_t k = 0; k < a.halves.size(); ++k) {
    if (a.halves[k] == b.halves[k]) {
      common.push_back(VolumeOf(a.halves[k], tangent));
    } else {
      changed = k;
    }
  }
  if (common.size() != 3) return std::nullopt;
  const int half = a.halves[changed];
  const int other = b.halves[changed];
  if (half / 2 == other / 2) {
    const UnionVolume::Shape& part = ShapeOf(half);
    min_max_.Restart();
    const MinMaxResult result = min_max_.Solve(
        [&](const Vector3d& x) { return LargestOnPart(common, part, x); }, MinMax::Until::kMinimum);
    if (!Decide(result, a.halves)) return std::nullopt;
    const double height = part.normal.dot(result.point - part.origin);
    const Vector3d on_face = result.point - height * part.normal;
    return Junction{on_face, changed, on_face};
  }
  if (half % 2 != other % 2) return std::nullopt;
  for (const PartJoint& joint : parts_.joints) {
    const auto& [p, q] = joint.parts;
    if (std::minmax(p, q) != std::minmax(half / 2, other / 2)) continue;
    const UnionVolume::Shape segment(joint.segment);
    std::vector<UnionVolume> all = common;
    all.emplace_back(segment, half % 2 == 0, tangent);
    min_max_.Restart();
    const MinMaxResult result = min_max_.Solve(all, MinMax::Until::kMinimum);
    if (!Decide(result, a.halves)) continue;
    const UnionVolume::Shape::Side& side = segment.sides.front();
    const Vector3d from = segment.origin + side.from.x() * segment.u + side.from.y() * segment.v;
    const Vector3d along = side.along.x() * segment.u + side.along.y() * segment.v;
    const double at = std::clamp(along.dot(result.point - from), 0.0, side.length);
    return Junction{result.point, changed, from + at * along};
  }
  return std::nullopt;
}

std::optional<MinMaxResult> FocusCellFinder::FindDeepest(std::span<const UnionVolume> volumes,
                                                         const FocusPiece* from) {
  if (from != nullptr) {
    min_max_.Resume(from->basis);
  } else {
    min_max_.Restart();
  }
  const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kMinimum);
  if (result.overlap != Overlap::kSome) return std::nullopt;
  return result;
}

bool FocusCellFinder::HasPoint(const MinMax::LargestCut& largest_cut) {
  min_max_.Restart();
  return min_max_.Solve(largest_cut, MinMax::Until::kSign).overlap == Overlap::kSome;
}

bool FocusCellFinder::Overlap(const FocusCell& a, const FocusCell& b) {
  // The faces that only one of the two has.
  std::size_t own_a = 0, own_b = 0;
  while (own_a < 3 && std::ranges::find(b.faces, a.faces[own_a]) != b.faces.end()) ++own_a;
  while (own_b < 3 && std::ranges::find(a.faces, b.faces[own_b]) != a.faces.end()) ++own_b;
  const auto others = [](std::size_t own) {
    std::array<std::size_t, 3> rest;
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = k < own ? k : k + 1;
    return rest;
  };
  const auto common_a = others(own_a);
  const auto common_b = others(own_b);
  const double narrower = std::min(a.tangent, b.tangent);
  for (const FocusPiece& of_a : a.pieces) {
    for (const FocusPiece& of_b : b.pieces) {
      const bool same = std::equal(
          common_a.begin(), common_a.end(), common_b.begin(),
          [&](std::size_t i, std::size_t j) { return of_a.halves[i] == of_b.halves[j]; });
      if (!same) continue;
      const std::array volumes = {VolumeOf(of_b.halves[own_b], b.tangent),
                                  VolumeOf(of_a.halves[own_a], a.tangent),
                                  VolumeOf(of_a.halves[common_a[0]], narrower),
                                  VolumeOf(of_a.halves[common_a[1]], narrower),
                                  VolumeOf(of_a.halves[common_a[2]], narrower)};
      // What is known of the piece with the narrower cones holds: its volumes are among the five.
      if (a.tangent == narrower && volumes[0].At(of_a.point) < 0) return true;
      if (b.tangent == narrower && volumes[1].At(of_b.point) < 0) return true;
      min_max_.Resume(a.tangent == narrower ? of_a.basis : of_b.basis);
      if (Decide(min_max_.Solve(volumes, MinMax::Until::kSign), of_a.halves)) return true;
    }
  }
  return false;
}

}  // namespace regrasp
