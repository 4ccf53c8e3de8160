// Every posture and action that the robot offers, pressed on the phone: done, or refused in words.
import assert from "node:assert/strict";
import {after, before, test} from "node:test";
import {openBrowser, Phone} from "./phone.mjs";
import {Stack, until} from "./stack.mjs";

/** Every robot of this project goes to these. */
const kStanding = ["StandZero", "StandInit", "Stand", "Crouch"];
const kDeadlineMs = 120_000;

const stack = new Stack(process.env.NAO_BIN_DIR);
let browser;
let phone;

before(async () => {
  await stack.start({scene: "empty"});
  browser = await openBrowser(process.env.NAO_WEB_SOURCE_DIR);
  phone = await Phone.open(browser, stack.url);
  await phone.sees("controller");
});

after(async () => {
  await browser?.close();
  await stack.stop();
});

const refusals = () => phone.page.locator(".message.bad").allTextContents();

/** Until no old words are in sight, so that new ones belong to what is pressed next. */
const silence = () => until("old messages are gone", async () => (await refusals()).length === 0, 20_000);

/** Presses a button of the controller, wherever its row has slid to. */
async function press(name) {
  await silence();
  await phone.page.locator(`.chip[data-name="${name}"]`).tap();
}

/** Stands the robot up again by hand, after whatever it did: getting up by itself has trials of its own. */
async function standReady() {
  await stack.nao("world", "reset");
  await until("the robot stands ready", async () => (await phone.look("state.state.posture")) === "StandInit",
              kDeadlineMs);
}

test("every posture is reached, or refused in words", async (t) => {
  for (const posture of await phone.look("state.robot.postures")) {
    await press(posture);
    const end = await until(`${posture} is reached or refused`, async () => {
      if ((await phone.look("state.state.posture")) === posture) return "reached";
      return (await refusals())[0];
    }, kDeadlineMs);
    t.diagnostic(`${posture}: ${end}`);
    assert.ok(end === "reached" || !kStanding.includes(posture), `${posture}: ${end}`);
    assert.ok(end.length > 5, `${posture} is refused without a reason`);
    if (!kStanding.includes(posture)) await standReady();
  }
});

test("every action begins, or is refused in words", async (t) => {
  for (const action of await phone.look("state.robot.actions")) {
    const before = await phone.look("state.lastOutcome?.requestId");
    await press(action);
    const end = await until(`${action} is accepted or refused`, async () => {
      const isNew = (await phone.look("state.lastOutcome?.requestId")) !== before;
      return (await refusals())[0] ?? (isNew && [0, 2].includes(await phone.look("state.lastOutcome?.outcome")) && "accepted");
    }, kDeadlineMs);
    t.diagnostic(`${action}: ${end}`);
    assert.ok(end.length > 5, `${action} is refused without a reason`);
    if (end === "accepted") await standReady();
  }
});

test("the phone has no complaint", () => {
  assert.deepEqual(phone.errors, []);
});
