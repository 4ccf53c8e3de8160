// Makes docs/images/app-*.png with the real programs: node screenshots.mjs OUTPUT_DIR [SIZE or SCREEN...]. Wants pngquant, and
// fonts-roboto-unhinted so that letters look as on a phone. NAO_BIN_DIR, NAO_WEB_SOURCE_DIR as for the tests.
import {execFileSync} from "node:child_process";
import {mkdirSync, statSync} from "node:fs";
import {join} from "node:path";
import {openBrowser, Phone} from "./phone.mjs";
import {pause, Stack, until} from "./stack.mjs";

const kMaxBytes = 150_000;
const kSizes = {small: [360, 640], portrait: [412, 915], landscape: [915, 412], tablet: [1280, 800]};
/** Software drawing is slow: the view has come to rest after this, ms. */
const kRestMs = 2500;
/** Pings wait while it draws; so long at the most, ms. */
const kGoodLatencyMs = 40;
const kLinkMs = 12_000;

const [outputDir, ...words] = process.argv.slice(2);
if (!outputDir) throw new Error("usage: node screenshots.mjs OUTPUT_DIR [SIZE or SCREEN...]");
const wantedSizes = words.filter((word) => word in kSizes);
const wantedScreens = words.filter((word) => !(word in kSizes));
mkdirSync(outputDir, {recursive: true});

/** Makes the app draw in full quality, as on a phone, although the processor draws here. */
const kGraphicsChip = () => {
  const kUnmaskedRenderer = 0x9246;
  const {getParameter} = WebGL2RenderingContext.prototype;
  WebGL2RenderingContext.prototype.getParameter = function (name) {
    return name === kUnmaskedRenderer ? "a graphics chip" : getParameter.call(this, name);
  };
};

const stack = new Stack(process.env.NAO_BIN_DIR);

async function take(phone, name) {
  if (wantedScreens.length > 0 && !wantedScreens.includes(name.split("-")[0])) return;
  await pause(kRestMs);
  // The link indicator would show the software renderer's delay.
  await until("the link is good", async () => (await phone.look("state.latencyMs")) < kGoodLatencyMs, kLinkMs).catch(() => {});
  const file = join(outputDir, `app-${name}.png`);
  await phone.page.screenshot({path: file});
  // As many colours as fit the size.
  for (const colors of [256, 160, 96, 64]) {
    execFileSync("pngquant", ["--force", "--speed", "1", "--output", file, String(colors), file]);
    if (statSync(file).size <= kMaxBytes) break;
  }
  console.log(file, statSync(file).size);
}

const screens = {
  async connection(phone, name) {
    await phone.page.locator(".problem").waitFor();
    await take(phone, `connection-${name}`);
    await phone.page.locator('[name="token"]').fill(stack.token);
    await phone.page.locator('[name="client-name"]').fill("Ana");
    // One file that does not come: the loading screen stays for its image.
    let release;
    await phone.page.route("**/Head.glb", (route) => release = () => route.continue());
    await phone.tap('.card [type="submit"]');
    await until("the rest is loaded", () => release !== undefined);
    await take(phone, `loading-${name}`);
    release();
    await phone.sees("controller");
    await until("an image", async () => (await phone.look("numImages")) > 2);
  },
  async drive(phone, name) {
    await phone.page.locator('[data-name="StandInit"]').tap();
    await take(phone, `drive-${name}`);
  },
  async image(phone, name) {
    await phone.tap(".image-main");
    await take(phone, `image-${name}`);
    await phone.tap(".image-main");
  },
  async joints(phone, name) {
    await phone.tap(".joints-button");
    await phone.page.locator('[data-name="left shoulder"]').tap();
    await take(phone, `joints-${name}`);
    await phone.tap(".joints-button");
  },
  async teach(phone, name) {
    await phone.tap(".joints-button");
    await phone.tap(".teach-add");
    await phone.tap(".teach-open");
    await take(phone, `teach-${name}`);
    await phone.tap(".motions header .round");
    await phone.tap(".joints-button");
  },
  async speech(phone, name) {
    await phone.tap(".speech-button");
    await take(phone, `speech-${name}`);
    await phone.tap(".speech-sheet header .round");
  },
  async menu(phone, name) {
    await phone.page.locator(".menu-button").tap();
    await take(phone, `menu-${name}`);
  },
};

/** The robots of a match of two against two: one is driven, one is away. */
async function takeLobby(browser) {
  if (wantedScreens.length > 0 && !wantedScreens.includes("lobby")) return;
  await stack.stop();
  const robots = [0, 0, 1, 1].map((team, i) => ({name: `NAO${i + 1}`, model: "nao", team, number: 2 + i % 2, isAbsent: i > 2}));
  await stack.startSeveral(robots);
  const driver = await Phone.open(browser, stack.url, undefined, {name: "Ana"});
  await driver.page.locator('[data-robot="NAO1"][data-driver="free"] .robot-drive').tap();
  await driver.sees("controller");
  for (const [name, [width, height]] of Object.entries(kSizes)) {
    if (wantedSizes.length > 0 && !wantedSizes.includes(name)) continue;
    const phone = await Phone.open(browser, stack.url, {width, height}, {name: "Ben"});
    await phone.page.locator('[data-robot="NAO1"][data-driver="other"]').waitFor();
    await take(phone, `lobby-${name}`);
    await phone.close();
  }
  await driver.close();
}

try {
  await stack.start();
  const browser = await openBrowser(process.env.NAO_WEB_SOURCE_DIR);
  for (const [name, [width, height]] of Object.entries(kSizes)) {
    if (wantedSizes.length > 0 && !wantedSizes.includes(name)) continue;
    const phone = await Phone.open(browser, "about:blank", {width, height});
    await phone.context.addInitScript(kGraphicsChip);
    await phone.page.goto(stack.url.replace(stack.token, "wrong"));
    for (const screen of Object.values(screens)) await screen(phone, name);
    await phone.close();
  }
  await takeLobby(browser);
  await browser.close();
} finally {
  await stack.stop();
}
