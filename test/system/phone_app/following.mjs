// How closely the robot on the phone follows the simulated one: what the page showed of a joint, frame by frame,
// against the recorded truth at the robot time of the states that it knew.
import {pause, until} from "./stack.mjs";

/** In this time a frame has come to within 1 % of a state, ms: five times the time constant of the app's PoseMirror.
 * What the page shows is made of states that were the newest within it. */
const kInterpolationMs = 60;
/** From the joint to the state that reports it, us: two ticks. */
const kStateDelay = 20_000;

/** How long the page is watched after it is done, ms; and how many frames before and after it, however slow the page is. */
const kAfterwardsMs = 300;
const kLeastFrames = 4;

/** In the page: notes what each frame shows; nothing while there is no state, as after a link that was lost. */
export function sampleJoint(joint) {
  const {naoRemote} = window;
  const samples = window.shownSamples = [];
  const look = (nowMs) => {
    if (window.shownSamples !== samples) return;
    const {state} = naoRemote.state;
    if (state) samples.push({ms: nowMs, wallMs: performance.timeOrigin + nowMs, utime: Number(state.utime), angle: naoRemote.jointAngles()[joint]});
    requestAnimationFrame(look);
  };
  requestAnimationFrame(look);
}

/** Does something while it watches a joint.
 * @return frames the page showed meanwhile: when {ms, wallMs}, utime of the newest state us, angle rad; and the true
 * angles in order of utime: wallMs, utime, angle. */
export async function watchJoint(stack, phone, joint, act) {
  let frames = [];
  const recorded = await stack.record("WORLD_TRUTH", async () => {
    await phone.page.evaluate(sampleJoint, joint);
    const seesMore = async () => {
      const least = await phone.page.evaluate("window.shownSamples.length") + kLeastFrames;
      await until("the page has drawn more", () => phone.page.evaluate(`window.shownSamples.length >= ${least}`));
    };
    await seesMore();
    await act();
    await pause(kAfterwardsMs);
    await seesMore();
    frames = await phone.page.evaluate(() => {
      const samples = window.shownSamples;
      window.shownSamples = null;
      return samples;
    });
  });
  const truth = recorded.map(({wallMs, message: {utime, robots: [robot]}}) =>
      ({wallMs, utime, angle: robot.joint_position[robot.joint_names.indexOf(joint)]}));
  return {frames, truth};
}

/** Compares what was shown with what was so. Frames whose time was not recorded are left out.
 * @return strays: by how much each frame's angle is beyond all true ones of the time that it may show, from two ticks
 * before the oldest state that it is made of to the newest, rad; turned: by how much these frames turned the joint. */
export function compare(frames, truth) {
  const strays = [];
  const shown = [];
  for (const frame of frames) {
    const oldest = frames.findLast(({ms}) => ms <= frame.ms - kInterpolationMs);
    if (!oldest || oldest.utime - kStateDelay < truth[0].utime || frame.utime > truth.at(-1).utime) continue;
    const angles = truth.filter(({utime}) => utime >= oldest.utime - kStateDelay && utime <= frame.utime)
        .map(({angle}) => angle);
    strays.push(Math.max(Math.min(...angles) - frame.angle, frame.angle - Math.max(...angles), 0));
    shown.push(frame.angle);
  }
  return {strays, turned: Math.max(...shown) - Math.min(...shown)};
}

/** By how much time the page is late while the joint moves, by the clock on the wall, ms: one figure for each frame.
 * @param tolerance rad. */
export function lagsOf(frames, truth, tolerance) {
  const lags = [];
  for (const frame of frames) {
    const until = truth.findLastIndex(({wallMs}) => wallMs <= frame.wallMs);
    if (until < 10 || Math.abs(truth[until].angle - truth[until - 10].angle) < 3 * tolerance) continue;
    let same = until;
    while (same > 0 && Math.abs(truth[same].angle - frame.angle) > tolerance &&
           Math.sign(truth[same].angle - frame.angle) === Math.sign(truth[until].angle - frame.angle)) same--;
    lags.push(frame.wallMs - truth[same].wallMs);
  }
  return lags;
}
