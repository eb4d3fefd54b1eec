"""Sequences of grasps by fingers without a hand: the contacts of each finger."""

from __future__ import annotations

import json
import math
import os
from dataclasses import dataclass, field

import numpy as np

from . import _arguments, _deprecated, _html, _npz
from ._regrasp import InputError
from .objects import Object
from .plans import Plan

_ROWS = 10
"""Number of rows in a notebook."""


@dataclass
class FingerGrasps:
    """N grasps by F fingers, some of which may be without contact."""

    points: np.ndarray
    """Contact points (N, F, 3) in the object's frame and unit; NaN for a finger without contact."""
    normals: np.ndarray
    """Inward normals (N, F, 3) as in the file; NaN for a finger without contact."""
    names: list[str]
    """Names of the N grasps."""
    lost: list[str] = field(default_factory=list)
    """Descriptions of the file's content that is not converted."""

    def __post_init__(self):
        """Check the arrays.

        Raises:
            InputError: If the shapes of the arrays do not match.
        """
        self.names = _arguments.texts("names", self.names)
        for name in ("points", "normals"):
            array = _arguments.numbers_or_nan(name, getattr(self, name), "(N, F, 3)", (3,))
            if array.shape[0] != len(self.names) or array.shape[2] != 3 or array.shape[1] < 1:
                raise InputError(f"{name} must have shape ({len(self.names)}, F, 3) for "
                                 f"{len(self.names)} names, found {array.shape}")
            setattr(self, name, array)
        if self.normals.shape != self.points.shape:
            raise InputError(f"normals must have the shape of points, {self.points.shape}, "
                             f"found {self.normals.shape}")

    def __len__(self) -> int:
        return len(self.names)

    def _repr_html_(self) -> str:
        held = [", ".join(map(str, np.flatnonzero(row))) for row in self.active[:_ROWS]]
        more = f"{len(self)} grasps" + (f", the first {_ROWS}" if len(self) > _ROWS else "")
        lost = f"; not converted: {', '.join(self.lost)}" if self.lost else ""
        return _html.text(more + lost) + _html.table(["grasp", "fingers"],
                                                     [list(row) for row in zip(self.names, held)])

    @property
    def active(self) -> np.ndarray:
        """Contact mask (N, F): True for a finger in contact."""
        return ~np.isnan(self.points).any(axis=-1)

    @property
    def holds(self) -> np.ndarray:
        """Deprecated name of `active`."""
        _deprecated.renamed("FingerGrasps.holds", "active")
        return self.active

    def on(self, object: Object, *, tolerance: float = 0.002) -> FingerGrasps:
        """Return the grasps projected onto the object's surface: nearest points with the surface's
        normals.

        Args:
            object: Solid that the fingers hold.
            tolerance: Maximum distance of a point from the surface, m.

        Raises:
            InputError: If a point is farther away, or a normal more than 90 degrees off that of the
                surface.
        """
        if _arguments.of_type("object", object, Object).dimension != 3:
            raise InputError(f"object must be a solid, found the polygon {object.name}")
        tolerance = _arguments.number("tolerance", tolerance, 0)
        active = self.active
        points, normals = self.points.copy(), self.normals.copy()
        points[active], normals[active] = object.nearest(self.points[active])
        off = np.linalg.norm(points - self.points, axis=-1) * object.scale
        self._check("points", off > tolerance, lambda at:
                    f"{1000 * off[at]:.3g} mm from the surface of {object.name}, expected at most {1000 * tolerance:g} mm")
        self._check("normals", np.einsum("nfi,nfi->nf", normals, self.normals) < 0, lambda at:
                    f"points out of {object.name}, expected a normal into the object")
        return FingerGrasps(points, normals, self.names, self.lost)

    def _check(self, name: str, wrong: np.ndarray, what) -> None:
        places = np.argwhere(wrong)
        if len(places):
            grasp, finger = (int(i) for i in places[0])
            raise InputError(f"{name}[{grasp}, {finger}]: grasp {self.names[grasp]}, finger {finger}: "
                             f"{what((grasp, finger))}; {len(places)} in total")

    def write_npz(self, path: str | os.PathLike) -> None:
        """Write the input file of `validate --grasps`."""
        active = self.active
        _npz.write_grasps(_arguments.path("path", path), active=active,
                          points=np.where(active[..., None], self.points, 0),
                          normals=np.where(active[..., None], self.normals, 0))

    def as_plan(self, object: Object, mu: float | None = None, *,
                friction_angle_deg: float | None = None) -> Plan:
        """Return a plan of finger switches from each grasp to the next.

        First, new fingers are placed. Then each finger with a changed contact is released and
        placed again, one finger after the other. Finally, all other fingers without contact in the
        next grasp are released.

        Args:
            object: Object that the fingers hold; the contacts must be on its surface (`on`).
            mu: Friction coefficient. Either this or the friction angle is required.
            friction_angle_deg: Friction angle, degrees.

        Returns:
            Plan that is not validated; use `validate` to test it.
        """
        if _arguments.of_type("object", object, Object).dimension != 3:
            raise InputError(f"object must be a solid, found the polygon {object.name}")
        half_angle = _arguments.needed_half_angle(mu, friction_angle_deg)
        if not len(self):
            raise InputError("names must have at least one grasp, found none")
        goal = [{"point": c["point"], "normal": c["normal"]} for c in self._contacts(-1)]
        steps = [step for i in range(1, len(self)) for step in self._steps(i)]
        result = Plan(json.dumps({
            "format": "regrasp-plan", "version": 1,
            "object": {"file": object.name, "sha256": object.sha256, "scale": object.scale,
                       "dimension": 3},
            "friction": {"half_angle_deg": math.degrees(half_angle)},
            "fingers": self.points.shape[1], "planner": "converted",
            "initial": {"contacts": self._contacts(0)}, "steps": steps, "goal": {"contacts": goal}}))
        result.object = object
        return result

    def _contacts(self, grasp: int, fingers=None) -> list[dict]:
        fingers = np.flatnonzero(self.active[grasp]) if fingers is None else fingers
        return [{"finger": int(f), "point": self.points[grasp, f].tolist(),
                 "normal": self.normals[grasp, f].tolist()} for f in fingers]

    def _steps(self, grasp: int) -> list[dict]:
        """Return the steps from the previous grasp to this one."""
        before, after = self.active[grasp - 1], self.active[grasp]
        elsewhere = before & after & (self.points[grasp] != self.points[grasp - 1]).any(axis=-1)
        steps = [(np.flatnonzero(after & ~before), [])]
        for finger in np.flatnonzero(elsewhere):
            steps += [([], [finger]), ([finger], [])]
        steps.append(([], np.flatnonzero(before & ~after)))
        if len(steps) == 2:  # place and release in one step
            steps = [(steps[0][0], steps[1][1])]
        return [{"kind": "switch", "place": self._contacts(grasp, place),
                 "release": [int(f) for f in release]}
                for place, release in steps if len(place) or len(release)]
