"""Read world files of GraspIt! (XML)."""

from __future__ import annotations

import os
import re
import xml.etree.ElementTree

import numpy as np

from . import _arguments, _poses
from ._arguments import shown, vector
from ._hand_grasps import HandGrasps
from ._regrasp import InputError

_TRANSFORM = re.compile(r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s+(\S+?)\s*\)\s*"
                        r"\[\s*(\S+)\s+(\S+)\s+(\S+?)\s*\]")


def _graspit_pose(name: str, element) -> tuple[np.ndarray, np.ndarray]:
    text = element.findtext("transform/fullTransform", "").strip()
    match = _TRANSFORM.fullmatch(text)
    if not match:
        raise InputError(f"{name}: transform must be (w x y z)[x y z], found {shown(text)}")
    try:
        values = np.array([float(number) for number in match.groups()])
    except ValueError:
        raise InputError(f"{name}: transform must have 7 numbers, found {shown(text)}") from None
    values = vector(f"{name}: transform", values, 7)
    return values[4:] / 1000, _poses.unit(f"{name}: transform", values[:4])


def read_graspit(path: str | os.PathLike) -> HandGrasps:
    """Read a world of GraspIt! (XML): the last robot, on the first graspable body.

    Lengths in the file are millimetres. Its degrees of freedom have no names.

    Args:
        path: XML file.

    Raises:
        InputError: If the file is invalid. The message names the file and the element.
    """
    name = path = _arguments.path("path", path)
    try:
        world = xml.etree.ElementTree.parse(path).getroot()
    # An encoding unknown to the parser raises LookupError or ValueError.
    except (xml.etree.ElementTree.ParseError, LookupError, ValueError) as error:
        raise InputError(f"{name}: not an XML file: {error}") from None
    if world.tag == "virtual_contacts":
        raise InputError(f"{name}: virtual_contacts is not supported, because its frames are those of a GraspIt! hand model; "
                         "help: save the world instead")
    bodies, robots = world.findall("graspableBody"), world.findall("robot")
    if world.tag != "world" or not bodies or not robots:
        raise InputError(f"{name}: expected a world with a graspableBody and a robot, found "
                         f"{world.tag} with {len(bodies)} and {len(robots)}")
    position, back = _poses.inverse(*_graspit_pose(f"{name}: graspableBody", bodies[0]))
    palm, turn = _graspit_pose(f"{name}: robot", robots[-1])
    text = robots[-1].findtext("dofValues", "").split()
    try:
        joints = np.array([float(number) for number in text])
    except ValueError:
        raise InputError(f"{name}: robot: dofValues must be numbers") from None
    vector(f"{name}: robot: dofValues", joints, len(joints))
    lost = [f"{len(world.findall(tag))} {tag}" for tag in ("obstacle", "connection", "camera")
            if world.findall(tag)]
    lost += [f"{len(items) - 1} other {tag}" for tag, items in
             (("graspableBody", bodies), ("robot", robots)) if len(items) > 1]
    return HandGrasps((_poses.matrices(back) @ palm + position)[None],
                      _poses.product(back, turn)[None], [], joints[None],
                      [os.path.splitext(os.path.basename(name))[0]], np.ones(1), lost)
