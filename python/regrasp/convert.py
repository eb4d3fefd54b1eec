"""Program regrasp-convert: convert grasps and plans from and to third-party formats."""

from __future__ import annotations

import argparse
import json
import os
import re
import sys
from dataclasses import replace

import numpy as np

from . import _arguments, _dict_file, _get_a_grip, _misread, _npz, formats
from ._hand_grasp_lines import not_written
from ._hand_grasps import WorldPoses, check_object_of_plan
from ._help_as import help_as
from ._regrasp import InputError, version
from .hands import Hand
from .objects import Object

_EPILOG = """Input, by file ending: isaac_grasp 1.0 (.yaml), dictionaries of DexGraspBench, Dexonomy and BODex
(.npy, .npz), lists of DexGraspNet (.npy), dictionaries of Get-a-Grip (.npy), worlds of GraspIt! (.xml), grasps of MultiGripperGrasp (.json) and ACRONYM (.h5), plans of HiDex (.csv), plans of regrasp for a hand (.json),
trajectories of validate (.npz, to .mcap). Output: hand grasps for evaluate
(.jsonl), isaac_grasp 1.0 (.yaml), contacts for validate --grasps (.npz), plans of regrasp (.json, of .csv), ROS 2 transforms and joint states (.mcap)."""


_HDF5 = (".h5", ".hdf5")
"""File endings of HDF5."""


class _Parser(argparse.ArgumentParser):

    def error(self, message):
        """Print one line, like the other programs, and exit."""
        self.exit(2, f"{self.prog}: error: {message} ({self.prog} --help lists all)\n")


class _HelpAs(argparse.Action):
    """Option that prints the help in another format and exits, as in the other programs."""

    def __call__(self, parser, namespace, value, option_string=None):
        try:
            print(help_as(parser, value), end="")
        except InputError as error:
            parser.error(str(error))
        parser.exit(0)


class NoContacts(Exception):
    """No grasp has contacts: the result is negative, and no file is written."""


def parser() -> argparse.ArgumentParser:
    """Return the parser of the program's options."""
    parser = _Parser(
        prog="regrasp-convert", description="Convert grasps and plans between formats, and report what "
        "the output format cannot represent.", epilog=_EPILOG)
    parser.add_argument("inputs", nargs="+", metavar="INPUT", help="files of one format, a single one for "
                        ".csv and .mcap; folders for .jsonl")
    parser.add_argument("-o", "--output", required=True, metavar="FILE", help="output file, .jsonl, .yaml, .npz, "
                        ".json or .mcap")
    parser.add_argument("--hand", metavar="FILE", help="hand file. Required for .json and .npz; adds fingertips "
                        "to .mcap")
    parser.add_argument("--palm", metavar="X,Y,Z[,QW,QX,QY,QZ]", help="pose of the palm frame in the body whose "
                        "poses the files contain. Metres and unit quaternion; --palm=-1,2,3 if it starts with a "
                        "minus [default: identity]")
    parser.add_argument("--object", metavar="FILE", help="object file. Required for .npz and from "
                        ".csv; names the object in .jsonl [default: that of the grasps]")
    parser.add_argument("--object-pose", metavar="X,Y,Z,QW,QX,QY,QZ", help="pose of the object in the world of a "
                        "dictionary (.npy, .npz). Replaces the pose in the file")
    parser.add_argument("--scale", type=float, metavar="METRES_PER_UNIT", help="metres per length unit of the "
                        "object file [default: that of the grasps, otherwise 1]")
    parser.add_argument("--tolerance-mm", type=float, default=2, metavar="MM", help="largest distance of a contact "
                        "from the surface in mm [default: 2]")
    parser.add_argument("--fingers", metavar="NAME,...", help="fingers whose contacts are written and must all "
                        "touch [default: all that touch]")
    parser.add_argument("--frame", choices=["object", "world"], help="frame of the contacts in .csv. Required if "
                        "all fingers touch throughout")
    parser.add_argument("--mesh-scale", type=float, default=1, metavar="X", help="scale of the object in the "
                        "setup.yaml of HiDex, for .csv [default: 1]")
    parser.add_argument("--mu", type=float, metavar="X", help="friction coefficient, from .csv to .json")
    parser.add_argument("-V", "--version", action="version", version=f"regrasp-convert {version}",
                        help="print the version")
    parser.add_argument("--help-as", action=_HelpAs, metavar="FORMAT", help=argparse.SUPPRESS)
    return parser


