"""The program hand from the shell: recognition of models, output, and errors."""

import json
import os

import program_case
from program_case import ProgramCase


def finger(name, place):
    """Return two links along z that bend towards +y."""
    return f"""<body name="{name}_proximal" pos="{place}">
      <joint name="{name}_mcp" axis="-1 0 0" range="-10 90" actuatorfrcrange="-0.5 0.5"/>
      <geom type="capsule" size="0.008" fromto="0 0 0 0 0 0.04"/>
      <body name="{name}_distal" pos="0 0 0.04">
        <joint name="{name}_dip" axis="-1 0 0" range="0 90"/>
        <geom type="capsule" size="0.007" fromto="0 0 0 0 0 0.02"/>
      </body></body>"""


# Model for a newer MuJoCo.
NEWER = f"""<mujoco model="claw">
  <option integrator="implicitfast"/>
  <worldbody><body name="palm"><geom type="box" size="0.05 0.01 0.03"/>
    {finger("left", "-0.04 0 0.03")} {finger("middle", "0 0 0.03")} {finger("right", "0.04 0 0.03")}
  </body></worldbody>
  <actuator>
    <position name="a" joint="left_mcp" kp="2" dampratio="1" inheritrange="1"/>
    <position name="b" joint="middle_mcp" kp="2" kv="0.1"/>
  </actuator>
</mujoco>"""


