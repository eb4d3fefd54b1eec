"""Run every command of every documentation page.

The commands of a page run one after the other in their own folder, which contains the models and
the files that the page assumes.
"""

import glob
import os
import re
import subprocess

import hand_grasp_files
import program_case
from program_case import ProgramCase

# Path of regrasp-convert, which is built with the Python module only.
CONVERTER = os.environ.get("REGRASP_CONVERTER", "")

# Replacements that shorten a run of an hour.
SHORTER = [("--export-states 100000", "--export-states 3")]

CUBE = """plan --quiet --object models/cube.obj --friction-angle 20 --start models/cube.start.json \
--goal models/cube.goal.json --output plan.json
"""
TURN = """plan --quiet --hand models/hands/ring4.json --object models/cube.obj --mu 0.8 --turn z,30 \
--output turn.json
"""

# Reference pages of the commands, with the files that their examples must create.
COMMANDS = {
    "commands": [],
    "command_plan": ["plan.json"],
    "command_validate": ["out/plan/report.html", "junit.xml"],
    "command_graph": ["graph.json"],
    "command_figure": ["figures/sheet.pdf"],
    "command_repair": ["solid.obj", "repair.json"],
    "command_merge": ["plans.jsonl", "reports.jsonl"],
    "command_evaluate": ["reports.jsonl"],
    "command_hand": ["hand.json", "hand.png"],
}

# Files that the examples of the commands assume.
EXAMPLES = ("cp models/*.obj models/*.wkt .; cp models/cube.start.json start.json; "
            "cp models/cube.goal.json goal.json; cp models/cube.obj part.obj; mkdir plans\n"
            + CUBE + "cp plan.json plans; cp plan.json cube.json; mkdir -p shards/1\n"
            "echo '{\"object\": {\"file\": \"cube.obj\"}}' > queries.jsonl\n"
            "plan --quiet --object . --batch queries.jsonl --mu 0.5 --start random --goal random "
            "--output shards/plans.1.jsonl\n"
            "validate --quiet --object . --plan shards/plans.1.jsonl --output shards/1\n"
            "cp models/hands/ring4.xml "
            "right_hand.xml\nplan --quiet --object models/polygon15.wkt --friction-angle 20 --planner "
            "polygon --start models/polygon15.start.json --goal models/polygon15.goal.json "
            "--output polygon15.json\n")

# Commands that create the user's files of a page.
GIVEN = {
    "analytic_check": CUBE,
    "export_hand_plan": TURN,
    "figures": "cp models/mug1000.obj .\n",
    "conditions": TURN,
    "hand_engines": TURN,
    "hand_replay": TURN,
    "make_a_figure": CUBE,
    "protocols_and_engines": CUBE,
    "robustness_trials": CUBE,
    **{name: EXAMPLES for name in COMMANDS},
}

# Files that a page must create.
LEFT = {
    "first_picture": ["out/plan/report.html", "out/plan/overview.png", "out/weak/report.json", "out/turn/replay.webp"],
    "trust_a_plan": ["out/plan/report.html", "out/weak/report.json", "out/proof/report.json"],
    "guard_a_library": ["out/junit.xml", "out/plans/summary.json", "out/plans/index.html"],
    "many_plans": ["plans.jsonl", "out/plans/reports.jsonl", "merged.jsonl", "reports.jsonl"],
    "make_a_figure": ["figures/sheet.pdf", "out/large/000_hold.png"],
    "hands": ["hand.png", "facing.json", "next.json", "scene/scene.xml", "turn.mcap", "turn.yaml", "states/states.npz"],
    "interchange": ["grasps.npz", "turn.mcap", "hidex.json"],
    "figures": ["figures/sheet.pdf", "figures/contact_space.png"],
    "objects": ["solid.obj", "repair.json"],
    **COMMANDS,
    "analytic_check": ["out/plan/report.json"],
    "diagnose_a_failure": ["out/cube.start/report.html"],
    "evaluate_grasps": ["reports.jsonl", "reports.html"],
    "export_hand_plan": ["turn.npz", "scene/scene.xml"],
    "conditions": ["out/turn/report.html"],
    "hand_engines": ["out/turn/report.html"],
    "hand_replay": ["out/turn/report.html"],
    "rolling": ["turn.json", "out/turn/report.html"],
    "rotate_a_cube": ["out/half/report.html", "out/slippery/report.json"],
    "robustness_trials": ["out/plan/report.json"],
    "protocols_and_engines": ["out/plan/report.json"],
    "reset_states": ["states/states.npz", "scene/scene.xml"],
    "plan_between_grasps": ["between.json", "out/between/report.html", "plans.jsonl"],
}


def commands_of(page):
    """Return the page's shell blocks; a command with a comment about exit code 1 must have it."""
    blocks = re.findall(r"^```sh\n(.*?)^```", page, re.DOTALL | re.MULTILINE)
    return [re.sub(r"^(#.* Exit code 1\.\n)(.*)$", r"\1code=0; \2 || code=$?; [ $code -eq 1 ]", block,
                   flags=re.MULTILINE) for block in blocks]


