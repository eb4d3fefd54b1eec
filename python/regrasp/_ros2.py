"""Write motions of a hand and an object as ROS 2 messages in MCAP: transforms and joint states."""

from __future__ import annotations

import os
import struct

import numpy as np

from . import _arguments, _mcap, _regrasp
from ._hand_motion import HandMotion
from ._regrasp import InputError, version
from .hands import Hand

_LINE = "=" * 80 + "\n"
_STAMPED = (_LINE + "MSG: std_msgs/Header\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
            + _LINE + "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n")
_TRANSFORMS = ("geometry_msgs/TransformStamped[] transforms\n"
               + _LINE + "MSG: geometry_msgs/TransformStamped\nstd_msgs/Header header\n"
               "string child_frame_id\nTransform transform\n"
               + _LINE + "MSG: geometry_msgs/Transform\nVector3 translation\nQuaternion rotation\n"
               + _LINE + "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n"
               + _LINE + "MSG: geometry_msgs/Quaternion\nfloat64 x\nfloat64 y\nfloat64 z\n"
               "float64 w\n" + _STAMPED)
_JOINTS = ("std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
           "float64[] effort\n" + _STAMPED)


class _Cdr:
    """Message in little-endian CDR, in which numbers are aligned to multiples of their size."""

    def __init__(self):
        self._data = bytearray()

    def number(self, format: str, value) -> None:
        size = struct.calcsize("<" + format)
        self._data += bytes(-len(self._data) % size) + struct.pack("<" + format, value)

    def text(self, text: str) -> None:
        content = text.encode() + b"\0"
        self.number("I", len(content))
        self._data += content

    def numbers(self, values) -> None:
        self.number("I", len(values))
        for value in values:
            self.number("d", value)

    def header(self, time: int, frame: str) -> None:
        self.number("i", time // 10**9)
        self.number("I", time % 10**9)
        self.text(frame)

    def bytes(self) -> bytes:
        return b"\0\1\0\0" + bytes(self._data)


def _transforms(time: int, parent: str, children: list[tuple[str, np.ndarray]]) -> bytes:
    """Return the message of poses with seven numbers each, quaternions with w first."""
    cdr = _Cdr()
    cdr.number("I", len(children))
    for name, pose in children:
        cdr.header(time, parent)
        cdr.text(name)
        for value in (*pose[:3], *pose[4:], pose[3]):
            cdr.number("d", value)
    return cdr.bytes()


def _joint_state(time: int, names: list[str], angles: np.ndarray) -> bytes:
    cdr = _Cdr()
    cdr.header(time, "")
    cdr.number("I", len(names))
    for name in names:
        cdr.text(name)
    cdr.numbers(angles)
    cdr.numbers(())
    cdr.numbers(())
    return cdr.bytes()


def write_mcap(path: str | os.PathLike, motion: HandMotion, hand: Hand | None = None, *,
               start_time: float = 0, palm_frame: str = "palm", object_frame: str = "object") -> None:
    """Write an MCAP file of ROS 2 messages for rosbag2, Foxglove and Rerun.

    The topics are:

    - `/tf` (tf2_msgs/msg/TFMessage): the object's frame in the palm frame. With a hand also a frame
      `FINGER_tip` at the centre of each fingertip sphere, with the orientation of the palm.
    - `/joint_states` (sensor_msgs/msg/JointState): the joints.
    - `/joint_commands` (sensor_msgs/msg/JointState): the controls, if there are any.

    Args:
        path: MCAP file.
        motion: Motion to write.
        hand: Hand for the fingertip frames. Default: no fingertip frames.
        start_time: Time of the motion's time 0, seconds since 1970.
        palm_frame: Name of the palm frame.
        object_frame: Name of the object's frame.
    """
    path = _arguments.path("path", path)
    _arguments.of_type("motion", motion, HandMotion)
    start = round(_arguments.number("start_time", start_time, 0, 2**31, zero=True) * 10**9)
    # Seconds in ROS 2 are an int32.
    if len(motion) and start / 10**9 + motion.times[-1] >= 2**31 - 1:
        raise InputError(f"times must be below 2^31 s, the largest time of ROS 2, found "
                         f"{motion.times[-1]:g} s")
    frames = _arguments.text("palm_frame", palm_frame), _arguments.text("object_frame", object_frame)
    tips, names = np.zeros((len(motion), 0, 3)), []
    if hand is not None:
        _arguments.of_type("hand", hand, Hand, "; Hand.read reads one")
        tips = hand.tips(hand.ordered(motion.joint_names, motion.joints))
        names = [f"{finger}_tip" for finger in hand.fingers]
    if len({*frames, *names}) < 2 + len(names):
        raise InputError("palm_frame: frames must have different names, found "
                         + ", ".join([*frames, *names]))
    for what, words in [("palm_frame", frames[:1]), ("object_frame", frames[1:]),
                        ("joint_names", motion.joint_names), ("control_names", motion.control_names)]:
        for word in words:
            if not word or not word.isprintable():
                raise InputError(f"{what} must be a printable name, found {_arguments.shown(word)}")
    writer = _mcap.Writer("ros2", f"regrasp {version}")
    # Metadata of rosbag2; empty: defaults.
    metadata = {"offered_qos_profiles": ""}
    tf = writer.channel("/tf", "tf2_msgs/msg/TFMessage", _TRANSFORMS, metadata)
    states = writer.channel("/joint_states", "sensor_msgs/msg/JointState", _JOINTS, metadata)
    if motion.control_names:
        commands = writer.channel("/joint_commands", "sensor_msgs/msg/JointState", _JOINTS, metadata)
    for i, seconds in enumerate(motion.times):
        time = start + round(seconds * 10**9)
        children = [(frames[1], motion.object_poses[i])]
        children += [(name, np.array([*tip, 1, 0, 0, 0])) for name, tip in zip(names, tips[i])]
        writer.message(tf, time, _transforms(time, frames[0], children))
        writer.message(states, time, _joint_state(time, motion.joint_names, motion.joints[i]))
        if motion.control_names:
            writer.message(commands, time,
                           _joint_state(time, motion.control_names, motion.controls[i]))
    _regrasp.write_file(path, writer.bytes())