def _ending(path: str) -> str:
    return os.path.splitext(path)[1].lower()


def _need(value, name: str, what: str):
    if value is None:
        raise InputError(f"--{name} is required {what}")
    return value


def _numbers(option: str, text: str) -> list[float]:
    try:
        return [float(number) for number in text.split(",")]
    except ValueError:
        raise InputError(f"{option} must be numbers separated by commas, found {text!r}") from None


def _read_dictionary(path: str, hand: Hand | None, options) -> formats.HandGrasps:
    content = _dict_file.read_content(path)
    if isinstance(content, list):
        _check_object_pose(path, options)
        return formats.read_dexgraspnet(path)
    if _get_a_grip.MEMBERS <= set(content):
        _check_object_pose(path, options)
        return formats.read_get_a_grip(path, hand)
    read = formats.read_bodex if "robot_pose" in content else formats.read_dexgraspbench
    pose = None
    if options.object_pose is not None:
        pose = _numbers("--object-pose", options.object_pose)
        if len(pose) != 7:
            raise InputError(f"--object-pose must have 7 numbers, found {len(pose)}")
    return read(path, object_pose=pose)


def _check_object_pose(path: str, options) -> None:
    """Check that --object-pose is not given for a file without object pose."""
    if options.object_pose is not None:
        raise InputError(f"--object-pose cannot be used with {path}, expected a dictionary of "
                         "DexGraspBench, Dexonomy or BODex")


def _is_multigrippergrasp(path: str) -> bool:
    """Return whether a JSON file is one of MultiGripperGrasp, and not a plan."""
    with open(path, "rb") as file:
        start = file.read(1 << 20)
    return b'"regrasp-plan"' not in start and b'"gripper"' in start


def _with_names_of(hand: Hand, grasps: formats.HandGrasps) -> formats.HandGrasps:
    """Return the grasps with the joint names of the hand, if they differ only in punctuation.

    Isaac Sim replaces characters: joint_0.0 of a URDF is joint_0_0 there.
    """
    own = {re.sub(r"\W", "_", name): name for name in hand.joint_names}
    if len(own) < len(hand.joint_names) or set(grasps.joint_names) <= set(hand.joint_names):
        return grasps
    closing = grasps.closing and {own.get(name, name): factor for name, factor in grasps.closing.items()}
    return replace(grasps, joint_names=[own.get(name, name) for name in grasps.joint_names], closing=closing)


def _read(path: str, hand: Hand | None, options) -> formats.HandGrasps:
    ending = _ending(path)
    if ending not in (".npy", ".npz"):
        _check_object_pose(path, options)
    if ending == ".json" and _is_multigrippergrasp(path):
        return formats.read_multigrippergrasp(path)
    if ending == ".json":
        hand = _need(hand, "hand", "for the joint names of a plan")
        if options.object is None:
            check_object_of_plan(path, hand)
        return formats.of_plan(path, hand)
    if ending in (".npy", ".npz"):
        return _read_dictionary(path, hand, options)
    if ending in (".yaml", ".yml"):
        return formats.read_isaac_grasp(path)
    if ending == ".xml":
        return formats.read_graspit(path)
    if ending in _HDF5:
        return formats.read_acronym(path)
    raise InputError(f"{path}: file type not supported, expected .yaml, .npy, .npz, .xml, .h5, .csv or .json")


