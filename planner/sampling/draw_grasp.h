#pragma once

#include <functional>
#include <optional>
#include <string>

#include "planner/base/random.h"
#include "planner/criteria/grasp_evaluator.h"
#include "planner/grasp/contact.h"
#include "planner/object/object.h"

namespace regrasp::sampling {

/// Negative result: no random grasp is found, or a planner cannot represent a given grasp.
/// Planners convert it to PlanResult::Status::kNoGrasp.
struct NoGrasp {
  std::string message;
};

/// Draw grasps until the evaluator accepts one.
/// @param draw  function that draws a grasp.
/// @returns nullopt if none of `kMaxSurfaceDraws` grasps is accepted.
[[nodiscard]] std::optional<grasp::Grasp> DrawGoodGrasp(const std::function<grasp::Grasp()>& draw,
                                                        const criteria::GraspEvaluator& evaluator);

/// Draw an accepted grasp with contacts uniformly distributed over an object's surface.
/// In the plane the initial number of contacts is random. If no grasp with that number is accepted,
/// the other numbers of the range follow. Two contacts are skipped for polygons without
/// sufficiently opposed edges.
/// @param contacts     range of the number of contacts; in space only its minimum is used.
/// @param name         name of the grasp in messages.
/// @param before_draw  called before each grasp; can throw to stop.
/// @throws NoGrasp  if none of kMaxSurfaceDraws grasps of each number is accepted, or fingers reach
///     almost no part of the surface.
[[nodiscard]] grasp::Grasp DrawOnSurface(
    const object::Object& object, const grasp::ContactLimits& contacts,
    const criteria::GraspEvaluator& evaluator, RandomStream& random, const std::string& name,
    const std::function<void()>& before_draw = [] {});

/// Largest number of drawn grasps. At 1 µs each they take less than a second, and they suffice for
/// objects that accept one grasp in ten thousand.
inline constexpr int kMaxSurfaceDraws = 200'000;

}  // namespace regrasp::sampling
