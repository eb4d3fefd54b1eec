#include "planner/sets/polyhedron/focus_geometry.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>

namespace regrasp::polyhedron {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Contacts are looked for at so many places on the way from the part's point nearest to the foot
/// of the focus point towards the middle of the part, as far as the cone reaches.
constexpr int kContactSteps = 16;

/// A contact this far outside a part, over the diameter, is on it.
constexpr double kOnPart = object::kPointTolerance;

/// Random focus points: steps of a walk (Smith 1984), and halvings to find where a step must end.
constexpr int kWalkSteps = 8;
constexpr int kHalvings = 30;

/// Random contacts tried on a face before the one that suits the focus point best is taken.
constexpr int kContactDraws = 20;

using Shape = UnionVolume::Shape;

Vector2d FootOn(const Shape& shape, const Vector3d& x) {
  const Vector3d from_origin = x - shape.origin;
  return {shape.u.dot(from_origin), shape.v.dot(from_origin)};
}

Vector3d Lift(const Shape& shape, const Vector2d& y) {
  return shape.origin + y.x() * shape.u + y.y() * shape.v;
}

/// How far inside a part a point of its plane is; negative outside.
double DepthIn(const Shape& shape, const Vector2d& y) {
  double depth = std::numeric_limits<double>::infinity();
  for (const Shape::Side& side : shape.sides) {
    depth = std::min(depth, -side.outward.dot(y - side.from));
  }
  return depth;
}

Vector2d MiddleOf(const Shape& shape) {
  Vector2d sum = Vector2d::Zero();
  for (const Shape::Side& side : shape.sides) sum += side.from;
  return sum / static_cast<double>(shape.sides.size());
}

/// The point of a part nearest to a point of its plane.
Vector2d NearestOn(const Shape& shape, const Vector2d& y) {
  if (DepthIn(shape, y) >= 0) return y;
  Vector2d nearest = y;
  double least = std::numeric_limits<double>::infinity();
  for (const Shape::Side& side : shape.sides) {
    const double along = std::clamp(side.along.dot(y - side.from), 0.0, side.length);
    const Vector2d candidate = side.from + along * side.along;
    const double distance = (y - candidate).norm();
    if (distance >= least) continue;
    least = distance;
    nearest = candidate;
  }
  return nearest;
}

/// The share of the way from a point to another, both of a part's plane, at which it leaves the
/// circle about `centre`; at most 1, 0 from a point outside.
double ShareInside(const Vector2d& from, const Vector2d& to, const Vector2d& centre,
                   double radius) {
  const double a = (to - from).squaredNorm();
  const double b = (to - from).dot(from - centre);
  const double c = (from - centre).squaredNorm() - radius * radius;
  if (c >= 0) return 0;
  const double root = std::sqrt(b * b - a * c);
  if (root - b >= a) return 1;
  // Of the two forms of the larger root the one without cancellation.
  return b > 0 ? -c / (b + root) : (root - b) / a;
}

/// The position of a face among a cell's, 4 where it has another.
std::size_t PositionOf(const FocusCell& cell, int face) {
  return static_cast<std::size_t>(std::ranges::find(cell.faces, face) - cell.faces.begin());
}

/// The position of the face that the other cell does not have.
std::size_t OwnFace(const FocusCell& cell, const FocusCell& other) {
  std::size_t own = 0;
  while (own < 3 && PositionOf(other, cell.faces[own]) < 4) ++own;
  return own;
}

}  // namespace

grasp::Grasp FocusGeometry::GraspOf(const FocusGrasp& grasp) const {
  const FocusCell& cell = graph_.cells()[grasp.cell];
  grasp::Grasp contacts;
  for (std::size_t k = 0; k < cell.faces.size(); ++k) {
    const FaceIndex face(cell.faces[k]);
    contacts.push_back({grasp.points[k], solid_.inward_normal(face), face});
  }
  return contacts;
}

