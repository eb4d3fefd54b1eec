"""Triangle meshes from the shell: clustered roadmaps, queries, plans with them and their replay."""

import json
import os

import jsonschema

import program_case
from program_case import ProgramCase

# Binomial coefficients: all 4-subsets of the representatives.
FOURS = {20: 4845, 30: 27405, 50: 230300}


class ClusteredGraph(ProgramCase):
    program = "graph"

    def arguments(self, *more, model="mug500"):
        return ["--object", self.model(model + ".obj"), "--friction-angle", "10", *more]

    def graph(self, *more, model="mug500"):
        done = self.assert_done(*self.arguments(*more, "--json", "-", model=model))
        self.assertEqual(done.stderr, "")
        return json.loads(done.stdout)

    def test_counts_the_grasps_of_representatives(self):
        for clusters in (20, 30):
            graph = self.graph("--planner", f"clusters={clusters}")
            self.assertEqual((graph["planner"], graph["faces"], graph["clusters"]),
                             ("roadmap", 500, clusters))
            kind = graph["types"]["representative"]
            self.assertEqual(kind["candidates"], FOURS[clusters])
            self.assertEqual(kind["combinations"], kind["vertices"])
            self.assertEqual((kind["vertices"], kind["components"]),
                             (graph["vertices"], graph["components"]))
            self.assertGreater(kind["vertices"], 10)
            self.assertGreaterEqual(kind["vertices"], kind["components"])
            self.assertNotIn("queries", graph)

    def test_a_mesh_has_fifty_clusters_by_itself(self):
        graph = self.graph()
        self.assertEqual((graph["faces"], graph["clusters"]), (500, 50))
        self.assertEqual(graph["types"]["representative"]["candidates"], FOURS[50])

    def test_a_mesh_of_more_triangles_is_thinned(self):
        graph = self.graph("--planner", "points=300,clusters=20")
        self.assertEqual((graph["faces"], graph["clusters"]), (300, 20))

    def test_few_contacts_have_no_clusters(self):
        graph = self.graph("--planner", "points=20")
        self.assertEqual(graph["faces"], 20)
        self.assertNotIn("clusters", graph)

    def test_has_fewer_clusters_than_contacts(self):
        graph = self.graph("--planner", "points=6,clusters=50")
        self.assertEqual((graph["faces"], graph["clusters"]), (6, 5))

    def test_answers_queries(self):
        queries = self.graph("--planner", "clusters=30,queries=10")["queries"]
        self.assertEqual((queries["count"], queries["connected"]), (10, 10))
        self.assertGreater(queries["shortest_seconds"], 0)
        self.assertLessEqual(queries["shortest_seconds"], queries["mean_seconds"])
        self.assertLessEqual(queries["mean_seconds"], queries["longest_seconds"])

    def test_without_the_last_resort_some_queries_fail(self):
        def connected(*more):
            return self.graph("--planner", "clusters=20,queries=30", *more,
                              model="spanner500")["queries"]["connected"]
        self.assertEqual(connected(), 30)
        joined = connected("--planner", "fallback=no")
        self.assertGreater(joined, 0)
        self.assertLess(joined, 30)

    def test_prints_clusters_and_queries(self):
        done = self.assert_done(*self.arguments("--planner", "clusters=30,queries=5"))
        self.assertIn("roadmap of mug500.obj, 500 contact points, 10°, 30 clusters", done.stdout)
        self.assertRegex(done.stdout, r"(?m)^5 of 5 random queries joined, \S+ to \S+ ms each, "
                                      r"mean \S+ ms$")
        self.assertIn("27405", done.stdout)

    def test_the_seed_decides_the_clusters(self):
        def counts(seed):
            graph = self.graph("--planner", "clusters=30", "--seed", seed)
            return graph["vertices"], graph["edges"]
        self.assertEqual(counts("1"), counts("1"))
        self.assertNotEqual(counts("1"), counts("2"))

    def test_refuses_bad_usage(self):
        for clusters in ("3", "201", "0", "-5", "many", "20.5"):
            self.assert_refused(2, "--planner clusters",
                                *self.arguments("--planner", "clusters=" + clusters))
        for contacts in ("3", "4001", "none"):
            self.assert_refused(2, "--planner points",
                                *self.arguments("--planner", "points=" + contacts))
        for queries in ("0", "-1", "all"):
            self.assert_refused(2, "--planner queries",
                                *self.arguments("--planner", "clusters=20,queries=" + queries))
        self.assert_refused(2, ["--planner queries", "clusters"],
                            *self.arguments("--planner", "points=20,queries=5"))
        self.assert_refused(2, "--planner queries", *self.arguments("--planner", "polyhedron,queries=5"))
        self.assert_refused(2, ["--planner fallback", "queries"], *self.arguments("--planner", "fallback=no"))


