// Phones that do not run Chrome: connect, image, drive, joints and teach, in WebKit (as on iPhones) and in Firefox.
import assert from "node:assert/strict";
import {createServer} from "node:net";
import {after, before, describe, test} from "node:test";
import {Firefox, WebKit} from "./remote_browsers.mjs";
import {kWebDir, setUp} from "./set_up.mjs";
import {until} from "./stack.mjs";

/** Pages that a processor draws beside the simulation are slow. */
const kDeadlineMs = 60_000;
/** A motion is simulated four times, at low priority. */
const kCheckMs = 240_000;
const kMoved = 0.1;

const {stack} = setUp({hasPhone: false});

function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const {port} = server.address();
      server.close(() => resolve(port));
    });
  });
}

for (const Browser of [WebKit, Firefox]) {
  const skip = Browser.isInstalled() ? false : `${Browser.name} is not installed (${Browser.packages})`;
  describe(Browser.name, {skip}, () => {
    const browser = new Browser();
    const look = (expression) => browser.evaluate(`window.naoRemote.${expression}`);
    const isSeen = (selector) => browser.evaluate(`document.querySelector(${JSON.stringify(selector)})?.checkVisibility() ?? false`);
    const seen = (selector) => until(`${selector} is seen`, () => isSeen(selector), kDeadlineMs);

    /** Middle of an element that is seen, px, and its half width. */
    async function middleOf(selector) {
      await seen(selector);
      return browser.evaluate(`(() => {
        const element = document.querySelector(${JSON.stringify(selector)});
        element.scrollIntoView({block: "nearest", inline: "nearest"});
        const {x, y, width, height} = element.getBoundingClientRect();
        return {x: Math.round(x + width / 2), y: Math.round(y + height / 2), radius: width / 2};
      })()`);
    }

    async function tap(selector) {
      const {x, y} = await middleOf(selector);
      await browser.act([{type: "pointerMove", x, y, duration: 0}, {type: "pointerDown", button: 0}, {type: "pause", duration: 50},
                         {type: "pointerUp", button: 0}]);
    }

    /** Holds a pad off its middle until something is so. */
    async function hold(selector, right, up, what, isSo) {
      const {x, y, radius} = await middleOf(selector);
      await browser.act([{type: "pointerMove", x, y, duration: 0}, {type: "pointerDown", button: 0},
                         {type: "pointerMove", x: Math.round(x + right * radius), y: Math.round(y - up * radius), duration: 100}]);
      await until(what, isSo, kDeadlineMs).finally(() => browser.act([{type: "pointerUp", button: 0}]));
    }

    const angle = async (joint) => (await look("jointAngles()"))[joint];
    const turn = async (up) => {
      const before = await angle("RShoulderPitch");
      await hold(".joystick-joint", 0, up, "the arm has turned", async () =>
          Math.abs(await angle("RShoulderPitch") - before) > 3 * kMoved);
    };

    before(async () => {
      await browser.start(await freePort(), kWebDir);
      await browser.open(stack.url);
    });
    after(() => browser.close());

    test("connects, draws the robot, and says how to walk", async () => {
      await seen('#app[data-screen="controller"]');
      await until("the robot is drawn", async () => (await look("numFrames")) > 0, kDeadlineMs);
      await seen(".hint");
    });

    test("shows the head's images", async () => {
      await until("images are drawn", async () => (await look("numImages")) > 2, kDeadlineMs);
    });

    test("walks while the pad is held, and stands when it is let go", async () => {
      await hold(".joystick-walk", 0, 0.6, "the robot walks", async () => (await look("mode")) === "walking");
      assert.equal(await isSeen(".hint"), false, "the hint has served");
      await until("the robot stands", async () => (await look("mode")) === "holding", kDeadlineMs);
    });

    test("turns a joint", async () => {
      await tap(".joints-button");
      await browser.evaluate(`document.querySelector('.joints-panel [data-name="right shoulder"]').click()`);
      await turn(0.8);
    });

    test("teaches a motion, plays and saves it", async () => {
      const name = `browser-${Browser.name}`;
      await tap(".teach-add");
      await turn(-0.8);
      await tap(".teach-add");
      await until("two poses are there", async () => (await look("state.draft.keyframes.length")) === 2, kDeadlineMs);
      await tap(".teach-play");
      await until("the robot acts", async () => (await look("state.state.activity?.name")) === "_draft", kCheckMs);
      await until("the motion has ended", async () => (await look("mode")) === "holding", kDeadlineMs);
      await tap(".teach-open");
      await seen(".motion-name");
      await browser.evaluate(`(() => {
        const input = document.querySelector('[name="motion-name"]');
        input.value = ${JSON.stringify(name)};
        input.dispatchEvent(new Event("input", {bubbles: true}));
        return true;
      })()`);
      await tap(".motion-name .primary");
      await until("it is saved", async () => (await look("state.savedMotions")).includes(name), kCheckMs);
      await tap(`.saved-motions [data-name="${name}"] [data-act="motion.removeNamed"]`);
      await until("it is deleted", async () => !(await look("state.savedMotions")).includes(name), kDeadlineMs);
    });
  });
}
