#include "sim/scene/scene.h"

#include <algorithm>
#include <limits>
#include <set>

#include "planner/base/error.h"
#include "planner/base/number.h"
#include "planner/criteria/reach.h"
#include "planner/object/polygon.h"
#include "planner/object/polyhedron.h"
#include "sim/scene/align_script.h"
#include "sim/scene/scaling.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Largest number of fingers with contacts. Each has its own collision bit, of the 31 of an int.
constexpr int kMostTouching = 31;

/// Number of points of a path at which a fingertip's clearance is tested.
constexpr int kClearanceSamples = 8;

/// Distance from the centroid of fingers that the plan never uses, in diameters.
constexpr double kParkingDistance = 1.5;

/// Collector of the sites at which fingers make contact.
struct SiteCollector {
  const object::Object& object;
  double scale;
  Scene& scene;
  double point_tolerance;  ///< metres

  SiteIndex Add(FingerIndex finger, const grasp::Contact& from, const grasp::Contact& to) {
    const ContactSite site{to.face, ToScene(object, scale, from.face == to.face ? from : to).p,
                           ToScene(object, scale, to).p};
    const int index = FindEqual(site);
    if (index == static_cast<int>(scene.sites.size())) scene.sites.push_back({site, {}, {}});
    std::vector<FingerIndex>& fingers = scene.sites[index].fingers;
    if (std::ranges::find(fingers, finger) == fingers.end()) fingers.push_back(finger);
    return SiteIndex(index);
  }

  void AddPlanned(const plan::FingerGrasp& grasp) {
    for (const plan::FingerContact& held : grasp) {
      const SiteIndex index = Add(held.finger, held.contact, held.contact);
      SiteIndex& first = scene.fingers[held.finger].first_site;
      if (!first.valid()) first = index;
    }
  }

  void Add(const AlignScript& script) {
    for (const AlignMove& move : script.moves) {
      if (const auto* handover = std::get_if<FingerHandover>(&move)) {
        for (const plan::FingerGrasp* grasp : {&handover->support_fingers, &handover->targets}) {
          for (const plan::FingerContact& held : *grasp)
            Add(held.finger, held.contact, held.contact);
        }
        continue;
      }
      if (const auto* roll = std::get_if<FingersRoll>(&move)) {
        for (std::size_t k = 0; k < roll->from.size(); ++k) {
          Add(roll->from[k].finger, roll->from[k].contact, roll->to[k].contact);
        }
        continue;
      }
      const auto& grasps = std::get<FingersSlide>(move).grasps;
      for (std::size_t k = 0; k < grasps.front().size(); ++k) {
        Add(grasps.front()[k].finger, grasps.front()[k].contact, grasps.back()[k].contact);
      }
    }
  }

 private:
  /// Return the index of an equal site; the number of sites if there is none.
  [[nodiscard]] int FindEqual(const ContactSite& site) const {
    const auto equal = std::ranges::find_if(scene.sites, [&](const SceneSite& other) {
      return other.place.face == site.face &&
             (other.place.from - site.from).norm() <= point_tolerance &&
             (other.place.to - site.to).norm() <= point_tolerance;
    });
    return static_cast<int>(equal - scene.sites.begin());
  }
};

/// Initial grasp and first steps of a plan, and the fingers that they require.
struct Sequence {
  const object::Object& object;
  const plan::Plan& plan;
  int steps;

  /// Return the contacts that entry `index` of the report names and at which fingers stop.
  [[nodiscard]] plan::FingerGrasp PlannedStaticGrasps(plan::EntryIndex index) const {
    if (index == 0) return plan.initial;
    const plan::Step& step = plan::StepOf(plan, index);
    if (const auto* change = std::get_if<plan::Switch>(&step)) return change->place;
    const auto* align = std::get_if<plan::Align>(&step);
    if (align == nullptr) return {};  // in-hand motion: no new contacts
    const auto& waypoints = align->waypoints;
    return waypoints.empty() ? plan::FingerGrasp() : waypoints.back();
  }

  [[nodiscard]] int CountFingers() const {
    int fingers = plan.fingers;
    for (plan::EntryIndex index{0}; index <= steps; ++index) {
      for (const plan::FingerContact& held : PlannedStaticGrasps(index)) {
        fingers = std::max(fingers, held.finger + 1);
      }
    }
    return fingers;
  }

