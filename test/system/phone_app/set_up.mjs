// Objects that the tests of a file share from before the first to after the last: the programs, a browser, a phone.
// NAO_BIN_DIR and NAO_WEB_SOURCE_DIR say where the programs and the app's package.json are. With NAO_PHONE_URL no
// program is started: the phones open that page, such as the one of `npm run fake`.
import {after, before} from "node:test";
import {kFewFramesPerSecond, openBrowser, Phone} from "./phone.mjs";
import {Stack} from "./stack.mjs";

export const kWebDir = process.env.NAO_WEB_SOURCE_DIR;

/** @param scene  the simulated world; null: the tests start the programs themselves.
 * @param robots  several robots, as Stack.startSeveral() takes them; none: one robot of `model`.
 * @param pace  simulated seconds per second, of several robots.
 * @param model  the robot, a folder of robots/.
 * @param hasPhone  true: `phone` sees the controller before the first test.
 * @param framesPerSecond  how many a phone draws at most, 0: as many as it can.
 * @param browserOptions  more options of Chromium.
 * @param prepare  what it does then, still before the first test.
 * @return {stack, phone, openPhone}; openPhone(url, size, options) opens one more. */
export function setUp({scene = "empty", model = "nao", robots = [], pace = 1, hasPhone = true, prepare = () => {},
                       framesPerSecond = kFewFramesPerSecond, browserOptions = []} = {}) {
  const url = process.env.NAO_PHONE_URL;
  const stack = url ? {url, start: () => {}, stop: () => {}} : new Stack(process.env.NAO_BIN_DIR);
  const phone = new Phone();
  let browser;
  before(async () => {
    if (robots.length > 0) await stack.startSeveral(robots, {scene, pace});
    else if (scene) await stack.start({scene, model});
    browser = await openBrowser(kWebDir, browserOptions);
    if (!hasPhone) return;
    await phone.open(browser, stack.url, undefined, {framesPerSecond});
    await phone.sees("controller");
    await prepare(phone);
  });
  after(async () => {
    await browser?.close();
    await stack.stop();
  });
  return {stack, phone, openPhone: (url = stack.url, size, options) =>
      Phone.open(browser, url, size, {framesPerSecond, ...options})};
}
