#include "planner/plan/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "planner/base/in_blocks.h"
#include "planner/base/number.h"
#include "planner/grasp/required_friction_angle.h"
#include "planner/plan/check_step.h"
#include "planner/plan/plan.h"

namespace regrasp::plan {

namespace {

/// Distance in diameters from which points are moved nearer to the object, since points may be
/// anywhere.
constexpr double kFarthest = 1e6;

void ProjectAll(const object::Object& object, FingerGrasp& grasp) {
  for (FingerContact& held : grasp) held.contact = ProjectContact(object, held.contact).contact;
}

/// Largest difference of normals that are equal up to rounding. If they differed, the contact would
/// turn between two states, without a direction.
constexpr double kSameNormal = 1e-9;

/// Set the faces of rolled contacts. Points and normals stay as they are, because the fingertips
/// are at them to a micrometre; only normals that are equal up to rounding become equal. Contacts
/// on edges have no face.
void LocateRolled(const object::Object& object, std::vector<FingerGrasp>& states) {
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (FingerContact& held : states[i]) {
      held.contact.face = ProjectContact(object, held.contact).contact.face;
      const FingerContact* last = i == 0 ? nullptr : FindFinger(states[i - 1], held.finger);
      if (last != nullptr && (held.contact.n - last->contact.n).norm() < kSameNormal) {
        held.contact.n = last->contact.n;
      }
    }
  }
}

bool IsUnit(const Eigen::Vector3d& normal) {
  return std::abs(normal.norm() - 1) <= kNormalLengthTolerance;
}

/// Return the angles between the contact's normal and those of faces near it, nearest first.
std::vector<std::pair<double, FaceIndex>> RankFaces(const std::vector<FaceIndex>& faces,
                                                    const object::Object& object,
                                                    const grasp::Contact& contact) {
  std::vector<std::pair<double, FaceIndex>> ranked;
  for (const FaceIndex face : faces) {
    ranked.emplace_back(grasp::AngleBetween(contact.n, object.inward_normal(face)), face);
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<double, FaceIndex>::first);
  return ranked;
}

grasp::Contact Project(const object::Object& object, const grasp::Contact& contact,
                       FaceIndex face) {
  return {object.ClosestPoint(face, contact.p), object.inward_normal(face), face};
}

/// Return the distance of a point to the surface.
/// Most points are near the surface; only other points require a search of all faces.
double DistanceToSurface(const object::Object& object, const Eigen::Vector3d& p) {
  constexpr double kNear = 0.05;
  for (double radius = 0.0125; radius <= kNear; radius *= 2) {
    const std::vector<FaceIndex> near = object.FacesNear(p, radius * object.diameter());
    if (!near.empty()) return (object.ClosestPoint(near.front(), p) - p).norm();
  }
  double least = std::numeric_limits<double>::infinity();
  for (FaceIndex face{0}; face < object.face_count(); ++face) {
    least = std::min(least, (object.ClosestPoint(face, p) - p).norm());
  }
  return least;
}

}  // namespace

std::string VectorText(const Eigen::Vector3d& v, int dimension) {
  std::string text = "(";
  for (int k = 0; k < dimension; ++k) text += (k == 0 ? "" : ", ") + FormatShort(v[k]);
  return text + ")";
}

ProjectedContact ProjectContact(const object::Object& object, const grasp::Contact& contact) {
  ProjectedContact projected{{contact.p, contact.n}, Reason::kNone, ""};
  const std::vector<FaceIndex> faces = object.FacesNear(contact.p, SurfaceTolerance(object));
  if (faces.empty()) {
    projected.reason = Reason::kOffSurface;
    return projected;
  }
  if (!IsUnit(contact.n)) {
    projected.reason = Reason::kWrongNormal;
    projected.detail = "the normal must have length 1, found " + FormatShort(contact.n.norm());
    return projected;
  }
  const auto [least, nearest] = RankFaces(faces, object, contact).front();
  if (!(least <= kNormalTolerance)) {
    projected.reason = Reason::kWrongNormal;
    projected.detail = "the normal differs by " + FormatDegrees(Degrees(least)) +
                       " from the inward normal of face " + std::to_string(nearest);
    return projected;
  }
  projected.contact = Project(object, contact, nearest);
  return projected;
}

grasp::Contact NearestContact(const object::Object& object, const grasp::Contact& contact) {
  const Eigen::Vector3d& centre = object.mass_properties().centroid;
  const Eigen::Vector3d away = contact.p - centre;
  // The nearest surface point is the same from farther away, and squares of distances stay finite.
  const double most = kFarthest * object.diameter();
  const double distance = away.stableNorm();
  const Eigen::Vector3d p = distance <= most ? contact.p : centre + away * (most / distance);
  const double least = DistanceToSurface(object, p);
  const grasp::Contact near = {p, contact.n.stableNormalized()};
  const double tolerance = object::kPointTolerance * object.diameter();
  return Project(object, near,
                 RankFaces(object.FacesNear(p, least + tolerance), object, near).front().second);
}

