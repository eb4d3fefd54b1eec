"""The program regrasp-convert: grasps of hands from and to the formats of other projects."""

from __future__ import annotations

import argparse
import os
import sys

import numpy as np

from . import _arguments, formats
from ._regrasp import InputError, version
from .hands import Hand
from .objects import Object

_READERS = {".yaml": formats.read_isaac_grasp, ".yml": formats.read_isaac_grasp,
            ".npy": formats.read_dexgraspbench, ".xml": formats.read_graspit}


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="regrasp-convert", description="Converts grasps of hands between formats, and says what "
        "it could not carry over.", epilog="Read, by the file's ending: isaac_grasp 1.0 (.yaml), "
        "dictionaries of DexGraspBench (.npy), worlds of GraspIt! (.xml), plans of regrasp for a hand "
        "(.json). Written: isaac_grasp 1.0 (.yaml), contacts for validate --grasps (.npz).")
    parser.add_argument("inputs", nargs="+", metavar="INPUT", help="files of one format")
    parser.add_argument("--output", required=True, metavar="FILE", help=".yaml or .npz")
    parser.add_argument("--hand", metavar="FILE", help="hand file; for .json and .npz")
    parser.add_argument("--palm", metavar="X,Y,Z[,QW,QX,QY,QZ]", help="the palm's frame in that of the "
                        "body whose poses the files give, metres and a quaternion, --palm=-1,2,3 where it begins "
                        "with a minus (default: they are "
                        "the palm's own)")
    parser.add_argument("--object", metavar="FILE", help="object file; for .npz")
    parser.add_argument("--scale", type=float, default=1, metavar="METRES_PER_UNIT",
                        help="of the object file (default 1)")
    parser.add_argument("--tolerance-mm", type=float, default=2, metavar="MM", help="a fingertip "
                        "touches that is no farther from the surface, or deeper in it (default 2)")
    parser.add_argument("--fingers", metavar="NAME,...", help="those that must touch (default: all)")
    parser.add_argument("--version", action="version", version=f"regrasp-convert {version}")
    return parser


def _ending(path: str) -> str:
    return os.path.splitext(path)[1].lower()


def _need(value, name: str, what: str):
    if value is None:
        raise InputError(f"--{name}: is needed {what}")
    return value


def _read(path: str, hand: Hand | None) -> formats.HandGrasps:
    if _ending(path) == ".json":
        return formats.of_plan(path, _need(hand, "hand", "for the joints' names of a plan"))
    if _ending(path) not in _READERS:
        raise InputError(f"{path}: .yaml, .npy, .xml or .json is read")
    return _READERS[_ending(path)](path)


def _join(parts: list[formats.HandGrasps]) -> formats.HandGrasps:
    names = [part.joint_names for part in parts]
    if any(n != names[0] for n in names) or len({p.joints.shape[1] for p in parts}) > 1:
        raise InputError("the files have other joints than each other")
    lost = sorted({what for part in parts for what in part.lost})
    return formats.HandGrasps(
        *(np.concatenate([getattr(p, key) for p in parts]) for key in ("positions", "quaternions")),
        names[0], np.concatenate([p.joints for p in parts]), [n for p in parts for n in p.names],
        np.concatenate([p.confidence for p in parts]), lost)


def _chosen(fingers: str | None, hand: Hand) -> list[int]:
    if not fingers:
        return list(range(len(hand.fingers)))
    return [hand.fingers.index(_arguments.choice("--fingers", name, hand.fingers))
            for name in fingers.split(",")]


def _palm(text: str) -> list[float]:
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        raise InputError(f"--palm: numbers are needed, found {text!r}") from None


def _run(options) -> list[str]:
    """Converts, and returns what was lost."""
    ending = _ending(options.output)
    if ending not in (".yaml", ".yml", ".npz"):
        raise InputError(f"--output: {options.output}: .yaml or .npz is written")
    hand = Hand.read(options.hand) if options.hand else None
    grasps = _join([_read(path, hand) for path in options.inputs])
    if options.palm:
        grasps = grasps.with_palm_at(_palm(options.palm))
    if ending == ".npz":
        _need(hand, "hand", "to find contacts")
        body = Object.read(_need(options.object, "object", "to find contacts"), scale=options.scale)
        points, normals, touching = grasps.touching(hand, body,
                                                    tolerance=options.tolerance_mm / 1000)
        chosen = _chosen(options.fingers, hand)
        held = np.flatnonzero(touching[:, chosen].all(axis=1))
        np.savez(options.output, points=points[held][:, chosen], normals=normals[held][:, chosen],
                 grasps=held)
        lost = grasps.lost + ["palm and joints"]
        if len(held) < len(grasps):
            off = (~touching[:, chosen]).sum(axis=0)
            lost.append(
                f"{len(grasps) - len(held)} of {len(grasps)} grasps: a fingertip is not within "
                f"{options.tolerance_mm:g} mm of the surface: "
                + ", ".join(f"{hand.fingers[f]} in {n}" for f, n in zip(chosen, off) if n)
                + "; --fingers says which must be")
        return lost
    if len(set(grasps.names)) < len(grasps.names):
        grasps.names = [f"grasp_{i}" for i in range(len(grasps))]
    if not grasps.joint_names:
        if hand is None:
            raise InputError("--hand: is needed, as the joints have no names")
        grasps.joints, grasps.joint_names = grasps.in_order_of(hand), hand.joint_names
    formats.write_isaac_grasp(options.output, grasps)
    return grasps.lost


def main(arguments: list[str] | None = None) -> int:
    """Runs the program; returns its exit code: 0, or 2 for bad input, 3 where the machine fails."""
    options = _parser().parse_args(arguments)
    try:
        lost = _run(options)
    except InputError as error:
        print(f"regrasp-convert: {error}".replace("\n", " "), file=sys.stderr)
        return 2
    except (FileNotFoundError, IsADirectoryError) as error:
        print(f"regrasp-convert: {error.filename}: {error.strerror.lower()}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"regrasp-convert: {error}", file=sys.stderr)
        return 3
    for what in lost:
        print(f"regrasp-convert: not carried over: {what}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
