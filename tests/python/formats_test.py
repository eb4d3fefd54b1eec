"""Grasps by hands in third-party formats. The tests write the files according to the formats'
documents."""

import contextlib
import io
import json
import os
import pickle
import shutil
import subprocess
import tempfile
import unittest

import numpy as np

import regrasp
from regrasp import _poses, convert, formats
from isaac_text import ISAAC
from regrasp_case import PROGRAMS, RegraspCase

HAND = "models/hands/ring4.json"
CUBE = "models/cube.obj"


class Trap:
    """Object whose unpickling has a visible effect."""

    def __reduce__(self):
        return os.mkdir, (os.path.join(tempfile.gettempdir(), "regrasp-unpickled"),)


class FormatsTest(RegraspCase):

    @classmethod
    def setUpClass(cls):
        cls.shared = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.shared.cleanup)
        cls.plan = os.path.join(cls.shared.name, "plan.json")
        subprocess.run([f"{PROGRAMS}/plan", "--hand", HAND, "--object", CUBE, "--mu", "0.8",
                        "--turn", "z,30", "--output", cls.plan, "--quiet"], check=True)
        cls.hand = regrasp.Hand.read(HAND)
        cls.cube = regrasp.Object.read(CUBE)
        cls.grasps = formats.of_plan(cls.plan, cls.hand)

    def path(self, name, text=None):
        path = super().path(name)
        if text is not None:
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        return path

    def assert_same(self, found, tolerance=1e-12):
        """Compare up to the rounding of a rotation and its inverse."""
        np.testing.assert_allclose(found.positions, self.grasps.positions, atol=tolerance)
        np.testing.assert_allclose(_poses.matrices(found.quaternions),
                                   _poses.matrices(self.grasps.quaternions), atol=tolerance)
        np.testing.assert_array_equal(found.in_order_of(self.hand), self.grasps.joints)

    def test_fingertips_of_a_plan_touch_where_the_plan_says(self):
        points, normals, touching = self.grasps.touching(self.hand, self.cube, tolerance=1e-5)
        held = regrasp.Plan.read(self.plan).data["initial"]["contacts"]
        self.assertEqual([c["finger"] for c in held], list(np.flatnonzero(touching[0])))
        for contact in held:
            np.testing.assert_allclose(points[0, contact["finger"]], contact["point"], atol=1e-6)
            np.testing.assert_allclose(normals[0, contact["finger"]], contact["normal"], atol=1e-9)
        self.assertFalse(self.grasps.touching(self.hand, self.cube, tolerance=1e-15)[2].all())

    def test_a_notebook_shows_grasps_of_hands(self):
        page = self.grasps._repr_html_()
        self.assertEqual(page.count("<tr>"), 1 + len(self.grasps))
        self.assertIn("not converted: contacts", page)

    def test_isaac_grasp_comes_back_bit_for_bit(self):
        path = self.path("grasps.yaml")
        formats.write_isaac_grasp(path, self.grasps)
        found = formats.read_isaac_grasp(path)
        for name in ("positions", "joints", "confidence"):
            np.testing.assert_array_equal(getattr(found, name), getattr(self.grasps, name))
        self.assert_same(found)
        self.assertEqual((found.names, found.joint_names),
                         (self.grasps.names, self.hand.joint_names))
        self.assertEqual(found.lost, [])

    def test_isaac_grasp_as_its_document_has_it(self):
        found = formats.read_isaac_grasp(self.path("grasps.yaml", ISAAC))
        self.assertEqual(found.names, ["first", "second"])
        self.assertEqual(found.joint_names, ["b", "a"])
        np.testing.assert_array_equal(found.joints, [[0.25, -1], [5, 4]])
        np.testing.assert_array_equal(found.quaternions, [[0, 0.6, 0.8, 0], [1, 0, 0, 0]])
        np.testing.assert_array_equal(found.positions, [[-0.04, 0.06, 0.2], [1, 2, 3]])
        np.testing.assert_array_equal(found.confidence, [0.5, 1])
        self.assertEqual(found.lost, ["pregrasp_cspace_position"])

    def test_isaac_grasp_that_is_wrong_is_named(self):
        for change, words in [
                (("isaac_grasp", "other"), ["format", "'other'"]),
                (("1.0", "2.0"), ["format_version", "2.0"]),
                (("[1, 2, 3]", "[1, 2]"), ["grasps: second: position", "3 numbers"]),
                (("[1, 2, 3]", "[1, 2, x]"), ["grasps: second: position"]),
                (("[1, 2, 3]", "[1, 2, .nan]"), ["grasps: second: position", "must be finite"]),
                (("xyz: [0, 0, 0]", "xyz: [0, 0, 2]"), ["grasps: second: orientation must be a unit quaternion", "2.236"]),
                (("w: 1.0, ", ""), ["grasps: second: orientation", "w not found"]),
                (("{a: 4, b: 5}", "{a: 4}"), ["grasps: second: cspace_position"]),
                (("{a: 4, b: 5}", "{a: 4"), ["not a YAML file"]),
                (("  second:", "  !!python/object/apply:os.getcwd []\n  second:"), ["not a YAML file"])]:
            with self.subTest(change=change):
                self.assertIn(change[0], ISAAC)
                path = self.path("bad.yaml", ISAAC.replace(*change))
                self.refuses([path, *words], formats.read_isaac_grasp, path)
        self.refuses(["mapping"], formats.read_isaac_grasp, self.path("list.yaml", "[]"))

    def world_poses(self):
        """Return poses of the object and the palms in a world frame that differs from both."""
        object_pose = np.array([0.3, -0.2, 0.1, 0.5, 0.5, -0.5, 0.5])
        turn = _poses.matrices(object_pose[3:])
        palms = np.concatenate([
            self.grasps.positions @ turn.T + object_pose[:3],
            _poses.product(np.broadcast_to(object_pose[3:], (len(self.grasps), 4)),
                             self.grasps.quaternions)], axis=1)
        return object_pose, palms

    def test_dictionaries_of_dexgraspbench(self):
        object_pose, palms = self.world_poses()
        path = self.path("0.npy")
        data = {"obj_pose": object_pose, "obj_scale": 0.06, "obj_path": "cube", "squeeze_qpos": 0,
                "grasp_qpos": np.concatenate([palms, self.grasps.joints], axis=1)}
        np.save(path, data)
        found = formats.read_dexgraspbench(path)
        self.assert_same(found)
        self.assertEqual(found.lost, ["obj_path", "obj_scale, to be given as --scale 0.06",
                                      "squeeze_qpos"])
        # One grasp, with its joint names in another order.
        np.save(path, {**data, "grasp_qpos": np.concatenate([palms[0], self.grasps.joints[0][::-1]]),
                       "joint_names": self.hand.joint_names[::-1]})
        one = formats.read_dexgraspbench(path)
        np.testing.assert_array_equal(one.in_order_of(self.hand), self.grasps.joints[:1])

    def bodex(self):
        """Return the dictionary that BODex saves of the plan's grasps: a leading axis of one,
        grasps, three stages."""
        object_pose, palms = self.world_poses()
        grasps = np.concatenate([palms, self.grasps.joints], axis=1)
        stages = np.stack([grasps + 0.1, grasps, grasps + 0.2], axis=1)
        return {"robot_pose": stages[None], "obj_pose": object_pose[None], "obj_scale": [0.06],
                "joint_names": list(self.hand.joint_names), "contact_force": np.ones((1, 2, 3)),
                "world_cfg": [{"mesh": {"name": "cube", "scale": [1., 1, 1]}}]}

    def test_files_of_bodex(self):
        data, path = self.bodex(), self.path("cube_grasp.npy")
        np.save(path, data)
        found = formats.read_bodex(path)
        self.assert_same(found)
        self.assertEqual(found.lost, ["contact_force", "obj_scale, to be given as --scale 0.06",
                                      "world_cfg", "all stages of robot_pose but the second"])
        np.savez(self.path("grasp.npz"), **data)
        self.assert_same(formats.read_bodex(self.path("grasp.npz")))
        # The object's pose may be elsewhere in the dictionary.
        pose = data.pop("obj_pose")[0]
        np.save(path, data)
        self.refuses(["object_pose", path], formats.read_bodex, path)
        self.assert_same(formats.read_bodex(path, object_pose=pose))
        self.assertIn("--hand", self.convert(path, "--object-pose=" + ",".join(map(repr, pose.tolist())),
                                             "--output", self.path("a.npz"), code=2))
        self.convert(path, "--object-pose=" + ",".join(map(repr, pose.tolist())), "--output",
                     self.path("a.yaml"))
        self.assert_same(formats.read_isaac_grasp(self.path("a.yaml")))
        for change, words in [({"robot_pose": data["robot_pose"][0]}, ["robot_pose", "(1, N, stages"]),
                              ({"robot_pose": data["robot_pose"][:, :, :1]}, ["two stages"]),
                              ({"joint_names": 7}, ["joint_names", "7"]),
                              ({"obj_scale": [1, 1, 2.]}, ["obj_scale", "[1.0, 1.0, 2.0]"])]:
            np.save(path, {**data, **change})
            self.refuses([path, *words], formats.read_bodex, path, object_pose=pose)

    def test_scenes_of_dexonomy(self):
        object_pose, palms = self.world_poses()
        table = {"type": "rigid_object", "pose": np.arange(7.), "scale": np.ones(3)}
        cube = {"type": "rigid_object", "pose": object_pose, "scale": np.full(3, 0.06)}
        scene = {"scene_id": "s", "interest_obj_name": "cube", "scene": {"table": table, "cube": cube}}
        path = self.path("grasp.npy")
        qpos = np.concatenate([palms, self.grasps.joints], axis=1)
        plain = {"grasp_qpos": qpos, "pregrasp_qpos": qpos, "hand_name": "ring4"}
        np.save(path, {**plain, "scene_cfg": scene})
        found = formats.read_dexgraspbench(path)
        self.assert_same(found)
        np.testing.assert_array_equal(found.scales, np.full(len(qpos), 0.06))
        self.assertEqual(found.lost, ["hand_name", "pregrasp_qpos", "scale of scene_cfg, to be given as "
                                      "--scale 0.06", "scene_cfg but the object's pose and scale"])
        # The name of the object may be missing if there is only one, and the scale may be a number.
        np.save(path, {**plain, "scene_cfg": {"scene": {"cube": {**cube, "scale": 0.5}}}})
        found = formats.read_dexgraspbench(path)
        self.assert_same(found)
        self.assertEqual(found.scales[0], 0.5)
        for change, words in [
                ({"interest_obj_name": "cup"}, ["scene_cfg: scene", "cup not found"]),
                ({"interest_obj_name": 3}, ["interest_obj_name", "3"]),
                ({"scene": {"cube": {**cube, "pose": [1, 2]}}}, ["scene_cfg: pose", "7"]),
                ({"scene": {"cube": {**cube, "pose": np.zeros(7)}}}, ["scene_cfg: pose must be a unit quaternion"]),
                ({"scene": {"cube": {**cube, "scale": [1, 1, 2.]}}}, ["scene_cfg: scale", "2.0"]),
                ({"scene": {"cube": {**cube, "scale": 0}}}, ["scene_cfg: scale", "0"]),
                ({"scene": [cube]}, ["scene_cfg: scene", "list"]),
                ({"scene": {"cube": {"scale": 1}}}, ["no obj_pose", "--object-pose"])]:
            with self.subTest(change=change):
                np.save(path, {**plain, "scene_cfg": {**scene, **change}})
                self.refuses([path, *words], formats.read_dexgraspbench, path)
        nameless = {"scene": {"a": cube, "b": cube}}
        np.save(path, {**plain, "scene_cfg": nameless})
        self.refuses([path, "interest_obj_name", "2"], formats.read_dexgraspbench, path)

    def test_the_pose_of_the_object_is_an_option_for_every_dictionary(self):
        object_pose, palms = self.world_poses()
        plain = {"grasp_qpos": np.concatenate([palms, self.grasps.joints], axis=1),
                 "joint_names": self.hand.joint_names}
        option = "--object-pose=" + ",".join(map(repr, object_pose.tolist()))
        path, output = self.path("plain.npy"), self.path("a.yaml")
        np.save(path, plain)
        self.assertIn("--object-pose", self.convert(path, "--output", output, code=2))
        self.convert(path, option, "--output", output)
        self.assert_same(formats.read_isaac_grasp(output))
        # A given pose replaces that of the file, which is reported.
        np.save(path, {**plain, "obj_pose": np.eye(7)[3]})
        said = self.convert(path, option, "--output", output)
        self.assertIn("pose, replaced by the one that is given", said)
        self.assert_same(formats.read_isaac_grasp(output))
        self.assertIn("found 3", self.convert(path, "--object-pose", "1,2,3", "--output", output, code=2))
        # A meaningless option is rejected, not ignored.
        for other in (output, self.plan):
            said = self.convert(other, option, "--hand", HAND, "--output", self.path("b.yaml"), code=2)
            self.assertIn("--object-pose cannot be used with", said)

    def dexgraspnet(self, scales):
        """Return the list that DexGraspNet saves of the plan's grasps, on a scaled cube of edge 1.
        """
        # Rotations about the fixed axes x, y and z: R = Rz Ry Rx.
        turns = _poses.matrices(self.grasps.quaternions)
        angles = np.stack([np.arctan2(turns[:, 2, 1], turns[:, 2, 2]), np.arcsin(-turns[:, 2, 0]),
                           np.arctan2(turns[:, 1, 0], turns[:, 0, 0])], axis=1)
        entries = []
        for i, scale in enumerate(scales):
            i %= len(self.grasps)
            # On a cube of another size the same grasp has no contacts; the first scale is that of
            # the cube.
            qpos = dict(zip(self.hand.joint_names, self.grasps.joints[i].tolist()))
            qpos |= dict(zip(["WRJTx", "WRJTy", "WRJTz"], self.grasps.positions[i].tolist()))
            qpos |= dict(zip(["WRJRx", "WRJRy", "WRJRz"], angles[i].tolist()))
            entries.append({"qpos": qpos, "scale": scale, "E_pen": 0.1})
        return entries

    def test_lists_of_dexgraspnet(self):
        path = self.path("cube.npy")
        count = len(self.grasps)
        for kind in (lambda entries: np.array(entries, dtype=object), list):
            np.save(path, kind(self.dexgraspnet([0.06] * count)))
            found = formats.read_dexgraspnet(path)
            self.assert_same(found)
            self.assertEqual(found.names[-1], f"cube_{count - 1}")
            self.assertEqual(found.lost, ["E_pen", "scale, to be given as --scale 0.06"])
        # A later grasp may have its joints in another order, and NumPy numbers.
        entries = self.dexgraspnet([0.06] * count)
        entries[-1]["qpos"] = {key: np.float64(value)
                               for key, value in reversed(list(entries[-1]["qpos"].items()))}
        np.save(path, entries)
        self.assert_same(formats.read_dexgraspnet(path))
        self.refuses([path, "list of", "read_dexgraspnet"], formats.read_dexgraspbench, path)

    def test_each_grasp_of_dexgraspnet_is_on_an_object_of_its_own_size(self):
        # A cube of edge 1, which has the size of the plan's cube at the first scale.
        unit = regrasp.Object.from_arrays(self.cube.vertices / 0.06, self.cube.triangles, name="unit.obj")
        unit.write(self.path("unit.obj"))
        path, output = self.path("unit.npy"), self.path("a.npz")
        np.save(path, self.dexgraspnet([0.06, 0.12]))
        found = formats.read_dexgraspnet(path)
        touching = found.touching(self.hand, unit)[2]
        self.assertGreaterEqual(touching[0].sum(), 3)
        self.assertFalse(touching[1].any())  # the cube has twice the size there
        said = self.convert(path, "--hand", HAND, "--object", self.path("unit.obj"), "--output", output)
        self.assertIn("0.06 of 1, 0.12 of 1", said)
        with np.load(output) as arrays:
            np.testing.assert_array_equal(arrays["grasps"], [0])
            places = unit.nearest(arrays["points"][arrays["active"]])[0]
            np.testing.assert_allclose(places, arrays["points"][arrays["active"]], atol=1e-12)
        # An object with a different size is rejected, one with the same size is accepted.
        large = regrasp.Object.read(self.path("unit.obj"), scale=0.06)
        self.refuses(["object", "found 0.06", "0.12", "unit_1"], found.touching, self.hand, large)
        np.save(path, self.dexgraspnet([0.06, 0.06]))
        same = formats.read_dexgraspnet(path).touching(self.hand, large)[2]
        self.assertTrue(same.any(axis=1).all())

    def test_lists_of_dexgraspnet_that_are_wrong_are_named(self):
        path = self.path("cube.npy")
        good = self.dexgraspnet([0.06, 0.06])

        def changed(**more):
            return [good[0], {**good[1], "qpos": {**good[1]["qpos"], **more}}]
        without = {key: value for key, value in good[1]["qpos"].items() if key != "WRJTy"}
        for entries, words in [
                ([good[0], {"qpos": good[1]["qpos"]}], ["[1]", "scale not found"]),
                ([good[0], {"scale": 1}], ["[1]", "qpos not found"]),
                ([good[0], {"scale": 1, "qpos": without}], ["[1]: qpos", "WRJTy not found"]),
                ([good[0], {"scale": -1, "qpos": good[1]["qpos"]}], ["[1]: scale", "-1"]),
                ([good[0], {"scale": 1, "qpos": [1, 2]}], ["[1]: qpos", "list"]),
                (changed(extra=1), ["[1]: qpos", "extra"]),
                (changed(WRJRx=float("nan")), ["[1]: qpos: WRJRx", "nan"]),
                (changed(WRJRx=[1, 2]), ["[1]: qpos: WRJRx", "2"]),
                (changed(WRJRx="x"), ["[1]: qpos: WRJRx"]),
                ([good[0], 7], ["[1]", "int"])]:
            with self.subTest(words=words):
                np.save(path, np.array(entries, dtype=object))
                self.refuses([path, *words], formats.read_dexgraspnet, path)
        np.save(path, good[0])
        self.refuses([path, "one dictionary"], formats.read_dexgraspnet, path)
        np.save(path, np.array([], dtype=object))
        self.refuses([path, "none"], formats.read_dexgraspnet, path)

    def test_members_of_an_archive_are_read_like_a_dictionary(self):
        object_pose, palms = self.world_poses()
        np.savez_compressed(self.path("a.npz"), obj_pose=object_pose,
                            grasp_qpos=np.concatenate([palms, self.grasps.joints], axis=1))
        self.assert_same(formats.read_dexgraspbench(self.path("a.npz")))
        np.savez(self.path("b.npz"), grasp_qpos=np.array({"not": Trap()}, dtype=object))
        self.refuses(["b.npz", "posix.mkdir"], formats.read_dexgraspbench, self.path("b.npz"))

    def test_a_dictionary_with_any_byte_changed_is_read_or_refused(self):
        object_pose, palms = self.world_poses()
        path = self.path("0.npy")
        np.save(path, {"obj_pose": object_pose, "joint_names": self.hand.joint_names,
                       "grasp_qpos": np.concatenate([palms, self.grasps.joints], axis=1)})
        with open(path, "rb") as file:
            whole = bytearray(file.read())
        rng, refused = np.random.default_rng(5), 0
        for at in rng.integers(0, len(whole), 600):
            changed = whole.copy()
            changed[at] ^= 1 << rng.integers(8)
            with open(path, "wb") as file:
                file.write(changed)
            with self.subTest(at=at):
                try:
                    formats.read_dexgraspbench(path)
                except regrasp.InputError as error:
                    self.assertNotIn("\n", str(error))
                    refused += 1
        self.assertGreater(refused, 100)

    def test_nothing_in_a_dictionary_is_executed(self):
        trapped = os.path.join(tempfile.gettempdir(), "regrasp-unpickled")
        for data in ({"grasp_qpos": Trap()}, {"grasp_qpos": np.array([Trap()])}):
            np.save(self.path("trap.npy"), data)
            self.refuses(["trap.npy", "posix.mkdir"], formats.read_dexgraspbench,
                         self.path("trap.npy"))
            self.assertFalse(os.path.exists(trapped))
        # Positive control: ordinary unpickling triggers the trap.
        np.load(self.path("trap.npy"), allow_pickle=True)
        self.assertTrue(os.path.exists(trapped))
        os.rmdir(trapped)

    def test_dictionaries_that_are_wrong_are_named(self):
        path = self.path("0.npy")
        pose = np.array([0, 0, 0, 1, 0, 0, 0.])
        for data, words in [
                ({"obj_pose": pose}, ["grasp_qpos not found"]),
                ({"grasp_qpos": np.ones(20)}, ["no obj_pose"]),
                ({"grasp_qpos": np.ones(5), "obj_pose": pose}, ["grasp_qpos", "(1, 5)"]),
                ({"grasp_qpos": np.ones(20), "obj_pose": pose}, ["grasp_qpos", "quaternion"]),
                ({"grasp_qpos": "x", "obj_pose": pose}, ["grasp_qpos", "<U1"]),
                ([1, 2], ["int64"]), ("text", ["str"])]:
            np.save(path, data)
            self.refuses([path, *words], formats.read_dexgraspbench, path)
        with open(path, "rb") as file:
            whole = file.read()
        for cut in range(0, len(whole), 7):
            with open(path, "wb") as file:
                file.write(whole[:cut])
            self.refuses([path], formats.read_dexgraspbench, path)
        with open(path, "wb") as file:
            pickle.dump({}, file)
        self.refuses([path, "expected an NPY or NPZ file of dictionaries"], formats.read_dexgraspbench, path)

    def graspit(self, palm):
        def pose(p):
            w, x, y, z = p[3:]
            a, b, c = 1000 * p[:3]
            return (f"<transform><fullTransform>({w:+.17g} {x:+.17g} {y:+.17g} {z:+.17g})"
                    f"[{a:+.17g} {b:+.17g} {c:+.17g}]</fullTransform></transform>")
        joints = " ".join(f"{angle:+.17g}" for angle in self.grasps.joints[0])
        return ('<?xml version="1.0" ?><world><obstacle><filename>table.xml</filename></obstacle>'
                f"<graspableBody><filename>cube.xml</filename>{pose(self.world_poses()[0])}"
                f"</graspableBody><robot><filename>ring4.xml</filename>"
                f"<dofValues>{joints} </dofValues>{pose(palm)}</robot></world>")

    def test_worlds_of_graspit(self):
        text = self.graspit(self.world_poses()[1][0])
        found = formats.read_graspit(self.path("grasp.xml", text))
        np.testing.assert_allclose(found.positions, self.grasps.positions[:1], atol=1e-12)
        np.testing.assert_array_equal(found.in_order_of(self.hand), self.grasps.joints[:1])
        self.assertEqual(found.lost, ["1 obstacle"])
        contacts = self.path("contacts.xml", "<virtual_contacts><robot_name>a</robot_name></virtual_contacts>")
        self.refuses([contacts, "save the world"], formats.read_graspit, contacts)
        for change, words in [(("<world>", "<worlds>"), ["not an XML file"]),
                              (("<robot>", "<robots>"), ["not an XML file"]),
                              (("graspableBody", "body"), ["0 and 1"]),
                              (("fullTransform", "transform"), ["graspableBody: transform"]),
                              (("<dofValues>", "<dofValues>x "), ["dofValues"])]:
            path = self.path("bad.xml", text.replace(*change))
            self.refuses([path, *words], formats.read_graspit, path)

    def convert(self, *arguments, code=0):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            self.assertEqual(convert.main(list(arguments)), code, said.getvalue())
        if code:
            self.assertEqual(said.getvalue().count("\n"), 1)
        return said.getvalue()

    def test_hand_grasps_of_a_plan_name_its_object(self):
        plan, output = self.path("plan.json"), self.path("grasps.jsonl")
        shutil.copy(self.plan, plan)

        def objects(*more):
            self.convert(plan, "--hand", HAND, "--output", output, *more)
            with open(output, encoding="utf-8") as file:
                return [json.loads(line)["object"] for line in file]
        own = [{"file": "cube.obj", "scale": 1}] * len(self.grasps)
        self.assertEqual(objects(), own)
        self.assertEqual(objects("--object", "other.obj", "--scale", "2")[0], {"file": "other.obj", "scale": 2})
        # A file of this name next to the plan must be the object.
        shutil.copy(CUBE, self.path("cube.obj"))
        self.assertEqual(objects(), own)
        with open(self.path("cube.obj"), "a", encoding="utf-8") as file:
            file.write("# changed\n")
        said = self.convert(plan, "--hand", HAND, "--output", output, code=2)
        self.assertIn("cube.obj is not the object of the plan, expected SHA-256", said)
        self.assertEqual(objects("--object", "cube.obj"), own)

    def test_the_program_goes_from_a_plan_to_verdicts(self):
        said = self.convert(self.plan, "--hand", HAND, "--output", self.path("a.yaml"))
        self.assertIn("not converted: which fingers hold", said)
        held = [str(c["finger"]) for c in regrasp.Plan.read(self.plan).data["initial"]["contacts"]]
        fingers = ",".join("finger" + finger for finger in held)
        said = self.convert(self.path("a.yaml"), "--hand", HAND, "--object", CUBE, "--fingers",
                            fingers, "--output", self.path("a.npz"))
        self.assertEqual(said, "regrasp-convert: note: not converted: palm and joints\n")
        done = subprocess.run([f"{PROGRAMS}/validate", "--object", CUBE, "--grasps",
                               self.path("a.npz"), "--mu", "0.8", "--output", self.path("out")],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        # All fingers in contact are used; the verdicts are the same.
        said = self.convert(self.path("a.yaml"), "--hand", HAND, "--object", CUBE, "--output",
                            self.path("b.npz"))
        idle, = {"0", "1", "2", "3"} - set(held)
        self.assertIn(f"finger{idle} in {len(self.grasps)} of {len(self.grasps)} grasps", said)
        margins = []
        for name in ("a.npz", "b.npz"):
            subprocess.run([f"{PROGRAMS}/validate", "--object", CUBE, "--grasps", self.path(name),
                            "--mu", "0.8", "--output", self.path("out"), "--quiet"], check=True)
            with np.load(self.path("out/verdicts.npz")) as verdicts:
                margins.append(verdicts["margin"])
        np.testing.assert_array_equal(*margins)
        with np.load(self.path("b.npz")) as arrays:
            self.assertEqual(arrays["points"].shape, (len(self.grasps), 4, 3))
            self.assertFalse(arrays["active"][:, int(idle)].any())
        # If a required finger is not in contact, no grasp remains and no file is written.
        said = self.convert(self.path("a.yaml"), "--hand", HAND, "--object", CUBE, "--fingers",
                            "finger" + idle, "--output", self.path("c.npz"), code=1)
        self.assertIn(f"finger{idle} ", said)
        self.assertFalse(os.path.exists(self.path("c.npz")))

    def test_poses_of_another_body_than_the_palm(self):
        # In the frame of a link, the palm is at (1, 2, 3), rotated by 90° about z.
        palm = np.array([1, 2, 3, 0.5 ** 0.5, 0, 0, 0.5 ** 0.5])
        back = _poses.inverse(palm[:3], palm[3:])
        other = self.grasps.with_palm_at([*back[0], *back[1]])
        self.assertGreater(np.linalg.norm(other.positions - self.grasps.positions), 1)
        self.assert_same(other.with_palm_at(palm))
        moved = self.grasps.with_palm_at([0, 0, 0.1])
        turns = _poses.matrices(self.grasps.quaternions)
        np.testing.assert_allclose(moved.positions, self.grasps.positions + 0.1 * turns[:, :, 2])
        formats.write_isaac_grasp(self.path("other.yaml"), other)
        self.convert(self.path("other.yaml"), "--palm", ",".join(map(repr, palm.tolist())),
                     "--output", self.path("palm.yaml"))
        self.assert_same(formats.read_isaac_grasp(self.path("palm.yaml")))
        self.refuses(["palm", "found 4"], self.grasps.with_palm_at, [1, 2, 3, 4])
        self.assertIn("--palm", self.convert(self.path("other.yaml"), "--palm", "1,2,x", "--output",
                                             self.path("palm.yaml"), code=2))

    def test_the_program_joins_files_and_names_joints(self):
        object_pose, palms = self.world_poses()
        for i, palm in enumerate(palms):
            np.save(self.path(f"{i}.npy"), {"obj_pose": object_pose, "grasp_qpos": np.concatenate(
                [palm, self.grasps.joints[i]])})
        files = [self.path(f"{i}.npy") for i in range(len(palms))]
        self.assertIn("--hand", self.convert(*files, "--output", self.path("a.yaml"), code=2))
        self.convert(*files, "--hand", HAND, "--output", self.path("a.yaml"))
        self.assert_same(formats.read_isaac_grasp(self.path("a.yaml")))

    def test_the_program_says_in_a_line_what_is_wrong(self):
        good = self.path("a.yaml", ISAAC)
        for words, arguments in [
                (["none.yaml", "no such file"], [self.path("none.yaml"), "--output", "x.yaml"]),
                (["a.txt", ".yaml"], [self.path("a.txt", ""), "--output", "x.yaml"]),
                (["--output", ".npz"], [good, "--output", "x.csv"]),
                (["--hand"], [self.plan, "--output", "x.yaml"]),
                (["--hand"], [good, "--output", "x.npz"]),
                (["--object"], [good, "--hand", HAND, "--output", "x.npz"]),
                (["joint finger0_joint0"], [good, "--hand", HAND, "--object", CUBE, "--output",
                                                "x.npz"])]:
            said = self.convert(*arguments, code=2)
            for word in words:
                self.assertIn(word, said)


if __name__ == "__main__":
    unittest.main()
