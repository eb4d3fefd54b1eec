"""Cut a planar face with holes into simple polygons, without new corners, in exact arithmetic."""

import itertools
import math


def area_vector(ring):
    """Return twice the area, along the normal."""
    total = (0, 0, 0)
    for p, q in zip(ring, ring[1:] + ring[:1]):
        total = tuple(t + p[(i + 1) % 3] * q[(i + 2) % 3] - p[(i + 2) % 3] * q[(i + 1) % 3]
                      for i, t in enumerate(total))
    return total


def turn(p, q, r):
    """Return a positive value if p, q, r turn left in the plane, and 0 if they are collinear."""
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])


def in_box(p, q, r):
    return all(min(a, b) <= c <= max(a, b) for a, b, c in zip(p, q, r))


def meet(first, second):
    """Return True if two segments share a point other than a common end."""
    (p, q), (r, s) = first, second
    if {p, q} == {r, s}:
        return True
    ends = [(p, q, r), (p, q, s), (r, s, p), (r, s, q)]
    if any(c not in (a, b) and turn(a, b, c) == 0 and in_box(a, b, c) for a, b, c in ends):
        return True
    return turn(p, q, r) * turn(p, q, s) < 0 and turn(r, s, p) * turn(r, s, q) < 0


def trace(edges):
    """Return the cycles to the left of the directed edges of a planar graph."""
    leaving = {}
    for p, q in edges:
        leaving.setdefault(p, []).append(q)
    angle = lambda p, q: math.atan2(q[1] - p[1], q[0] - p[0])
    cycles, left = [], list(edges)
    while left:
        cycle, edge = [], left[0]
        while edge in left:
            left.remove(edge)
            cycle.append(edge[0])
            p, q = edge
            # The next edge clockwise from the incoming one turns left most.
            edge = (q, min((r for r in leaving[q]),
                           key=lambda r: (angle(q, p) - angle(q, r)) % (2 * math.pi)
                           or 2 * math.pi))
        cycles.append(cycle)
    return cycles


def repeats(cycles):
    return sum(len(cycle) - len(set(cycle)) for cycle in cycles)


def cut_in_plane(rings):
    """Cut rings with the face to their left into simple polygons.

    The first cuts are the shortest chords that connect all rings. The next cuts are the shortest
    chords after which no polygon touches itself.
    """
    edges = [edge for ring in rings for edge in zip(ring, ring[1:] + ring[:1])]
    chords = [(p, q) for a, b in itertools.combinations(rings, 2) for p in a for q in b]
    chords = [chord for chord in chords if not any(meet(chord, edge) for edge in edges)]
    chords.sort(key=lambda chord: sum((a - b) ** 2 for a, b in zip(*chord)))
    group = {p: i for i, ring in enumerate(rings) for p in ring}
    for p, q in chords:
        if group[p] != group[q] and not any(meet((p, q), edge) for edge in edges):
            edges += [(p, q), (q, p)]
            group = {r: group[p] if g == group[q] else g for r, g in group.items()}
    for p, q in chords:
        if repeats(trace(edges)) == 0:
            break
        more = edges + [(p, q), (q, p)]
        if (not any(meet((p, q), edge) for edge in edges)
                and repeats(trace(more)) < repeats(trace(edges))):
            edges = more
    return trace(edges)


def simple_polygons(rings):
    """Return the polygons with the orientation of the rings.

    The outer ring is counter-clockwise seen from outside, holes are clockwise.
    """
    if len(rings) == 1:
        return list(rings)
    normal = [sum(x) for x in zip(*map(area_vector, rings))]
    axis = max(range(3), key=lambda i: abs(normal[i]))
    # Omit the dominant axis of the normal, and keep the order counter-clockwise.
    kept = [(axis + 1) % 3, (axis + 2) % 3][::1 if normal[axis] > 0 else -1]
    flat = {p: tuple(p[i] for i in kept) for ring in rings for p in ring}
    back = {f: p for p, f in flat.items()}
    polygons = [[back[f] for f in polygon]
                for polygon in cut_in_plane([[flat[p] for p in ring] for ring in rings])]
    if any(len(polygon) != len(set(polygon)) for polygon in polygons):
        raise ValueError("a face with holes could not be cut")
    return polygons
