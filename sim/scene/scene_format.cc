#include <Eigen/Geometry>
#include <map>

#include "planner/base/number.h"
#include "scene_template.h"
#include "sim/scene/contact_patches.h"
#include "sim/scene/scaling.h"
#include "sim/scene/scene.h"

namespace regrasp::sim {

using Eigen::Vector3d;

namespace {

/// Tolerance of collision distances over D; contacts are 1e-7 D deep.
constexpr double kCollisionTolerance = 1e-9;

/// Inertia over m r² of the fingers, which never rotate but require one in the engine: that of a
/// sphere, 2/5 m r².
constexpr double kBallInertia = 0.4;

/// Half the length of a capsule finger over the prism's thickness; its ends stay away from the
/// prism's rims.
constexpr double kCapsuleLength = 0.25;

/// Ratio of the stiffness of friction to that of normal forces. The engine makes torsional friction
/// more compliant for smaller torsion. With the value of hard-finger contacts, objects held by soft
/// fingers with a torsion of a hundredth of their size creep too fast for a static grasp.
constexpr double kHardImpratio = 100;
constexpr double kSoftImpratio = 1000;

/// Number of time steps over which impacts are softened, the smallest at which the engine's
/// integration is stable.
constexpr double kContactSteps = 2;

std::string Join(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ' ';
    text += FormatDouble(value);
  }
  return text;
}

/// The engine counts a space after the last number as another number.
void Append(std::string& list, const std::string& item) {
  if (!list.empty()) list += ' ';
  list += item;
}

std::string Join(const Vector3d& v) { return Join({v.x(), v.y(), v.z()}); }

std::string Collision(const Scene& scene, const std::vector<FingerIndex>& fingers) {
  int bits = 0;
  for (const FingerIndex finger : fingers) bits |= scene.fingers[finger].collision_bit;
  return " conaffinity=\"" + std::to_string(bits) + "\"";
}

std::string FormatBox(const ContactPatch& patch, double thickness) {
  const Vector3d u = patch.outline[1] - patch.outline[0];
  const Vector3d v = patch.outline[2] - patch.outline[1];
  const Vector3d inward = v.cross(u).normalized();
  const Vector3d centre = (patch.outline[0] + patch.outline[2]) / 2 + thickness / 2 * inward;
  return " type=\"box\" pos=\"" + Join(centre) + "\" xyaxes=\"" + Join(u.normalized()) + " " +
         Join(v.normalized()) + "\" size=\"" + Join({u.norm() / 2, v.norm() / 2, thickness / 2}) +
         "\"";
}

/// Return the mesh of a patch's prism, with vertices relative to the patch's first corner.
/// The engine stores them in single precision; relative to the object's centre, small patches would
/// be tilted.
std::string FormatPrismMesh(const std::string& name, const ContactPatch& patch,
                            const Vector3d& inward, double thickness) {
  std::string vertices;
  for (const double depth : {0.0, thickness}) {
    for (const Vector3d& corner : patch.outline) {
      Append(vertices, Join(corner - patch.outline[0] + depth * inward));
    }
  }
  return "    <mesh name=\"" + name + "\" vertex=\"" + vertices + "\"/>\n";
}

struct Parts {
  std::string assets, object_geoms, fingers, actuators;
};

void AddSurface(const object::Object& body, double scale, double thickness_m, Parts& parts) {
  const VisibleSurface surface = MakeVisibleSurface(body, thickness_m / scale);
  std::string vertices, faces;
  for (const Vector3d& v : surface.vertices) {
    Append(vertices, Join((v - body.mass_properties().centroid) * scale));
  }
  for (const auto& [a, b, c] : surface.triangles) {
    for (const int corner : {a, b, c}) Append(faces, std::to_string(corner));
  }
  parts.assets +=
      "    <mesh name=\"surface\" vertex=\"" + vertices + "\" face=\"" + faces + "\"/>\n";
  parts.object_geoms += "      <geom class=\"surface\" type=\"mesh\" mesh=\"surface\"/>\n";
}

void AddPatches(const Scene& scene, const object::Object& body, Parts& parts) {
  for (std::size_t i = 0; i < scene.sites.size(); ++i) {
    const SceneSite& site = scene.sites[i];
    const Vector3d inward = body.inward_normal(site.place.face);
    for (std::size_t k = 0; k < site.patches.size(); ++k) {
      const ContactPatch& patch = site.patches[k];
      const std::string name = "site" + std::to_string(i) + "_" + std::to_string(k);
      const double thickness = scene.settings.patch_thickness_m;
      std::string shape;
      if (patch.rectangle) {
        shape = FormatBox(patch, thickness);
      } else {
        parts.assets += FormatPrismMesh(name, patch, inward, thickness);
        shape = " type=\"mesh\" mesh=\"" + name + "\" pos=\"" + Join(patch.outline[0]) + "\"";
      }
      parts.object_geoms += "      <geom name=\"" + name + "\" class=\"patch\"" + shape +
                            Collision(scene, site.fingers) + "/>\n";
    }
  }
}

void AddFinger(const Scene& scene, FingerIndex finger, Parts& parts) {
  const std::string name = "finger" + std::to_string(finger);
  const double mass = scene.settings.finger_mass_kg;
  const double inertia =
      kBallInertia * mass * scene.settings.fingertip_radius_m * scene.settings.fingertip_radius_m;
  parts.fingers += "    <body name=\"" + name + "\" pos=\"" + Join(scene.fingers[finger].start_S) +
                   "\" childclass=\"finger\">\n      <inertial pos=\"0 0 0\" mass=\"" +
                   Join({mass}) + "\" diaginertia=\"" + Join({inertia, inertia, inertia}) +
                   "\"/>\n";
  for (int axis = 0; axis < scene.dimension; ++axis) {
    const std::string joint = name + "xyz"[axis];
    const std::string direction = Join(Vector3d::Unit(axis));
    parts.fingers += "      <joint name=\"" + joint + "\" axis=\"" + direction + "\"/>\n";
    parts.actuators +=
        "    <general class=\"finger\" name=\"" + joint + "\" joint=\"" + joint + "\"/>\n";
  }
  parts.fingers += "      <geom name=\"" + name + "\" contype=\"" +
                   std::to_string(scene.fingers[finger].collision_bit) + "\"/>\n    </body>\n";
}

std::string FormatObjectJoints(int dimension) {
  if (dimension == 3) return "<freejoint/>";
  return "<joint type=\"slide\" axis=\"1 0 0\"/>\n      <joint type=\"slide\" axis=\"0 1 0\"/>\n"
         "      <joint type=\"hinge\" axis=\"0 0 1\"/>";
}

/// Return the attributes of a finger's geom: a sphere, or a capsule along z.
std::string FormatTip(int dimension, const ReplaySettings& s) {
  if (dimension == 3) return "type=\"sphere\" size=\"" + Join({s.fingertip_radius_m}) + "\"";
  return "type=\"capsule\" size=\"" + Join({s.fingertip_radius_m, kCapsuleLength * s.thickness_m}) +
         "\"";
}

/// Return the friction attributes of two geoms.
/// The engine's elliptic cone of four dimensions is the ellipsoid of soft fingers (grasp::Contact).
/// Its torsional friction is the largest torque over the normal force.
std::string FormatFriction(const ReplaySettings& s) {
  const double mu = s.friction_factor * s.mu;
  if (s.torsion_m == 0) return "condim=\"3\" friction=\"" + FormatDouble(mu) + " 1e-5 1e-5\"";
  return "condim=\"4\" friction=\"" + Join({mu, mu * s.torsion_m}) + " 1e-5\"";
}

std::string FormatKeyframe(int dimension, const std::vector<Vector3d>& hold) {
  if (hold.empty()) return {};
  std::string controls;
  for (const Vector3d& control : hold) {
    for (int axis = 0; axis < dimension; ++axis) Append(controls, Join({control[axis]}));
  }
  return "  <keyframe>\n    <key name=\"hold\" ctrl=\"" + controls + "\"/>\n  </keyframe>\n";
}

std::string Fill(const std::map<std::string, std::string>& values) {
  std::string_view rest = kSceneTemplate;
  std::string text;
  for (;;) {
    const std::size_t open = rest.find("{{");
    text += rest.substr(0, open);
    if (open == std::string_view::npos) return text;
    const std::size_t close = rest.find("}}", open);
    text += values.at(std::string(rest.substr(open + 2, close - open - 2)));
    rest.remove_prefix(close + 2);
  }
}

/// Return the collision options of this version of the engine.
/// Later versions call them ccd_… and reject these names.
std::string CollisionOptions(double tolerance_m) {
  return " mpr_iterations=\"500\" mpr_tolerance=\"" + FormatDouble(tolerance_m) + "\"";
}

/// Return a remark on what a scene for all versions omits.
std::string CollisionRemark(const std::string& options) {
  return "If a contact patch is a mesh instead of a box, the default collision tolerance misses "
         "most contacts 1e-7 m deep. Add" +
         options + " to the option, from MuJoCo 3.2.3 on with ccd_ instead of mpr_.";
}

/// Largest number of contacts of one finger: a capsule has two on a patch, and at the border
/// between patches a fingertip touches several.
constexpr int kContactsPerFinger = 8;
/// A contact has one normal and two tangential constraints, and for a soft finger a torsional one.
constexpr int kConstraintsPerContact = 4;

/// Return a memory size that is enough for all contacts of the fingers.
/// No step then fails for lack of memory (CheckState). The engine clears its memory, which grows
/// with the square. Later versions choose the size themselves.
std::string EngineSize(std::size_t fingers) {
  const std::size_t contacts = kContactsPerFinger * fingers;
  return "  <size njmax=\"" + std::to_string(kConstraintsPerContact * contacts) + "\" nconmax=\"" +
         std::to_string(contacts) + "\"/>\n";
}

}  // namespace

