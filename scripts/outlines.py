"""Outlines of real objects as polygons with a given number of edges, in centimetres.

A ring is a list of pieces, each a finely sampled curve that starts at the end of the previous one.
It is then cut into edges. The ends of the pieces are vertices. Between them the vertices are
unevenly spaced, and denser at higher curvature, as in a traced outline. A straight piece is one
edge.
"""

import itertools
import math
import random

FINE = 240  # points of an arc, and of a spline between two of its points
BEND = 0.12  # centimetres of straight curve with as many vertices as a turn of one radian
UNEVENNESS = 0.3  # over the distance between two vertices along a curve


def polar(middle, radius, degrees):
    angle = math.radians(degrees)
    return middle[0] + radius * math.cos(angle), middle[1] + radius * math.sin(angle)


def mirrored(pieces):
    """Return the mirror image in the y-axis, in reversed order."""
    return [[(-x, y) for x, y in reversed(piece)] for piece in reversed(pieces)]


def moved(pieces, middle, degrees):
    """Rotate pieces about the origin, then move them to `middle`."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return [[(middle[0] + c * x - s * y, middle[1] + s * x + c * y) for x, y in piece]
            for piece in pieces]


def arc(middle, radius, start, end):
    """Return an arc between two angles in degrees; anticlockwise if the second is larger."""
    return [polar(middle, radius, start + (end - start) * k / FINE) for k in range(FINE + 1)]


def spline(points):
    """Return a centripetal Catmull-Rom spline through all points (Barry and Goldman's pyramid)."""
    beyond = lambda end, last: tuple(2 * a - b for a, b in zip(end, last))
    points = [beyond(points[0], points[1]), *points, beyond(points[-1], points[-2])]
    blend = lambda p, q, low, high, t: tuple(((high - t) * a + (t - low) * b) / (high - low)
                                             for a, b in zip(p, q))
    curve = [points[1]]
    for p in zip(points, points[1:], points[2:], points[3:]):
        knots = [0.0, *itertools.accumulate(math.sqrt(math.dist(a, b)) for a, b in zip(p, p[1:]))]
        for k in range(1, FINE + 1):
            t = knots[1] + (knots[2] - knots[1]) * k / FINE
            a = [blend(p[i], p[i + 1], knots[i], knots[i + 1], t) for i in range(3)]
            b = [blend(a[i], a[i + 1], knots[i], knots[i + 2], t) for i in range(2)]
            curve.append(blend(*b, knots[1], knots[2], t))
    return curve


def rounded(corners, closed=True):
    """Return straight lines between corners (x, y, radius), each rounded by an arc; radius 0 is
    sharp.

    An open chain starts and ends at its first and last corner, which stay sharp.
    """
    pieces, ends = [], []
    for before, corner, after in zip(corners[-1:] + corners, corners, corners[1:] + corners[:1]):
        x, y, radius = corner
        inwards = math.atan2(before[1] - y, before[0] - x)
        onwards = math.atan2(after[1] - y, after[0] - x)
        turn = math.remainder(onwards - inwards - math.pi, 2 * math.pi)
        if radius == 0 or (not closed and corner in (corners[0], corners[-1])):
            ends.append(([(x, y)], (x, y), (x, y)))
            continue
        reach = radius * math.tan(abs(turn) / 2)
        start = polar((x, y), reach, math.degrees(inwards))
        side = math.degrees(inwards) - math.copysign(90, turn)
        middle = polar(start, radius, side)
        curve = arc(middle, radius, side + 180, side + 180 + math.degrees(turn))
        ends.append((curve, curve[0], curve[-1]))
    for (curve, _, end), (_, start, _) in zip(ends, ends[1:] + ends[:1]):
        if len(curve) > 1:
            pieces.append(curve)
        pieces.append([end, start])
    return pieces if closed else pieces[:-1]


def spread(piece):
    """Return the position of each point along the piece, in centimetres and bends."""
    far, heading = [0.0], None
    for p, q in zip(piece, piece[1:]):
        towards = math.atan2(q[1] - p[1], q[0] - p[0])
        bend = 0 if heading is None else abs(math.remainder(towards - heading, 2 * math.pi))
        far.append(far[-1] + math.dist(p, q) + BEND * bend)
        heading = towards
    return far


def shares(weights, count):
    """Return whole numbers of at least 1 in proportion to the weights, with the sum `count`."""
    part = [w * (count - len(weights)) / sum(weights) for w in weights]
    whole = [math.floor(p) for p in part]
    most_left = sorted(range(len(part)), key=lambda i: whole[i] - part[i])
    for i in most_left[:count - len(weights) - sum(whole)]:
        whole[i] += 1
    return [1 + n for n in whole]


def cut(pieces, count, seed):
    """Return the vertices of a ring with `count` edges."""
    rng = random.Random(seed)
    curved = [piece for piece in pieces if len(piece) > 2]
    numbers = iter(shares([spread(piece)[-1] for piece in curved],
                          count - (len(pieces) - len(curved))))
    ring = []
    for piece in pieces:
        number = next(numbers) if len(piece) > 2 else 1
        steps = [1 + rng.uniform(-UNEVENNESS, UNEVENNESS) for _ in range(number)]
        at = [0.0, *itertools.accumulate(steps)][:-1]
        far = spread(piece)
        for a in at:
            wanted = far[-1] * a / sum(steps)
            k = max(i for i, f in enumerate(far[:-1]) if f <= wanted)
            share = (wanted - far[k]) / (far[k + 1] - far[k])
            ring.append(tuple(p + share * (q - p) for p, q in zip(piece[k], piece[k + 1])))
    return ring


def gear():
    """Return a wheel with twelve teeth that have slanted flanks and rounded, partly worn corners.
    """
    teeth, root, rng = 12, 4.5, random.Random(12)
    corners = []
    for k in range(teeth):
        middle, tip = 360 * k / teeth, 6.0 - rng.uniform(0, 0.2)
        corners += [(*polar((0, 0), radius, middle + degrees), rounding)
                    for radius, degrees, rounding in ((root, -9.5, 0.3), (tip, -4.6, 0.32),
                                                      (tip, 4.6, 0.32), (root, 9.5, 0.3))]
    return [cut(rounded(corners), 128, seed=128)]


def bottle():
    """Return a bottle: lip, neck, shoulder, waist, six grooves down the side, and a base with a
    dimple."""
    grooves = ((2.32, -4.7), (2.2, -3.55), (2.13, -2.4), (2.17, -1.25), (2.3, -0.1), (2.5, 3.0))
    side = [(x - inwards, y + upwards) for x, y in grooves
            for inwards, upwards in ((0, -0.34), (0.28, 0), (0, 0.34))]
    side[-3:-3] = [(2.55, 1.0), (2.58, 1.8)]
    half = [spline([(0, -6.7), (0.9, -6.85), (1.55, -7.2)]),
            arc((1.8, -6.65), 0.6, -114, 0),
            spline([(2.4, -6.65), (2.45, -5.7), *side, (2.3, 3.75), (1.75, 4.2), (1.15, 4.6),
                    (0.9, 5.15), (0.84, 6.2)]),
            *rounded([(0.84, 6.2, 0), (1.27, 6.15, 0.2), (1.27, 6.75, 0.2), (0.98, 6.8, 0),
                      (0.98, 7.3, 0.2), (0, 7.3, 0)], closed=False)]
    # One edge across the mouth, instead of two that meet in the middle.
    half[-1], other = [half[-1][0], (-half[-1][0][0], 7.3)], mirrored(half)[1:]
    return [cut(half + other, 200, seed=200)]


def fillet(middle, radius, height, rounding, side):
    """Return the fillet from a circle about (x, 0) to the line y = height, on one side of it.

    The result is the centre of the fillet's arc, and its direction from the circle's centre in
    degrees.
    """
    rise = height + rounding
    reach = math.sqrt((radius + rounding) ** 2 - rise ** 2)
    return (middle[0] + side * reach, rise), math.degrees(math.atan2(rise, side * reach))


def wrench():
    """Return a combination spanner: an open jaw, rotated by 15 degrees, and a ring with twelve
    corners."""
    ring, ring_radius, jaw, jaw_radius, opening = (5.75, 0), 1.7, (-5.2, 0), 2.2, 165
    ring_fillet, ring_from = fillet(ring, ring_radius, 0.62, 1.6, -1)
    jaw_fillet, jaw_from = fillet(jaw, jaw_radius, 0.75, 1.4, 1)
    upper = [arc(ring_fillet, 1.6, ring_from - 180, -90),
             spline([(ring_fillet[0], 0.62), (1.8, 0.52), (-0.6, 0.55), (jaw_fillet[0], 0.75)]),
             arc(jaw_fillet, 1.4, -90, jaw_from - 180)]
    lower = [[(x, -y) for x, y in reversed(piece)] for piece in reversed(upper)]
    mouth = rounded([(*polar((0, 0), jaw_radius, -42), 0), (2.06, -1.0, 0.2), (-0.2, -1.0, 0.3),
                     (-0.75, -0.45, 0.3), (-0.75, 0.45, 0.3), (-0.2, 1.0, 0.3), (2.06, 1.0, 0.2),
                     (*polar((0, 0), jaw_radius, 42), 0)], closed=False)
    outer = [arc(ring, ring_radius, -ring_from, ring_from), *upper,
             arc(jaw, jaw_radius, jaw_from, opening - 42), *moved(mouth, jaw, opening),
             arc(jaw, jaw_radius, opening + 42, 360 - jaw_from), *lower]
    rng = random.Random(12)
    hole = [polar(ring, (1.12, 0.98)[k % 2], -15 * k + rng.uniform(-1, 1)) for k in range(24)]
    return [cut(outer, 232, seed=256), hole]


def leaf():
    """Return an oak leaf on a bent stalk, with four lobes per side, slightly lower on the left."""
    half = [(0.17, -7.0), (0.14, -5.9), (0.3, -4.9), (1.2, -4.4), (1.75, -3.75), (1.5, -3.15),
            (0.9, -2.95), (0.92, -2.62), (1.5, -2.3), (2.5, -1.7), (2.8, -1.05), (2.25, -0.7),
            (1.25, -0.85), (1.25, -0.5), (2.1, 0.3), (3.3, 1.1), (3.55, 1.85), (2.95, 2.15),
            (1.62, 1.35), (1.5, 1.8), (1.95, 2.9), (2.8, 3.8), (2.8, 4.5), (2.2, 4.65),
            (1.35, 4.1), (1.15, 4.45), (1.3, 5.4), (1.05, 6.3), (0.55, 6.9)]
    left = [(0.93 * x if y > -4.5 else x, y - 0.35 * min(1, max(0, (y + 5.5) / 3)))
            for x, y in half]
    rng, above_stalk = random.Random(300), -5
    half, left = ([(x, y) if y < above_stalk else
                   (x + rng.uniform(-0.05, 0.05), y + rng.uniform(-0.05, 0.05)) for x, y in side]
                  for side in (half, left))
    bent = [(x + 0.12 * min(0, y - above_stalk) ** 2, y)
            for x, y in [*half, (0.05, 7.1), *mirrored([left])[0]]]
    edge = spline(bent)
    return [cut([edge, [edge[-1], edge[0]]], 300, seed=300)]


def plate_with_holes():
    """Return a bracket with a round hole, a slanted slot and a keyhole."""
    outer = rounded([(-6.2, -3.4, 1.3), (-1.6, -3.7, 1.6), (0.6, -2.5, 2.2), (5.4, -3.6, 1.5),
                     (6.6, 0.3, 1.5), (3.3, 1.3, 2.5), (1.9, 4.6, 1.4), (-2.6, 4.1, 1.6),
                     (-4.0, 1.4, 2.0), (-6.6, 0.2, 1.2)])
    round_hole = [arc((-4.2, -1.6), 0.95, 360, 0)]
    slot = moved([arc((1.4, 0), 0.55, 90, -90), [(1.4, -0.55), (-1.4, -0.55)],
                  arc((-1.4, 0), 0.55, 270, 90), [(-1.4, 0.55), (1.4, 0.55)]], (3.7, -1.05), -12)
    neck = math.degrees(math.asin(0.45 / 1.1))
    left, right = (polar((0, 0), 1.1, angle) for angle in (270 - neck, neck - 90))
    keyhole = moved([arc((0, 0), 1.1, 270 - neck, neck - 90), [right, (0.45, -2.6)],
                     arc((0, -2.6), 0.45, 0, -180), [(-0.45, -2.6), left]], (-0.5, 2.4), 8)
    return [cut(pieces, count, seed=count) for pieces, count in
            ((outer, 72), (round_hole, 27), (slot, 26), (keyhole, 35))]
