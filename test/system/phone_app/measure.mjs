// Times and memory of the app with the real programs: node measure.mjs [--only PART,PART] [--minutes N]. Prints
// a table; no limits are applied, since machines differ. Parts: load, link, touch, tasks, stop. NAO_BIN_DIR and NAO_WEB_SOURCE_DIR
// as for the tests.
//   first load        bytes over the air, headers among them, until the robot is seen, and the seconds that this takes at 3 Mbit/s
//   link to robot     from following the QR link, in a browser that was never here, to the first frame drawn
//   touch to pixel    from the touch event's own time stamp to the end of drawing the first frame in which the
//                     head has turned by 1 mrad (an encoder's step is 1.5), and the marks on the way
//   hidden to stop    from hiding the page to the end of the true torso's way ahead, on the world's own clock
//   walking           while two joysticks walk: frames a second, processor time of the browser for each, tasks of the page's
//                     main thread above 50 ms
//   memory            with --minutes: heap after collecting garbage, and the processes', while the app drives
import {readFileSync} from "node:fs";
import {parseArgs} from "node:util";
import {Air} from "./air.mjs";
import {openBrowser, Phone} from "./phone.mjs";
import {pause, Stack, until} from "./stack.mjs";

const {values: options} = parseArgs({options: {
  minutes: {type: "string", default: "0"}, only: {type: "string", default: "load,link,touch,tasks,stop"}}});
const isWanted = (part) => options.only.split(",").includes(part);
const kNumLinks = 7;
const kSlowBitsPerSecond = 3e6;
const kNumThumbs = 24;
const kNumHidden = 5;
const kWalkMs = 15_000;
/** The robot has stopped when it is so near to where it ends: m; a step is 40 mm. It has ended after so long: ms. */
const kRest = 0.01;
const kRestWindowMs = 2500;

const stack = new Stack(process.env.NAO_BIN_DIR);
const browser = await openBrowser(process.env.NAO_WEB_SOURCE_DIR);

const quantile = (values, share) => [...values].sort((a, b) => a - b)[Math.floor(share * (values.length - 1))] ?? NaN;
const row = (name, values, unit = "ms") => console.log(
    `${name.padEnd(40)} p50 ${quantile(values, 0.5).toFixed(0)} ${unit}, p90 ${quantile(values, 0.9).toFixed(0)} ${unit}` +
    ` of ${values.length}`);

async function openController() {
  const phone = await Phone.open(browser, stack.url);
  await phone.sees("controller");
  await until("the robot is drawn", () => shownAt(phone));
  return phone;
}

const shownAt = (phone) => phone.page.evaluate(() => performance.getEntriesByName("robot-shown")[0]?.startTime);

async function measureLinks() {
  const times = [];
  for (let i = 0; i < kNumLinks; i++) {
    const phone = await openController();
    times.push(await shownAt(phone));
    await phone.close();
  }
  row("link to robot", times);
}

