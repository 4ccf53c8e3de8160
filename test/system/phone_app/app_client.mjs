// The app's own connection in this process, without a page: what a request costs is measured without drawing.
import {mkdtemp, rm} from "node:fs/promises";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {pathToFileURL} from "node:url";
import {webcrypto} from "node:crypto";
import {requireFromApp} from "./phone.mjs";

/** Names of the app's source that a client needs. */
const kEntry = `
export {Connection} from "./src/connection";
export {ErrorCode} from "./src/protocol/generated/remote_pb";
export {Store} from "./src/store";
export {GatewayTransport} from "./src/relay/gateway_transport";
`;

/** @param webDir  folder of the app's package.json.
 * @return connectTo(link): {ask(useCase), store, end()} of a client that is connected; ErrorCode of the app. */
export async function loadClient(webDir) {
  const require = requireFromApp(webDir);
  // What browsers have, and Node 18 does not.
  globalThis.crypto ??= webcrypto;
  const {WebSocket} = require("ws");
  // The relay's certificate is signed by itself.
  globalThis.WebSocket = class extends WebSocket {
    constructor(url) {
      super(url, {rejectUnauthorized: false});
    }
  };
  const folder = await mkdtemp(join(tmpdir(), "nao-client-"));
  const file = join(folder, "client.mjs");
  try {
    await require("esbuild").build({stdin: {contents: kEntry, resolveDir: webDir}, bundle: true, platform: "node", format: "esm", outfile: file});
    const {Connection, ErrorCode, GatewayTransport, Store} = await import(pathToFileURL(file));
    const connectTo = (link) => new Promise((resolve, reject) => {
      const url = new URL(link);
      const store = new Store();
      const ignore = () => {};
      const connection = new Connection(new GatewayTransport(url), store, {
        connected: () => resolve({store, ask: (useCase) => connection.request(useCase), end: () => connection.disconnect()}),
        state: ignore, image: ignore, notice: ignore,
      });
      store.watch(({problem}) => problem, (problem) => {
        if (problem) reject(new Error(problem));
      });
      connection.connect({token: new URLSearchParams(url.hash.slice(1)).get("token"), clientName: "test", clientSoftware: "test"});
    });
    return {connectTo, ErrorCode};
  } finally {
    await rm(folder, {recursive: true, force: true});
  }
}
