// Repeat a replay in the current version of MuJoCo, as described in scripts/current-mujoco. Reads
// scene/ and trajectory.csv in the folder of this script.

import fs from 'node:fs';
import loadMujoco from '@mujoco/mujoco';

const MOST_MM = 2;
const MOST_DEGREES = 5;

// Quaternions: w, x, y, z.
const conjugate = ([w, x, y, z]) => [w, -x, -y, -z];
const times = ([a, b, c, d], [e, f, g, h]) => [
  a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
const turned = (by, v) => times(times(by, [0, ...v]), conjugate(by)).slice(1);
const plus = (a, b) => a.map((value, i) => value + b[i]);
const minus = (a, b) => a.map((value, i) => value - b[i]);

/** How far a pose (place, quaternion) is from another one: millimetres and degrees. */
function distance(a, b) {
  const turn = times(conjugate(a.slice(3)), b.slice(3));
  return {
    mm: 1e3 * Math.hypot(...minus(a.slice(0, 3), b.slice(0, 3))),
    degrees: (360 / Math.PI) * Math.acos(Math.min(1, Math.abs(turn[0]))),
  };
}

function larger(a, b) {
  return {mm: Math.max(a.mm, b.mm), degrees: Math.max(a.degrees, b.degrees)};
}

const text = ({mm, degrees}) => `${mm.toFixed(2)} mm and ${degrees.toFixed(2)} degrees`;

const mujoco = await loadMujoco();
mujoco.FS.mkdir('/scene');
for (const file of fs.readdirSync('scene')) {
  mujoco.FS.writeFile(`/scene/${file}`, fs.readFileSync(`scene/${file}`));
}
const model = mujoco.MjModel.mj_loadXML('/scene/scene.xml');
// Contact forces follow from the inertia with implicit damping, as in the replay
// (sim/scene/damped_step.h). With the other integrators, fingertips of light, damped links slip.
model.opt.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE.value;
const data = new mujoco.MjData(model);
const FREE = 0;
const joint = Array.from(model.jnt_type).indexOf(FREE);
const objectAt = model.jnt_qposadr[joint];
/** The pose of the object's body: its centroid, with the axes of the object's file. */
const objectPose = () => Array.from(data.qpos.slice(objectAt, objectAt + 7));
// The trajectory has the origin of the object's file, which is the only site of the object.
const site = Array.from(model.site_bodyid).indexOf(model.jnt_bodyid[joint]);
if (site < 0) throw new Error('scene/scene.xml: the object has no site at its origin');
const centroid = Array.from(model.site_pos.slice(3 * site, 3 * site + 3)).map((x) => -x);

function start(keyframe) {
  mujoco.mj_resetDataKeyframe(model, data, keyframe);
  mujoco.mj_forward(model, data);
}

/** The controls stay as they are in the keyframe. */
function holdKeyframes() {
  let worst = {mm: 0, degrees: 0};
  for (let key = 0; key < model.nkey; ++key) {
    start(key);
    const before = objectPose();
    const end = data.time + 1;
    while (data.time < end) mujoco.mj_step(model, data);
    worst = larger(worst, distance(before, objectPose()));
  }
  return worst;
}

/** From the first keyframe on the actuators do what they did. */
function followTrajectory() {
  const [head, ...rows] = fs.readFileSync('trajectory.csv', 'utf8').trim().split('\n')
      .map((line) => line.split(','));
  const control = head.findIndex((name) => name.startsWith('control '));
  const object = head.indexOf('object_x_m');
  const samples = rows.map((row) => row.map(Number));
  start(0);
  let at = samples.findIndex((sample) => sample[0] >= data.time - 1e-9);
  const poseOf = (sample) => {
    const turn = sample.slice(object + 3, object + 7);
    return [...plus(sample.slice(object, object + 3), turned(turn, centroid)), ...turn];
  };
  // The trajectory's poses are in the palm frame.
  const first = objectPose();
  const firstInPalm = poseOf(samples[at]);
  const palm = times(first.slice(3), conjugate(firstInPalm.slice(3)));
  const inWorld = (pose) => {
    const way = turned(palm, minus(pose.slice(0, 3), firstInPalm.slice(0, 3)));
    return [...way.map((value, i) => value + first[i]), ...times(palm, pose.slice(3))];
  };
  let worst = {mm: 0, degrees: 0};
  let last = worst;
  for (; at + 1 < samples.length; ++at) {
    for (let i = 0; i < model.nu; ++i) data.ctrl[i] = samples[at][control + i];
    const next = samples[at + 1];
    while (data.time < next[0] - model.opt.timestep / 2) mujoco.mj_step(model, data);
    last = distance(inWorld(poseOf(next)), objectPose());
    worst = larger(worst, last);
  }
  return {worst, last};
}

const held = holdKeyframes();
const {worst, last} = followTrajectory();
console.log(`MuJoCo ${mujoco.mj_versionString()}: ${model.nkey} keyframes held for a second each move by ` +
            `${text(held)} at most`);
console.log(`the trajectory's controls lead the object ${text(worst)} off at most, ${text(last)} in the end`);
const all = larger(held, worst);
process.exit(all.mm > MOST_MM || all.degrees > MOST_DEGREES ? 1 : 0);
