// What the robot sees and does by itself, on the page: with the fake gateway, which sees a ball.
import assert from "node:assert/strict";
import {after, before, test} from "node:test";
import {startFake} from "./fake.mjs";
import {openBrowser, Phone} from "./phone.mjs";
import {kWebDir} from "./set_up.mjs";
import {until} from "./stack.mjs";

// play_command_t's BEHAVIOR_*.
const kGoToBall = 1;
const kScore = 4;

let fake;
let browser;
const phone = new Phone();

before(async () => {
  fake = await startFake({NAO_PLAYS: "1"});
  browser = await openBrowser(kWebDir);
  await phone.open(browser, fake.url);
  await phone.sees("controller");
});
after(async () => {
  await browser?.close();
  fake?.end();
});

const behavior = () => phone.look("state.playState.behavior");
const activity = () => phone.page.locator(".activity").textContent();

test("a tap on Score begins it, the status says what the robot does, and a second tap ends it", async () => {
  await phone.choose('.play-strip [data-name="score"]');
  await until("the robot plays", async () => (await behavior()) === kScore);
  await until("the status says so", async () => (await activity()) === "Score: walks to the ball");
  await phone.choose('.play-strip [data-name="score"]');
  await until("it has ended", async () => (await behavior()) === 0);
});

test("a hidden page ends what the robot does by itself", async () => {
  await phone.choose('.play-strip [data-name="keep-goal"]');
  await until("the robot plays", async () => (await behavior()) !== 0);
  await phone.hide();
  await until("it has ended", async () => (await behavior()) === 0);
  await phone.unhide();
});

test("the ball is drawn where the robot takes it to be, and a tap on it offers to go there", async () => {
  const ball = await until("the ball is drawn", async () => (await phone.look("soccerBall()")) ?? undefined);
  assert.ok(Math.hypot(ball.x - 0.5, ball.y + 0.2) < 0.01);
  const [x, y] = await phone.look("pagePlace(0.5, -0.2)");
  await phone.page.touchscreen.tap(x, y);
  await phone.tap('.ball-choice [data-name="go-to-ball"]');
  await until("the robot goes to the ball", async () => (await behavior()) === kGoToBall);
  await phone.choose('.play-strip [data-name="go-to-ball"]');
  await until("it has ended", async () => (await behavior()) === 0);
});

test("boxes are drawn over the image until they are switched off", async () => {
  const numDrawn = () => phone.page.locator(".image-marks :is(rect, line)").count();
  await until("boxes are drawn", async () => (await numDrawn()) > 0);
  await phone.tap(".image-boxes");
  await until("they are gone", async () => (await numDrawn()) === 0);
  await phone.tap(".image-boxes");
});

test("the map is there while the robot knows its place, and nothing complains", async () => {
  await phone.page.locator('.more-button[aria-expanded="true"]').waitFor();
  assert.ok(await phone.page.locator(".field-map").isVisible());
  if (process.env.NAO_SCREENSHOT) await phone.page.screenshot({path: process.env.NAO_SCREENSHOT});
  assert.deepEqual(phone.errors, []);
});
