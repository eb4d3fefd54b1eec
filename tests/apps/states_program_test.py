"""validate --export-states: states in which a hand holds an object, as arrays."""

import math
import xml.etree.ElementTree

import program_case
from npz_file import read_npz
from program_case import ProgramCase

GRAVITY = 9.81
PER_STATE = {"joints": 20, "controls": 20, "qpos": 27, "object_position": 3,
             "object_quaternion": 4, "active": 5, "contact_points": 5, "contact_forces": 5}


class States(ProgramCase):
    program = "validate"

    def arguments(self, *more, scale="0.8333"):
        return ("--object", self.model("cube.obj"), "--scale", scale, "--hand",
                self.model("hands/ring5.json"), "--mu", "0.8", *more)

    def test_states_have_all_that_a_simulation_is_set_to(self):
        done = self.assert_done(*self.arguments(
            "--export-states", "6", "--seed", "3", "--output", "states", "--export-mjcf", "scene"))
        self.assertIn("stable, written  ", done.stdout)
        self.assertIn("confidence", done.stdout)
        states = read_npz(self.path("states/states.npz"))
        for name, width in PER_STATE.items():
            self.assertEqual([len(row) for row in states[name]], 6 * [width], name)
        self.assertEqual(states["joint_names"][:2], ["finger0_joint0", "finger0_joint1"])
        self.assertEqual(states["control_names"][:2], ["finger0_motor0", "finger0_motor1"])
        self.assertEqual(states["finger_names"], [f"finger{i}" for i in range(5)])
        self.assertEqual(states["format_version"], 2)
        self.assertEqual((states["object"], states["hand"]), ("cube.obj", "ring5.json"))
        self.assertAlmostEqual(states["mu"], 0.8)
        self.assertEqual((states["scale"], states["seed"], states["held_s"]), (0.8333, "3", 1))
        self.assertEqual((states["tolerance_m"], len(states["fallen"])), (1e-3, 9))
        self.assertAlmostEqual(states["gravity"][2], -GRAVITY)
        for state in range(6):
            self.check_state({name: states[name][state] for name in PER_STATE}, states)
            self.assertLess(states["off_m"][state], states["tolerance_m"])
            self.assertLess(states["off_rad"][state], states["tolerance_rad"])
        self.check_scene(states)

    def check_state(self, state, states):
        """Check the units: contacts are on the cube, and forces support its weight."""
        self.assertAlmostEqual(math.hypot(*state["object_quaternion"]), 1)
        self.assertGreaterEqual(sum(state["active"]), 3)
        half = 0.03 * states["scale"]  # half of the cube's edge
        total = [0, 0, 0]
        for active, point, force in zip(state["active"], state["contact_points"],
                                       state["contact_forces"]):
            self.assertEqual(active, not math.isnan(point[0]))
            self.assertEqual(active, not math.isnan(force[0]))
            if not active:
                continue
            self.assertAlmostEqual(max(map(abs, point)), half, places=6)
            total = [a + b for a, b in zip(total, force)]
        weight = GRAVITY * states["mass_kg"]
        self.assertAlmostEqual(math.hypot(*total), weight, delta=0.1 * weight)

    def check_scene(self, states):
        scene = xml.etree.ElementTree.parse(self.path("scene/scene.xml")).getroot()
        key = scene.find("keyframe/key")
        self.assertEqual(key.get("name"), "state 0")
        for name, numbers in (("qpos", states["qpos"][0]), ("ctrl", states["controls"][0])):
            self.assertEqual([float(x) for x in key.get(name).split()], numbers)

    def test_the_bytes_depend_on_the_seed_and_not_on_the_threads(self):
        for out, more in (("one", ("--jobs", "1")), ("two", ("--jobs", "2")),
                          ("other", ("--seed", "1"))):
            self.assert_done(*self.arguments("--export-states", "3", "--output", out, *more))
        self.assert_done(*self.arguments("--export-states", "2", "--output", "few"))
        self.assertEqual(self.read("one/states.npz"), self.read("two/states.npz"))
        self.assertNotEqual(self.read("one/states.npz"), self.read("other/states.npz"))
        few, one = (read_npz(self.path(f"{out}/states.npz")) for out in ("few", "one"))
        for name in ("qpos", "controls", "off_m"):
            self.assertEqual(few[name], one[name][:2], name)

    def test_what_cannot_be_held_ends_with_one_line(self):
        self.assert_refused(1, ["no states", "cube.obj", "random grasps"],
                            *self.arguments("--export-states", "2", scale="10"))
        self.assert_refused(1, ["no states", "1000", "support the weight"],
                            *self.arguments("--export-states", "2", "--mass", "50"))

    def test_bad_usage_is_told(self):
        states = ("--export-states", "2")
        for more, words in ((("--export-states", "0"), "--export-states"),
                            (("--export-states", "x"), "--export-states"),
                            ((*states, "--trials", "2"), "--trials: cannot be used with"),
                            ((*states, "--plan", "p.json"), "--plan: cannot be used with"),
                            ((*states, "--grasp-force", "realistic"), "--grasp-force realistic: cannot be used"),
                            (("--export-states", "min-quality=0.1"), "the number of states is required")):
            self.assert_refused(2, words, *self.arguments(*more))
        cube = ("--object", self.model("cube.obj"), "--mu", "0.8")
        self.assert_refused(2, "--export-states: requires --hand", *cube, *states)
        self.assert_refused(2, "planar object", "--object", self.model("square.wkt"), "--mu", "0.8",
                            "--hand", self.model("hands/ring5.json"), *states)
        self.assert_refused(2, "friction", *cube[:2], "--hand", self.model("hands/ring5.json"),
                            *states)
        self.assert_refused(2, "--seed: requires --trials or --export-states", "--object",
                            self.model("cube.obj"), "--plan", "p.json", "--seed", "1")


if __name__ == "__main__":
    program_case.main()
