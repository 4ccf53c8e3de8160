// Speech and lights: texts said by the real nao-speaker, sound on the phone, kept phrases, colours of the lights.
import assert from "node:assert/strict";
import {test} from "node:test";
import {setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

const {stack, phone} = setUp({prepare});
const kMaxBytes = 1000;
const kRed = 0xff0000;

/** Number of texts that nao-speaker has spoken, from its status. */
const numSpoken = async () => {
  const programs = JSON.parse(await stack.nao("status", "--json"));
  return programs.find(({program}) => program === "nao-speaker").metrics.texts_spoken;
};
const lights = () => phone.look("state.state.lightRgb");
const write = (text) => phone.page.locator(".speech-sheet textarea").fill(text);
const phrases = () => phone.page.locator(".phrase .chip").allTextContents();

async function prepare(phone) {
  stack.run("nao-speaker", ["--output", "none"]);
  await until("nao-speaker is ready", () => stack.nao("status", "--wait", "nao-speaker", "--timeout", "60"));
  // What the page gives to the browser's sound output.
  await phone.page.evaluate(() => {
    window.heard = [];
    const start = AudioBufferSourceNode.prototype.start;
    AudioBufferSourceNode.prototype.start = function(...when) {
      const samples = this.buffer.getChannelData(0);
      window.heard.push({seconds: this.buffer.duration, loudest: Math.max(...samples.map(Math.abs))});
      return start.apply(this, when);
    };
  });
  await phone.tap(".speech-button");
}

test("a text is said, and the eyes light while it is", async () => {
  const before = await lights();
  await write("Good morning, dear visitors, and welcome.");
  await phone.tap(".speech-say");
  await until("the eyes light", async () => (await lights()).some((rgb, i) => rgb !== before[i]));
  await until("it has been said", async () => (await numSpoken()) === 1);
  await until("the lights are as before", async () => (await lights()).every((rgb, i) => rgb === before[i]));
});

test("a phone plays what the robot says, once it wants to", async () => {
  assert.equal(await phone.page.evaluate("heard.length"), 0);
  await phone.tap(".speech-sheet [role=switch]");
  await write("One, two, three.");
  await phone.page.locator(".speech-sheet textarea").press("Enter");
  await until("half a second of sound is played", () =>
      phone.page.evaluate("heard.reduce((sum, {seconds}) => sum + seconds, 0) > 0.5"));
  assert.ok(await phone.page.evaluate("Math.max(...heard.map(({loudest}) => loudest))") > 0.05);
  await until("it has been said", async () => (await numSpoken()) === 2);
});

test("Be quiet ends a long text", async () => {
  await write("And so on, and so on. ".repeat(40));
  await phone.tap(".speech-say");
  const dark = await lights();
  await until("the eyes light", async () => (await lights()).some((rgb, i) => rgb !== dark[i]));
  await phone.tap(".speech-stop");
  await until("the eyes are dark", async () => (await lights()).every((rgb, i) => rgb === dark[i]), 5000);
});

test("a text that is too long is refused in words before it is sent", async () => {
  const spoken = await numSpoken();
  await write("é".repeat(kMaxBytes / 2 + 1));
  assert.match(await phone.page.locator(".speech-fault").textContent(), /At most 1000 bytes; this text has 1002/);
  await phone.tap(".speech-say");
  await write("Hello");
  assert.ok(await phone.page.locator(".speech-fault").isHidden());
  assert.equal(await numSpoken(), spoken);
});

test("a kept phrase is said by one tap, is still there after a reload, and can be forgotten", async () => {
  await write("Mind the step");
  await phone.tap(".speech-save");
  assert.equal((await phrases())[0], "Mind the step");
  await phone.page.reload();
  await phone.sees("controller");
  await phone.tap(".speech-button");
  assert.equal((await phrases())[0], "Mind the step");
  const spoken = await numSpoken();
  await phone.page.locator(".phrase .chip").first().tap();
  await until("it has been said", async () => (await numSpoken()) > spoken);
  await phone.page.locator(".phrase-forget").first().tap();
  assert.ok(!(await phrases()).includes("Mind the step"));
});

test("a swatch colours all lights or the chosen one, and so on the robot that is drawn", async () => {
  await phone.tap('.swatch[aria-label="Red"]');
  await until("all lights are red", async () => (await lights()).every((rgb) => rgb === kRed));
  const names = await phone.look("state.robot.lights.map(({name}) => name)");
  await phone.page.locator(".lights select").selectOption(names[0]);
  await phone.tap('.swatch[aria-label="Off"]');
  await until("one is off", async () => (await lights())[0] === 0);
  assert.ok((await lights()).slice(1).every((rgb) => rgb === kRed));
  await phone.page.locator(".lights select").selectOption("");
  await phone.tap('.swatch[aria-label="Off"]');
  await until("all are off", async () => (await lights()).every((rgb) => rgb === 0));
  if (process.env.NAO_SCREENSHOT) await phone.page.screenshot({path: process.env.NAO_SCREENSHOT});
  assert.deepEqual(phone.errors, []);
});
