#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/plan.h"
#include "planner/plan/snapshot.h"
#include "render/frames/frame.h"

namespace regrasp::render {

struct AnimationOptions {
  int width = 640;
  int height = 480;
  double thickness = kUsualThickness;  ///< of the prism of a planar object, in diameters
};

/// How an animation is cut: pictures where something moves, whatever its time in the replay, and a
/// rest at the end of every entry. A unit of motion is a fingertip's travel of kMotionUnit
/// diameters, or half of the largest contact force coming or going.
inline constexpr double kMotionUnit = 0.02;
inline constexpr double kPicturesPerUnit = 4;  ///< a finger comes down in ten pictures
inline constexpr int kFewestPictures = 8;      ///< of an entry
inline constexpr int kMostPictures = 64;       ///< of an entry: a long align goes faster
inline constexpr int kPictureTime_ms = 50;     ///< 20 pictures a second
inline constexpr int kRestTime_ms = 900;

/// A plan of many entries has fewer pictures an entry, but one at least and its rest.
inline constexpr int kMostPicturesInAll = 900;

/// How far the replay has come at each sample, in units of motion, ascending. A jump, where a free
/// finger appears somewhere else, counts as little; time counts a little too, so that no two
/// samples are equal.
/// @param largest_force  newtons, > 0.
[[nodiscard]] std::vector<double> MeasureProgress(const std::vector<plan::Snapshot>& samples,
                                                  double diameter_m, double largest_force);

/// The instants of one entry that an animation shows, by their index in `progress`: at most
/// `count`, evenly spaced over what lies in (from, to], ascending, without repetition.
/// @param progress  ascending.
[[nodiscard]] std::vector<int> ChooseInstants(const std::vector<double>& progress, double from,
                                              double to, int count);

/// The whole replay as an animated WebP file: its pictures are spread over what moves, so that a
/// finger is seen to come down, forces to change, and a finger to leave; every entry rests at its
/// end. Deterministic.
/// @param samples  states during the replay, ascending in time.
/// @param rests    the state after each entry that was replayed, in the order of the plan, ≥ 1.
/// @param on_entry  called with the number of entries drawn, after each.
/// @throws EnvironmentError       no off-screen rendering context.
/// @throws std::invalid_argument  a size that frames cannot have, or no rest.
[[nodiscard]] std::string RenderAnimation(const object::Object& object, const plan::Plan& plan,
                                          double half_angle,
                                          const std::vector<plan::Snapshot>& samples,
                                          const std::vector<plan::Snapshot>& rests,
                                          const AnimationOptions& options = {},
                                          const std::function<void(int)>& on_entry = {});

}  // namespace regrasp::render
