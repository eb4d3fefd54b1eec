"""The schemas of docs/ accept what the project writes and ships, and refuse what is wrong.

usage: schema_test.py --programs DIR --source DIR [unittest's own arguments]
"""

import argparse
import copy
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import validate_schema

ARGUMENTS = argparse.Namespace(programs="", source="")

# Far above what planning on a cube needs: a program that hangs fails.
HANG_SECONDS = 300

REMOVED = object()


def source(path):
    return pathlib.Path(ARGUMENTS.source) / path


def schema(name):
    return validate_schema.validator(source(f"docs/{name}.schema.json"))


def changed(value, place, new):
    """A copy of `value` with the element at `place` replaced, or removed."""
    result = copy.deepcopy(value)
    parent = result
    for key in place[:-1]:
        parent = parent[key]
    if new is REMOVED:
        del parent[place[-1]]
    else:
        parent[place[-1]] = new
    return result


REPORT = {
    "format": "regrasp-report",
    "version": 1,
    "verdict": "fail",
    "object": {"file": "cube.obj"},
    "plan": {"file": "plan.json"},
    "settings": {"mu": 0.5},
    "run": {"sha256": "0" * 64, "files": [{"file": "report.html", "sha256": "1" * 64}],
            "report_sha256": "2" * 64},
    "steps": [
        {
            "index": 0, "kind": "hold", "verdict": "pass", "reason": None,
            "force_closure": {"holds": True, "required_half_angle_deg": 12.4},
            "simulation": {
                "displacement_m": 1.1e-6, "rotation_deg": 0.002, "slip_m": 4e-6,
                "contact_lost": False,
            },
            "frame": "000_hold.png",
        },
        {
            "index": 1, "kind": "switch", "verdict": "fail", "reason": "not-force-closure",
            "force_closure": {"holds": False, "required_half_angle_deg": None},
            "simulation": None, "frame": None,
        },
        {
            "index": 2, "kind": "align", "verdict": "skipped", "reason": None,
            "force_closure": None, "simulation": None, "frame": None,
        },
    ],
}

SUMMARY = {
    "format": "regrasp-summary",
    "version": 1,
    "verdict": "bad-input",
    "counts": {"plans": 3, "pass": 1, "fail": 1, "bad-input": 1, "error": 0},
    "plans": [
        {
            "name": "good", "file": "good.json", "verdict": "pass", "steps": 4, "weakest_step": 2,
            "required_half_angle_deg": 12.4, "failed_step": None, "reason": None, "message": None,
            "report": "good/report.json",
        },
        {
            "name": "weak", "file": "weak.json", "verdict": "fail", "steps": 4, "weakest_step": None,
            "required_half_angle_deg": None, "failed_step": 0, "reason": "slipped",
            "message": None, "report": "weak/report.json",
        },
        {
            "name": "broken", "file": "broken.json", "verdict": "bad-input", "steps": None,
            "weakest_step": None, "required_half_angle_deg": None, "failed_step": None,
            "reason": None, "message": "broken.json: is empty", "report": None,
        },
    ],
    "skipped": [{"file": "grasp.json", "why": "is a regrasp-grasp file"}],
}

GRAPH = {
    "format": "regrasp-graph",
    "version": 1,
    "planner": "polygon",
    "friction": {"half_angle_deg": 10},
    "faces": 40,
    "types": {"concurrent": {"candidates": 1074, "combinations": 736, "vertices": 740}},
    "edges": {"concurrent-concurrent": 12, "two_finger-concurrent": 3},
    "vertices": 740,
    "components": 1,
    "seconds": {"vertices": 0.1, "edges": 0.2},
}


