// Bluetooth: the app's second way to the gateway, in Chromium's emulation.
import assert from "node:assert/strict";
import {mkdtemp, rm} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {violations} from "./accessibility.mjs";
import {kBluetoothOptions, Radio} from "./radio.mjs";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const {stack, openPhone} = setUp({scene: null, hasPhone: false, browserOptions: kBluetoothOptions});
const radio = new Radio();
const kIphone = "Mozilla/5.0 (iPhone; CPU iPhone OS 17_5 like Mac OS X) AppleWebKit/605.1.15 (KHTML, like Gecko) Version/17.5 Mobile/15E148 Safari/604.1";
let folder;
let phone;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "nao-bluetooth-"));
  await radio.start(folder);
  stack.gatewayOptions = ["--bluetooth", "--no-announce"];
  await stack.start({scene: "empty"});
  phone = await openPhone("about:blank", {width: 360, height: 640}, {});
  await radio.reach(phone.page);
});
after(async () => {
  radio.end();
  await rm(folder, {recursive: true, force: true});
});

const field = (name) => phone.page.locator(`input[name="${name}"]`);
/** How the clients are connected. */
const transports = async () => (await stack.driver("list")).match(/\b(websocket|tcp|bluetooth)\b/g) ?? [];

test("a wrong pairing code is refused by Bluetooth", async () => {
  // The gateway's own host needs no code: only its page is secure without https.
  await phone.page.goto(`http://127.0.0.1:${stack.httpPort}/`);
  await phone.sees("controller");
  await phone.tap(".menu-button");
  await phone.tap(".menu-buttons button:last-child");
  await phone.sees("connection");
  assert.deepEqual(await violations(phone), []);
  await field("token").fill("wrong");
  const before = radio.numWrites;
  await phone.tap(".bluetooth");
  await until("the app has written", () => radio.numWrites > before);
  await phone.page.getByText("The pairing code is not the right one.").filter({visible: true}).first().waitFor();
  assert.deepEqual(await transports(), []);
});

test("the phone drives the robot by Bluetooth", async (t) => {
  await field("token").fill(stack.token);
  await phone.tap(".bluetooth");
  await phone.sees("controller");
  assert.deepEqual(await transports(), ["bluetooth"]);
  assert.match(await stack.driver("list"), /AA:BB:CC:DD:EE:FF/);
  await until("images come", async () => (await phone.look("numImages")) > 2);
  const begin = (await stack.truth()).torso;
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.9 * pad.radius}]);
  await until("the robot has walked 0.2 m", async () => {
    const {torso} = await stack.truth();
    return Math.hypot(torso[0] - begin[0], torso[1] - begin[1]) > 0.2;
  });
  t.diagnostic(`latency ${(await phone.look("state.latencyMs")).toFixed(0)} ms`);
});

test("an iPhone is told why it has no Bluetooth", async () => {
  const iphone = await openPhone(`http://127.0.0.1:${stack.httpPort}/`, {width: 360, height: 640}, {userAgent: kIphone});
  await iphone.page.addInitScript(() => Object.defineProperty(navigator, "bluetooth", {value: undefined}));
  await iphone.page.reload();
  await iphone.page.locator(".no-bluetooth").waitFor({state: "attached"});
  assert.equal(await iphone.page.locator(".bluetooth").count(), 0);
  await iphone.close();
});

test("out of reach the robot stops and the app says so; back in reach it connects again", async () => {
  await radio.leave();
  await until("the robot stands", async () => /mode +(holding|standing)/.test(await stack.nao("state")));
  // The gateway hears of the loss first.
  await until("the app connects again", async () =>
    (await phone.look("state.phase")) === "connected" && (await transports()).join() === "bluetooth");
  await phone.fingers("touchEnd", []);
  assert.deepEqual(phone.errors.filter((text) => !/Bluetooth/.test(text)), []);
});
