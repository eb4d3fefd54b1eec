#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/grasp/required_half_angle.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp {

/// Of the folder models, in space and in the plane.
inline constexpr std::array kGraspedBodies = {"cube.obj",        "l_block.obj", "hole_block.obj",
                                              "stone.obj",       "mug500.obj",  "polygon15.wkt",
                                              "polygon_hole.wkt"};
/// The friction that grasps are examined at, over the critical one.
inline constexpr double kLeastRatio = 0.7;
inline constexpr double kMostRatio = 1.5;

/// Where grasps are drawn, and how: contacts evenly over the surface where a fingertip has room.
class GraspedBody {
 public:
  explicit GraspedBody(const std::filesystem::path& path)
      : name_(path.stem().string()), file_(object::ReadObject(path)), source_(*file_.object) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const object::Object& object() const { return *file_.object; }
  [[nodiscard]] const sampling::SurfaceSampler& source() const { return source_; }
  /// How many fingers hold it.
  [[nodiscard]] int hold() const { return object().dimension() == 2 ? 3 : 4; }

 private:
  std::string name_;
  object::ObjectFile file_;
  sampling::SurfaceSampler source_;
};

/// A plan whose last grasp is examined at some friction.
struct RandomCase {
  plan::Plan plan;
  grasp::Grasp examined;
  double ratio = 0;                   ///< of the plan's μ to the critical one of `examined`
  grasp::RequiredHalfAngle required;  ///< of `examined`
};

/// Random grasps whose critical friction is between 0.5° and 50°, each at a friction drawn evenly
/// between kLeastRatio and kMostRatio times that: plans of the hold alone.
[[nodiscard]] std::vector<RandomCase> DrawHolds(const GraspedBody& body, int count,
                                                std::uint64_t seed);

/// The same of grasps after a switch of one finger, from a grasp that resists much more than the
/// default shake, so that a fail is the second's.
[[nodiscard]] std::vector<RandomCase> DrawSwitches(const GraspedBody& body, int count,
                                                   std::uint64_t seed);

}  // namespace regrasp
