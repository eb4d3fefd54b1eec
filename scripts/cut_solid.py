"""Cut convex bodies out of a convex body, in exact arithmetic.

A body or a cutter is a list of half-spaces ((a, b, c), d): the points with a x + b y + c z <= d,
with rational numbers. They may be unbounded: a slot is a cutter of three half-spaces. Bodies must
be in general position: no two planes are equal, and no edge is in a face of another body.
"""

import collections
from fractions import Fraction
import itertools

import facet_cutting

FAR = Fraction(1000)  # outside every body


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def cross(u, v):
    return (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])


def minus(u, v):
    return tuple(a - b for a, b in zip(u, v))


def is_straight(p, q, r):
    return not any(cross(minus(q, p), minus(r, q)))


def split(polygon, half_space):
    """Return the parts of a convex polygon inside and outside a half-space; empty if there are
    none."""
    normal, distance = half_space
    heights = [dot(normal, p) - distance for p in polygon]
    if not any(heights):
        raise ValueError("a face lies in the plane of another")
    inside, outside = [], []
    for (p, h), (q, k) in zip(zip(polygon, heights),
                              zip(polygon[1:] + polygon[:1], heights[1:] + heights[:1])):
        if h <= 0:
            inside.append(p)
        if h >= 0:
            outside.append(p)
        if h * k < 0:
            meeting = tuple(a + (b - a) * h / (h - k) for a, b in zip(p, q))
            inside.append(meeting)
            outside.append(meeting)
    return (inside if min(heights) < 0 else []), (outside if max(heights) > 0 else [])


def clip(polygon, half_spaces):
    for half_space in half_spaces:
        if polygon:
            polygon = split(polygon, half_space)[0]
    return polygon


def cut_away(polygons, cutter):
    """Return the convex parts of the polygons outside the cutter."""
    left = []
    for polygon in polygons:
        if not clip(polygon, cutter):
            left.append(polygon)
            continue
        for half_space in cutter:
            polygon, outside = split(polygon, half_space)
            if outside:
                left.append(outside)
    return left


def plane_polygon(half_space):
    """Return a large square in a half-space's plane, counter-clockwise seen from outside."""
    normal, distance = half_space
    axis = min(range(3), key=lambda i: abs(normal[i]))
    u = cross(normal, tuple(Fraction(i == axis) for i in range(3)))
    v = cross(normal, u)
    foot = tuple(n * distance / dot(normal, normal) for n in normal)
    u, v = (tuple(x * FAR / max(map(abs, w)) for x in w) for w in (u, v))
    return [tuple(f + s * a + t * b for f, a, b in zip(foot, u, v))
            for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]


def pieces_by_plane(body, cutters):
    """Return the convex pieces of the boundary, grouped by plane, counter-clockwise seen from
    outside."""
    planes = []
    for i, half_space in enumerate(body):
        pieces = [clip(plane_polygon(half_space), body[:i] + body[i + 1:])]
        if not pieces[0]:
            raise ValueError(f"half-space {i} of the body cuts nothing")
        for cutter in cutters:
            pieces = cut_away(pieces, cutter)
        planes.append(pieces)
    for c, cutter in enumerate(cutters):
        for i, half_space in enumerate(cutter):
            piece = clip(plane_polygon(half_space), cutter[:i] + cutter[i + 1:] + body)
            pieces = [piece[::-1]] if piece else []
            for other in cutters[:c] + cutters[c + 1:]:
                pieces = cut_away(pieces, other)
            planes.append(pieces)
    return planes


def with_points_between(polygon, points):
    """Return the polygon with the points on its sides as additional corners."""
    corners = []
    for p, q in zip(polygon, polygon[1:] + polygon[:1]):
        along = minus(q, p)
        between = [r for r in points if 0 < dot(minus(r, p), along) < dot(along, along)
                   and not any(cross(minus(r, p), along))]
        corners += [p] + sorted(between, key=lambda r: dot(r, along))
    return corners


def outlines_of_faces(pieces):
    """Return the connected unions of the pieces of one plane, each as its rings."""
    points = sorted({p for piece in pieces for p in piece})
    pieces = [with_points_between(piece, points) for piece in pieces]
    owner = {(p, q): i for i, piece in enumerate(pieces)
             for p, q in zip(piece, piece[1:] + piece[:1])}
    face = list(range(len(pieces)))
    for (p, q), i in owner.items():
        if (q, p) in owner:
            joined, kept = face[i], face[owner[q, p]]
            face = [kept if f == joined else f for f in face]
    faces = collections.defaultdict(list)
    for (p, q), i in owner.items():
        if (q, p) not in owner:
            faces[face[i]].append((p, q))
    return [rings_of(edges) for edges in faces.values()]


def rings_of(edges):
    following = dict(edges)
    if len(following) < len(edges):
        raise ValueError("a face touches itself at a corner")
    rings = []
    while following:
        ring = [next(iter(following))]
        while ring[-1] in following:
            ring.append(following.pop(ring[-1]))
        rings.append(ring[:-1])
    return rings


def without_straight_corners(faces):
    """Remove vertices that are not corners of any face."""
    corners = {ring[i] for face in faces for ring in face for i in range(len(ring))
               if not is_straight(ring[i - 1], ring[i], ring[(i + 1) % len(ring)])}
    return [[[p for p in ring if p in corners] for ring in face] for face in faces]


def cut(body, cutters=()):
    """Return the faces of `body` without the cutters, each as its rings (one ring without a hole).

    Args:
        body: Half-spaces of the body.
        cutters: Half-spaces of each cutter.

    Returns:
        Faces with exact points.

    Raises:
        ValueError: If a half-space does not contribute to the boundary, or planes are not in
            general position.
    """
    planes = pieces_by_plane(list(body), [list(cutter) for cutter in cutters])
    return without_straight_corners([face for pieces in planes
                                     for face in outlines_of_faces(pieces)])


def facets_of(faces):
    """Return vertices and simple polygons, into which faces with holes are cut; closed and
    oriented."""
    polygons = [polygon for face in faces for polygon in facet_cutting.simple_polygons(face)]
    vertices = list(dict.fromkeys(itertools.chain.from_iterable(polygons)))
    index = {p: i for i, p in enumerate(vertices)}
    facets = [[index[p] for p in polygon] for polygon in polygons]
    edges = collections.Counter((f[i - 1], f[i]) for f in facets for i in range(len(f)))
    if any(n != 1 or edges[q, p] != 1 for (p, q), n in list(edges.items())):
        raise ValueError("the surface is not closed")
    return vertices, facets