def _fitting(path: str, grasps: formats.HandGrasps, hand: Hand | None) -> formats.HandGrasps:
    """Return the grasps; if a hand is given, check that they have its joints."""
    try:
        if hand is not None:
            grasps.in_order_of(hand)
    except InputError as error:
        raise InputError(f"{path}: {error}") from None
    return grasps


def _join(parts: list[formats.HandGrasps]) -> formats.HandGrasps:
    names = [part.joint_names for part in parts]
    if any(n != names[0] for n in names) or len({p.joints.shape[1] for p in parts}) > 1:
        raise InputError("INPUT: all files must have the same joints")
    lost = sorted({what for part in parts for what in part.lost})
    if len({p.scales is None for p in parts}) > 1:
        raise InputError("INPUT: all files must have a scale, or none of them")
    worlds = [part.world for part in parts if part.world is not None]

    def all_of(name: str, of: list) -> np.ndarray:
        return np.concatenate([getattr(part, name) for part in of])
    return formats.HandGrasps(
        all_of("positions", parts), all_of("quaternions", parts), names[0], all_of("joints", parts),
        [n for p in parts for n in p.names], all_of("confidence", parts), lost,
        None if parts[0].scales is None else all_of("scales", parts),
        WorldPoses(all_of("palms", worlds), all_of("objects", worlds))
        if len(worlds) == len(parts) else None)


def _chosen(fingers: str | None, hand: Hand) -> list[int]:
    if not fingers:
        return list(range(len(hand.fingers)))
    return [hand.fingers.index(_arguments.choice("--fingers", name, hand.fingers))
            for name in fingers.split(",")]


def _check_output(options) -> None:
    for path in [*options.inputs, options.hand, options.object]:
        if path and os.path.exists(path) and os.path.exists(options.output) and \
                os.path.samefile(path, options.output):
            raise InputError(f"--output {options.output} must not be an input")


def _single(inputs: list[str], what: str) -> str:
    if len(inputs) > 1:
        raise InputError(f"{inputs[1]}: {what} must be the only input")
    return inputs[0]


def _object(options) -> Object:
    scale = 1 if options.scale is None else options.scale
    return Object.read(_need(options.object, "object", "to find contacts"), scale=scale)


def _convert_motion(options, hand: Hand | None) -> list[str]:
    """Convert to .mcap."""
    path = _single(options.inputs, "a plan or trajectory")
    if _ending(path) == ".json":
        motion = formats.motion_of_plan(path, _need(hand, "hand", "for the joint names of a plan"))
    elif _ending(path) == ".npz":
        motion = formats.read_trajectory(path)
    else:
        raise InputError(f"{path}: --output .mcap requires a plan (.json) or a trajectory (.npz)")
    formats.write_mcap(options.output, motion, hand)
    return motion.lost


def _convert_fingers(options) -> list[str]:
    """Convert from .csv."""
    ending = _ending(options.output)
    if ending not in (".npz", ".json"):
        raise InputError(f"--output {options.output} must be .npz or .json for an input .csv")
    grasps = formats.read_hidex(_single(options.inputs, "a plan"), frame=options.frame,
                                mesh_scale=options.mesh_scale)
    body = _object(options)
    grasps = grasps.on(body, tolerance=options.tolerance_mm / 1000)
    if ending == ".npz":
        grasps.write_npz(options.output)
        return [*grasps.lost, "the order of the grasps, which validate --grasps does not use"]
    grasps.as_plan(body, _need(options.mu, "mu", "for a plan")).write(options.output)
    return grasps.lost


