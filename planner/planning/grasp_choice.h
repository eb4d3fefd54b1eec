#pragma once

#include <string>

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

}  // namespace regrasp
