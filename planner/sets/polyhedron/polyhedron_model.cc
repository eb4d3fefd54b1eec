#include "planner/sets/polyhedron/polyhedron_model.h"

#include <algorithm>

#include "planner/sets/candidate_search.h"
#include "planner/sets/polyhedron/face_part.h"
#include "planner/sets/set_graph.h"

namespace regrasp::polyhedron {

using Eigen::Vector3d;

using sets::PieceIndex;
using sets::SetIndex;

namespace {

/// Largest distance of a contact from its part, divided by the diameter.
constexpr double kOnPart = object::kPointTolerance;

/// Random focus points: number of steps of a walk (Smith 1984), and of bisections for the end of a
/// step.
constexpr int kWalkSteps = 8;
constexpr int kHalvings = 30;

}  // namespace

double PolyhedronModel::WidthOf(SetIndex cell) {
  const auto [known, is_new] = widths_.try_emplace(cell, 0);
  if (!is_new) return known->second;
  const FocusCell& c = graph_.cells()[cell];
  for (const FocusPiece& piece : c.pieces) {
    const auto volumes = graph_.finder().VolumesOf(piece, c.tangent);
    if (const auto deepest = graph_.finder().FindDeepest(volumes, &piece)) {
      known->second = std::max(known->second, -deepest->value);
    }
  }
  return known->second;
}

grasp::Grasp PolyhedronModel::GraspOf(const Place& place) const {
  const FocusCell& cell = graph_.cells()[place.cell];
  grasp::Grasp contacts;
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const FaceIndex face = cell.faces[k];
    contacts.push_back({place.points[k], solid_.inward_normal(face), face});
  }
  return contacts;
}

PolyhedronModel::Attachments PolyhedronModel::Attach(const grasp::Grasp& grasp) {
  std::vector<grasp::Contact> sorted = grasp;
  std::ranges::sort(sorted, {}, &grasp::Contact::face);
  FaceQuadruple faces;
  GivenContacts contacts;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    faces[k] = sorted[k].face;
    contacts[k] = sorted[k].p;
  }
  Attachments attachments;
  const auto cells = std::ranges::equal_range(graph_.cells(), faces, {}, &FocusCell::faces);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    const SetIndex cell(static_cast<int>(it - graph_.cells().begin()));
    if (const auto place = FindDeepest(cell, contacts)) attachments.push_back({cell, *place});
  }
  return attachments;
}

std::string PolyhedronModel::WhyUnattached(const grasp::Grasp& /*grasp*/) const {
  if (graph_.vertex_count() == 0) {
    return "four contacts are nowhere concurrent on this object at this friction, and planner "
           "polyhedron supports concurrent grasps only";
  }
  return "in none of the " + std::to_string(graph_.vertex_count()) +
         " focus cells: its four contacts are not concurrent, and planner polyhedron supports "
         "concurrent grasps only";
}

/// Find the grasp of a cell with the given contacts and the deepest focus point.
///
/// The focus point is deepest inside their cones and the volumes of the other faces, which get
/// contacts for it.
std::optional<FocusGrasp> PolyhedronModel::FindDeepest(SetIndex cell,
                                                       const GivenContacts& contacts) {
  const FocusCell& c = graph_.cells()[cell];
  std::optional<Place> best;
  double least = 0;
  for (PieceIndex p{0}; p < std::ssize(c.pieces); ++p) {
    const auto deepest = FindDeepestFocus(c, c.pieces[p], contacts);
    if (!deepest || deepest->value >= least) continue;
    least = deepest->value;
    best = {cell, p, deepest->point};
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      best->points[k] = contacts[k] ? *contacts[k]
                                    : ContactFor(graph_.finder().PartOf(c.pieces[p].halves[k]),
                                                 c.tangent, deepest->point);
    }
  }
  return best;
}

