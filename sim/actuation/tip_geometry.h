#pragma once

#include <string>
#include <vector>

#include "planner/collision/convex_shape.h"
#include "planner/kinematics/hand_file.h"
#include "sim/scene/settings.h"

struct mjModel_;

namespace regrasp::sim {

/// What of a fingertip touches the object, in the frame of the tip's link, metres.
using TipShapes = std::vector<collision::ConvexShape>;

/// By finger: the ball of the hand's file; or with TipShape::kGeometry each geom of the tip's link
/// that collides, as links have them elsewhere (kinematics::ReadHandFile). A shape without a radius
/// gets one of kTipSkin, in which its contacts are found.
/// @throws InputError  a tip's link has no such geom: names the model's file, the link and finger.
[[nodiscard]] std::vector<TipShapes> TipShapesOf(const kinematics::HandFile& file, TipShape tip);

/// Return the collision geometry of a body as convex shapes in the body's frame, metres: the shapes
/// of its geoms (kinematics::ShapeOfGeom), of meshes a hull of at most 500 points.
[[nodiscard]] std::vector<collision::ConvexShape> CollisionShapesOf(const mjModel_& model,
                                                                    const std::string& body);

inline constexpr double kTipSkin = 2e-4;  ///< metres: thrice as deep as tips press at rest

}  // namespace regrasp::sim