  void CheckFaces() const {
    const auto check = [&](const plan::FingerGrasp& grasp) {
      for (const plan::FingerContact& held : grasp) {
        if (held.contact.face.valid() && held.contact.face < object.face_count()) continue;
        throw InputError("replay: a contact of finger " + std::to_string(held.finger) +
                         " is on no face of the object");
      }
    };
    check(plan.initial);
    for (plan::EntryIndex index{1}; index <= steps; ++index) {
      if (const auto* align = std::get_if<plan::Align>(&plan::StepOf(plan, index))) {
        std::ranges::for_each(align->waypoints, check);
      } else {
        check(PlannedStaticGrasps(index));
      }
    }
  }
};

/// Return the clearance that the fingertip requires: twice its radius if the radius is derived.
double WantedClearance(const object::Object& object, const ReplayOptions& options) {
  return options.finger_radius.value_or(2 * kTipRadius * object.diameter());
}

/// Return the smallest clearance of the contacts of a grasp, at most `limit`.
double SmallestClearance(const object::Object& object, const plan::FingerGrasp& grasp,
                         double limit) {
  double least = limit;
  for (const plan::FingerContact& held : grasp) {
    least = std::min(least, criteria::ComputeClearance(object, held.contact, least));
  }
  return least;
}

/// Return the entries with the scripts of all sliding steps, in the object's own frame and unit.
std::vector<SceneEntry> WriteScripts(const Sequence& sequence, int fingers, double friction_angle,
                                     double wanted, AlignChoice choice) {
  const double D = sequence.object.diameter();
  double clearance = wanted;
  for (plan::EntryIndex index{0}; index <= sequence.steps; ++index) {
    clearance = SmallestClearance(sequence.object, sequence.PlannedStaticGrasps(index), clearance);
  }
  AlignLimits limits{friction_angle, {}, 0, kLeastClearance * D, choice == AlignChoice::kSlide};
  limits.clearance = std::max(clearance, 2 * kLeastTipRadius * D);
  std::vector<SceneEntry> entries(sequence.steps + 1);
  plan::FingerGrasp holding = sequence.plan.initial;
  for (plan::EntryIndex index{1}; index <= sequence.steps; ++index) {
    const plan::Step& step = plan::StepOf(sequence.plan, index);
    if (const auto* align = std::get_if<plan::Align>(&step)) {
      limits.spare.clear();
      for (FingerIndex f{0}; f < fingers; ++f) {
        if (plan::FindFinger(holding, f) == nullptr) limits.spare.push_back(f);
      }
      entries[index].script = WriteAlignScript(sequence.object, *align, limits);
    }
    holding = plan::GraspAfter(holding, step);
  }
  return entries;
}

AlignScript ScriptToScene(const object::Object& object, double scale, AlignScript script) {
  const auto convert = [&](plan::FingerGrasp& grasp) {
    grasp = ToScene(object, scale, std::move(grasp));
  };
  for (AlignMove& move : script.moves) {
    if (auto* handover = std::get_if<FingerHandover>(&move)) {
      convert(handover->support_fingers);
      convert(handover->targets);
    } else if (auto* roll = std::get_if<FingersRoll>(&move)) {
      convert(roll->from);
      convert(roll->to);
    } else {
      std::ranges::for_each(std::get<FingersSlide>(move).grasps, convert);
    }
  }
  return script;
}

double DistanceTo(const ContactSite& site, const Vector3d& point) {
  const Vector3d path = site.to - site.from;
  const double length = path.squaredNorm();
  const double t = length > 0 ? std::clamp((point - site.from).dot(path) / length, 0.0, 1.0) : 0;
  return (site.from + t * path - point).norm();
}

/// Report the first finger that must stop at a contact at which no sphere fits.
std::optional<plan::Obstacle> FindUnreachable(const object::Object& object,
                                              const plan::FingerGrasp& rests) {
  const double least = kLeastClearance * object.diameter();
  for (const plan::FingerContact& held : rests) {
    const double clearance = criteria::ComputeClearance(object, held.contact, least);
    if (clearance >= least) continue;
    return plan::Obstacle{
        "finger " + std::to_string(held.finger) +
            " does not fit at its contact in a corner: largest fingertip radius " +
            FormatShort(clearance),
        {.fingers = {held.finger}, .found = held.contact}};
  }
  return std::nullopt;
}

