// A recorded run, played again into a gateway without robot: the phone shows the same poses and images.
// NAO_BIN_DIR and NAO_WEB_SOURCE_DIR say where the programs and the app's package.json are.
import assert from "node:assert/strict";
import {execFile, spawn} from "node:child_process";
import {mkdtemp, rm} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {fileURLToPath} from "node:url";
import {promisify} from "node:util";
import {setUp} from "./set_up.mjs";
import {pause, until} from "./stack.mjs";

const kDegree = Math.PI / 180;
const kReplay = fileURLToPath(new URL("../../../scripts/replay", import.meta.url));

const {stack, openPhone} = setUp({scene: null, hasPhone: false});
let folder;
let log;
let crouched;

before(async () => {
  folder = await mkdtemp(join(tmpdir(), "nao-replay-"));
  log = join(folder, "run.lcmlog");
});

after(async () => {
  await rm(folder, {recursive: true, force: true});
});

test("a run to Crouch is recorded", async () => {
  await stack.start();
  const watcher = await openPhone();
  await until("a client watches", async () => (await watcher.look("numImages")) > 0);
  const logger = spawn("lcm-logger", ["--quiet", `--lcm-url=${stack.lcmUrl}`, log], {stdio: "ignore"});
  try {
    await pause(1000);
    await stack.nao("posture", "Crouch");
    await pause(2000);
    crouched = await stack.truth();
  } finally {
    logger.kill();
  }
  await watcher.page.close();
  await stack.stop();
  assert.ok(Math.abs(crouched.torso[2] - 0.229) < 0.015, `the torso is at ${crouched.torso[2]} m`);
});

test("played again, the phone shows the robot crouch, and its images", async () => {
  await stack.startGateway();
  const phone = await openPhone();
  await phone.sees("controller");
  const replay = promisify(execFile)(kReplay, ["--lcm-url", stack.lcmUrl, log]);
  replay.catch(() => {});
  await until("the phone shows the recorded angles within 1 degree", async () => {
    const shown = await phone.look("jointAngles()");
    return Object.entries(crouched.angles).every(
        ([name, angle]) => Math.abs(shown[name] - angle) < 1 * kDegree);
  });
  const height = (await phone.look("torsoPosition()"))[2];
  assert.ok(Math.abs(height - 0.229) < 0.02, `the phone shows the torso at ${height} m`);
  assert.ok(await phone.look("numImages") > 0, "no recorded image was drawn");
  await replay;
});
