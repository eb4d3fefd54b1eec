"""Checks of arguments: each message names the argument, the place in it and the value."""

from __future__ import annotations

import difflib
import math
import operator

import numpy as np

from ._regrasp import InputError


def numbers(name: str, value, shapes: str, dimensions: tuple[int, ...]) -> np.ndarray:
    """Finite float64 values with so many axes; `shapes` says which, for the message."""
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name}: no array of shape {shapes}: {error}") from None
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name}: numbers are needed, found an array of {array.dtype}")
    if array.ndim not in dimensions:
        raise InputError(f"{name}: the shape is {shapes}, found {array.shape}")
    array = np.ascontiguousarray(array, dtype=np.float64)
    if not np.isfinite(array).all():
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InputError(f"{name}{list(place)}: {array[place]} is not finite")
    return array


def number(name: str, value, lower: float, upper: float = math.inf) -> float:
    """A finite number above `lower` and below `upper`."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{name}: a number is needed, found {value!r}") from None
    if not (lower < result < upper):
        limits = f"above {lower:g}" if upper == math.inf else f"between {lower:g} and {upper:g}"
        raise InputError(f"{name}: {limits}, found {result!r}")
    return result


def integer(name: str, value, lower: int, upper: int) -> int:
    """An integer from `lower` to `upper`."""
    try:
        result = operator.index(value)
    except TypeError:
        raise InputError(f"{name}: an integer is needed, found {value!r}") from None
    if not lower <= result <= upper:
        raise InputError(f"{name}: from {lower} to {upper}, found {result}")
    return result


def choice(name: str, value: str, words) -> str:
    """One of some words."""
    words = list(words)
    if value in words:
        return value
    near = difflib.get_close_matches(str(value), words, 1)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    raise InputError(f"{name}: {value!r} is none of {', '.join(map(repr, words))}{hint}")


def half_angle(mu: float | None, friction_angle_deg: float | None) -> float | None:
    """The friction cone's half-angle in radians; None where neither is given."""
    if mu is not None and friction_angle_deg is not None:
        raise InputError("mu and friction_angle_deg: give one of them")
    if mu is not None:
        return math.atan(number("mu", mu, 0))
    if friction_angle_deg is not None:
        # As the programs' Radians().
        return number("friction_angle_deg", friction_angle_deg, 0, 90) * (math.pi / 180)
    return None


def needed_half_angle(mu: float | None, friction_angle_deg: float | None) -> float:
    """The same, where one must be given."""
    angle = half_angle(mu, friction_angle_deg)
    if angle is None:
        raise InputError("mu: friction is needed; give mu or friction_angle_deg")
    return angle