std::vector<grasp::Contact> ProjectOnAllFaces(const object::Object& object,
                                              const grasp::Contact& contact) {
  std::vector<grasp::Contact> places;
  if (!IsUnit(contact.n)) return places;
  const std::vector<FaceIndex> faces = object.FacesNear(contact.p, SurfaceTolerance(object));
  for (const auto& [angle, face] : RankFaces(faces, object, contact)) {
    if (angle <= kNormalTolerance) places.push_back(Project(object, contact, face));
  }
  return places;
}

Plan ProjectPlan(const object::Object& object, const Plan& plan) {
  Plan projected = plan;
  ProjectAll(object, projected.initial);
  for (Step& step : projected.steps) {
    if (auto* finger_switch = std::get_if<Switch>(&step)) {
      ProjectAll(object, finger_switch->place);
    } else if (auto* align = std::get_if<Align>(&step)) {
      ProjectAlign(object, *align);
    } else {
      LocateRolled(object, std::get<Move>(step).contacts);
    }
  }
  for (grasp::Contact& contact : projected.goal) contact = ProjectContact(object, contact).contact;
  SetTorsion(plan.torsion, projected);
  return projected;
}

namespace {

/// Largest number of placements of a contact. If that many faces meet almost in one plane, the
/// nearest normals are as good as any.
constexpr std::size_t kMostChoices = 16;

/// Distance over the diameter within which points are equal up to rounding.
constexpr double kRounding = 1e-12;

/// Placement of a contact, and the best path of the finger to it.
struct Choice {
  grasp::Contact place;
  int faults = 0;     ///< number of faults on the best path
  int ranks = 0;      ///< sum of the ranks of the chosen placements
  int previous = -1;  ///< index of the choice at the previous waypoint
};

using Choices = std::vector<Choice>;

Choices FindChoices(const object::Object& object, const grasp::Contact& contact) {
  Choices choices;
  for (const grasp::Contact& place : ProjectOnAllFaces(object, contact)) {
    if (choices.size() == kMostChoices) break;
    choices.push_back({place, 0, static_cast<int>(choices.size())});
  }
  if (choices.empty()) choices.push_back({ProjectContact(object, contact).contact});
  return choices;
}

bool IsFault(const object::Object& object, const grasp::Contact& from, const grasp::Contact& to) {
  return from.face.valid() && to.face.valid() && FindMotionFault(object, from, to).has_value();
}

bool IsBetter(const Choice& a, const Choice& b) {
  return a.faults != b.faults ? a.faults < b.faults : a.ranks < b.ranks;
}

/// Extend the best paths to the previous waypoint by one motion.
void Extend(const object::Object& object, const Choices& before, Choices& choices) {
  for (Choice& choice : choices) {
    Choice best;
    best.faults = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < before.size(); ++i) {
      Choice path = choice;
      path.faults = before[i].faults + IsFault(object, before[i].place, choice.place);
      path.ranks = before[i].ranks + choice.ranks;
      path.previous = static_cast<int>(i);
      if (IsBetter(path, best)) best = path;
    }
    choice = best;
  }
}

/// Merge the two projections of a turning point.
/// A point of an edge has a projection on each of both faces, and rounding may separate them. The
/// finger would then have a tiny motion between them that cannot be proved. It keeps the first
/// projection.
void KeepTurningPoints(const object::Object& object, const std::vector<grasp::Contact*>& chain) {
  for (std::size_t j = 1; j < chain.size(); ++j) {
    const grasp::Contact& before = *chain[j - 1];
    if (!before.face.valid() || !chain[j]->face.valid() || before.face == chain[j]->face) continue;
    if ((before.p - chain[j]->p).norm() <= kRounding * object.diameter()) chain[j]->p = before.p;
  }
}

/// Place the contacts of one finger, in the order of the waypoints.
void ProjectChain(const object::Object& object, const std::vector<grasp::Contact*>& chain) {
  std::vector<Choices> choices;
  for (const grasp::Contact* contact : chain) {
    choices.push_back(FindChoices(object, *contact));
    if (choices.size() > 1) Extend(object, choices[choices.size() - 2], choices.back());
  }
  int chosen =
      static_cast<int>(std::ranges::min_element(choices.back(), IsBetter) - choices.back().begin());
  for (std::size_t j = chain.size(); j-- > 0;) {
    *chain[j] = choices[j][chosen].place;
    chosen = choices[j][chosen].previous;
  }
  KeepTurningPoints(object, chain);
}

}  // namespace

