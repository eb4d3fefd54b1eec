"""Plans and their validation: agreement with the programs, and invalid arguments."""

import json
import pickle
import os
import shutil
import signal
import subprocess
import threading
import unittest

import numpy as np

import regrasp
from regrasp_case import PROGRAMS, RegraspCase

START = "models/cube.start.json"
GOAL = "models/cube.goal.json"


def soft_pair(axis):
    """Return two opposite points of the cube."""
    points = np.zeros((2, 3))
    points[:, axis] = -0.03, 0.03
    return points


class PlansTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.cube = regrasp.Object.read("models/cube.obj")
        cls.plan = regrasp.plan(cls.cube, START, GOAL, friction_angle_deg=20)

    def test_the_plan_has_the_bytes_of_the_program(self):
        for model, arguments in [("cube.obj", {}), ("cube.obj", {"seed": 5, "optimize": "margin"}),
                                 ("gear128.wkt", {})]:
            ends = [f"models/{model.split('.')[0]}.{end}.json" for end in ("start", "goal")]
            options = [word for name, value in arguments.items()
                       for word in (f"--{name}", str(value))]
            program = subprocess.run(
                [f"{PROGRAMS}/plan", "--object", f"models/{model}", "--friction-angle", "20",
                 "--start", ends[0], "--goal", ends[1], "--quiet", "--output", "-", *options],
                capture_output=True, check=True, text=True)
            plan = regrasp.plan(regrasp.Object.read(f"models/{model}"), *ends,
                                friction_angle_deg=20, **arguments)
            self.assertEqual(plan.text, program.stdout)

    def test_the_report_says_what_the_program_says(self):
        self.plan.write(self.path("plan.json"))
        subprocess.run([f"{PROGRAMS}/validate", "--object", "models/cube.obj", "--plan",
                        self.path("plan.json"), "--output", self.path("out"), "--frames", "none",
                        "--quiet"], check=True)
        with open(self.path("out/report.json"), encoding="utf-8") as file:
            told = json.load(file)
        told.pop("run")
        self.assertEqual(regrasp.validate(self.cube, self.plan).data, told)

    def test_pickles_and_files_of_plans_and_reports(self):
        again = pickle.loads(pickle.dumps(self.plan))
        self.assertEqual((again.text, again.name, again.object.sha256), (self.plan.text, self.plan.name, self.cube.sha256))
        self.plan.write(self.path("plan.json"))
        read = regrasp.Plan.read(self.path("plan.json"), object=self.cube)
        self.assertIs(read.object, self.cube)
        self.refuses(["object", "Object"], lambda: regrasp.Plan.read(self.path("plan.json"), object="cube.obj"))
        report = regrasp.validate(self.cube, self.plan)
        report.write(self.path("new/report"), (160, 120))
        names = ["overview.png", "report.html", "report.json"] + [f"{i:03}.png" for i in range(len(report.steps))]
        self.assertEqual(sorted(os.listdir(self.path("new/report"))), sorted(names))
        with open(self.path("new/report/report.json"), encoding="utf-8") as file:
            self.assertEqual(file.read(), report.text)

    def test_a_plan_states_how_several_shells_were_read(self):
        with open("models/cube.obj", encoding="utf-8") as file:
            lines = file.read().splitlines()
        corners = [line.split()[1:] for line in lines if line.startswith("v ")]
        faces = [[int(word.split("/")[0]) for word in line.split()[1:]] for line in lines if line.startswith("f ")]
        text = ""
        for size, shift in ((1, 0), (0.5, 0.2)):
            text += "".join(f"v {size * float(x) + shift} {size * float(y)} {size * float(z)}\n" for x, y, z in corners)
        for first in (0, len(corners)):
            text += "".join("f " + " ".join(str(first + corner) for corner in face) + "\n" for face in faces)
        with open(self.path("two.obj"), "w", encoding="utf-8") as file:
            file.write(text)
        two = regrasp.Object.read(self.path("two.obj"), shells="largest")
        plan = regrasp.plan(two, START, GOAL, friction_angle_deg=20)
        self.assertEqual(plan.data["object"]["shells"], "largest")
        self.assertNotIn("shells", self.plan.data["object"])

    def test_a_plan_for_another_size_of_the_object_is_refused(self):
        small = regrasp.Object.read("models/cube.obj", scale=0.5)
        words = ["plan.json: /object/scale", "cube.obj", "expected 0.5", "found 1", "scale=1"]
        self.refuses(words, regrasp.validate, small, self.plan)
        self.refuses(words, self.plan.figure, small)
        # Positive control: a plan made at this scale passes with it, and only with it.
        plan = regrasp.plan(small, START, GOAL, friction_angle_deg=20)
        self.assertTrue(regrasp.validate(small, plan).passed)
        self.refuses(["expected 1 m", "found 0.5"], regrasp.validate, self.cube, plan)

    def test_grasps_as_arrays_are_those_of_the_file(self):
        def contacts(path):
            with open(path, encoding="utf-8") as file:
                grasp = json.load(file)["contacts"]
            return (np.array([c["point"] for c in grasp]), np.array([c["normal"] for c in grasp]))
        start, goal = contacts(START), contacts(GOAL)
        for given in [(start, goal), (start[0], goal[0])]:
            plan = regrasp.plan(self.cube, *given, friction_angle_deg=20)
            self.assertEqual(plan.text, self.plan.text)

    def test_two_soft_fingers_take_over_from_two(self):
        plan = regrasp.plan(self.cube, soft_pair(0), soft_pair(1), mu=0.5, torsion=0.01)
        self.assertEqual(plan.data["torsion"], 0.01)
        self.assertTrue(regrasp.validate(self.cube, plan).passed)
        self.assertFalse(regrasp.validate(self.cube, plan, torsion=0).passed)
        self.refuses(["found 2"], regrasp.plan, self.cube, soft_pair(0), soft_pair(1), mu=0.5)
        self.refuses(["torsion"], regrasp.plan, self.cube, soft_pair(0), soft_pair(1), mu=0.5,
                     torsion=-1)

    def test_the_second_engine_replays_and_both_are_compared(self):
        ode = regrasp.validate(self.cube, self.plan, engine="ode")
        self.assertTrue(ode.passed)
        self.assertEqual(ode.data["settings"]["engine"], "ode")
        both = regrasp.validate(self.cube, self.plan, engine="both")
        mujoco = regrasp.validate(self.cube, self.plan)
        self.assertEqual(both.data["settings"]["engine"], "both")
        self.assertNotIn("engines", mujoco.steps[0])
        for step, by_mujoco, by_ode in zip(both.steps, mujoco.steps, ode.steps, strict=True):
            self.assertIsNone(step["engines"]["cause"])
            self.assertEqual(step["simulation"], by_mujoco["simulation"])
            self.assertEqual(step["engines"]["ode"]["displacement_m"],
                             by_ode["simulation"]["displacement_m"])
            self.assertNotEqual(step["simulation"], by_ode["simulation"])

    def test_an_engine_that_is_none_is_refused(self):
        for wrong in ("dart", "", 1, ["ode"]):
            self.refuses(["engine", "mujoco", "ode", "both"], regrasp.validate, self.cube, self.plan,
                         engine=wrong)

    def test_soft_fingers_are_not_replayed_by_the_second_engine(self):
        plan = regrasp.plan(self.cube, soft_pair(0), soft_pair(1), mu=0.5, torsion=0.01)
        self.refuses(["engine ode", "soft-finger"], regrasp.validate, self.cube, plan, engine="ode")

    def test_a_plan_goes_through_its_file(self):
        self.plan.write(self.path("mine.json"))
        read = regrasp.Plan.read(self.path("mine.json"))
        self.assertEqual(read.text, self.plan.text)
        self.assertEqual(read.name, "mine.json")
        self.assertEqual(len(read), len(self.plan.steps))
        self.assertIn("cube.obj", repr(read))

    def test_a_plan_on_an_object_made_of_arrays(self):
        ball = np.array([[1., 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]])
        faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5],
                 [0, 3, 5]]
        body = regrasp.Object.from_arrays(ball, faces, scale=0.04, name="octahedron.obj")
        plan = regrasp.plan(body, "random", "random", mu=0.7, seed=1)
        self.assertEqual(plan.data["object"]["sha256"], body.sha256)
        body.write(self.path("octahedron.obj"))
        plan.write(self.path("plan.json"))
        done = subprocess.run([f"{PROGRAMS}/validate", "--object", self.path("octahedron.obj"),
                               "--plan", self.path("plan.json"), "--output", self.path("out"),
                               "--frames", "none", "--quiet"], check=False)
        self.assertEqual(done.returncode == 0, regrasp.validate(body, plan).passed)

    def test_a_plan_that_is_broken_fails_with_the_reason(self):
        report = regrasp.validate(self.cube, self.plan, mu=0.05)
        self.assertFalse(report.passed)
        self.assertEqual(report.steps[0]["reason"], "not-force-closure")
        self.assertIn("help: ", report.failure)
        self.assertIn("fail", str(report).lower())
        self.assertIn("hold", repr(report))

    def test_frames_are_the_pictures_of_the_program(self):
        self.plan.write(self.path("plan.json"))
        subprocess.run([f"{PROGRAMS}/validate", "--object", "models/cube.obj", "--plan",
                        self.path("plan.json"), "--output", self.path("out"), "--size", "320x240",
                        "--quiet"], check=True)
        report = regrasp.validate(self.cube, self.plan)
        frames = report.frames((320, 240))
        pictures = sorted(name for name in os.listdir(self.path("out")) if name[0].isdigit())
        self.assertEqual(len(frames), len(pictures))
        for frame, name in zip(frames, pictures):
            self.assertEqual((frame.shape, frame.dtype), ((240, 320, 3), np.uint8))
            with open(self.path(f"out/{name}"), "rb") as file:
                self.assertEqual(regrasp._regrasp.encode_png(frame), file.read())
        self.assertGreater(len(np.unique(report.overview((320, 240)))), 10)
        self.refuses(["size[0]", "from 48", "10"], report.frames, (10, 240))
        broken = regrasp.validate(self.cube, self.plan, mu=0.05)
        self.assertEqual(len(broken.frames((320, 240))), 1)

    def test_a_pickled_report_is_equal_and_draws_the_same(self):
        for arguments in ({}, {"mu": 0.05}, {"mass": 0.2, "resisted_wrench": True}):
            report = regrasp.validate(self.cube, self.plan, **arguments)
            again = pickle.loads(pickle.dumps(report))
            self.assertEqual(again, report)
            self.assertEqual(hash(again), hash(report))
            self.assertEqual((again.text, again.table, again.failure, again.passed, again.data),
                             (report.text, report.table, report.failure, report.passed, report.data))
            self.assertEqual(pickle.dumps(again), pickle.dumps(report))
            self.assertIsNone(again._made)  # no validation yet
            self.assertEqual(again.page(), report.page())
        self.assertNotEqual(again, regrasp.validate(self.cube, self.plan))
        self.assertNotEqual(again, again.text)

    def test_a_pickled_report_whose_inputs_changed_is_refused(self):
        shutil.copy("models/cube.obj", self.path("cube.obj"))
        cube = regrasp.Object.read(self.path("cube.obj"))
        report = regrasp.validate(cube, regrasp.plan(cube, START, GOAL, friction_angle_deg=20))
        kept = pickle.dumps(report)
        with open(self.path("cube.obj"), "a", encoding="utf-8") as file:
            file.write("# changed\n")
        with self.assertRaisesRegex(regrasp.InputError, "cube.obj: differs from the pickled object"):
            pickle.loads(kept)
        other = pickle.loads(pickle.dumps(regrasp.validate(self.cube, self.plan)))
        other.text += " "
        with self.assertRaisesRegex(regrasp.InputError, "differs from the pickled report"):
            other.page()

    def test_the_trajectory_has_the_states_of_the_replay(self):
        trajectory = regrasp.validate(self.cube, self.plan).trajectory
        count = len(trajectory.time_s)
        self.assertGreater(count, 10)
        self.assertTrue((np.diff(trajectory.time_s) > 0).all())
        self.assertEqual(trajectory.position_m.shape, (count, 3))
        self.assertEqual(trajectory.quaternion.shape, (count, 4))
        np.testing.assert_allclose(np.linalg.norm(trajectory.quaternion, axis=1), 1, atol=1e-12)
        np.testing.assert_allclose(trajectory.position_m, 0, atol=1e-4)  # point fingers hold the cube still
        np.testing.assert_allclose(np.abs(trajectory.quaternion[:, 0]), 1, atol=1e-4)
        self.assertEqual(trajectory.fingertips_m.shape, (count, 5, 3))
        self.assertIsNone(trajectory.joints)
        contacts = self.plan.data["initial"]["contacts"]
        for contact in contacts:
            tip = trajectory.fingertips_m[0, contact["finger"]]
            self.assertLess(np.linalg.norm(tip - contact["point"]), 0.02)
        # The fingers of the last grasp are at their contacts at the end.
        last = self.plan.data["steps"][-1]["place"]
        for contact in last:
            tip = trajectory.fingertips_m[-1, contact["finger"]]
            self.assertLess(np.linalg.norm(tip - contact["point"]), 0.02)
        self.assertGreater(len(contacts) * len(last), 0)
        self.refuses(["no trajectory"], lambda: regrasp.validate(self.cube, self.plan, mu=0.05).trajectory)

    def test_the_trajectory_of_a_hand_turns_the_object(self):
        hand = regrasp.Hand.read("models/hands/ring5.json")
        cube = regrasp.Object.read("models/cube.obj", scale=0.8)
        plan = regrasp.plan_in_hand(cube, hand, turn=("z", 30), mu=0.8)
        report = regrasp.validate(cube, plan, hand=hand)
        trajectory = report.trajectory
        count = len(trajectory.time_s)
        self.assertEqual(trajectory.joints.shape, (count, len(trajectory.joint_names)))
        self.assertEqual(trajectory.step[0], 0)
        self.assertEqual(trajectory.step[-1], len(plan) if report.passed else trajectory.step[-1])
        angle = 2 * np.degrees(np.arccos(np.clip(abs(np.dot(trajectory.quaternion[0], trajectory.quaternion[-1])), 0, 1)))
        self.assertAlmostEqual(angle, 30, delta=3)
        self.assertIsNone(trajectory.fingertips_m)
        self.assertEqual(pickle.loads(pickle.dumps(report)), report)

    def test_the_video_is_that_of_the_program(self):
        self.plan.write(self.path("plan.json"))
        report = regrasp.validate(self.cube, self.plan)
        report.video(self.path("replay.webp"), (160, 120))
        subprocess.run([f"{PROGRAMS}/validate", "--object", "models/cube.obj", "--plan", self.path("plan.json"),
                        "--output", self.path("out"), "--frames", "none", "--size", "animation=160x120", "--video",
                        self.path("program.webp"), "--quiet"], check=True)
        with open(self.path("replay.webp"), "rb") as file, open(self.path("program.webp"), "rb") as program:
            self.assertEqual(file.read(), program.read())
        self.refuses(["path", ".webp", "avi"], report.video, self.path("replay.avi"))
        self.refuses(["size[1]"], report.video, self.path("replay.gif"), (160, 1))
        with self.assertRaises(OSError):
            report.video(self.path("missing/replay.gif"), (160, 120))
        self.assertEqual(sorted(name for name in os.listdir(self.path("")) if name.startswith("replay")), ["replay.webp"])

    def test_a_notebook_shows_plans_and_reports(self):
        report = regrasp.validate(self.cube, self.plan)
        self.assertTrue(report._repr_png_().startswith(b"\x89PNG"))
        page = report._repr_html_()
        # The replay is a page of its own, whose markup cannot end the attribute.
        self.assertTrue(page.startswith('<iframe srcdoc="&lt;!DOCTYPE html&gt;'))
        self.assertNotIn("<script", page)
        self.assertNotIn('"', page.split('srcdoc="')[1].split('" title=')[0])
        self.assertIn("required_deg", page)
        below = page.split("</iframe>")[1]
        self.assertIn("verdict: pass", below)
        self.assertEqual(below.count("<tr>"), len(self.plan) + 2)
        required, margin = below.split("<td>hold</td><td>")[1].split("</td><td>")[:2]
        self.assertEqual(report.table.split("hold")[1].split()[0], required)
        exact = report.steps[0]["force_closure"]["required_half_angle_deg"]
        self.assertLessEqual(float(margin), report.data["settings"]["friction_half_angle_deg"] - exact)
        self.assertAlmostEqual(float(margin), report.data["settings"]["friction_half_angle_deg"] - exact, delta=0.01)
        self.assertNotIn("<pre", below.split("<table>")[1].split("</table>")[0])
        weak = regrasp.validate(self.cube, self.plan, mu=0.05)._repr_html_().split("</iframe>")[1]
        self.assertIn("verdict: fail: ", weak)
        self.assertIn("<td>fail: not-force-closure</td>", weak)
        rows = self.plan._repr_html_()
        self.assertEqual(rows.count("<tr>"), len(self.plan) + 2)
        named = json.loads(self.plan.text)
        named["object"]["file"] = "<script>.obj"
        self.assertNotIn("<script>", regrasp.Plan(json.dumps(named))._repr_html_())

    def test_a_report_is_a_page(self):
        report = regrasp.validate(self.cube, self.plan)
        page = report.page()
        self.assertIn('id="viewer-data"', page)
        self.assertIn("<th scope=\"col\" class=\"\">Verdict</th>", page)
        self.assertNotIn("<img", page)
        self.assertEqual(page, report.page())
        weak = regrasp.validate(self.cube, self.plan, mu=0.05).page()
        self.assertIn("<strong>Fail</strong>", weak)
        self.assertIn('"verdict":"fail"', weak)

    def test_a_notebook_draws_plans_of_known_objects(self):
        # Frames have hinted text, figures do not: rendering frames must not change figures.
        regrasp.validate(self.cube, self.plan).frames((320, 240))
        self.plan.write(self.path("plan.json"))
        subprocess.run([f"{PROGRAMS}/figure", "--object", "models/cube.obj", "--plan",
                        self.path("plan.json"), "--output", self.path("figures"), "--quiet"], check=True)
        with open(self.path("figures/sheet.svg"), encoding="utf-8") as file:
            self.assertEqual(self.plan.figure(), file.read())
        self.assertIn("data:image/svg+xml", self.plan._repr_html_())
        read = regrasp.Plan.read(self.path("plan.json"))
        self.assertNotIn("<img", read._repr_html_())
        self.refuses(["object", "cube.obj", "object is required"], read.figure)
        self.assertEqual(read.figure(self.cube), self.plan.figure())
        self.refuses(["width_mm", "20"], read.figure, self.cube, width_mm=1)
        gear = regrasp.Object.read("models/gear128.wkt")
        self.refuses(["plan.json", "sha256"], read.figure, gear)
        # A plan that violates a rule has no drawing, and the message names the rule.
        broken = json.loads(self.plan.text)
        broken["friction"]["half_angle_deg"] = 1
        weak = regrasp.Plan(json.dumps(broken), "weak.json")
        weak.object = self.cube
        self.refuses(["weak.json: step 0 (hold): not-force-closure"], weak.figure)
        self.assertIn("not-force-closure", weak._repr_html_())
        self.assertNotIn("<img", weak._repr_html_())
        planar = regrasp.plan(gear, "random", "random", mu=0.4, seed=1)
        self.assertIn("<svg", planar.figure(width_mm=85))

    def test_no_plan_says_what_was_searched(self):
        # Two pairs whose torques cancel: little friction suffices, and a contact can only leave if
        # another one takes its line of force.
        def pinwheel(first, second):
            points = np.zeros((4, 3))
            for i, (axis, other, side) in enumerate([(first, second, 1), (first, second, -1),
                                                     (second, first, 1), (second, first, -1)]):
                points[i, axis], points[i, other] = side * 0.03, side * 0.02
            return points
        with self.assertRaises(regrasp.NoPlan) as caught:
            regrasp.plan(self.cube, pinwheel(0, 1), pinwheel(1, 2), friction_angle_deg=2,
                         contacts=4)
        self.assertIn("495 subsets of four", str(caught.exception))
        with self.assertRaises(regrasp.NoPlan) as caught:
            regrasp.plan(self.cube, "random-any", GOAL, mu=0.3, min_quality=0.9)
        self.assertIn("start random-any", str(caught.exception))

    def test_progress_is_told_and_its_exception_comes_back(self):
        told = []
        regrasp.validate(self.cube, self.plan, progress=told.append)
        self.assertIn("replay: 1 of", told[0])

        def stop(text):
            raise KeyError(text)
        with self.assertRaises(KeyError):
            regrasp.validate(self.cube, self.plan, progress=stop)
        with self.assertRaises(KeyError):
            regrasp.Object.read("models/cube.obj", progress=stop)

    def test_ctrl_c_ends_planning(self):
        # Planning takes several seconds; the signal is sent after it has started.
        timer = threading.Timer(0.2, os.kill, (os.getpid(), signal.SIGINT))
        told = []

        def begin(text):
            if not told:
                timer.start()
            told.append(text)
        duck = regrasp.Object.read("models/duck1000.obj")
        with self.assertRaises(KeyboardInterrupt):
            regrasp.plan(duck, "random", "random", mu=0.2, planner="roadmap", contacts=4000,
                         clusters=200, progress=begin)
            timer.join()
        self.assertTrue(told)

    def test_a_time_limit_ends_planning(self):
        with self.assertRaises((regrasp.NoPlan, TimeoutError)) as caught:
            regrasp.plan(self.cube, START, GOAL, friction_angle_deg=20, planner="roadmap",
                         time_limit=1e-9)
        self.assertIn("time", str(caught.exception))

    def test_other_threads_run_meanwhile(self):
        reports = []
        threads = [threading.Thread(target=lambda: reports.append(
            regrasp.validate(self.cube, self.plan).text)) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(reports), 3)
        self.assertEqual(len(set(reports)), 1)

    def test_arguments_that_are_wrong_are_named(self):
        cube, grasp = self.cube, [[.03, 0, 0], [-.03, 0, 0], [0, .03, 0]]
        self.refuses(["start", "file no.json not found", "'random'"], regrasp.plan, cube, "no.json", GOAL,
                     mu=0.5)
        self.refuses(["start", "/contacts/0/point", "off the surface"], regrasp.plan, cube,
                     [[9, 9, 9]] * 3, GOAL, mu=0.5)
        self.refuses(["goal", "(k, 3)", "(3, 2)"], regrasp.plan, cube, grasp,
                     np.zeros((3, 2)), mu=0.5)
        self.refuses(["start[1]", "(3, 3)", "(2, 3)"], regrasp.plan, cube,
                     (grasp, np.zeros((2, 3))), GOAL, mu=0.5)
        self.refuses(["goal[0, 1]", "nan"], regrasp.plan, cube, grasp,
                     [[0, float("nan"), 0]], mu=0.5)
        self.refuses(["planner", "did you mean 'general'"], regrasp.plan, cube, START, GOAL,
                     mu=0.5, planner="genral")
        self.refuses(["optimize", "'steps'"], regrasp.plan, cube, START, GOAL, mu=0.5,
                     optimize="all")
        self.refuses(["seed", "-1"], regrasp.plan, cube, START, GOAL, mu=0.5, seed=-1)
        self.refuses(["time_limit", "above 0"], regrasp.plan, cube, START, GOAL, mu=0.5,
                     time_limit=0)
        self.refuses(["object", "str"], regrasp.plan, "cube.obj", START, GOAL, mu=0.5)
        self.refuses(["plan", "str", "Plan.read"], regrasp.validate, cube, "plan.json")
        self.refuses(["mass", "above 0"], regrasp.validate, cube, self.plan, mass=0)
        self.refuses(["plan.json"], regrasp.Plan, "{}")
        gear = regrasp.Object.read("models/gear128.wkt")
        self.refuses(["plan.json", "sha256", "gear128.wkt"], regrasp.validate, gear, self.plan)


if __name__ == "__main__":
    unittest.main()