def pages():
    """Return the text of the pages with commands, by name."""
    found = {}
    for path in glob.glob(os.path.join(program_case.ARGUMENTS.source, "docs", "*.md")):
        with open(path, encoding="utf-8") as file:
            text = file.read()
        if commands_of(text):
            found[os.path.basename(path)[:-3]] = text
    return found


class Pages(ProgramCase):
    def run_block(self, block):
        path = os.pathsep.join(filter(None, (program_case.ARGUMENTS.programs, CONVERTER,
                                             os.environ["PATH"])))
        return subprocess.run(["bash", "-euo", "pipefail", "-c", block], cwd=self.folder, text=True,
                              capture_output=True, check=False, env={
                                  **os.environ, "PATH": path, "PYTHONPATH": CONVERTER},
                              timeout=program_case.HANG_SECONDS)

    def triangles(self):
        """Return the triangles of models/cube.obj, with subdivided faces, in metres: corners by
        triangle."""
        with open(self.model("cube.obj"), encoding="utf-8") as file:
            rows = [line.split() for line in file]
        corners = [[float(x) for x in row[1:]] for row in rows if row[:1] == ["v"]]
        for row in rows:
            if row[:1] == ["f"]:
                face = [corners[int(word.split("/")[0]) - 1] for word in row[1:]]
                for i in range(1, len(face) - 1):
                    yield from self.cut([face[0], face[i], face[i + 1]], 3)

    def cut(self, triangle, times):
        if times == 0:
            return [triangle]
        a, b, c = triangle
        ab, bc, ca = ([(x + y) / 2 for x, y in zip(p, q)] for p, q in ((a, b), (b, c), (c, a)))
        return [t for part in ([a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca])
                for t in self.cut(part, times - 1)]

    def write_objects(self):
        """Write a scan with a hole, a part in millimetres, and an intact next to a broken cube."""
        triangles = list(self.triangles())
        open_ones = triangles[1:]
        rows = [" ".join(map(str, corner)) for triangle in open_ones for corner in triangle]
        self.write("scan.ply", "ply\nformat ascii 1.0\n" f"element vertex {len(rows)}\n"
                   "property double x\nproperty double y\nproperty double z\n"
                   f"element face {len(open_ones)}\nproperty list uchar int vertex_indices\nend_header\n"
                   + "\n".join(rows) + "\n"
                   + "".join(f"3 {3 * i} {3 * i + 1} {3 * i + 2}\n" for i in range(len(open_ones))))
        facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join(
            "vertex " + " ".join(str(1000 * x) for x in corner) + "\n" for corner in triangle)
            + "endloop\nendfacet\n" for triangle in triangles)
        self.write("part.stl", f"solid part\n{facets}endsolid part\n")
        both = triangles + [[[x + 1, y, z] for x, y, z in triangle] for triangle in open_ones]
        self.write("pieces.obj", "".join(f"v {x} {y} {z}\n" for t in both for x, y, z in t)
                   + "".join(f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}\n" for i in range(len(both))))

    def write_hidex(self):
        """Write a plan in which three fingers pinch the cube and a fourth takes over from one."""
        away, pose = "nan, nan, nan, 0, 0, 0", "0, 0, 0, 0, 0, 0, 1"
        pinch = ".03, 0, .01, -1, 0, 0, -.03, 0, .01, 1, 0, 0"
        self.write("hidex.csv", f"{pinch}, 0, .03, 0, 0, -1, 0, {away}, {pose}\n"
                   f"{pinch}, {away}, 0, -.03, 0, 0, 1, 0, {pose}\n")

    def write_hand_grasps(self):
        """Write a hand, an object and a grasp that holds it."""
        hand_grasp_files.write_hand(self.folder)
        os.rename(self.path("gripper.json"), self.path("hand.json"))
        self.write("grasps.jsonl", hand_grasp_files.lines([
            hand_grasp_files.grasp("hold", target=hand_grasp_files.TARGET, claimed=True)]))

    def test_every_command_runs_and_leaves_what_the_page_says(self):
        found = pages()
        self.assertEqual(sorted(found), sorted(LEFT), "a page that has commands is to say what it leaves")
        for name, text in sorted(found.items()):
            if not CONVERTER and "regrasp-convert" in "".join(commands_of(text)):
                continue
            with self.subTest(page=name):
                self.setUp()
                os.symlink(self.model(""), self.path("models"))
                self.write_objects()
                self.write_hidex()
                if name in ("command_evaluate", "evaluate_grasps"):
                    self.write_hand_grasps()
                for block in [GIVEN.get(name, ""), *commands_of(text)]:
                    for long, short in SHORTER:
                        block = block.replace(long, short)
                    done = self.run_block(block)
                    self.assertEqual(done.returncode, 0, block + done.stdout + done.stderr)
                for left in LEFT[name]:
                    self.assertTrue(os.path.exists(self.path(left)), left)

    def test_a_command_that_fails_or_does_not_fail_as_said_is_found(self):
        for text, code in (("true", 0), ("false", 1), ("# Fails. Exit code 1.\nfalse", 0),
                           ("# Fails. Exit code 1.\ntrue", 1), ("# Exit code 1.\n(exit 2)", 1)):
            block, = commands_of(f"```sh\n{text}\n```\n")
            self.assertEqual(self.run_block(block).returncode, code, block)


if __name__ == "__main__":
    program_case.main()
