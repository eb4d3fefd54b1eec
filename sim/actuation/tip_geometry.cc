#include "sim/actuation/tip_geometry.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>

#include "planner/base/error.h"
#include "planner/base/quantity_text.h"
#include "planner/kinematics/model_names.h"
#include "planner/kinematics/mujoco_model.h"
#include "sim/actuation/tip_contact.h"
#include "sim/hand/hand_finding.h"

namespace regrasp::sim {
namespace {

using Eigen::Vector3d;
using kinematics::VectorAt;

/// Hollows that are less deep are none, metres: ten times less than a tip yields.
constexpr double kFlat = 1e-5;
/// Its parameters count and not those of the hand's geoms.
constexpr int kObjectPriority = 1'000'000;
/// Of all contacts of a tip, newtons: less is no weight.
constexpr double kNoForce = 1e-9;

/// How far a vertex is beyond the plane of a face, at most: 0 of a convex solid.
double LargestOverhang(const object::Polyhedron& solid) {
  double most = 0;
  for (FaceIndex face{0}; face < solid.face_count(); ++face) {
    const Vector3d& inward = solid.inward_normal(face);
    const double plane = inward.dot(solid.CentroidOf(face));
    for (const Vector3d& vertex : solid.vertices()) {
      most = std::max(most, plane - inward.dot(vertex));
    }
  }
  return most;
}

/// 1 where the tip is the contact's second geom, −1 where it is the first, 0 of other contacts.
int SideOfTip(const mjContact& contact, const std::vector<int>& tip_geoms, int object_geom) {
  const auto is_tip = [&](int geom) {
    return std::ranges::find(tip_geoms, geom) != tip_geoms.end();
  };
  if (contact.geom1 == object_geom && is_tip(contact.geom2)) return 1;
  return contact.geom2 == object_geom && is_tip(contact.geom1) ? -1 : 0;
}

}  // namespace

std::vector<std::vector<int>> TipGeoms(const kinematics::HandFile& file, const mjModel& model) {
  std::vector<std::vector<int>> tips;
  for (FingerIndex finger{0}; finger < std::ssize(file.hand.fingers); ++finger) {
    const std::string& link = file.hand.fingers[finger].tip.body;
    const int body = mj_name2id(&model, mjOBJ_BODY, link.c_str());
    std::vector<int>& geoms = tips.emplace_back();
    for (int geom = 0; geom < model.ngeom; ++geom) {
      if (model.geom_bodyid[geom] == body && kinematics::Collides(model, geom)) {
        geoms.push_back(geom);
      }
    }
    if (geoms.empty()) {
      throw InputError(file.description.model + ": the tip link " + link + " of " +
                       FingerText(file.hand, finger) +
                       " has no collision geometry that could touch the object");
    }
  }
  return tips;
}

double ReachFrom(const Vector3d& point, const std::vector<int>& geoms, const mjModel& model) {
  double reach = 0;
  for (const int geom : geoms) {
    const double centre = (VectorAt(model.geom_pos, geom) - point).norm();
    reach = std::max(reach, centre + model.geom_rbound[geom]);
  }
  return reach;
}

void RequireTipGeometry(const kinematics::HandFile& file, const object::Polyhedron& solid,
                        double scale) {
  static_cast<void>(TipGeoms(file, *file.compiled->model));
  const double overhang = scale * LargestOverhang(solid);
  if (overhang <= kFlat) return;
  throw InputError("the object is not convex (a vertex is " + FormatLength(overhang) +
                   " beyond the plane of a face): with the model's own tips MuJoCo would collide "
                   "its convex hull instead");
}

void LetTipsCollide(const std::vector<std::vector<int>>& tips, int object_geom, double mu,
                    mjModel& model) {
  model.geom_contype[object_geom] = 1;
  const auto touch_at_once = [&model](int geom) {
    model.geom_margin[geom] = model.geom_gap[geom] = 0;
  };
  touch_at_once(object_geom);
  for (const std::vector<int>& geoms : tips) {
    for (const int geom : geoms) {
      model.geom_conaffinity[geom] = 1;
      touch_at_once(geom);
    }
  }
  model.geom_priority[object_geom] = kObjectPriority;
  model.geom_condim[object_geom] = 3;
  mjtNum* friction = model.geom_friction + std::ptrdiff_t{3} * object_geom;
  friction[0] = mu;
  friction[1] = friction[2] = mjMINMU;
  mjtNum* solref = model.geom_solref + std::ptrdiff_t{mjNREF} * object_geom;
  solref[0] = kTipContactTime;
  solref[1] = 1;
  std::ranges::copy(kTipImpedance, model.geom_solimp + std::ptrdiff_t{mjNIMP} * object_geom);
  model.opt.collision = mjCOL_ALL;
  model.opt.enableflags |= mjENBL_MULTICCD;
  model.opt.enableflags &= ~mjENBL_OVERRIDE;
}

std::optional<ContactSum> SumContacts(const std::vector<int>& tip_geoms, int object_geom,
                                      const mjModel& model, const mjData& data) {
  ContactSum sum;
  sum.gap = std::numeric_limits<double>::infinity();
  Vector3d points = Vector3d::Zero();  // weighted
  Vector3d normals = Vector3d::Zero();
  double pressing = 0;
  Vector3d plain_points = Vector3d::Zero();
  Vector3d plain_normals = Vector3d::Zero();
  int count = 0;
  for (int i = 0; i < data.ncon; ++i) {
    const mjContact& contact = data.contact[i];
    const int side = SideOfTip(contact, tip_geoms, object_geom);
    if (side == 0) continue;
    const Vector3d outward = side * VectorAt(contact.frame, 0);
    const Vector3d point = VectorAt(contact.pos, 0) - contact.dist / 2 * outward;
    mjtNum local[6];
    mj_contactForce(&model, &data, i, local);
    // The engine gives the force on the second geom.
    for (int k = 0; k < 3; ++k) sum.force -= side * local[k] * VectorAt(contact.frame, k);
    points += local[0] * point;
    normals += local[0] * outward;
    pressing += local[0];
    plain_points += point;
    plain_normals += outward;
    sum.gap = std::min(sum.gap, contact.dist);
    ++count;
  }
  if (count == 0) return std::nullopt;
  const bool presses = pressing > kNoForce;
  sum.point = presses ? Vector3d(points / pressing) : Vector3d(plain_points / count);
  sum.outward = (presses ? normals : plain_normals).stableNormalized();
  return sum;
}

}  // namespace regrasp::sim
