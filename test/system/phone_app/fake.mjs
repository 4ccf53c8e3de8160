// The app with the fake gateway: whatever state a screen is to be seen in.
import {spawn} from "node:child_process";
import {writeFileSync} from "node:fs";
import {join} from "node:path";
import {kWebDir} from "./set_up.mjs";
import {until} from "./stack.mjs";

const kDataDir = process.env.NAO_DATA_DIR ?? join(process.env.NAO_BIN_DIR ?? "", "../share/nao-remote");

/** @param env  of the fake gateway: NAO_PLAYS, NAO_MATCH, NAO_IMAGE. @return {url, end()}. */
export async function startFake(env = {}) {
  const child = spawn("node", ["node_modules/.bin/vite-node", "test_support/serve_fake.ts", kDataDir],
                      {cwd: kWebDir, env: {...process.env, ...env}, stdio: ["ignore", "pipe", "inherit"]});
  let said = "";
  child.stdout.on("data", (text) => said += text);
  const url = await until("the fake gateway listens", () => /http:\S+/.exec(said)?.[0]);
  return {url, end: () => child.kill("SIGKILL")};
}

/** Draws an image as the head's camera would send it, sky and field with a ball, into a file. */
export async function drawCameraImage(browser, file) {
  const page = await browser.newPage();
  const url = await page.evaluate(() => {
    const canvas = Object.assign(document.createElement("canvas"), {width: 640, height: 480});
    const context = canvas.getContext("2d");
    const fill = (color, ...box) => {
      context.fillStyle = color;
      context.fillRect(...box);
    };
    fill("#b6c6dc", 0, 0, 640, 220);
    fill("#3d7f45", 0, 220, 640, 260);
    fill("#f4f7f4", 0, 250, 640, 6);
    context.fillStyle = "#f2f2f2";
    context.arc(415, 330, 26, 0, 7);
    context.fill();
    return canvas.toDataURL("image/jpeg");
  });
  writeFileSync(file, Buffer.from(url.split(",")[1], "base64"));
  await page.close();
}
