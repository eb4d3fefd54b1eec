// Evaluate hand grasps with the procedure of DexGraspBench (fcMocapEval) in the current version of MuJoCo.
//
// usage: node dexgraspbench.mjs MODEL OBJECTS GRASPS     (npm install @mujoco/mujoco)
//
//   MODEL    MJCF file of a hand of DexGraspBench, whose meshdir exists
//   OBJECTS  folder of objects, as assets/example_object of DexGraspBench
//   GRASPS   hand grasps of regrasp-convert, without --palm: poses of the first body of the hand
//
// Prints one JSON object per grasp: verdict, largest translation in mm and rotation in degrees, and number of
// contacts with the object after the hand has closed.

import fs from 'node:fs';
import path from 'node:path';
import loadMujoco from '@mujoco/mujoco';

const MASS_KG = 0.1, FRICTION = 0.6, TORSION = 0.02, ACCELERATION = 10;
const MOST_M = 0.05, MOST_DEGREES = 15, MOST_DEPTH_M = 0.01;
const DIRECTIONS = [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0, 1]];
const HAND_SOLREF = [0.005, 1], HAND_SOLIMP = [0.5, 0.99, 0.0001];

const [modelFile, objects, graspFile] = process.argv.slice(2);
const mujoco = await loadMujoco();
mujoco.FS.mkdir('/scene');
const handXml = fs.readFileSync(modelFile, 'utf8');
const meshdir = path.resolve(path.dirname(modelFile), /meshdir="([^"]*)"/.exec(handXml)?.[1] ?? '.');
for (const file of fs.readdirSync(meshdir)) {
  mujoco.FS.writeFile(`/scene/${file}`, fs.readFileSync(path.join(meshdir, file)));
}

/** The scene of the class MjHO: the hand in a free body that a weld holds, and the pieces of the object. */
function sceneOf(name, scale) {
  const info = JSON.parse(fs.readFileSync(path.join(objects, name, 'info/simplified.json')));
  const density = MASS_KG / (info.mass / (info.density * info.scale ** 3) * scale ** 3);
  const folder = path.join(objects, name, 'urdf/meshes');
  let meshes = '', geoms = '';
  for (const file of fs.readdirSync(folder).filter((each) => each.endsWith('.obj')).sort()) {
    mujoco.FS.writeFile(`/scene/${file}`, fs.readFileSync(path.join(folder, file)));
    meshes += `<mesh name="${file}" file="${file}" scale="${scale} ${scale} ${scale}"/>`;
    geoms += `<geom type="mesh" mesh="${file}" density="${density}"/>`;
  }
  const option = '<option timestep="0.004" integrator="implicitfast" cone="elliptic" impratio="10" noslip_iterations="2">' +
      '<flag gravity="disable"/></option>';
  return handXml.replace(/meshdir="[^"]*"/, '').replace(/<option[^>]*\/>/, option)
      .replace('</asset>', `${meshes}</asset>`)
      .replace('<worldbody>', '<worldbody><body name="mount" mocap="true"/><body name="hand"><freejoint/>')
      .replace('</worldbody>', `</body><body name="object"><freejoint/>${geoms}</body></worldbody>` +
          '<equality><weld body1="mount" body2="hand" solimp="0.9 0.95 0.001 0.5 2" torquescale="1"/></equality>');
}

function setContacts(model) {
  for (let geom = 0; geom < model.ngeom; ++geom) {
    model.geom_friction[3 * geom] = FRICTION;
    model.geom_friction[3 * geom + 1] = TORSION;
    model.geom_condim[geom] = 4;
    if (model.geom_bodyid[geom] === model.nbody - 1) continue;
    HAND_SOLREF.forEach((value, i) => { model.geom_solref[2 * geom + i] = value; });
    HAND_SOLIMP.forEach((value, i) => { model.geom_solimp[5 * geom + i] = value; });
  }
}

function between(a, b, share) {
  let q = b.quaternion, cosine = a.quaternion.reduce((sum, value, i) => sum + value * q[i], 0);
  if (cosine < 0) [q, cosine] = [q.map((value) => -value), -cosine];
  const angle = Math.acos(Math.min(1, cosine));
  const [u, v] = angle < 1e-6 ? [1 - share, share]
                              : [Math.sin((1 - share) * angle) / Math.sin(angle), Math.sin(share * angle) / Math.sin(angle)];
  return {position: a.position.map((value, i) => value + share * (b.position[i] - value)),
          quaternion: a.quaternion.map((value, i) => u * value + v * q[i])};
}

