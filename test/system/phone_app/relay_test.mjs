// From anywhere: the phone, the relay and the robot are in network namespaces of their own; phone and robot reach the relay
// only, and nobody reaches them. Between robot and relay stands a proxy that changes messages.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtemp, readFile, rm} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {setUp} from "./set_up.mjs";
import {pause, until} from "./stack.mjs";

/** Small: the processor draws. */
const kSize = {width: 360, height: 640};
const kName = "Secret-Ana-of-the-phone";
/** Time in which all must be whole after a restart of the relay, as told; here the machine may be busy. */
const kWholeMs = 60_000;

const {stack, openPhone} = setUp({scene: null, hasPhone: false});
const ip = (...words) => execFileSync("ip", words, {stdio: "pipe"});
let folder;
let file;
let ana;
let proxy;

/** A cable between two namespaces; "" is that of the test, in which the phone is. */
function connect(one, name, address, other, otherName, otherAddress) {
  const at = (space) => (space ? ["-n", space] : []);
  ip("-n", other, "link", "add", otherName, "type", "veth", "peer", "name", name, ...(one ? ["netns", one] : ["netns", String(process.pid)]));
  for (const [space, device, its] of [[one, name, address], [other, otherName, otherAddress]]) {
    ip(...at(space), "address", "add", `${its}/24`, "dev", device);
    ip(...at(space), "link", "set", device, "up");
  }
}

function canMakeSpaces() {
  try {
    ip("netns", "add", "relay");
    return true;
  } catch {
    return false;
  }
}
const skip = canMakeSpaces() ? false : "no network namespaces";

const startRelay = () => stack.runIn("relay", "nao-relay", ["--port", "8443", "--tls-dir", folder, "--host-name", "relay.example"]);
const invite = async (...words) => {
  const text = await stack.nao("invite", "--relay-file", file, ...words);
  return {link: /https:\S+/.exec(text)?.[0].replace("10.77.2.1:9000", "10.77.1.1:8443"), id: /^([0-9a-f]{16}) {2}/m.exec(text)?.[1]};
};
const open = (link, name = kName) => openPhone(link, kSize, {ignoreHTTPSErrors: true, name});
const isConnected = (phone) => until("the phone is connected", async () => (await phone.look("state.phase")) === "connected");

before(async () => {
  if (skip) return;
  folder = await mkdtemp(join(tmpdir(), "nao-relay-"));
  file = join(folder, "relay.json");
  ip("netns", "add", "robot");
  for (const space of ["relay", "robot"]) ip("-n", space, "link", "set", "lo", "up");
  ip("-n", "robot", "route", "add", "224.0.0.0/4", "dev", "lo");
  connect("", "relay0", "10.77.1.2", "relay", "phone0", "10.77.1.1");
  connect("robot", "relay0", "10.77.2.2", "relay", "robot0", "10.77.2.1");
  const relay = startRelay();
  await until("the relay listens", () => relay.log.includes("listens on"));
  process.env.NAO_SECRET_WORDS = kName;
  proxy = stack.runIn("relay", process.execPath, [new URL("meddling_proxy.mjs", import.meta.url).pathname, "10.77.2.1", "9000",
                                                  "10.77.2.1", "8443"], "proxy");
  await until("the proxy listens", () => proxy.log.includes("listening"));
  stack.space = "robot";
  stack.bind = "0.0.0.0";
  stack.gatewayOptions = ["--relay", "10.77.2.1:9000", "--relay-file", file, "--audit-log", join(folder, "audit.jsonl"),
                          "--no-announce"];
  await stack.start({scene: "empty"});
});
after(() => folder && rm(folder, {recursive: true, force: true}));