class Hand(ProgramCase):
    program = "hand"

    def test_a_model_is_described_and_what_was_converted_is_listed(self):
        self.write("claw.xml", NEWER)
        os.mkdir(self.path("hands"))
        done = self.assert_done("--model", "claw.xml", "--output", "hands/claw.json")
        for words in ("palm  palm", "up    +y of the palm", "implicitfast to implicit",
                      "inheritrange", "dampratio", "kv", "actuatorfrcrange", "autolimits",
                      "claw.xml:2 ", "left_dip, middle_dip, right_mcp, right_dip have no actuator"):
            self.assertIn(words, done.stdout)
        hand = json.loads(self.read("hands/claw.json"))
        self.assertEqual(hand["model"], "../claw.xml")
        self.assertEqual([f["name"] for f in hand["fingers"]], ["left", "middle", "right"])
        self.assertEqual(hand["fingers"][0]["tip"],
                         {"body": "left_distal", "centre": [0, 0, 0.02], "radius": 0.007})

    def test_what_it_writes_it_reads_and_says_the_same(self):
        self.write("claw.xml", NEWER)
        self.assert_done("--model", "claw.xml", "--output", "hand.json", "--quiet")
        first = self.read("hand.json")
        done = self.assert_done("--model", "hand.json", "--output", "again.json")
        self.assertEqual(self.read("again.json"), first)
        self.assertIn("palm  palm", done.stdout)

    def test_hands_of_the_project_have_pictures_with_the_same_bytes(self):
        model = self.model("hands/ring5.json")
        for name in ("one.png", "two.png"):
            done = self.assert_done("--model", model, "--picture", name, "--quiet")
            self.assertFalse(done.stdout)
        with open(self.path("one.png"), "rb") as one, open(self.path("two.png"), "rb") as two:
            picture = one.read()
            self.assertEqual(picture, two.read())
        self.assertTrue(picture.startswith(b"\x89PNG"))
        self.assertGreater(len(picture), 20_000)

    def urdf(self, limit='effort="1"', look="", mimic=""):
        """Return a URDF with three fingers of two links on a palm."""
        inertial = ('<inertial><mass value="0.02"/><inertia ixx="1e-5" iyy="1e-5" izz="1e-5" '
                    'ixy="0" ixz="0" iyz="0"/></inertial>')
        links = [f'<link name="palm">{inertial}{look}<collision><geometry>'
                 '<cylinder radius="0.06" length="0.02"/></geometry></collision></link>']
        for name, place in (("f", "0.05 0 0.03"), ("g", "-0.03 0.05 0.03"),
                            ("h", "-0.03 -0.05 0.03")):
            for part, parent, origin in (("1", "palm", place), ("2", name + "1_link", "0 0 0.04")):
                joint = name + part
                links.append(
                    f'<link name="{joint}_link">{inertial}<collision><origin xyz="0 0 0.03"/>'
                    '<geometry><sphere radius="0.01"/></geometry></collision></link>'
                    f'<joint name="{joint}" type="revolute"><parent link="{parent}"/>'
                    f'<child link="{joint}_link"/><origin xyz="{origin}"/><axis xyz="0 1 0"/>'
                    f'<limit lower="-0.5" upper="1.5" velocity="6" {limit}/>'
                    f'{mimic if joint == "f2" else ""}</joint>')
        return f'<robot name="ring">{"".join(links)}</robot>'

    def test_couplings_are_written_with_their_offset_or_refused(self):
        self.write("ring.urdf",
                   self.urdf(mimic='<mimic joint="f1" multiplier=" +1.1169 " offset="-0.15"/>'))
        self.assert_done("--model", "ring.urdf", "--output", "hand.json")
        hand = json.loads(self.read("hand.json"))
        self.assertEqual(hand["couplings"], [
            {"joint": "f2", "follows": "f1", "ratio": 1.1169, "offset": -0.15}])
        del hand["couplings"]
        self.write_json("hand.json", hand)
        self.assert_refused(2, ["hand.json: /couplings", "f2", "<mimic>", "found none"],
                            "--model", "hand.json")
        for mimic, words in (('joint="f1" multiplier="1,1"', ["line 1", "multiplier", "1,1"]),
                             ('joint="f1" multiplier="0"', ["fixes joint f2"]),
                             ('joint="g1"', ["f2 and g1", "two fingers"]),
                             ('joint="x1"', ["f2", "x1"])):
            self.write("ring.urdf", self.urdf(mimic=f"<mimic {mimic}/>"))
            self.assert_refused(2, words, "--model", "ring.urdf", "--output", "bad.json")
            self.assertFalse(os.path.exists(self.path("bad.json")))

    def test_an_unknown_strength_is_noted(self):
        unknown = "joints f1, f2, g1, g2, h1, h2 unknown, treated as unlimited"
        self.write("ring.urdf", self.urdf(limit='effort=" 1.5"'))
        done = self.assert_done("--model", "ring.urdf")
        self.assertNotIn("unlimited", done.stdout)
        self.assertIn("1.5", done.stdout)
        for limit in ("", 'effort="0"'):
            self.write("ring.urdf", self.urdf(limit=limit))
            self.assertIn(unknown, self.assert_done("--model", "ring.urdf").stdout)

    def test_looks_that_are_missing_are_left_out_in_the_current_folder_too(self):
        for mesh in ("package://no_pkg/nowhere.obj", "meshes/nowhere.stl"):
            self.write("ring.urdf", self.urdf(
                look=f'<visual><geometry><mesh filename="{mesh}"/></geometry></visual>'))
            for model in ("ring.urdf", "./ring.urdf"):
                done = self.assert_done("--model", model, "--output", "hand.json")
                self.assertIn("left out, visual only: ", done.stdout)
                self.assertIn("no such file", done.stdout)
            self.assert_done("--model", "hand.json", "--picture", "hand.png")

    def test_xacro_is_refused(self):
        self.write("ring.urdf.xacro", self.urdf(limit='effort="${effort}"'))
        self.assert_refused(2, ["ring.urdf.xacro: line 1", "xacro is not expanded",
                                "xacro ring.urdf.xacro > hand.urdf"],
                            "--model", "ring.urdf.xacro", "--output", "hand.json")
        self.assertFalse(os.path.exists(self.path("hand.json")))

    def test_what_is_no_hand_is_refused_in_one_line(self):
        self.write("ball.xml", '<mujoco><worldbody><geom size="1"/></worldbody></mujoco>')
        self.assert_refused(2, ["ball.xml", "found 0 fingers"], "--model", "ball.xml")
        self.write("cut.xml", "<mujoco>\n<worldbody>")
        self.assert_refused(2, ["cut.xml: line 2"], "--model", "cut.xml")
        self.write("many.xml", NEWER.replace("<worldbody>", "<worldbody><replicate/>"))
        self.assert_refused(2, ["many.xml: line 3", "replicate"], "--model", "many.xml")
        self.assert_refused(2, "no.xml", "--model", "no.xml")
        self.write("hand.json", '{"format": "regrasp-grasp", "version": 1}')
        self.assert_refused(2, "hand.json", "--model", "hand.json")
        self.write("claw.xml", NEWER)
        self.assert_refused(2, "--output", "--model", "claw.xml", "--output", "claw.xml")


if __name__ == "__main__":
    program_case.main()