const kKinds = [["code", /\.js$/], ["styles", /\.css$/], ["robot", /^\/robots\//], ["other", /./]];

async function measureLoad() {
  const times = [];
  for (let i = 0; i < kNumLinks; i++) {
    const air = new Air(stack.httpPort, kSlowBitsPerSecond);
    const port = await air.start();
    const phone = await Phone.open(browser, stack.url.replace(`:${stack.httpPort}`, `:${port}`));
    await until("the robot is drawn", () => shownAt(phone));
    times.push(await shownAt(phone));
    if (i === 0) {
      const parts = Object.fromEntries(kKinds.map(([kind]) => [kind, 0]));
      for (const [path, bytes] of air.bytesOf) parts[kKinds.find(([, pattern]) => pattern.test(path))[0]] += bytes;
      const words = Object.entries(parts).map(([kind, bytes]) => `${kind} ${(bytes / 1000).toFixed(1)}`).join(", ");
      console.log(`${"first load".padEnd(40)} ${(air.numBytes / 1000).toFixed(1)} kB in ${air.paths.length} files: ${words}`);
    }
    await phone.close();
    air.stop();
  }
  row("first load at 3 Mbit/s", times);
}

/** In the page: notes the marks of one deflection of the joystick into window.marks. */
function watchThumb() {
  const {naoRemote} = window;
  const index = naoRemote.state.robot.joints.findIndex(({name}) => name === "HeadYaw");
  const known = () => naoRemote.state.state.jointPosition[index];
  const gl = document.querySelector("canvas.stage").getContext("webgl2");
  const pixel = new Uint8Array(4);
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (bytes) {
    const marks = window.pending;
    if (marks && !marks.sent) marks.sent = performance.now();
    send.call(this, bytes);
  };
  window.marks = [];
  document.querySelector(".joystick-joint").addEventListener("pointerrawupdate", ({timeStamp}) => {
    if (window.isWatching) return;
    window.isWatching = true;
    const marks = window.pending = {moved: timeStamp};
    const shown = naoRemote.jointAngles().HeadYaw;
    const begin = known();
    const look = () => {
      if (!marks.known && Math.abs(known() - begin) > 0.001) marks.known = performance.now();
      if (Math.abs(naoRemote.jointAngles().HeadYaw - shown) < 0.001) return requestAnimationFrame(look);
      // Returns when the frame is drawn.
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
      marks.drawn = performance.now();
      window.marks.push(marks);
      window.pending = null;
    };
    requestAnimationFrame(look);
  }, true);
}

async function measureTouch() {
  const phone = await openController();
  await phone.tap(".joints-button");
  await phone.page.locator('[data-name="head"]').tap();
  await pause(3000);
  const pad = await phone.middleOf(".joystick-joint");
  await phone.page.evaluate(watchThumb);
  for (let i = 0; i < kNumThumbs; i++) {
    const side = i % 2 ? -1 : 1;
    await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
    await phone.fingers("touchMove", [{id: 1, x: pad.x + side * 0.7 * pad.radius, y: pad.y}]);
    await pause(300);
    await phone.fingers("touchEnd", []);
    await pause(450 + 37 * (i % 5));
    await phone.page.evaluate("window.isWatching = false");
  }
  const marks = await phone.page.evaluate("window.marks");
  row("touch to command sent", marks.map(({sent, moved}) => sent - moved));
  row("touch to moved state known", marks.map(({known, moved}) => known - moved).filter(Number.isFinite));
  row("touch to moved pixel", marks.map(({drawn, moved}) => drawn - moved));
  await phone.close();
}

async function touchJoysticks(phone, walk, turn) {
  const left = await phone.middleOf(".joystick-walk");
  const right = await phone.middleOf(".joystick-turn");
  const at = (pad, id, [x, y]) => ({id, x: pad.x + x * pad.radius, y: pad.y - y * pad.radius});
  await phone.fingers("touchStart", [at(left, 1, [0, 0]), at(right, 2, [0, 0])]);
  await phone.fingers("touchMove", [at(left, 1, walk), at(right, 2, turn)]);
}

async function standsReady(phone) {
  await stack.nao("world", "reset");
  await until("the robot stands ready", async () => (await phone.look("state.state.posture")) === "StandInit");
}

async function measureLongTasks() {
  const phone = await openController();
  await phone.page.evaluate(() => {
    window.tasks = [];
    new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map(({duration}) => duration)))
        .observe({type: "longtask"});
    window.numFramesBefore = window.naoRemote.numFrames;
  });
  const whole = await browser.newBrowserCDPSession();
  await touchJoysticks(phone, [0, 0.7], [-0.4, 0]);
  const before = await processorTime(whole);
  await pause(kWalkMs);
  const used = (await processorTime(whole)) - before;
  await phone.fingers("touchEnd", []);
  const {tasks, numFrames} = await phone.page.evaluate(
      () => ({tasks: window.tasks, numFrames: window.naoRemote.numFrames - window.numFramesBefore}));
  console.log(`${"walking".padEnd(40)} ${(numFrames / kWalkMs * 1000).toFixed(0)} frames a second, ${(used / numFrames).toFixed(1)} ms of a core each, ${tasks.length} tasks above 50 ms` +
              (tasks.length ? `, the longest ${Math.max(...tasks)} ms` : ""));
  await standsReady(phone);
  await phone.close();
}