class SchemaTest(unittest.TestCase):
    def expect_valid(self, name, files):
        checked = 0
        for file in sorted(files):
            with self.subTest(file=file):
                lines = validate_schema.complaints(schema(name), validate_schema.load(file))
                self.assertEqual(lines, [])
            checked += 1
        self.assertGreater(checked, 0)

    def expect_refused(self, name, value, changes):
        """`value` is valid, and no longer is with any one of the changes."""
        checker = schema(name)
        self.assertEqual(validate_schema.complaints(checker, value), [])
        for place, new in changes:
            with self.subTest(place=place, new=new):
                bad = changed(value, place, new)
                self.assertNotEqual(validate_schema.complaints(checker, bad), [])
        self.assertTrue(changes)

    def run_program(self, name, *arguments, code=0):
        program = pathlib.Path(ARGUMENTS.programs) / name
        result = subprocess.run(
            [program, *map(str, arguments)],
            capture_output=True, text=True, timeout=HANG_SECONDS, check=False,
        )
        self.assertEqual(result.returncode, code, result.stderr)

    def test_grasps_of_the_models_are_valid(self):
        models = source("models")
        self.expect_valid(
            "grasp", [*models.glob("*.start.json"), *models.glob("*.goal.json")]
        )

    def test_hands_are_valid_and_wrong_ones_refused(self):
        hands = sorted(source("models/hands").glob("*.json"))
        self.expect_valid("hand", hands)
        hand = validate_schema.load(hands[0])
        hand["couplings"] = [{"joint": "a", "follows": "b", "ratio": 1, "offset": -0.1}]
        self.expect_refused("hand", hand, [
            (["format"], "regrasp-plan"),
            (["palm"], REMOVED),
            (["up"], [0, 1]),
            (["fingers"], hand["fingers"][:2]),
            (["fingers", 0, "name"], ""),
            (["fingers", 0, "tip", "radius"], 0),
            (["fingers", 0, "tip", "radius"], 0.2),
            (["fingers", 0, "tip", "centre"], REMOVED),
            (["couplings", 0, "ratio"], 0),
            (["couplings", 0, "offset"], "0.1"),
            (["couplings", 0, "follows"], REMOVED),
        ])

    def test_the_corpus_of_good_files_is_valid(self):
        self.expect_valid("grasp", source("tests/data/plans/grasp_good").glob("*.json"))
        self.expect_valid("plan", source("tests/data/plans/plan_good").glob("*.json"))

    def test_bad_plans_of_the_corpus_are_refused(self):
        # Every plan that is refused for what it says is refused by the schema too; those that are
        # refused for how they are written (truncated, a repeated key …) do not load.
        refused = 0
        for file in sorted(source("tests/data/plans/plan_bad").glob("*.json")):
            with self.subTest(file=file):
                try:
                    value = validate_schema.load(file)
                except (ValueError, RecursionError):
                    refused += 1
                    continue
                self.assertNotEqual(validate_schema.complaints(schema("plan"), value), [])
                refused += 1
        self.assertGreater(refused, 20)

    def test_what_the_programs_write_is_valid(self):
        with tempfile.TemporaryDirectory() as folder:
            plan = pathlib.Path(folder) / "plan.json"
            graph = pathlib.Path(folder) / "graph.json"
            cube = source("models/cube.obj")
            self.run_program(
                "plan", "--object", cube, "--friction-angle", 25, "--output", plan, "--start",
                source("models/cube.start.json"), "--goal", source("models/cube.goal.json"),
            )
            self.run_program(
                "graph", "--object", cube, "--planner", "roadmap", "--friction-angle", 25,
                "--json", graph,
            )
            self.expect_valid("plan", [plan])
            thick = pathlib.Path(folder) / "thick.json"
            self.run_program(
                "plan", "--object", cube, "--friction-angle", 25, "--output", thick, "--start",
                "random", "--goal", "random", "--finger-radius", 0.004,
            )
            self.expect_valid("plan", [thick])
            self.assertEqual(validate_schema.load(thick)["finger_radius"], 0.004)
            in_hand = pathlib.Path(folder) / "in_hand.json"
            self.run_program(
                "plan", "--object", cube, "--scale", 0.8, "--mu", 0.8, "--output", in_hand, "--hand",
                source("models/hands/ring4.json"), "--turn", "z,100",
            )
            self.expect_valid("plan", [in_hand])
            self.assertIn("move", [step["kind"] for step in validate_schema.load(in_hand)["steps"]])
            self.expect_valid("graph", [graph])

    def test_reports_of_plans_that_pass_and_fail_are_valid(self):
        good = validate_schema.load(
            source("tests/data/plans/plan_good/cube_switches_and_align.json")
        )
        cases = {
            "pass": (0, good),
            "fail": (1, changed(good, ["steps", 0, "release"], [2, 0])),
            "thin": (0, {**good, "finger_radius": 0.001}),
            "thick": (1, {**good, "finger_radius": 0.09}),
        }
        with tempfile.TemporaryDirectory() as folder:
            for verdict, (code, plan) in cases.items():
                plan_file = pathlib.Path(folder) / f"{verdict}.json"
                plan_file.write_text(json.dumps(plan), encoding="utf-8")
                out = pathlib.Path(folder) / verdict
                self.run_program(
                    "validate", "--object", source("models/cube.obj"), "--plan", plan_file,
                    "--output", out, "--frames", "none", "--allow", "object-change", code=code,
                )
                self.expect_valid("report", [out / "report.json"])
                report = validate_schema.load(out / "report.json")
                self.assertEqual(report["verdict"], "pass" if code == 0 else "fail")
                self.assertEqual(report["settings"].get("finger_radius"),
                                 plan.get("finger_radius"))

    def test_reports_with_every_protocol_and_stress_are_valid_and_wrong_ones_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            plan = pathlib.Path(folder) / "plan.json"
            out = pathlib.Path(folder) / "out"
            cube = source("models/cube.obj")
            self.run_program(
                "plan", "--object", cube, "--friction-angle", 25, "--planner", "roadmap", "--output",
                plan, "--start",
                source("models/cube.start.json"), "--goal", source("models/cube.goal.json"),
            )
            # A shake that adapted forces resist and a fixed squeeze does not.
            self.run_program(
                "validate", "--object", cube, "--plan", plan, "--output", out, "--frames", "none",
                "--disturbance", "both,limits,0.08",
            )
            report = validate_schema.load(out / "report.json")
        causes = [index for index, step in enumerate(report["steps"]) if step["cause"]]
        self.assertTrue(causes)
        self.assertTrue(all(step["stress"] for step in report["steps"]))
        self.expect_refused("report", report, [
            (["settings", "protocol"], "none"),
            (["margins", "friction"], REMOVED),
            (["margins", "weakest_finger", "step"], REMOVED),
            (["margins", "stress", "direction"], "up"),
            (["steps", 0, "simulation", "motion_m"], -1),
            (["steps", 0, "simulation", "cone_margin_deg", "rest"], REMOVED),
            (["steps", 0, "simulation", "fingers", 0, "finger"], "thumb"),
            (["steps", 0, "protocols", "adapted", "verdict"], "maybe"),
            (["steps", 0, "protocols", "fixed", "give_m"], REMOVED),
            (["steps", 0, "protocols", "loose"], {}),
            (["steps", 0, "protocols"], {}),
            (["steps", 0, "stress", 0, "replay"], -1),
            (["steps", 0, "stress"], []),
            (["steps", 0, "weakest_finger", "margin_deg"], REMOVED),
            (["steps", causes[0], "cause", "cause"], "bad luck"),
            (["steps", causes[0], "cause", "text"], ""),
        ])

    def test_wrong_grasps_are_refused(self):
        grasp = validate_schema.load(source("models/cube.start.json"))
        self.expect_refused("grasp", grasp, [
            (["format"], "regrasp-plan"),
            (["version"], 2),
            (["contacts"], []),
            (["contacts"], REMOVED),
            (["contacts", 0], None),
            (["contacts", 0, "point"], REMOVED),
            (["contacts", 0, "point"], [1]),
            (["contacts", 0, "point", 0], "1"),
            (["contacts", 0, "point", 0], 1e200),
            (["contacts", 0, "normal"], [0, 0, 1, 0]),
        ])

    def test_wrong_goals_are_refused(self):
        facing = {"axis": "+x", "direction": "up", "tolerance_deg": 30}
        pose = {"position": [0, 0, 0.12], "quaternion": [1, 0, 0, 0]}
        goals = {"format": "regrasp-goals", "version": 1, "goals": [
            {"name": "a", "facing": facing},
            {"name": "b", "pose": pose, "tolerance_m": 0.005, "tolerance_deg": 10}]}
        self.expect_refused("goals", goals, [
            (["format"], "regrasp-plan"),
            (["more"], 1),
            (["goals"], []),
            (["goals", 0, "name"], REMOVED),
            (["goals", 0, "name"], ""),
            (["goals", 0, "facing", "axis"], "up"),
            (["goals", 0, "facing", "direction"], "left"),
            (["goals", 0, "facing", "tolerance_deg"], -1),
            (["goals", 0, "facing", "tolerance_deg"], REMOVED),
            (["goals", 0, "pose"], pose),
            (["goals", 0, "tolerance_deg"], 10),
            (["goals", 1, "pose", "quaternion"], [1, 0, 0]),
            (["goals", 1, "tolerance_m"], 0),
            (["goals", 1, "yaw"], 0),
        ])

    def test_wrong_plans_are_refused(self):
        plan = validate_schema.load(
            source("tests/data/plans/plan_good/cube_switches_and_align.json")
        )
        self.expect_refused("plan", plan, [
            *[([key], REMOVED) for key in plan],
            *[(["object", key], REMOVED) for key in plan["object"]],
            (["object", "dimension"], 2),
            (["object", "sha256"], "F" * 64),
            (["friction", "half_angle_deg"], 90),
            (["fingers"], 65),
            (["finger_radius"], 0),
            (["finger_radius"], "0.01"),
            (["initial", "contacts", 0, "finger"], REMOVED),
            (["initial", "contacts", 0, "normal"], REMOVED),
            (["initial", "contacts", 0, "point"], [0, 0]),
            (["steps", 0, "kind"], "jump"),
            (["steps", 0, "kind"], "align"),
            (["steps", 0, "place", 0, "point"], [0, 0]),
            (["steps", 0, "release"], [-1]),
            (["steps", 0, "release"], REMOVED),
            (["steps", 2, "waypoints", 1], REMOVED),
            (["steps", 2, "waypoints", 0, "contacts", 0, "normal"], [0, 1]),
            (["goal", "contacts", 0, "point"], None),
        ])

    def test_wrong_reports_are_refused(self):
        self.expect_refused("report", REPORT, [
            *[([key], REMOVED) for key in REPORT if key != "run"],
            (["run"], "0" * 64),
            (["run", "sha256"], "abc"),
            (["run", "files"], REMOVED),
            (["run", "files", 0, "file"], REMOVED),
            (["run", "files", 0, "sha256"], "1"),
            (["run", "report_sha256"], REMOVED),
            (["run", "report_sha256"], 2),
            *[(["steps", 0, key], REMOVED) for key in REPORT["steps"][0]],
            (["verdict"], "maybe"),
            (["verdict"], "pass"),
            (["steps"], []),
            (["steps", 0, "kind"], "switch"),
            (["steps", 1, "kind"], "hold"),
            (["steps", 0, "reason"], "slipped"),
            (["steps", 1, "reason"], None),
            (["steps", 1, "reason"], "bad luck"),
            (["steps", 1, "verdict"], "pass"),
            (["steps", 0, "force_closure", "holds"], "yes"),
            (["steps", 0, "force_closure", "required_half_angle_deg"], 90),
            (["steps", 0, "simulation", "slip_m"], -1),
        ])

    def test_wrong_summaries_are_refused(self):
        self.expect_refused("summary", SUMMARY, [
            *[([key], REMOVED) for key in SUMMARY],
            *[(["plans", 0, key], REMOVED) for key in SUMMARY["plans"][0]],
            *[(["counts", key], REMOVED) for key in SUMMARY["counts"]],
            (["verdict"], "maybe"),
            (["counts", "pass"], -1),
            (["plans"], []),
            (["plans", 0, "verdict"], "fail"),
            (["plans", 0, "verdict"], "error"),
            (["plans", 0, "message"], "no"),
            (["plans", 0, "report"], None),
            (["plans", 0, "required_half_angle_deg"], 90),
            (["plans", 1, "reason"], None),
            (["plans", 1, "failed_step"], None),
            (["plans", 1, "verdict"], "pass"),
            (["plans", 2, "message"], None),
            (["plans", 2, "steps"], 3),
            (["skipped", 0, "why"], REMOVED),
        ])

    def test_wrong_trials_and_aligns_of_reports_are_refused(self):
        report = copy.deepcopy(REPORT)
        report["trials"] = {
            "count": 100, "seed": 0, "position_noise": 0.01, "friction_error": 0.1,
            "mass_error": 0.1, "min_pass_rate": 0.9, "passed": 93, "verdict": "pass",
            "share": 0.93, "confidence": 0.95,
            "interval": [0.86, 0.97], "reasons": {"slipped": 7},
            "steps": [{"index": 1, "failed": 7}],
        }
        step = report["steps"][0]
        step["align_mode"] = "mixed"
        step["align_shares"] = {"imitated": 0.5, "slid": 0.5, "best_effort": 0}
        self.expect_refused("report", report, [
            *[(["trials", key], REMOVED) for key in report["trials"]],
            *[(["steps", 0, "align_shares", key], REMOVED) for key in step["align_shares"]],
            (["trials", "count"], 0), (["trials", "share"], 1.5), (["trials", "interval"], [0.5]),
            (["trials", "min_pass_rate"], 0), (["trials", "verdict"], "skipped"),
            (["trials", "reasons"], {"tired": 1}), (["trials", "steps"], [{"index": 1}]),
            (["steps", 0, "align_mode"], "dragged"), (["settings", "align"], "fly"),
        ])

    def test_wrong_graphs_are_refused(self):
        self.expect_refused("graph", GRAPH, [
            *[([key], REMOVED) for key in GRAPH],
            (["planner"], "guess"),
            (["faces"], -1),
            (["types"], {}),
            (["types", "concurrent", "vertices"], REMOVED),
            (["types", "skew"], {"candidates": 0, "combinations": 0, "vertices": 0}),
            (["edges", "concurrent"], 1),
            (["vertices"], 1.5),
            (["seconds", "edges"], REMOVED),
        ])

    def test_the_script_tells_good_files_from_bad_ones(self):
        good = source("models/cube.start.json")
        grasp_schema = source("docs/grasp.schema.json")
        bad = source("tests/data/plans/grasp_bad/is_a_plan.json")
        self.assertEqual(validate_schema.main([grasp_schema, good, good]), 0)
        self.assertEqual(validate_schema.main([grasp_schema, good, bad]), 1)
        self.assertEqual(validate_schema.main([grasp_schema, source("no/such/file.json")]), 1)
        self.assertEqual(validate_schema.main([good, good]), 2)
        self.assertEqual(validate_schema.main([grasp_schema]), 2)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--programs", required=True)
    parser.add_argument("--source", required=True)
    _, rest = parser.parse_known_args(namespace=ARGUMENTS)
    unittest.main(argv=[sys.argv[0], *rest])


if __name__ == "__main__":
    main()
