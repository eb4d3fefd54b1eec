"""The program hand from the shell: what it finds in models, what it writes, what it refuses."""

import json
import os

import program_case
from program_case import ProgramCase


def finger(name, place):
    """Two links along z that bend towards +y."""
    return f"""<body name="{name}_proximal" pos="{place}">
      <joint name="{name}_mcp" axis="-1 0 0" range="-10 90" actuatorfrcrange="-0.5 0.5"/>
      <geom type="capsule" size="0.008" fromto="0 0 0 0 0 0.04"/>
      <body name="{name}_distal" pos="0 0 0.04">
        <joint name="{name}_dip" axis="-1 0 0" range="0 90"/>
        <geom type="capsule" size="0.007" fromto="0 0 0 0 0 0.02"/>
      </body></body>"""


# Written for a newer MuJoCo.
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
                      "claw.xml:2 ", "joint left_dip has no actuator"):
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
