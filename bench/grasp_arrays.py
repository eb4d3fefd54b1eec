"""Compare force_closure on arrays of grasps with the usual Python methods: time and verdicts.

usage: PYTHONPATH=build/release/python python3 bench/grasp_arrays.py [--grasps N] [--edges E]

- linprog: a loop over scipy's linear program (HiGHS). It is feasible if forces within friction
  pyramids of E edges balance, each with a normal force of at least 1. Feasible and of full rank
  means force closure.
- Qhull: a loop over the convex hull of the pyramids' edge wrenches, as in GraspIt! and Dex-Net:
  force closure iff the origin is inside.
The pyramids are inscribed in the cones. They miss some grasps that the cones accept, but must not
accept a grasp that the cones reject.
"""

import argparse
import time

import numpy as np
from scipy.optimize import linprog
from scipy.spatial import ConvexHull, QhullError

import regrasp

MU = 0.5


def random_grasps(count, contacts, seed):
    """Return points on a sphere, with normals about 20 degrees off its normals."""
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(count, contacts, 3))
    points /= np.linalg.norm(points, axis=-1, keepdims=True)
    normals = 0.3 * rng.normal(size=points.shape) - points
    return points, normals / np.linalg.norm(normals, axis=-1, keepdims=True)


def edge_wrenches(points, normals, edges):
    """Return the wrenches of the edges of all contacts' friction pyramids, shape (6, k · edges)."""
    columns = []
    for point, normal in zip(points, normals):
        aside = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
        aside /= np.linalg.norm(aside)
        across = np.cross(normal, aside)
        for angle in 2 * np.pi * np.arange(edges) / edges:
            force = normal + MU * (np.cos(angle) * aside + np.sin(angle) * across)
            columns.append(np.concatenate([force, np.cross(point, force)]))
    return np.array(columns).T


def by_linprog(points, normals, edges):
    wrenches = edge_wrenches(points, normals, edges)
    if np.linalg.matrix_rank(wrenches) < 6:
        return False
    found = linprog(np.zeros(wrenches.shape[1]), A_eq=wrenches, b_eq=np.zeros(6),
                    bounds=(1 / edges, None), method="highs")
    return found.status == 0


def by_qhull(points, normals, edges):
    try:
        return bool((ConvexHull(edge_wrenches(points, normals, edges).T).equations[:, -1] < 0).all())
    except QhullError:  # degenerate hull
        return False


def seconds(run):
    begin = time.perf_counter()
    result = run()
    return time.perf_counter() - begin, result


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--grasps", type=int, default=100_000)
    parser.add_argument("--peer-grasps", type=int, default=200)
    parser.add_argument("--contacts", type=int, default=4)
    parser.add_argument("--edges", type=int, default=8)
    options = parser.parse_args()
    points, normals = random_grasps(options.grasps, options.contacts, 1)
    regrasp.force_closure(points[:100], normals[:100], mu=MU)
    rows = []
    for threads in (1, 0):
        taken, verdicts = min((seconds(lambda n=threads: regrasp.force_closure(
            points, normals, mu=MU, threads=n)) for _ in range(5)), key=lambda pair: pair[0])
        rows.append((f"regrasp, {'all cores' if threads == 0 else 'one core'}",
                     taken / options.grasps, ""))
    few = min(options.peer_grasps, options.grasps)
    for name, judge in (("linprog", by_linprog), ("Qhull", by_qhull)):
        taken, holds = seconds(lambda judge=judge: np.array(
            [judge(points[i], normals[i], options.edges) for i in range(few)]))
        missed = int((verdicts.is_force_closure[:few] & ~holds).sum())
        invented = int((~verdicts.is_force_closure[:few] & holds).sum())
        rows.append((f"{name}, {options.edges} edges", taken / few,
                     f"of {few}: {missed} missed, {invented} that are none"))
    ours = rows[1][1]
    print(f"{options.grasps} grasps of {options.contacts} contacts, μ = {MU}, "
          f"{verdicts.is_force_closure.mean():.0%} force closure")
    print(f"{'':22} {'μs a grasp':>12} {'times ours':>11}")
    for name, taken, note in rows:
        print(f"{name:22} {1e6 * taken:12.3f} {taken / ours:11.1f}  {note}")


if __name__ == "__main__":
    main()
