"""Evaluation of grasps by a whole hand, as by the program `evaluate`."""

from __future__ import annotations

import os
import time
from dataclasses import dataclass, field

import numpy as np

from . import _arguments, _html, _regrasp
from ._hand_grasps import HandConfigurations, HandGrasps
from ._regrasp import InputError
from ._types import ArrayLike, Path, Progress, Sequence
from .hands import Hand
from .objects import Object

_PROTOCOLS = tuple(_regrasp.grasp_protocols())
_FAULTS = np.array(_regrasp.grasp_faults())

_PART = 100
"""Grasps between two checks for Ctrl-C if none is simulated."""

_INTERVAL_S = 0.1
"""Smallest time between two calls of the progress function."""


@dataclass(frozen=True)
class GraspVerdicts:
    """The result of `validate_grasps` for N grasps. Lengths are in millimetres.

    A value that was not measured is NaN: its protocol was not requested, or failed before.
    """

    passed: np.ndarray
    """Whether each grasp passes all protocols (N,), bool."""
    reasons: list[str]
    """Reason of the first protocol that fails, per grasp; empty if it passes (docs/grasp_failure_reasons.md)."""
    protocols: tuple[str, ...]
    """Names of the P protocols."""
    protocol_reasons: np.ndarray
    """Reasons per protocol (N, P), str; empty if the protocol passes."""
    distance_mm: np.ndarray
    """Smallest signed distance (N,) of the hand from the surface; negative: penetration."""
    links: list[str]
    """Names of the L links with collision geometry."""
    contacts: np.ndarray
    """Number of contacts (N, L) per link within 1 mm of the surface."""
    quality: np.ndarray
    """Grasp quality ε (N,) of the contacts (`analytic`)."""
    moved_mm: np.ndarray
    """Largest translation (N,) of the object (`dexgraspbench`)."""
    rotated_deg: np.ndarray
    """Largest rotation (N,) of the object, degrees (`dexgraspbench`)."""
    held_s: np.ndarray
    """Time (N, 6) that the hand holds the object against gravity along −x, x, −y, y, −z, z (`fall`)."""
    resisted_N: np.ndarray
    """Largest resisted force (N, 6) along these directions, newtons (`disturbance`)."""
    _names: list[str] = field(default_factory=list, repr=False, compare=False)

    def __len__(self) -> int:
        return len(self.passed)

    def _repr_html_(self) -> str:
        rows = [[self._names[i], "pass" if self.passed[i] else f"fail: {self.reasons[i]}",
                 f"{max(0, -self.distance_mm[i]):.2f}", str(int(self.contacts[i].sum()))]
                for i in sorted(range(len(self)), key=lambda i: bool(self.passed[i]))[:10]]
        count = f"{int(self.passed.sum())} of {len(self)} grasps pass {', '.join(self.protocols)}"
        return _html.text(count) + _html.table(["grasp", "verdict", "penetration (mm)", "contacts"], rows)


