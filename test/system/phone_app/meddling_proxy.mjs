// Usage: node meddling_proxy.mjs LISTEN_ADDRESS PORT RELAY_ADDRESS PORT
// Stands between a gateway and nao-relay, and does to the next message of a phone what a signal says: SIGUSR1 changes it,
// SIGUSR2 repeats it, SIGHUP drops it. Prints on stderr what it has done, and whether it has read NAO_SECRET_WORDS.
import {createConnection, createServer} from "node:net";

const [address, port, relayAddress, relayPort] = process.argv.slice(2);
const words = process.env.NAO_SECRET_WORDS;
/** First byte of TLS (RFC 8446, 5.1: handshake), which the connection without phones has. */
const kTls = 0x16;
/** A message of a phone has at least 32 bytes, and is longer than a ping or the end of a WebSocket. */
const kLeastBytes = 34;
let mode = "";
for (const [signal, name] of [["SIGUSR1", "changed"], ["SIGUSR2", "repeated"], ["SIGHUP", "dropped"]]) {
  process.on(signal, () => mode = name);
}

createServer((gateway) => {
  const relay = createConnection({host: relayAddress, port: Number(relayPort)});
  let isTls;
  gateway.on("data", (bytes) => {
    isTls ??= bytes[0] === kTls;
    relay.write(bytes);
  });
  let read = "";
  relay.on("data", (bytes) => {
    if (isTls) return gateway.write(bytes);
    read = (read + bytes.toString("latin1")).slice(-10_000);
    if (words && read.includes(words)) process.stderr.write("read the secret words\n");
    // A WebSocket's binary message (RFC 6455, 5.2) after the handshake.
    if (!mode || bytes[0] !== 0x82 || bytes.length < kLeastBytes) return gateway.write(bytes);
    const done = mode;
    mode = "";
    process.stderr.write(`${done} a message\n`);
    if (done === "changed") bytes[bytes.length - 1] ^= 1;
    if (done !== "dropped") gateway.write(bytes);
    if (done === "repeated") gateway.write(bytes);
  });
  for (const [one, other] of [[gateway, relay], [relay, gateway]]) {
    one.on("error", () => other.destroy());
    one.on("close", () => other.destroy());
  }
}).listen(Number(port), address, () => process.stderr.write("listening\n"));
