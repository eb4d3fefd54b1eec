#include "sim/scene.h"

#include <algorithm>
#include <limits>

#include "planner/base/error.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "sim/clearance.h"
#include "sim/scaling.h"

namespace regrasp {

using Eigen::Vector3d;

namespace {

/// Collision bits are 32, and the planners' largest hand has five fingers.
constexpr int kMostFingers = 16;

/// A path is looked at this often for the room that a fingertip has along it.
constexpr int kClearanceSamples = 8;

/// Fingers that the plan never uses wait this far from the centroid, in diameters.
constexpr double kParkingDistance = 1.5;

struct SiteCollector {
  const Object& object;
  double scale;
  Scene& scene;
  double point_tolerance;  ///< metres

  void Add(int finger, const Contact& from, const Contact& to) {
    for (const Contact* contact : {&from, &to}) {
      if (contact->face < 0 || contact->face >= object.face_count()) {
        throw InputError("replay: a contact of finger " + std::to_string(finger) +
                         " is on no face of the object");
      }
    }
    const ContactSite site{to.face, ToScene(object, scale, from.face == to.face ? from : to).p,
                           ToScene(object, scale, to).p};
    int index = FindEqual(site);
    if (index < 0) {
      index = static_cast<int>(scene.sites.size());
      scene.sites.push_back(site);
      scene.fingers_of_site.emplace_back();
    }
    std::vector<int>& fingers = scene.fingers_of_site[index];
    if (std::ranges::find(fingers, finger) == fingers.end()) fingers.push_back(finger);
    if (finger >= static_cast<int>(first_site.size())) first_site.resize(finger + 1, -1);
    if (first_site[finger] < 0) first_site[finger] = index;
  }

  void Add(const FingerContact& held) { Add(held.finger, held.contact, held.contact); }

  void Add(const Step& step) {
    if (const auto* change = std::get_if<Switch>(&step)) {
      for (const FingerContact& placed : change->place) Add(placed);
      return;
    }
    const auto& waypoints = std::get<Align>(step).waypoints;
    for (std::size_t j = 1; j < waypoints.size(); ++j) {
      for (const FingerContact& to : waypoints[j]) {
        const auto from = std::ranges::find(waypoints[j - 1], to.finger, &FingerContact::finger);
        Add(to.finger, from == waypoints[j - 1].end() ? to.contact : from->contact, to.contact);
      }
    }
  }

  std::vector<int> first_site;  ///< of every finger