async function measureStop() {
  const phone = await openController();
  const toCommand = [];
  const toRest = [];
  for (let i = 0; i < kNumHidden; i++) {
    await touchJoysticks(phone, [0, 0.7], [0, 0]);
    await until("it walks", async () => (await phone.look("mode")) === "walking");
    let hidden = 0;
    const recorded = await stack.record("WORLD_TRUTH|NAO_WALK_COMMAND", async () => {
      await pause(2000 + 130 * i);
      hidden = await phone.hide();
      await pause(kRestWindowMs);
    });
    const after = recorded.filter(({wallMs}) => wallMs > hidden);
    const zero = after.find(({channel, message: {vx}}) => channel === "NAO_WALK_COMMAND" && vx === 0);
    toCommand.push(zero.wallMs - hidden);
    toRest.push(timeOfRest(after.filter(({channel}) => channel === "WORLD_TRUTH")));
    await phone.fingers("touchEnd", []);
    await phone.unhide();
    await until("it holds", async () => (await phone.look("mode")) === "holding");
    await standsReady(phone);
  }
  row("hidden to zero command on the bus", toCommand);
  row("hidden to stop", toRest);
  await phone.close();
}

/** @param truths  of the world, from when the page was hidden.
 * @return after what time the torso had come as far ahead as it would, ms of the world's clock. */
function timeOfRest(truths) {
  const seen = truths.map(({message: {utime, robots: [robot]}}) => {
    const [x, y] = robot.position_torso_in_world;
    const [w, i, j, k] = robot.orientation_torso_in_world;
    const heading = Math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k));
    return {utime, ahead: x * Math.cos(heading) + y * Math.sin(heading)};
  });
  const end = seen.at(-1).ahead;
  return (seen.find(({ahead}) => end - ahead < kRest).utime - seen[0].utime) / 1000;
}

/** Processor time of the browser's processes, ms. */
async function processorTime(session) {
  const {processInfo} = await session.send("SystemInfo.getProcessInfo");
  return 1000 * processInfo.reduce((sum, {cpuTime}) => sum + cpuTime, 0);
}

/** MB that the browser's processes have in memory. */
async function memoryOfBrowser(session) {
  const {processInfo} = await session.send("SystemInfo.getProcessInfo");
  return Object.fromEntries(processInfo.filter(({type}) => type === "renderer" || type === "GPU").map(({type, id}) => [
    type, Number(/VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${id}/status`, "utf8"))?.[1]) / 1024]));
}

async function measureMemory(minutes) {
  const phone = await openController();
  const page = await phone.context.newCDPSession(phone.page);
  const whole = await browser.newBrowserCDPSession();
  await page.send("Performance.enable");
  console.log("minute     heap MB  nodes  listeners  renderer MB  graphics MB");
  for (let minute = 0; minute <= minutes; minute++) {
    const end = Date.now() + (minute === 0 ? 20_000 : 60_000);
    while (Date.now() < end) await driveALittle(phone);
    await page.send("HeapProfiler.collectGarbage");
    const metrics = Object.fromEntries((await page.send("Performance.getMetrics")).metrics.map(({name, value}) => [name, value]));
    const processes = await memoryOfBrowser(whole);
    console.log([`${minute}`.padEnd(10), (metrics.JSHeapUsedSize / 1e6).toFixed(2), metrics.Nodes,
                 metrics.JSEventListeners, processes.renderer?.toFixed(0), processes.GPU?.toFixed(0)].join("  "));
  }
  console.log("errors of the page:", phone.errors);
  await phone.close();
}

let turn = 0;
/** Some seconds of what people do, on either side in turn so that the robot stays where it is. */
async function driveALittle(phone) {
  const side = ++turn % 2 ? 1 : -1;
  await touchJoysticks(phone, [0, 0.5 * side], [0.4 * side, 0]);
  await pause(3000);
  await phone.fingers("touchEnd", []);
  await phone.tap(".image-main");
  await pause(1000);
  await phone.tap(".image-main");
  await phone.tap(".joints-button");
  await phone.page.locator(`[data-name="${side > 0 ? "head" : "left shoulder"}"]`).tap();
  const pad = await phone.middleOf(".joystick-joint");
  await phone.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await phone.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y + 0.4 * side * pad.radius}]);
  await pause(1000);
  await phone.fingers("touchEnd", []);
  await phone.tap(".joints-button");
  const mode = await phone.look("mode");
  if (mode !== "holding" && mode !== "walking" && mode !== "moving") await standsReady(phone);
}

try {
  await stack.start({scene: "soccer"});
  if (Number(options.minutes) > 0) {
    await measureMemory(Number(options.minutes));
  } else {
    if (isWanted("load")) await measureLoad();
    if (isWanted("link")) await measureLinks();
    if (isWanted("touch")) await measureTouch();
    if (isWanted("tasks")) await measureLongTasks();
    if (isWanted("stop")) await measureStop();
  }
} finally {
  await browser.close();
  await stack.stop();
}
