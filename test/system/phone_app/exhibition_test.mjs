// An exhibition: two phones, the big display and the operator's page at one gateway, which is killed and started again.
import assert from "node:assert/strict";
import {mkdtemp, readFile, rm, writeFile} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {violations} from "./accessibility.mjs";
import {setUp} from "./set_up.mjs";
import {pause, until} from "./stack.mjs";

const kSettings = `
turn: 60
idle: 40
changeover: 2
speed: 1
forbidden: [dive]
fence: {frame: start, corners: [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]}
challenge: {gate: [[0.1, -0.4], [0.1, 0.4]]}
`;
const kSecret = "operators";
/** Small: the processor draws for all. */
const kSize = {width: 360, height: 640};
/** Overshoot of the fence that is allowed, m. */
const kOvershoot = 0.1;

const {stack, openPhone} = setUp({scene: null, hasPhone: false});
let folder;
let [ana, ben, screen, tablet] = [];

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "nao-exhibition-"));
  await writeFile(join(folder, "fair.yaml"), kSettings);
  await writeFile(join(folder, "secret"), `${kSecret}\n`);
  stack.gatewayOptions = ["--exhibition", join(folder, "fair.yaml"), "--exhibition-state", join(folder, "state.json"),
                          "--exhibition-report", join(folder, "report.txt"), "--operator-secret-file", join(folder, "secret")];
  await stack.start({scene: "empty"});
});
after(() => rm(folder, {recursive: true, force: true}));

const text = (phone, selector) => phone.page.locator(selector).textContent();
const says = (phone, selector, pattern) => until(`${selector} says ${pattern}`, async () => pattern.test(await text(phone, selector)));
const phase = (phone) => phone.look("state.exhibition.phase");
const mayDrive = (phone) => until("it is the phone's turn", async () => (await phase(phone)) === 2);
const page = (name) => stack.url.replace("/#", `/${name}#`);
/** The operator's button with this text. */
const press = (name) => tablet.page.getByRole("button", {name, exact: true}).tap();

async function walk(phone) {
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.9 * pad.radius}]);
}

test("the first visitor drives, the second waits with place and time", async () => {
  ana = await openPhone(stack.url, kSize);
  await ana.sees("controller");
  await mayDrive(ana);
  assert.ok(await ana.page.locator(".visit-turn").isVisible());
  assert.match(await text(ana, ".visit-turn"), /[01]:\d\d left/);
  ben = await openPhone(stack.url, kSize);
  await ben.sees("controller");
  await says(ben, ".visit-card h1", /^You are /);
  assert.equal(await text(ben, ".visit-big"), "You are next");
  assert.match(await text(ben, ".visit-detail"), /in (less than|about)/);
  assert.deepEqual(await violations(ben), []);
});

test("a second scan of the same phone is the same place", async () => {
  const again = await ben.context.newPage();
  await again.goto(stack.url);
  await again.locator(".visit-card").waitFor();
  assert.equal(await ana.look("state.exhibition.numWaiting"), 1);
  await again.close();
  await ben.page.reload();
  await ben.sees("controller");
  await says(ben, ".visit-big", /You are next/);
});

test("the big display shows code, driver, countdown and queue", async () => {
  screen = await openPhone(page("screen"), {width: 1280, height: 720}, {isMobile: false});
  await says(screen, ".screen-head h1", / drives$/);
  assert.match(await text(screen, ".screen-time"), /^\d:\d\d$/);
  const name = await ben.look("state.exhibition.nickname");
  await until("the queue is shown", async () => (await text(screen, ".screen-queue")) === name);
  assert.ok(await screen.page.evaluate(() => document.querySelector(".screen-code").naturalWidth > 50), "there is no code");
  await until("an image comes", () => screen.page.evaluate(() => document.querySelector(".live-image").naturalWidth === 640));
  assert.deepEqual(await violations(screen), []);
});

test("a driver passes the gate, and the fence holds the robot", async () => {
  await walk(ana);
  await until("the time is shown", async () => /\d\.\d s/.test(await text(ana, ".visit-turn span")));
  await says(screen, ".screen-best", /^Best today: /);
  let ahead = 0;
  await until("the robot walks on no longer", async () => {
    const before = (await stack.truth()).torso[0];
    await pause(1500);
    ahead = (await stack.truth()).torso[0];
    return before > 0.3 && Math.abs(ahead - before) < 0.01;
  });
  await ana.lift();
  assert.ok(ahead < 0.5 + kOvershoot, `${ahead} m`);
});

test("the operator pauses, forbids, prolongs and passes the turn on", async (t) => {
  tablet = await openPhone(`${page("operator")}&secret=${kSecret}`, {width: 800, height: 1280});
  await says(tablet, ".operator h1", / drives$/);
  assert.deepEqual(await violations(tablet), []);
  await press("Pause");
  await ana.page.locator(".visit-card").waitFor();
  assert.equal(await text(ana, ".visit-detail"), "A short pause");
  await press("Go on");
  await mayDrive(ana);
  await press("Kicks: allowed");
  await tablet.page.getByRole("button", {name: "Kicks: forbidden"}).waitFor();
  const before = await ana.look("state.exhibition.turnLeft");
  await press("30 s more");
  await until("the turn is longer", async () => (await ana.look("state.exhibition.turnLeft")) > before + 20);
  await press("End this turn");
  await says(ana, ".visit-card h1", /^Thank you/);
  await mayDrive(ben);
  t.diagnostic(await text(ana, ".visit-card"));
});

test("a gateway that is killed goes on where it was", async () => {
  await ana.page.getByRole("button", {name: "Once more"}).tap();
  await says(ana, ".visit-big", /You are next/);
  const left = await ben.look("state.exhibition.turnLeft");
  // What is written each second.
  await pause(1500);
  await stack.end("nao-phone-gateway", "SIGKILL");
  await stack.startGateway();
  await until("the driver is back", async () =>
      (await ben.look("state.phase")) === "connected" && (await phase(ben)) === 2);
  const now = await ben.look("state.exhibition.turnLeft");
  assert.ok(now > 0 && now <= left + 5, `${left} s, then ${now} s`);
  await until("the other one waits again", async () => (await phase(ana)) === 1);
  assert.equal(await ana.look("state.exhibition.driver"), await ben.look("state.exhibition.nickname"));
});

test("the operator's page refuses a wrong secret, and the report is written", async () => {
  const other = await openPhone(`${page("operator")}&secret=guess`, {width: 800, height: 1280});
  await says(other, ".operator-fault", /secret is wrong/);
  await other.close();
  await until("the report has both", async () => /drove: 2,/.test(await readFile(join(folder, "report.txt"), "utf8")));
  for (const phone of [ana, ben, screen, tablet]) {
    // While the gateway was gone, requests failed, those by the copy of the app too.
    assert.deepEqual(phone.errors.filter((error) => !/WebSocket|ERR_CONNECTION|ERR_FAILED/.test(error)), []);
  }
});
