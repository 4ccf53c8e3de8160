// Every screen in every state: laid out and accessible. With NAO_PICTURES=FOLDER at five sizes, in light and dark and in
// four languages, and an image of each is left there: scripts/pictures app.
import assert from "node:assert/strict";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {violations} from "./accessibility.mjs";
import {drawCameraImage, startFake} from "./fake.mjs";
import {faultsOfLayout} from "./layout.mjs";
import {kFewFramesPerSecond, openBrowser, Phone} from "./phone.mjs";
import {kWebDir} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kPictures = process.env.NAO_PICTURES;
/** What fades in, or glides, would be judged half-way. */
const kStill = {reducedMotion: "reduce"};
const kDesk = {isMobile: false, hasTouch: false};
const kDark = {colorScheme: "dark"};
const kLight = {colorScheme: "light"};
const kPasses = [
  {name: "320-light-de", size: [320, 568], options: {...kLight, locale: "de-DE"}},
  {name: "320-dark-pt", size: [320, 568], options: {...kDark, locale: "pt-PT"}},
  {name: "412-light-en", size: [412, 915], options: {...kLight, locale: "en-US"}},
  {name: "412-dark-de", size: [412, 915], options: {...kDark, locale: "de-DE"}},
  {name: "915-light-pt", size: [915, 412], options: {...kLight, locale: "pt-PT"}},
  {name: "915-dark-en", size: [915, 412], options: {...kDark, locale: "en-US"}, isTypical: true},
  {name: "768-light-pt", size: [768, 1024], options: {...kLight, locale: "pt-PT"}},
  {name: "1024-dark-de", size: [1024, 768], options: {...kDark, locale: "de-DE"}},
  {name: "desk-light-de", size: [1280, 800], options: {...kLight, ...kDesk, locale: "de-DE"}, isTypical: true},
  {name: "desk-dark-pt", size: [1280, 800], options: {...kDark, ...kDesk, locale: "pt-PT"}},
  // From right to left.
  {name: "412-light-ar", size: [412, 915], options: {...kLight, locale: "ar-EG"}, isTypical: true},
  {name: "320-dark-ar", size: [320, 568], options: {...kDark, locale: "ar-EG"}},
  {name: "915-dark-ar", size: [915, 412], options: {...kDark, locale: "ar-EG"}},
  {name: "desk-light-ar", size: [1280, 800], options: {...kLight, ...kDesk, locale: "ar-EG"}},
  // Letters 10 % wider, as of another font: half a pixel to one more beside each.
  {name: "320-wide-de", size: [320, 568], options: {...kLight, locale: "de-DE"}, spacing: ".05em", isTypical: true},
  {name: "915-wide-ar", size: [915, 412], options: {...kDark, locale: "ar-EG"}, spacing: ".05em"},
  {name: "412-letters-200", size: [412, 915], options: kDark, letters: "200%"},
];

let browser;
let fake;
let match;
let folder;

before(async () => {
  browser = await openBrowser(kWebDir);
  folder = mkdtempSync(join(tmpdir(), "nao-image-"));
  const image = join(folder, "image.jpg");
  await drawCameraImage(browser, image);
  fake = await startFake({NAO_PLAYS: "1", NAO_IMAGE: image});
  match = await startFake({NAO_PLAYS: "1", NAO_IMAGE: image, NAO_MATCH: "1"});
});
after(async () => {
  await browser?.close();
  fake?.end();
  match?.end();
  rmSync(folder, {recursive: true, force: true});
});

/** As set by a phone that shows large or wide letters. */
function setPage({letters, spacing}) {
  const set = () => {
    if (letters) document.documentElement.style.fontSize = letters;
    if (spacing) document.documentElement.style.letterSpacing = spacing;
  };
  if (document.documentElement) set();
  document.addEventListener("DOMContentLoaded", set);
}

