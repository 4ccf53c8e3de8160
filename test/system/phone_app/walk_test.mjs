// Walking by two joysticks at once, observed in the simulated world; and everything that must end a walk.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kMaxAttempts = 3;
/** As stage.ts says for a processor that draws. */
const kFramePeriodMs = 30;

const {stack, phone} = setUp();

const headingOf = ([w, x, y, z]) => Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
const turned = (from, to) => Math.atan2(Math.sin(to - from), Math.cos(to - from));

async function place() {
  const {time, torso, orientation} = await stack.truth();
  return {time, x: torso[0], y: torso[1], height: torso[2], heading: headingOf(orientation)};
}

/** Frames drawn so far, and the page's time, ms. */
const drawing = () => phone.page.evaluate(() => ({count: window.naoRemote.numFrames, ms: performance.now()}));

/** Touches both joysticks, each deflected by fractions of its radius: right and up. */
async function touchJoysticks(walk, turn) {
  const left = await phone.middleOf(".joystick-walk");
  const right = await phone.middleOf(".joystick-turn");
  const at = (pad, id, [x, y]) => ({id, x: pad.x + x * pad.radius, y: pad.y - y * pad.radius});
  await phone.fingers("touchStart", [at(left, 1, [0, 0]), at(right, 2, [0, 0])]);
  await phone.fingers("touchMove", [at(left, 1, walk), at(right, 2, turn)]);
}

const lift = () => phone.lift();

/** Asks for places until one meets the condition, for some seconds of simulated time. */
async function untilPlace(what, isSo, simulatedSeconds) {
  const begin = (await place()).time;
  for (;;) {
    const now = await place();
    if (now.height < 0.2) throw new Fall(`the robot fell before ${what}\n${stack.logs}`);
    if (isSo(now)) return now;
    assert.ok(now.time - begin < simulatedSeconds,
              `${simulatedSeconds} simulated seconds passed before ${what}: ${JSON.stringify(now)}`);
  }
}

class Fall extends Error {}

/** The robustness of the walk has separate trials, in lock-step. Here a busy machine may delay commands until the robot
 * stumbles; one that fell is put on its feet, and the phone's action is repeated. */
function walkTest(name, body) {
  test(name, async (t) => {
    for (let attempt = 1; ; attempt++) {
      try {
        return await body();
      } catch (error) {
        if (!(error instanceof Fall) || attempt === kMaxAttempts) throw error;
        t.diagnostic(`attempt ${attempt}: ${error.message.split("\n")[0]}`);
        await lift();
        await phone.unhide();
        await stack.nao("world", "reset");
        await until("the robot stands ready", async () => (await phone.look("state.state.posture")) === "StandInit");
      }
    }
  });
}

/** The walk has ended: the robot says so, and stands still. */
async function stands() {
  const mode = await until("the robot stands", async () => {
    const mode = await phone.look("mode");
    return ["holding", "falling", "fallen", "getting-up"].includes(mode) && mode;
  });
  if (mode !== "holding") throw new Fall("the robot fell as it stopped");
  const before = await place();
  const after = await untilPlace("half a second passed", ({time}) => time > before.time + 0.5, 5);
  assert.ok(Math.hypot(after.x - before.x, after.y - before.y) < 0.02, "it says that it stands, and walks on");
}

walkTest("the left joystick up and the right one to the left walk forward in a left turn", async () => {
  const start = await place();
  const before = await drawing();
  await touchJoysticks([0, 0.75], [-0.6, 0]);
  const end = await untilPlace("the robot has walked and turned", (now) =>
      Math.hypot(now.x - start.x, now.y - start.y) > 0.12 && turned(start.heading, now.heading) > 0.15, 20);
  const after = await drawing();
  await lift();
  assert.ok(end.x > start.x, "it walked backwards");
  const numFrames = after.count - before.count;
  assert.ok(numFrames > 0 && numFrames <= (after.ms - before.ms) / kFramePeriodMs + 1,
            `${numFrames} frames drawn in ${after.ms - before.ms} ms`);
  await stands();
});

walkTest("a page that is hidden stops the walk", async () => {
  const start = await place();
  let hidden = 0;
  const commands = await stack.record("NAO_WALK_COMMAND", async () => {
    await touchJoysticks([0, 0.75], [0, 0]);
    await untilPlace("the robot walks", (now) => Math.hypot(now.x - start.x, now.y - start.y) > 0.05, 20);
    hidden = await phone.hide();
    const {velocity} = await until("the walk command has ended", async () => {
      const state = JSON.parse(await stack.nao("state", "--json")).motion_state;
      return state.mode !== "walking" && {velocity: [state.vx, state.vy, state.wz]};
    });
    assert.deepEqual(velocity, [0, 0, 0]);
  });
  // By the page's own word: if the gateway had to wait until the last one is stale, it would repeat it five times.
  const walks = commands.filter(({message: {vx}}) => vx !== 0);
  const late = walks.filter(({wallMs}) => wallMs > hidden);
  assert.ok(walks.length > 2, "the walk was not recorded");
  assert.ok(late.length <= 2, `the walk was asked for ${late.length} times more`);
  await lift();
  await phone.unhide();
  await stands();
});

walkTest("the stop button stops the walk while the joystick is held", async () => {
  const start = await place();
  await touchJoysticks([0, 0.75], [0, 0]);
  await untilPlace("the robot walks", (now) => Math.hypot(now.x - start.x, now.y - start.y) > 0.05, 20);
  const stop = await phone.middleOf(".stop");
  const walk = await phone.middleOf(".joystick-walk");
  const turn = await phone.middleOf(".joystick-turn");
  const held = [{id: 1, x: walk.x, y: walk.y - 0.75 * walk.radius}, {id: 2, x: turn.x, y: turn.y}];
  await phone.fingers("touchStart", [...held, {id: 3, x: stop.x, y: stop.y}]);
  await stands();
  await lift();
});

walkTest("a tap on the ground and on 'Walk here' walks there", async () => {
  const start = await place();
  const stage = await phone.middleOf(".stage");
  await phone.page.touchscreen.tap(stage.x * 1.7, stage.y * 1.12);
  await phone.tap(".walk-here");
  await untilPlace("the robot has gone there", (now) => Math.hypot(now.x - start.x, now.y - start.y) > 0.1, 40);
  await phone.tap(".stop");
  await stands();
});

test("the phone has no complaint", () => {
  assert.deepEqual(phone.errors, []);
});
