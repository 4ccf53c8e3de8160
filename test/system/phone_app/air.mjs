// What goes over the air: a forwarder before the gateway that counts every byte of HTTP towards the phone,
// whichever part of the browser asked for it. A page's own resource timing does not know what its service
// worker fetched, and reports what came through it unpacked.
import {connect, createServer} from "node:net";

export class Air {
  /** Bytes of HTTP answers, headers among them; the WebSocket's states and images are not. */
  numBytes = 0;
  /** Paths asked for, in this order. */
  paths = [];
  /** Bytes of the answers to each path. */
  bytesOf = new Map();
  #server = createServer((phone) => this.#forward(phone));
  #gatewayPort;
  #bytesPerMs;
  /** When all that was sent has gone through, ms. */
  #freeMs = 0;

  /** @param bitsPerSecond  towards the phone, of all connections together. */
  constructor(gatewayPort, bitsPerSecond = Infinity) {
    this.#gatewayPort = gatewayPort;
    this.#bytesPerMs = bitsPerSecond / 8000;
  }

  /** @return the port for the phone. */
  async start() {
    await new Promise((resolve) => this.#server.listen(0, "127.0.0.1", resolve));
    return this.#server.address().port;
  }

  stop() {
    this.#server.close();
  }

  #forward(phone) {
    const gateway = connect(this.#gatewayPort, "127.0.0.1");
    let isWebSocket = false;
    let asked = "";
    phone.on("data", (bytes) => {
      // A phone sends one request at a time on a connection, and each of them in one piece.
      const path = isWebSocket ? undefined : /^GET (\S+) HTTP/.exec(bytes.toString("latin1"))?.[1];
      if (path === "/ws") isWebSocket = true;
      else if (path) this.paths.push(asked = path);
    });
    gateway.on("data", (bytes) => {
      if (!isWebSocket) {
        this.numBytes += bytes.length;
        this.bytesOf.set(asked, (this.bytesOf.get(asked) ?? 0) + bytes.length);
      }
      const now = performance.now();
      this.#freeMs = Math.max(this.#freeMs, now) + bytes.length / this.#bytesPerMs;
      if (this.#freeMs - now < 1) return phone.write(bytes);
      gateway.pause();
      setTimeout(() => {
        phone.write(bytes);
        gateway.resume();
      }, this.#freeMs - now);
    });
    phone.pipe(gateway);
    gateway.on("end", () => phone.end());
    for (const [from, to] of [[phone, gateway], [gateway, phone]]) from.on("error", () => to.destroy());
  }
}
