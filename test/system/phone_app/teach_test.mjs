// Teaching motions by touch: add poses, play, repair, save, share, delete with undo, files, and by hand.
import assert from "node:assert/strict";
import {mkdtemp, readFile, writeFile} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kSize = {width: 360, height: 640};
const kMoved = 0.15;
/** Shoulder pitch of StandInit, rad. */
const kHanging = 1.4;
/** Fingers: least size of what is tapped, px. */
const kTouch = 44;
/** How far the forearm swings to its last pose, rad: at the shortest time of a pose, 0.1 s, beyond the joint's
 * speed limit of 8.3 rad/s. */
const kSwing = 1.2;
/** What a person does in a test of two minutes, at 3 s a tap. */
const kMaxTaps = 40;
/** A motion is simulated six times, at low priority beside a browser that draws in software. */
const kCheckMs = 240_000;

const {stack, openPhone} = setUp({hasPhone: false});
let numTaps = 0;

/** A phone in its owner's hand until the test ends. */
const open = async (t) => {
  const phone = await openPhone(stack.url, kSize, {acceptDownloads: true});
  t.after(() => phone.close());
  await phone.sees("controller");
  return phone;
};
/** The same, and the robot stands ready. */
const openReady = async (t) => {
  const phone = await open(t);
  await until("nobody drives", async () => (await phone.look("state.control.driverId")) === 0);
  await phone.tap('.strips [data-name="StandInit"]');
  await until("the robot stands ready", async () =>
      (await phone.look("mode")) === "holding" && (await phone.look("state.state.posture")) === "StandInit");
  // The fake gateway names the posture before the arms are there.
  await until("the arms hang", async () => Math.abs(await angle(phone, "RShoulderPitch") - kHanging) < 0.1);
  return phone;
};
const tap = async (phone, selector) => {
  numTaps++;
  await phone.tap(selector);
};
const choose = async (phone, group) => {
  await tap(phone, `.joints-panel [data-name="${group}"]`);
  await until(`${group} is chosen`, async () => (await phone.look("state.selectedGroup")) === group);
};
const angle = async (phone, joint) => (await phone.look("jointAngles()"))[joint];
const keyframes = (phone) => phone.look("state.draft.keyframes");
const saved = (phone) => phone.look("state.savedMotions");
const isActing = async (phone) => (await phone.look("mode")) === "acting";
/** Whether the draft is played, or was: a page that stands still under load sees only the result. */
const hasActed = async (phone) => (await isActing(phone)) || (await phone.look("state.lastResult?.message")) === "_draft: done.";
const acts = (phone) => until("the robot acts", () => hasActed(phone), kCheckMs).catch(async (error) => {
  const {phase, isCheckingMotion, motionFault, lastResult} = await phone.look("state");
  const message = await phone.page.locator(".messages").innerText();
  assert.fail(`${error.message}: ${phase}, mode ${await phone.look("mode")}, checking ${isCheckingMotion}, fault ${motionFault?.text}, ` +
              `last result "${lastResult?.message}", message "${message}", poses ${(await keyframes(phone)).map(({duration}) => duration)}`);
});
const hasEnded = (phone) => until("the motion has ended", async () => (await phone.look("mode")) === "holding");

/** Pushes the pad until a joint has turned. */
async function turn(phone, joint, right, up, change) {
  numTaps++;
  const before = await angle(phone, joint);
  const pad = await phone.middleOf(".joystick-joint");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x + right * pad.radius, y: pad.y - up * pad.radius}]);
  await until(`${joint} has turned`, async () => Math.abs(await angle(phone, joint) - before) > change)
      .catch(async (error) => {
        const knob = await phone.page.locator(".joystick-joint .joystick-knob").getAttribute("style");
        const state = await phone.look("state");
        assert.fail(`${error.message}: it is at ${await angle(phone, joint)} after ${before} rad, pad ${JSON.stringify(pad)}, ` +
                    `knob "${knob}", ${state.phase}, age of its state ${state.stateAgeMs} ms, driven by ${state.control.driverId}, ` +
                    `message "${await phone.page.locator(".messages").innerText()}"`);
      })
      .finally(() => phone.fingers("touchEnd", []));
}

async function addPose(phone) {
  const number = (await keyframes(phone)).length + 1;
  await tap(phone, ".teach-add");
  await until(`pose ${number} is there`, async () => (await keyframes(phone)).length === number);
}