test("an invited phone drives the robot over the relay", {skip}, async () => {
  const {link} = await invite("--role", "drive", "--for", "1h");
  ana = await open(link);
  await ana.sees("controller");
  assert.ok(!(await ana.page.evaluate(() => location.href)).includes("token"), "the secret stays in the address bar");
  await until("images come", async () => (await ana.look("numImages")) > 3);
  const begin = (await stack.truth()).torso;
  const pad = await ana.middleOf(".joystick-walk");
  await ana.fingers("touchStart", [{id: 1, x: pad.x, y: pad.y}]);
  await ana.fingers("touchMove", [{id: 1, x: pad.x, y: pad.y - 0.9 * pad.radius}]);
  await until("the robot has walked 0.2 m", async () => {
    const {torso} = await stack.truth();
    return Math.hypot(torso[0] - begin[0], torso[1] - begin[1]) > 0.2;
  });
  await ana.fingers("touchEnd", []);
});

test("an invitation for watching lets nobody drive", {skip}, async () => {
  const {link} = await invite("--role", "watch");
  const ben = await open(link, "Ben");
  await ben.sees("controller");
  assert.equal(await ben.look("state.control.isMuted"), true);
  await ben.close();
});

test("changed, repeated and lost messages are refused, and none is read on the way", {skip}, async (t) => {
  const refusals = async () => (await readFile(join(folder, "audit.jsonl"), "utf8")).match(/relay-message-refused/g)?.length ?? 0;
  for (const [signal, done] of [["SIGUSR1", "changed"], ["SIGUSR2", "repeated"], ["SIGHUP", "dropped"]]) {
    await isConnected(ana);
    const client = await ana.look("state.clientId");
    const before = await refusals();
    proxy.child.kill(signal);
    await until(`a message is ${done}`, () => proxy.log.includes(`${done} a message`));
    await until("the gateway refuses it", async () => (await refusals()) > before);
    await until("the phone has connected anew", async () => (await ana.look("state.clientId")) !== client);
    t.diagnostic(`${done}: refused`);
  }
  await isConnected(ana);
  assert.ok(!proxy.log.includes("secret words"), "the client's name was read between phone and gateway");
});

test("after the relay was killed and started again the phone drives again; the robot stands meanwhile", {skip}, async (t) => {
  await isConnected(ana);
  await stack.end("nao-relay", "SIGKILL");
  await until("the phone knows", async () => (await ana.look("state.phase")) !== "connected");
  assert.match(await stack.nao("state"), /mode +holding/);
  startRelay();
  const begin = Date.now();
  await until("the phone is connected again", async () => (await ana.look("state.phase")) === "connected", kWholeMs);
  t.diagnostic(`whole ${Date.now() - begin} ms after the start of the relay`);
});

test("how much later an answer comes over the relay is told", {skip}, async (t) => {
  await isConnected(ana);
  connect("", "robot1", "10.77.3.2", "robot", "phone1", "10.77.3.1");
  const direct = await openPhone(`http://10.77.3.1:${stack.httpPort}/#token=${stack.token}`, kSize);
  await direct.sees("controller");
  await isConnected(ana);
  // At the same time: the machine may be busy.
  const samples = [[], []];
  for (let i = 0; i < 20; i++) {
    await pause(1000);
    for (const [k, phone] of [ana, direct].entries()) samples[k].push(await phone.look("state.latencyMs"));
  }
  await ana.close();
  await direct.close();
  const [relayed, straight] = samples.map((found) => found.sort((x, y) => x - y));
  for (const [name, at] of [["median", 9], ["p95", 18]]) {
    t.diagnostic(`answer to a ping, ${name}: ${relayed[at].toFixed(1)} ms over the relay, ${straight[at].toFixed(1)} ms directly`);
  }
  assert.ok(relayed[9] > 0 && straight[9] > 0);
});

test("who is no longer invited is told so", {skip}, async () => {
  const {link, id} = await invite("--role", "drive");
  const eva = await open(link, "Eva");
  await eva.sees("controller");
  await stack.nao("invite", "--relay-file", file, "--revoke", id);
  await eva.page.getByText("This invitation has expired or was withdrawn.").filter({visible: true}).first().waitFor();
  await eva.close();
  const short = await invite("--for", "0.01min");
  await pause(1000);
  const late = await open(short.link, "Late");
  await late.page.getByText("This invitation has expired or was withdrawn.").filter({visible: true}).first().waitFor();
  assert.notEqual(await late.look("state.phase"), "connected");
  await late.close();
});
