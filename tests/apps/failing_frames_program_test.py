"""What validate draws of a plan that fails: a frame for every reason, and the contact sheet."""

import copy
import os
import struct
import zlib

import program_case
from program_case import ProgramCase

SIZE = (320, 240)
EMPTY_CELL = (238, 240, 244)


def png_pixels(data):
    """Width, and rows of RGB triples, of a PNG of 8 bits a channel without interlace."""
    width, height = struct.unpack(">II", data[16:24])
    assert data[24:26] == b"\x08\x02", "RGB"
    packed, at = b"", 8
    while at < len(data):
        length = struct.unpack(">I", data[at:at + 4])[0]
        if data[at + 4:at + 8] == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    raw, stride = zlib.decompress(packed), 3 * width
    before, rows = bytearray(stride), []
    for y in range(height):
        kind = raw[y * (stride + 1)]
        row = bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - 3] if i >= 3 else 0
            corner = before[i - 3] if i >= 3 else 0
            if kind == 1:
                add = left
            elif kind == 2:
                add = before[i]
            elif kind == 3:
                add = (left + before[i]) // 2
            elif kind == 4:
                guess = left + before[i] - corner
                ways = (abs(guess - left), abs(guess - before[i]), abs(guess - corner))
                add = (left, before[i], corner)[ways.index(min(ways))]
            else:
                add = 0
            row[i] = (row[i] + add) & 255
        rows.append([tuple(row[i:i + 3]) for i in range(0, stride, 3)])
        before = row
    return rows


def count(rows, holds):
    return sum(holds(pixel) for row in rows for pixel in row)


def is_red(pixel):
    """The red of what is wrong, lit or in shade; no finger has it."""
    red, green, blue = pixel
    return red > 110 and green < 0.22 * red and blue < 0.35 * red


