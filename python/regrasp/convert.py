"""The program regrasp-convert: grasps and plans from and to the formats of other projects."""

from __future__ import annotations

import argparse
import os
import sys

import numpy as np

from . import _arguments, _dict_file, _npz, formats
from ._help_as import help_as
from ._regrasp import InputError, version
from .hands import Hand
from .objects import Object

_EPILOG = """Read, by the files' ending: isaac_grasp 1.0 (.yaml), dictionaries of DexGraspBench and BODex
(.npy, .npz), worlds of GraspIt! (.xml), plans of HiDex (.csv), plans of regrasp for a hand (.json),
trajectories of validate (.npz, to .mcap). Written: isaac_grasp 1.0 (.yaml), contacts for validate --grasps
(.npz), plans of regrasp (.json, of .csv), ROS 2 transforms and joint states (.mcap)."""


class _Parser(argparse.ArgumentParser):

    def error(self, message):
        """One line, as of the other programs."""
        self.exit(2, f"{self.prog}: {message} ({self.prog} --help lists all options)\n")


class _HelpAs(argparse.Action):
    """As of the other programs: prints the text in another format, and exits."""

    def __call__(self, parser, namespace, value, option_string=None):
        try:
            print(help_as(parser, value), end="")
        except InputError as error:
            parser.error(str(error))
        parser.exit(0)


def parser() -> argparse.ArgumentParser:
    """Of the program's options."""
    parser = _Parser(
        prog="regrasp-convert", description="Converts grasps and plans between formats, and says what "
        "it could not carry over.", epilog=_EPILOG)
    parser.add_argument("inputs", nargs="+", metavar="INPUT", help="files of one format; of .csv and "
                        "for .mcap one")
    parser.add_argument("--output", required=True, metavar="FILE", help=".yaml, .npz, .json or .mcap")
    parser.add_argument("--hand", metavar="FILE", help="hand file; for .json and .npz; for .mcap also "
                        "the fingertips")
    parser.add_argument("--palm", metavar="X,Y,Z[,QW,QX,QY,QZ]", help="the palm's frame in that of the "
                        "body whose poses the files give, metres and a quaternion, --palm=-1,2,3 where "
                        "it begins with a minus (default: they are the palm's own)")
    parser.add_argument("--object", metavar="FILE", help="object file; for .npz and of .csv")
    parser.add_argument("--object-pose", metavar="X,Y,Z,QW,QX,QY,QZ", help="the object's pose in the "
                        "world of a file of BODex that has none")
    parser.add_argument("--scale", type=float, default=1, metavar="METRES_PER_UNIT",
                        help="of the object file (default 1)")
    parser.add_argument("--tolerance-mm", type=float, default=2, metavar="MM", help="a fingertip "
                        "touches that is no farther from the surface, or deeper in it; so far a contact "
                        "of .csv may be off it (default 2)")
    parser.add_argument("--fingers", metavar="NAME,...", help="those whose contacts are "
                        "written, and which must all touch (default: all fingers, where they touch)")
    parser.add_argument("--frame", choices=["object", "world"], help="that contacts of .csv are in, "
                        "where all fingers touch all the time and so the file does not tell")
    parser.add_argument("--mesh-scale", type=float, default=1, metavar="X", help="by which HiDex scales "
                        "the object's file, scale in its setup.yaml; of .csv (default 1)")
    parser.add_argument("--mu", type=float, metavar="X", help="friction coefficient; of .csv to .json")
    parser.add_argument("--version", action="version", version=f"regrasp-convert {version}",
                        help="print the version and exit")
    parser.add_argument("--help-as", action=_HelpAs, metavar="FORMAT", help=argparse.SUPPRESS)
    return parser


def _ending(path: str) -> str:
    return os.path.splitext(path)[1].lower()


def _need(value, name: str, what: str):
    if value is None:
        raise InputError(f"--{name}: is needed {what}")
    return value


def _numbers(option: str, text: str) -> list[float]:
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        raise InputError(f"{option}: numbers are needed, found {text!r}") from None


def _read_dictionary(path: str, options) -> formats.HandGrasps:
    if "robot_pose" not in _dict_file.read_dict(path):
        return formats.read_dexgraspbench(path)
    pose = options.object_pose
    return formats.read_bodex(path, object_pose=_numbers("--object-pose", pose) if pose else None)


def _read(path: str, hand: Hand | None, options) -> formats.HandGrasps:
    ending = _ending(path)
    if ending == ".json":
        return formats.of_plan(path, _need(hand, "hand", "for the joints' names of a plan"))
    if ending in (".npy", ".npz"):
        return _read_dictionary(path, options)
    if ending in (".yaml", ".yml"):
        return formats.read_isaac_grasp(path)
    if ending == ".xml":
        return formats.read_graspit(path)
    raise InputError(f"{path}: .yaml, .npy, .npz, .xml, .csv or .json is read")


