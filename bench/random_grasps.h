#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "planner/grasp/required_friction_angle.h"
#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/sampling/surface_sampler.h"

namespace regrasp {

/// Objects of the folder models, in space and in the plane.
inline constexpr std::array kGraspedBodies = {"cube.obj",        "l_block.obj", "hole_block.obj",
                                              "stone.obj",       "mug500.obj",  "polygon15.wkt",
                                              "polygon_hole.wkt"};
/// Range of the friction coefficient of tested grasps, in required friction coefficients.
inline constexpr double kLeastRatio = 0.7;
inline constexpr double kMostRatio = 1.5;

/// Object and sampler of grasps.
/// Contacts are uniform over the part of the surface that a fingertip can reach.
class GraspedBody {
 public:
  explicit GraspedBody(const std::filesystem::path& path)
      : name_(path.stem().string()), file_(object::ReadObject(path)), source_(*file_.object) {}

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const object::Object& object() const { return *file_.object; }
  [[nodiscard]] const sampling::SurfaceSampler& source() const { return source_; }
  /// Return the number of fingers that hold the object.
  [[nodiscard]] int hold() const { return object().dimension() == 2 ? 3 : 4; }

 private:
  std::string name_;
  object::ObjectFile file_;
  sampling::SurfaceSampler source_;
};

/// Plan whose last grasp is tested at a given friction.
struct RandomCase {
  plan::Plan plan;
  grasp::Grasp examined;
  double ratio = 0;  ///< friction coefficient of the plan over the required one of `examined`
  grasp::RequiredFrictionAngle required;  ///< required friction angle of `examined`
};

/// Draw static grasps with a required friction angle between 0.5° and 50°, as plans that only hold.
/// The friction coefficient of each is uniform between kLeastRatio and kMostRatio times the
/// required one.
[[nodiscard]] std::vector<RandomCase> DrawHolds(const GraspedBody& body, int count,
                                                std::uint64_t seed);

/// Draw grasps after a switch of one finger, with friction as in DrawHolds. The first grasp resists
/// much more than the default disturbance, so that a failure is that of the second.
[[nodiscard]] std::vector<RandomCase> DrawSwitches(const GraspedBody& body, int count,
                                                   std::uint64_t seed);

}  // namespace regrasp
