#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "planner/grasp/contact.h"
#include "planner/object/polyhedron.h"
#include "planner/roadmap/random.h"

namespace regrasp {

/// How a plan's start or goal is chosen.
struct GraspChoice {
  enum class Kind {
    kGiven,      ///< `grasp`
    kRandom,     ///< a vertex of the roadmap; a goal out of the start's component
    kRandomAny,  ///< four contacts drawn evenly over the surface, reachable or not
  };
  Kind kind = Kind::kGiven;
  Grasp grasp;
  std::string name;  ///< how messages call it: the file, or "--start random"
};

/// Checks a grasp that the user gives.
/// @throws InputError  it does not have four contacts, two are within `same_point` of each other,
///                     or it is not force closure; the message gives the half-angle it needs.
void CheckGivenGrasp(const GraspChoice& choice, const WrenchFrame& frame, double half_angle,
                     double same_point);

/// Four contacts evenly over the surface that are force closure and of quality `min_quality`.
/// @returns nullopt where none of `kMaxSurfaceDraws` draws serves.
[[nodiscard]] std::optional<Grasp> DrawGraspOnSurface(const Polyhedron& solid, double half_angle,
                                                      double min_quality, double same_point,
                                                      RandomStream& random);

/// Draws before a random grasp is given up: at a microsecond each below a second, and enough for
/// bodies where one grasp in ten thousand serves.
inline constexpr int kMaxSurfaceDraws = 200'000;

}  // namespace regrasp
