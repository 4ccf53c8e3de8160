// The real programs on a private bus and free ports, started and ended by a test.
import {execFile, spawn} from "node:child_process";
import {mkdtemp, readFile, rm} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";

// Deadlines are generous: the machine may be busy with other things.
const kReadyMs = 60_000;
const kEndMs = 5000;

/** Pause, ms. */
export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Asks until the answer is neither false nor undefined, and returns it.
 * @throws Error with `what` after `ms`. */
export async function until(what, ask, ms = kReadyMs) {
  const deadline = Date.now() + ms;
  let failure = "";
  while (Date.now() < deadline) {
    try {
      const answer = await ask();
      if (answer !== false && answer !== undefined) return answer;
    } catch (error) {
      failure = `: ${error.message}`;
    }
    await pause(50);
  }
  throw new Error(`waited ${ms / 1000} s in vain until ${what}${failure}`);
}

const robotOption = ({name, model, team, number}) => ["--robot", `${name}:${model}:${team}:${number}`];

export class Stack {
  token = "system-test";
  httpPort = 0;
  tcpPort = 0;
  #programs = new Map();
  #binDir;
  #model = [];
  /** --robot of the gateway, where there are several. */
  #robots = [];
  /** Folder of the taught motions. */
  #motions = "";
  /** More options of the gateway. */
  gatewayOptions = [];

  /** @param binDir  folder of the programs. */
  constructor(binDir) {
    this.#binDir = binDir;
    // Parallel test runs do not hear each other: a multicast port of this process's own.
    this.lcmUrl = `udpm://239.255.76.67:${20000 + (process.pid % 10000)}?ttl=0`;
  }

