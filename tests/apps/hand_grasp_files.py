"""A gripper with two prismatic fingers, a box between them, and grasps of it: known answers by construction."""

import json
import os

GRIPPER = """<mujoco model="gripper">
  <compiler angle="radian" autolimits="true"/>
  <default>
    <joint type="slide" range="0 0.05" damping="20" armature="0.1"/>
    <position kp="500" ctrlrange="0 0.05" forcerange="-10 10"/>
    <geom density="500"/>
  </default>
  <worldbody>
    <body name="palm">
      <geom type="box" size="0.06 0.02 0.01" pos="0 0 -0.01"/>
      <body name="left" pos="-0.05 0 0.05">
        <joint name="left_slide" axis="1 0 0"/>
        <geom type="box" size="0.005 0.01 0.01"/>
      </body>
      <body name="right" pos="0.05 0 0.05">
        <joint name="right_slide" axis="-1 0 0"/>
        <geom type="box" size="0.005 0.01 0.01"/>
      </body>
    </body>
  </worldbody>
  <actuator>
    <position joint="left_slide"/>
    <position joint="right_slide"/>
  </actuator>
</mujoco>
"""

# Half of the edge of the box, m. The fingers touch it at TOUCH.
HALF, TOUCH = 0.02, 0.025

TARGET = {"joints": {"left_slide": 0.04, "right_slide": 0.04}}


def box():
    """Return the box as OBJ."""
    corners = [(x, y, z) for x in (-HALF, HALF) for y in (-HALF, HALF) for z in (-HALF, HALF)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    return "".join("v %g %g %g\n" % corner for corner in corners) + "".join(
        "f %d %d %d %d\n" % face for face in faces)


def write_hand(folder):
    """Write gripper.xml, gripper.json and objects/box.obj."""
    os.makedirs(os.path.join(folder, "objects"), exist_ok=True)
    for name, text in (("gripper.xml", GRIPPER), ("objects/box.obj", box()),
                       ("gripper.json", json.dumps({"format": "regrasp-hand", "version": 1, "name": "gripper",
                                                    "model": "gripper.xml", "palm": "palm"}))):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


def grasp(name, position=TOUCH, **more):
    """Return a grasp with both fingers at `position`; `more` replaces or adds members."""
    return {"format": "regrasp-hand-grasp", "version": 1, "id": name,
            "object": {"file": "box.obj", "scale": 1},
            "palm": {"position": [0, 0, -0.05], "quaternion": [1, 0, 0, 0]},
            "joints": {"left_slide": position, "right_slide": position}, **more}


def lines(grasps):
    """Return grasps as JSON Lines."""
    return "".join(json.dumps(grasp) + "\n" for grasp in grasps)
