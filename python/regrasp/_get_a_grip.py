"""Read the NumPy dictionaries in which Get-a-Grip stores the grasps of an object."""

from __future__ import annotations

import os
import re
from dataclasses import replace

import numpy as np

from . import _arguments, _dict_file, _poses
from ._arguments import member, shown
from ._hand_grasps import HandConfigurations, HandGrasps
from ._regrasp import InputError
from .hands import Hand

MEMBERS = {"trans", "rot", "joint_angles"}
"""Members of each file."""

JOINT_NAMES = {
    "Allegro": [f"joint_{i}.0" for i in range(16)],
    "LEAP": [str(i) for i in (1, 0, 2, 3, 5, 4, 6, 7, 9, 8, 10, 11, 12, 13, 14, 15)],
}
"""Order of the joints in the files by hand. Each finger has four consecutive ones."""

_CLOSING_M = 0.05
_ITERATIONS = 100
_STEP = 5
"""Closing distance, number and size of the gradient steps of the project's own code."""

_ROTATION = 1e-3
"""Largest deviation of an element of R Rᵀ from the unit matrix. The files have single precision."""
_DIFFERENCE = 1e-6
_BATCH = 500


def read_get_a_grip(path: str | os.PathLike, hand: Hand | None = None) -> HandGrasps:
    """Read a config dictionary of Get-a-Grip: the grasps of one object at one scale.

    `trans` and `rot` are the pose of the hand's root link in the frame of the object, in metres.
    `joint_angles` is the configuration before the hand closes. The name of the file is
    `OBJECT_S_SSSS.npy`, with the scale as a number with four decimals. The directions are the third
    columns of `grasp_orientations`, as in the code of the project (its documentation states the
    first column). The claimed success is `y_PGS` above 0.5, and the score is `y_PGS`. No code in
    the file is executed.

    Args:
        path: NPY file.
        hand: Hand of the grasps, whose joints have the names of the data set, or are in its order.
            Default: joints without names.

    Raises:
        InputError: If the file is invalid. The message names the file, the member and the element.
    """
    name = path = _arguments.path("path", path)
    data = _dict_file.read_dict(path)
    positions = _table(name, data, "trans", (None, 3))
    count = len(positions)
    rotations = _rotations(name, data, "rot", (count, 3, 3))
    joints = _table(name, data, "joint_angles", (count, None))
    score = _table(name, data, "y_PGS", (count,)) if "y_PGS" in data else None
    names = [] if hand is None else _joint_names(name, hand, joints.shape[1])
    directions = None
    if "grasp_orientations" in data:
        directions = _rotations(name, data, "grasp_orientations", (count, None, 3, 3))[..., 2]
        if hand is not None:
            directions = directions[:, _columns(name, hand, names, directions.shape[1])]
    stem = os.path.splitext(os.path.basename(name))[0]
    found = re.fullmatch(r"(.+)_(\d_\d{4})", stem)
    scale = float(found[2].replace("_", ".")) if found else 0
    read = MEMBERS | {"grasp_orientations", "y_PGS"}
    lost = sorted(map(str, set(data) - read)) + ([] if directions is None else ["grasp_orientations"])
    if scale > 0:
        lost.append(f"scale, to be given as --scale {scale:g}")
    return HandGrasps(
        positions, _poses.of_matrices(rotations), names, joints, [f"{stem}_{i}" for i in range(count)],
        np.ones(count) if score is None else score, lost, np.full(count, scale) if scale > 0 else None,
        claimed=None if score is None else score > 0.5, scored=score is not None,
        objects=[f"{found[1]}.obj"] * count if scale > 0 else None, set_name="get_a_grip", directions=directions)


