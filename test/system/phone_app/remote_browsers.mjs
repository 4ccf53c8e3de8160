// Browsers other than Chrome, as people have them: WebKit (stands for iPhones) by WebDriver over HTTP, Firefox by
// WebDriver BiDi over a WebSocket. Both take the same descriptions of fingers. They draw on a screen of Xvfb: without a
// screen Firefox has no WebGL.
import {spawn} from "node:child_process";
import {existsSync} from "node:fs";
import {mkdtemp, rm, writeFile} from "node:fs/promises";
import {tmpdir} from "node:os";
import {delimiter, join} from "node:path";
import {requireFromApp} from "./phone.mjs";
import {until} from "./stack.mjs";

const kSize = {width: 412, height: 915};
const kStartMs = 60_000;
/** Debian's minimal browser around WebKit; one folder for each architecture. */
const kMiniBrowsers = ["x86_64-linux-gnu", "aarch64-linux-gnu"].map(
    (architecture) => `/usr/lib/${architecture}/webkit2gtk-4.1/MiniBrowser`);
/** Firefox without questions, greetings and calls home. */
const kFirefoxSettings = {
  "browser.shell.checkDefaultBrowser": false, "browser.startup.page": 0, "datareporting.policy.dataSubmissionEnabled": false,
  "datareporting.policy.dataSubmissionPolicyBypassNotification": true, "app.normandy.enabled": false,
  "browser.aboutwelcome.enabled": false, "intl.accept_languages": "en-US", "app.update.enabled": false,
  "browser.region.network.url": "", "services.settings.server": "http://127.0.0.1:9",
  // The processor draws: Firefox would refuse.
  "webgl.force-enabled": true,
};

/** Path of an installed program; undefined if it is not. */
function find(program) {
  return process.env.PATH.split(delimiter).map((folder) => join(folder, program)).find(existsSync);
}

/** Starts a program and waits for words of its output. @return {child, match}. */
async function start(program, options, words, env = process.env) {
  const child = spawn(program, options, {stdio: ["ignore", "pipe", "pipe"], env});
  let log = "";
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (text) => log += text);
  child.on("error", (error) => log += error.message);
  const match = await until(`${program} has started`, () => {
    if (child.exitCode !== null) throw new Error(log);
    return words.exec(log) ?? undefined;
  }, kStartMs).catch((error) => {
    child.kill();
    throw new Error(`${error.message}\n${log.slice(-2000)}`);
  });
  return {child, match};
}

/** A virtual screen. @return {child, env}: what programs must know to draw on it. */
async function startScreen() {
  const {child, match} = await start("Xvfb", [
    "-displayfd", "1", "-screen", "0", "1024x1024x24", "+extension", "GLX", "-nolisten", "tcp"], /^(\d+)\n/);
  return {child, env: {...process.env, DISPLAY: `:${match[1]}`, GDK_BACKEND: "x11", LANG: "en_US.UTF-8", LANGUAGE: "en"}};
}

function ended(child) {
  if (child.exitCode !== null || child.signalCode !== null) return Promise.resolve();
  return new Promise((resolve) => {
    child.once("exit", resolve);
    child.kill();
  });
}

export class WebKit {
  /** Packages that it needs; tests say so where it is not there. */
  static packages = "webkit2gtk-driver, xvfb";
  #children = [];
  #session = "";

  static isInstalled() {
    return Boolean(find("WebKitWebDriver") && find("Xvfb") && kMiniBrowsers.some(existsSync));
  }

