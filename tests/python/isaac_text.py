"""Sample file of two grasps in the format isaac_grasp 1.0."""

ISAAC = """\
format: isaac_grasp
format_version: 1.0
object_frame: /World/mug
gripper_frame: /World/hand
grasps:
  first:
    confidence: 0.5
    position: [-0.04, 0.06, 0.2]
    orientation: {w: 0.0, xyz: [0.6, 0.8, 0.0]}
    cspace_position: {b: 0.25, a: -1}
    pregrasp_cspace_position: {a: 0.0, b: 0.0}
  second:
    position: [1, 2, 3]
    orientation: {w: 1.0, xyz: [0, 0, 0]}
    cspace_position: {a: 4, b: 5}
"""