def validate_grasps(object: Object, hand: Hand | Path, grasps: HandGrasps, *,
                    protocols: Sequence[str] = ("analytic",), mu: float = 0.6, mass_kg: float = 0.1,
                    pieces: Sequence[ArrayLike] = (), progress: Progress = None) -> GraspVerdicts:
    """Test grasps of an object by a whole hand, with its palm and all links.

    The tests are those of the program `evaluate` (docs/evaluate_grasps.md), which runs in several
    processes and continues stopped runs. A grasp passes if it passes all protocols.

    Args:
        object: solid that is grasped. `grasps.scales`, if it is given, replaces `Object.scale`.
        hand: hand, or path of a hand file. Fingertips are not required in the file.
        grasps: N grasps: palm poses and joint values (N, J) with the names of the joints. The
            configurations `pregrasp` and `target` are used if they are given.
        protocols: names of tests: "analytic", "dexgraspbench", "fall", "disturbance".
        mu: friction coefficient between hand and object.
        mass_kg: mass of the object.
        pieces: convex pieces of the object: arrays (V, 3) of points in its unit, for the simulation.
        progress: function that is called with one line of text, at most ten times per second.
            Ctrl-C stops the work after the current grasp.

    Returns:
        Verdicts, reasons and measured values as arrays.

    Raises:
        InputError: an argument is invalid, or a grasp violates a convention, such as joints that the
            hand does not have; the message names the grasp.

    >>> import regrasp.formats
    >>> cube = Object.read("models/cube.obj")
    >>> hand = Hand.read("models/hands/ring4.json")
    >>> grasps = regrasp.formats.HandGrasps([[0, 0, 0.2]], [[1, 0, 0, 0]], hand.joint_names,
    ...                                     np.zeros((1, len(hand.joint_names))), ["above"], [1])
    >>> verdicts = validate_grasps(cube, hand, grasps)
    >>> verdicts.passed, verdicts.reasons
    (array([False]), ['no-contact'])
    """
    _arguments.of_type("object", object, Object)
    _arguments.of_type("grasps", grasps, HandGrasps)
    if isinstance(protocols, str):
        protocols = (protocols,)
    protocols = tuple(_arguments.choice("protocols", name, _PROTOCOLS)
                      for name in _arguments.texts("protocols", protocols))
    if not protocols or len(set(protocols)) != len(protocols):
        raise InputError(f"protocols must be different names, found {_arguments.shown(list(protocols))}")
    if not grasps.joint_names and grasps.joints.shape[1] > 0:
        raise InputError("grasps must have joint_names")
    test = _Test(object, hand._path if isinstance(hand, Hand) else _arguments.path("hand", hand),
                 [_arguments.numbers(f"pieces[{i}]", piece, "(V, 3)", (2,)) for i, piece in enumerate(pieces)],
                 [_PROTOCOLS.index(name) for name in protocols],
                 _arguments.number("mu", mu, 0), _arguments.number("mass_kg", mass_kg, 0))
    for i, piece in enumerate(test.pieces):
        if piece.shape[1] != 3:
            raise InputError(f"pieces[{i}] must have shape (V, 3), found {piece.shape}")
    columns = test.run(grasps, _arguments.callback("progress", progress))
    return _verdicts(protocols, test.links, grasps.names, columns)


@dataclass
class _Test:
    """Arguments of a test."""

    object: Object
    hand: str
    pieces: list[np.ndarray]
    protocols: list[int]
    mu: float
    mass_kg: float
    links: list[str] = field(default_factory=list)

    def run(self, grasps: HandGrasps, progress) -> list[np.ndarray]:
        """Return the arrays of all grasps, in their order."""
        scales = np.full(len(grasps), self.object.scale) if grasps.scales is None else grasps.scales
        part = _PART if self.protocols == [0] else 1
        found: list[tuple[np.ndarray, tuple]] = []
        done, reported = 0, time.monotonic()
        for scale in np.unique(scales) if len(grasps) else [self.object.scale]:
            world = _regrasp.GraspWorld(self.hand, self.object._core, float(scale), self.pieces)
            self.links = world.links
            chosen = np.flatnonzero(scales == scale)
            for begin in range(0, max(1, len(chosen)), part):
                index = chosen[begin:begin + part]
                found.append((index, self._part(world, grasps, index)))
                done += len(index)
                if progress is not None and time.monotonic() - reported > _INTERVAL_S:
                    reported = time.monotonic()
                    progress(f"tested {done} of {len(grasps)} grasps")
        order = np.argsort(np.concatenate([index for index, _ in found]))
        return [np.concatenate(column)[order] for column in zip(*(values for _, values in found))]

    def _part(self, world, grasps: HandGrasps, index: np.ndarray) -> tuple:
        def of(all) -> tuple | None:
            if all is None:
                return None
            return tuple(np.ascontiguousarray(array[index], dtype=float)
                         for array in (all.positions, all.quaternions, all.joints))
        own = HandConfigurations(grasps.positions, grasps.quaternions, grasps.joints)
        return world.test(grasps.joint_names, of(own), of(grasps.pregrasp), of(grasps.target), self.protocols,
                          self.mu, self.mass_kg, index.tolist())


def _verdicts(protocols: tuple[str, ...], links: list[str], names: list[str],
              columns: list[np.ndarray]) -> GraspVerdicts:
    distance, contacts, faults, quality, moved, rotated, held, resisted = columns
    faults = faults[:, [_PROTOCOLS.index(name) for name in protocols]]
    reasons = np.where(faults > 0, _FAULTS[faults], "")
    first = np.argmax(faults > 0, axis=1)
    return GraspVerdicts(
        passed=(faults == 0).all(axis=1), reasons=[str(row[i]) for row, i in zip(reasons, first)], protocols=protocols,
        protocol_reasons=reasons, distance_mm=1000 * distance, links=links, contacts=contacts, quality=quality,
        moved_mm=1000 * moved, rotated_deg=rotated, held_s=held, resisted_N=resisted, _names=list(names))
