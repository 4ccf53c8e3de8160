// Makes the README's animated image with the real programs: node drive_animation.mjs FILE.webp. A finger walks the robot, then
// taps a kick. Needs img2webp (package webp) and fonts-roboto-unhinted. NAO_BIN_DIR, NAO_WEB_SOURCE_DIR as for the tests.
import {execFileSync} from "node:child_process";
import {mkdtempSync, rmSync, statSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {openBrowser, Phone} from "./phone.mjs";
import {Stack, until} from "./stack.mjs";

const kSize = {width: 800, height: 450};
/** Simulated time between two frames, s. */
const kFramePeriod = 0.125;
/** Simulated seconds per wall second: the software renderer needs about half a second for a screenshot. */
const kPace = 0.2;
const kWalkSeconds = 5;
const kKickSeconds = 4.5;
/** Ball's position for a kick from a stand, m ahead of and to the left of the torso. */
const kBallAhead = 0.17;
const kBallLeft = 0.05;
const kMaxBytes = 2_000_000;

const [file] = process.argv.slice(2);
if (!file) throw new Error("usage: node drive_animation.mjs FILE.webp");

const stack = new Stack(process.env.NAO_BIN_DIR);
const folder = mkdtempSync(join(tmpdir(), "nao-animation-"));
const frames = [];

/** Takes a screenshot every kFramePeriod of simulated time for `seconds` of it. */
async function film(phone, seconds) {
  const begin = (await stack.truth()).time;
  for (let i = 0; i * kFramePeriod < seconds; i++) {
    await until("the next frame is due", async () => (await stack.truth()).time >= begin + i * kFramePeriod);
    const frame = join(folder, `${String(frames.length).padStart(4, "0")}.png`);
    await phone.page.screenshot({path: frame});
    frames.push(frame);
  }
}

async function placeBallAhead() {
  const {torso: [x, y], orientation: [w, qx, qy, z]} = await stack.truth();
  const heading = Math.atan2(2 * (w * z + qx * qy), 1 - 2 * (qy * qy + z * z));
  const ball = [x + kBallAhead * Math.cos(heading) - kBallLeft * Math.sin(heading),
                y + kBallAhead * Math.sin(heading) + kBallLeft * Math.cos(heading)];
  await stack.nao("world", "place-ball", ...ball.map((value) => value.toFixed(3)));
}

try {
  await stack.start();
  const browser = await openBrowser(process.env.NAO_WEB_SOURCE_DIR);
  const phone = await Phone.open(browser, stack.url, kSize);
  await phone.sees("controller");
  await phone.page.locator('[data-name="StandInit"]').tap();
  await until("an image", async () => (await phone.look("numImages")) > 2);
  await until("the robot stands", async () => (await phone.look("mode")) === "holding");
  await stack.nao("world", "set-pace", String(kPace));
  await film(phone, 0.5);

  const pad = await phone.middleOf(".joystick-walk");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.9 * pad.radius}]);
  await film(phone, kWalkSeconds);
  await phone.lift();
  await film(phone, 1.5);

  await placeBallAhead();
  await phone.choose('[data-name="kick-left"]');
  await film(phone, kKickSeconds);
  await browser.close();

  for (const quality of [60, 45, 30]) {
    execFileSync("img2webp", ["-lossy", "-q", String(quality), "-m", "4", "-d", String(1000 * kFramePeriod), ...frames, "-o", file],
                 {stdio: "ignore"});
    if (statSync(file).size <= kMaxBytes) break;
  }
  console.log(file, frames.length, "frames,", statSync(file).size, "bytes");
} finally {
  await stack.stop();
  rmSync(folder, {recursive: true, force: true});
}
