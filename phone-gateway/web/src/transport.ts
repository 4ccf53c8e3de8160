import type {BluetoothDevice} from "./bluetooth/web_bluetooth";
import {timeLimit} from "./time_limit";

/** How messages reach the gateway. */
export interface Transport {
  /** Starts to connect, by a token or an invitation; exactly one of the listener's calls follows in time. */
  open(listener: TransportListener, token?: string): void;
  /** Sends one message. Ignored unless open. */
  send(bytes: Uint8Array): void;
  /** Ends the connection; the listener hears nothing more. */
  close(): void;
  /** Bytes handed to send() that have not left yet. */
  backlogBytes(): number;
  /** Images come over this connection too. */
  readonly isSingle?: boolean;
  /** It carries some kB a second, and takes seconds to open. */
  readonly isNarrow?: boolean;
  /** Another connection to the same gateway, for images. */
  another?(): Transport;
  /** True if something answers at the address at all; asked after a failure, to say why. */
  somethingAnswers(): Promise<boolean>;
}

export interface TransportListener {
  opened(): void;
  received(bytes: Uint8Array): void;
  /** @param wasOpen false if the connection never came about. */
  closed(wasOpen: boolean): void;
}

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
    if (this.device) return new (await import("./bluetooth/bluetooth_transport")).BluetoothTransport(this.device);
    const {openInvitation} = await import("./relay/sealed_transport");
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

export class WebSocketTransport implements Transport {
  private socket: WebSocket | null = null;

  /** @param pageUrl URL of the gateway's page; the WebSocket lies beside it at /ws. */
  constructor(private readonly pageUrl: URL, private readonly path = "/ws") {}

  open(listener: TransportListener): void {
    this.close();
    const url = new URL(this.path, this.pageUrl);
    url.protocol = this.pageUrl.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    let wasOpen = false;
    const isCurrent = () => this.socket === socket;
    socket.onopen = () => {
      wasOpen = true;
      if (isCurrent()) listener.opened();
    };
    socket.onmessage = (event: MessageEvent<unknown>) => {
      if (isCurrent() && event.data instanceof ArrayBuffer) {
        listener.received(new Uint8Array(event.data));
      }
    };
    // An error is always followed by a close; browsers give scripts no further information.
    socket.onclose = () => {
      if (!isCurrent()) return;
      this.socket = null;
      listener.closed(wasOpen);
    };
  }

  send(bytes: Uint8Array): void {
    if (this.socket?.readyState === WebSocket.OPEN) {
      this.socket.send(bytes as Uint8Array<ArrayBuffer>);
    }
  }

  close(): void {
    const socket = this.socket;
    this.socket = null;
    socket?.close();
  }

  backlogBytes(): number {
    return this.socket?.bufferedAmount ?? 0;
  }

  async somethingAnswers(): Promise<boolean> {
    try {
      // The query keeps the service worker's offline copy out of the answer.
      const url = new URL(`/manifest.webmanifest?probe=${Date.now()}`, this.pageUrl);
      await fetch(url, {cache: "no-store", signal: timeLimit(2000)});
      return true;
    } catch {
      return false;
    }
  }
}
