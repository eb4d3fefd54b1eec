"""The program graph from the shell: valid, missing and invalid input."""

import json
import math
import os
import subprocess

import program_case
from program_case import ProgramCase


def regular_polygon(count):
    """Return the WKT of a regular polygon with `count` edges."""
    corners = [(math.cos(2 * math.pi * k / count), math.sin(2 * math.pi * k / count))
               for k in range(count)]
    ring = ", ".join(f"{x!r} {y!r}" for x, y in corners + corners[:1])
    return f"POLYGON (({ring}))"


class Graph(ProgramCase):
    program = "graph"

    def arguments(self, *more):
        return ["--object", self.model("cube.obj"), "--planner", "points=20", *more]

    def tables(self, text):
        """Return the rows of the tables by their first cell, with the other cells as numbers."""
        rows = [line.split() for line in text.splitlines()]
        return {row[0]: [int(cell) for cell in row[1:]] for row in rows
                if len(row) > 1 and all(cell.isdigit() for cell in row[1:])}

    def test_prints_tables_with_the_sizes(self):
        done = self.assert_done(*self.arguments("--friction-angle", "20"))
        self.assertIn("roadmap of cube.obj, 20 contact points, 20°", done.stdout.splitlines()[0])
        tables = self.tables(done.stdout)
        candidates, combinations, vertices, components = tables["representative"]
        self.assertEqual(candidates, 4845)
        self.assertEqual(combinations, vertices)
        self.assertGreater(vertices, 0)
        self.assertGreater(components, 0)
        self.assertGreater(tables["representative-representative"][0], 0)
        self.assertEqual(done.stderr, "")

    def test_a_terminal_is_told_the_stages_of_reading_and_building(self):
        arguments = self.arguments("--friction-angle", "20")
        done, shown = self.run_on_terminal(*arguments)
        self.assertEqual(done.returncode, 0, shown)
        self.assert_stages(shown, "reading ", "checking 6 facets", "preparing 6 faces",
                           "sampling 20 contact points")
        self.assertEqual(self.run_on_terminal(*arguments, "--quiet")[1], "")

    def test_writes_the_same_as_json(self):
        done = self.assert_done(*self.arguments("--friction-angle", "20", "--planner", "roadmap",
                                                "--json", "graph.json"))
        tables = self.tables(done.stdout)
        graph = json.loads(self.read("graph.json"))
        self.assertEqual(graph["format"], "regrasp-graph")
        self.assertEqual(graph["version"], 1)
        self.assertEqual(graph["planner"], "roadmap")
        self.assertAlmostEqual(graph["friction"]["half_angle_deg"], 20, places=12)
        self.assertEqual(graph["faces"], 20)
        kind = graph["types"]["representative"]
        self.assertEqual([kind[name] for name in ("candidates", "combinations", "vertices",
                                                  "components")], tables["representative"])
        self.assertEqual((kind["vertices"], kind["components"]),
                         (graph["vertices"], graph["components"]))
        self.assertEqual([graph["edges"]["representative-representative"]],
                         tables["representative-representative"])
        self.assertGreaterEqual(graph["seconds"]["vertices"], 0)
        self.assertGreaterEqual(graph["seconds"]["edges"], 0)

    def test_a_graph_that_takes_more_than_half_of_the_memory_is_refused_unless_forced(self):
        large = self.write("large.wkt", regular_polygon(3000))  # terabytes
        self.assert_refused(2, ["large.wkt: the graph of the planner polygon: ",
                                "3000 edges require", "edges fit", "--allow large-graph"],
                            "--object", large, "--friction-angle", "15")
        self.assert_refused(2, ["the graph of the planner polyhedron", "999 faces require"],
                            "--object", self.model("ellipsoid1000.obj"), "--friction-angle", "15",
                            "--planner", "polyhedron")
        self.assert_done(*self.polygon("--friction-angle", "10", "--allow", "large-graph"))

    def test_a_contour_that_takes_more_than_half_of_the_memory_is_refused(self):
        count = 60_000  # more than a hundred gigabytes
        large = self.write("large.wkt", regular_polygon(count))
        words = ["large.wkt: the graph of the planner contour: ",
                 f"{count} edges require", "edges fit", "--allow large-graph"]
        self.assert_refused(2, words, "--object", large, "--friction-angle", "85", "--planner",
                            "contour")
        done = self.run_program("--object", large, "--friction-angle", "85", "--planner", "contour",
                                "--start", "random", "--goal", "random", "--output", "-",
                                program="plan")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_a_roadmap_that_takes_more_than_half_of_the_memory_is_refused_unless_forced(self):
        def limited(program, *arguments):
            return subprocess.run(
                ["sh", "-c", 'ulimit -v 1500000; exec "$0" "$@"',
                 os.path.join(program_case.ARGUMENTS.programs, program), *arguments],
                capture_output=True, text=True, cwd=self.folder, check=False)

        if limited("graph", "--version").returncode != 0:
            self.skipTest("the address sanitizer does not run in a small address space")
        for more, words in (
                (["--planner", "points=200"], "200 contact points require"),
                (["--planner", "points=1000,clusters=200"], "200 clusters require")):
            roadmap = ["--object", self.model("cube.obj"), "--friction-angle", "60", "--planner",
                       "roadmap", *more]
            for program, ends in (("graph", []),
                                  ("plan", ["--start", "random", "--goal", "random", "--output",
                                            "plan.json"])):
                done = limited(program, *roadmap, *ends)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("cube.obj: the graph of the planner roadmap: ", done.stderr)
                self.assertIn(words, done.stderr)
        small = [*roadmap[:-1], "points=30"]
        self.assertEqual(limited("graph", *small).returncode, 0)
        self.assertEqual(limited("graph", *small, "--allow", "large-graph").returncode, 0)

    def polygon(self, *more):
        return ["--object", self.model("square.wkt"), *more]

    def test_a_polygon_is_counted_by_types(self):
        done = self.assert_done(*self.polygon("--friction-angle", "10", "--json", "graph.json"))
        self.assertIn("polygon of square.wkt, 4 edges, 10°, adaptive", done.stdout)
        # Opposite sides form two-finger grasps; no three normals of a square span or are nearly
        # parallel.
        tables = self.tables(done.stdout)
        self.assertEqual(tables["concurrent"], [0, 0, 0, 0])
        self.assertEqual(tables["two_finger"], [2, 2, 2, 1])
        self.assertEqual(tables["parallel"], [0, 0, 0, 0])
        self.assertEqual(tables["all"], [2, 1])
        graph = json.loads(self.read("graph.json"))
        self.assertEqual((graph["planner"], graph["faces"]), ("polygon", 4))
        self.assertEqual(graph["edges"],
                         {"concurrent-concurrent": 0, "two_finger-concurrent": 0,
                          "parallel-parallel": 0, "two_finger-parallel": 0,
                          "two_finger-two_finger": 1, "concurrent-parallel": 0})
        self.assertEqual((graph["vertices"], graph["components"]), (2, 1))

    def test_a_contour_is_counted(self):
        done = self.assert_done(*self.polygon("--friction-angle", "46", "--planner", "contour",
                                              "--json", "graph.json"))
        self.assertIn("contour of square.wkt, 4 edges, 46°", done.stdout)
        # Opposite and neighbouring sides form grasps, so that all are connected: one set, no
        # switch.
        self.assertEqual(self.tables(done.stdout)["two_finger"], [6, 6, 1, 1])
        graph = json.loads(self.read("graph.json"))
        self.assertEqual((graph["planner"], graph["faces"]), ("contour", 4))
        self.assertEqual(graph["types"]["two_finger"],
                         {"candidates": 6, "combinations": 6, "vertices": 1, "components": 1})
        self.assertEqual(graph["edges"], {"two_finger-two_finger": 0})
        self.assertEqual((graph["vertices"], graph["components"]), (1, 1))

    def test_a_polyhedron_is_counted_directly_and_by_sampling(self):
        body = ["--object", self.model("body14.obj"), "--friction-angle", "10", "--planner",
                "polyhedron,spanning=uniform"]
        done = self.assert_done(*body, "--json", "graph.json")
        self.assertIn("polyhedron of body14.obj, 14 faces, 10°, uniform", done.stdout)
        graph = json.loads(self.read("graph.json"))
        self.assertEqual((graph["planner"], graph["faces"], graph["unclear"]),
                         ("polyhedron", 14, 0))
        cells = graph["types"]["concurrent"]["vertices"]
        links = graph["edges"]["concurrent-concurrent"]
        self.assertGreater(min(cells, links), 10)
        shares = []
        for points in ("20", "2000", "2000"):
            done = self.assert_done(*body, "--planner", f"sampling={points},compare", "--json",
                                    "sampled.json")
            self.assertIn("of the direct graph sampling found", done.stdout)
            shares.append(json.loads(self.read("sampled.json"))["compare"])
        self.assertEqual(shares[1], shares[2])
        self.assertLess(shares[0]["found_combinations"], shares[1]["found_combinations"])
        self.assertLessEqual(shares[1]["found_combinations"], cells)
        self.assertEqual(shares[1]["links"], links)

    def test_spanning_decides_which_normals_span(self):
        triangle = self.write("triangle.wkt", "POLYGON((0 0, 1 0, 0.5 0.866, 0 0))")
        def counts(angle, spanning):
            done = self.assert_done("--object", triangle, "--friction-angle", angle,
                                    "--planner", "spanning=" + spanning, "--json", "-")
            graph = json.loads(done.stdout)
            self.assertEqual("concurrent-parallel" in graph["edges"], spanning == "adaptive")
            return graph["types"]["concurrent"]["vertices"]
        # Normals 120° apart span for cones with a friction angle below 30°.
        self.assertEqual([counts(angle, "uniform") for angle in ("29", "31")], [1, 0])
        self.assertEqual([counts(angle, "adaptive") for angle in ("29", "31")], [1, 1])

    def test_dash_writes_nothing_but_json_to_standard_output(self):
        done = self.assert_done(*self.arguments("--mu", "0.4", "--json", "-"))
        self.assertEqual(json.loads(done.stdout)["format"], "regrasp-graph")

    def test_an_empty_graph_is_an_answer(self):
        done = self.assert_done("--object", self.model("cube.obj"), "--planner", "points=4",
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

    def test_an_option_that_the_planner_lacks_is_refused_with_one_that_has_it(self):
        solid = ["--object", self.model("cube.obj"), "--friction-angle", "20"]
        for options, lacking, having in (
                (["--planner", "spanning=uniform"], "roadmap", "polyhedron"),
                (["--planner", "sampling=9"], "roadmap", "polyhedron"),
                (["--planner", "points=20"], "polyhedron", "roadmap"),
                (["--planner", "clusters=9"], "polyhedron", "roadmap"),
                (["--planner", "queries=9"], "polyhedron", "roadmap")):
            self.assert_refused(2, [f"{options[0]} {options[1]}".split("=")[0].rstrip(" 9"), f": not supported by planner {lacking}",
                                    f"use --planner {having}"],
                                *solid, *options, "--planner", lacking)
        self.assert_refused(2, "not supported by planner contour; help: use --planner polygon",
                            *self.polygon("--mu", "1", "--planner", "contour,spanning=uniform"))
        # A planner accepts its own options, and the default value of another planner's option.
        self.assert_done(*solid, "--planner", "roadmap,points=20,spanning=adaptive")

    def test_without_a_name_the_planner_is_the_first_with_a_graph_and_every_option(self):
        def planner(*arguments):
            return json.loads(self.assert_done(*arguments, "--mu", "0.3", "--json", "-").stdout)[
                "planner"]
        self.assertEqual(planner(*self.polygon()), "polygon")
        self.assertEqual(planner(*self.arguments()), "roadmap")
        body = ["--object", self.model("body14.obj")]
        self.assertEqual(planner(*body, "--planner", "spanning=uniform"), "polyhedron")
        self.assertEqual(planner(*body, "--planner", "sampling=5"), "polyhedron")
        self.assert_refused(2, ["--planner points (roadmap)", "--planner spanning=uniform (polyhedron)"],
                            *self.arguments("--mu", "0.3", "--planner", "spanning=uniform"))

    def test_a_time_limit_ends_the_building_of_every_graph(self):
        cases = [self.polygon("--planner", "polygon"), self.polygon("--planner", "contour"),
                 ["--object", self.model("body14.obj"), "--planner", "polyhedron"],
                 self.arguments("--planner", "roadmap"),
                 self.arguments("--planner", "roadmap,clusters=8")]
        for case in cases:
            case = [*case, "--friction-angle", "20", "--json", "graph.json"]
            self.assert_refused(1, "time limit reached", *case, "--time-limit", "1e-9")
        for case in cases:
            self.assert_done(*case, "--friction-angle", "20", "--time-limit", "1e300")
        self.assert_refused(2, "--time-limit", *cases[0], "--mu", "1", "--time-limit", "0")

    def test_refuses_bad_usage_and_bad_input(self):
        self.assert_refused(2, "--object", "--friction-angle", "20")
        self.assert_refused(2, "friction: --friction-angle DEG or --mu X is required", *self.arguments())
        self.assert_refused(2, "cannot be used with --mu", *self.arguments("--mu", "1", "--friction-angle", "20"))
        self.assert_refused(2, "planner general: graph not supported; help: use --planner roadmap",
                            *self.arguments("--mu", "1", "--planner", "general"))
        self.assert_refused(2, "--planner queries requires clusters",
                            *self.arguments("--mu", "1", "--planner", "queries=9"))
        self.assert_refused(2, "--planner sampling", *self.arguments("--mu", "1", "--planner", "roadmap,sampling=100"))
        self.assert_refused(2, "--planner compare: requires the setting sampling",
                            *self.arguments("--mu", "1", "--planner", "polyhedron,compare"))
        self.assert_refused(2, "no.obj", "--object", "no.obj", "--mu", "1")
        self.assert_refused(2, "planar", *self.polygon("--mu", "1", "--planner", "roadmap"))
        self.assert_refused(2, "solid", *self.arguments("--mu", "1", "--planner", "polygon"))
        self.assert_refused(2, "vague", *self.polygon("--mu", "1", "--planner", "spanning=vague"))

    def test_an_output_that_cannot_be_written_is_the_environments_fault(self):
        self.assert_refused(3, "missing/graph.json",
                            *self.arguments("--mu", "1", "--json", "missing/graph.json"))


if __name__ == "__main__":
    program_case.main()