def _fitting(path: str, grasps: formats.HandGrasps, hand: Hand | None) -> formats.HandGrasps:
    """The same grasps, if a hand that is given has their joints."""
    try:
        if hand is not None:
            grasps.in_order_of(hand)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    return grasps


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


def _check_output(options) -> None:
    for path in [*options.inputs, options.hand, options.object]:
        if path and os.path.exists(path) and os.path.exists(options.output) and \
                os.path.samefile(path, options.output):
            raise InputError(f"--output: {options.output}: is an input")


def _single(inputs: list[str], what: str) -> str:
    if len(inputs) > 1:
        raise InputError(f"{inputs[1]}: {what} is converted alone")
    return inputs[0]


def _object(options) -> Object:
    return Object.read(_need(options.object, "object", "to find contacts"), scale=options.scale)


def _convert_motion(options, hand: Hand | None) -> list[str]:
    """To .mcap."""
    path = _single(options.inputs, "what goes to .mcap")
    if _ending(path) == ".json":
        motion = formats.motion_of_plan(path, _need(hand, "hand", "for the joints' names of a plan"))
    elif _ending(path) == ".npz":
        motion = formats.read_trajectory(path)
    else:
        raise InputError(f"{path}: .mcap is made of a plan (.json) or a trajectory (.npz)")
    formats.write_mcap(options.output, motion, hand)
    return motion.lost


def _convert_fingers(options) -> list[str]:
    """Of .csv."""
    ending = _ending(options.output)
    if ending not in (".npz", ".json"):
        raise InputError(f"--output: {options.output}: .csv goes to .npz or .json")
    grasps = formats.read_hidex(_single(options.inputs, "a plan"), frame=options.frame,
                                mesh_scale=options.mesh_scale)
    body = _object(options)
    grasps = grasps.on(body, tolerance=options.tolerance_mm / 1000)
    if ending == ".npz":
        grasps.write_npz(options.output)
        return [*grasps.lost, "the order of the grasps means nothing to validate --grasps"]
    grasps.as_plan(body, _need(options.mu, "mu", "for a plan")).write(options.output)
    return grasps.lost


def _write_contacts(options, grasps: formats.HandGrasps, hand: Hand) -> list[str]:
    points, normals, touching = grasps.touching(hand, _object(options),
                                                tolerance=options.tolerance_mm / 1000)
    chosen = _chosen(options.fingers, hand)
    touching = touching[:, chosen]
    kept = np.flatnonzero(touching.all(axis=1) if options.fingers else touching.any(axis=1))
    _npz.write(options.output, points=points[kept][:, chosen], normals=normals[kept][:, chosen],
               holds=touching[kept], grasps=kept)
    lost = grasps.lost + ["palm and joints"]
    off = (~touching).sum(axis=0)
    if off.any():
        lost.append(f"fingertips that are not within {options.tolerance_mm:g} mm of the surface: "
                    + ", ".join(f"{hand.fingers[f]} in {n}" for f, n in zip(chosen, off) if n)
                    + f" of {len(grasps)} grasps")
    if len(kept) < len(grasps):
        lost.append(f"{len(grasps) - len(kept)} of {len(grasps)} grasps, in which "
                    + ("one of --fingers does not touch" if options.fingers
                       else "no fingertip touches"))
    return lost


def _write_isaac_grasp(options, grasps: formats.HandGrasps, hand: Hand | None) -> list[str]:
    if len(set(grasps.names)) < len(grasps.names):
        grasps.names = [f"grasp_{i}" for i in range(len(grasps))]
    if not grasps.joint_names:
        if hand is None:
            raise InputError("--hand: is needed, as the joints have no names")
        grasps.joints, grasps.joint_names = grasps.in_order_of(hand), hand.joint_names
    formats.write_isaac_grasp(options.output, grasps)
    return grasps.lost


def _run(options) -> list[str]:
    """Converts, and returns what was lost."""
    ending = _ending(options.output)
    if ending not in (".yaml", ".yml", ".npz", ".json", ".mcap"):
        raise InputError(f"--output: {options.output}: .yaml, .npz, .json or .mcap is written")
    _check_output(options)
    if _ending(options.inputs[0]) == ".csv":
        return _convert_fingers(options)
    hand = Hand.read(options.hand) if options.hand else None
    if ending == ".mcap":
        return _convert_motion(options, hand)
    if ending == ".json":
        raise InputError(f"{options.inputs[0]}: only .csv goes to .json")
    if ending == ".npz":
        _need(hand, "hand", "to find contacts")
        _need(options.object, "object", "to find contacts")
    grasps = _join([_fitting(path, _read(path, hand, options), hand if ending == ".npz" else None)
                    for path in options.inputs])
    if options.palm:
        grasps = grasps.with_palm_at(_numbers("--palm", options.palm))
    if ending == ".npz":
        return _write_contacts(options, grasps, hand)
    return _write_isaac_grasp(options, grasps, hand)


def main(arguments: list[str] | None = None) -> int:
    """Runs the program; returns its exit code: 0, or 2 for bad input, 3 where the machine fails."""
    options = parser().parse_args(arguments)
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
