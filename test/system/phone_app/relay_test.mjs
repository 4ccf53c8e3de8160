// From anywhere: the phone, the relay and the robot are in network namespaces of their own. Phone and robot are behind a router
// each, which translates addresses; they reach the relay only, and nobody reaches them. A proxy changes messages on their way.
import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtemp, readFile, rm, writeFile} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, test} from "node:test";
import {loadClient} from "./app_client.mjs";
import {kWebDir, setUp} from "./set_up.mjs";
import {pause, until} from "./stack.mjs";

/** Small: the processor draws. */
const kSize = {width: 360, height: 640};
const kName = "Secret-Ana-of-the-phone";
/** Time in which all must be whole after a restart of the relay, as told; here the machine may be busy. */
const kWholeMs = 60_000;
const kNumPings = 400;

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
    ip("netns", "exec", "relay", "iptables", "-t", "nat", "-L");
    return true;
  } catch {
    return false;
  }
}
const skip = canMakeSpaces() ? false : "no network namespaces with iptables";

/** Makes a router between the relay and a private network, 192.168.1.0/24 like that of every home.
 * @param space  of the one device there; "" is the test's. @param network  "10.77.1" between router and relay. */
function connectBehindRouter(space, device, router, network) {
  ip("netns", "add", router);
  ip("-n", router, "link", "set", "lo", "up");
  connect(router, "public", `${network}.2`, "relay", router, `${network}.1`);
  connect(space, device, "192.168.1.2", router, "private", "192.168.1.1");
  ip(...(space ? ["-n", space] : []), "route", "add", "10.77.0.0/16", "via", "192.168.1.1");
  const inRouter = (command) => ip("netns", "exec", router, "sh", "-c", command);
  inRouter("echo 1 > /proc/sys/net/ipv4/ip_forward");
  inRouter("iptables -t nat -A POSTROUTING -o public -j MASQUERADE && iptables -A FORWARD -i public -m state --state NEW -j DROP");
}

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
  connectBehindRouter("", "wifi", "home", "10.77.1");
  connectBehindRouter("robot", "wifi", "lab", "10.77.2");
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

test("an answer comes over the relay little later than directly", {skip}, async (t) => {
  connect("", "robot1", "10.77.3.2", "robot", "phone1", "10.77.3.1");
  const {connectTo} = await loadClient(kWebDir);
  const clients = [await connectTo((await invite("--role", "drive")).link),
                   await connectTo(`http://10.77.3.1:${stack.httpPort}/#token=${stack.token}`)];
  const times = [[], []];
  for (let i = 0; i < kNumPings; i++) {
    // At the same time: the machine may be busy.
    await Promise.all(clients.map(async ({ask}, k) => {
      const begin = performance.now();
      assert.equal((await ask({case: "ping", value: {clientUtime: BigInt(i)}}))?.result.case, "pong");
      times[k].push(performance.now() - begin);
    }));
    await pause(30);
  }
  for (const client of clients) client.end();
  const [relayed, straight] = times.map((found) => found.sort((x, y) => x - y));
  for (const [name, at] of [["median", 0.5], ["p95", 0.95]]) {
    const [over, direct] = [relayed, straight].map((found) => found[Math.floor(at * kNumPings)]);
    t.diagnostic(`answer, ${name}: ${over.toFixed(1)} ms over the relay, ${direct.toFixed(1)} ms directly`);
  }
});

test("an invitation lets do what its role may, and no more", {skip}, async () => {
  const {connectTo, ErrorCode} = await loadClient(kWebDir);
  const clients = [];
  for (const role of ["watch", "drive", "operate"]) clients.push(await connectTo((await invite("--role", role)).link));
  const [watch, drive, operate] = clients;
  const error = async (client, useCase) => (await client.ask(useCase)).error;
  const list = {case: "operate", value: {$typeName: "naoremote.Operate", operation: 0, clientId: 0, robot: ""}};
  await ana.close();
  assert.equal(await error(watch, {case: "takeControl", value: {}}), ErrorCode.NOT_ALLOWED);
  assert.equal(await error(watch, {case: "walkTurn", value: {vx: 0.1}}), ErrorCode.NOT_ALLOWED);
  await until("the robot is free", async () => (await error(drive, {case: "takeControl", value: {}})) === ErrorCode.OK);
  assert.equal(await error(drive, list), ErrorCode.NOT_ALLOWED);
  const {result} = await operate.ask(list);
  assert.ok(result.value.clients.length >= 3, "the operator sees all clients");
  assert.equal(await error(operate, {case: "takeControl", value: {}}), ErrorCode.OK, "the operator takes control from the driver");
  assert.equal(await error(drive, {case: "walkTurn", value: {vx: 0.1}}), ErrorCode.CONTROL_TAKEN);
  for (const client of clients) client.end();
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

test("an exhibition's visitor and operator come over the relay", {skip}, async () => {
  const settings = join(folder, "exhibition.yaml");
  await writeFile(settings, "turn: 60\n");
  await stack.end("nao-phone-gateway");
  stack.gatewayOptions.push("--exhibition", settings);
  await stack.startGateway();
  const visitor = await open((await invite("--role", "drive")).link, "Visitor");
  await visitor.sees("controller");
  await until("it is the visitor's turn", async () => (await visitor.look("state.exhibition?.phase")) === 2);
  const {link} = await invite("--role", "operate");
  const tablet = await open(link.replace("/#", "/operator#"), "");
  await tablet.page.getByRole("button", {name: "Pause", exact: true}).tap();
  await until("the exhibition pauses", async () => (await visitor.look("state.exhibition.isPaused")) === true);
  await visitor.close();
  await tablet.close();
});
