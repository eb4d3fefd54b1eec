#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::sampling {

/// Thrown for a negative answer: a random grasp could not be drawn, or a planner has no place for a
/// grasp that it is given. PlanResult::Status::kNoGrasp where planners end.
struct NoGrasp {
  std::string message;
};

/// Draws grasps until the evaluator accepts one.
/// @param draw  gives a grasp.
/// @returns nullopt where none of `kMaxSurfaceDraws` draws is accepted.
[[nodiscard]] std::optional<grasp::Grasp> DrawGoodGrasp(const std::function<grasp::Grasp()>& draw,
                                                        const criteria::GraspEvaluator& evaluator);

/// A grasp that the evaluator accepts, of contacts spread evenly over an object's surface. In the
/// plane the random numbers say how many contacts are tried first; where the object has no such
/// grasp of that number, the others of the range are. Two contacts are not drawn where no two edges
/// of a polygon are opposed enough for any.
/// @param contacts     in space as many as the range has at least.
/// @param name         how messages call it.
/// @param before_draw  may throw to make an end.
/// @throws NoGrasp  none of kMaxSurfaceDraws draws of each number is accepted, or fingers reach
///                  next to nothing of the surface.
[[nodiscard]] grasp::Grasp DrawOnSurface(
    const object::Object& object, const grasp::ContactLimits& contacts,
    const criteria::GraspEvaluator& evaluator, RandomStream& random, const std::string& name,
    const std::function<void()>& before_draw = [] {});

/// Draws before a random grasp is given up: at a microsecond each below a second, and enough for
/// objects where one grasp in ten thousand is accepted.
inline constexpr int kMaxSurfaceDraws = 200'000;

}  // namespace regrasp::sampling
