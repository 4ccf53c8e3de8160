// Makes an image of the app while a finger walks a robot: node robot_image.mjs FILE.png MODEL. Wants pngquant and
// fonts-roboto-unhinted. NAO_BIN_DIR, NAO_WEB_SOURCE_DIR as for the tests.
import {execFileSync} from "node:child_process";
import {openBrowser, Phone} from "./phone.mjs";
import {Stack, until} from "./stack.mjs";

const kSize = {width: 1000, height: 640};
/** Simulated seconds per wall second: the software renderer shares the processor with the robot. */
const kPace = 0.3;
/** The image is taken after this way, m. */
const kWay = 0.5;

const [file, model] = process.argv.slice(2);
if (!model) throw new Error("usage: node robot_image.mjs FILE.png MODEL");

const stack = new Stack(process.env.NAO_BIN_DIR);
try {
  await stack.start({scene: "soccer", model, pace: kPace});
  const browser = await openBrowser(process.env.NAO_WEB_SOURCE_DIR);
  const phone = await Phone.open(browser, stack.url, kSize);
  await phone.sees("controller");
  await until("an image", async () => (await phone.look("numImages")) > 2);
  await until("the robot stands", async () => (await phone.look("mode")) === "holding");
  const start = (await stack.truth()).torso;
  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.7 * pad.radius}]);
  await until("it has walked", async () => (await stack.truth()).torso[0] - start[0] > kWay);
  await phone.page.screenshot({path: file});
  await phone.lift();
  await browser.close();
  execFileSync("pngquant", ["--force", "--speed", "1", "--output", file, "256", file]);
  console.log(file);
} finally {
  await stack.stop();
}