/// Return all contacts at which fingers stop in entry `index`.
plan::FingerGrasp AllStaticGrasps(const Sequence& sequence, const Scene& scene_O,
                                  plan::EntryIndex index) {
  plan::FingerGrasp rests = sequence.PlannedStaticGrasps(index);
  const std::optional<AlignScript>& script = scene_O.entries[index].script;
  if (!script) return rests;
  for (const AlignMove& move : script->moves) {
    if (const auto* handover = std::get_if<FingerHandover>(&move)) {
      rests.insert(rests.end(), handover->support_fingers.begin(), handover->support_fingers.end());
      rests.insert(rests.end(), handover->targets.begin(), handover->targets.end());
    }
  }
  return rests;
}

Vector3d FromScene(const object::Object& object, double scale, const Vector3d& p_S) {
  return p_S / scale + object.mass_properties().centroid;
}

double SmallestClearance(const object::Object& object, double scale, const Scene& scene,
                         double limit) {
  double least = limit;
  for (const auto& [site, patches, fingers] : scene.sites) {
    const int samples = site.from == site.to ? 0 : kClearanceSamples;
    for (int i = 0; i <= samples; ++i) {
      const double t = samples == 0 ? 0 : static_cast<double>(i) / samples;
      const Vector3d p = FromScene(object, scale, site.from + t * (site.to - site.from));
      const grasp::Contact contact{p, object.inward_normal(site.face), site.face};
      least = std::min(least, criteria::ComputeClearance(object, contact, limit));
    }
  }
  return least * scale;
}

std::vector<ContactPatch> MakePatches(const object::Object& body, const ContactSite& site,
                                      double size, double thickness) {
  if (const auto* polygon = dynamic_cast<const object::Polygon*>(&body)) {
    return {MakeEdgePatch(*polygon, site, size, thickness)};
  }
  return MakeContactPatches(dynamic_cast<const object::Polyhedron&>(body), site, size);
}

std::vector<ContactPatch> MakeScenePatches(const object::Object& body, double scale,
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

/// Return the inertia of the homogeneous object about its centroid, kg m².
/// A polygon's moments are those of its area; its prism adds M t²/12 about the axes in the plane.
Eigen::Matrix3d Inertia(const object::Object& body, double scale, const ReplaySettings& s) {
  const double mass = s.mass_factor * s.mass_kg;
  Eigen::Matrix3d inertia =
      mass / body.mass_properties().volume * scale * scale * body.mass_properties().inertia;
  inertia.diagonal().head<2>().array() += mass * s.thickness_m * s.thickness_m / 12;
  return inertia;
}

void PlaceFingersAtStart(const object::Object& object, Scene& scene) {
  for (SceneFinger& finger : scene.fingers) {
    if (!finger.first_site.valid()) {
      finger.start_S = Vector3d::UnitX() * kParkingDistance * scene.settings.diameter_m;
      continue;
    }
    const ContactSite& place = scene.sites[finger.first_site].place;
    finger.start_S =
        place.from - object.inward_normal(place.face) * scene.settings.fingertip_radius_m;
  }
}

/// Assign collision bits to the fingers with contacts.
/// A hand may have many more fingers.
void AssignCollisionBits(Scene& scene) {
  std::set<FingerIndex> touching;
  for (const SceneSite& site : scene.sites) {
    touching.insert(site.fingers.begin(), site.fingers.end());
  }
  if (touching.size() > kMostTouching) {
    throw InputError("replay: " + std::to_string(touching.size()) +
                     " fingers touch the object, one after the other or at once; " +
                     std::to_string(kMostTouching) + " can be simulated");
  }
  int place = 0;
  for (const FingerIndex finger : touching) scene.fingers[finger].collision_bit = 1 << place++;
}

/// Set scripts, unreachable fingers, and sites.
void LayOut(const Sequence& sequence, const ReplayOptions& options, Scene& scene) {
  const object::Object& object = sequence.object;
  const double scale = sequence.plan.scale;
  const int fingers = static_cast<int>(scene.fingers.size());
  scene.entries = WriteScripts(sequence, fingers, sequence.plan.friction_angle,
                               WantedClearance(object, options), options.align);
  SiteCollector collector{object, scale, scene,
                          object::kPointTolerance * object.diameter() * scale};
  for (plan::EntryIndex index{0}; index <= sequence.steps; ++index) {
    SceneEntry& entry = scene.entries[index];
    entry.unreachable = FindUnreachable(object, AllStaticGrasps(sequence, scene, index));
    if (!entry.script) {
      collector.AddPlanned(sequence.PlannedStaticGrasps(index));
      continue;
    }
    collector.Add(*entry.script);
    entry.script = ScriptToScene(object, scale, *std::move(entry.script));
  }
}

}  // namespace