class PlansOnMeshes(ProgramCase):
    program = "plan"

    def arguments(self, model="mug500", *more, **changes):
        options = {"--object": self.model(model + ".obj"), "--start": "random", "--goal": "random",
                   "--output": "plan.json", "--friction-angle": "10",
                   "--planner": "roadmap,clusters=30"}
        options.update({"--" + key.replace("_", "-"): value for key, value in changes.items()})
        return [word for pair in options.items() for word in pair] + list(more)

    def plan(self, *arguments, **changes):
        """Return the plan, which must follow its schema."""
        self.assert_done(*self.arguments(*arguments, **changes))
        plan = json.loads(self.read("plan.json"))
        schema = os.path.join(program_case.ARGUMENTS.source, "docs", "plan.schema.json")
        with open(schema, encoding="utf-8") as file:
            jsonschema.validate(plan, json.load(file))
        return plan

    def test_says_what_linked_the_ends(self):
        links = set()
        for seed in ("1", "2", "3"):
            plan = self.plan("mug500", seed=seed, planner="roadmap,points=600,clusters=30")
            self.assertEqual((plan["planner"], plan["fingers"]), ("roadmap", 5))
            note = plan["roadmap"]
            self.assertEqual((note["contacts"], note["clusters"], note["seed"]),
                             (600, 30, int(seed)))
            for end in (note["start"], note["goal"]):
                self.assertRegex(end, r"^(vertex|algorithm-[123]|last-resort(-subsets)?)$")
                links.add(end)
            self.assertTrue(all(step["kind"] == "switch" for step in plan["steps"]))
            self.assertGreater(len(plan["steps"]), 0)
        self.assertGreater(len(links), 0)

    def test_a_plan_over_few_points_has_no_such_note(self):
        done = self.assert_done("--object", self.model("cube.obj"), "--start", "random", "--goal",
                                "random", "--output", "plan.json", "--friction-angle", "20",
                                "--planner", "roadmap")
        self.assertIn("switch", done.stderr)
        self.assertNotIn("roadmap", [key for key in json.loads(self.read("plan.json"))
                                     if key != "planner"])

    def test_the_same_seed_gives_the_same_bytes(self):
        self.plan("mug500", seed="5")
        first = self.read("plan.json")
        self.plan("mug500", seed="5")
        self.assertEqual(self.read("plan.json"), first)
        self.plan("mug500", seed="6")
        self.assertNotEqual(self.read("plan.json"), first)

    def test_without_the_last_resort_some_plans_are_not_found(self):
        codes = set()
        for seed in range(30):
            arguments = self.arguments("spanner500", "--planner", "fallback=no", seed=str(seed),
                                       planner="roadmap,clusters=20", goal="random-any")
            done = self.run_program(*arguments)
            codes.add(done.returncode)
            if done.returncode == 1:
                self.assertIn("planner roadmap finds no path over", done.stderr)
                self.assertIn("500 contact points in 20 clusters", done.stderr)
                self.assertRegex(done.stderr, r"start (has no link|is linked by)")
                self.assertRegex(done.stderr, r"goal (has no link|is linked by)")
                self.assertNotIn("last resort", done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1)
                arguments[arguments.index("fallback=no")] = "fallback=yes"
                self.assert_done(*arguments)
            if codes == {0, 1}:
                return
        self.fail(f"exit codes {codes} only")

    def test_refuses_bad_usage(self):
        for clusters in ("3", "201", "x"):
            self.assert_refused(2, "--planner clusters",
                                *self.arguments(planner="roadmap,clusters=" + clusters))
        self.assert_refused(2, "--planner points", *self.arguments(planner="roadmap,points=5000"))
        self.assert_refused(2, "no.json", *self.arguments(start="no.json"))

    def test_plans_pass_the_replay(self):
        passed = 0
        for model in ("ellipsoid500", "spanner500"):
            for seed in ("1", "2", "3"):
                with self.subTest(model=model, seed=seed):
                    self.plan(model, seed=seed)
                    done = self.assert_done("--object", self.model(model + ".obj"), "--plan",
                                            "plan.json", "--output", "out", "--frames", "none",
                                            program="validate")
                    self.assertIn("pass", done.stdout + done.stderr)
                    report = json.loads(self.read("out/report.json"))
                    self.assertEqual(report["verdict"], "pass")
                    for step in report["steps"]:
                        self.assertEqual(step["verdict"], "pass")
                        self.assertTrue(step["force_closure"]["holds"])
                        self.assertFalse(step["simulation"]["contact_lost"])
                    passed += 1
        self.assertEqual(passed, 6)

    def test_frames_show_the_clusters_where_asked(self):
        self.plan("mug500", seed="1")
        frames = []
        for shown in ((), ("--show", "clusters",)):
            self.assert_done("--object", self.model("mug500.obj"), "--plan", "plan.json", "--output",
                             "out", "--size", "320x240", *shown, program="validate")
            frames.append(self.read("out/000_hold.png"))
        # The images differ only in the colours of the surface.
        self.assertNotEqual(frames[0], frames[1])
        self.assertGreater(len(frames[1]), 10_000)

    def test_frames_show_the_clusters_of_plans_with_patches(self):
        mug = self.model("mug500.obj")
        plan = self.plan("mug500", "--patch", "0.002", friction_angle="30", planner="roadmap,clusters=20")
        note = plan["roadmap"]
        self.assertEqual((note["roughness_deg"], "invented" in note), (5, False))
        frames = []
        for roughness in (5, 20):
            plan["roadmap"]["roughness_deg"] = roughness  # negative control: different clusters
            self.write_json("other.json", plan)
            self.assert_done("--object", mug, "--plan", "other.json", "--output", "out", "--size",
                             "320x240", "--show", "clusters", program="validate")
            frames.append(self.read("out/000_hold.png"))
        self.assertNotEqual(frames[0], frames[1])

    def test_plans_without_clusters_have_none_to_show(self):
        self.assert_done("--object", self.model("cube.obj"), "--start", "random", "--goal", "random",
                         "--output", "plan.json", "--friction-angle", "20", "--planner", "roadmap")
        done = self.run_program("--object", self.model("cube.obj"), "--plan", "plan.json",
                                "--show", "clusters", "--output", "out", program="validate")
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--show clusters", done.stderr)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse(os.path.exists(self.path("out")))

    def test_a_plan_with_a_finger_elsewhere_fails(self):
        plan = self.plan("ellipsoid500", seed="1")
        place = plan["steps"][0]["place"][0]
        # Move the placed finger to the contact of another finger.
        other = plan["initial"]["contacts"][0]
        place["point"], place["normal"] = other["point"], other["normal"]
        self.write_json("plan.json", plan)
        done = self.run_program("--object", self.model("ellipsoid500.obj"), "--plan", "plan.json",
                                "--output", "out", "--frames", "none", program="validate")
        self.assertEqual(done.returncode, 1, done.stderr)
        report = json.loads(self.read("out/report.json"))
        self.assertEqual(report["verdict"], "fail")
        self.assertIn("coincident-fingers", [step["reason"] for step in report["steps"]])


if __name__ == "__main__":
    program_case.main()
