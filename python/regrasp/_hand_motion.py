"""Motions of a hand and of the object in it over time."""

from __future__ import annotations

import os
import zipfile
from dataclasses import dataclass, field

import numpy as np

from . import _arguments, _poses
from ._regrasp import InputError
from .hands import Hand
from .plans import Plan

PLAN_INTERVAL = 0.1
"""Time between consecutive states of a plan, s, because a plan has no times."""


@dataclass
class HandMotion:
    """Motion of T samples with J joints and the object's pose."""

    times: np.ndarray
    """Ascending times (T,), s."""
    joint_names: list[str]
    """Names of the J joints."""
    joints: np.ndarray
    """Joint positions (T, J), radians; metres for prismatic joints."""
    object_poses: np.ndarray
    """Poses (T, 7) of the object's frame in the palm frame: metres, and a quaternion w, x, y, z."""
    control_names: list[str] = field(default_factory=list)
    """Names of the A controls; empty if there are none."""
    controls: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    """Controls (T, A); radians for position servos."""
    lost: list[str] = field(default_factory=list)
    """Descriptions of the file's content that is not converted."""

    def __post_init__(self):
        """Check the arrays.

        Raises:
            InputError: If the shapes of the arrays do not match, a value is not finite, or the
                times do not ascend.
        """
        self.times = _arguments.numbers("times", self.times, "(T,)", (1,))
        count = len(self.times)
        if (np.diff(self.times) < 0).any() or (count and self.times[0] < 0):
            raise InputError("times must be increasing and not negative")
        self.joint_names = _arguments.texts("joint_names", self.joint_names)
        self.control_names = _arguments.texts("control_names", self.control_names)
        for name, width, names in [
                ("joints", len(self.joint_names), " and as many joint_names"), ("object_poses", 7, ""),
                ("controls", len(self.control_names), " and as many control_names")]:
            if name == "controls" and not width:
                self.controls = np.zeros((count, 0))
                continue
            array = _arguments.numbers(name, getattr(self, name), f"({count}, {width})", (2,))
            if array.shape != (count, width):
                raise InputError(f"{name} must have shape ({count}, {width}) for {count} times{names}, "
                                 f"found {array.shape}")
            setattr(self, name, array)
        self.object_poses[:, 3:] = _poses.unit("object_poses", self.object_poses[:, 3:])

    def __len__(self) -> int:
        return len(self.times)


def read_trajectory(path: str | os.PathLike) -> HandMotion:
    """Read a trajectory written by `validate --hand HAND --trajectory FILE.npz`.

    Args:
        path: NPZ file.

    Raises:
        InputError: If the file is invalid. The message names the file and the array.
    """
    name = path = _arguments.path("path", path)
    keys = ("time_s", "joint_names", "joints", "object", "control_names", "controls")
    try:
        with open(path, "rb") as file:
            if not zipfile.is_zipfile(file):
                raise ValueError("not a ZIP archive")
            file.seek(0)
            with np.load(file, allow_pickle=False) as arrays:
                found = {key: arrays[key] for key in keys if key in arrays}
        # NumPy returns the bytes of a member that is not an array.
        for key, array in found.items():
            if not isinstance(array, np.ndarray):
                raise ValueError(f"{key} is not an array")
    except (FileNotFoundError, IsADirectoryError, PermissionError):
        raise
    except Exception as error:  # caused by damaged or forged archives
        raise InputError(f"{name}: not an NPZ file of arrays: {error}".replace("\n", " ")) from None
    for key in keys:
        _arguments.member(name, found, key)
    try:
        return HandMotion(found["time_s"], found["joint_names"].tolist(), found["joints"],
                          found["object"], found["control_names"].tolist(), found["controls"])
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def motion_of_plan(path: str | os.PathLike, hand: Hand) -> HandMotion:
    """Return all states of a plan for a hand, in order, 0.1 s apart.

    Args:
        path: Plan file.
        hand: Hand of the plan, which gives the names of its joints.

    Raises:
        InputError: If the plan has no hand, or a different one.
    """
    _, data = hand_plan(path, hand)
    states = [data["hand"]["initial"]]
    # The first state of a path equals the last state of the path before it.
    for step in data["steps"]:
        states += [state for path in paths_of(step) for state in path[1:]]
    joints = joints_of(states)
    poses = np.array([[*s["pose"]["position"], *s["pose"]["quaternion"]] for s in states])
    return HandMotion(PLAN_INTERVAL * np.arange(len(states)), hand.joint_names, joints, poses,
                      lost=["contacts", "which fingers hold",
                            f"a plan has no times: its states are {PLAN_INTERVAL:g} s apart"])


def hand_plan(path: str | os.PathLike, hand: Hand) -> tuple[str, dict]:
    """Return the name of a plan file, and the plan as a dictionary.

    Raises:
        InputError: If the plan is not a plan for this hand.
    """
    name = _arguments.path("path", path)
    _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
    data = Plan.read(name).data
    if "hand" not in data:
        raise InputError(f"{name}: not a plan for a hand")
    if data["hand"]["name"] != hand.name:
        raise InputError(f"{name}: the plan must be for {hand.name}, found {data['hand']['name']}")
    count = sum(len(finger) for finger in data["hand"]["initial"]["joints"])
    if count != len(hand.joint_names):
        raise InputError(f"{name}: expected {len(hand.joint_names)} joints of {hand.name}, found {count}")
    return name, data


def joints_of(states: list[dict]) -> np.ndarray:
    """Return the joint angles (N, J) of states of a plan, radians, in the order of
    Hand.joint_names."""
    return np.array([[angle for finger in state["joints"] for angle in finger]
                     for state in states])


def paths_of(step: dict) -> list[list[dict]]:
    """Return the paths of states of a plan's step, in order."""
    if step["kind"] == "move":
        return [step["path"]]
    motion = step.get("motion", [])
    return [motion["place"], motion["release"]] if isinstance(motion, dict) else motion
