"""The program graph from the shell: good, missing and illegal input."""

import json

import program_case
from program_case import ProgramCase


class Graph(ProgramCase):
    program = "graph"

    def arguments(self, *more):
        return ["--object", self.model("cube.obj"), "--contacts", "20", *more]

    def test_prints_a_table_with_the_sizes(self):
        done = self.assert_done(*self.arguments("--friction-angle", "20"))
        title, head, row = done.stdout.splitlines()
        self.assertIn("cube.obj", title)
        values = dict(zip(head.split(), row.split()))
        self.assertEqual(values["#Points"], "20")
        self.assertEqual(values["#Subsets"], "4845")
        self.assertGreater(int(values["#Vert"]), 0)
        self.assertEqual(done.stderr, "")

    def test_writes_the_same_as_json(self):
        done = self.assert_done(*self.arguments("--friction-angle", "20", "--planner", "roadmap",
                                                "--json", "graph.json"))
        row = done.stdout.splitlines()[-1].split()
        graph = json.loads(self.read("graph.json"))
        self.assertEqual(graph["format"], "regrasp-graph")
        self.assertEqual(graph["version"], 1)
        self.assertEqual(graph["planner"], "roadmap")
        self.assertAlmostEqual(graph["friction"]["half_angle_deg"], 20, places=12)
        self.assertEqual(graph["faces"], 20)
        kind = graph["types"]["representative"]
        self.assertEqual(kind["candidates"], 4845)
        self.assertEqual(kind["combinations"], kind["vertices"])
        self.assertEqual(kind["vertices"], graph["vertices"])
        self.assertEqual([str(n) for n in (graph["vertices"],
                                           graph["edges"]["representative-representative"],
                                           graph["components"])], row[2:5])
        self.assertGreaterEqual(graph["seconds"]["vertices"], 0)
        self.assertGreaterEqual(graph["seconds"]["edges"], 0)

    def test_dash_writes_nothing_but_json_to_standard_output(self):
        done = self.assert_done(*self.arguments("--mu", "0.4", "--json", "-"))
        self.assertEqual(json.loads(done.stdout)["format"], "regrasp-graph")

    def test_an_empty_graph_is_an_answer(self):
        done = self.assert_done("--object", self.model("cube.obj"), "--contacts", "4",
                                "--friction-angle", "0.1", "--json", "-")
        graph = json.loads(done.stdout)
        self.assertEqual((graph["vertices"], graph["components"]), (0, 0))
        self.assertEqual(graph["edges"], {"representative-representative": 0})

    def test_the_seed_decides_the_graph(self):
        def vertices(seed):
            done = self.assert_done(*self.arguments("--friction-angle", "20", "--json", "-",
                                                    "--seed", seed))
            graph = json.loads(done.stdout)
            return graph["vertices"], graph["edges"]
        self.assertEqual(vertices("1"), vertices("1"))
        self.assertNotEqual(vertices("1"), vertices("2"))

    def test_more_friction_gives_no_fewer_grasps(self):
        counts = []
        for angle in ("5", "10", "20", "40"):
            done = self.assert_done(*self.arguments("--friction-angle", angle, "--json", "-"))
            counts.append(json.loads(done.stdout)["vertices"])
        self.assertEqual(counts, sorted(counts))
        self.assertLess(counts[0], counts[-1])

    def test_refuses_bad_usage_and_bad_input(self):
        self.assert_refused(2, "--object", "--friction-angle", "20")
        self.assert_refused(2, "friction is missing", *self.arguments())
        self.assert_refused(2, "exclude", *self.arguments("--mu", "1", "--friction-angle", "20"))
        self.assert_refused(2, "planner", *self.arguments("--mu", "1", "--planner", "polyhedron"))
        self.assert_refused(2, "no.obj", "--object", "no.obj", "--mu", "1")
        self.assert_refused(2, "planar", "--object",
                            self.write("a.wkt", "POLYGON((0 0, 1 0, 1 1, 0 0))"), "--mu", "1")

    def test_an_output_that_cannot_be_written_is_the_environments_fault(self):
        self.assert_refused(3, "missing/graph.json",
                            *self.arguments("--mu", "1", "--json", "missing/graph.json"))


if __name__ == "__main__":
    program_case.main()