void ProjectAlign(const object::Object& object, Align& align) {
  // A finger that a waypoint names twice, by mistake, counts as two chains.
  std::map<std::pair<FingerIndex, int>, std::vector<grasp::Contact*>> chains;
  for (FingerGrasp& waypoint : align.waypoints) {
    std::map<FingerIndex, int> named;
    for (FingerContact& held : waypoint) {
      chains[{held.finger, named[held.finger]++}].push_back(&held.contact);
    }
  }
  for (const auto& [finger, chain] : chains) ProjectChain(object, chain);
}

namespace {

constexpr std::size_t kBlock = 256;  // grasps per block of work

using Vector = Eigen::Map<Eigen::Vector3d>;

/// Return the contact of a point without a normal; a reason off the surface and on borders.
ProjectedContact ProjectPoint(const object::Object& object, const Eigen::Vector3d& point) {
  const double tolerance = SurfaceTolerance(object);
  const std::vector<FaceIndex> faces = object.FacesNear(point, tolerance);
  if (faces.empty()) return {{point, {}}, Reason::kOffSurface, ""};
  const FaceIndex face = faces.front();
  if (faces.size() > 1 || object.DistanceToBorder(face, point) <= tolerance) {
    return {{point, {}}, Reason::kWrongNormal, ""};
  }
  return {{object.ClosestPoint(face, point), object.inward_normal(face), face}, Reason::kNone, ""};
}

bool Coincide(std::span<const double> points, double tolerance) {
  for (std::size_t i = 0; i < points.size(); i += 3) {
    for (std::size_t j = 0; j < i; j += 3) {
      const auto apart = Eigen::Vector3d::Map(&points[i]) - Eigen::Vector3d::Map(&points[j]);
      if (apart.norm() <= tolerance) return true;
    }
  }
  return false;
}

}  // namespace

ProjectedGrasps ProjectGrasps(const object::Object& object, std::span<const double> points,
                              std::span<const double> normals, int contacts, int threads) {
  const bool has_normals = !normals.empty();
  if (contacts < 1 || points.size() % (3 * static_cast<std::size_t>(contacts)) != 0 ||
      (has_normals && normals.size() != points.size())) {
    throw std::invalid_argument(std::to_string(points.size()) + " and " +
                                std::to_string(normals.size()) + " values for grasps of " +
                                std::to_string(contacts) + " contacts");
  }
  const auto k = static_cast<std::size_t>(contacts);
  const double tolerance = object::kPointTolerance * object.diameter();
  ProjectedGrasps projected;
  projected.points.assign(points.begin(), points.end());
  projected.normals.assign(normals.begin(), normals.end());
  projected.normals.resize(points.size());
  projected.reasons.resize(points.size() / (3 * k));
  projected.contacts.resize(projected.reasons.size(), -1);
  InBlocks(projected.reasons.size(), kBlock, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t grasp = begin; grasp < end; ++grasp) {
      for (std::size_t c = 0; c < k && projected.reasons[grasp] == Reason::kNone; ++c) {
        const std::size_t at = 3 * (grasp * k + c);
        Vector p(&projected.points[at]), n(&projected.normals[at]);
        const ProjectedContact found =
            has_normals ? ProjectContact(object, {p, n}) : ProjectPoint(object, p);
        projected.reasons[grasp] = found.reason;
        p = found.contact.p;
        n = found.contact.n;
        if (found.reason == Reason::kNone && object.IsEnclosed(found.contact.face)) {
          projected.reasons[grasp] = Reason::kUnreachable;
        }
        if (projected.reasons[grasp] != Reason::kNone)
          projected.contacts[grasp] = static_cast<int>(c);
      }
      const auto own = std::span(projected.points).subspan(3 * grasp * k, 3 * k);
      if (projected.reasons[grasp] == Reason::kNone && Coincide(own, tolerance)) {
        projected.reasons[grasp] = Reason::kCoincidentFingers;
      }
    }
  });
  return projected;
}

double SurfaceTolerance(const object::Object& object) {
  const double diameter = object.diameter();
  const double largest = object.mass_properties().centroid.lpNorm<Eigen::Infinity>() + diameter;
  const double lost =
      kSinglePrecisionSteps * double{std::numeric_limits<float>::epsilon()} * largest;
  return std::max(object::kPointTolerance * diameter,
                  std::min(lost, kLargestPointTolerance * diameter));
}