class FailingFrames(ProgramCase):
    program = "validate"

    def setUp(self):
        super().setUp()
        self.plan = self.plan_of_cube()

    def arguments(self, *more):
        self.write_json("plan.json", self.plan)
        return ["--object", self.model("cube.obj"), "--plan", "plan.json", "--out", "result",
                "--size", "x".join(map(str, SIZE)), *more]

    def assert_frame_of_failure(self, index, reason, *more, finger=True):
        """The step at fault has a frame, with red where a finger is at fault; the sheet has a
        grey cell for each step after it."""
        done = self.run_program(*self.arguments(*more))
        self.assertEqual(done.returncode, 1, done.stderr)
        steps = self.report()["steps"]
        self.assertEqual(steps[index]["reason"], reason)
        frame = f"{index:03}_{steps[index]['kind']}.png"
        self.assertEqual([step["frame"] for step in steps[index:]],
                         [frame] + [None] * (len(steps) - index - 1))
        frames = sorted(name for name in os.listdir(self.path("result"))
                        if name.endswith(".png") and name != "overview.png")
        self.assertEqual(frames, [step["frame"] for step in steps[:index + 1]])
        if finger:
            self.assertGreater(count(png_pixels(self.read("result/" + frame)), is_red), 10)
        return steps, frame

    def make_align(self):
        """The hold, and an align of all its fingers by half a millimetre."""
        first = self.plan["initial"]["contacts"]
        last = copy.deepcopy(first)
        for contact in last:
            axis = next(i for i in range(3) if abs(contact["normal"][i]) < 0.5)
            contact["point"][axis] += 0.0005
        self.plan["steps"] = [{"kind": "align", "waypoints": [
            {"contacts": copy.deepcopy(first)}, {"contacts": last}]}]
        self.plan["goal"] = {"contacts": copy.deepcopy(last)}
        return [waypoint["contacts"] for waypoint in self.plan["steps"][0]["waypoints"]]

    def test_frames_of_a_plan_that_passes_have_no_red(self):
        self.assert_done(*self.arguments())
        steps = self.report()["steps"]
        for step in steps:
            self.assertEqual(count(png_pixels(self.read("result/" + step["frame"])), is_red), 0)
        sheet = png_pixels(self.read("result/overview.png"))
        self.assertEqual(count(sheet, lambda pixel: pixel == EMPTY_CELL), 0)

    def test_the_sheet_has_a_grey_cell_for_each_step_that_was_not_replayed(self):
        contact = self.plan["steps"][0]["place"][0]
        contact["point"] = [p - 0.004 * n for p, n in zip(contact["point"], contact["normal"])]
        steps, _ = self.assert_frame_of_failure(1, "off-surface")
        sheet = png_pixels(self.read("result/overview.png"))
        columns = 3
        self.assertEqual(len(steps), 5)
        cell = (len(sheet[0]) / columns) ** 2 * SIZE[1] / SIZE[0]
        grey = count(sheet, lambda pixel: pixel == EMPTY_CELL) / cell
        self.assertGreater(grey, 0.8 * 3)
        self.assertLess(grey, 3)

    def test_a_contact_off_the_surface_near_or_far(self):
        place = copy.deepcopy(self.plan["steps"][1]["place"][0])
        for away in (1e-4, 0.004, -0.004, 4000, 1e9):
            contact = self.plan["steps"][1]["place"][0]
            contact["point"] = [p - away * n for p, n in zip(place["point"], place["normal"])]
            self.assert_frame_of_failure(2, "off-surface")

    def test_a_wrong_normal_at_the_hold_where_nothing_was_replayed(self):
        contact = self.plan["initial"]["contacts"][0]
        contact["normal"] = [-n for n in contact["normal"]]
        self.assert_frame_of_failure(0, "wrong-normal")

    def test_fingers_that_are_not_free_not_holding_or_too_many(self):
        step = self.plan["steps"][0]
        good = copy.deepcopy(step)
        step["place"][0]["finger"] = step["release"][0]
        self.assert_frame_of_failure(1, "finger-not-free")
        step["place"][0]["finger"] = 7
        self.assert_frame_of_failure(1, "too-many-fingers")
        holding = {contact["finger"] for contact in self.plan["initial"]["contacts"]}
        step["place"], step["release"] = [], list({0, 1, 2, 3, 4} - holding)
        # The finger is nowhere: what is wrong stands in words.
        self.assert_frame_of_failure(1, "finger-not-holding", finger=False)
        held = self.plan["initial"]["contacts"][0]
        self.plan["steps"][0] = good
        good["place"][0]["point"], good["place"][0]["normal"] = held["point"], held["normal"]
        if held["finger"] in good["release"]:
            good["release"] = [next(f for f in holding if f != held["finger"])]
        self.assert_frame_of_failure(1, "coincident-fingers")

    def test_an_align_that_jumps_or_leaves_its_face(self):
        waypoints = self.make_align()
        self.assert_done(*self.arguments())
        waypoints[0][0]["point"] = waypoints[1][0]["point"]
        self.assert_frame_of_failure(1, "discontinuous")
        waypoints = self.make_align()
        other = waypoints[1][1]
        axis = next(i for i in range(3) if abs(other["normal"][i]) < 0.5)
        waypoints[1][0]["point"] = list(other["point"])
        waypoints[1][0]["point"][axis] += 0.005
        waypoints[1][0]["normal"] = other["normal"]
        self.assert_frame_of_failure(1, "leaves-face")

    def test_too_little_friction(self):
        steps, _ = self.assert_frame_of_failure(0, "not-force-closure", "--friction-angle", "5")
        self.assertGreater(steps[0]["force_closure"]["required_half_angle_deg"], 5)

    def test_fingers_that_are_too_thick(self):
        self.assert_frame_of_failure(1, "unreachable", "--finger-radius", "0.06")

    def test_failures_of_the_replay(self):
        self.assert_frame_of_failure(0, "slipped", "--tolerance", "1e-12")
        self.assert_frame_of_failure(0, "contact-lost", "--squeeze", "3", "--mu", "0.36")
        self.assert_frame_of_failure(1, "object-moved", "--squeeze", "20", "--tolerance", "1e-6",
                                     finger=False)

    def test_another_start_or_goal(self):
        self.assert_frame_of_failure(0, "start-differs", "--start", self.model("cube.goal.json"))
        last = len(self.plan["steps"])
        self.assert_frame_of_failure(last, "goal-not-reached", "--goal",
                                     self.model("cube.start.json"))


if __name__ == "__main__":
    program_case.main()