 private:
  [[nodiscard]] int FindEqual(const ContactSite& site) const {
    for (std::size_t i = 0; i < scene.sites.size(); ++i) {
      const ContactSite& other = scene.sites[i];
      if (other.face == site.face && (other.from - site.from).norm() <= point_tolerance &&
          (other.to - site.to).norm() <= point_tolerance) {
        return static_cast<int>(i);
      }
    }
    return -1;
  }
};

Vector3d FromScene(const Object& object, double scale, const Vector3d& p_S) {
  return p_S / scale + object.mass_properties().centroid;
}

double SmallestClearance(const Object& object, double scale, const Scene& scene) {
  const double limit = 2 * kTipRadius * object.diameter();
  double least = limit;
  for (const ContactSite& site : scene.sites) {
    const int samples = site.from == site.to ? 0 : kClearanceSamples;
    for (int i = 0; i <= samples; ++i) {
      const double t = samples == 0 ? 0 : static_cast<double>(i) / samples;
      const Vector3d p = FromScene(object, scale, site.from + t * (site.to - site.from));
      const Contact contact{p, object.inward_normal(site.face), site.face};
      least = std::min(least, ComputeClearance(object, contact, limit));
    }
  }
  return least * scale;
}

std::vector<ContactPatch> MakePatches(const Object& body, const ContactSite& site, double size,
                                      double thickness) {
  if (const auto* polygon = dynamic_cast<const Polygon*>(&body)) {
    return {MakeEdgePatch(*polygon, site, size, thickness)};
  }
  return MakeContactPatches(dynamic_cast<const Polyhedron&>(body), site, size);
}

std::vector<ContactPatch> MakeScenePatches(const Object& body, double scale,
                                           const ContactSite& site, const ReplaySettings& s) {
  std::vector<ContactPatch> patches = MakePatches(
      body, {site.face, FromScene(body, scale, site.from), FromScene(body, scale, site.to)},
      s.patch_size_m / scale, s.thickness_m / scale);
  for (ContactPatch& patch : patches) {
    for (Vector3d& corner : patch.outline) {
      corner = (corner - body.mass_properties().centroid) * scale;
    }
  }
  return patches;
}

/// Of the homogeneous body about its centroid, kg m². A polygon's moments are those of its area:
/// its prism adds M t²/12 about the axes in the plane.
Eigen::Matrix3d Inertia(const Object& body, double scale, const ReplaySettings& s) {
  Eigen::Matrix3d inertia =
      s.mass_kg / body.mass_properties().volume * scale * scale * body.mass_properties().inertia;
  inertia.diagonal().head<2>().array() += s.mass_kg * s.thickness_m * s.thickness_m / 12;
  return inertia;
}

void PlaceFingersAtStart(const Object& object, int fingers, const std::vector<int>& first_site,
                         Scene& scene) {
  for (int f = 0; f < fingers; ++f) {
    const int site = f < static_cast<int>(first_site.size()) ? first_site[f] : -1;
    if (site < 0) {
      scene.finger_start_S.push_back(Vector3d::UnitX() * kParkingDistance *
                                     scene.settings.diameter_m);
      continue;
    }
    const ContactSite& where = scene.sites[site];
    scene.finger_start_S.push_back(where.from - object.inward_normal(where.face) *
                                                    scene.settings.fingertip_radius_m);
  }
}

}  // namespace

Contact ToScene(const Object& object, double scale, const Contact& contact) {
  return {(contact.p - object.mass_properties().centroid) * scale, contact.n, contact.face};
}

Scene MakeScene(const Object& body, const Plan& plan, int steps, const ReplayOptions& options) {
  Scene scene;
  scene.dimension = body.dimension();
  SiteCollector collector{
      body, plan.scale, scene, kPointTolerance * body.diameter() * plan.scale, {}};
  int fingers = plan.fingers;
  for (const FingerContact& held : plan.initial) fingers = std::max(fingers, held.finger + 1);
  for (int i = 0; i < steps; ++i) {
    if (const auto* change = std::get_if<Switch>(&plan.steps[i])) {
      for (const FingerContact& placed : change->place) {
        fingers = std::max(fingers, placed.finger + 1);
      }
    }
  }
  if (fingers > kMostFingers) {
    throw InputError("replay: " + std::to_string(fingers) + " fingers; " +
                     std::to_string(kMostFingers) + " can be simulated");
  }
  for (const FingerContact& held : plan.initial) collector.Add(held);
  for (int i = 0; i < steps; ++i) collector.Add(plan.steps[i]);

  scene.settings = DeriveSettings(body, plan.scale, plan.half_angle,
                                  SmallestClearance(body, plan.scale, scene), options);
  for (const ContactSite& site : scene.sites) {
    scene.patches.push_back(MakeScenePatches(body, plan.scale, site, scene.settings));
  }
  PlaceFingersAtStart(body, fingers, collector.first_site, scene);
  scene.inertia = Inertia(body, plan.scale, scene.settings);
  return scene;
}

int FindSite(const Scene& scene, const Contact& contact_S) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.sites.size(); ++i) {
    const ContactSite& site = scene.sites[i];
    if (site.face != contact_S.face) continue;
    const Vector3d path = site.to - site.from;
    const double length = path.squaredNorm();
    const double t =
        length > 0 ? std::clamp((contact_S.p - site.from).dot(path) / length, 0.0, 1.0) : 0;
    const double distance = (site.from + t * path - contact_S.p).norm();
    if (distance < least) {
      least = distance;
      best = static_cast<int>(i);
    }
  }
  return best;
}

}  // namespace regrasp