for (const {name, size: [width, height], options, ...page} of kPasses.filter((pass) => kPictures || pass.isTypical)) {
  test(`every screen is laid out and accessible: ${name}`, async () => {
    const faults = [];
    const open = async (url, person) => {
      const phone = await Phone.open(browser, "about:blank", {width, height},
                                     {...options, ...kStill, name: person, framesPerSecond: kFewFramesPerSecond});
      await phone.context.addInitScript(setPage, page);
      await phone.page.goto(url);
      return phone;
    };
    const look = async (phone, state) => {
      await phone.rests();
      if (kPictures) await phone.page.screenshot({path: join(kPictures, `${name}-${state}.png`)});
      for (const fault of [...await faultsOfLayout(phone), ...await violations(phone)]) faults.push(`${state}: ${fault}`);
    };
    const click = (phone, selector) => phone.page.locator(selector).click();

    const ana = await open(fake.url, "Ana");
    await ana.sees("controller");
    await until("the postures are drawn", async () => (await ana.page.locator(".postures canvas").count()) > 0);
    await until("an image", async () => (await ana.look("numImages")) > 0);
    await look(ana, "drive");
    await click(ana, ".image-main");
    await look(ana, "swapped");
    await click(ana, (await ana.page.locator(".camera-large").count()) ? ".stage" : ".image-main");
    if (await ana.page.locator(".more-button").isVisible()) {
      await click(ana, ".more-button");
      await look(ana, "more");
      await click(ana, ".more-button");
    }
    await click(ana, ".joints-button");
    await click(ana, '.joints-panel [data-name="left shoulder"]');
    await look(ana, "joints");
    await click(ana, ".teach-add");
    await look(ana, "teach");
    await click(ana, ".teach-open");
    await click(ana, ".pose-title");
    await look(ana, "motions");
    await click(ana, ".motions header .round");
    await click(ana, ".joints-button");
    await click(ana, ".speech-button");
    await look(ana, "speech");
    await click(ana, ".speech-sheet header .round");
    await click(ana, ".menu-button");
    await look(ana, "menu");
    await click(ana, ".menu[open] header .round");
    await click(ana, '[data-name="LyingBack"]');
    await until("it lies", async () => (await ana.look("state.state.posture")) === "LyingBack");
    // Beside a message, which goes away soon, it is smaller.
    await until("no message is shown", async () => (await ana.page.locator(".message:visible").count()) === 0);
    await look(ana, "lying");
    assert.equal(await ana.page.locator(".strips .chip:visible").count(), 1, "lying, it can only get up");
    const ben = await open(fake.url, "Ben");
    await ben.sees("controller");
    await click(ben, ".driver-button");
    await ana.page.locator('.cause [data-remedy="hand-over"]').waitFor();
    await look(ana, "asked");
    await look(ben, "next");
    await click(ana, '.cause [data-remedy="hand-over"]');
    await until("Ben drives", () => ben.look("state.control.isMine"));
    const {token, robot} = await ben.page.evaluate(() => ({token: location.hash, robot: window.naoRemote.state.robot.name}));
    assert.deepEqual([token, robot], ["", "NAO"], "the code stays in sight");
    // The robot stands for the next one.
    await ben.page.evaluate(() => document.querySelector('[data-name="StandInit"]').click());
    await until("it stands", async () => (await ben.look("state.state.posture")) === "StandInit");
    for (const phone of [ana, ben]) {
      assert.deepEqual(phone.errors, []);
      await phone.close();
    }

    const eva = await open(fake.url.replace("token=fake", "token=old"), "Eva");
    await eva.page.locator(".problem").waitFor();
    await look(eva, "code");
    const submit = await eva.page.locator('.card [type="submit"]').boundingBox();
    assert.ok(submit.y + submit.height <= height, `code: the button ends at ${submit.y + submit.height} px`);
    await eva.close();

    const dan = await open(match.url, "Dan");
    await dan.sees("lobby");
    await look(dan, "lobby");
    await click(dan, '[data-robot="NAO"] .robot-drive');
    await dan.sees("controller");
    await until("the postures are drawn", async () => (await dan.page.locator(".postures canvas").count()) > 0);
    await look(dan, "match");
    await dan.page.route("**/ws", (route) => route.abort());
    await dan.context.setOffline(true);
    await dan.page.locator('.cause [data-remedy="retry"]').waitFor();
    await look(dan, "lost");
    await dan.close();
    assert.deepEqual(faults, []);
  });
}