/** The motion of a first-time user: the right arm up, and to and fro. */
async function teachWave(phone) {
  await tap(phone, ".joints-button");
  await choose(phone, "right shoulder");
  await turn(phone, "RShoulderPitch", 0, 0.9, 1.2);
  await addPose(phone);
  await choose(phone, "right elbow");
  // So far that the swing back, from 1.39 rad, ends before the joint's stop at 2.09 rad.
  await turn(phone, "RElbowYaw", -0.9, 0, 0.6);
  await addPose(phone);
  await turn(phone, "RElbowYaw", 0.9, 0, kSwing);
  await addPose(phone);
}

async function save(phone, name) {
  await tap(phone, ".teach-open");
  await phone.page.locator('[name="motion-name"]').fill(name);
  await tap(phone, ".motion-name .primary");
  await phone.page.locator(".draft .note.good").waitFor({timeout: kCheckMs});
  await until("it is listed", async () => (await saved(phone)).includes(name.replaceAll(" ", "-")));
}

const closeSheet = (phone) => tap(phone, ".motions header .round");
const actOn = (phone, name, what) => tap(phone, `.saved-motions [data-name="${name}"] [data-act="motion.${what}Named"]`);

/** Leaves the robot as the next test expects it: no motion saved, ready. */
async function tidy(phone) {
  for (const name of await saved(phone)) {
    await actOn(phone, name, "remove");
    await until("it is gone", async () => !(await saved(phone)).includes(name));
  }
  assert.deepEqual(phone.errors, []);
}

test("a wave is taught in few taps, played, saved, and an action on every phone", async (t) => {
  const phone = await openReady(t);
  const other = await open(t);
  numTaps = 0;
  await teachWave(phone);
  await tap(phone, ".teach-play");
  await acts(phone);
  await hasEnded(phone);
  await save(phone, "Big wave");
  t.diagnostic(`${numTaps} taps`);
  assert.ok(numTaps <= kMaxTaps, `${numTaps} taps`);
  const action = other.page.locator('.strips [data-name="Big-wave"]');
  await action.waitFor({state: "attached"});
  assert.equal(await action.textContent(), "Big wave");
  // The phone that taught it has control until it hands over.
  await closeSheet(phone);
  await tap(phone, ".driver-button");
  const before = await angle(other, "RElbowYaw");
  await other.choose('.strips [data-name="Big-wave"]');
  await until("the other phone's tap waves", async () => Math.abs(await angle(other, "RElbowYaw") - before) > kMoved);
  await hasEnded(other);
  await tap(other, ".driver-button");
  await tap(phone, ".teach-open");
  await tidy(phone);
});

test("a pose that comes too fast is named, and a tap on the slower motion repairs it", async (t) => {
  const phone = await openReady(t);
  await teachWave(phone);
  await tap(phone, ".teach-open");
  const shorter = phone.page.locator(".keyframes li").nth(2).locator(".pose-row .stepper .round").first();
  for (let i = 0; i < 30 && (await keyframes(phone))[2].duration > 0.101; i++) await shorter.tap();
  await phone.page.locator(".draft-buttons .button").first().tap();
  await phone.page.locator(".teach-bar .note").waitFor({timeout: kCheckMs});
  assert.match(await phone.page.locator(".teach-bar .note p").textContent(), /^Pose 3: /);
  assert.equal(await phone.page.locator(".pose-dots .bad").textContent(), "3");
  assert.equal(await isActing(phone), false);
  await tap(phone, ".teach-bar .note .primary");
  await until("the pose has more time", async () => (await keyframes(phone))[2].duration > 0.101);
  await tap(phone, ".teach-play");
  await acts(phone);
  await hasEnded(phone);
  await tidy(phone);
});

test("Stop ends a played motion, and what is being checked is not played", async (t) => {
  const phone = await openReady(t);
  await teachWave(phone);
  await tap(phone, ".teach-play");
  await acts(phone);
  await tap(phone, ".stop");
  await hasEnded(phone);
  await phone.page.locator(".teach-play").tap();
  await phone.page.locator(".stop").tap();
  await until("the check was given up", async () => !(await phone.look("state.isCheckingMotion")));
  assert.equal(await isActing(phone), false);
  await tidy(phone);
});

