#pragma once

#include <filesystem>
#include <vector>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Convert MJCF of a newer MuJoCo version to the linked version, and list its mesh files.
/// Elements and attributes that the linked version's schema (MujocoSchema) lacks are converted:
///
/// | found | becomes |
/// | --- | --- |
/// | integrator implicitfast | implicit |
/// | ccd_iterations, ccd_tolerance | mpr_iterations, mpr_tolerance |
/// | compiler assetdir | meshdir and texturedir |
/// | no autolimits (true in newer versions) | autolimits true, if an element has a range |
/// | position kv, timeconst | general with gainprm, biasprm "0 −kp −kv", a filter |
/// | position dampratio | the same with kv = 2 ratio √(kp m), m the inertia that it moves |
/// | position inheritrange r | ctrlrange: that of the joint, r times as wide |
/// | joint actuatorfrcrange | forcerange of its actuators, by their gear |
/// | dyntype filterexact | filter |
/// | frame | a body without joints |
///
/// Attributes of default classes are included. All other unknown attributes, sensors, plugins and
/// solver settings are removed. Keyframes lose their controls if an actuator is removed. Visual
/// geoms whose mesh file is missing or empty are removed (missing_meshes.h).
/// @throws InputError  if the model has replicate, attach or flexcomp, which are part of the hand
///     and cannot be converted; or if a mesh that a geom requires is missing or empty.
void ConvertMjcf(const std::filesystem::path& folder, ModelText& text);

/// Write the dampings of the actuators in `damping_ratios`.
/// @param dampings  dampings in the order of `damping_ratios`, N m s/rad.
void SetDampings(const std::vector<double>& dampings, ModelText& text);

}  // namespace regrasp::kinematics
