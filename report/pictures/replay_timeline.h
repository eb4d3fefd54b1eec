#pragma once

#include <vector>

#include "planner/plan/plan.h"
#include "planner/plan/projection.h"
#include "render/viewer/viewer_scene.h"
#include "report/pictures/hand_picture.h"
#include "report/pictures/report_pictures.h"

namespace regrasp::report {

/// A replay over time: states in the world frame, and the time at which each entry ends. Each entry
/// starts at the end of the entry before it, the first at 0.
struct ReplayTimeline {
  std::vector<render::ViewerSample> samples;
  std::vector<double> ends;
  bool simulated_time = false;
};

/// Return the fingers that any of the entries shows, ascending and at most kMostDrawnFingers.
[[nodiscard]] std::vector<FingerIndex> FingersOf(const std::vector<ShownEntry>& entries);

/// Return the motion between the entries of a plan (MakePointTimeline, MakeHandTimeline).
/// @param hand  hand of the plan; null: fingers without a hand.
[[nodiscard]] ReplayTimeline MakeTimeline(const object::Object& object, const Report& report,
                                          const std::vector<ShownEntry>& entries,
                                          const std::vector<FingerIndex>& fingers,
                                          const HandPicture* hand,
                                          const std::vector<HandSample>& samples);

/// Return the motion of a plan without a hand, from the static grasp after each entry.
///
/// A finger that is placed travels around the object and approaches its contact along the normal.
/// Then forces change from one static grasp to the next, and sliding fingers follow their paths. A
/// released finger leaves along the normal. Times do not have the scale of the simulation.
/// @param fingers     fingers of each sample (FingersOf).
/// @param centroid_m  centroid of the object in its frame, metres.
[[nodiscard]] ReplayTimeline MakePointTimeline(const std::vector<ShownEntry>& entries,
                                               const std::vector<FingerIndex>& fingers,
                                               const Eigen::Vector3d& centroid_m,
                                               double diameter_m);

/// Return the motion of a plan for a hand.
///
/// Entries with recorded states show these. All others show the planned path up to the failing
/// instant, if there is one; their fingers have the forces of the static grasps before and after.
/// @param samples  recorded states, ascending in time; may be empty.
[[nodiscard]] ReplayTimeline MakeHandTimeline(const std::vector<ShownEntry>& entries,
                                              const std::vector<FingerIndex>& fingers,
                                              const HandPicture& hand,
                                              const std::vector<HandSample>& samples);

}  // namespace regrasp::report
