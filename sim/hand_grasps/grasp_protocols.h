#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/object/polyhedron.h"
#include "sim/hand_grasps/grasp_geometry.h"
#include "sim/hand_grasps/grasp_world.h"
#include "sim/hand_grasps/hand_grasp.h"

namespace regrasp::sim {

/// Tests of a hand grasp (docs/evaluate_grasps.md).
enum class GraspProtocol { kAnalytic, kDexGraspBench, kFall, kDisturbance };

/// Return the name: "analytic", "dexgraspbench", "fall" or "disturbance".
[[nodiscard]] std::string_view GraspProtocolName(GraspProtocol protocol);

/// Reasons for which a hand grasp fails a protocol, in the order of their checks.
enum class GraspFault {
  kNone,
  kJointsOutOfRange,
  kPenetrates,
  kNoContact,
  kNotForceClosure,
  kObjectMoved,
  kDropped,
  kForceNotResisted,
  kUnstable,
};

/// Return the name: "none", "joints-out-of-range", "penetrates", "no-contact", …
[[nodiscard]] std::string_view GraspFaultName(GraspFault fault);

/// Parameters of the protocols.
struct GraspTest {
  double mu = 0.6;       ///< friction coefficient
  double mass_kg = 0.1;  ///< mass of the object
};

/// Result of a protocol. Only the values of its protocol are set.
struct ProtocolResult {
  GraspProtocol protocol = GraspProtocol::kAnalytic;
  GraspFault fault = GraspFault::kNone;
  std::optional<double> quality;      ///< analytic: lower bound of ε; absent if not closed
  std::optional<double> moved_m;      ///< dexgraspbench: largest translation of the object
  std::optional<double> rotated_deg;  ///< dexgraspbench: largest rotation of the object
  std::vector<std::optional<double>> seconds;  ///< fall: held time by direction; absent: not run
  std::vector<double> resisted_N;              ///< disturbance: resisted force by direction

  [[nodiscard]] bool passed() const { return fault == GraspFault::kNone; }
};

/// Result of all protocols for a grasp.
struct GraspVerdict {
  std::vector<LinkTouch> touches;  ///< links of the grasp's configuration
  double distance_m = 0;  ///< smallest signed distance of the configuration; negative: depth
  std::vector<ProtocolResult> results;

  /// Return the fault of the first protocol that fails.
  [[nodiscard]] GraspFault fault() const;
};

/// Directions of the loads of all protocols, in the frame of the object: −x, x, −y, y, −z, z.
inline constexpr int kLoadDirections = 6;
[[nodiscard]] Eigen::Vector3d LoadDirection(int direction);

/// Test a grasp by protocols, in their order.
/// The result depends on nothing but the arguments: the world is reset.
/// @param world     world of the grasp's hand and object.
/// @param geometry  geometry of the same world.
/// @throws InputError  as GraspWorld::CheckJoints.
[[nodiscard]] GraspVerdict TestHandGrasp(const HandGrasp& grasp, const object::Object& object,
                                         const GraspGeometry& geometry,
                                         const std::vector<GraspProtocol>& protocols,
                                         const GraspTest& test, GraspWorld& world);

/// Depth beyond which analytic, fall and disturbance reject a grasp, metres.
inline constexpr double kMostGraspDepth = 2e-3;

}  // namespace regrasp::sim