def with_closing_targets(grasps: HandGrasps, hand: Hand) -> HandGrasps:
    """Return the grasps with targets that move each fingertip along its direction.

    As in the code of Get-a-Grip, 100 gradient steps of size 5 minimize the sum of squared distances
    between the fingertips and the points 5 cm ahead of them, from the joints of the grasp. The
    targets may exceed the joint ranges. A fingertip is the centre of its sphere in the hand file,
    and in Get-a-Grip the mean of points on its surface.

    Args:
        grasps: Grasps with `directions`. The poses are those of the palm.
        hand: Hand of the grasps.

    Raises:
        InputError: If the grasps have no directions, or not one for each finger of the hand.
    """
    if grasps.directions is None:
        raise InputError("grasps must have directions, found none")
    if grasps.directions.shape[1] != len(hand.fingers):
        raise InputError(f"grasps: directions must have {len(hand.fingers)} fingers for {hand.name}, found "
                         f"{grasps.directions.shape[1]}")
    joints = grasps.in_order_of(hand)
    ahead = _CLOSING_M * np.einsum("nji,nfj->nfi", _poses.matrices(grasps.quaternions), grasps.directions)
    closed = [_closed(hand, joints[i:i + _BATCH], ahead[i:i + _BATCH]) for i in range(0, len(grasps), _BATCH)]
    target = HandConfigurations(grasps.positions, grasps.quaternions, np.concatenate([np.zeros_like(joints[:0]), *closed]))
    return replace(grasps, joints=joints, joint_names=hand.joint_names, target=target)


def _closed(hand: Hand, joints: np.ndarray, ahead: np.ndarray) -> np.ndarray:
    """Return joints (N, J) after the gradient steps towards fingertips moved by `ahead` (N, F, 3)."""
    count = joints.shape[1]
    steps = np.concatenate([np.zeros((1, count)), _DIFFERENCE * np.eye(count)])
    wanted = hand.tips(joints) + ahead
    for _ in range(_ITERATIONS):
        tips = hand.tips((joints[:, None] + steps).reshape(-1, count)).reshape(len(joints), count + 1, -1, 3)
        slopes = (tips[:, 1:] - tips[:, :1]) / _DIFFERENCE
        joints = joints + 2 * _STEP * np.einsum("njfi,nfi->nj", slopes, wanted - tips[:, 0])
    return joints


def _table(name: str, data: dict, key: str, shape: tuple) -> np.ndarray:
    """Return numbers of a shape, in which None is any length."""
    text = "(" + ", ".join("N" if length is None else str(length) for length in shape) + ("," if len(shape) == 1 else "") + ")"
    array = _arguments.numbers(f"{name}: {key}", member(name, data, key), text, (len(shape),))
    if any(want not in (None, have) for want, have in zip(shape, array.shape)):
        raise InputError(f"{name}: {key} must have shape {text}, found {array.shape}")
    return array


def _rotations(name: str, data: dict, key: str, shape: tuple) -> np.ndarray:
    """Return rotation matrices (…, 3, 3)."""
    matrices = _table(name, data, key, shape)
    off = np.abs(matrices @ np.swapaxes(matrices, -1, -2) - np.eye(3)).max(axis=(-1, -2), initial=0)
    bad = np.argwhere((off > _ROTATION) | (np.linalg.det(matrices) < 0))
    if len(bad):
        raise InputError(f"{name}: {key}{[int(i) for i in bad[0]]} must be a rotation matrix, found "
                         f"{shown(matrices[tuple(bad[0])].round(3).tolist())}")
    return matrices


def _joint_names(name: str, hand: Hand, count: int) -> list[str]:
    """Return the names of the joints: in the order of the data set if it has the hand, otherwise in that of the hand."""
    names = next((known for known in JOINT_NAMES.values() if set(known) == set(hand.joint_names)), hand.joint_names)
    if len(names) != count:
        raise InputError(f"{name}: joint_angles must have {len(names)} columns for {hand.name}, found {count}")
    return names


def _columns(name: str, hand: Hand, names: list[str], count: int) -> list[int]:
    """Return the number of the direction in the file of each finger of the hand."""
    fingers = len(hand.fingers)
    if count != fingers:
        raise InputError(f"{name}: grasp_orientations must have {fingers} fingers for {hand.name}, found {count}")
    if names not in JOINT_NAMES.values():
        return list(range(fingers))
    return [names.index(joints[0]) * fingers // len(names) for joints in hand._core.joint_names]
