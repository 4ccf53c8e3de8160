// nao-foxglove with the protocol's own client and with one that offers only foxglove.sdk.v1; MCAP files of
// nao log with the format's own reader. Every message is validated against the schema of its channel, and
// those in Foxglove's schemas against Foxglove's own.
import assert from "node:assert/strict";
import {mkdtemp, readFile, rm} from "node:fs/promises";
import {createRequire} from "node:module";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {after, before, describe, test} from "node:test";

import {pause, Stack, until} from "../../system/phone_app/stack.mjs";

// Their CommonJS form: some have no other that node finds.
const require = createRequire(import.meta.url);
const foxgloveSchemas = require("@foxglove/schemas/jsonschema");
const {FoxgloveClient} = require("@foxglove/ws-protocol");
const {McapIndexedReader} = require("@mcap/core");
const Ajv2020 = require("ajv/dist/2020");
const {WebSocket} = require("ws");

const stack = new Stack(process.env.NAO_BIN_DIR);
const ajv = new Ajv2020({strict: false});
const official = new Map(Object.values(foxgloveSchemas).filter((schema) => schema.title?.startsWith("foxglove."))
    .map((schema) => [schema.title, ajv.compile(schema)]));
let port = 0;

/** Checks messages of one channel. */
class Checker {
  constructor(channel) {
    this.channel = channel;
    this.count = 0;
    this.validate = ajv.compile(JSON.parse(channel.schema));
  }

  /** @return the decoded message. */
  check(bytes) {
    const message = JSON.parse(new TextDecoder().decode(bytes));
    const validators = [this.validate];
    if (this.channel.schemaName.startsWith("foxglove.")) validators.push(official.get(this.channel.schemaName));
    for (const validate of validators) {
      assert.ok(validate(message), `${this.channel.topic}: ${ajv.errorsText(validate.errors)}`);
    }
    ++this.count;
    return message;
  }
}

/** The part of JSON Schema that Foxglove and Lichtblick understand: every property has one type, and items of lists are
 * not lists. They refuse a channel with another. */
function checkSupported(schema, path) {
  assert.equal(schema.type, "object", path);
  for (const [name, property] of Object.entries(schema.properties)) {
    const item = property.type === "array" ? property.items : property;
    assert.ok(["object", "number", "integer", "boolean", "string"].includes(item.type), `${path}.${name}: ${item.type}`);
    if (item.type === "object") checkSupported(item, `${path}.${name}`);
  }
}

/** Channels of the bus: type by name. */
async function busChannels() {
  const report = JSON.parse(await stack.nao("spy", "--for", "2", "--json"));
  return new Map(report.map((channel) => [channel.channel, channel.type]));
}

/** A client that knows only current programs' name of the protocol, written without the protocol's library. */
class PlainClient {
  channels = new Map();
  texts = [];
  /** Called with channel and decoded message. */
  onMessage = () => {};

  constructor(subprotocols = ["foxglove.sdk.v1"]) {
    this.socket = new WebSocket(`ws://127.0.0.1:${port}`, subprotocols);
    this.socket.binaryType = "arraybuffer";
    this.opened = new Promise((resolve, reject) => {
      this.socket.on("open", resolve);
      this.socket.on("error", reject);
    });
    this.socket.on("message", (data, isBinary) => {
      if (!isBinary) return this.#text(JSON.parse(new TextDecoder().decode(data)));
      const view = new DataView(data);
      assert.equal(view.getUint8(0), 1, "message data");
      // The client's numbers of subscriptions are those of the channels.
      this.onMessage(this.channels.get(view.getUint32(1, true)), new Uint8Array(data, 13), view.getBigUint64(5, true));
    });
  }

  #text(message) {
    this.texts.push(message);
    if (message.op !== "advertise") return;
    for (const channel of message.channels) this.channels.set(channel.id, channel);
  }

  send(message) {
    this.socket.send(JSON.stringify(message));
  }

  subscribe(ids) {
    this.send({op: "subscribe", subscriptions: ids.map((id) => ({id, channelId: id}))});
  }

  close() {
    this.socket.terminate();
  }
}

before(async () => {
  stack.run("nao-sim", ["--scene", "soccer"]);
  stack.run("nao-motion");
  stack.run("nao-head-camera");
  const program = stack.run("nao-foxglove", ["--port", "0"]);
  port = await until("nao-foxglove listens", () => {
    const listening = /ws:\/\/127\.0\.0\.1:(\d+)/.exec(program.log);
    if (program.exited) throw new Error(program.log);
    return listening ? Number(listening[1]) : undefined;
  });
  await stack.nao("status", "--wait", "nao-sim,nao-motion,nao-head-camera,nao-foxglove", "--timeout", "60");
});

