"""Images of failed plans by validate: a frame for every reason, and the overview image."""

import copy
import json
import os

import program_case
from picture_pixels import count, is_red, png_pixels
from program_case import ProgramCase

SIZE = (320, 240)
EMPTY_CELL = (238, 240, 244)

# No reason, and reasons of plans for a hand, whose frames gait_program_test.py tests.
OF_HANDS = (None, "hand-jumps", "tip-off-contact", "joint-limit", "hand-collides",
            "torque-limit", "coupling-violated", "tip-penetrates", "not-static")


class FailingFrames(ProgramCase):
    program = "validate"

    # Failures by the object, the friction or the engine, without a finger at fault.
    WITHOUT_FINGER = ("not-proved", "simulation-unstable", "object-moved")

    def setUp(self):
        super().setUp()
        self.plan = self.plan_of_cube()

    def arguments(self, *more):
        self.write_json("plan.json", self.plan)
        return ["--object", self.model("cube.obj"), "--plan", "plan.json", "--output", "result",
                "--size", "x".join(map(str, SIZE)), *more]

    def assert_frame_of_failure(self, index, reason, *more, finger=True):
        """Expect a frame of the failed step, with red if a finger is at fault.

        Later steps have no frames.
        """
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
        """Make a plan of the initial grasp, and a sliding step of all its fingers by 0.5 mm."""
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

    def test_the_sheet_has_one_grey_cell_for_all_steps_that_were_not_replayed(self):
        contact = self.plan["steps"][0]["place"][0]
        contact["point"] = [p - 0.004 * n for p, n in zip(contact["point"], contact["normal"])]
        steps, _ = self.assert_frame_of_failure(1, "off-surface")
        sheet = png_pixels(self.read("result/overview.png"))
        columns = 2
        self.assertEqual(len(steps), 5)
        cell = (len(sheet[0]) / columns) ** 2 * SIZE[1] / SIZE[0]
        grey = count(sheet, lambda pixel: pixel == EMPTY_CELL) / cell
        self.assertGreater(grey, 0.8)
        self.assertLess(grey, 1)

    def test_a_contact_off_the_surface_near_or_far(self):
        place = copy.deepcopy(self.plan["steps"][1]["place"][0])
        for away in (1e-4, 0.004, -0.004, 4000, 1e9):
            contact = self.plan["steps"][1]["place"][0]
            contact["point"] = [p - away * n for p, n in zip(place["point"], place["normal"])]
            self.assert_frame_of_failure(2, "off-surface")

    # Each function breaks the plan for one reason, and returns the failing entry and the options.

    def break_off_point(self):
        self.plan["contacts"] = "given"  # the corners of the cube, without contacts
        return 0, ()

    def break_off_surface(self):
        contact = self.plan["steps"][1]["place"][0]
        contact["point"] = [p - 0.004 * n for p, n in zip(contact["point"], contact["normal"])]
        return 2, ()

    def break_wrong_normal(self):
        contact = self.plan["initial"]["contacts"][0]
        contact["normal"] = [-n for n in contact["normal"]]
        return 0, ()

    def break_finger_not_free(self):
        step = self.plan["steps"][0]
        step["place"][0]["finger"] = step["release"][0]
        return 1, ()

    def break_finger_not_holding(self):
        holding = {contact["finger"] for contact in self.plan["initial"]["contacts"]}
        self.plan["steps"][0].update(place=[], release=sorted({0, 1, 2, 3, 4} - holding))
        return 1, ()

    def break_too_many_fingers(self):
        self.plan["steps"][0]["place"][0]["finger"] = 7
        return 1, ()

    def break_coincident_fingers(self):
        contacts = self.plan["initial"]["contacts"]
        step = self.plan["steps"][0]
        held, left = contacts[0], contacts[1]["finger"]
        step["place"][0].update(point=held["point"], normal=held["normal"])
        step["release"] = [left]
        return 1, ()

    def break_discontinuous(self):
        waypoints = self.make_align()
        waypoints[0][0]["point"] = waypoints[1][0]["point"]
        return 1, ()

    def break_leaves_face(self):
        waypoints = self.make_align()
        other = waypoints[1][1]
        axis = next(i for i in range(3) if abs(other["normal"][i]) < 0.5)
        waypoints[1][0].update(point=list(other["point"]), normal=other["normal"])
        waypoints[1][0]["point"][axis] += 0.005
        return 1, ()

    def break_not_force_closure(self):
        return 0, ("--friction-angle", "5")

    def break_not_proved(self):
        self.plan.update(program_case.align_past_a_finger())
        return 1, ()

    def break_unreachable(self):
        return 1, ("--finger-radius", "0.06")

    def break_simulation_unstable(self):
        return 0, ("--grasp-force", "100", "--disturbance", "1e30", "--tolerance", "1e32")

    def break_contact_lost(self):
        return 0, ("--grasp-force", "3", "--mu", "0.36")

    def break_slipped(self):
        return 0, ("--tolerance", "1e-12")

    def break_object_moved(self):
        return 1, ("--grasp-force", "20", "--tolerance", "1e-6")

    def break_start_differs(self):
        return 0, ("--start", self.model("cube.goal.json"))

    def break_goal_not_reached(self):
        return len(self.plan["steps"]), ("--goal", self.model("cube.start.json"))

    def test_each_reason_of_the_report_has_its_frame_with_the_finger_at_fault_in_red(self):
        with open(os.path.join(program_case.ARGUMENTS.source, "docs", "report.schema.json"),
                  encoding="utf-8") as file:
            reasons = json.load(file)["$defs"]["step"]["properties"]["reason"]["enum"]
        reasons = [reason for reason in reasons if reason not in OF_HANDS]
        self.assertEqual(len(reasons), 18)
        whole = copy.deepcopy(self.plan)
        for reason in reasons:
            with self.subTest(reason=reason):
                self.plan = copy.deepcopy(whole)
                index, more = getattr(self, "break_" + reason.replace("-", "_"))()
                self.assert_frame_of_failure(index, reason, *more,
                                             finger=reason not in self.WITHOUT_FINGER)

    def test_a_normal_of_another_length_or_none_at_all(self):
        contact = self.plan["initial"]["contacts"][0]
        normal = contact["normal"]
        for length in (0, 1e-3, 2):
            contact["normal"] = [length * n for n in normal]
            self.assert_frame_of_failure(0, "wrong-normal")

    def test_a_finger_that_is_missing_in_a_waypoint_is_in_the_frame(self):
        waypoints = self.make_align()
        self.assert_done(*self.arguments())
        waypoints[1].pop()
        self.assert_frame_of_failure(1, "discontinuous")


if __name__ == "__main__":
    program_case.main()