test("poses are reordered, mirrored and undone; the draft survives a reload", async (t) => {
  const phone = await openReady(t);
  await teachWave(phone);
  const [first, second] = await keyframes(phone);
  await tap(phone, ".teach-open");
  await phone.page.locator(".pose-title").nth(1).tap();
  await phone.page.getByRole("button", {name: "Move up"}).tap();
  assert.deepEqual((await keyframes(phone)).slice(0, 2), [second, first]);
  await phone.page.getByRole("button", {name: "Mirror"}).tap();
  const mirrored = (await keyframes(phone))[1].pose;
  assert.ok(Math.abs(mirrored.LShoulderPitch - first.pose.RShoulderPitch) < 1e-6);
  assert.ok(Math.abs(mirrored.LElbowYaw + first.pose.RElbowYaw) < 1e-6);
  const before = await keyframes(phone);
  await phone.page.reload();
  await phone.sees("controller");
  assert.deepEqual(await keyframes(phone), before);
  await tap(phone, ".joints-button");
  await tap(phone, ".teach-open");
  await phone.page.getByRole("button", {name: "Start anew"}).tap();
  assert.deepEqual(await keyframes(phone), []);
  await phone.page.locator(".draft-buttons").getByRole("button", {name: "Undo"}).tap();
  assert.deepEqual(await keyframes(phone), before);
  await tidy(phone);
});

test("a motion is downloaded, deleted, brought back by undo, uploaded, and replaced only when asked", async (t) => {
  const phone = await openReady(t);
  await teachWave(phone);
  await save(phone, "wave-2");
  const [download] = await Promise.all([phone.page.waitForEvent("download"), actOn(phone, "wave-2", "download")]);
  assert.equal(download.suggestedFilename(), "wave-2.yaml");
  const text = await readFile(await download.path(), "utf8");
  assert.match(text, /wave-2/);
  await actOn(phone, "wave-2", "remove");
  await until("it is gone", async () => (await saved(phone)).length === 0);
  await phone.page.locator(".saved .note").getByRole("button", {name: "Undo"}).tap();
  await until("it is back", async () => (await saved(phone)).includes("wave-2"), kCheckMs);
  const file = join(await mkdtemp(join(tmpdir(), "nao-motion-")), "motion.yaml");
  await writeFile(file, text);
  const upload = () => phone.page.locator('.saved input[type="file"]').setInputFiles(file);
  await upload();
  await phone.page.locator(".saved .note").getByRole("button", {name: "Replace"}).tap();
  await phone.page.getByText("The file is saved on the robot.").waitFor({timeout: kCheckMs});
  await actOn(phone, "wave-2", "remove");
  await until("it is gone", async () => (await saved(phone)).length === 0);
  await upload();
  await until("the file is listed", async () => (await saved(phone)).includes("wave-2"), kCheckMs);
  await writeFile(file, "this: [is not a motion");
  await upload();
  await phone.page.locator(".saved .note.bad, .message.bad").first().waitFor({state: "attached", timeout: kCheckMs});
  phone.errors.length = 0;
  await tidy(phone);
});

test("a limb is relaxed and dragged in the simulation, and its pose is added", async (t) => {
  const phone = await openReady(t);
  await tap(phone, ".joints-button");
  await choose(phone, "left shoulder");
  await tap(phone, ".relax");
  // One group after the other; only a limp one can be held.
  await until("the arm is limp to the wrist", async () => (await phone.look("state.relaxedGroups")).includes("left wrist"));
  const before = await angle(phone, "LShoulderPitch");
  const [x, y] = (await phone.rests())["left wrist"];
  await phone.fingers("touchStart", [{id: 1, x, y}]);
  await phone.fingers("touchMove", [{id: 1, x: x + 10, y: y - 90}]);
  await until("the arm follows the finger", async () => Math.abs(await angle(phone, "LShoulderPitch") - before) > kMoved)
      .finally(() => phone.fingers("touchEnd", []));
  await addPose(phone);
  await tap(phone, ".relax");
  await until("the arm is stiff", async () => (await phone.look("state.relaxedGroups")).length === 0);
  await tidy(phone);
});

test("every new control is large enough for a finger", async (t) => {
  const phone = await openReady(t);
  await teachWave(phone);
  await tap(phone, ".teach-open");
  await phone.page.locator(".pose-title").first().tap();
  const small = await phone.page.evaluate((least) =>
      [...document.querySelectorAll(".motions button, .motions input, .teach-bar button, .joint-buttons button")]
          .map((one) => [one.textContent || one.ariaLabel, one.getBoundingClientRect()])
          .filter(([, {width, height}]) => width > 0 && (width < least || height < least)).map(([name]) => name), kTouch);
  assert.deepEqual(small, []);
  await tidy(phone);
});
