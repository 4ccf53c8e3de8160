/** The second connection to the gateway: images and sound come over it, so that they keep no state waiting, and copies of what is
 * sent go over it, of which the gateway takes the one that comes first. Without it all goes over the first one. */
import {retryDelayMs} from "./backoff";
import {decodeServerMessage, encodeRequest} from "./protocol/codec";
import {ErrorCode} from "./protocol/generated/remote_pb";
import {randomKey} from "./random_key";
import type {Transport} from "./transport";

/** A longer request is sent once; bytes. Chosen: far above a command, below a taught motion. */
const kMaxCopiedBytes = 1024;
/** Apart from those of the first connection, which count up from 1. */
const kJoinId = 0xffffffff;

export class SecondConnection {
  private clientId = 0;
  private hasJoined = false;
  private attempts = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  /** By which the gateway knows that both connections are of one client. */
  readonly key = randomKey();

  /** @param received  called with each message of the gateway. */
  constructor(private readonly transport: Transport, private readonly received: (bytes: Uint8Array) => void) {}

  /** Opens it for the client of a number, and again whenever it breaks. */
  open(clientId: number): void {
    this.close();
    this.clientId = clientId;
    this.attempts = 0;
    this.start();
  }

  close(): void {
    clearTimeout(this.retryTimer);
    this.hasJoined = false;
    this.transport.close();
  }

  /** Sends a copy of a request. */
  copy(bytes: Uint8Array): void {
    if (this.hasJoined && bytes.length <= kMaxCopiedBytes) this.transport.send(bytes);
  }

  private start(): void {
    this.transport.open({
      opened: () => this.transport.send(encodeRequest(kJoinId, {case: "join", value: {clientId: this.clientId, key: this.key}})),
      received: (bytes) => this.arrived(bytes),
      closed: () => this.broken(),
    });
  }

  private arrived(bytes: Uint8Array): void {
    if (this.hasJoined) {
      this.received(bytes);
      return;
    }
    const message = decodeServerMessage(bytes)?.message;
    if (message?.case !== "response" || message.value.requestId !== kJoinId) return;
    this.hasJoined = message.value.error === ErrorCode.OK;
    // A gateway of before, or one that does not know this client: all goes over the first connection.
    if (!this.hasJoined) this.transport.close();
    else this.attempts = 0;
  }

  private broken(): void {
    this.hasJoined = false;
    this.retryTimer = setTimeout(() => this.start(), retryDelayMs(++this.attempts));
  }
}
