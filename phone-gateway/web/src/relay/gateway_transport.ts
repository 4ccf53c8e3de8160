/** Which way messages take to the gateway. */
import type {BluetoothDevice} from "../bluetooth/web_bluetooth";
import {WebSocketTransport} from "../transport";
import type {Transport, TransportListener} from "../transport";

/** An invitation over the relay is "ROBOT.ID.SECRET"; a pairing token has no dot. */
export const isInvitation = (token: string): boolean => token.includes(".");

/** The gateway, by Bluetooth or by the network; where the token is an invitation, the relay that has served the page. */
export class GatewayTransport implements Transport {
  isSingle = false;
  /** By Bluetooth from the next open() on; null: by the network. */
  device: BluetoothDevice | null = null;
  private inner: Transport | null = null;
  private attempt = 0;

  constructor(private readonly pageUrl: URL) {}

  open(listener: TransportListener, token = ""): void {
    this.close();
    const start = (transport: Transport | null) => {
      this.inner = transport ?? new WebSocketTransport(this.pageUrl);
      this.inner.open(listener);
    };
    this.isSingle = this.isNarrow || isInvitation(token);
    if (!this.isSingle) return start(null);
    const attempt = this.attempt;
    this.load(token).then((transport) => {
      if (attempt === this.attempt) start(transport);
    }, () => {
      if (attempt === this.attempt) listener.closed(false);
    });
  }

  get isNarrow(): boolean {
    return this.device !== null;
  }

  private async load(token: string): Promise<Transport | null> {
    if (this.device) return new (await import("../bluetooth/bluetooth_transport")).BluetoothTransport(this.device);
    const {openInvitation} = await import("./sealed_transport");
    return openInvitation(token, (path) => new WebSocketTransport(this.pageUrl, path));
  }

  send(bytes: Uint8Array): void {
    this.inner?.send(bytes);
  }

  close(): void {
    this.attempt++;
    this.inner?.close();
    this.inner = null;
  }

  backlogBytes(): number {
    return this.inner?.backlogBytes() ?? 0;
  }

  another(): Transport {
    return new WebSocketTransport(this.pageUrl);
  }

  somethingAnswers(): Promise<boolean> {
    if (this.inner && this.isNarrow) return this.inner.somethingAnswers();
    return new WebSocketTransport(this.pageUrl).somethingAnswers();
  }
}
