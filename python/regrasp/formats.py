"""Grasps and plans in third-party formats (docs/interchange.md has the table)."""

from ._acronym import read_acronym
from ._dexgraspbench import read_bodex, read_dexgraspbench
from ._dexgraspnet import read_dexgraspnet
from ._finger_grasps import FingerGrasps
from ._get_a_grip import read_get_a_grip, with_closing_targets
from ._graspit import read_graspit
from ._hand_grasp_lines import write_hand_grasps
from ._hand_grasps import HandConfigurations, HandGrasps, of_plan
from ._hand_motion import HandMotion, motion_of_plan, read_trajectory
from ._hidex import read_hidex
from ._isaac_grasp import read_isaac_grasp, write_isaac_grasp
from ._multigrippergrasp import read_multigrippergrasp
from ._ros2 import write_mcap

__all__ = [
    "FingerGrasps",
    "HandConfigurations",
    "HandGrasps",
    "HandMotion",
    "motion_of_plan",
    "of_plan",
    "read_acronym",
    "read_bodex",
    "read_dexgraspbench",
    "read_dexgraspnet",
    "read_get_a_grip",
    "read_graspit",
    "read_hidex",
    "read_isaac_grasp",
    "read_multigrippergrasp",
    "read_trajectory",
    "with_closing_targets",
    "write_hand_grasps",
    "write_isaac_grasp",
    "write_mcap",
]
