/** Messages over Bluetooth, cut into fragments: phone-gateway/bluetooth/fragments.h says how. */
import {joinBytes} from "../join_bytes";

const kLast = 0x80;
const kNumNumbers = 128;
const kAcknowledgedBytes = 500;

/** Cuts messages into values. */
export class FragmentWriter {
  private number = 0;

  /** @param valueBytes  Longest value. */
  constructor(private readonly valueBytes: number) {}

  cut(message: Uint8Array): Uint8Array<ArrayBuffer>[] {
    const fragments: Uint8Array<ArrayBuffer>[] = [];
    for (let begin = 0; begin < message.length; begin += this.valueBytes - 1) {
      const part = message.subarray(begin, begin + this.valueBytes - 1);
      const fragment = new Uint8Array(part.length + 1);
      fragment[0] = this.number | (begin + part.length === message.length ? kLast : 0);
      fragment.set(part, 1);
      fragments.push(fragment);
      this.number = (this.number + 1) % kNumNumbers;
    }
    return fragments;
  }
}

/** Joins what the gateway notifies. */
export class FragmentReader {
  private number = 0;
  private parts: Uint8Array[] = [];
  private numNew = 0;
  /** To be sent to the gateway; null: nothing is to be acknowledged yet. */
  acknowledgement: Uint8Array<ArrayBuffer> | null = null;

  /** @return The message, if this value ends it. @throws Error  A fragment is lost, or the gateway has ended the connection. */
  read(value: Uint8Array): Uint8Array | null {
    this.acknowledgement = null;
    if (value.length < 2 || (value[0]! & ~kLast) !== this.number) throw new Error("no fragment that follows");
    this.number = (this.number + 1) % kNumNumbers;
    this.parts.push(value.subarray(1));
    this.numNew += value.length;
    const isLast = (value[0]! & kLast) !== 0;
    if (isLast || this.numNew >= kAcknowledgedBytes) {
      this.numNew = 0;
      this.acknowledgement = new Uint8Array([this.number]);
    }
    return isLast ? joinBytes(this.parts.splice(0)) : null;
  }
}