double FocusGeometry::WidthOf(int cell) {
  const auto [known, is_new] = widths_.try_emplace(cell, 0);
  if (!is_new) return known->second;
  const FocusCell& c = graph_.cells()[cell];
  for (const FocusPiece& piece : c.pieces) {
    std::vector<UnionVolume> volumes;
    for (const int half : piece.halves)
      volumes.push_back(graph_.finder().VolumeOf(half, c.tangent));
    if (const auto deepest = graph_.finder().FindDeepest(volumes, &piece)) {
      known->second = std::max(known->second, -deepest->value);
    }
  }
  return known->second;
}

bool FocusGeometry::ContainsContact(int half, const Vector3d& contact) const {
  const Shape& shape = graph_.finder().ShapeOf(half);
  return DepthIn(shape, FootOn(shape, contact)) >= -kOnPart * solid_.diameter();
}

std::vector<FocusGrasp> FocusGeometry::Locate(const grasp::Grasp& grasp) {
  std::vector<grasp::Contact> contacts = grasp;
  std::ranges::sort(contacts, {}, &grasp::Contact::face);
  std::array<int, 4> faces;
  for (std::size_t k = 0; k < faces.size(); ++k) faces[k] = contacts[k].face;
  std::vector<FocusGrasp> located;
  const auto cells = std::ranges::equal_range(graph_.cells(), faces, {}, &FocusCell::faces);
  for (auto it = cells.begin(); it != cells.end(); ++it) {
    std::optional<FocusGrasp> best;
    double least = 0;
    for (std::size_t p = 0; p < it->pieces.size(); ++p) {
      std::vector<Shape> shapes;
      shapes.reserve(faces.size());
      std::vector<UnionVolume> volumes;
      for (std::size_t k = 0; k < faces.size(); ++k) {
        const int half = it->pieces[p].halves[k];
        if (!ContainsContact(half, contacts[k].p)) break;
        shapes.emplace_back(graph_.finder().parts().parts[half / 2], contacts[k].p);
        volumes.emplace_back(shapes.back(), half % 2 == 0, it->tangent);
      }
      if (volumes.size() < faces.size()) continue;
      const auto deepest = graph_.finder().FindDeepest(volumes);
      if (!deepest || deepest->value >= least) continue;
      least = deepest->value;
      best = {static_cast<int>(it - graph_.cells().begin()),
              static_cast<int>(p),
              deepest->point,
              {contacts[0].p, contacts[1].p, contacts[2].p, contacts[3].p}};
    }
    if (best) located.push_back(*best);
  }
  return located;
}

/// Well inside the cone at the focus point and well inside the part, by the smaller of the two.
Vector3d FocusGeometry::ContactFor(int half, double tangent, const Vector3d& focus) const {
  const Shape& shape = graph_.finder().ShapeOf(half);
  const Vector2d foot = FootOn(shape, focus);
  const double radius = std::abs(shape.normal.dot(focus - shape.origin)) * tangent;
  const Vector2d nearest = NearestOn(shape, foot);
  const Vector2d middle = MiddleOf(shape);
  const Vector2d way = ShareInside(nearest, middle, foot, radius) * (middle - nearest);
  Vector2d best = nearest;
  double most = -std::numeric_limits<double>::infinity();
  for (int step = 0; step <= kContactSteps; ++step) {
    const Vector2d y = nearest + static_cast<double>(step) / kContactSteps * way;
    const double room = std::min(radius - (y - foot).norm(), DepthIn(shape, y));
    if (room <= most) continue;
    most = room;
    best = y;
  }
  return Lift(shape, best);
}

