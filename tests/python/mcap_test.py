"""MCAP files, parsed according to their specification, with ROS 2 messages in CDR."""

import contextlib
import io
import struct
import subprocess
import unittest
import zlib

import numpy as np

import regrasp
from regrasp import _mcap, convert, formats
from regrasp_case import PROGRAMS, RegraspCase

HAND = "models/hands/ring4.json"
CUBE = "models/cube.obj"
MAGIC = b"\x89MCAP0\r\n"


class Reader:
    """Sequential reader of bytes; numbers are little-endian."""

    def __init__(self, data, at=0):
        self.data, self.at = data, at

    def take(self, count):
        taken = self.data[self.at:self.at + count]
        assert len(taken) == count, "the file ends too early"
        self.at += count
        return bytes(taken)

    def number(self, form):
        return struct.unpack("<" + form, self.take(struct.calcsize("<" + form)))[0]

    def bytes(self):
        return self.take(self.number("I"))

    def text(self):
        return self.bytes().decode()

    def more(self):
        return self.at < len(self.data)


def records(data, at=0, end=None):
    """Yield (kind, start, end, content) of each record."""
    reader = Reader(data[:end], at)
    while reader.more():
        begin = reader.at
        kind, length = reader.number("B"), reader.number("Q")
        yield kind, begin, begin + 9 + length, reader.take(length)


def read(data):
    """Return channels by number (topic, schema, definition) and messages (channel, time, content)
    in order.

    All statements of the index and the checksums are checked.
    """
    assert data.startswith(MAGIC) and data.endswith(MAGIC)
    found = list(records(data, 8, len(data) - 8))
    kinds = [kind for kind, *_ in found]
    assert kinds[0] == 1 and kinds[-1] == 2 and kinds.count(0x0F) == 1
    footer = Reader(found[-1][3])
    summary, offsets, crc = footer.number("Q"), footer.number("Q"), footer.number("I")
    assert crc == zlib.crc32(data[summary:len(data) - 8 - 4])
    end = next(record for record in found if record[0] == 0x0F)
    assert Reader(end[3]).number("I") == zlib.crc32(data[:end[1]]) and end[2] == summary
    schemas, channels, messages, places = {}, {}, [], {}
    defined, restated = [], []

    def define(kind, content):
        defined.append((kind, content))
        reader = Reader(content)
        number = reader.number("H")
        if kind == 3:
            schemas[number] = (reader.text(), reader.text(), reader.text())
        elif kind == 4:
            name, encoding, definition = schemas[reader.number("H")]
            channels[number] = (reader.text(), name, definition)
            assert (encoding, reader.text()) == ("ros2msg", "cdr")

    chunks = {}
    for kind, begin, stop, content in found:
        if kind == 6:
            reader = Reader(content)
            first, last, size, crc = (reader.number(form) for form in "QQQI")
            assert reader.text() == "" and reader.number("Q") == size
            inner = reader.take(size)
            assert not reader.more() and zlib.crc32(inner) == crc
            times = []
            for k, at, _, c in records(inner):
                if k == 5:
                    m = Reader(c)
                    channel, sequence, time = m.number("H"), m.number("I"), m.number("Q")
                    assert m.number("Q") == time
                    messages.append((channel, sequence, time, c[m.at:]))
                    places.setdefault((begin, channel), []).append((time, at))
                    times.append(time)
                else:
                    define(k, c)
            assert (first, last) == (min(times), max(times))
            chunks[begin] = (stop - begin, first, last, size)
        elif kind in (3, 4):
            restated.append((kind, content)) if begin >= summary else define(kind, content)
        elif kind == 7:
            reader = Reader(content)
            channel, entries = reader.number("H"), Reader(reader.bytes())
            pairs = []
            while entries.more():
                pairs.append((entries.number("Q"), entries.number("Q")))
            assert pairs == places[max(chunks), channel]
        elif kind == 8:
            reader = Reader(content)
            first, last, start, length = (reader.number("Q") for _ in range(4))
            indices = Reader(reader.bytes())
            reader.number("Q")
            assert reader.text() == "" and reader.number("Q") == reader.number("Q") == chunks[start][3]
            assert chunks.pop(start)[:3] == (length, first, last)
            while indices.more():
                channel, at = indices.number("H"), indices.number("Q")
                assert data[at] == 7 and struct.unpack("<H", data[at + 9:at + 11])[0] == channel
        elif kind == 0x0B:
            reader = Reader(content)
            assert reader.number("Q") == len(messages)
            assert reader.number("H") == len(schemas) and reader.number("I") == len(channels)
            assert (reader.number("I"), reader.number("I"), reader.number("I")) == (0, 0, kinds.count(6))
            times = [time for _, _, time, _ in messages] or [0]
            assert (reader.number("Q"), reader.number("Q")) == (min(times), max(times))
            counts = Reader(reader.bytes())
            while counts.more():
                number, count = counts.number("H"), counts.number("Q")
                assert count == sum(message[0] == number for message in messages)
        elif kind == 0x0E:
            reader = Reader(content)
            kind, start, length = reader.number("B"), reader.number("Q"), reader.number("Q")
            assert {k for k, *_ in records(data, start, start + length)} == {kind}
    assert not chunks, "a chunk without an index"
    assert sorted(restated) == sorted(defined), "the summary has other schemas or channels"
    times = [time for _, _, time, _ in messages]
    assert times == sorted(times)
    assert offsets == next(begin for kind, begin, *_ in found if kind == 0x0E)
    return channels, messages


