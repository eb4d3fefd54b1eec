#pragma once

#include <filesystem>
#include <vector>

#include "planner/kinematics/model_text.h"

namespace regrasp::kinematics {

/// Converts MJCF that is written for a newer MuJoCo to what the linked one knows, and names the
/// files of its meshes. What its schema (MujocoSchema) does not have is
///
/// | found | becomes |
/// | --- | --- |
/// | integrator implicitfast | implicit |
/// | ccd_iterations, ccd_tolerance | mpr_iterations, mpr_tolerance |
/// | compiler assetdir | meshdir and texturedir |
/// | no autolimits (newer ones take it for true) | autolimits true, where something has a range |
/// | position kv, timeconst | general with gainprm, biasprm "0 −kp −kv", a filter |
/// | position dampratio | the same with kv = 2 ratio √(kp m), m the inertia that it moves |
/// | position inheritrange r | ctrlrange: that of the joint, r times as wide |
/// | joint actuatorfrcrange | forcerange of its actuators, by their gear |
/// | dyntype filterexact | filter |
/// | frame | a body without joints |
///
/// Attributes are taken from the classes of defaults too. All else is left out: attributes,
/// sensors, plugins, settings of the solver. Keyframes lose their controls where an actuator is
/// left out. Geoms that only show a mesh whose file is missing or empty are left out, too
/// (missing_meshes.h).
/// @throws InputError  replicate, attach, flexcomp: they are part of the hand, and cannot be
///                     converted; a mesh that a geom needs is missing or empty.
void ConvertMjcf(const std::filesystem::path& folder, ModelText& text);

/// Writes the dampings of the actuators that `damping_ratios` names, in its order, N m s/rad.
void SetDampings(const std::vector<double>& dampings, ModelText& text);

}  // namespace regrasp::kinematics