std::string FormatScene(const Scene& scene, const object::Object& body,
                        const std::vector<Vector3d>& hold, bool surface) {
  const ReplaySettings& s = scene.settings;
  Parts parts;
  if (surface) AddSurface(body, s.diameter_m / body.diameter(), s.thickness_m, parts);
  AddPatches(scene, body, parts);
  for (FingerIndex f{0}; f < std::ssize(scene.fingers); ++f) {
    AddFinger(scene, f, parts);
  }
  const Eigen::Matrix3d& I = scene.inertia;
  const std::string collision = CollisionOptions(kCollisionTolerance * s.diameter_m);
  return Fill({{"timestep", FormatDouble(s.timestep_s)},
               {"gravity", FormatDouble(0 - s.gravity_m_s2)},
               {"collision", surface ? "" : collision},
               {"collision_remark", surface ? CollisionRemark(collision) : ""},
               {"size", surface ? "" : EngineSize(scene.fingers.size())},
               {"diameter", FormatDouble(s.diameter_m)},
               {"light", FormatDouble(s.diameter_m)},
               {"friction", FormatFriction(s)},
               {"impratio", FormatDouble(s.torsion_m == 0 ? kHardImpratio : kSoftImpratio)},
               {"contact_time", FormatDouble(kContactSteps * s.timestep_s)},
               {"object_joints", FormatObjectJoints(scene.dimension)},
               {"tip", FormatTip(scene.dimension, s)},
               {"stiffness", FormatDouble(s.finger_stiffness_N_m)},
               {"damping", FormatDouble(s.finger_damping_Ns_m)},
               {"mass", FormatDouble(s.mass_factor * s.mass_kg)},
               {"inertia", Join({I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)})},
               {"assets", parts.assets},
               {"object_geoms", parts.object_geoms},
               {"fingers", parts.fingers},
               {"actuators", parts.actuators},
               {"keyframe", FormatKeyframe(scene.dimension, hold)}});
}

}  // namespace regrasp::sim
