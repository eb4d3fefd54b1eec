"""Read plans of HiDex (CSV)."""

from __future__ import annotations

import os

import numpy as np

from . import _arguments, _poses
from ._finger_grasps import FingerGrasps
from ._regrasp import InputError

_AWAY = -7777
"""Coordinate that HiDex writes for a finger without contact, if points are in the world frame."""


def read_hidex(path: str | os.PathLike, *, frame: str | None = None,
               mesh_scale: float = 1) -> FingerGrasps:
    """Read a plan of HiDex: the contacts of each finger, one grasp after the other.

    Each row is an instant: point and normal of each finger, then the object's pose (position and
    quaternion x, y, z, w). If the first row is only the number of fingers, the pose comes first,
    and contacts with the environment come last. Consecutive rows in which only the object moves are
    one grasp.

    Args:
        path: CSV file.
        frame: Frame of the contacts, "object" or "world". Default: derived from the fingers without
            contact, which are NaN in the object frame and -7777 in the world frame. A file that
            begins with the number of fingers uses the object frame.
        mesh_scale: Scale of the object's file, `scale` in HiDex's setup.yaml. Points are returned
            in the file's unit.

    Raises:
        InputError: If the file is invalid or the frame cannot be derived. The message names the
            file and the row, or `frame`.
    """
    name = path = _arguments.path("path", path)
    if frame is not None:
        frame = _arguments.choice("frame", frame, ["object", "world"])
    mesh_scale = _arguments.number("mesh_scale", mesh_scale, 0)
    contacts, poses, counted = _table(name, _rows(name))
    points, normals = contacts[..., :3].copy(), contacts[..., 3:]
    away = (points == _AWAY).all(axis=-1)
    holds = ~(np.isnan(points).any(axis=-1) | away)
    if frame is None:
        frame = "world" if away.any() else "object" if counted or not holds.all() else None
    if frame is None:
        raise InputError(f'frame is required for {name}, which does not contain it: "object" or "world"')
    points[~holds] = np.nan
    if frame == "world":
        back = np.swapaxes(_poses.matrices(poses[:, 3:]), 1, 2)
        points = np.einsum("nij,nfj->nfi", back, points - poses[:, None, :3])
        normals = np.einsum("nij,nfj->nfi", back, normals)
    points /= mesh_scale
    first = _changes(points, holds)
    names = [f"row_{row + 1 + counted}" for row in first]
    return FingerGrasps(points[first], np.where(holds[first][..., None], normals[first], np.nan),
                        names, ["the object's poses"] + (
                            ["contacts with the surroundings"] if counted else []))


def _is_number(cell: str) -> bool:
    try:
        return not cell.strip() or float(cell) is not None
    except ValueError:
        return False


def _rows(name: str) -> list[list[float]]:
    try:
        with open(name, encoding="utf-8") as file:
            lines = [line.split(",") for line in file if line.strip()]
    except UnicodeDecodeError as error:
        raise InputError(f"{name}: not a CSV file: {error}") from None
    rows = []
    for i, line in enumerate(lines, 1):
        try:
            rows.append([float(cell) for cell in line if cell.strip()])
        except ValueError:
            wrong = next(cell.strip() for cell in line if not _is_number(cell))
            raise InputError(f"{name}: row {i}: expected numbers, found "
                             f"{_arguments.shown(wrong)}") from None
    return rows


def _table(name: str, rows: list[list[float]]) -> tuple[np.ndarray, np.ndarray, int]:
    """Return contacts (N, F, 6), poses (N, 7) with w first, and the number of rows before them."""
    counted = int(bool(rows) and len(rows[0]) == 1)
    body = rows[counted:]
    if not body:
        raise InputError(f"{name}: expected at least one row with contacts, found none")
    fingers = rows[0][0] if counted else (len(body[0]) - 7) / 6
    if fingers not in range(1, 65):
        found = f"{fingers:g} fingers" if counted else str(len(rows[0]))
        raise InputError(f"{name}: row 1: expected 6 numbers per finger for 1 to 64 fingers and 7 for a pose, "
                         f"found {found}")
    fingers = int(fingers)
    width = 7 + 6 * fingers
    for i, row in enumerate(body, 1 + counted):
        if len(row) != width and not (counted and len(row) > width):
            raise InputError(f"{name}: row {i}: expected {width} numbers, found {len(row)}")
    table = np.array([row[:width] for row in body])
    poses, contacts = (table[:, :7], table[:, 7:]) if counted else (table[:, -7:], table[:, :-7])
    if not np.isfinite(poses).all():
        row = int(np.argwhere(~np.isfinite(poses))[0, 0])
        raise InputError(f"{name}: row {row + 1 + counted}: the pose must be finite")
    if np.isinf(contacts).any():
        row = int(np.argwhere(np.isinf(contacts))[0, 0])
        raise InputError(f"{name}: row {row + 1 + counted}: contacts must not be infinite")
    turns = _poses.unit(f"{name}: pose", poses[:, [6, 3, 4, 5]])
    return contacts.reshape(len(body), fingers, 6), np.hstack([poses[:, :3], turns]), counted


def _changes(points: np.ndarray, holds: np.ndarray) -> list[int]:
    """Return the rows whose contacts differ from the last such row beyond rounding."""
    size = np.nanmax(np.abs(points), initial=0) or 1
    rows = [0]
    for row in range(1, len(points)):
        last = rows[-1]
        same = (holds[row] == holds[last]).all() and np.allclose(
            points[row], points[last], rtol=0, atol=1e-6 * size, equal_nan=True)
        if not same:
            rows.append(row)
    return rows