def _write_contacts(options, grasps: formats.HandGrasps, hand: Hand) -> list[str]:
    body = _object(options)
    tolerance = _arguments.number("--tolerance-mm", options.tolerance_mm, 0) / 1000
    chosen = _chosen(options.fingers, hand)
    sized = grasps if options.scale is None else replace(grasps, scales=None)
    points, normals, gaps = _at_palm(options, sized).gaps(hand, body)
    touching = np.abs(gaps[:, chosen]) <= tolerance
    kept = np.flatnonzero(touching.all(axis=1) if options.fingers else touching.any(axis=1))
    if not len(kept):
        raise NoContacts(_no_contacts(options, grasps, hand, body, gaps[:, chosen]))
    lost = list(grasps.lost)
    if len(chosen) > 1 and touching.sum(axis=1).max() < 2:
        cause = _likely_cause(options, grasps, hand, body)
        if cause is not None:
            print("regrasp-convert: warning: no grasp has two fingertips at the surface; likely cause: "
                  f"{cause}", file=sys.stderr)
    _npz.write_grasps(options.output, points=points[kept][:, chosen], normals=normals[kept][:, chosen],
                      active=touching[kept], grasps=kept)
    lost.append("palm and joints")
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


def _no_contacts(options, grasps: formats.HandGrasps, hand: Hand, body: Object,
                 gaps: np.ndarray) -> str:
    """Return the message that no grasp has contacts.

    Args:
        options: Options of the program.
        grasps: Grasps as they were read.
        hand: Hand of the grasps.
        body: Object that the hand holds.
        gaps: Signed distances (N, selected fingers), m.
    """
    if not len(grasps):
        return "no contacts found: the input has no grasps"
    chosen = _chosen(options.fingers, hand)
    touching = np.abs(gaps) <= options.tolerance_mm / 1000
    if touching.any():
        what = "one of --fingers is farther from the surface in each"
    else:
        what = f"no fingertip is within {options.tolerance_mm:g} mm of the surface in any"
    nearest = int(np.argmin(np.sort(np.abs(gaps), axis=1)[:, :3].mean(axis=1)))
    distances = ", ".join(f"{hand.fingers[finger]} {1000 * gap:+.3g}"
                          for finger, gap in zip(chosen, gaps[nearest]))
    text = (f"no contacts found: {what} of {len(grasps)} grasps of {body.name}; signed distances in mm "
            f"(negative: inside) in grasp {grasps.names[nearest]}, the nearest: {distances}")
    if touching.any():
        return text
    cause = _likely_cause(options, grasps, hand, body)
    if cause is None:
        return f"{text}; cause not found: other {_misread.KINDS} does not make fingertips touch"
    return f"{text}; likely cause: {cause}"


def _likely_cause(options, grasps: formats.HandGrasps, hand: Hand,
                  body: Object) -> _misread.Cause | None:
    """Return the likely cause for the grasps as they were read. A given --scale replaces their
    scales."""
    sized = grasps if options.scale is None else replace(grasps, scales=None)
    return _misread.likely_cause(
        sized, hand, body, fingers=_chosen(options.fingers, hand),
        tolerance=options.tolerance_mm / 1000,
        palm=_numbers("--palm", options.palm) if options.palm else None,
        file_scales=None if options.scale is None else grasps.scales)


def _at_palm(options, grasps: formats.HandGrasps) -> formats.HandGrasps:
    """Return the grasps with the poses of the palm."""
    return grasps.with_palm_at(_numbers("--palm", options.palm)) if options.palm else grasps


def _write_isaac_grasp(options, grasps: formats.HandGrasps, hand: Hand | None) -> list[str]:
    if len(set(grasps.names)) < len(grasps.names):
        grasps.names = [f"grasp_{i}" for i in range(len(grasps))]
    if not grasps.joint_names:
        if hand is None:
            raise InputError("--hand is required, because the joints have no names")
        grasps.joints, grasps.joint_names = grasps.in_order_of(hand), hand.joint_names
    formats.write_isaac_grasp(options.output, grasps)
    return grasps.lost