std::string OffSurfaceText(const object::Object& object, const Eigen::Vector3d& point) {
  const double distance =
      (NearestContact(object, {point, Eigen::Vector3d::Zero()}).p - point).stableNorm();
  const double tolerance = SurfaceTolerance(object);
  const bool single = tolerance > object::kPointTolerance * object.diameter();
  constexpr int kDigits = 4;
  const auto percent = [&](double length) {
    return FormatPlain(100 * length / object.diameter(), kDigits) + " %";
  };
  return "off the surface, expected at most " + percent(tolerance) + " of the object's diameter" +
         (single ? " (the precision of float32 at this distance from the origin)" : "") +
         ", found " + percent(distance) + " (" + FormatPlain(distance, kDigits) +
         " in the object file's unit)";
}

namespace {

bool Has(const std::vector<FingerIndex>& fingers, FingerIndex finger) {
  return std::ranges::find(fingers, finger) != fingers.end();
}

FingerGrasp GraspBefore(const Plan& plan, int entry) {
  FingerGrasp grasp = plan.initial;
  for (int step = 1; step < entry; ++step) grasp = GraspAfter(grasp, plan.steps[step - 1]);
  return grasp;
}

/// Select the fingers that are drawn.
FingerGrasp Select(FingerGrasp grasp, const Fault& fault) {
  std::ranges::stable_partition(
      grasp, [&](const FingerContact& held) { return Has(fault.fingers, held.finger); });
  if (std::ssize(grasp) > kMostDrawnFingers) grasp.resize(kMostDrawnFingers);
  return grasp;
}

FingerState StateOf(const FingerContact& held, FingerRole role) {
  return {held.finger, role, held.contact.p, held.contact.p, held.contact.n};
}

std::vector<FingerState> DuringSwitch(const FingerGrasp& before, const Switch& step,
                                      const Fault& fault) {
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(before, fault)) {
    const bool released = Has(step.release, held.finger);
    states.push_back(StateOf(held, released ? FingerRole::kReleased : FingerRole::kHolding));
  }
  for (const FingerContact& placed : Select(step.place, fault)) {
    states.push_back(StateOf(placed, FingerRole::kPlaced));
  }
  return states;
}

/// Return the state of a finger on its path from the first waypoint to `waypoint`.
FingerState OnItsWay(const FingerContact& held, const std::vector<FingerGrasp>& waypoints,
                     int waypoint) {
  FingerState state = StateOf(held, FingerRole::kMoved);
  for (int w = 0; w <= waypoint; ++w) {
    const FingerContact* there = FindFinger(waypoints[w], held.finger);
    if (there != nullptr) state.path_W.push_back(there->contact.p);
  }
  state.path_W.push_back(held.contact.p);
  if (state.path_W.front() != state.path_W.back()) return state;
  return StateOf(held, FingerRole::kHolding);
}

/// Return the states of fingers that slide or roll along the surface.
std::vector<FingerState> AlongSurface(const FingerGrasp& before,
                                      const std::vector<FingerGrasp>& waypoints,
                                      const Fault& fault) {
  const int last = static_cast<int>(waypoints.size()) - 1;
  const int waypoint = fault.waypoint < 0 ? last : std::min(fault.waypoint, last);
  const FingerGrasp& planned = last < 0 ? before : waypoints[waypoint];
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(fault.grasp.empty() ? planned : fault.grasp, fault)) {
    states.push_back(OnItsWay(held, waypoints, waypoint));
  }
  return states;
}

std::vector<FingerState> AtHold(const FingerGrasp& grasp, const Fault& fault) {
  std::vector<FingerState> states;
  for (const FingerContact& held : Select(grasp, fault)) {
    states.push_back(StateOf(held, FingerRole::kHolding));
  }
  return states;
}

std::vector<FingerState> DuringEntry(const Plan& plan, int entry, const Fault& fault) {
  if (entry == 0) return AtHold(plan.initial, fault);
  const Step& step = plan.steps[entry - 1];
  const FingerGrasp before = GraspBefore(plan, entry);
  if (const auto* change = std::get_if<Switch>(&step)) return DuringSwitch(before, *change, fault);
  if (const auto* align = std::get_if<Align>(&step)) {
    return AlongSurface(before, align->waypoints, fault);
  }
  return AlongSurface(before, std::get<Move>(step).contacts, fault);
}

}  // namespace

Snapshot MakePlannedSnapshot(const Plan& projected, int entry, const Fault& fault,
                             double fingertip_radius_m) {
  Snapshot snapshot;
  snapshot.fingertip_radius_m = fingertip_radius_m;
  snapshot.fingers = DuringEntry(projected, entry, fault);
  for (FingerState& state : snapshot.fingers) {
    state.contact_W *= projected.scale;
    state.tip_W = state.contact_W - fingertip_radius_m * state.normal_W;
    for (Eigen::Vector3d& p : state.path_W) p *= projected.scale;
  }
  return snapshot;
}

}  // namespace regrasp::plan