after(() => stack.stop());

describe("nao-foxglove", () => {
  test("the protocol's own client lists every channel of the bus with its schema and decodes all", async () => {
    const client = new FoxgloveClient({
      ws: new WebSocket(`ws://127.0.0.1:${port}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]),
    });
    const checkers = new Map();
    const failures = [];
    let info;
    client.on("error", (error) => failures.push(error.message));
    client.on("serverInfo", (event) => info = event);
    client.on("advertise", (channels) => {
      for (const channel of channels) {
        checkSupported(JSON.parse(channel.schema), channel.topic);
        checkers.set(client.subscribe(channel.id), new Checker(channel));
      }
    });
    client.on("message", ({subscriptionId, data}) => {
      try {
        checkers.get(subscriptionId).check(data);
      } catch (error) {
        failures.push(error.message);
      }
    });
    // Events appear with their first message, and that message is not lost.
    await stack.nao("posture", "Crouch");
    const onBus = await busChannels();
    assert.ok(onBus.size >= 7, [...onBus.keys()].join());
    const byTopic = () => new Map([...checkers.values()].map((checker) => [checker.channel.topic, checker]));
    await until("every channel has a message", () => {
      if (failures.length > 0) return true;
      const known = byTopic();
      const expected = [...onBus.keys(), "NAO_POSTURE_COMMAND", "NAO_COMMAND_RESULT",
        ...["joint_states", "odometry", "transforms", "balance", "footsteps", "camera/top/image", "camera/top/calibration"]
            .map((name) => `/NAO/${name}`), "/world/transforms", "/world/scene"];
      const missing = expected.filter((topic) => !known.get(topic)?.count);
      if (missing.length > 0) throw new Error(`missing: ${missing.join()}`);
      return true;
    });
    assert.deepEqual(failures, []);
    for (const [topic, type] of onBus) assert.equal(byTopic().get(topic).channel.schemaName, `naolcm.${type}`);
    assert.deepEqual(info.capabilities, ["assets"], "read-only");
    client.close();
  });

  test("a client that offers only foxglove.sdk.v1 receives and decodes every channel", async () => {
    const client = new PlainClient();
    await client.opened;
    assert.equal(client.socket.protocol, "foxglove.sdk.v1");
    await until("there are channels", () => client.texts.some((text) => text.op === "advertise"));
    assert.equal(client.texts[0].op, "serverInfo");
    const checkers = new Map([...client.channels].map(([id, channel]) => [id, new Checker(channel)]));
    const failures = [];
    let logTime = 0n;
    client.onMessage = (channel, bytes, time) => {
      try {
        checkers.get(channel.id).check(bytes);
      } catch (error) {
        failures.push(error.message);
      }
      logTime = time;
    };
    client.subscribe([...client.channels.keys()]);
    await until("states and images arrive", () => failures.length > 0 || ["NAO_ROBOT_STATE", "NAO_SENSOR_STATE",
      "NAO_HEAD_CAMERA_IMAGE", "WORLD_TRUTH", "/NAO/transforms", "/NAO/camera/top/image"].every((topic) =>
        [...checkers.values()].some((checker) => checker.channel.topic === topic && checker.count > 10)));
    assert.deepEqual(failures, []);
    assert.ok(Math.abs(Number(logTime / 1_000_000n) - Date.now()) < 60_000, "log time is the wall clock, ns");
    client.close();
  });

  test("a WebSocket without a known subprotocol is refused", async () => {
    for (const subprotocols of [[], ["foxglove.sdk.v9"]]) {
      await assert.rejects(new PlainClient(subprotocols).opened, /400/);
    }
  });

  test("it is read-only, and says so", async () => {
    const client = new PlainClient();
    await client.opened;
    client.send({op: "advertise", channels: [{id: 1, topic: "NAO_STOP_COMMAND", encoding: "json", schemaName: "x"}]});
    client.socket.send(new Uint8Array([1, 1, 0, 0, 0, 65]));
    client.socket.send("nonsense");
    await until("each is refused", () => client.texts.filter((text) => text.op === "status").length === 3);
    client.close();
  });

  /** HTTP status of the answer to a page of this origin that opens a WebSocket; 101: it is open. */
  function statusOfPage(at, headers) {
    return new Promise((resolve, reject) => {
      const socket = new WebSocket(`ws://127.0.0.1:${at}`, ["foxglove.sdk.v1"], {headers});
      socket.on("open", () => resolve(101));
      socket.on("unexpected-response", (request, response) => resolve(response.statusCode));
      socket.on("error", reject);
    });
  }

  test("only pages of Foxglove, Lichtblick and this computer may look, under a name of this host", async () => {
    for (const origin of ["https://app.foxglove.dev", "https://lichtblick-suite.github.io", "file://", "http://localhost:8080"]) {
      assert.equal(await statusOfPage(port, {Origin: origin}), 101, origin);
    }
    for (const origin of ["https://evil.example", "null", "https://app.foxglove.dev.evil.example"]) {
      assert.equal(await statusOfPage(port, {Origin: origin}), 403, origin);
    }
    assert.equal(await statusOfPage(port, {Host: "localhost"}), 101);
    assert.equal(await statusOfPage(port, {Host: "evil.example"}), 421);
    assert.equal(await statusOfPage(port, {Origin: ["http://localhost:8080", "https://evil.example"]}), 400);
  });

  test("with --allow-commands only pages of named sites may connect", async () => {
    const listening = (program) => until("it listens", () => /ws:\/\/127\.0\.0\.1:(\d+)/.exec(program.log)?.[1]);
    const closed = await listening(stack.run("nao-foxglove", ["--port", "0", "--allow-commands"], "closed"));
    for (const origin of ["https://evil.example", "https://app.foxglove.dev", "http://localhost:8080", "file://"]) {
      assert.equal(await statusOfPage(closed, {Origin: origin}), 403, origin);
    }
    const named = await listening(stack.run("nao-foxglove",
        ["--port", "0", "--allow-commands", "--allow-origin", "https://app.foxglove.dev"], "named"));
    assert.equal(await statusOfPage(named, {Origin: "https://app.foxglove.dev"}), 101);
    assert.equal(await statusOfPage(named, {Origin: "http://localhost:8080"}), 403);
  });

  test("with --allow-commands the protocol's own client walks the robot", async () => {
    const program = stack.run("nao-foxglove", ["--port", "0", "--allow-commands"], "open");
    const openPort = await until("it listens", () => /ws:\/\/127\.0\.0\.1:(\d+)/.exec(program.log)?.[1]);
    const client = new FoxgloveClient({
      ws: new WebSocket(`ws://127.0.0.1:${openPort}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]),
    });
    let info;
    const refusals = [];
    const states = [];
    client.on("serverInfo", (event) => info = event);
    client.on("status", (event) => refusals.push(event.message));
    client.on("advertise", (channels) => {
      for (const {id} of channels.filter(({topic}) => topic === "NAO_MOTION_STATE")) client.subscribe(id);
    });
    client.on("message", ({data}) => states.push(JSON.parse(new TextDecoder().decode(data))));
    await until("the server introduces itself", () => info);
    assert.ok(info.capabilities.includes("clientPublish"));
    const channel = (topic, schemaName) => client.advertise({topic, encoding: "json", schemaName});
    const send = (id, message) => client.sendMessage(id, new TextEncoder().encode(JSON.stringify(message)));
    const walk = channel("NAO_WALK_COMMAND", "naolcm.walk_command_t");
    const timer = setInterval(() => send(walk, {vx: 0.1}), 100);
    try {
      await until("it walks", () => states.some((state) => state.mode_name === "MODE_WALKING"));
      const sources = new Set(states.map((state) => state.command_source));
      assert.ok([...sources].some((source) => source.startsWith("nao-foxglove.")), [...sources].join());
      assert.deepEqual(refusals, []);
      send(walk, {vz: 0.1});
      await until("a wrong field is refused", () => refusals.some((text) => text.includes('"vz" does not exist')));
      channel("NAO_JOINT_COMMAND", "naolcm.joint_command_t");
      await until("joint commands are refused", () => refusals.some((text) => text.includes("may publish on")));
    } finally {
      clearInterval(timer);
    }
    await until("it stands again", () => states.at(-1).mode_name !== "MODE_WALKING");
    client.close();
  });

  test("the robot's URDF and all its meshes come over HTTP and as assets", async () => {
    const url = `http://127.0.0.1:${port}/robot/robot.urdf`;
    const response = await fetch(url);
    assert.equal(response.status, 200);
    assert.equal(response.headers.get("access-control-allow-origin"), "*");
    const urdf = await response.text();
    const meshes = [...new Set([...urdf.matchAll(/<mesh filename="([^"]*)"/g)].map((match) => match[1]))];
    assert.ok(meshes.length > 10);
    for (const mesh of meshes) assert.equal((await fetch(new URL(mesh, url))).status, 200, mesh);
    assert.equal((await fetch(new URL("../../etc/passwd", url))).status, 404);
    assert.equal((await fetch(`http://127.0.0.1:${port}/robot/..%2f..%2fCMakeCache.txt`)).status, 404);

    const client = new FoxgloveClient({
      ws: new WebSocket(`ws://127.0.0.1:${port}`, [FoxgloveClient.SUPPORTED_SUBPROTOCOL]),
    });
    const assets = new Map();
    client.on("fetchAssetResponse", (asset) => assets.set(asset.requestId, asset));
    await new Promise((resolve) => client.on("open", resolve));
    client.fetchAsset("package://robot/robot.urdf", 0);
    // As programs resolve a mesh against the URDF's address.
    meshes.forEach((mesh, i) => client.fetchAsset(new URL(mesh, "package://robot/robot.urdf").toString(), i + 1));
    client.fetchAsset("file:///etc/passwd", 1000);
    await until("all assets arrive", () => assets.size === meshes.length + 2);
    assert.equal(new TextDecoder().decode(assets.get(0).data), urdf);
    for (let i = 0; i <= meshes.length; ++i) assert.equal(assets.get(i).status, 0, meshes[i - 1]);
    assert.equal(assets.get(1000).status, 1);
    client.close();
  });

  test("a client that stops reading disturbs no other", async () => {
    const [stalled, other] = [new PlainClient(), new PlainClient()];
    await Promise.all([stalled.opened, other.opened]);
    await until("there are channels", () => [stalled, other].every((client) => client.channels.size > 0));
    stalled.subscribe([...stalled.channels.keys()]);
    stalled.socket._socket.pause();
    const ticks = [];
    other.onMessage = (channel, bytes) => ticks.push(JSON.parse(new TextDecoder().decode(bytes)).tick);
    const states = [...other.channels.values()].find((channel) => channel.topic === "NAO_ROBOT_STATE");
    other.subscribe([states.id]);
    // A robot at rest sends fewer states. 20 MB or so for the stalled one.
    const walk = stack.nao("walk", "0", "0", "0.3", "--for", "6");
    await until("six seconds of states arrive", () => ticks.length >= 600);
    const lost = ticks.at(-1) - ticks[0] + 1 - ticks.length;
    assert.ok(lost <= 6, `${lost} of ${ticks.length} states lost`);
    await walk;
    stalled.close();
    other.close();
  });
});

describe("nao log mcap", () => {
  test("the format's own reader decodes all messages, which fit their schemas", async () => {
    const folder = await mkdtemp(join(tmpdir(), "nao-mcap-"));
    try {
      const watcher = new PlainClient();  // images are on the bus only while a client watches
      await watcher.opened;
      await until("there are channels", () => watcher.channels.size > 0);
      const images = [...watcher.channels.values()].find((channel) => channel.topic === "/NAO/camera/top/image");
      watcher.subscribe([images.id]);
      await new Promise((resolve) => watcher.onMessage = resolve);
      await Promise.all([stack.nao("record", join(folder, "run.lcmlog"), "--for", "3"),
        pause(500).then(() => stack.nao("posture", "Stand"))]);
      watcher.close();
      await stack.nao("log", "mcap", join(folder, "run.lcmlog"), join(folder, "run.mcap"));
      const bytes = await readFile(join(folder, "run.mcap"));
      const reader = await McapIndexedReader.Initialize({readable: {
        size: async () => BigInt(bytes.length),
        read: async (offset, size) => bytes.subarray(Number(offset), Number(offset + size)),
      }});
      const checkers = new Map();
      for (const channel of reader.channelsById.values()) {
        const schema = reader.schemasById.get(channel.schemaId);
        assert.equal(channel.messageEncoding, "json");
        assert.equal(schema.encoding, "jsonschema");
        const text = new TextDecoder().decode(schema.data);
        checkSupported(JSON.parse(text), channel.topic);
        checkers.set(channel.id, new Checker({topic: channel.topic, schemaName: schema.name, schema: text}));
      }
      for await (const message of reader.readMessages()) checkers.get(message.channelId).check(message.data);
      const counts = new Map([...checkers.values()].map(({channel, count}) => [channel.topic, count]));
      for (const topic of ["NAO_ROBOT_STATE", "NAO_COMMAND_RESULT", "WORLD_TRUTH", "/NAO/transforms", "/NAO/odometry",
        "/NAO/joint_states", "/NAO/balance", "/NAO/camera/top/image", "/NAO/camera/top/calibration", "/world/scene"]) {
        assert.ok(counts.get(topic) > 0, `${topic} of ${[...counts.keys()].join()}`);
      }
    } finally {
      await rm(folder, {recursive: true});
    }
  });
});
