"""The program plan from the shell: valid, missing and invalid input."""

import json
import math
import os
import re
import shutil

import jsonschema

import program_case
from program_case import ProgramCase


def contact_key(contact):
    return (contact["point"], contact["normal"])


class Plan(ProgramCase):
    program = "plan"

    def arguments(self, **changes):
        """Return a valid command line with changed options; None removes an option."""
        options = {
            "--object": self.model("cube.obj"),
            "--start": self.model("cube.start.json"),
            "--goal": self.model("cube.goal.json"),
            "--output": "plan.json",
            "--friction-angle": "20",
            "--planner": "points=30",
        }
        options.update({"--" + key.replace("_", "-"): value for key, value in changes.items()})
        return [word for key, value in options.items() if value is not None
                for word in (key, value)]

    def refuse(self, words, code=2, **changes):
        return self.assert_refused(code, words, *self.arguments(**changes))

    def grasp(self, contacts):
        return {"format": "regrasp-grasp", "version": 1, "contacts": contacts}

    def polygon_arguments(self, **changes):
        """Return a valid command line for a polygon."""
        options = {"object": self.model("polygon15.wkt"), "planner": None,
                   "start": self.model("polygon15.start.json"),
                   "goal": self.model("polygon15.goal.json")}
        return self.arguments(**dict(options, **changes))

    def plan(self, arguments):
        """Run the program and return the plan, which must follow its schema."""
        self.assert_done(*arguments)
        plan = json.loads(self.read("plan.json"))
        schema = os.path.join(program_case.ARGUMENTS.source, "docs", "plan.schema.json")
        with open(schema, encoding="utf-8") as file:
            jsonschema.validate(plan, json.load(file))
        return plan

    def start_contacts(self):
        with open(self.model("cube.start.json"), encoding="utf-8") as file:
            return json.load(file)["contacts"]

    # Valid input.

    def test_plans_on_every_model(self):
        names = sorted(name[:-len(".start.json")] for name in os.listdir(self.model(""))
                       if name.endswith(".start.json") and
                       os.path.exists(self.model(name[:-len(".start.json")] + ".obj")))
        self.assertGreaterEqual(len(names), 7, names)
        for name in names:
            with self.subTest(model=name):
                self.assert_done(*self.arguments(
                    object=self.model(name + ".obj"), start=self.model(name + ".start.json"),
                    goal=self.model(name + ".goal.json"), planner=None))
                plan = json.loads(self.read("plan.json"))
                self.assertEqual(plan["format"], "regrasp-plan")
                self.assertEqual((plan["planner"], plan["fingers"]), ("general", 5))
                self.assertGreater(len(plan["steps"]), 0)

    def test_plans_on_every_polygon(self):
        names = sorted(name[:-len(".wkt")] for name in os.listdir(self.model(""))
                       if name.endswith(".wkt"))
        self.assertGreaterEqual(len(names), 9, names)
        for name in names:
            with self.subTest(model=name):
                plan = self.plan(self.polygon_arguments(
                    object=self.model(name + ".wkt"), start=self.model(name + ".start.json"),
                    goal=self.model(name + ".goal.json")))
                self.assertEqual((plan["planner"], plan["fingers"]), ("general", 4))
                self.assertEqual(plan["object"]["dimension"], 2)
                self.assertGreater(len(plan["steps"]), 0)

    def test_a_contour_is_planned_with_three_fingers_one_of_them_spare(self):
        aligns, switches = 0, 0
        for optimize in ({}, {"optimize": "regions"}):
            for seed in range(4):
                plan = self.plan(self.polygon_arguments(
                    object=self.model("polygon40.wkt"), start="random", goal="random",
                    planner="contour", seed=str(seed), **optimize))
                self.assertEqual((plan["planner"], plan["fingers"]), ("contour", 3))
                for step in plan["steps"]:
                    if step["kind"] == "align":
                        aligns += 1
                        continue
                    switches += 1
                    self.assertEqual((len(step["place"]), len(step["release"])), (1, 1))
                    self.assertGreater(step["place"][0]["region"], 0)
        self.assertGreater(min(aligns, switches), 4)

    def test_optimized_regions_are_no_smaller(self):
        def regions(plan):
            return [step["place"][0]["region"] for step in plan["steps"]
                    if step["kind"] == "switch"]
        compared = 0
        for seed in range(6):
            free = self.plan(self.polygon_arguments(
                object=self.model("polygon40.wkt"), start="random", goal="random",
                planner="contour", seed=str(seed)))
            start = self.write_json("start.json", self.grasp(free["initial"]["contacts"]))
            goal = self.write_json("goal.json", self.grasp(free["goal"]["contacts"]))
            optimized = self.plan(self.polygon_arguments(
                object=self.model("polygon40.wkt"), start=start, goal=goal, planner="contour",
                optimize="regions"))
            self.assertEqual(len(regions(free)), len(regions(optimized)))
            for small, large in zip(regions(free), regions(optimized)):
                self.assertGreaterEqual(large, small * (1 - 1e-9))
                compared += 1
        self.assertGreater(compared, 5)

    def test_auto_and_polygon_join_what_contour_cannot(self):
        def pair(first, second):
            return self.write_json(f"{first[0]}.json", self.grasp([{"point": first},
                                                                   {"point": second}]))
        square = self.model("square.wkt")
        options = {"object": square, "start": pair([-0.03, 0], [0.03, 0]),
                   "goal": pair([0, -0.03], [0, 0.03])}
        for planner, taken in (("auto", "general"), ("polygon", "polygon")):
            plan = self.plan(self.polygon_arguments(planner=planner, **options))
            self.assertEqual(plan["planner"], taken)
        self.assert_refused(1, "no sequence of switches and sliding steps",
                            *self.polygon_arguments(planner="contour", **options))

    def test_fingers_of_a_polygon_hold_until_they_leave_and_never_are_more_than_four(self):
        aligns = 0
        for seed in range(5):
            plan = self.plan(self.polygon_arguments(start="random", goal="random",
                                                    planner="polygon", seed=str(seed)))
            holding = {c["finger"]: contact_key(c) for c in plan["initial"]["contacts"]}
            for step in plan["steps"]:
                if step["kind"] == "align":
                    first, *_, last = [{c["finger"]: contact_key(c) for c in waypoint["contacts"]}
                                       for waypoint in step["waypoints"]]
                    self.assertEqual(first, holding)
                    holding = last
                    aligns += 1
                    continue
                for contact in step["place"]:
                    self.assertNotIn(contact["finger"], holding)
                    holding[contact["finger"]] = contact_key(contact)
                self.assertLessEqual(len(holding), 4)
                self.assertLess(max(holding), 4)
                for finger in step["release"]:
                    del holding[finger]
            self.assertEqual(sorted(holding.values()),
                             sorted(contact_key(c) for c in plan["goal"]["contacts"]))
        self.assertGreater(aligns, 0)

    def test_the_same_seed_gives_the_same_bytes_on_a_polygon(self):
        plans = []
        for seed in ("1", "1", "2"):
            self.assert_done(*self.polygon_arguments(start="random-any", goal="random",
                                                     planner="polygon", seed=seed))
            plans.append(self.read("plan.json"))
        self.assertEqual(plans[0], plans[1])
        self.assertNotEqual(plans[0], plans[2])

    def test_summary_counts_switches_and_aligns(self):
        done = self.assert_done(*self.polygon_arguments())
        steps = [step["kind"] for step in json.loads(self.read("plan.json"))["steps"]]
        counted = dict(reversed(found) for found in
                       re.findall(r"(\d+) (switch|align)(?:es|s)?[,;] ", done.stderr))
        self.assertEqual({kind: int(count) for kind, count in counted.items()},
                         {kind: steps.count(kind) for kind in set(steps)})

    def test_tells_the_margin_that_validate_tells(self):
        weakest = []
        for model, arguments in (("cube.obj", self.arguments(planner=None)),
                                 ("stone.obj", self.arguments(
                                     object=self.model("stone.obj"), planner=None,
                                     start=self.model("stone.start.json"),
                                     goal=self.model("stone.goal.json"))),
                                 ("polygon15.wkt", self.polygon_arguments(planner="polygon"))):
            with self.subTest(model=model):
                said = self.assert_done(*arguments).stderr
                told = re.search(r"weakest: (step (\d+) \((\w+)\), which requires a friction "
                                 r"angle of (\S+) of 20\.00 degrees); ", said)
                checked = self.assert_done(
                    "--object", self.model(model), "--plan", "plan.json", "--output", "result",
                    "--frames", "none", program="validate").stdout
                self.assertIn(f"weakest: {told[1]}\n", checked)
                margin = self.report()["margins"]["friction"]
                self.assertEqual((margin["step"], f"{math.ceil(100 * margin['required_half_angle_deg'] - 1e-4) / 100:.2f}"),
                                 (int(told[2]), told[4]))
                weakest.append(told[3])
        # An analysis of static grasps alone would give a different value.
        self.assertGreaterEqual(weakest.count("align"), 2)

    def test_uniform_spanning_leaves_grasps_out_that_adaptive_has(self):
        # The normals of this triangle span for cones with a friction angle below 30°. At 35°, no
        # two fingers of the rotated grasps are force closure.
        def turned(share):
            corners = [(-1, 0), (1, 0), (0, 3 ** 0.5)]
            contacts = []
            for (ax, ay), (bx, by) in zip(corners, corners[1:] + corners[:1]):
                contacts.append({"point": [ax + share * (bx - ax), ay + share * (by - ay)]})
            return self.write_json(f"{share}.json", self.grasp(contacts))
        triangle = self.write("triangle.wkt", "POLYGON((-1 0, 1 0, 0 1.7320508075688772, -1 0))")
        options = {"object": triangle, "start": turned(0.4), "goal": turned(0.6),
                   "friction_angle": "35"}
        steps = [[step["kind"] for step in self.plan(self.polygon_arguments(
            planner="spanning=" + spanning, **options))["steps"]] for spanning in ("adaptive", "uniform")]
        self.assertEqual(steps[0], ["align"])
        self.assertEqual((steps[1][0], steps[1][-1]), ("switch", "switch"))

    def test_a_grasp_in_no_set_of_the_polygon_is_a_negative_answer(self):
        # Two pairs whose torques cancel; each pair alone is inclined by atan(2 / 6).
        start = self.write_json("start.json", self.grasp(
            [{"point": [-0.03, 0.01]}, {"point": [0.03, -0.01]},
             {"point": [0.01, -0.03]}, {"point": [-0.01, 0.03]}]))
        said = self.assert_refused(1, "in none of the", *self.polygon_arguments(
            object=self.model("square.wkt"), goal=self.model("square.goal.json"), start=start,
            friction_angle="5", planner="polygon")).stderr
        self.assertIn(start, said)

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
        self.assertIn("switches; weakest: step ", done.stderr)
        self.assertNotIn("0 aligns", done.stderr)
        self.assertEqual(done.stdout, "")
        quiet = self.assert_done(*self.arguments(), "--quiet")
        self.assertEqual(quiet.stderr + quiet.stdout, "")

    def test_a_terminal_is_told_what_is_done_from_the_first_moment(self):
        shutil.copy(self.model("cube.obj"), self.path("cu\u202ebe.obj"))
        arguments = self.arguments(object=self.path("cu\u202ebe.obj"))
        done, shown = self.run_on_terminal(*arguments)
        self.assertEqual(done.returncode, 0, shown)
        self.assert_stages(shown, "reading ", "checking 6 facets", "preparing 6 faces")
        self.assertIn("cu\\u202ebe.obj", shown)
        self.assertNotIn("\u202e", shown)
        self.assertEqual(self.run_on_terminal(*arguments, "--quiet")[1], "")

    def test_says_how_large_and_heavy_the_object_is_and_warns_of_what_no_hand_holds(self):
        done = self.assert_done(*self.arguments())
        self.assertIn("plan: cube.obj: 10.4 cm across, 216 g at the density of water\n",
                      done.stderr)
        self.assertNotIn("warning", done.stderr)
        for scale, size in (("1000", "104 m across, 2.16e+08 kg"), ("0.01", "1.04 mm across")):
            done = self.assert_done(*self.arguments(scale=scale), "--quiet")
            self.assertRegex(done.stderr, f"^plan: warning: the object is {re.escape(size)}.*"
                                          r"metres, pass --scale 1 \(10.4 cm across\)$")
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_warns_of_a_coefficient_of_friction_that_is_an_angle(self):
        done = self.assert_done(*self.arguments(friction_angle=None, mu="20"), "--quiet")
        self.assertIn("plan: warning: --mu 20: implausible friction coefficient", done.stderr)
        for usual in ({"friction_angle": None, "mu": "3"}, {"friction_angle": "80"}):
            self.assertEqual(self.assert_done(*self.arguments(**usual), "--quiet").stderr, "")

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
            self.assert_done(*self.arguments(start="random-any", goal="random", planner="roadmap,points=30",
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
                                         planner="roadmap,points=30"))
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

    # Negative results.

    def test_no_sequence_is_a_negative_answer_that_says_what_was_searched(self):
        # Two pairs whose torques cancel, so that little friction suffices and a contact can only
        # leave if another one takes its line of force.
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
                           code=1, friction_angle="2", planner="points=4", **grasps).stderr
        sizes = re.search(r"subsets of four, (\d+) force-closure grasps; the start's component "
                          r"has (\d+) of them, the goal's (\d+)$", said)
        self.assertTrue(sizes, said)
        grasp_count, start_size, goal_size = map(int, sizes.groups())
        self.assertGreater(min(start_size, goal_size), 0)
        self.assertLessEqual(start_size + goal_size, grasp_count)
        self.assert_done(*self.arguments(**grasps))

    def test_a_random_grasp_better_than_all_is_a_negative_answer(self):
        self.refuse("--start random-any: none of", code=1, start="random-any", min_quality="0.9")

    def test_grasps_of_a_polygon_that_no_sequence_joins_are_a_negative_answer(self):
        # At 0.5° the graph of this polygon has several components.
        shape = self.model("polygon25.wkt")
        starts = []
        for seed in range(20):
            plan = self.plan(self.polygon_arguments(
                object=shape, start="random", goal="random", planner="polygon",
                friction_angle="0.5", min_quality="0", seed=str(seed)))
            contacts = [{"point": c["point"], "normal": c["normal"]}
                        for c in plan["initial"]["contacts"]]
            starts.append(self.write_json(f"{seed}.json", self.grasp(contacts)))
        os.remove(self.path("plan.json"))
        refused = 0
        for start, goal in zip(starts, starts[1:]):
            command = self.polygon_arguments(object=shape, start=start, goal=goal,
                                             planner="polygon", friction_angle="0.5", output="-")
            if self.run_program(*command).returncode == 0:
                continue
            said = self.assert_refused(1, "no sequence of switches and sliding steps", *command).stderr
            sizes = re.search(r"of (\d+) sets .* the start's component has (\d+), "
                              r"the goal's (\d+)$", said)
            self.assertTrue(sizes, said)
            total, start_size, goal_size = map(int, sizes.groups())
            self.assertGreater(min(start_size, goal_size), 0)
            self.assertLessEqual(start_size + goal_size, total)
            refused += 1
        self.assertGreater(refused, 0)
        self.assertLess(refused, len(starts) - 1)

    # Invalid usage.

    def test_refuses_missing_and_unknown_options(self):
        for option in ("object", "start", "goal", "output"):
            self.refuse("--" + option, **{option: None})
        self.refuse("--no-such", no_such="1")
        self.assert_refused(2, "stray", *self.arguments(), "stray")

    def test_refuses_no_friction_and_two(self):
        self.refuse("friction: --friction-angle DEG or --mu X is required", friction_angle=None)
        self.refuse("--friction-angle: cannot be used with --mu", mu="0.3")

    def test_refuses_numbers_that_are_none_or_out_of_range(self):
        cases = {
            "friction_angle": ("0", "90", "-5", "nan", "inf", "20x", "", "1e999", "2,5", "1e-323"),
            "seed": ("-1", "1.5", "18446744073709551616", "x"),
            "min_quality": ("-0.1", "nan", "inf"),
            "scale": ("0", "-1", "nan", "inf"),
        }
        for option, values in cases.items():
            for value in values:
                with self.subTest(option=option, value=value):
                    self.refuse("--" + option.replace("_", "-"), **{option: value})
        for setting, values in (("points", ("3", "4001", "4.5", "-60")), ("clusters", ("3", "201", "4.5"))):
            for value in values:
                with self.subTest(setting=setting, value=value):
                    self.refuse(f"--planner {setting}", planner=f"{setting}={value}")
        for value in ("0", "-1", "nan", "1e300", "1e-400"):
            with self.subTest(mu=value):
                self.refuse("--mu", friction_angle=None, mu=value)

    def test_refuses_an_option_given_twice(self):
        self.assert_refused(2, "--seed", *self.arguments(seed="1"), "--seed", "2")

    def test_refuses_planners_that_do_not_exist(self):
        for planner in ("generals", "none", ""):
            self.refuse("planner", planner=planner)
        self.refuse("--planner spanning", planner="spanning=neither")

    # Invalid input.

    def test_refuses_a_start_that_is_not_force_closure_and_names_the_angle(self):
        # Two pairs across x whose lines are inclined by atan(0.024 / 0.06) = 21.80°.
        contacts = [{"point": [side * 0.03, y, side * 0.012], "normal": [-side, 0, 0]}
                    for side in (-1, 1) for y in (-0.01, 0.01)]
        start = self.write_json("start.json", self.grasp(contacts))
        self.refuse([start, "requires a friction angle of 21.81°, found 20.00°"], start=start)
        self.assert_done(*self.arguments(start=start, friction_angle="21.81"))

    def test_refuses_a_start_of_three_or_five_contacts(self):
        contacts = self.start_contacts()
        fewer = self.write_json("fewer.json", self.grasp(contacts[:3]))
        self.refuse([fewer, "requires 4 contacts, found 3"], start=fewer)
        extra = {"point": [0.03, -0.02, 0.0], "normal": [-1, 0, 0]}
        more = self.write_json("more.json", self.grasp(contacts + [extra]))
        self.refuse([more, "requires 4 contacts, found 5"], goal=more)

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

    def test_refuses_a_solid_for_the_polygon_and_a_polygon_for_the_roadmap(self):
        self.refuse([self.model("cube.obj"), "a solid"], planner="polygon")
        self.refuse([self.model("cube.obj"), "a solid", "contour"], planner="contour")
        self.assert_refused(2, [self.model("polygon15.wkt"), "planar"],
                            *self.polygon_arguments(planner="roadmap"))

    def test_auto_takes_the_planner_that_has_the_option(self):
        for model, options, planner in (("bottle200", {"optimize": "regions"}, "contour"),
                                        ("polygon15", {"spanning": "uniform"}, "polygon"),
                                        ("polygon15", {"optimize": "travel"}, "general")):
            with self.subTest(options=options):
                plan = self.plan(self.polygon_arguments(
                    object=self.model(model + ".wkt"), start=self.model(model + ".start.json"),
                    goal=self.model(model + ".goal.json"), **options))
                self.assertEqual(plan["planner"], planner)
        self.assert_refused(2, ["--optimize regions (contour)", "--explain (general)"],
                            *self.polygon_arguments(optimize="regions"), "--explain")

    def test_refuses_an_option_that_the_planner_does_not_have_and_names_one_that_does(self):
        for option, planner, other in ((("--planner", "budget=5"), "polygon", "general"),
                                       (("--planner", "fallback=no",), "polyhedron", "roadmap"),
                                       (("--planner", "points=40"), "general", "roadmap"),
                                       (("--planner", "spanning=uniform"), "roadmap", "polyhedron")):
            with self.subTest(option=option):
                arguments = (self.polygon_arguments if planner == "polygon" else self.arguments)
                given = arguments(planner=planner, **({} if planner == "polygon" else
                                                      {"contacts": None}))
                self.assert_refused(2, [option[0], "planner " + planner, other], *given, *option)

    def test_refuses_to_optimize_regions_that_a_planner_does_not_have(self):
        for planner, arguments in (("polygon", self.polygon_arguments),
                                   ("roadmap", self.arguments)):
            self.assert_refused(2, ["--optimize regions", planner],
                                *arguments(planner=planner, optimize="regions"))
        self.assert_refused(2, "--optimize", *self.polygon_arguments(optimize="colour"))

    def test_refuses_grasps_of_three_contacts_on_a_contour(self):
        self.assert_refused(2, ["contour", "found 3"], *self.polygon_arguments(planner="contour"))

    def test_refuses_grasps_that_do_not_serve_on_a_polygon(self):
        pair = [{"point": [-0.03, 0.01]}, {"point": [0.03, -0.01]}]
        def refuse(words, contacts):
            start = self.write_json("start.json", self.grasp(contacts))
            self.assert_refused(2, [start, words], *self.polygon_arguments(
                object=self.model("square.wkt"), start=start,
                goal=self.model("square.goal.json"), friction_angle="10"))
        # The inclination is atan(2 / 6) = 18.43°.
        refuse("requires a friction angle of 18.44°, found 10.00°", pair)
        refuse("requires 2 to 4 contacts, found 1", pair[:1])
        refuse("requires 2 to 4 contacts, found 5",
               [{"point": [x, 0.03]} for x in (-0.02, -0.01, 0, 0.01, 0.02)])
        refuse("contacts 0 and 2 are at the same point", pair + pair[:1])
        refuse("/contacts/0/point", [{"point": [-0.03, 0.01, 0]}] + pair[1:])

    # Environment.

    def test_an_output_that_cannot_be_written_is_the_environments_fault(self):
        self.refuse("missing/plan.json", code=3, output="missing/plan.json")
        os.mkdir(self.path("folder"))
        self.refuse("folder", code=3, output="folder")

    def test_a_full_disk_behind_standard_output_is_the_environments_fault(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = self.run_program(*self.arguments(output="-"), "--quiet", stdout=full)
        self.assertEqual(done.returncode, 3)
        self.assertEqual(done.stderr, "plan: error: standard output cannot be written\n")


if __name__ == "__main__":
    program_case.main()
