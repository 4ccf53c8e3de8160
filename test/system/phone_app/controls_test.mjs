// Every other way to drive, against the real programs: keyboard, gamepad, tilt; the head camera's image, which
// turns the head; and the settings.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kDegree = Math.PI / 180;

const {stack, phone} = setUp({prepare: async ({page}) => {
  // Headless Chromium has no gamepad: the page gets a simulated one.
  await page.evaluate(() => {
    window.pad = null;
    navigator.getGamepads = () => [window.pad];
  });
}});

/** The walk velocity being executed: vx, vy m/s, wz rad/s. Zero without a walk. */
async function executedWalk() {
  const {vx, vy, wz} = JSON.parse(await stack.nao("state", "--json")).motion_state;
  return [vx, vy, wz];
}

const walks = (what, isSo) => until(what, async () => isSo(...await executedWalk()));

async function stops() {
  await walks("the walk has ended", (vx, vy, wz) => vx === 0 && vy === 0 && wz === 0);
  await until("the robot stands", async () => (await phone.look("mode")) === "holding");
}

/** Holds a key while it acts, and releases it also after a failure: the next test begins without a held key. */
async function holding(key, act) {
  await phone.page.keyboard.down(key);
  await act().finally(() => phone.page.keyboard.up(key));
}

test("keys walk while they are held, and stop when they are released", async () => {
  await holding("KeyW", () => walks("W walks ahead", (vx) => vx > 0.01));
  await stops();
  await holding("ArrowLeft", () => walks("the left arrow turns left", (vx, vy, wz) => wz > 0.05));
  await stops();
});

test("the space bar stops while a key is held, and losing the focus releases it", async () => {
  await holding("KeyW", async () => {
    await walks("W walks ahead", (vx) => vx > 0.01);
    await phone.page.keyboard.press("Space");
    await stops();
  });
  await holding("KeyW", async () => {
    await walks("W walks ahead again", (vx) => vx > 0.01);
    await phone.page.evaluate(() => window.dispatchEvent(new Event("blur")));
    await stops();
  });
});

/** Connects a simulated gamepad; null disconnects it. */
const holdPad = (axes, pressed = []) => phone.page.evaluate(([axes, pressed]) => {
  // Its hardware reports, whatever the sticks do.
  window.pad = axes && {index: 0, mapping: "standard", axes, connected: true, get timestamp() { return performance.now(); },
                        buttons: Array.from({length: 17}, (_, i) => ({pressed: pressed.includes(i)}))};
}, [axes, pressed]);

test("a gamepad's sticks walk and its buttons command; unplugging releases it", async () => {
  await holdPad([0, -1, 0, 0]);
  await walks("the left stick walks ahead", (vx) => vx > 0.01);
  await holdPad([0, 0, 0, 0]);
  await stops();
  await holdPad([0, 0, 1, 0]);
  await walks("the right stick turns right", (vx, vy, wz) => wz < -0.05);
  await holdPad(null);
  await stops();
  await holdPad([0, 0, 0, 0], [2]);
  await until("the robot crouches", async () => (await phone.look("state.state.posture")) === "Crouch");
  await holdPad([0, 0, 0, 0], [0]);
  await until("the robot stands ready", async () => (await phone.look("state.state.posture")) === "StandInit");
  await holdPad(null);
});

const tilt = (beta) => phone.page.evaluate((beta) => window.dispatchEvent(
    new DeviceOrientationEvent("deviceorientation", {alpha: 0, beta, gamma: 0})), beta);

// A sensor reports many times a second.
const keepTilting = (beta) => phone.page.evaluate((beta) => window.tilting = setInterval(() => window.dispatchEvent(
    new DeviceOrientationEvent("deviceorientation", {alpha: 0, beta, gamma: 0})), 50), beta);
const endTilting = () => phone.page.evaluate(() => clearInterval(window.tilting));

test("tilting the phone walks, only while the pad is touched", async () => {
  await keepTilting(40);
  await phone.page.locator(".menu-button").tap();
  await phone.page.locator(".menu[open] [role=switch]").first().tap();
  await phone.page.locator(".menu[open] header .round").tap();
  await endTilting();
  await tilt(15);
  assert.deepEqual(await executedWalk(), [0, 0, 0], "it walks without a touch");
  await tilt(40);
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await keepTilting(15);
  await walks("a tilt walks ahead", (vx) => vx > 0.01);
  await endTilting();
  await stops();
  await phone.fingers("touchEnd", []);
  await phone.page.locator(".menu-button").tap();
  await phone.page.locator(".menu[open] [role=switch]").first().tap();
  await phone.page.locator(".menu[open] header .round").tap();
});

test("a drag on the image turns the head, as if it moved what is seen", async () => {
  const {HeadYaw: yaw} = (await stack.truth()).angles;
  const image = await phone.middleOf(".image-main");
  await phone.fingers("touchStart", [{id: 1, x: image.x - 30, y: image.y}]);
  for (let x = -20; x <= 30; x += 10) await phone.fingers("touchMove", [{id: 1, x: image.x + x, y: image.y}]);
  await phone.fingers("touchEnd", []);
  // What is under the finger goes to the right when the head turns to the left, which is positive.
  await until("the head has turned left", async () => (await stack.truth()).angles.HeadYaw - yaw > 5 * kDegree);
  assert.ok(!(await phone.page.locator(".image.large").count()), "a drag counted as a tap");
});

test("a tap on the image enlarges it, another makes it small; the other camera is a tap away", async () => {
  const small = await phone.middleOf(".image-main");
  await phone.tap(".image-main");
  await until("a large image comes", async () => (await phone.look("state.image.width")) === 640);
  assert.ok((await phone.middleOf(".image-main")).radius > 1.5 * small.radius, "it is not larger");
  await phone.tap(".image-camera");
  await until("the bottom camera's image comes", async () => (await phone.look("state.image.camera")) === "bottom");
  await phone.tap(".image-camera");
  await until("the top camera's image comes", async () => (await phone.look("state.image.camera")) === "top");
  await phone.tap(".image-main");
  await until("a small image comes", async () => (await phone.look("state.image.width")) === 320);
});

test("left-handed people get the pads the other way round", async () => {
  const before = await phone.middleOf(".joystick-walk");
  await phone.page.locator(".menu-button").tap();
  await phone.page.locator(".menu[open] [role=switch]").nth(1).tap();
  await phone.page.locator(".menu[open] header .round").tap();
  const after = await phone.middleOf(".joystick-walk");
  assert.ok(before.x < 206 && after.x > 206, `${before.x} and ${after.x}`);
});

for (const [language, stop] of [["pt", "Parar"], ["de", "Stopp"], ["en", "Stop"]]) {
  test(`the language ${language} is remembered, and the app comes back by itself`, async () => {
    await phone.page.locator(".menu-button").tap();
    await Promise.all([phone.page.waitForEvent("load"), phone.page.locator(".menu[open] select").selectOption(language)]);
    await phone.sees("controller");
    assert.equal((await phone.page.locator(".stop").innerText()).trim(), stop);
    assert.equal(await phone.page.evaluate("document.documentElement.lang"), language);
  });
}

test("the phone has no complaint", () => {
  assert.deepEqual(phone.errors, []);
});
