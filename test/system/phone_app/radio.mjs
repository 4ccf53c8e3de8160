// Bluetooth without a radio: a D-Bus of the test's own with test/support/bluez.py for the gateway, and Chromium's emulated Bluetooth
// for the app. DevTools has no notifications: the page gets them as events of its characteristic.
import {spawn} from "node:child_process";
import {join} from "node:path";
import {createInterface} from "node:readline";
import {fileURLToPath} from "node:url";
import {until} from "./stack.mjs";

export const kBluetoothOptions = ["--enable-features=WebBluetooth", "--enable-blink-features=WebBluetooth"];
const kAddress = "09:09:09:09:09:09";
const kPhone = "AA_BB_CC_DD_EE_FF";
/** Longest packet between phone and robot, bytes: a usual one. */
const kMtu = 185;
/** Client Characteristic Configuration, which asks for notifications. */
const kConfiguration = "00002902-0000-1000-8000-00805f9b34fb";
/** Error of a read that is not permitted (Bluetooth Core Specification 5.4, Vol 3, Part F, 3.4.1.1). */
const kNotPermitted = 2;

const support = (name) => fileURLToPath(new URL(`../../support/${name}`, import.meta.url));

/** In the page, before the app: keeps the characteristic. */
function keepCharacteristic() {
  const {prototype} = BluetoothRemoteGATTCharacteristic;
  const start = prototype.startNotifications;
  prototype.startNotifications = function () {
    window.characteristic = this;
    return start.call(this);
  };
}

/** In the page: a notification. */
function notify(base64) {
  const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
  Object.defineProperty(window.characteristic, "value", {value: new DataView(bytes.buffer), configurable: true});
  window.characteristic.dispatchEvent(new Event("characteristicvaluechanged"));
}

export class Radio {
  /** Requests of the page until now. */
  numWrites = 0;
  #children = [];
  #answers = new Map();
  #advertised = null;
  #lastId = 0;
  #page = null;
  #browser = null;
  #isNotifying = false;
  #characteristic = "";

  /** Starts D-Bus and bluez.py; the programs that start afterwards use that bus. */
  async start(folder) {
    const address = process.env.DBUS_SYSTEM_BUS_ADDRESS = `unix:path=${join(folder, "bus")}`;
    this.#children.push(spawn("dbus-daemon", ["--nofork", `--config-file=${support("system_bus.conf")}`, `--address=${address}`],
                              {stdio: "ignore"}));
    await until("bluez.py runs", () => this.#startBluez());
  }

  #startBluez() {
    return new Promise((resolve) => {
      const bluez = spawn("/usr/bin/python3", [support("bluez.py")],
                          {stdio: ["pipe", "pipe", "inherit"]});
      bluez.on("exit", () => resolve(false));
      createInterface(bluez.stdout).on("line", (line) => {
        const what = JSON.parse(line);
        if (what.event === "ready") {
          this.#children.push(bluez);
          this.bluez = bluez;
          resolve(true);
        }
        else if (what.event === "advertised") this.#advertised = what;
        else if (what.event === "value") void this.#notify(what.value);
        else this.#answers.get(what.id)(what);
      });
    });
  }

  end() {
    for (const child of this.#children.reverse()) child.kill();
  }

  #act(what, more = {}) {
    return new Promise((resolve) => {
      const id = ++this.#lastId;
      this.#answers.set(id, resolve);
      this.bluez.stdin.write(`${JSON.stringify({id, do: what, phone: kPhone, mtu: kMtu, ...more})}\n`);
    });
  }

  #notify(hexadecimal) {
    if (!this.#isNotifying) return undefined;
    // A page that is being left has no use for it.
    return this.#page.evaluate(notify, Buffer.from(hexadecimal, "hex").toString("base64")).catch(() => {});
  }

  /** Puts the robot within reach of a page; the person chooses it. To be called before the page opens. */
  async reach(page) {
    await until("the robot is advertised", () => this.#advertised !== null);
    const {name, services, characteristics} = this.#advertised;
    this.#page = page;
    await page.addInitScript(keepCharacteristic);
    const session = await page.context().newCDPSession(page);
    await session.send("DeviceAccess.enable");
    let chosen = "";
    session.on("DeviceAccess.deviceRequestPrompted", ({id, devices}) => {
      if (devices.length === 0 || id === chosen) return;
      chosen = id;
      void session.send("DeviceAccess.selectPrompt", {id, deviceId: devices[0].id});
    });
    const browser = this.#browser = await page.context().browser().newBrowserCDPSession();
    const send = (method, options) => browser.send(`BluetoothEmulation.${method}`, options);
    await send("enable", {state: "powered-on", leSupported: true});
    await send("simulatePreconnectedPeripheral", {address: kAddress, name, manufacturerData: [], knownServiceUuids: services});
    browser.on("BluetoothEmulation.gattOperationReceived", async ({address, type}) => {
      if (type === "discovery" && !this.#characteristic) {
        const {serviceId} = await send("addService", {address, serviceUuid: services[0]});
        const {characteristicId} = await send("addCharacteristic", {serviceId, characteristicUuid: characteristics[0],
                                                                    properties: {read: true, writeWithoutResponse: true, notify: true}});
        await send("addDescriptor", {characteristicId, descriptorUuid: kConfiguration});
        this.#characteristic = characteristicId;
      }
      await send("simulateGATTOperationResponse", {address, type, code: 0});
    });
    browser.on("BluetoothEmulation.characteristicOperationReceived", async ({characteristicId, type, data}) => {
      const answer = await this.#answer(type, data);
      // An operation may have ended with its connection.
      const respond = (options) => send("simulateCharacteristicOperationResponse", options).catch(() => {});
      await respond({
        characteristicId, type, code: answer.error ? kNotPermitted : 0,
        ...(type === "read" && !answer.error ? {data: Buffer.from(answer.value, "hex").toString("base64")} : {})});
    });
  }

  async #answer(type, data) {
    switch (type) {
      case "read": {
        const answer = await this.#act("read");
        this.#isNotifying = true;
        return answer;
      }
      case "write":
        this.numWrites++;
        return this.#act("write", {value: Buffer.from(data, "base64").toString("hex")});
      default:
        return this.#act(type.startsWith("subscribe") ? "start" : "stop");
    }
  }

  /** The phone is out of reach, also for the page. */
  async leave() {
    this.#isNotifying = false;
    // The emulation forgets its services then.
    this.#characteristic = "";
    await this.#browser.send("BluetoothEmulation.simulateGATTDisconnection", {address: kAddress});
    await this.#act("leave");
  }
}
