"""Check function arguments. Each message names the argument, the element and its value."""

from __future__ import annotations

import difflib
import math
import operator
import os

import numpy as np

from ._regrasp import InputError


def shown(value) -> str:
    """Return a value as short text on one line, for a message."""
    try:
        text = " ".join(repr(value).split())
    except Exception:  # repr() of the class fails
        text = type(value).__name__
    return text if len(text) <= 60 else text[:57] + "..."


def numbers(name: str, value, shapes: str, dimensions: tuple[int, ...]) -> np.ndarray:
    """Return finite float64 values of one of the given `dimensions`.

    Args:
        name: Name of the argument in messages.
        value: Array, or nested sequences of numbers.
        shapes: Allowed shapes as text, for messages.
        dimensions: Allowed numbers of axes.
    """
    return finite(name, numbers_or_nan(name, value, shapes, dimensions))


def finite(name: str, array: np.ndarray) -> np.ndarray:
    """Return the array if all its values are finite."""
    if not np.isfinite(array).all():
        place = tuple(int(i) for i in np.argwhere(~np.isfinite(array))[0])
        raise InputError(f"{name}{list(place)} must be finite, found {array[place]}")
    return array


def flags(name: str, value, shape: tuple[int, ...]) -> np.ndarray:
    """Return a bool array of the given shape."""
    array = _array(name, value, str(shape))
    if array.dtype != bool:
        raise InputError(f"{name} must be an array of bool, found an array of {array.dtype}")
    if array.shape != shape:
        raise InputError(f"{name} must have shape {shape}, found {array.shape}")
    return array


