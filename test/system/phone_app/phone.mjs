// A phone: headless Chromium with a touch screen, and fingers that may be down two at a time.
import {createRequire} from "node:module";
import {until} from "./stack.mjs";

const kChromium = process.env.CHROMIUM ?? "/usr/bin/chromium";
const kOptions = [
  "--headless", "--no-sandbox", "--disable-gpu", "--enable-unsafe-swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync",
];

/** Node looks for packages beside the app. @param webDir  folder of its package.json. */
export function requireFromApp(webDir) {
  return createRequire(`${webDir}/package.json`);
}

/** @param options  more options of Chromium. */
export async function openBrowser(webDir, options = []) {
  const {chromium} = requireFromApp(webDir)("playwright-core");
  return chromium.launch({executablePath: kChromium, args: [...kOptions, ...options]});
}

/** In the page: what the app remembers. */
function remember(known) {
  try {
    const settings = JSON.parse(localStorage.getItem("nao-remote") ?? "{}");
    localStorage.setItem("nao-remote", JSON.stringify({...settings, ...known}));
  } catch {
    // about:blank keeps nothing.
  }
}

/** How many frames a second are enough for a test that does not measure them: here a processor draws them. */
export const kFewFramesPerSecond = 5;

/** In the page: it draws no more frames a second. All who wait draw in one frame. */
function drawSeldom(framesPerSecond) {
  const request = window.requestAnimationFrame.bind(window);
  const period = 1000 / framesPerSecond;
  window.requestAnimationFrame = (callback) => setTimeout(() => request(callback), period - performance.now() % period);
}

export class Phone {
  #isTouched = false;
  /** Errors of the page, and errors that it wrote to the console. */
  errors = [];

  static async open(browser, url, size, options) {
    const phone = new Phone();
    await phone.open(browser, url, size, options);
    return phone;
  }

  /** @param size  CSS pixels: {width, height}.
   * @param options  of Playwright's context; isNewcomer: the person has not walked a robot yet; name: what others see;
   * framesPerSecond: how many the page draws at most, 0: as many as it can. */
  async open(browser, url, size = {width: 412, height: 915},
             {isNewcomer = false, name = "", framesPerSecond = 0, ...options} = {}) {
    this.context = await browser.newContext({
      viewport: size, deviceScaleFactor: 1, isMobile: true, hasTouch: true, locale: "en-US", ...options});
    if (!isNewcomer) await this.context.addInitScript(remember, {hasWalked: true});
    if (name) await this.context.addInitScript(remember, {clientName: name});
    if (framesPerSecond > 0) await this.context.addInitScript(drawSeldom, framesPerSecond);
    this.page = await this.context.newPage();
    this.page.on("pageerror", (error) => this.errors.push(error.message));
    this.page.on("console", (message) => {
      if (message.type() === "error") this.errors.push(message.text());
    });
    this.touch = await this.context.newCDPSession(this.page);
    await this.page.goto(url);
  }

  async close() {
    await this.context.close();
  }

  /** Waits until a screen is seen: loading, connection, lobby or controller. */
  async sees(screen, ms = 60_000) {
    await this.page.locator(`#app[data-screen="${screen}"]`).waitFor({timeout: ms});
  }

  /** A value of window.naoRemote, by an expression: "numImages". */
  look(expression) {
    return this.page.evaluate(`window.naoRemote.${expression}`);
  }

  /** Waits for so many animation frames: on a busy machine they come seldom. */
  draws(numFrames) {
    return this.page.evaluate((count) => new Promise((done) => {
      const next = (left) => (left > 0 ? requestAnimationFrame(() => next(left - 1)) : done());
      next(count);
    }), numFrames);
  }

  async tap(selector) {
    await this.page.locator(selector).tap();
  }

  /** Taps a choice, which may be behind "More". */
  async choose(selector) {
    const choice = this.page.locator(selector);
    if (!(await choice.isVisible())) await this.tap(".more-button");
    await choice.tap();
  }

  /** Waits until the robot and the view of it have come to rest. @return where the balls of its groups of joints are drawn, px. */
  async rests() {
    let places = await this.look("ballPlaces()");
    await until("the view is at rest", async () => {
      const last = places;
      await this.draws(2);
      places = await this.look("ballPlaces()");
      return Object.keys(places).every((group) =>
          last[group] && Math.hypot(places[group][0] - last[group][0], places[group][1] - last[group][1]) < 1);
    });
    return places;
  }

  /** The middle of an element, px. */
  async middleOf(selector) {
    const box = await this.page.locator(selector).boundingBox();
    return {x: box.x + box.width / 2, y: box.y + box.height / 2, radius: box.width / 2};
  }

  /** As when another app comes to the front, or the screen locks: no finger is reported as lifted.
   * @return when, on the clock of Date.now(), ms. */
  hide() {
    return this.page.evaluate(() => {
      const wallMs = performance.timeOrigin + performance.now();
      Object.defineProperty(document, "visibilityState", {value: "hidden", configurable: true});
      document.dispatchEvent(new Event("visibilitychange"));
      return wallMs;
    });
  }

  async unhide() {
    await this.page.evaluate(() => {
      delete document.visibilityState;
      document.dispatchEvent(new Event("visibilitychange"));
    });
  }

  /** Puts fingers on the glass, moves them, or takes them away: {x, y, id} each, px. */
  async fingers(type, points) {
    this.#isTouched = points.length > 0;
    await this.touch.send("Input.dispatchTouchEvent", {type, touchPoints: points});
  }

  /** Takes all fingers away, if any are down. */
  async lift() {
    if (this.#isTouched) await this.fingers("touchEnd", []);
  }
}