std::optional<FocusSwitch> FocusGeometry::FindSwitch(int from, int to) {
  const FocusCell& a = graph_.cells()[from];
  const FocusCell& b = graph_.cells()[to];
  const std::size_t own_a = OwnFace(a, b);
  const std::size_t own_b = OwnFace(b, a);
  const double narrower = std::min(a.tangent, b.tangent);
  std::optional<FocusSwitch> best;
  double least = 0;
  std::array<std::size_t, 4> position_in_b;
  for (std::size_t k = 0; k < 4; ++k) position_in_b[k] = PositionOf(b, a.faces[k]);
  std::vector<UnionVolume> volumes;
  for (std::size_t p = 0; p < a.pieces.size(); ++p) {
    for (std::size_t q = 0; q < b.pieces.size(); ++q) {
      const auto& of_a = a.pieces[p].halves;
      const auto& of_b = b.pieces[q].halves;
      volumes.assign({graph_.finder().VolumeOf(of_a[own_a], a.tangent),
                      graph_.finder().VolumeOf(of_b[own_b], b.tangent)});
      for (std::size_t k = 0; k < of_a.size(); ++k) {
        if (k == own_a) continue;
        if (of_b[position_in_b[k]] != of_a[k]) break;
        volumes.push_back(graph_.finder().VolumeOf(of_a[k], narrower));
      }
      if (volumes.size() < 5) continue;
      // The narrower cell's own volumes are all among the five.
      const FocusPiece& known = a.tangent == narrower ? a.pieces[p] : b.pieces[q];
      const auto deepest = graph_.finder().FindDeepest(volumes, &known);
      if (!deepest || deepest->value >= least) continue;
      least = deepest->value;
      FocusSwitch found;
      found.before = {from, static_cast<int>(p), deepest->point};
      found.after = {to, static_cast<int>(q), deepest->point};
      for (std::size_t k = 0; k < of_a.size(); ++k) {
        const double tangent = k == own_a ? a.tangent : narrower;
        found.before.points[k] = ContactFor(of_a[k], tangent, deepest->point);
        if (k != own_a) found.after.points[PositionOf(b, a.faces[k])] = found.before.points[k];
      }
      found.after.points[own_b] = ContactFor(of_b[own_b], b.tangent, deepest->point);
      best = found;
    }
  }
  return best;
}

/// A grasp of a cell that has the contacts of a given one on their common faces.
std::optional<FocusGrasp> FocusGeometry::Complete(const FocusGrasp& given, int cell) {
  const FocusCell& a = graph_.cells()[given.cell];
  const FocusCell& b = graph_.cells()[cell];
  const std::size_t own = OwnFace(b, a);
  std::optional<FocusGrasp> best;
  double least = 0;
  for (std::size_t q = 0; q < b.pieces.size(); ++q) {
    const auto& halves = b.pieces[q].halves;
    std::vector<Shape> shapes;
    shapes.reserve(halves.size());
    std::vector<UnionVolume> volumes = {graph_.finder().VolumeOf(halves[own], b.tangent)};
    FocusGrasp completed = {cell, static_cast<int>(q)};
    for (std::size_t k = 0; k < halves.size(); ++k) {
      if (k == own) continue;
      completed.points[k] = given.points[PositionOf(a, b.faces[k])];
      if (!ContainsContact(halves[k], completed.points[k])) break;
      shapes.emplace_back(graph_.finder().parts().parts[halves[k] / 2], completed.points[k]);
      volumes.emplace_back(shapes.back(), halves[k] % 2 == 0, b.tangent);
    }
    if (volumes.size() < halves.size()) continue;
    const auto deepest = graph_.finder().FindDeepest(volumes);
    if (!deepest || deepest->value >= least) continue;
    least = deepest->value;
    completed.focus = deepest->point;
    completed.points[own] = ContactFor(halves[own], b.tangent, deepest->point);
    best = completed;
  }
  return best;
}

std::optional<FocusSwitch> FocusGeometry::FindSwitchFrom(const FocusGrasp& before, int to) {
  const auto after = Complete(before, to);
  if (!after) return std::nullopt;
  return FocusSwitch{before, *after};
}

std::optional<FocusSwitch> FocusGeometry::FindSwitchTo(int from, const FocusGrasp& after) {
  const auto before = Complete(after, from);
  if (!before) return std::nullopt;
  return FocusSwitch{*before, after};
}

std::optional<FocusSwitch> FocusGeometry::FindSwitchBetween(const FocusGrasp& before,
                                                            const FocusGrasp& after) const {
  const FocusCell& a = graph_.cells()[before.cell];
  const FocusCell& b = graph_.cells()[after.cell];
  int common = 0;
  for (std::size_t k = 0; k < a.faces.size(); ++k) {
    const std::size_t other = PositionOf(b, a.faces[k]);
    if (other < 4 && before.points[k] == after.points[other]) ++common;
  }
  if (common != 3) return std::nullopt;
  return FocusSwitch{before, after};
}

