"""What a hand and the object in it do over time."""

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
"""Seconds from each state of a plan to the next, as a plan has no times."""


@dataclass
class HandMotion:
    """T instants of J joints and the object."""

    times: np.ndarray
    """(T,) seconds, growing."""
    joint_names: list[str]
    """Of the J joints."""
    joints: np.ndarray
    """(T, J), radians, of slides metres."""
    object_poses: np.ndarray
    """(T, 7) of the object's frame in the palm's: metres, and a quaternion w, x, y, z."""
    control_names: list[str] = field(default_factory=list)
    """Of the A controls; empty where there are none."""
    controls: np.ndarray = field(default_factory=lambda: np.zeros((0, 0)))
    """(T, A): of position servos radians."""
    lost: list[str] = field(default_factory=list)
    """What the file has besides and could not be carried over, in words."""

    def __post_init__(self):
        """
        Raises:
            InputError: the arrays have other shapes than each other, values that are not finite, or
                times that do not grow.
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
    """Reads what `validate --hand HAND --trajectory FILE.npz` writes.

    Raises:
        InputError: names the file, the array and what is wrong.
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
        # NumPy gives a member that is no array as its bytes.
        for key, array in found.items():
            if not isinstance(array, np.ndarray):
                raise ValueError(f"{key} is not an array")
    except (FileNotFoundError, IsADirectoryError, PermissionError):
        raise
    except Exception as error:  # what an archive that is damaged or made up brings about
        raise InputError(f"{name}: not an NPZ file of arrays: {error}".replace("\n", " ")) from None
    for key in keys:
        _arguments.member(name, found, key)
    try:
        return HandMotion(found["time_s"], found["joint_names"].tolist(), found["joints"],
                          found["object"], found["control_names"].tolist(), found["controls"])
    except InputError as error:
        raise InputError(f"{name}: {error}") from None


def motion_of_plan(path: str | os.PathLike, hand: Hand) -> HandMotion:
    """All states of a plan for a hand, in its order, a tenth of a second apart.

    Args:
        path: of the plan file.
        hand: that it is for; names its joints.

    Raises:
        InputError: the plan is for fingers without a hand, or for another one.
    """
    _, data = hand_plan(path, hand)
    states = [data["hand"]["initial"]]
    # A path begins where the one before it ended.
    for step in data["steps"]:
        states += [state for path in paths_of(step) for state in path[1:]]
    joints = joints_of(states)
    poses = np.array([[*s["pose"]["position"], *s["pose"]["quaternion"]] for s in states])
    return HandMotion(PLAN_INTERVAL * np.arange(len(states)), hand.joint_names, joints, poses,
                      lost=["contacts", "which fingers hold",
                            f"a plan has no times: its states are {PLAN_INTERVAL:g} s apart"])


def hand_plan(path: str | os.PathLike, hand: Hand) -> tuple[str, dict]:
    """The name of a plan file, and the plan as a dictionary, if it is for this hand.

    Raises:
        InputError: it is not.
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
    """The joint angles of a plan's states, radians, in the order of Hand.joint_names: (N, J)."""
    return np.array([[angle for finger in state["joints"] for angle in finger]
                     for state in states])


def paths_of(step: dict) -> list[list[dict]]:
    """The paths of states of a plan's step, in their order."""
    if step["kind"] == "move":
        return [step["path"]]
    motion = step.get("motion", [])
    return [motion["place"], motion["release"]] if isinstance(motion, dict) else motion
