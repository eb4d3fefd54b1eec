#pragma once

#include <span>
#include <vector>

#include "planner/object/object.h"
#include "planner/plan/reason.h"

namespace regrasp::plan {

/// Many grasps of k contacts each on an object, in the layout of grasp::GraspArrays.
struct LocatedGrasps {
  std::vector<double> points;   ///< projected onto the surface
  std::vector<double> normals;  ///< unit, into the object: the faces' own
  /// Of each grasp kNone, or why it cannot be held: kOffSurface or kWrongNormal (also of a point on
  /// a border without a normal) of its first contact that has no place, which is left as it was
  /// given, as are those after it; kUnreachable of one in a sealed cavity; kCoincidentFingers.
  std::vector<Reason> reasons;
  /// Of each grasp the index of the contact that the reason is of; −1 with kNone and
  /// kCoincidentFingers.
  std::vector<int> contacts;
};

/// Places every contact as a grasp file's is (LocateContact); without normals on the only face at
/// its point.
/// @param points   N x k x 3 finite values.
/// @param normals  as many, or none.
/// @param threads  0: as many as the machine has cores.
/// @throws std::invalid_argument  another number of values, or fewer than 0 threads.
[[nodiscard]] LocatedGrasps LocateGrasps(const object::Object& object,
                                         std::span<const double> points,
                                         std::span<const double> normals, int contacts,
                                         int threads = 0);

}  // namespace regrasp::plan
