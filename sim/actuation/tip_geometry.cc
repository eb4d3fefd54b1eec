#include "sim/actuation/tip_geometry.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "planner/base/error.h"
#include "planner/kinematics/derive_couplings.h"
#include "planner/kinematics/fit_tip.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {

namespace {

using Eigen::Vector3d;
using kinematics::VectorAt;

/// Largest depth that counts for the contact force, metres: five times that of a static grasp.
/// Fingertip geometry can overlap the object more deeply than its sphere, and must not be ejected.
constexpr double kDeepestContact = 3e-4;
/// Largest depth with TipContactModel::kDefault, whose static grasps are up to 2 mm deep.
constexpr double kDeepestDefaultContact = 4e-3;

/// Return two unit vectors that are perpendicular to a unit vector and to each other.
std::pair<Vector3d, Vector3d> Tangents(const Vector3d& normal) {
  const Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

}  // namespace

mjContact MakeTipContact(const collision::SurfaceContact& touching, const Eigen::Isometry3d& pose,
                         double mu, const HandPhysics& physics) {
  const bool is_stiff = physics.contacts == TipContactModel::kStiff;
  mjContact contact = {};
  contact.dist = std::max(touching.gap, is_stiff ? -kDeepestContact : -kDeepestDefaultContact);
  const Vector3d normal = pose.linear() * touching.outward;
  const Vector3d at = pose * touching.point + contact.dist / 2 * normal;
  const auto [first, second] = Tangents(normal);
  std::copy_n(at.data(), 3, contact.pos);
  std::copy_n(normal.data(), 3, contact.frame);
  std::copy_n(first.data(), 3, contact.frame + 3);
  std::copy_n(second.data(), 3, contact.frame + 6);
  contact.friction[0] = contact.friction[1] = mu;
  contact.friction[2] = contact.friction[3] = contact.friction[4] = mjMINMU;
  if (physics.torsion_m > 0) contact.friction[2] = mu * physics.torsion_m;
  contact.solref[0] = is_stiff ? kTipContactTime : kDefaultTipContactTime;
  contact.solref[1] = 1;
  std::ranges::copy(is_stiff ? kTipImpedance : kDefaultTipImpedance, contact.solimp);
  contact.dim = physics.torsion_m > 0 ? 4 : 3;
  contact.efc_address = -1;  // no force before a step
  return contact;
}

ContactSum SumTipContacts(const mjModel& model, const mjData& data, int object_geom, int tip_geom) {
  ContactSum sum;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.geom1 != object_geom || contact.geom2 != tip_geom) continue;
    mjtNum local[6];
    mj_contactForce(&model, &data, i, local);
    // The engine's force is that on the second geom.
    for (int k = 0; k < 3; ++k) sum.force -= local[k] * VectorAt(contact.frame, k);
    const Vector3d normal = VectorAt(contact.frame, 0);
    sum.pressing += local[0];
    sum.point += local[0] * (VectorAt(contact.pos, 0) - contact.dist / 2 * normal);
    sum.normal += local[0] * normal;
  }
  return sum;
}

namespace {

using collision::SurfaceContact;
using Eigen::Isometry3d;

/// Motion of a fingertip after which its nearby triangles are searched again, metres.
constexpr double kNeighbourhood = 3e-3;
/// Assumed maximum number of contacts of a shape. A sphere has no bound; on smooth bodies it has
/// one or two.
constexpr int kMostOfShape = 2 * collision::kMostContacts;

}  // namespace

TipSurface::TipSurface(const kinematics::HandFile& file, TipShape tip,
                       const object::Polyhedron& solid, double scale)
    : surface_(solid, scale), centroid_(scale * solid.mass_properties().centroid) {
  for (const Vector3d& vertex : solid.vertices()) {
    object_reach_ = std::max(object_reach_, (scale * vertex - centroid_).norm());
  }
  const std::vector<TipShapes> shapes = TipShapesOf(file, tip);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const auto& ball = file.description.tips[i];
    Tip& made = tips_.emplace_back(
        Tip{Shapes(shapes[i].begin(), shapes[i].end()), ball.centre, ball.radius});
    for (const collision::ConvexShape& shape : shapes[i]) {
      for (const Vector3d& point : shape.points) {
        made.reach = std::max(made.reach, (point - made.centre).norm() + shape.radius);
      }
    }
  }
}

int TipSurface::most_contacts() const {
  std::size_t shapes = 0;
  for (const Tip& tip : tips_) shapes += tip.shapes.size();
  return kMostOfShape * static_cast<int>(shapes);
}

void TipSurface::Forget() {
  for (Tip& tip : tips_) tip.triangles.reset();
}