std::vector<FocusGrasp> FocusGeometry::FindRoute(const FocusGrasp& from, const FocusGrasp& to) {
  const FocusCell& cell = graph_.cells()[from.cell];
  const int count = static_cast<int>(cell.pieces.size());
  std::vector<int> previous(count, -1);
  std::vector<FocusGrasp> junctions(count);  // through which each piece was reached
  std::deque<int> queue = {from.piece};
  previous[from.piece] = from.piece;
  while (!queue.empty() && previous[to.piece] < 0) {
    const int piece = queue.front();
    queue.pop_front();
    for (int next = 0; next < count; ++next) {
      if (previous[next] >= 0) continue;
      const FocusPiece& a = cell.pieces[piece];
      const auto junction = graph_.finder().FindJunction(cell.tangent, a, cell.pieces[next]);
      if (!junction) continue;
      previous[next] = piece;
      FocusGrasp& grasp = junctions[next];
      grasp = {from.cell, next, junction->focus};
      for (std::size_t k = 0; k < a.halves.size(); ++k) {
        grasp.points[k] = k == junction->changed
                              ? junction->contact
                              : ContactFor(a.halves[k], cell.tangent, junction->focus);
      }
      queue.push_back(next);
    }
  }
  std::vector<FocusGrasp> route = {to};
  for (int piece = to.piece; piece != from.piece; piece = previous[piece]) {
    if (previous[piece] < 0) return {};
    route.push_back(junctions[piece]);
  }
  route.push_back(from);
  std::reverse(route.begin(), route.end());
  return route;
}

std::optional<FocusGrasp> FocusGeometry::Draw(int cell, RandomStream& random) {
  const FocusCell& c = graph_.cells()[cell];
  const int piece = static_cast<int>(random.Index(c.pieces.size()));
  const auto& halves = c.pieces[piece].halves;
  std::vector<UnionVolume> volumes;
  for (const int half : halves) volumes.push_back(graph_.finder().VolumeOf(half, c.tangent));
  const auto is_inside = [&](const Vector3d& x) {
    return std::ranges::all_of(volumes, [&](const UnionVolume& v) { return v.At(x) < 0; });
  };
  const auto normal = [&] {  // one number of a direction drawn evenly (Box and Muller 1958)
    const double radius = std::sqrt(-2 * std::log(1 - random.Uniform()));
    return radius * std::cos(2 * std::numbers::pi * random.Uniform());
  };
  FocusGrasp grasp = {cell, piece, c.pieces[piece].point};
  for (int step = 0; step < kWalkSteps; ++step) {
    const Vector3d direction = Vector3d(normal(), normal(), normal()).normalized();
    const auto reach = [&](double sign) {
      double inside = 0, outside = solid_.diameter();
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = (inside + outside) / 2;
        (is_inside(grasp.focus + sign * middle * direction) ? inside : outside) = middle;
      }
      return inside;
    };
    const double forward = reach(1);
    const double backward = reach(-1);
    grasp.focus += (random.Uniform() * (forward + backward) - backward) * direction;
  }
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const Shape& shape = graph_.finder().ShapeOf(halves[k]);
    const Vector2d foot = FootOn(shape, grasp.focus);
    const double radius = std::abs(shape.normal.dot(grasp.focus - shape.origin)) * c.tangent;
    grasp.points[k] = ContactFor(halves[k], c.tangent, grasp.focus);
    for (int draw = 0; draw < kContactDraws; ++draw) {
      const double r = radius * std::sqrt(random.Uniform());
      const double angle = 2 * std::numbers::pi * random.Uniform();
      const Vector2d y = foot + r * Vector2d(std::cos(angle), std::sin(angle));
      if (DepthIn(shape, y) <= 0) continue;
      grasp.points[k] = Lift(shape, y);
      break;
    }
  }
  return grasp;
}

}  // namespace regrasp::polyhedron