class Bench {
  constructor(grasp) {
    mujoco.FS.writeFile('/scene/scene.xml', sceneOf(grasp.object.file.replace(/\.obj$/, ''), grasp.object.scale));
    this.model = mujoco.MjModel.mj_loadXML('/scene/scene.xml');
    this.data = new mujoco.MjData(this.model);
    setContacts(this.model);
    const full = (part) => ({palm: part?.palm ?? grasp.palm, joints: {...grasp.joints, ...part?.joints}});
    this.stages = [full(grasp.pregrasp), full(), full(grasp.target)];
    this.joints = Array.from({length: this.model.njnt}, (_, i) => this.model.jnt(i).name);
  }

  delete() {
    this.data.delete();
    this.model.delete();
  }

  /** Actuator lengths of a configuration, for actuators of joints and of fixed tendons. */
  controls({joints}) {
    const {model} = this;
    return Array.from({length: model.nu}, (_, a) => {
      const id = model.actuator_trnid[2 * a];
      if (model.actuator_trntype[a] === 0) return joints[this.joints[id]];
      let sum = 0;
      for (let w = model.tendon_adr[id]; w < model.tendon_adr[id] + model.tendon_num[id]; ++w) {
        sum += model.wrap_prm[w] * joints[this.joints[model.wrap_objid[w]]];
      }
      return sum;
    });
  }

  reset() {
    const {model, data} = this, stage = this.stages[0];
    mujoco.mj_resetData(model, data);
    [...stage.palm.position, ...stage.palm.quaternion].forEach((value, i) => { data.qpos[i] = value; });
    this.joints.forEach((name, joint) => {
      if (name in stage.joints) data.qpos[model.jnt_qposadr[joint]] = stage.joints[name];
    });
    [0, 0, 0, 1, 0, 0, 0].forEach((value, i) => { data.qpos[model.nq - 7 + i] = value; });
    this.command(stage, stage, 1);
    mujoco.mj_forward(model, data);
  }

  command(from, to, share) {
    const {data} = this, pose = between(from.palm, to.palm, share), begin = this.controls(from), end = this.controls(to);
    pose.position.forEach((value, i) => { data.mocap_pos[i] = value; });
    pose.quaternion.forEach((value, i) => { data.mocap_quat[i] = value; });
    begin.forEach((value, i) => { data.ctrl[i] = value + share * (end[i] - value); });
  }

  steps(count) {
    for (let i = 0; i < count; ++i) mujoco.mj_step(this.model, this.data);
  }

  close() {
    this.reset();
    for (const stage of [0, 1]) {
      for (let i = 1; i <= 10; ++i) {
        this.command(this.stages[stage], this.stages[stage + 1], i / 10);
        this.steps(10);
      }
    }
  }

  contacts() {
    return Array.from({length: this.data.ncon}, (_, i) => {
      const contact = this.data.contact.get(i), object = this.model.nbody - 1;
      const bodies = [contact.geom1, contact.geom2].map((geom) => this.model.geom_bodyid[geom]);
      return {distance: contact.dist, touches: (bodies[0] === object) !== (bodies[1] === object)};
    });
  }

  run() {
    this.reset();
    const depth = Math.max(0, ...this.contacts().map(({distance}) => -distance));
    if (depth > MOST_DEPTH_M) return {verdict: 'fail', depth_mm: 1e3 * depth};
    const result = {verdict: 'pass', moved_mm: 0, rotated_deg: 0};
    for (const direction of DIRECTIONS) {
      this.close();
      result.contacts ??= this.contacts().filter(({touches}) => touches).length;
      direction.forEach((value, i) => {
        this.data.xfrc_applied[6 * (this.model.nbody - 1) + i] = ACCELERATION * MASS_KG * value;
      });
      for (let check = 0; check < 10; ++check) {
        this.steps(50);
        const pose = this.data.qpos.slice(this.model.nq - 7);
        const moved = Math.hypot(pose[0], pose[1], pose[2]);
        const rotated = 360 / Math.PI * Math.acos(Math.min(1, Math.abs(pose[3])));
        result.moved_mm = Math.max(result.moved_mm, 1e3 * moved);
        result.rotated_deg = Math.max(result.rotated_deg, rotated);
        if (moved >= MOST_M || rotated >= MOST_DEGREES) return {...result, verdict: 'fail'};
      }
    }
    return result;
  }
}

for (const line of fs.readFileSync(graspFile, 'utf8').trim().split('\n')) {
  const grasp = JSON.parse(line), bench = new Bench(grasp);
  console.log(JSON.stringify({id: grasp.id, ...bench.run()}));
  bench.delete();
}