/** In the page: frames take long. */
function beSlow() {
  const end = performance.now() + 40;
  while (performance.now() < end);
  requestAnimationFrame(beSlow);
}

/** In the page: the pixels of the frame that is drawn next. */
async function takeFrame() {
  const canvas = document.querySelector("canvas.stage");
  const {numFrames} = window.naoRemote;
  while (window.naoRemote.numFrames === numFrames) await new Promise(requestAnimationFrame);
  const {width, height} = canvas;
  const copy = Object.assign(document.createElement("canvas"), {width, height}).getContext("2d");
  copy.drawImage(canvas, 0, 0);
  return {width, ratio: width / canvas.clientWidth, data: copy.getImageData(0, 0, width, height).data};
}

/** In the page: how many edges there are in a frame, between pixels two apart, and how many of them are smooth: the pixel between
 * lies between both. */
function countEdges({data, ratio}) {
  let numEdges = 0;
  let numSmooth = 0;
  for (let i = 4; i < data.length - 4; i += 4) {
    const [before, at, after] = [data[i - 4], data[i], data[i + 4]];
    if (Math.abs(after - before) < 60) continue;
    numEdges++;
    if (Math.abs(2 * at - before - after) < 0.6 * Math.abs(after - before)) numSmooth++;
  }
  return {numEdges, numSmooth, ratio};
}

/** In the page: how many pixels of one column, at the most, differ from those on both sides, which are alike; left of the robot. */
function countMarks({data, width}) {
  const numMarks = new Uint32Array(width);
  for (let i = 4; i < data.length - 4; i += 4) {
    const [before, at, after] = [data[i - 4], data[i], data[i + 4]];
    const column = i / 4 % width;
    if (column < 0.35 * width && Math.abs(after - before) < 10 && Math.abs(2 * at - before - after) > 30) numMarks[column]++;
  }
  return Math.max(...numMarks);
}

test("where a processor draws large pixels their edges are smooth", async (t) => {
  const alone = await startFake();
  t.after(() => alone.end());
  const phone = await Phone.open(browser, "about:blank", {width: 1280, height: 800}, kDesk);
  const ofFrame = (count) => phone.page.evaluate(`(${takeFrame})().then(${count})`);
  // The field's lines would be edges too.
  await phone.context.route("**/scene.yaml", (route) => route.fulfill({body: ""}));
  const walkSlowly = async () => {
    await phone.sees("controller");
    await phone.page.evaluate(beSlow);
    await phone.page.keyboard.down("w");
  };
  await phone.page.goto(alone.url);
  await walkSlowly();
  // What smooths them is fetched then.
  const found = await until("fewer pixels are drawn, and a sixth of the edges is smooth", async () => {
    const found = await ofFrame(countEdges);
    return found.ratio < 0.6 && found.numEdges > 100 && found.numSmooth > found.numEdges / 6 && found;
  });
  t.diagnostic(`${found.numSmooth} of ${found.numEdges} edges are smooth`);
  // What is smoothed ends within the field's lines: nothing is seen of its border.
  await phone.page.keyboard.up("w");
  await phone.context.unroute("**/scene.yaml");
  await phone.page.reload();
  await walkSlowly();
  await until("fewer pixels are drawn again", async () => (await ofFrame(countEdges)).ratio < 0.6);
  for (let i = 0; i < 20; i++) assert.ok((await ofFrame(countMarks)) <= 5, "a border is seen");
  assert.deepEqual(phone.errors, []);
  await phone.close();
});
