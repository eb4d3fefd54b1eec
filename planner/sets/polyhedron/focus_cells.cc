#include "planner/sets/polyhedron/focus_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "planner/object/segment.h"

namespace regrasp::polyhedron {

using Eigen::Vector3d;

namespace {

/// Radius of the search for focus points about the centroid, divided by the diameter. If normals
/// φ-positively span with little margin, cells extend far. Their contacts beyond this radius are on
/// a vanishing part of the faces.
constexpr double kReach = 100;

/// Distance below which a point is at a vertex or an edge, divided by the diameter. A minimum of
/// zero is accurate to about the square root of rounding.
constexpr double kAtBorder = 1e-6;

/// Return the position at which the halves of two pieces differ; nullopt if they differ at several.
std::optional<std::size_t> ChangedHalf(const FocusPiece& a, const FocusPiece& b) {
  std::optional<std::size_t> changed;
  for (std::size_t k = 0; k < a.halves.size(); ++k) {
    if (a.halves[k] == b.halves[k]) continue;
    if (changed) return std::nullopt;
    changed = k;
  }
  return changed;
}

/// Return the largest cut of some volumes and of a part's sides, restricted to the part's plane. It
/// does not depend on the height over the plane.
Cut LargestOnPart(std::span<const UnionVolume> volumes, const FacePart& part, const Vector3d& x) {
  const Vector3d foot = x - part.HeightOf(x) * part.normal;
  Cut largest;
  largest.offset = -std::numeric_limits<double>::infinity();
  const auto consider = [&](Cut cut) {
    // Equal to the cut on the plane, and constant along its normal.
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

std::size_t PositionOf(const FocusCell& cell, FaceIndex face) {
  return static_cast<std::size_t>(std::ranges::find(cell.faces, face) - cell.faces.begin());
}

std::size_t OwnPosition(const FocusCell& cell, const FocusCell& other) {
  std::size_t own = 0;
  while (own < 3 && PositionOf(other, cell.faces[own]) < 4) ++own;
  return own;
}

FocusCellFinder::FocusCellFinder(const object::Polyhedron& solid, double tangent)
    : solid_(solid),
      parts_(SplitFaces(solid)),
      joined_(parts_.parts.size()),
      tangent_(tangent),
      min_max_(solid.mass_properties().centroid, kReach * solid.diameter()),
      meet_(4 * parts_.hulls.size() * parts_.hulls.size(), Known::kNotYet) {
  for (int joint = 0; joint < std::ssize(parts_.joints); ++joint) {
    const auto [p, q] = parts_.joints[joint].parts;
    joined_[p].push_back({q, joint});
    if (p != q) joined_[q].push_back({p, joint});
  }
}

bool FocusCellFinder::Decide(const MinMaxResult& result, std::span<const HalfIndex> halves) {
  const bool unclear = result.overlap == Overlap::kUnclear;
  if (unclear && !IsAtSharedBorder(result.point, halves)) ++unclear_;
  return result.overlap == Overlap::kSome;
}

bool FocusCellFinder::IsAtSharedBorder(const Vector3d& point,
                                       std::span<const HalfIndex> halves) const {
  for (std::size_t i = 0; i < halves.size(); ++i) {
    for (std::size_t j = i + 1; j < halves.size(); ++j) {
      const std::vector<int> shared = SharedCorners(halves[i], halves[j]);
      for (const int a : shared) {
        for (const int b : shared) {
          const Vector3d nearest =
              object::ClosestOnSegment(solid_.vertices()[a], solid_.vertices()[b], point);
          if ((point - nearest).norm() <= kAtBorder * solid_.diameter()) return true;
        }
      }
    }
  }
  return false;
}

/// Return false only if two halves of hulls, with cones of angle θ, certainly do not meet. A piece
/// requires that all six pairs meet. Two inner halves nearly always meet and are not tested.
bool FocusCellFinder::MayMeet(HalfIndex half, HalfIndex other) {
  if (IsInner(half) && IsInner(other)) return true;
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

/// Return the common vertices of two parts: the ends of a common edge, or a corner.
std::vector<int> FocusCellFinder::SharedCorners(HalfIndex half, HalfIndex other) const {
  std::vector<int> shared;
  const std::vector<int>& corners = PartOf(half).corners;
  for (const int vertex : PartOf(other).corners) {
    if (std::ranges::count(corners, vertex) > 0) shared.push_back(vertex);
  }
  return shared;
}

std::vector<FocusCell> FocusCellFinder::Find(const QuadrupleCandidate& candidate) {
  std::vector<FocusPiece> pieces;
  Halves halves;
  FindPieces(candidate, 0, halves, pieces);
  if (pieces.size() < 2) {
    if (pieces.empty()) return {};
    return {{candidate.faces, candidate.tangent, std::move(pieces)}};
  }
  std::ranges::sort(pieces, {}, &FocusPiece::halves);
  const int count = static_cast<int>(pieces.size());
  // For each piece, the first piece of its connected component.
  std::vector<int> component(count);
  std::iota(component.begin(), component.end(), 0);
  for (int i = 0; i < count; ++i) {
    for (int j = i + 1; j < count; ++j) {
      const auto [kept, gone] = std::minmax(component[i], component[j]);
      if (kept == gone ||
          !FindJunction(candidate.tangent, pieces[i], pieces[j], MinMax::Until::kSign)) {
        continue;
      }
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

/// Find pieces of whole faces first, with hulls instead of parts: sixteen combinations of sides.
void FocusCellFinder::FindPieces(const QuadrupleCandidate& candidate, std::size_t depth,
                                 Halves& halves, std::vector<FocusPiece>& pieces) {
  if (depth < halves.size()) {
    const PartIndex hull(static_cast<int>(parts_.parts.size()) + candidate.faces[depth]);
    for (const HalfIndex half : {HalfOf(hull, true), HalfOf(hull, false)}) {
      const bool may = std::all_of(halves.begin(), halves.begin() + depth,
                                   [&](HalfIndex other) { return MayMeet(other, half); });
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

/// Replace hulls by parts, face by face. The volume of a part is inside that of its hull. An empty
/// intersection therefore stays empty, and the basis of the hulls stays valid.
void FocusCellFinder::Refine(const QuadrupleCandidate& candidate, std::size_t position,
                             const FocusPiece& piece, std::vector<FocusPiece>& pieces) {
  if (position == piece.halves.size()) {
    pieces.push_back(piece);
    return;
  }
  const FaceIndex face = candidate.faces[position];
  const PartIndex first = parts_.first[face];
  const PartIndex end = parts_.first[face + 1];
  for (PartIndex part = first; part < end; ++part) {
    FocusPiece finer = piece;
    finer.halves[position] = HalfOf(part, IsInner(piece.halves[position]));
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

std::vector<UnionVolume> FocusCellFinder::VolumesOf(const FocusPiece& piece, double tangent) const {
  std::vector<UnionVolume> volumes;
  for (const HalfIndex half : piece.halves) volumes.push_back(VolumeOf(half, tangent));
  return volumes;
}

MinMaxResult FocusCellFinder::MeetAcrossFace(double tangent, const FocusPiece& a,
                                             std::size_t changed, MinMax::Until until) {
  std::vector<UnionVolume> common = VolumesOf(a, tangent);
  common.erase(common.begin() + static_cast<std::ptrdiff_t>(changed));
  const FacePart& part = PartOf(a.halves[changed]);
  min_max_.Restart();
  return min_max_.Solve([&](const Vector3d& x) { return LargestOnPart(common, part, x); }, until);
}

std::optional<FocusCellFinder::Junction> FocusCellFinder::FindJunction(double tangent,
                                                                       const FocusPiece& a,
                                                                       const FocusPiece& b,
                                                                       MinMax::Until until) {
  const auto changed = ChangedHalf(a, b);
  if (!changed) return std::nullopt;
  const HalfIndex half = a.halves[*changed];
  const HalfIndex other = b.halves[*changed];
  if (PartNumber(half) == PartNumber(other)) {
    const MinMaxResult result = MeetAcrossFace(tangent, a, *changed, until);
    if (!Decide(result, a.halves)) return std::nullopt;
    const FacePart& part = PartOf(half);
    const Vector3d on_face = result.point - part.HeightOf(result.point) * part.normal;
    return Junction{on_face, *changed, on_face};
  }
  if (IsInner(half) != IsInner(other)) return std::nullopt;
  for (const JoinedPart& joined : joined_[PartNumber(half)]) {
    if (joined.other != PartNumber(other)) continue;
    const FacePart& segment = parts_.joints[joined.joint].segment;
    const auto focus = MeetOverJoint(tangent, a, b, *changed, segment, until);
    if (!focus) continue;
    const FacePart::Side& side = segment.sides.front();
    const Vector3d from = segment.PointAt(side.from);
    const Vector3d along = side.along.x() * segment.u + side.along.y() * segment.v;
    const double at = std::clamp(along.dot(*focus - from), 0.0, side.length);
    return Junction{*focus, *changed, from + at * along};
  }
  return std::nullopt;
}

/// Find a focus point of a piece that sees a given segment instead of its part; the segment is the
/// joint with another part.
std::optional<Vector3d> FocusCellFinder::MeetOverJoint(double tangent, const FocusPiece& a,
                                                       const FocusPiece& b, std::size_t changed,
                                                       const FacePart& segment,
                                                       MinMax::Until until) {
  const UnionVolume seeing(segment, IsInner(a.halves[changed]), tangent);
  for (const FocusPiece* piece : {&a, &b}) {
    if (until == MinMax::Until::kMinimum) break;
    if (seeing.At(piece->point) < -min_max_.rounding()) return piece->point;
  }
  std::vector<UnionVolume> volumes = VolumesOf(a, tangent);
  volumes[changed] = seeing;
  // The volume of a segment is inside that of its part, so the basis is valid.
  min_max_.Resume(a.basis);
  const MinMaxResult result = min_max_.Solve(volumes, until);
  if (!Decide(result, a.halves)) return std::nullopt;
  return result.point;
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
  const std::size_t own_a = OwnPosition(a, b);
  const std::size_t own_b = OwnPosition(b, a);
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
      // All volumes of the piece with the narrower cones are among the five, so its point and basis
      // are valid.
      if (a.tangent == narrower && volumes[0].At(of_a.point) < 0) return true;
      if (b.tangent == narrower && volumes[1].At(of_b.point) < 0) return true;
      min_max_.Resume(a.tangent == narrower ? of_a.basis : of_b.basis);
      if (Decide(min_max_.Solve(volumes, MinMax::Until::kSign), of_a.halves)) return true;
    }
  }
  return false;
}

}  // namespace regrasp::polyhedron