std::optional<MinMaxResult> PolyhedronModel::FindDeepestFocus(const FocusCell& cell,
                                                              const FocusPiece& piece,
                                                              const GivenContacts& contacts) {
  std::vector<UnionVolume> volumes;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!contacts[k]) volumes.push_back(graph_.finder().VolumeOf(piece.halves[k], cell.tangent));
  }
  std::vector<FacePart> points;
  points.reserve(contacts.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (!contacts[k]) continue;
    const FacePart& part = graph_.finder().PartOf(piece.halves[k]);
    if (DepthIn(part, part.FootOf(*contacts[k])) < -kOnPart * solid_.diameter()) {
      return std::nullopt;
    }
    points.push_back(PointPart(part, *contacts[k]));
    volumes.emplace_back(points.back(), IsInner(piece.halves[k]), cell.tangent);
  }
  return graph_.finder().FindDeepest(volumes);
}

std::optional<PolyhedronModel::Switch> PolyhedronModel::FindSwitch(const Ends& ends) {
  if (ends.before == nullptr && ends.after == nullptr) return FindDeepestSwitch(ends.from, ends.to);
  if (ends.before != nullptr && ends.after != nullptr) {
    if (CountCommonContacts(*ends.before, *ends.after) != 3) return std::nullopt;
    return Switch{*ends.before, *ends.after};
  }
  const auto other =
      ends.before != nullptr ? Complete(*ends.before, ends.to) : Complete(*ends.after, ends.from);
  if (!other) return std::nullopt;
  if (ends.before != nullptr) return Switch{*ends.before, *other};
  return Switch{*other, *ends.after};
}

int PolyhedronModel::CountCommonContacts(const Place& a, const Place& b) const {
  const FocusCell& of_a = graph_.cells()[a.cell];
  const FocusCell& of_b = graph_.cells()[b.cell];
  int common = 0;
  for (std::size_t k = 0; k < a.points.size(); ++k) {
    const std::size_t other = PositionOf(of_b, of_a.faces[k]);
    if (other < b.points.size() && a.points[k] == b.points[other]) ++common;
  }
  return common;
}

/// Find a grasp of a cell that shares the contacts on common faces with a given grasp.
std::optional<FocusGrasp> PolyhedronModel::Complete(const Place& given, SetIndex cell) {
  const FocusCell& a = graph_.cells()[given.cell];
  const FocusCell& b = graph_.cells()[cell];
  const std::size_t own = OwnPosition(b, a);
  GivenContacts contacts;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (k != own) contacts[k] = given.points[PositionOf(a, b.faces[k])];
  }
  return FindDeepest(cell, contacts);
}

std::optional<PolyhedronModel::Switch> PolyhedronModel::FindDeepestSwitch(SetIndex from,
                                                                          SetIndex to) {
  FocusCellFinder& finder = graph_.finder();
  const FocusCell& a = graph_.cells()[from];
  const FocusCell& b = graph_.cells()[to];
  const std::size_t own_a = OwnPosition(a, b);
  const std::size_t own_b = OwnPosition(b, a);
  const double narrower = std::min(a.tangent, b.tangent);
  std::array<std::size_t, 4> in_b;
  for (std::size_t k = 0; k < in_b.size(); ++k) in_b[k] = PositionOf(b, a.faces[k]);
  std::optional<Switch> best;
  double least = 0;
  for (PieceIndex p{0}; p < std::ssize(a.pieces); ++p) {
    for (PieceIndex q{0}; q < std::ssize(b.pieces); ++q) {
      const auto& of_a = a.pieces[p].halves;
      const auto& of_b = b.pieces[q].halves;
      std::vector<UnionVolume> volumes = {finder.VolumeOf(of_a[own_a], a.tangent),
                                          finder.VolumeOf(of_b[own_b], b.tangent)};
      for (std::size_t k = 0; k < of_a.size(); ++k) {
        if (k == own_a || of_b[in_b[k]] != of_a[k]) continue;
        volumes.push_back(finder.VolumeOf(of_a[k], narrower));
      }
      if (volumes.size() < 5) continue;
      // All volumes of the narrower cell are among the five, so its basis is valid.
      const FocusPiece& known = a.tangent == narrower ? a.pieces[p] : b.pieces[q];
      const auto deepest = finder.FindDeepest(volumes, &known);
      if (!deepest || deepest->value >= least) continue;
      least = deepest->value;
      best = {{from, p, deepest->point}, {to, q, deepest->point}};
    }
  }
  if (best) PlaceContacts(*best);
  return best;
}

