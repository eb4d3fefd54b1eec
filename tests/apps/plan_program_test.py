"""The program plan from the shell: good, missing and illegal input."""

import json
import os
import re

import program_case
from program_case import ProgramCase


def contact_key(contact):
    return (contact["point"], contact["normal"])


class Plan(ProgramCase):
    program = "plan"

    def arguments(self, **changes):
        """A command line that works, with options changed or, where None, left out."""
        options = {
            "--object": self.model("cube.obj"),
            "--start": self.model("cube.start.json"),
            "--goal": self.model("cube.goal.json"),
            "--output": "plan.json",
            "--friction-angle": "20",
            "--contacts": "30",
        }
        options.update({"--" + key.replace("_", "-"): value for key, value in changes.items()})
        return [word for key, value in options.items() if value is not None
                for word in (key, value)]

    def refuse(self, words, code=2, **changes):
        return self.assert_refused(code, words, *self.arguments(**changes))

    def grasp(self, contacts):
        return {"format": "regrasp-grasp", "version": 1, "contacts": contacts}

    def start_contacts(self):
        with open(self.model("cube.start.json"), encoding="utf-8") as file:
            return json.load(file)["contacts"]

    # What works.

    def test_plans_on_every_model(self):
        names = sorted(name[:-len(".start.json")] for name in os.listdir(self.model(""))
                       if name.endswith(".start.json") and
                       os.path.exists(self.model(name[:-len(".start.json")] + ".obj")))
        self.assertGreaterEqual(len(names), 7, names)
        for name in names:
            with self.subTest(model=name):
                self.assert_done(*self.arguments(
                    object=self.model(name + ".obj"), start=self.model(name + ".start.json"),
                    goal=self.model(name + ".goal.json"), contacts=None))
                plan = json.loads(self.read("plan.json"))
                self.assertEqual(plan["format"], "regrasp-plan")
                self.assertEqual(plan["planner"], "roadmap")
                self.assertEqual(plan["fingers"], 5)
                self.assertGreater(len(plan["steps"]), 0)

    def test_steps_lead_from_the_start_to_the_goal(self):
        self.assert_done(*self.arguments())
        plan = json.loads(self.read("plan.json"))
        holding = {c["finger"]: contact_key(c) for c in plan["initial"]["contacts"]}
        self.assertEqual(sorted(holding), [0, 1, 2, 3])
        for step in plan["steps"]:
            self.assertEqual(step["kind"], "switch")
            for contact in step["place"]:
                self.assertNotIn(contact["finger"], holding)
                holding[contact["finger"]] = contact_key(contact)
            self.assertLessEqual(len(holding), 5)
            for finger in step["release"]:
                del holding[finger]
            self.assertEqual(len(holding), 4)
        self.assertEqual(sorted(holding.values()),
                         sorted(contact_key(c) for c in plan["goal"]["contacts"]))

    def test_summary_goes_to_standard_error_and_quiet_is_silent(self):
        done = self.assert_done(*self.arguments())
        self.assertIn("switches; the weakest grasp needs", done.stderr)
        self.assertEqual(done.stdout, "")
        quiet = self.assert_done(*self.arguments(), "--quiet")
        self.assertEqual(quiet.stderr + quiet.stdout, "")

    def test_dash_writes_the_plan_to_standard_output(self):
        self.assert_done(*self.arguments())
        done = self.assert_done(*self.arguments(output="-"))
        self.assertEqual(done.stdout.encode(), self.read("plan.json"))

    def test_mu_is_the_tangent_of_the_half_angle(self):
        self.assert_done(*self.arguments(friction_angle=None, mu="0.5"))
        angle = json.loads(self.read("plan.json"))["friction"]["half_angle_deg"]
        self.assertAlmostEqual(angle, 26.56505117707799, places=12)

    def test_scale_goes_into_the_plan(self):
        self.assert_done(*self.arguments(scale="0.001"))
        self.assertEqual(json.loads(self.read("plan.json"))["object"]["scale"], 0.001)

    def test_same_seed_gives_the_same_bytes(self):
        plans = []
        for seed in ("5", "5", "6"):
            self.assert_done(*self.arguments(start="random-any", goal="random", planner="roadmap",
                                             seed=seed))
            plans.append(self.read("plan.json"))
        self.assertEqual(plans[0], plans[1])
        self.assertNotEqual(plans[0], plans[2])

    def test_locale_changes_nothing(self):
        self.assert_done(*self.arguments(friction_angle="20.5"))
        plain = self.read("plan.json")
        self.assert_done(*self.arguments(friction_angle="20.5"),
                         environment={"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"})
        self.assertEqual(self.read("plan.json"), plain)

    def test_start_equal_to_goal_gives_no_steps(self):
        contacts = self.start_contacts()
        goal = self.write_json("goal.json", self.grasp(contacts[::-1]))
        self.assert_done(*self.arguments(goal=goal))
        self.assertEqual(json.loads(self.read("plan.json"))["steps"], [])

    def test_random_any_plans_at_several_seeds(self):
        for seed in range(5):
            with self.subTest(seed=seed):
                self.assert_done(*self.arguments(start="random-any", goal="random-any",
                                                 seed=str(seed)))

    def test_random_under_auto_is_random_any(self):
        self.assert_done(*self.arguments(start="random", goal="random", seed="3"))
        under_auto = self.read("plan.json")
        self.assert_done(*self.arguments(start="random-any", goal="random-any", seed="3"))
        self.assertEqual(self.read("plan.json"), under_auto)
        self.assert_done(*self.arguments(start="random", goal="random", seed="3",
                                         planner="roadmap"))
        self.assertNotEqual(self.read("plan.json"), under_auto)

    def test_start_just_off_the_surface_is_projected(self):
        contacts = self.start_contacts()
        contacts[0]["point"][0] += 5e-8
        start = self.write_json("start.json", self.grasp(contacts))
        self.assert_done(*self.arguments(start=start))
        self.assertEqual(json.loads(self.read("plan.json"))["initial"]["contacts"][0]["point"][0],
                         0.03)

    def test_warns_of_grasps_below_the_quality_asked_for(self):
        done = self.assert_done(*self.arguments(min_quality="0.5"), "--quiet")
        self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("plan: warning: "), done.stderr)
        self.assertIn("step", done.stderr)

    def test_help_and_version_go_to_standard_output(self):
        for option, word in (("--help", "--min-quality"), ("--version", "plan 0.")):
            done = self.assert_done(option)
            self.assertIn(word, done.stdout)
            self.assertEqual(done.stderr, "")

    # Negative answers.

    def test_no_sequence_is_a_negative_answer_that_says_what_was_searched(self):
        # Two pairs whose torques cancel, so that hardly any friction holds and no contact can leave
        # unless another takes its very line of force.
        def pinwheel(first, second):
            contacts = []
            for axis, other in ((first, second), (second, first)):
                for side in (-1, 1):
                    point, normal = [0, 0, 0], [0, 0, 0]
                    point[axis], point[other], normal[axis] = side * 0.03, side * 0.02, -side
                    contacts.append({"point": point, "normal": normal})
            return self.grasp(contacts)
        grasps = {"start": self.write_json("start.json", pinwheel(0, 1)),
                  "goal": self.write_json("goal.json", pinwheel(1, 2))}
        said = self.refuse(["no sequence", "12 contact points", "495 subsets of four"],
                           code=1, friction_angle="2", contacts="4", **grasps).stderr
        sizes = re.search(r"subsets of four, (\d+) force-closure grasps; the start's component "
                          r"has (\d+) of them, the goal's (\d+)$", said)
        self.assertTrue(sizes, said)
        grasp_count, start_size, goal_size = map(int, sizes.groups())
        self.assertGreater(min(start_size, goal_size), 0)
        self.assertLessEqual(start_size + goal_size, grasp_count)
        self.assert_done(*self.arguments(**grasps))

    def test_a_random_grasp_better_than_all_is_a_negative_answer(self):
        self.refuse("--start random-any: none of", code=1, start="random-any", min_quality="0.9")

    # Bad usage.

    def test_refuses_missing_and_unknown_options(self):
        for option in ("object", "start", "goal", "output"):
            self.refuse("--" + option, **{option: None})
        self.refuse("--no-such", no_such="1")
        self.assert_refused(2, "stray", *self.arguments(), "stray")

    def test_refuses_no_friction_and_two(self):
        self.refuse("friction is missing", friction_angle=None)
        self.refuse("exclude each other", mu="0.3")

    def test_refuses_numbers_that_are_none_or_out_of_range(self):
        cases = {
            "friction_angle": ("0", "90", "-5", "nan", "inf", "20x", "", "1e999", "2,5", "1e-323"),
            "seed": ("-1", "1.5", "18446744073709551616", "x"),
            "contacts": ("3", "201", "4.5", "-60"),
            "min_quality": ("-0.1", "nan", "inf"),
            "scale": ("0", "-1", "nan", "inf"),
        }
        for option, values in cases.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.refuse("--" + option.replace("_", "-"), **{option: value})
        for value in ("0", "-1", "nan", "1e300", "1e-400"):
            with self.subTest(mu=value):
                self.refuse("--mu", friction_angle=None, mu=value)

    def test_refuses_an_option_given_twice(self):
        self.assert_refused(2, "--seed", *self.arguments(seed="1"), "--seed", "2")

    def test_refuses_planners_that_do_not_exist(self):
        for planner in ("polygon", "contour", "polyhedron", "general", "none", ""):
            self.refuse("planner", planner=planner)
        self.refuse("--spanning", spanning="neither")

    # Bad input.

    def test_refuses_a_start_that_is_not_force_closure_and_names_the_angle(self):
        # Two pairs across x whose lines lean by atan(0.024 / 0.06) = 21.80°.
        contacts = [{"point": [side * 0.03, y, side * 0.012], "normal": [-side, 0, 0]}
                    for side in (-1, 1) for y in (-0.01, 0.01)]
        start = self.write_json("start.json", self.grasp(contacts))
        self.refuse([start, "needs a friction half-angle of 21.81°, given 20°"], start=start)
        self.assert_done(*self.arguments(start=start, friction_angle="21.81"))

    def test_refuses_a_start_of_three_or_five_contacts(self):
        contacts = self.start_contacts()
        fewer = self.write_json("fewer.json", self.grasp(contacts[:3]))
        self.refuse([fewer, "needs 4 contacts, found 3"], start=fewer)
        extra = {"point": [0.03, -0.02, 0.0], "normal": [-1, 0, 0]}
        more = self.write_json("more.json", self.grasp(contacts + [extra]))
        self.refuse([more, "needs 4 contacts, found 5"], goal=more)

    def test_refuses_two_contacts_at_one_point(self):
        contacts = self.start_contacts()
        start = self.write_json("start.json", self.grasp(contacts[:3] + contacts[2:3]))
        self.refuse([start, "contacts 2 and 3 are at the same point"], start=start)

    def test_refuses_a_start_off_the_surface(self):
        contacts = self.start_contacts()
        contacts[0]["point"][0] += 1e-5
        start = self.write_json("start.json", self.grasp(contacts))
        self.refuse(start, start=start)

    def test_refuses_files_that_are_missing_or_garbage(self):
        garbage = [self.write("empty", b""), self.write("binary", bytes(range(256))),
                   self.path("missing"), self.folder, self.write("deep", "[" * 100000)]
        for name in garbage:
            for option in ("object", "start", "goal"):
                with self.subTest(option=option, name=name):
                    self.refuse(name, **{option: name})

    def test_refuses_a_planar_object(self):
        square = self.write("square.wkt", "POLYGON((0 0, 1 0, 1 1, 0 1, 0 0))")
        self.refuse([square, "planar"], object=square)

    # The environment.

    def test_an_output_that_cannot_be_written_is_the_environments_fault(self):
        self.refuse("missing/plan.json", code=3, output="missing/plan.json")
        os.mkdir(self.path("folder"))
        self.refuse("folder", code=3, output="folder")

    def test_a_full_disk_behind_standard_output_is_the_environments_fault(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = self.run_program(*self.arguments(output="-"), "--quiet", stdout=full)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr, "plan: standard output cannot be written\n")


if __name__ == "__main__":
    program_case.main()
