/** Messages to the gateway over nao-relay: the relay connects, phone and gateway encrypt. */
import type {Transport, TransportListener} from "../transport";
import {Handshake, parseInvitation} from "./secure_channel";
import type {Invitation, SecureChannel} from "./secure_channel";

/** First byte of a message that is not encrypted: why there is no secure channel. */
const kRefusal = 0;

export class SealedTransport implements Transport {
  private channel: SecureChannel | null = null;
  /** Frames are made and opened in their order, one after the other. */
  private sealing: Promise<unknown> = Promise.resolve();
  private opening: Promise<unknown> = Promise.resolve();
  private isOver = false;

  /** @param inner  A connection whose address is the relay's. */
  constructor(private readonly inner: Transport, private readonly invitation: Invitation) {}

  open(listener: TransportListener): void {
    let handshake: Handshake | null = null;
    let wasOpen = false;
    const opened = () => {
      wasOpen = true;
      listener.opened();
    };
    const end = () => {
      if (this.isOver) return;
      this.close();
      listener.closed(wasOpen);
    };
    const take = async (bytes: Uint8Array<ArrayBuffer>) => {
      if (this.isOver || !handshake) return;
      if (this.channel) {
        listener.received(await this.channel.open(bytes));
      } else if (bytes[0] === kRefusal) {
        opened();
        listener.received(bytes.slice(1));
      } else {
        this.channel = await handshake.finish(bytes);
        if (!this.isOver) opened();
      }
    };
    this.inner.open({
      opened: () => void Handshake.begin(this.invitation).then((begun) => {
        handshake = begun;
        this.inner.send(begun.hello);
      }, end),
      // A frame that cannot be opened ends the connection: what follows cannot be trusted either.
      received: (bytes) => {
        this.opening = this.opening.then(() => take(bytes as Uint8Array<ArrayBuffer>)).catch(end);
      },
      closed: () => void this.opening.then(end),
    });
  }

  send(bytes: Uint8Array): void {
    const channel = this.channel;
    if (!channel) return;
    this.sealing = this.sealing.then(async () => {
      const frame = await channel.seal(bytes);
      if (!this.isOver) this.inner.send(frame);
    });
  }

  close(): void {
    this.isOver = true;
    this.inner.close();
  }

  backlogBytes(): number {
    return this.inner.backlogBytes();
  }

  somethingAnswers(): Promise<boolean> {
    return this.inner.somethingAnswers();
  }
}

/** @param connect  Makes a connection with an address of the relay. @return null: the text is no invitation. */
export function openInvitation(text: string, connect: (path: string) => Transport): SealedTransport | null {
  const invitation = parseInvitation(text);
  return invitation && new SealedTransport(connect(`/ws?robot=${invitation.robot}`), invitation);
}