class Cdr(Reader):
    """Message; numbers are aligned to multiples of their size after the header of four bytes."""

    def __init__(self, data):
        assert data[:4] == b"\0\1\0\0"
        super().__init__(data[4:])

    def number(self, form):
        size = struct.calcsize("<" + form)
        self.at += -self.at % size
        return super().number(form)

    def text(self):
        text = self.bytes()
        assert text.endswith(b"\0")
        return text[:-1].decode()

    def header(self):
        return self.number("i") * 10**9 + self.number("I"), self.text()

    def transforms(self):
        return [(*self.header(), self.text(), [self.number("d") for _ in range(7)])
                for _ in range(self.number("I"))]

    def joint_state(self):
        header = self.header()
        names = [self.text() for _ in range(self.number("I"))]
        arrays = [[self.number("d") for _ in range(self.number("I"))] for _ in range(3)]
        assert not self.more()
        return header, names, arrays


class McapTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.hand = regrasp.Hand.read(HAND)
        times = np.array([0, 0.25, 0.25, 7.000000001])
        turns = np.array([[1., 0, 0, 0], [0.6, 0, 0.8, 0], [0, 1, 0, 0], [0.5, 0.5, -0.5, 0.5]])
        rng = np.random.default_rng(1)
        cls.motion = formats.HandMotion(
            times, cls.hand.joint_names[::-1] + ["wrist"], rng.normal(size=(4, 17)),
            np.hstack([rng.normal(size=(4, 3)), turns]), ["a", "b"], rng.normal(size=(4, 2)))

    def messages(self, *arguments, **named):
        formats.write_mcap(self.path("a.mcap"), *arguments, **named)
        with open(self.path("a.mcap"), "rb") as file:
            channels, messages = read(file.read())
        by_topic = {topic: [] for topic, *_ in channels.values()}
        for number, sequence, time, content in messages:
            topic = channels[number][0]
            self.assertEqual(sequence, len(by_topic[topic]))
            by_topic[topic].append((time, Cdr(content)))
        return {c[0]: c[1:] for c in channels.values()}, by_topic

    def test_every_number_comes_back_bit_for_bit(self):
        channels, messages = self.messages(self.motion, self.hand, start_time=1.5e9)
        self.assertEqual(channels["/tf"][0], "tf2_msgs/msg/TFMessage")
        self.assertEqual(channels["/joint_states"][0], "sensor_msgs/msg/JointState")
        self.assertIn("MSG: geometry_msgs/TransformStamped\n", channels["/tf"][1])
        tips = self.hand.tips(self.motion.joints[:, 15::-1])
        for i, (seconds, pose) in enumerate(zip(self.motion.times, self.motion.object_poses)):
            time, cdr = messages["/tf"][i]
            self.assertEqual(time, 1_500_000_000_000_000_000 + round(seconds * 1e9))
            transforms = cdr.transforms()
            self.assertEqual([t[:3] for t in transforms], [
                (time, "palm", name) for name in ["object", *(f + "_tip" for f in self.hand.fingers)]])
            self.assertEqual(transforms[0][3], [*pose[:3], *pose[4:], pose[3]])
            for tip, transform in zip(tips[i], transforms[1:]):
                self.assertEqual(transform[3], [*tip, 0, 0, 0, 1])
            for topic, names, values in [
                    ("/joint_states", self.motion.joint_names, self.motion.joints),
                    ("/joint_commands", ["a", "b"], self.motion.controls)]:
                self.assertEqual(messages[topic][i][0], time)
                header, found, arrays = messages[topic][i][1].joint_state()
                self.assertEqual((header, found), ((time, ""), names))
                self.assertEqual(arrays, [values[i].tolist(), [], []])

    def test_definitions_have_all_that_they_refer_to_and_topics_a_quality_of_service(self):
        channels, _ = self.messages(self.motion, self.hand)
        fields = 0
        for name, definition in channels.values():
            first, *others = definition.split("=" * 80 + "\n")
            parts = {name.replace("/msg", ""): first}
            for other in others:
                line, _, text = other.partition("\n")
                self.assertTrue(line.startswith("MSG: "))
                parts[line.removeprefix("MSG: ")] = text
            for package, text in [(part.split("/")[0], text) for part, text in parts.items()]:
                for line in text.splitlines():
                    kind = line.split()[0].removesuffix("[]")
                    if kind not in ("string", "int32", "uint32", "float64"):
                        self.assertIn(kind if "/" in kind else f"{package}/{kind}", parts)
                    fields += 1
        self.assertGreater(fields, 30)
        with open(self.path("a.mcap"), "rb") as file:
            data = file.read()
        # Each topic once in the data and once in the summary.
        self.assertEqual(data.count(b"offered_qos_profiles"), 2 * 3)

    def test_without_controls_and_without_a_hand(self):
        bare = formats.HandMotion(self.motion.times, self.motion.joint_names, self.motion.joints,
                                  self.motion.object_poses)
        channels, messages = self.messages(bare, palm_frame="world", object_frame="cube")
        self.assertEqual(set(channels), {"/tf", "/joint_states"})
        self.assertEqual([t[:3] for t in messages["/tf"][0][1].transforms()], [(0, "world", "cube")])

    def test_long_motions_are_several_chunks(self):
        count = 2000
        long = formats.HandMotion(np.arange(count) / 100, self.motion.joint_names,
                                  np.resize(self.motion.joints, (count, 17)),
                                  np.resize(self.motion.object_poses, (count, 7)))
        _, messages = self.messages(long, self.hand)
        self.assertEqual(len(messages["/tf"]), count)
        with open(self.path("a.mcap"), "rb") as file:
            kinds = [kind for kind, *_ in records(file.read()[8:-8])]
        self.assertGreater(kinds.count(6), 1)
        self.assertEqual(kinds.count(6), kinds.count(8))

    def test_the_reader_finds_what_is_broken(self):
        writer = _mcap.Writer("ros2", "test")
        channel = writer.channel("/a", "a/msg/A", "uint8 a\n", {})
        for time in range(3):
            writer.message(channel, time, b"\0\1\0\0\7")
        good = writer.bytes()
        self.assertEqual(len(read(good)[1]), 3)
        broken = 0
        for at in range(8, len(good) - 8):
            with self.subTest(at=at):
                with self.assertRaises((AssertionError, struct.error, KeyError, ValueError,
                                        StopIteration)):
                    read(good[:at] + bytes([good[at] ^ 1]) + good[at + 1:])
                broken += 1
        self.assertEqual(broken, len(good) - 16)

    def test_no_messages_are_a_file_too(self):
        channels, messages = read(_mcap.Writer("ros2", "test").bytes())
        self.assertEqual((channels, messages), ({}, []))
        none = formats.HandMotion(np.zeros(0), ["a"], np.zeros((0, 1)), np.zeros((0, 7)))
        channels, messages = self.messages(none)
        self.assertEqual(messages, {"/tf": [], "/joint_states": []})
        self.assertIn("float64[] position", channels["/joint_states"][1])

    def test_wrong_motions_are_named(self):
        motion = self.motion
        given = [motion.times, motion.joint_names, motion.joints, motion.object_poses]
        self.refuses(["times must be increasing"], formats.HandMotion, motion.times[::-1], *given[1:])
        self.refuses(["joints", "(4, 17)", "(4, 16)"], formats.HandMotion, *given[:2],
                     motion.joints[:, 1:], given[3])
        self.refuses(["object_poses must be a unit quaternion"], formats.HandMotion, *given[:3], np.ones((4, 7)))
        self.refuses(["controls", "(4, 1)"], formats.HandMotion, *given, ["a"], motion.controls)
        self.refuses(["palm_frame", "different"], formats.write_mcap, self.path("a.mcap"), motion,
                     palm_frame="object")
        self.refuses(["names", "finger0_joint0"], formats.write_mcap, self.path("a.mcap"),
                     formats.HandMotion([0.], ["a"], [[0.]], given[3][:1]), self.hand)

    def test_the_program_goes_from_plan_and_trajectory_to_mcap(self):
        plan, trajectory = self.path("plan.json"), self.path("t.npz")
        subprocess.run([f"{PROGRAMS}/plan", "--hand", HAND, "--object", CUBE, "--mu", "0.8", "--turn",
                        "z 30", "--output", plan, "--quiet"], check=True)
        subprocess.run([f"{PROGRAMS}/validate", "--hand", HAND, "--object", CUBE, "--plan", plan,
                        "--trajectory", trajectory, "--out", self.path("out"), "--no-frames",
                        "--quiet"], check=True)
        self.assertIn("no times", self.convert(plan, "--hand", HAND, "--output", self.path("p.mcap")))
        self.assertEqual("", self.convert(trajectory, "--output", self.path("t.mcap")))
        with open(self.path("t.mcap"), "rb") as file:
            channels, messages = read(file.read())
        with np.load(trajectory) as arrays:
            self.assertEqual(len(messages), 3 * len(arrays["time_s"]))
            last = Cdr(messages[-2][3]).joint_state()
            self.assertEqual(last[2][0], arrays["joints"][-1].tolist())
        with open(self.path("p.mcap"), "rb") as file:
            channels, messages = read(file.read())
        self.assertEqual({channel[0] for channel in channels.values()}, {"/tf", "/joint_states"})
        states = [Cdr(m[3]).joint_state()[2][0] for m in messages if channels[m[0]][0] != "/tf"]
        ends = formats.of_plan(plan, self.hand).joints
        self.assertEqual((states[0], states[-1]), (ends[0].tolist(), ends[-1].tolist()))
        for words, arguments in [(["--hand"], [plan, "--output", "x.mcap"]),
                                 (["a.yaml", ".mcap requires"], ["a.yaml", "--output", "x.mcap"]),
                                 (["NPZ"], [plan.replace("json", "npz"), "--output", "x.mcap"])]:
            if words == ["NPZ"]:
                with open(plan.replace("json", "npz"), "w", encoding="utf-8") as file:
                    file.write("no archive")
            said = self.convert(*arguments, code=2)
            for word in words:
                self.assertIn(word, said)
        np.savez(self.path("few.npz"), time_s=np.zeros(2))
        self.assertIn("joint_names not found", self.convert(self.path("few.npz"), "--output", "x.mcap", code=2))

    def convert(self, *arguments, code=0):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(convert.main(list(arguments)), code, said.getvalue())
        return said.getvalue()


if __name__ == "__main__":
    unittest.main()