std::vector<SurfaceContact> TipSurface::FindContacts(FingerIndex finger, const Isometry3d& link,
                                                     const Isometry3d& to_object) {
  Tip& tip = tips_[finger];
  const Vector3d centre = to_object * (link * tip.centre);
  tip.nearest.reset();
  const double reach = tip.reach + kNear;
  if ((centre - centroid_).norm() > object_reach_ + reach) return {};
  if (!tip.triangles || (centre - tip.around).norm() > kNeighbourhood) {
    tip.around = centre;
    tip.triangles = surface_.Around(centre, reach + kNeighbourhood);
  }
  Shapes placed = tip.shapes;
  std::vector<SurfaceContact> contacts;
  for (collision::TreeShape& shape : placed) {
    shape.points.Move(link);
    shape.points.Move(to_object);
    const auto found = collision::FindContacts(surface_, shape, *tip.triangles);
    contacts.insert(contacts.end(), found.begin(), found.end());
  }
  const auto deepest = std::ranges::min_element(contacts, {}, &SurfaceContact::gap);
  tip.nearest = deepest != contacts.end() ? std::optional(*deepest) : NearestTo(placed, tip);
  if (tip.nearest) return contacts;
  for (const collision::NearPoint& ball :
       surface_.Find(centre, tip.radius + kNear, *tip.triangles)) {
    tip.nearest = {ball.point, ball.outward, ball.distance - tip.radius};
    break;
  }
  return contacts;
}

std::optional<SurfaceContact> TipSurface::NearestTo(const Shapes& placed, const Tip& tip) const {
  std::optional<SurfaceContact> best;
  for (const collision::TreeShape& shape : placed) {
    const auto near = collision::FindNearest(surface_, shape, shape.radius + kNear, *tip.triangles);
    if (near && (!best || near->gap < best->gap)) best = near;
  }
  return best;
}

std::optional<collision::NearPoint> TipSurface::NearBall(FingerIndex finger,
                                                         const Vector3d& centre) const {
  const auto found = surface_.Find(centre, tips_[finger].radius + kNear);
  return found.empty() ? std::nullopt : std::optional(found.front());
}

namespace {

Eigen::Isometry3d PoseInBody(const mjModel& model, int geom) {
  mjtNum matrix[9];
  mju_quat2Mat(matrix, model.geom_quat + std::ptrdiff_t{4} * geom);
  return kinematics::PoseAt(model.geom_pos + std::ptrdiff_t{3} * geom, matrix, 0);
}

/// Number of directions for the touching points of fingertips. The hull of all points exceeds that
/// of the selected points by less than a thousandth of its size.
constexpr int kManyDirections = 2000;
/// Number of directions for collision shapes; the error is less than half a hundredth.
constexpr int kSomeDirections = 500;

/// Return the points that are farthest in one of `directions` evenly distributed directions.
std::vector<Vector3d> Outermost(const std::vector<Vector3d>& points, int directions) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  std::set<std::size_t> kept;
  for (int i = 0; i < directions; ++i) {
    const double z = 1 - (2.0 * i + 1) / directions;
    const double r = std::sqrt(1 - z * z);
    const Vector3d direction(r * std::cos(golden * i), r * std::sin(golden * i), z);
    std::size_t best = 0;
    for (std::size_t k = 1; k < points.size(); ++k) {
      if (points[k].dot(direction) > points[best].dot(direction)) best = k;
    }
    kept.insert(best);
  }
  std::vector<Vector3d> outermost;
  for (const std::size_t k : kept) outermost.push_back(points[k]);
  return outermost;
}

std::vector<collision::ConvexShape> ShapesOf(const mjModel& model, const std::string& link,
                                             int directions) {
  const int body = mj_name2id(&model, mjOBJ_BODY, link.c_str());
  std::vector<collision::ConvexShape> shapes;
  for (int geom = 0; geom < model.ngeom; ++geom) {
    if (model.geom_bodyid[geom] != body || !kinematics::Collides(model, geom)) continue;
    collision::ConvexShape shape =
        collision::Moved(PoseInBody(model, geom), kinematics::ShapeOfGeom(model, geom));
    if (shape.points.empty()) continue;
    shape.points = Outermost(shape.points, directions);
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

TipShapes GeometryOf(const mjModel& model, const std::string& link) {
  TipShapes shapes = ShapesOf(model, link, kManyDirections);
  for (collision::ConvexShape& shape : shapes) {
    if (shape.radius == 0) shape.radius = kTipSkin;
  }
  return shapes;
}

}  // namespace

std::vector<collision::ConvexShape> CollisionShapesOf(const mjModel& model,
                                                      const std::string& body) {
  return ShapesOf(model, body, kSomeDirections);
}

std::vector<TipShapes> TipShapesOf(const kinematics::HandFile& file, TipShape tip) {
  std::vector<TipShapes> tips;
  for (FingerIndex finger{0}; finger < std::ssize(file.hand.fingers); ++finger) {
    const auto& ball = file.description.tips[finger];
    if (tip == TipShape::kBall) {
      tips.push_back({{{ball.centre}, ball.radius}});
      continue;
    }
    tips.push_back(GeometryOf(*file.compiled->model, ball.body));
    if (!tips.back().empty()) continue;
    throw InputError(file.description.model + ": fingertip link " + ball.body + " of " +
                     FingerText(file.hand, finger) +
                     " has no collision geometry that could touch the object");
  }
  return tips;
}

}  // namespace regrasp::sim
