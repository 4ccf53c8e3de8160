// Joints mode by touch, against the real programs: a tap on a ball chooses a joint group, the pad turns
// it, and the simulated joint follows.
import assert from "node:assert/strict";
import {test} from "node:test";
import {compare, lagsOf, sampleJoint, watchJoint} from "./following.mjs";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kDegree = Math.PI / 180;
/** Deflection of the joystick, fraction of its radius: 0.9 rad/s for head and arms; 0.2 rad/s for a leg,
 * which shall turn only so far that the robot keeps standing. */
const kArmReach = 0.8;
const kLegReach = 0.35;
const kMoved = 3 * kDegree;
/** The phone knows a joint by its encoder, whose step is 1.5 mrad, and draws no invisible change: 0.8 mrad. */
const kShownTolerance = 0.003;
const kDeadlineMs = 20_000;

const {stack, phone} = setUp({framesPerSecond: 0, prepare: (phone) => phone.tap(".joints-button")});

/** Taps the ball of a group once the view has come to rest. */
async function choose(group) {
  const [x, y] = (await phone.rests())[group];
  await phone.page.touchscreen.tap(x, y);
  await until(`${group} is chosen`, async () => (await phone.look("state.selectedGroup")) === group);
}

/** Holds the pad off its middle until something is so. */
async function push(right, up, what, isSo) {
  const pad = await phone.middleOf(".joystick-joint");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x + right * pad.radius, y: pad.y - up * pad.radius}]);
  await until(what, isSo, kDeadlineMs).finally(() => phone.fingers("touchEnd", []));
}

/** Does something that turns a joint: what the phone shows meanwhile is the truth, two ticks and the app's own
 * interpolation late at most. */
async function follows(t, joint, act) {
  const {frames, truth} = await watchJoint(stack, phone, joint, act);
  const {strays, turned} = compare(frames, truth);
  const worst = Math.max(...strays);
  const lags = lagsOf(frames, truth, kShownTolerance).sort((a, b) => a - b);
  const lag = (share) => lags[Math.floor(share * (lags.length - 1))].toFixed(0);
  t.diagnostic(`${joint}: ${strays.length} frames, ${(1000 * worst).toFixed(1)} mrad off at most` +
               (lags.length ? `; ${lags.length} in quick movement, late by ${lag(0.5)} ms, 90 % by ${lag(0.9)} ms at most` : ""));
  assert.ok(worst < kShownTolerance, `${joint} is shown ${worst} rad off what it was`);
  return turned;
}

/** "Reset pose": everything back to where it was before the next joint. */
async function reset() {
  await phone.page.locator(".joint-buttons .button").nth(1).tap();
  await until("the robot stands ready", async () =>
      (await phone.look("state.state.posture")) === "StandInit", kDeadlineMs);
}

const groups = [
  ["head", "HeadPitch", "up", -1], ["head", "HeadYaw", "right", 1],
  ["left shoulder", "LShoulderPitch", "up", -1], ["right shoulder", "RShoulderPitch", "up", -1],
  ["left elbow", "LElbowYaw", "right", 1], ["right elbow", "RElbowYaw", "left", -1],
  ["left wrist", "LWristYaw", "right", 1], ["right wrist", "RWristYaw", "right", 1],
  ["left hand", "LHand", "up", 1], ["right hand", "RHand", "up", 1],
];

for (const [group, joint, direction, sign] of groups) {
  test(`${group}: the pad pushed ${direction} turns ${joint}, on the phone as in the simulation`, async (t) => {
    await choose(group);
    const before = (await stack.truth()).angles[joint];
    const right = direction === "right" ? kArmReach : direction === "left" ? -kArmReach : 0;
    const turned = await follows(t, joint, () => push(
        right, direction === "up" ? kArmReach : 0, `${joint} has turned; it was at ${before}`,
        async () => sign * ((await stack.truth()).angles[joint] - before) > kMoved));
    assert.ok(turned > kMoved / 2, `the frames compared turn ${joint} by ${turned} rad only`);
  });
}

test("the end of a joint's range is shown, and vibrates", async () => {
  await phone.page.evaluate(() => {
    window.felt = [];
    navigator.vibrate = (pattern) => window.felt.push(pattern);
  });
  await choose("left hand");
  // The tap itself causes a short vibration.
  const before = await phone.page.evaluate("window.felt.length");
  // The end of the range is shown from its last hundredth on.
  await push(0, kArmReach, "the hand is wide open, and said to be", async () =>
      (await phone.page.locator(".axis.at-limit dd").allTextContents()).includes("100 % · End of its range"));
  assert.ok((await phone.page.evaluate("window.felt")).slice(before).some((pattern) => pattern > 20), "nothing was felt");
});

const legGroups = [["left hip", "LHipPitch"], ["left knee", "LKneePitch"], ["left ankle", "LAnklePitch"],
                   ["right hip", "RHipPitch"], ["right knee", "RKneePitch"], ["right ankle", "RAnklePitch"]];

for (const [group, joint] of legGroups) {
  test(`${group}: ${joint} turns, on the phone as in the simulation, or the phone says why not`, async (t) => {
    await choose(group);
    const before = (await stack.truth()).angles[joint];
    await follows(t, joint, () => push(0, kLegReach, `${joint} has turned, or a refusal is shown`, async () =>
        Math.abs((await stack.truth()).angles[joint] - before) > kMoved ||
        (await phone.page.locator(".message.bad").count()) > 0));
    await reset();
  });
}

test("the roll slider turns the roll joint, and both sides at once if selected", async () => {
  await choose("left shoulder");
  await phone.page.locator(".joint-buttons .button").nth(0).tap();
  const {angles} = await stack.truth();
  const slider = await phone.page.locator(".roll input").boundingBox();
  const y = slider.y + slider.height / 2;
  await phone.page.touchscreen.tap(slider.x + 0.8 * slider.width, y);
  await until("both arms have moved, mirrored", async () => {
    const now = (await stack.truth()).angles;
    const left = now.LShoulderRoll - angles.LShoulderRoll;
    const right = now.RShoulderRoll - angles.RShoulderRoll;
    return Math.abs(left) > kMoved && Math.abs(left + right) < 2 * kDegree;
  }, kDeadlineMs);
});

test("the lock takes the balls away and brings the drive controls back", async () => {
  await phone.tap(".joints-button");
  assert.ok(await phone.page.locator(".joystick-walk").isVisible());
  assert.ok(await phone.page.locator(".joint-card").isHidden());
  assert.deepEqual(phone.errors, []);
});

test("a joint is not sampled while the page has no state, as after a lost link", () => {
  const frames = [];
  const naoRemote = {state: {state: null}, jointAngles: () => ({HeadYaw: 0.5})};
  Object.assign(globalThis, {window: {naoRemote}, requestAnimationFrame: (look) => frames.push(look)});
  sampleJoint("HeadYaw");
  frames.shift()(1);
  naoRemote.state.state = {utime: 7n};
  frames.shift()(2);
  assert.deepEqual(window.shownSamples.map(({ms, utime, angle}) => [ms, utime, angle]), [[2, 7, 0.5]]);
});
