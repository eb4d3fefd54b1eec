"""Read the NumPy lists of dictionaries in which DexGraspNet stores the grasps of an object."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _dict_file, _poses
from ._arguments import mapping, member
from ._hand_grasps import HandGrasps
from ._regrasp import InputError

_POSITION = ["WRJTx", "WRJTy", "WRJTz"]
_ANGLES = ["WRJRx", "WRJRy", "WRJRz"]


def read_dexgraspnet(path: str | os.PathLike) -> HandGrasps:
    """Read a list of DexGraspNet: an NPY array of dictionaries with `qpos` and `scale`.

    The poses are those of the hand in the frame of the object, which is scaled by `scale`. `WRJTx`,
    `WRJTy` and `WRJTz` are in metres. `WRJRx`, `WRJRy` and `WRJRz` are rotations about the object's
    x, then its y, then its z axis in radians (Euler angles "sxyz"). All other values of `qpos` are
    joint angles by joint name. No code in the file is executed.

    Args:
        path: NPY file.

    Raises:
        InputError: If the file is invalid. The message names the file, the grasp and the member.
    """
    name = path = _arguments.path("path", path)
    entries = _dict_file.read_content(path)
    if isinstance(entries, dict):
        raise InputError(f"{name} must be a list of dictionaries, as DexGraspNet writes it, found one "
                         "dictionary")
    if not entries:
        raise InputError(f"{name} must have at least one grasp, found none")
    joint_names: list[str] = []
    rows, scales, lost = [], [], set()
    for i, entry in enumerate(entries):
        where = f"{name}[{i}]"
        qpos = mapping(f"{where}: qpos", member(where, entry, "qpos"))
        if i == 0:
            joint_names = _arguments.texts(f"{where}: qpos", [
                key for key in qpos if key not in _POSITION + _ANGLES])
        rows.append(_row(f"{where}: qpos", qpos, joint_names))
        scale = f"{where}: scale"
        scales.append(_arguments.number(scale, _number(scale, member(where, entry, "scale")), 0))
        lost |= set(entry) - {"qpos", "scale"}
    values = np.array(rows)
    stem = os.path.splitext(os.path.basename(name))[0]
    return HandGrasps(values[:, :3], _quaternions(values[:, 3:6]), joint_names, values[:, 6:],
                      [f"{stem}_{i}" for i in range(len(rows))], np.ones(len(rows)),
                      sorted([*lost, _scale_note(scales)]), np.array(scales), objects=[f"{stem}.obj"] * len(rows),
                      # The released set has only validated grasps, without the energies of the generator.
                      claimed=None if lost else np.ones(len(rows), dtype=bool), set_name="dexgraspnet")


def _number(where: str, value) -> float:
    """Return a finite number, which may be an array with one element."""
    array = _arguments.numbers(where, value, "()", (0, 1)).ravel()
    if len(array) != 1:
        raise InputError(f"{where} must be a number, found {len(array)} numbers")
    return float(array[0])


def _row(where: str, qpos: dict, joint_names: list[str]) -> list[float]:
    """Return position, Euler angles and joints in one order."""
    keys = [*_POSITION, *_ANGLES, *joint_names]
    other = sorted(map(str, set(qpos) - set(keys)))
    if other:
        raise InputError(f"{where}: {_arguments.shown(other[0])} must be a joint of the first grasp")
    return [_number(f"{where}: {key}", member(where, qpos, key)) for key in keys]


def _quaternions(angles: np.ndarray) -> np.ndarray:
    """Return quaternions (N, 4) of consecutive rotations (N, 3) about the fixed axes x, y and z."""
    result = np.zeros((len(angles), 4))
    result[:, 0] = 1
    for axis in range(3):
        turn = np.zeros_like(result)
        turn[:, 0], turn[:, 1 + axis] = np.cos(angles[:, axis] / 2), np.sin(angles[:, axis] / 2)
        result = _poses.product(turn, result)
    return result


def _scale_note(scales: list[float]) -> str:
    values, counts = np.unique(scales, return_counts=True)
    if len(values) == 1:
        return f"scale, to be given as --scale {values[0]:g}"
    shown = ", ".join(f"{value:g} of {count}" for value, count in zip(values[:10], counts))
    more = f" and {len(values) - 10} other values" if len(values) > 10 else ""
    return f"scale, which differs between the grasps: {shown}{more}"
