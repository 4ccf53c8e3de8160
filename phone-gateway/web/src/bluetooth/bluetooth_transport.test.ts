import {describe, expect, it} from "vitest";
import {BluetoothTransport} from "./bluetooth_transport";
import {FragmentReader, FragmentWriter} from "./fragments";
import {kMessagesUuid, kServiceUuid} from "./web_bluetooth";
import type {BluetoothCharacteristic} from "./web_bluetooth";

const kValueBytes = 182;
const soon = () => new Promise((resolve) => setTimeout(resolve, 0));
const messageOf = (length: number) => Uint8Array.from({length}, (_, i) => (i * 7) & 0xff);

/** What navigator.bluetooth gives: a robot within reach, which the test speaks for. */
class FakeDevice extends EventTarget implements BluetoothCharacteristic {
  readonly written: Uint8Array[] = [];
  value?: DataView;
  isConnected = false;
  refuses = false;
  /** Writes that are under way at once, at most. */
  mostWrites = 0;
  private numWrites = 0;

  readonly gatt = {
    connect: () => {
      this.isConnected = true;
      return Promise.resolve({
        getPrimaryService: (uuid: string) => {
          expect(uuid).toBe(kServiceUuid);
          return Promise.resolve({
            getCharacteristic: (name: string) => {
              expect(name).toBe(kMessagesUuid);
              return Promise.resolve(this as BluetoothCharacteristic);
            },
          });
        },
      });
    },
    disconnect: () => {
      this.isConnected = false;
    },
  };

  startNotifications(): Promise<void> {
    // The end of a connection of before.
    this.notify(new Uint8Array([0xff]));
    return Promise.resolve();
  }

  readValue(): Promise<DataView> {
    if (this.refuses) return Promise.reject(new Error("NotPermitted"));
    const size = new DataView(new Uint8Array([kValueBytes, 0]).buffer);
    this.value = size;
    this.dispatchEvent(new Event("characteristicvaluechanged"));
    return Promise.resolve(size);
  }

  async writeValueWithoutResponse(value: Uint8Array): Promise<void> {
    this.mostWrites = Math.max(this.mostWrites, ++this.numWrites);
    this.written.push(value);
    await soon();
    this.numWrites--;
  }

  notify(value: Uint8Array): void {
    this.value = new DataView(value.slice().buffer);
    this.dispatchEvent(new Event("characteristicvaluechanged"));
  }
}

async function start(device = new FakeDevice()) {
  const events: string[] = [];
  const received: Uint8Array[] = [];
  const transport = new BluetoothTransport(device);
  transport.open({
    opened: () => events.push("opened"),
    received: (bytes) => received.push(bytes),
    closed: (wasOpen) => events.push(`closed ${wasOpen}`),
  });
  for (let i = 0; i < 10; i++) await soon();
  return {device, transport, events, received};
}

describe("fragments", () => {
  it("make the message again, with more fragments than numbers", () => {
    const writer = new FragmentWriter(20);
    const reader = new FragmentReader();
    for (const length of [1, 19, 20, 500, 9000, 3]) {
      const fragments = writer.cut(messageOf(length));
      expect(fragments.length).toBe(Math.ceil(length / 19));
      const results = fragments.map((fragment) => reader.read(fragment));
      expect(results.slice(0, -1).every((result) => result === null)).toBe(true);
      expect(results.at(-1)).toEqual(messageOf(length));
    }
  });

  it("are acknowledged after each message and each 500 bytes", () => {
    const writer = new FragmentWriter(101);
    const reader = new FragmentReader();
    const acknowledged = writer.cut(messageOf(1100)).map((fragment) => {
      reader.read(fragment);
      return reader.acknowledgement?.[0] ?? null;
    });
    expect(acknowledged).toEqual([null, null, null, null, 5, null, null, null, null, 10, 11]);
  });

  it("that are lost or repeated are errors", () => {
    const [first, second] = new FragmentWriter(20).cut(messageOf(30));
    const reader = new FragmentReader();
    expect(() => reader.read(second!)).toThrow();
    reader.read(first!);
    expect(() => reader.read(first!)).toThrow();
    expect(() => reader.read(new Uint8Array())).toThrow();
  });
});

describe("a connection by Bluetooth", () => {
  it("sends requests as fragments, one write at a time", async () => {
    const {device, transport, events} = await start();
    expect(events).toEqual(["opened"]);
    transport.send(messageOf(400));
    transport.send(messageOf(10));
    expect(transport.backlogBytes()).toBeGreaterThan(200);
    for (let i = 0; i < 10; i++) await soon();
    expect(device.mostWrites).toBe(1);
    expect(device.written.map((value) => value.length)).toEqual([182, 182, 39, 11]);
    expect(device.written.map((value) => value[0])).toEqual([0, 1, 0x82, 0x83]);
    expect(transport.backlogBytes()).toBe(0);
  });

  it("hands on what comes, and acknowledges it before its own requests", async () => {
    const {device, transport, received} = await start();
    transport.send(messageOf(400));
    const gateway = new FragmentWriter(kValueBytes);
    for (let i = 0; i < 3; i++) {
      for (const fragment of gateway.cut(messageOf(200))) device.notify(fragment);
    }
    expect(received).toEqual([messageOf(200), messageOf(200), messageOf(200)]);
    for (let i = 0; i < 10; i++) await soon();
    expect(device.written.map((value) => value.length), "the newest acknowledgement alone").toEqual([182, 1, 182, 39]);
    expect(device.written[1]).toEqual(new Uint8Array([6]));
  });

  it("ends when the robot is out of reach, when the gateway ends it, and when a fragment is lost", async () => {
    for (const end of [(device: FakeDevice) => device.dispatchEvent(new Event("gattserverdisconnected")),
                       (device: FakeDevice) => device.notify(new Uint8Array([0xff])),
                       (device: FakeDevice) => device.notify(new Uint8Array([5, 1]))]) {
      const {device, events} = await start();
      end(device);
      expect(events).toEqual(["opened", "closed true"]);
      expect(device.isConnected).toBe(false);
    }
  });

  it("does not begin while the robot serves another phone", async () => {
    const device = new FakeDevice();
    device.refuses = true;
    const {events} = await start(device);
    expect(events).toEqual(["closed false"]);
  });

  it("is left without a word, and begins again", async () => {
    const {device, transport, events} = await start();
    transport.close();
    expect(device.isConnected).toBe(false);
    device.notify(new Uint8Array([0xff]));
    expect(events).toEqual(["opened"]);
    const again: string[] = [];
    transport.open({opened: () => again.push("opened"), received: () => {}, closed: () => again.push("closed")});
    for (let i = 0; i < 10; i++) await soon();
    expect(again).toEqual(["opened"]);
  });
});
