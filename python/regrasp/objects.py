"""Objects: closed solids with planar faces, and polygons."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _arguments, _regrasp
from ._regrasp import InputError
from ._types import ArrayLike, Progress, Sequence

_SHELLS = {None: None, "union": _regrasp.Shells.union, "largest": _regrasp.Shells.largest}


class Object:
    """An object to grasp: a closed surface mesh or a polygon. It is valid and immutable.

    Made by `Object.read`, `Object.from_arrays`, `Object.from_trimesh` and `Object.from_polygon`. It can be
    pickled; the pickle of an object from a file has the path, and the file is read again.
    """

    def __init__(self, core: _regrasp.Object):
        if not isinstance(core, _regrasp.Object):
            raise TypeError("use Object.read, Object.from_arrays or Object.from_polygon")
        self._core = core
        self._made: tuple = ()  # method, arguments and keywords, from which a pickle makes the object again

    @classmethod
    def read(cls, path: str | os.PathLike, *, scale: float = 1, repair: bool = False,
             shells: str | None = None, progress: Progress = None) -> Object:
        """Read a mesh (OBJ, OFF, PLY, STL, GLB, 3MF, …) or a polygon (WKT).

        Args:
            path: path of the file.
            scale: metres per unit of the file.
            repair: whether to make a closed solid of a defective surface, like the program `repair`.
            shells: meaning of several closed shells, "union" or "largest"; default: raise InputError.
            progress: function that is called with one line of text per stage.

        Raises:
            InputError: the file cannot be read or is not a closed solid; the message names the element.

        >>> Object.read("models/cube.obj").face_count
        6
        """
        shells = None if shells is None else _arguments.choice("shells", shells, ["union", "largest"])
        scale = _arguments.number("scale", scale, 0)
        path = _arguments.path("path", path)
        made = cls(_regrasp.read_object(path, scale, _arguments.flag("repair", repair), _SHELLS[shells],
                                        _arguments.callback("progress", progress)))
        return made._made_by("read", os.path.abspath(path), scale=scale, repair=repair, shells=shells)

    @classmethod
    def from_arrays(cls, vertices: ArrayLike, faces: ArrayLike, *, scale: float = 1,
                    name: str = "object.obj") -> Object:
        """Make a solid from a closed triangle mesh.

        Args:
            vertices: array (V, 3), coordinates in the object's unit.
            faces: array (F, 3) of integers, vertices of the triangles, counter-clockwise from outside.
            scale: metres per unit of the vertices.
            name: name of the object in plans and messages, and file name for `write`.

        Raises:
            InputError: the shape of an array is wrong, or the surface is not closed; the message names the
                triangle.

        >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
        >>> Object.from_arrays(corners, [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]).diameter
        1.4142135623730951
        """
        vertices = _arguments.numbers("vertices", vertices, "(V, 3)", (2,))
        if vertices.shape[1] != 3:
            raise InputError(f"vertices must have shape (V, 3), found {vertices.shape}")
        faces = _arguments.indices("faces", faces, "(F, 3)", (2,))
        if faces.shape[1] != 3:
            raise InputError(f"faces must have shape (F, 3), found {faces.shape}")
        if len(vertices) == 0:
            raise InputError("vertices must have at least one vertex, found shape (0, 3)")
        wrong = np.argwhere((faces < 0) | (faces >= len(vertices)))
        if len(wrong):
            place = tuple(int(i) for i in wrong[0])
            raise InputError(f"faces{list(place)} must be a vertex from 0 to {len(vertices) - 1}, "
                             f"found {faces[place]}")
        made = cls(_regrasp.object_from_arrays(
            vertices, faces, _arguments.number("scale", scale, 0), _arguments.text("name", name)))
        return made._made_by("from_arrays", vertices, faces, scale=scale, name=name)

    @classmethod
    def from_trimesh(cls, mesh: Any, *, scale: float = 1, name: str = "object.obj") -> Object:
        """Make a solid from a mesh of the library trimesh, or of another one with the same members.

        Args:
            mesh: mesh with the arrays `vertices` (V, 3) and `faces` (F, 3).
            scale, name: as in `from_arrays`.

        Raises:
            InputError: as `from_arrays`, or `mesh` lacks an array.
        """
        for member in ("vertices", "faces"):
            if not hasattr(mesh, member):
                raise InputError(f"mesh must have vertices and faces, found {_arguments.shown(mesh)}")
        return cls.from_arrays(mesh.vertices, mesh.faces, scale=scale, name=name)

    @classmethod
    def from_polygon(cls, outline: ArrayLike, holes: Sequence[ArrayLike] = (), *, scale: float = 1,
                     name: str = "object.wkt") -> Object:
        """Make a planar object from its outline.

        Args:
            outline: array (V, 2), corners in order; the first is not repeated.
            holes: outlines of holes, arrays of the same form.
            scale: metres per unit.
            name: name of the object in plans and messages, and file name for `write`.

        Raises:
            InputError: an outline intersects itself or another one, or the shape of an array is wrong.

        >>> Object.from_polygon([[0, 0], [2, 0], [2, 1], [0, 1]]).measure
        2.0
        """
        try:
            holes = list(holes)
        except TypeError:
            raise InputError("holes must be a list of arrays, found "
                             f"{_arguments.shown(holes)}") from None
        rings = []
        for label, ring in [("outline", outline)] + [
                (f"holes[{i}]", hole) for i, hole in enumerate(holes)]:
            corners = _arguments.numbers(label, ring, "(V, 2)", (2,))
            if corners.shape[1] != 2 or len(corners) < 3:
                raise InputError(f"{label} must have shape (V, 2) with at least 3 corners, "
                                 f"found {corners.shape}")
            closed = [*corners.tolist(), corners[0].tolist()]
            rings.append("(" + ", ".join(f"{x!r} {y!r}" for x, y in closed) + ")")
        made = cls(_regrasp.object_from_wkt("POLYGON(" + ",\n".join(rings) + ")\n",
                                            _arguments.number("scale", scale, 0),
                                            _arguments.text("name", name)))
        return made._made_by("from_polygon", outline, holes, scale=scale, name=name)

    def _made_by(self, method: str, *arguments, **keywords) -> Object:
        self._made = method, arguments, keywords
        return self

    def __reduce__(self):
        return _made_again, (self._made, self.sha256)

    def nearest(self, points: ArrayLike) -> tuple[np.ndarray, np.ndarray]:
        """Project points onto the surface, on all processors.

        Args:
            points: array (N, 3), or (N, 2) for a polygon, in the object's unit.

        Returns:
            The nearest points of the surface, of the same shape, and the unit normals there, which point
            into the object.

        >>> place, normal = Object.read("models/cube.obj").nearest([[0.05, 0.01, 0.02]])
        >>> place.tolist(), normal.tolist()
        ([[0.03, 0.01, 0.02]], [[-1.0, 0.0, 0.0]])
        """
        shape = f"(N, {self.dimension})"
        points = _arguments.numbers("points", points, shape, (2,))
        if points.shape[1] != self.dimension:
            raise InputError(f"points must have shape {shape}, found {points.shape}")
        padded = np.zeros((len(points), 3))
        padded[:, :self.dimension] = points
        # In parts, between which the interpreter sees to signals.
        part = 20_000
        found = [_regrasp.nearest(self._core, padded[begin:begin + part])
                 for begin in range(0, max(len(points), 1), part)]
        places, normals = (np.concatenate(columns)[:, :self.dimension] for columns in zip(*found))
        return places, normals

    def write(self, path: str | os.PathLike) -> None:
        """Write the file from which the programs read this object.

        Raises:
            InputError: the object was read from a file.
        """
        if not self._core.text:
            raise InputError(f"{self.name} was read from a file, expected an object from arrays")
        _regrasp.write_file(_arguments.path("path", path), self._core.text.encode())

    @property
    def name(self) -> str:
        """Name of the file, without folders."""
        return self._core.name

    @property
    def sha256(self) -> str:
        """SHA-256 of the file's bytes; a plan identifies its object by it."""
        return self._core.sha256

    @property
    def scale(self) -> float:
        """Metres per unit of length."""
        return self._core.scale

    @property
    def dimension(self) -> int:
        """3 for a solid, 2 for a polygon."""
        return self._core.dimension

    @property
    def face_count(self) -> int:
        """Number of planar faces, each of all coplanar adjacent triangles; edges of a polygon."""
        return self._core.face_count

    @property
    def diameter(self) -> float:
        """Largest distance between two vertices, in the object's unit."""
        return self._core.diameter

    @property
    def measure(self) -> float:
        """Volume of a solid or area of a polygon, in the object's unit cubed or squared."""
        return self._core.measure

    @property
    def centroid(self) -> np.ndarray:
        """Centroid of the volume (3,) or of the area (2,)."""
        return np.array(self._core.centroid[:self.dimension])

    @property
    def vertices(self) -> np.ndarray:
        """Vertices (V, 3) of a solid, or corners (V, 2) of the outline of a polygon."""
        return self._core.vertices

    @property
    def triangles(self) -> np.ndarray:
        """Vertices (F, 3) of triangles, counter-clockwise from outside; (0, 3) for a polygon."""
        return self._core.triangles

    def __repr__(self) -> str:
        what = "faces" if self.dimension == 3 else "edges"
        return f"<Object {self.name}: {self.face_count} {what}, {self._core.size_text}>"


def _made_again(made: tuple, sha256: str) -> Object:
    """Make the object of a pickle."""
    method, arguments, keywords = made
    object = getattr(Object, method)(*arguments, **keywords)
    if object.sha256 != sha256:
        raise InputError(f"{object.name}: differs from the pickled object, expected SHA-256 {sha256[:12]}…, "
                         f"found {object.sha256[:12]}…")
    return object