/// Place the contacts of a switch for its focus point; on common faces inside the cones of both
/// cells.
void PolyhedronModel::PlaceContacts(Switch& change) const {
  const FocusCell& a = graph_.cells()[change.before.cell];
  const FocusCell& b = graph_.cells()[change.after.cell];
  const auto contact = [&](const FocusCell& cell, const Place& place, std::size_t k,
                           double tangent) {
    const HalfIndex half = cell.pieces[place.piece].halves[k];
    return ContactFor(graph_.finder().PartOf(half), tangent, place.focus);
  };
  const std::size_t own_a = OwnPosition(a, b);
  const std::size_t own_b = OwnPosition(b, a);
  for (std::size_t k = 0; k < a.faces.size(); ++k) {
    const double tangent = k == own_a ? a.tangent : std::min(a.tangent, b.tangent);
    change.before.points[k] = contact(a, change.before, k, tangent);
    if (k != own_a) change.after.points[PositionOf(b, a.faces[k])] = change.before.points[k];
  }
  change.after.points[own_b] = contact(b, change.after, own_b, b.tangent);
}

std::vector<FocusGrasp> PolyhedronModel::FindRoute(const Place& from, const Place& to) {
  const FocusCell& cell = graph_.cells()[from.cell];
  std::vector<bool> starts(cell.pieces.size()), goals(cell.pieces.size());
  starts[from.piece] = true;
  goals[to.piece] = true;
  const auto junctions = sets::FindPassages<Place>(
      starts, goals, [&](PieceIndex piece, PieceIndex next) -> std::optional<Place> {
        const auto junction =
            graph_.finder().FindJunction(cell.tangent, cell.pieces[piece], cell.pieces[next]);
        if (!junction) return std::nullopt;
        Place place = {from.cell, next, junction->focus};
        for (std::size_t k = 0; k < place.points.size(); ++k) {
          place.points[k] = k == junction->changed
                                ? junction->contact
                                : ContactFor(graph_.finder().PartOf(cell.pieces[next].halves[k]),
                                             cell.tangent, junction->focus);
        }
        return place;
      });
  if (!junctions) return {};
  std::vector<Place> route = {from};
  route.insert(route.end(), junctions->begin(), junctions->end());
  route.push_back(to);
  return route;
}

std::optional<FocusGrasp> PolyhedronModel::Draw(SetIndex cell, RandomStream& random) {
  const FocusCell& c = graph_.cells()[cell];
  const PieceIndex piece(static_cast<int>(random.Index(c.pieces.size())));
  Place place = {cell, piece, DrawFocus(c, c.pieces[piece], random)};
  for (std::size_t k = 0; k < place.points.size(); ++k) {
    const FacePart& part = graph_.finder().PartOf(c.pieces[piece].halves[k]);
    place.points[k] = DrawContact(part, c.tangent, place.focus, random);
  }
  return place;
}

/// Draw a focus point of a piece by hit and run.
Vector3d PolyhedronModel::DrawFocus(const FocusCell& cell, const FocusPiece& piece,
                                    RandomStream& random) const {
  const auto volumes = graph_.finder().VolumesOf(piece, cell.tangent);
  const auto is_inside = [&](const Vector3d& x) {
    return std::ranges::all_of(volumes, [&](const UnionVolume& v) { return v.At(x) < 0; });
  };
  Vector3d focus = piece.point;
  for (int step = 0; step < kWalkSteps; ++step) {
    Vector3d direction;
    for (const int axis : {2, 1, 0}) direction[axis] = sets::DrawNormal(random);
    direction.normalize();
    const auto reach = [&](double sign) {
      double inside = 0, outside = solid_.diameter();
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = (inside + outside) / 2;
        (is_inside(focus + sign * middle * direction) ? inside : outside) = middle;
      }
      return inside;
    };
    const double forward = reach(1);
    const double backward = reach(-1);
    focus += (random.Uniform() * (forward + backward) - backward) * direction;
  }
  return focus;
}

}  // namespace regrasp::polyhedron
