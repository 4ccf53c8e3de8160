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