grasp::Contact ToScene(const object::Object& object, double scale, const grasp::Contact& contact) {
  return {(contact.p - object.mass_properties().centroid) * scale, contact.n, contact.face,
          contact.torsion * scale};
}

plan::FingerGrasp ToScene(const object::Object& object, double scale, plan::FingerGrasp grasp) {
  for (plan::FingerContact& held : grasp) held.contact = ToScene(object, scale, held.contact);
  return grasp;
}

Scene MakeScene(const object::Object& body, const plan::Plan& plan, int steps,
                const ReplayOptions& given) {
  ReplayOptions options = given;
  if (!options.finger_radius) options.finger_radius = plan.finger_radius;
  const Sequence sequence{body, plan, steps};
  sequence.CheckFaces();
  Scene scene;
  scene.dimension = body.dimension();
  scene.fingers.resize(sequence.CountFingers());
  LayOut(sequence, options, scene);
  AssignCollisionBits(scene);
  if (options.hand_grasp_force && !options.grasp_force_N) {
    options.grasp_force_N = HandGraspForce(body, plan, steps + 1, plan.friction_angle,
                                           BodyOf(body, plan.scale, options).mass_kg);
  }
  scene.settings = DeriveSettings(
      body, plan.scale, plan.friction_angle,
      SmallestClearance(body, plan.scale, scene, WantedClearance(body, options)), options);
  scene.settings.torsion_m = plan.torsion * plan.scale;
  for (SceneSite& site : scene.sites) {
    site.patches = MakeScenePatches(body, plan.scale, site.place, scene.settings);
  }
  PlaceFingersAtStart(body, scene);
  scene.inertia = Inertia(body, plan.scale, scene.settings);
  return scene;
}

Scene InUnits(Scene scene, const EngineUnits& units) {
  const double metre = 1 / units.length_m;
  const double kilogram = 1 / units.mass_kg;
  const double second = 1 / units.time_s;
  ReplaySettings& s = scene.settings;
  for (double* length : {&s.torsion_m, &s.diameter_m, &s.thickness_m, &s.fingertip_radius_m,
                         &s.patch_size_m, &s.patch_thickness_m}) {
    *length *= metre;
  }
  s.mass_kg *= kilogram;
  s.finger_mass_kg *= kilogram;
  s.timestep_s *= second;
  s.characteristic_time_s *= second;
  s.grasp_force_N /= units.force_N();
  s.gravity_m_s2 *= metre / (second * second);
  s.finger_stiffness_N_m *= kilogram / (second * second);
  s.finger_damping_Ns_m *= kilogram / second;
  for (SceneSite& site : scene.sites) {
    site.place.from *= metre;
    site.place.to *= metre;
    for (ContactPatch& patch : site.patches) {
      for (Vector3d& corner : patch.outline) corner *= metre;
    }
  }
  for (SceneFinger& finger : scene.fingers) finger.start_S *= metre;
  scene.inertia *= kilogram * metre * metre;
  return scene;
}

SiteIndex FindSite(const Scene& scene, const grasp::Contact& from_S, const grasp::Contact& to_S) {
  // A finger that turns at an edge is already at its new face's site.
  const Vector3d begin = from_S.face == to_S.face ? from_S.p : to_S.p;
  SiteIndex best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.sites.size(); ++i) {
    const ContactSite& site = scene.sites[i].place;
    if (site.face != to_S.face) continue;
    const double distance = std::max(DistanceTo(site, begin), DistanceTo(site, to_S.p));
    if (distance < least) {
      least = distance;
      best = SiteIndex(i);
    }
  }
  return best;
}

SiteIndex FindSite(const Scene& scene, const grasp::Contact& contact_S) {
  return FindSite(scene, contact_S, contact_S);
}

}  // namespace regrasp::sim