  /** Starts simulation, motion, taught motions, camera and gateway; returns when a phone can drive.
   * @param options  scene; model: a folder of robots/; plays: also what sees and acts; pace: simulated seconds per second. */
  async start(options = {}) {
    this.#model = ["--model", options.model ?? "nao"];
    const pace = options.pace ? ["--pace", String(options.pace)] : [];
    this.run("nao-sim", [...this.#model, "--scene", options.scene ?? "soccer", ...pace]);
    this.run("nao-motion", this.#model);
    this.#motions = await mkdtemp(join(tmpdir(), "nao-motions-"));
    this.run("nao-motion-files", [...this.#model, "--folder", this.#motions]);
    this.run("nao-head-camera", this.#model);
    const more = options.plays ? ["nao-vision", "nao-play"] : [];
    for (const program of more) this.run(program, this.#model);
    await this.startGateway();
    const programs = ["nao-sim", "nao-motion", "nao-motion-files", "nao-head-camera", "nao-phone-gateway", ...more];
    await until("every program is ready", () => this.nao("status", "--wait", programs.join(","), "--timeout", "60"));
  }

  /** Starts a world with several robots: for each of them motion and camera, and one gateway.
   * @param robots  {name, model, team, number} each; isAbsent: only the gateway knows of it.
   * @param options  scene; pace: simulated seconds per second. */
  async startSeveral(robots, options = {}) {
    this.#robots = robots.flatMap(robotOption);
    const pace = options.pace ? ["--pace", String(options.pace)] : [];
    const present = robots.filter(({isAbsent}) => !isAbsent);
    this.run("nao-sim", [...present.flatMap(robotOption), "--scene", options.scene ?? "soccer", ...pace]);
    for (const {name, model} of present) {
      this.run("nao-motion", ["--robot", name, "--model", model], `nao-motion of ${name}`);
      this.run("nao-head-camera", ["--robot", name, "--model", model], `nao-head-camera of ${name}`);
    }
    await this.startGateway();
    await until("every program is ready", () =>
        this.nao("status", "--wait", "nao-sim,nao-motion,nao-head-camera,nao-phone-gateway", "--timeout", "60"));
  }

  /** Starts the gateway, on the same port as before if it ran already. */
  async startGateway() {
    const program = this.run("nao-phone-gateway", [
      ...this.#model, ...this.#robots, ...(this.#robots.length > 0 ? ["--overview"] : []), "--bind", "127.0.0.1",
      "--http-port", String(this.httpPort), "--tcp-port", "0", "--token", this.token, ...this.gatewayOptions]);
    [this.httpPort, this.tcpPort] = await until("the gateway listens", () => {
      const ports = /HTTP and WebSocket on 127\.0\.0\.1:(\d+), TCP on 127\.0\.0\.1:(\d+)/.exec(program.log);
      if (ports) return ports.slice(1).map(Number);
      if (program.exited) throw new Error(program.log);
      return undefined;
    });
  }

  /** What the QR code says. */
  get url() {
    return `http://127.0.0.1:${this.httpPort}/#token=${this.token}`;
  }

  /** Starts a program. @param label  Name for program() and end(), where two of one name run. */
  run(name, options = [], label = name) {
    const child = spawn(join(this.#binDir, name), ["--lcm-url", this.lcmUrl, ...options],
                        {stdio: ["ignore", "ignore", "pipe"]});
    const program = {child, log: "", exited: false};
    child.stderr.on("data", (text) => program.log += text);
    child.on("exit", () => program.exited = true);
    child.on("error", (error) => {
      program.log += error.message;
      program.exited = true;
    });
    this.#programs.set(label, program);
    return program;
  }

  program(name) {
    return this.#programs.get(name);
  }

  /** Ends one program. @param signal SIGKILL for one that must not end in an orderly way. */
  async end(name, signal = "SIGTERM") {
    const program = this.#programs.get(name);
    if (!program || program.exited) return;
    program.child.kill(signal);
    await until(`${name} has ended`, () => program.exited, kEndMs).catch(() => program.child.kill("SIGKILL"));
  }

  async stop() {
    await Promise.all([...this.#programs.keys()].map((name) => this.end(name)));
    if (this.#motions) await rm(this.#motions, {recursive: true, force: true});
  }

  /** Runs an operation of the operator, `nao driver`. @return what it prints; throws its error text. */
  driver(...words) {
    return this.nao("driver", "--port", String(this.tcpPort), ...words);
  }

  /** Runs the client `nao` on this bus. @return what it prints; throws its error text. */
  nao(...words) {
    return new Promise((resolve, reject) => {
      execFile(join(this.#binDir, "nao"), [...words, "--lcm-url", this.lcmUrl], (error, stdout, stderr) =>
          error ? reject(new Error(`nao ${words.join(" ")}: ${stderr}`)) : resolve(stdout));
    });
  }

  /** The true state of the world: time s; torso m, and (w, x, y, z); angles rad by joint name.
   * @param name  of the robot; by default the first. */
  async truth(name = "") {
    const world = JSON.parse(await this.nao("world", "show", "--json"));
    const robot = name ? world.robots.find(({robot}) => robot === name) : world.robots[0];
    return {
      time: world.utime * 1e-6,
      torso: robot.position_torso_in_world,
      orientation: robot.orientation_torso_in_world,
      angles: Object.fromEntries(robot.joint_names.map((name, i) => [name, robot.joint_position[i]])),
    };
  }

  /** Records channels while something is done. @param channels  regular expression of their names.
   * @return the messages in order, {wallMs, channel, message}: on the clock of Date.now(). */
  async record(channels, act) {
    const folder = await mkdtemp(join(tmpdir(), "nao-record-"));
    const file = join(folder, "run.lcmlog");
    try {
      this.run("nao", ["record", file, "--channels", channels]);
      await act();
      await this.end("nao", "SIGINT");
      await this.nao("log", "json", file, "--output", `${file}.json`);
      return (await readFile(`${file}.json`, "utf8")).trim().split("\n").map((line) => {
        const {log_wall_utime, channel, message} = JSON.parse(line);
        return {wallMs: log_wall_utime / 1000, channel, message};
      });
    } finally {
      await this.end("nao");
      await rm(folder, {recursive: true, force: true});
    }
  }

  /** Last lines of every program's output, for a failed test. */
  get logs() {
    return [...this.#programs].map(([name, {log}]) => `--- ${name}\n${log.slice(-2000)}`).join("\n");
  }
}