  /** @param port  of the driver, free. */
  async start(port) {
    const {child: screen, env} = await startScreen();
    this.#children.push(screen);
    const driver = spawn("WebKitWebDriver", [`--port=${port}`], {stdio: "ignore", env});
    this.#children.unshift(driver);
    const root = `http://127.0.0.1:${port}`;
    await until("the driver answers", async () => (await fetch(`${root}/status`)).ok, kStartMs);
    const options = {binary: kMiniBrowsers.find(existsSync), args: ["--automation"]};
    const {sessionId} = await this.#ask(`${root}/session`, {
      capabilities: {alwaysMatch: {"webkitgtk:browserOptions": options}}});
    this.#session = `${root}/session/${sessionId}`;
    await this.#ask(`${this.#session}/window/rect`, {x: 0, y: 0, ...kSize});
  }

  async open(url) {
    await this.#ask(`${this.#session}/url`, {url});
  }

  /** @return the value of an expression in the page, as far as JSON tells it. */
  async evaluate(expression) {
    const text = await this.#ask(`${this.#session}/execute/sync`, {
      script: `return JSON.stringify(${expression}) ?? "null"`, args: []});
    return JSON.parse(text);
  }

  /** @param pointer  what a finger does: actions of WebDriver. */
  async act(pointer) {
    await this.#ask(`${this.#session}/actions`, {actions: [
      {type: "pointer", id: "finger", parameters: {pointerType: "mouse"}, actions: pointer}]});
  }

  async close() {
    if (this.#session) await fetch(this.#session, {method: "DELETE"}).catch(() => {});
    for (const child of this.#children) await ended(child);
  }

  async #ask(url, body) {
    const response = await fetch(url, {method: "POST", body: JSON.stringify(body)});
    const {value} = await response.json();
    if (!response.ok) throw new Error(`${url}: ${value.error}: ${value.message}`);
    return value;
  }
}

export class Firefox {
  static packages = "firefox-esr, xvfb";
  #children = [];
  #profile;
  #socket;
  #context;
  #nextId = 1;
  #pending = new Map();

  static isInstalled() {
    return Boolean(find("firefox-esr") && find("Xvfb"));
  }

  /** @param port  for BiDi, free. @param webDir  folder of the app's package.json. */
  async start(port, webDir) {
    this.#profile = await mkdtemp(join(tmpdir(), "nao-firefox-"));
    await writeFile(join(this.#profile, "user.js"), Object.entries(kFirefoxSettings).map(
        ([name, value]) => `user_pref(${JSON.stringify(name)}, ${JSON.stringify(value)});\n`).join(""));
    const {child: screen, env} = await startScreen();
    this.#children.push(screen);
    const {child, match} = await start("firefox-esr", [
      "--no-remote", "--profile", this.#profile, `--remote-debugging-port=${port}`, "about:blank"],
        /WebDriver BiDi listening on (ws:\S+)/, env);
    this.#children.unshift(child);
    const {WebSocket} = requireFromApp(webDir)("ws");
    this.#socket = new WebSocket(`${match[1]}/session`);
    this.#socket.on("message", (data) => this.#received(JSON.parse(data)));
    await new Promise((resolve, reject) => this.#socket.once("open", resolve).once("error", reject));
    await this.#ask("session.new", {capabilities: {}});
    this.#context = (await this.#ask("browsingContext.getTree", {})).contexts[0].context;
    await this.#ask("browsingContext.setViewport", {context: this.#context, viewport: kSize});
  }

  async open(url) {
    await this.#ask("browsingContext.navigate", {context: this.#context, url, wait: "interactive"});
  }

  async evaluate(expression) {
    const {type, result, exceptionDetails} = await this.#ask("script.evaluate", {
      expression: `JSON.stringify(${expression}) ?? "null"`, awaitPromise: false, target: {context: this.#context}});
    if (type !== "success") throw new Error(exceptionDetails.text);
    return JSON.parse(result.value);
  }

  async act(pointer) {
    await this.#ask("input.performActions", {context: this.#context, actions: [
      {type: "pointer", id: "finger", parameters: {pointerType: "touch"}, actions: pointer}]});
  }

  async close() {
    this.#socket?.close();
    for (const child of this.#children) await ended(child);
    if (this.#profile) await rm(this.#profile, {recursive: true, force: true, maxRetries: 5});
  }

  #ask(method, params) {
    const id = this.#nextId++;
    return new Promise((resolve, reject) => {
      this.#pending.set(id, {resolve, reject, method});
      this.#socket.send(JSON.stringify({id, method, params}));
    });
  }

  #received({id, type, result, error, message}) {
    const asked = this.#pending.get(id);
    if (!asked) return;
    this.#pending.delete(id);
    if (type === "success") asked.resolve(result);
    else asked.reject(new Error(`${asked.method}: ${error}: ${message}`));
  }
}