def _grasp_files(inputs: list[str]) -> list[tuple[str, str]]:
    """Return the input files, each with the prefix of the names of its grasps.

    Folders are searched for files of grasps, with subfolders. The prefix is the path in the folder.
    """
    files = []
    for path in inputs:
        if not os.path.isdir(path):
            files.append((path, ""))
            continue
        below = sorted(os.path.join(folder, name) for folder, _, names in os.walk(path) for name in names
                       if _ending(name) in (".npy", ".npz", ".yaml", ".yml", ".xml", *_HDF5) or
                       _ending(name) == ".json" and _is_multigrippergrasp(os.path.join(folder, name)))
        if not below:
            raise InputError(f"{path}: no grasps found, expected .npy, .npz, .yaml, .xml, .h5 or .json files")
        for file in below:
            folder = os.path.dirname(os.path.relpath(file, path))
            files.append((file, folder.replace(os.sep, "/") + "/" if folder else ""))
    return files


def _hand_with_fingers(path: str | None) -> Hand | None:
    """Return the hand of a file; None if it has no fingers, which `evaluate` permits."""
    if path is None:
        return None
    try:
        with open(path, "rb") as file:
            if "fingers" not in json.load(file):
                return None
    except (ValueError, TypeError):
        pass  # Hand.read reports it
    return Hand.read(path)


def _write_hand_grasps(options) -> list[str]:
    hand = _hand_with_fingers(options.hand)
    lost: set[str] = set()

    def parts():
        for path, prefix in _grasp_files(options.inputs):
            grasps = _at_palm(options, _read(path, hand, options))
            if not grasps.joint_names and hand is not None:
                grasps = replace(_fitting(path, grasps, hand), joint_names=hand.joint_names)
            elif hand is not None:
                grasps = _with_names_of(hand, grasps)
            if grasps.directions is not None and hand is not None:
                grasps = formats.with_closing_targets(grasps, hand)
            lost.update(not_written(grasps))
            yield prefix, grasps

    scale = None if options.scale is None else _arguments.number("--scale", options.scale, 0)
    formats.write_hand_grasps(options.output, parts(), scale=scale,
                              object_file=os.path.basename(options.object) if options.object else None)
    return sorted(lost)


def _run(options) -> list[str]:
    """Convert the inputs, and return descriptions of the content that is not converted."""
    ending = _ending(options.output)
    if ending not in (".jsonl", ".yaml", ".yml", ".npz", ".json", ".mcap"):
        raise InputError(f"--output {options.output} must be .jsonl, .yaml, .npz, .json or .mcap")
    _check_output(options)
    if ending == ".jsonl":
        return _write_hand_grasps(options)
    if _ending(options.inputs[0]) == ".csv":
        return _convert_fingers(options)
    hand = Hand.read(options.hand) if options.hand else None
    if ending == ".mcap":
        return _convert_motion(options, hand)
    if ending == ".json":
        raise InputError(f"{options.inputs[0]}: --output .json requires an input .csv")
    if ending == ".npz":
        _need(hand, "hand", "to find contacts")
        _need(options.object, "object", "to find contacts")
    grasps = _join([_fitting(path, _read(path, hand, options), hand if ending == ".npz" else None)
                    for path in options.inputs])
    if ending == ".npz":
        return _write_contacts(options, grasps, hand)
    return _write_isaac_grasp(options, _at_palm(options, grasps), hand)


def main(arguments: list[str] | None = None) -> int:
    """Run the program.

    Returns:
        Exit code: 0 on success, 1 if no grasp has contacts, 2 for bad input, 3 if the machine
        fails.
    """
    options = parser().parse_args(arguments)
    try:
        lost = _run(options)
    except NoContacts as none:
        print(f"regrasp-convert: {none}", file=sys.stderr)
        return 1
    except InputError as error:
        print(f"regrasp-convert: error: {error}".replace("\n", " "), file=sys.stderr)
        return 2
    except (FileNotFoundError, IsADirectoryError) as error:
        print(f"regrasp-convert: error: {error.filename}: {error.strerror.lower()}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"regrasp-convert: error: {error}", file=sys.stderr)
        return 3
    for what in lost:
        print(f"regrasp-convert: note: not converted: {what}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