def numbers_or_nan(name: str, value, shapes: str, dimensions: tuple[int, ...]) -> np.ndarray:
    """Return float64 values as `numbers` does, but allow values that are not finite."""
    array = _array(name, value, shapes)
    if array.dtype.kind not in "fiu":
        raise InputError(f"{name} must be an array of numbers, found an array of {array.dtype}")
    if array.ndim not in dimensions:
        raise InputError(f"{name} must have shape {shapes}, found {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def indices(name: str, value, shapes: str, dimensions: tuple[int, ...]) -> np.ndarray:
    """Return int64 values; parameters as for `numbers`."""
    array = _array(name, value, shapes)
    if array.ndim not in dimensions:
        raise InputError(f"{name} must have shape {shapes}, found {array.shape}")
    if array.dtype.kind not in "iu":
        raise InputError(f"{name} must be an array of integers, found an array of {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.int64)


_MOST_AXES = 32
"""Maximum number of axes in NumPy."""


def unmasked(name: str, value) -> None:
    """Check that no value is masked, because an ordinary array would contain the values under the
    mask.

    Args:
        name: Name of the argument in messages.
        value: Array, or lists and tuples of arrays and numbers.

    Raises:
        InputError: If a value is masked. The message has the position of the first one and their
            number.
    """
    seen: set[int] = set()

    def check(name: str, part, depth: int) -> None:
        if isinstance(part, np.ma.MaskedArray):
            mask = np.ma.getmaskarray(part)
            if mask.dtype != bool or not mask.any():  # structured arrays are rejected later
                return
            place = [int(i) for i in np.argwhere(mask)[0]] if mask.ndim else ""
            count = int(mask.sum())
            more = f" and {count - 1} more" if count > 1 else ""
            raise InputError(f"{name}{place} must not be masked, found a masked value{more}; "
                             "help: leave masked values out, or fill them")
        if isinstance(part, (list, tuple)) and depth < _MOST_AXES and id(part) not in seen:
            seen.add(id(part))
            for i, inner in enumerate(part):
                if not isinstance(inner, (float, int, str)):
                    check(f"{name}[{i}]", inner, depth + 1)

    check(name, value, 0)


def _array(name: str, value, shapes: str) -> np.ndarray:
    unmasked(name, value)
    try:
        return np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name} must be an array of shape {shapes}: {error}") from None


def number(name: str, value, lower: float, upper: float = math.inf, *, zero: bool = False) -> float:
    """Return a finite number above `lower` and below `upper`; with `zero`, 0 is allowed too."""
    unmasked(name, value)
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        result = float(value)
    except (TypeError, ValueError, OverflowError):
        raise InputError(f"{name} must be a number, found {shown(value)}") from None
    if zero and result == 0:
        return 0
    if not (lower < result < upper):
        limits = f"above {lower:g}" if upper == math.inf else f"between {lower:g} and {upper:g}"
        raise InputError(f"{name} must be {limits}, found {result!r}")
    return result


def integer(name: str, value, lower: int, upper: int) -> int:
    """Return an integer from `lower` to `upper`."""
    unmasked(name, value)
    try:
        result = operator.index(value)
    except TypeError:
        raise InputError(f"{name} must be an integer, found {shown(value)}") from None
    if not lower <= result <= upper:
        raise InputError(f"{name} must be from {lower} to {upper}, found {result}")
    return result


def choice(name: str, value: str, words) -> str:
    """Return one of the given words."""
    words = list(words)
    if isinstance(value, str) and value in words:
        return value
    near = difflib.get_close_matches(value, words, 1) if isinstance(value, str) else []
    hint = f"; did you mean {near[0]!r}?" if near else ""
    raise InputError(f"{name} must be one of {', '.join(map(repr, words))}, found {shown(value)}{hint}")


def flag(name: str, value) -> bool:
    """Return a bool."""
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    raise InputError(f"{name} must be True or False, found {shown(value)}")


def text(name: str, value) -> str:
    """Return a str."""
    if isinstance(value, str):
        return value
    raise InputError(f"{name} must be a str, found {shown(value)}")


def path(name: str, value) -> str:
    """Return a file system path as a str."""
    if not isinstance(value, (str, bytes, os.PathLike)):
        raise InputError(f"{name} must be a path, found {shown(value)}")
    result = os.fsdecode(value)
    if not result or "\0" in result:
        raise InputError(f"{name} must be a path, found {shown(result)}")
    return result


def callback(name: str, value):
    """Return a function or None."""
    if value is None or callable(value):
        return value
    raise InputError(f"{name} must be callable or None, found {shown(value)}")


def of_type(name: str, value, kind: type, hint: str = ""):
    """Return a value of the given class."""
    if isinstance(value, kind):
        return value
    article = "an" if kind.__name__[0] in "AEIOU" else "a"
    raise InputError(f"{name} must be {article} {kind.__name__}, found "
                     f"{type(value).__name__}{hint}")


def vector(name: str, value, length: int) -> np.ndarray:
    """Return `length` finite numbers, shape (length,)."""
    vector = numbers(name, value, f"({length},)", (1,))
    if len(vector) != length:
        raise InputError(f"{name} must have {length} numbers, found {len(vector)}")
    return vector


def mapping(name: str, value) -> dict:
    """Return a dictionary."""
    if not isinstance(value, dict):
        raise InputError(f"{name} must be a mapping, found {type(value).__name__}")
    return value


def member(name: str, mapping: dict, key: str):
    """Return the value of a key of a dictionary."""
    if key not in mapping:
        raise InputError(f"{name}: {key} not found")
    return mapping[key]


_MOST_VALUES = 10**7
_DEEPEST = 64


def bounded(name: str, value):
    """Return a value that contains at most ten million values and at most 64 nested levels.

    A value with several references (YAML aliases, pickle memos) counts once for each of them,
    because the functions that read or print it process each reference.
    """
    known: dict[int, int] = {}

    def count(part, depth: int) -> int:
        if isinstance(part, np.ndarray) and part.dtype.hasobject:
            parts = part.flat
        elif isinstance(part, dict):
            parts = [*part.keys(), *part.values()]
        elif isinstance(part, (list, tuple, set)):
            parts = part
        else:
            return 1
        if depth > _DEEPEST:
            raise InputError(f"{name} must not be nested deeper than {_DEEPEST} levels")
        if id(part) not in known:
            known[id(part)] = 1 + sum(count(inner, depth + 1) for inner in parts)
        return known[id(part)]

    if count(value, 0) > _MOST_VALUES:
        raise InputError(f"{name} must not have more than {_MOST_VALUES} values, counting a shared "
                         "value at each place")
    return value


def texts(name: str, values) -> list[str]:
    """Return a list of str."""
    if not isinstance(values, (list, tuple)) or not all(isinstance(v, str) for v in values):
        raise InputError(f"{name} must be a list of str, found {shown(values)}")
    return list(values)


def half_angle(mu: float | None, friction_angle_deg: float | None) -> float | None:
    """Return the friction angle in radians; None if neither argument is given."""
    if mu is not None and friction_angle_deg is not None:
        raise InputError("mu cannot be used with friction_angle_deg")
    if mu is not None:
        mu = number("mu", mu, 0)
        if mu > 1e15:  # rounds to a right angle
            raise InputError(f"mu must be at most 1e15, found {mu:g}")
        return math.atan(mu)
    if friction_angle_deg is not None:
        # Same rounding as Radians() of the programs.
        return number("friction_angle_deg", friction_angle_deg, 0, 90) * (math.pi / 180)
    return None


def needed_half_angle(mu: float | None, friction_angle_deg: float | None) -> float:
    """Return the friction angle in radians; one of the arguments is required."""
    angle = half_angle(mu, friction_angle_deg)
    if angle is None:
        raise InputError("mu or friction_angle_deg is required")
    return angle
