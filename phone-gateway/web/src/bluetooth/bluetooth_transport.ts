/** Messages to the gateway by Bluetooth. */
import type {Transport, TransportListener} from "../transport";
import {FragmentReader, FragmentWriter} from "./fragments";
import {kMessagesUuid, kServiceUuid} from "./web_bluetooth";
import type {BluetoothCharacteristic, BluetoothDevice} from "./web_bluetooth";

export class BluetoothTransport implements Transport {
  private link: Link | null = null;

  constructor(private readonly device: BluetoothDevice) {}

  open(listener: TransportListener): void {
    this.close();
    const link = new Link(this.device, listener);
    this.link = link;
    void link.start();
  }

  send(bytes: Uint8Array): void {
    this.link?.send(bytes);
  }

  close(): void {
    this.link?.leave();
    this.link = null;
  }

  backlogBytes(): number {
    return this.link?.backlogBytes ?? 0;
  }

  somethingAnswers(): Promise<boolean> {
    return Promise.resolve(false);
  }
}

/** One connection, from its beginning to its end. */
class Link {
  private messages: BluetoothCharacteristic | null = null;
  private writer: FragmentWriter | null = null;
  private readonly reader = new FragmentReader();
  /** Bluetooth does one thing at a time. */
  private readonly queue: Uint8Array<ArrayBuffer>[] = [];
  /** The newest one, which goes before all that waits: the gateway waits for it. */
  private acknowledgement: Uint8Array<ArrayBuffer> | null = null;
  private isWriting = false;
  private isOver = false;
  private readonly lost = () => this.end();
  private readonly changed = () => this.take();

  constructor(private readonly device: BluetoothDevice, private readonly listener: TransportListener) {}

  get backlogBytes(): number {
    return this.queue.reduce((sum, value) => sum + value.length, 0);
  }

  async start(): Promise<void> {
    try {
      this.device.addEventListener("gattserverdisconnected", this.lost);
      const server = await this.device.gatt?.connect();
      const service = await server?.getPrimaryService(kServiceUuid);
      const messages = await service?.getCharacteristic(kMessagesUuid);
      if (!messages || this.isOver) return this.end();
      await messages.startNotifications();
      // What is notified before this answer belongs to a connection of before.
      const size = await messages.readValue();
      if (this.isOver) return;
      this.writer = new FragmentWriter(size.getUint16(0, true));
      this.messages = messages;
      messages.addEventListener("characteristicvaluechanged", this.changed);
      this.listener.opened();
    } catch {
      this.end();
    }
  }

  send(bytes: Uint8Array): void {
    this.queue.push(...(this.writer?.cut(bytes) ?? []));
    void this.write();
  }

  /** Ends it without a word. */
  leave(): void {
    if (this.isOver) return;
    this.isOver = true;
    this.device.removeEventListener("gattserverdisconnected", this.lost);
    this.messages?.removeEventListener("characteristicvaluechanged", this.changed);
    this.device.gatt?.disconnect();
  }

  private end(): void {
    if (this.isOver) return;
    this.leave();
    this.listener.closed(this.messages !== null);
  }

  private take(): void {
    const value = this.messages?.value;
    if (!value || this.isOver) return;
    try {
      // A copy: the browser may use the bytes again.
      const message = this.reader.read(new Uint8Array(value.buffer, value.byteOffset, value.byteLength).slice());
      this.acknowledgement = this.reader.acknowledgement ?? this.acknowledgement;
      void this.write();
      if (message) this.listener.received(message);
    } catch {
      this.end();
    }
  }

  private async write(): Promise<void> {
    if (this.isWriting) return;
    this.isWriting = true;
    try {
      while (this.messages && !this.isOver) {
        const value = this.acknowledgement ?? this.queue.shift();
        if (!value) break;
        this.acknowledgement = null;
        await this.messages.writeValueWithoutResponse(value);
      }
    } catch {
      this.end();
    }
    this.isWriting = false;
  }
}
