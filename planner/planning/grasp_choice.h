#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"
#include "planner/object/wrench_frame.h"

namespace regrasp {

/// How a plan's start or goal is chosen.
struct GraspChoice {
  enum class Kind {
    kGiven,      ///< `grasp`
    kRandom,     ///< drawn from the planner's own graph; a goal out of the start's component
    kRandomAny,  ///< drawn evenly over the surface, reachable or not
  };
  Kind kind = Kind::kGiven;
  Grasp grasp;
  std::string name;  ///< how messages call it: the file, or "--start random"
};

/// How many contacts a planner's grasps have.
struct ContactCount {
  std::string planner;  ///< for messages
  int least = 0;
  int most = 0;
};

/// Checks a grasp that the user gives.
/// @throws InputError  it has another number of contacts, two are within `same_point` of each
/// other,
///                     or it is not force closure; the message gives the half-angle it needs.
void CheckGivenGrasp(const GraspChoice& choice, const ContactCount& count, const WrenchFrame& frame,
                     double half_angle, double same_point);

/// Checks that fingers of a radius (reach.h) can hold a grasp that the user gives.
/// @throws InputError  a contact cannot be reached, or two are too close; the message says why.
void CheckFingersFit(const GraspChoice& choice, const Object& object, double finger_radius);

/// Draws grasps until one is force closure and of quality `min_quality`, its contacts farther apart
/// than `same_point`, and fingers of a radius keep apart in it (KeepApart).
/// @param draw  gives a grasp.
/// @returns nullopt where none of `kMaxSurfaceDraws` draws serves.
[[nodiscard]] std::optional<Grasp> DrawGoodGrasp(const std::function<Grasp()>& draw,
                                                 const WrenchFrame& frame, double half_angle,
                                                 double min_quality, double same_point,
                                                 double finger_radius = 0);

/// Draws before a random grasp is given up: at a microsecond each below a second, and enough for
/// bodies where one grasp in ten thousand serves.
inline constexpr int kMaxSurfaceDraws = 200'000;

}  // namespace regrasp
