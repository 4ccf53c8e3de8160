// Every posture and action that the robot offers, pressed on the phone: done, or refused in words.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

/** Every robot of this project has these postures. */
const kStanding = ["StandZero", "StandInit", "Stand", "Crouch"];
const kDeadlineMs = 120_000;

const {stack, phone} = setUp();

/** Said where a busy machine has held a program up: no answer to a button, or one after which a person presses
 * it again. */
const kPartIsAway = /does not answer|sends no images/;
const kNoRobot = /sensors are silent/;
const kMaxPresses = 3;

/** Presses a button, and looks for what comes of it. @param isReached  what shall. @return "reached" or a refusal. */
async function pressAndSee(name, isReached) {
  for (let attempt = 1; ; attempt++) {
    const refusal = await press(name);
    const end = await until(`${name} is done or refused`, async () =>
        (await isReached()) ? "reached" : refusal(), kDeadlineMs);
    if (!kNoRobot.test(end) || attempt === kMaxPresses) return end;
  }
}

/** Presses a button of the controller, wherever its row has slid to.
 * @return a question for the sentence of refusal that came since; undefined if none did. */
async function press(name) {
  const newest = await phone.look("state.messages.reduce((id, message) => Math.max(id, message.id), 0)");
  await phone.choose(`.chip[data-name="${name}"]`);
  return () => phone.look(`state.messages.find(({id, kind, text}) =>
      id > ${newest} && kind === "bad" && !${kPartIsAway}.test(text))?.text`);
}

/** Stands the robot up again by hand after any action: getting up by itself has separate trials. */
async function standReady() {
  await stack.nao("world", "reset");
  await until("the robot stands ready", async () => (await phone.look("state.state.posture")) === "StandInit",
              kDeadlineMs);
}

test("every posture is reached, or refused in words", async (t) => {
  for (const posture of await phone.look("state.robot.postures")) {
    const end = await pressAndSee(posture, async () => (await phone.look("state.state.posture")) === posture);
    t.diagnostic(`${posture}: ${end}`);
    assert.ok(end === "reached" || !kStanding.includes(posture), `${posture}: ${end}`);
    assert.ok(end.length > 5, `${posture} is refused without a reason`);
    if (!kStanding.includes(posture)) await standReady();
  }
});

test("every action begins, or is refused in words", async (t) => {
  for (const action of await phone.look("state.robot.actions")) {
    const before = await phone.look("state.lastResult?.requestId");
    const end = await pressAndSee(action, async () => {
      const isNew = (await phone.look("state.lastResult?.requestId")) !== before;
      return isNew && [0, 2].includes(await phone.look("state.lastResult?.status"));
    });
    t.diagnostic(`${action}: ${end}`);
    assert.ok(end.length > 5, `${action} is refused without a reason`);
    if (end === "reached") await standReady();
  }
});

test("the phone has no complaint", () => {
  assert.deepEqual(phone.errors, []);
});
