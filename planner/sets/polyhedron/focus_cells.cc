#include "planner/sets/polyhedron/focus_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace regrasp::polyhedron {

using Eigen::Vector3d;

namespace {

/// Focus points are looked for within so many diameters of the centroid. Cells of normals that
/// φ-positively span with little to spare reach far; what is beyond has contacts on a vanishing
/// part of its faces.
constexpr double kReach = 100;

/// A point this near to a vertex or an edge, over the diameter, is at it: minima that are zero are
/// found to about the square root of roundings.
constexpr double kAtBorder = 1e-6;

std::vector<UnionVolume::Shape> ShapesOf(const FaceParts& parts) {
  std::vector<UnionVolume::Shape> shapes(parts.parts.begin(), parts.parts.end());
  for (const FacePart& hull : parts.hulls) shapes.emplace_back(hull);
  return shapes;
}

/// The only position at which the halves of two pieces differ; nullopt where there are more.
std::optional<std::size_t> ChangedHalf(const FocusPiece& a, const FocusPiece& b) {
  std::optional<std::size_t> changed;
  for (std::size_t k = 0; k < a.halves.size(); ++k) {
    if (a.halves[k] == b.halves[k]) continue;
    if (changed) return std::nullopt;
    changed = k;
  }
  return changed;
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

FocusCellFinder::FocusCellFinder(const object::Polyhedron& solid, double tangent)
    : solid_(solid),
      parts_(SplitFaces(solid)),
      shapes_(ShapesOf(parts_)),
      joined_(parts_.parts.size()),
      tangent_(tangent),
      min_max_(solid.mass_properties().centroid, kReach * solid.diameter()),
      meet_(4 * parts_.hulls.size() * parts_.hulls.size(), Known::kNotYet) {
  for (const PartJoint& joint : parts_.joints) {
    const int number = static_cast<int>(joint_shapes_.size());
    const auto [p, q] = joint.parts;
    joined_[p].push_back({q, number});
    if (p != q) joined_[q].push_back({p, number});
    joint_shapes_.emplace_back(joint.segment);
  }
}

bool FocusCellFinder::Decide(const MinMaxResult& result, std::span<const int> halves) {
  const bool unclear = result.overlap == Overlap::kUnclear;
  if (unclear && !IsAtSharedBorder(result.point, halves)) ++unclear_;
  return result.overlap == Overlap::kSome;
}

bool FocusCellFinder::IsAtSharedBorder(const Vector3d& point, std::span<const int> halves) const {
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t j = i + 1; j < halves.size(); ++j) {
      const std::vector<int> shared = SharedCorners(halves[i], halves[j]);
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

/// False only where two halves of hulls, with cones of half-angle θ, certainly do not meet: a piece
/// needs all six pairs. Two inner halves nearly always meet, and are not asked.
bool FocusCellFinder::MayMeet(int half, int other) {
  if (half % 2 == 0 && other % 2 == 0) return true;
  const std::size_t first = 2 * parts_.parts.size();
  const std::size_t count = 2 * parts_.hulls.size();
  Known& known = meet_[(half - first) * count + (other - first)];
  if (known == Known::kNotYet) {
    const std::array volumes = {VolumeOf(half, tangent_), VolumeOf(other, tangent_)};
    min_max_.Restart();
    const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kSign);
    known = result.overlap == Overlap::kSome ? Known::kYes : Known::kNo;
    if (result.overlap == Overlap::kUnclear && SharedCorners(half, other).empty()) ++unclear_;
    meet_[(other - first) * count + (half - first)] = known;
  }
  return known == Known::kYes;
}

const FacePart& FocusCellFinder::PartOf(int half) const {
  const std::size_t shape = half / 2;
  const std::size_t parts = parts_.parts.size();
  return shape < parts ? parts_.parts[shape] : parts_.hulls[shape - parts];
}

/// The vertices that two parts have in common: the ends of a common edge, or a corner.
std::vector<int> FocusCellFinder::SharedCorners(int half, int other) const {
  std::vector<int> shared;
  const std::vector<int>& corners = PartOf(half).corners;
  for (const int vertex : PartOf(other).corners) {
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
  std::ranges::sort(pieces, {}, &FocusPiece::halves);
  const int count = static_cast<int>(pieces.size());
  // By the first piece that each is joined to, over others.
  std::vector<int> component(count);
  std::iota(component.begin(), component.end(), 0);
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const auto [kept, gone] = std::minmax(component[i], component[j]);
      if (kept == gone || !AreJoined(candidate.tangent, pieces[i], pieces[j])) continue;
      std::ranges::replace(component, int{gone}, int{kept});
    }
  }
  std::vector<FocusCell> cells;
  for (int i = 0; i < count; ++i) {
    if (component[i] != i) continue;
    cells.push_back({candidate.faces, candidate.tangent, {}});
    for (int j = i; j < count; ++j) {
      if (component[j] == i) cells.back().pieces.push_back(std::move(pieces[j]));
    }
  }
  return cells;
}

/// The pieces of whole faces first: hulls in place of parts, sixteen patterns of sides.
void FocusCellFinder::FindPieces(const QuadrupleCandidate& candidate, std::size_t depth,
                                 std::array<int, 4>& halves, std::vector<FocusPiece>& pieces) {
  if (depth < halves.size()) {
    const int hull = static_cast<int>(parts_.parts.size()) + candidate.faces[depth];
    for (const int half : {2 * hull, 2 * hull + 1}) {
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
  if (!Decide(result, halves)) return;
  Refine(candidate, 0, {halves, result.point, min_max_.basis()}, pieces);
}

/// Puts parts in place of hulls, face by face. Parts see less than their hull: where it has nothing
/// they have nothing, and what is known of it bounds them.
void FocusCellFinder::Refine(const QuadrupleCandidate& candidate, std::size_t position,
                             const FocusPiece& piece, std::vector<FocusPiece>& pieces) {
  if (position == piece.halves.size()) {
    pieces.push_back(piece);
    return;
  }
  const int face = candidate.faces[position];
  const int first = parts_.first[face];
  const int end = parts_.first[face + 1];
  for (int part = first; part < end; ++part) {
    FocusPiece finer = piece;
    finer.halves[position] = 2 * part + piece.halves[position] % 2;
    const UnionVolume volume = VolumeOf(finer.halves[position], candidate.tangent);
    if (end - first > 1 && volume.At(piece.point) >= -min_max_.rounding()) {
      const std::array volumes = {volume,
                                  VolumeOf(piece.halves[(position + 1) % 4], candidate.tangent),
                                  VolumeOf(piece.halves[(position + 2) % 4], candidate.tangent),
                                  VolumeOf(piece.halves[(position + 3) % 4], candidate.tangent)};
      min_max_.Resume(piece.basis);
      const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kSign);
      if (!Decide(result, finer.halves)) continue;
      finer.point = result.point;
      finer.basis = min_max_.basis();
    }
    Refine(candidate, position + 1, finer, pieces);
  }
}

/// Whether one goes from one piece to the other while three contacts stay on their parts: through
/// the face, or over a joint of its parts.
bool FocusCellFinder::AreJoined(double tangent, const FocusPiece& a, const FocusPiece& b) {
  const auto changed = ChangedHalf(a, b);
  if (!changed) return false;
  const int half = a.halves[*changed];
  const int other = b.halves[*changed];
  if (half / 2 == other / 2) {
    return Decide(MeetAcrossFace(tangent, a, *changed, MinMax::Until::kSign), a.halves);
  }
  if (half % 2 != other % 2) return false;
  return std::ranges::any_of(joined_[half / 2], [&](const JoinedPart& joined) {
    if (joined.other != other / 2) return false;
    const UnionVolume segment(joint_shapes_[joined.joint], half % 2 == 0, tangent);
    if (segment.At(a.point) < -min_max_.rounding() || segment.At(b.point) < -min_max_.rounding()) {
      return true;
    }
    std::vector<UnionVolume> volumes = VolumesOf(a, tangent);
    volumes[*changed] = segment;
    // A segment of a part sees less than the part.
    min_max_.Resume(a.basis);
    return Decide(min_max_.Solve(volumes, MinMax::Until::kSign), a.halves);
  });
}

std::vector<UnionVolume> FocusCellFinder::VolumesOf(const FocusPiece& piece, double tangent) const {
  std::vector<UnionVolume> volumes;
  for (const int half : piece.halves) volumes.push_back(VolumeOf(half, tangent));
  return volumes;
}

MinMaxResult FocusCellFinder::MeetAcrossFace(double tangent, const FocusPiece& a,
                                             std::size_t changed, MinMax::Until until) {
  std::vector<UnionVolume> common = VolumesOf(a, tangent);
  common.erase(common.begin() + static_cast<std::ptrdiff_t>(changed));
  const UnionVolume::Shape& part = ShapeOf(a.halves[changed]);
  min_max_.Restart();
  return min_max_.Solve([&](const Vector3d& x) { return LargestOnPart(common, part, x); }, until);
}

std::optional<FocusCellFinder::Junction> FocusCellFinder::FindJunction(double tangent,
                                                                       const FocusPiece& a,
                                                                       const FocusPiece& b) {
  const auto changed = ChangedHalf(a, b);
  if (!changed) return std::nullopt;
  const int half = a.halves[*changed];
  const int other = b.halves[*changed];
  if (half / 2 == other / 2) {
    const MinMaxResult result = MeetAcrossFace(tangent, a, *changed, MinMax::Until::kMinimum);
    if (!Decide(result, a.halves)) return std::nullopt;
    const UnionVolume::Shape& part = ShapeOf(half);
    const double height = part.normal.dot(result.point - part.origin);
    const Vector3d on_face = result.point - height * part.normal;
    return Junction{on_face, *changed, on_face};
  }
  if (half % 2 != other % 2) return std::nullopt;
  for (const JoinedPart& joined : joined_[half / 2]) {
    if (joined.other != other / 2) continue;
    const UnionVolume::Shape& segment = joint_shapes_[joined.joint];
    std::vector<UnionVolume> volumes = VolumesOf(a, tangent);
    volumes[*changed] = UnionVolume(segment, half % 2 == 0, tangent);
    min_max_.Resume(a.basis);
    const MinMaxResult result = min_max_.Solve(volumes, MinMax::Until::kMinimum);
    if (!Decide(result, a.halves)) continue;
    const UnionVolume::Shape::Side& side = segment.sides.front();
    const Vector3d from = segment.origin + side.from.x() * segment.u + side.from.y() * segment.v;
    const Vector3d along = side.along.x() * segment.u + side.along.y() * segment.v;
    const double at = std::clamp(along.dot(result.point - from), 0.0, side.length);
    return Junction{result.point, *changed, from + at * along};
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

}  // namespace regrasp::polyhedron
