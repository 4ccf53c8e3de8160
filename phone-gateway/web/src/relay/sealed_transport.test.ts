import {describe, expect, it} from "vitest";
import type {Transport, TransportListener} from "../transport";
import {openInvitation} from "./sealed_transport";

/** A relay without a robot: the test says what comes. */
class Inner implements Transport {
  listener!: TransportListener;
  readonly sent: Uint8Array[] = [];
  isClosed = false;
  open(listener: TransportListener): void {
    this.listener = listener;
  }
  send(bytes: Uint8Array): void {
    this.sent.push(bytes);
  }
  close(): void {
    this.isClosed = true;
  }
  backlogBytes(): number {
    return 0;
  }
  somethingAnswers(): Promise<boolean> {
    return Promise.resolve(true);
  }
}

const kToken = `${"a".repeat(32)}.${"b".repeat(16)}.${"c".repeat(32)}`;
const soon = () => new Promise((resolve) => setTimeout(resolve, 50));

async function start() {
  const inner = new Inner();
  const events: string[] = [];
  let asked = "";
  const transport = openInvitation(kToken, (path) => {
    asked = path;
    return inner;
  })!;
  transport.open({
    opened: () => events.push("opened"),
    received: (bytes) => events.push(`received ${bytes.join(" ")}`),
    closed: (wasOpen) => events.push(`closed ${wasOpen}`),
  });
  inner.listener.opened();
  await soon();
  return {inner, events, transport, asked};
}

describe("a connection over the relay", () => {
  it("asks the relay for the robot, and never for more than that", async () => {
    const {inner, asked, transport} = await start();
    expect(asked).toBe(`/ws?robot=${"a".repeat(32)}`);
    expect(inner.sent.length).toBe(1);
    expect(inner.sent[0]!.length).toBe(74);
    // Nothing leaves the phone before the gateway has shown that it knows the secret.
    transport.send(new Uint8Array([1, 2, 3]));
    await soon();
    expect(inner.sent.length).toBe(1);
  });

  it("passes on why the gateway refuses the invitation", async () => {
    const {inner, events} = await start();
    inner.listener.received(new Uint8Array([0, 7, 8]));
    inner.listener.closed(true);
    await soon();
    expect(events).toEqual(["opened", "received 7 8", "closed true"]);
  });

  it("ends at an answer without the secret", async () => {
    const {inner, events} = await start();
    inner.listener.received(new Uint8Array(98).fill(1));
    await soon();
    expect(events).toEqual(["closed false"]);
    expect(inner.isClosed).toBe(true);
  });

  it("leaves other tokens to the gateway itself", () => {
    expect(openInvitation("k7mq-3xpa", () => new Inner())).toBeNull();
  });
});
