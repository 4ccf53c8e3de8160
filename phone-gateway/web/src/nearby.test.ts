import {afterEach, describe, expect, it, vi} from "vitest";
import {findGateways, parseGateways} from "./nearby";
import {WebSocketTransport} from "./transport";

describe("parseGateways", () => {
  it("takes name and address", () => {
    const list = [{name: "NAO on lab-3", address: "192.168.1.20", http_port: 8080, url: "http://192.168.1.20:8080"}];
    expect(parseGateways({gateways: list})).toEqual([{name: "NAO on lab-3", address: "192.168.1.20:8080"}]);
  });
  it("leaves out what is not a gateway", () => {
    for (const data of [null, 3, {}, {gateways: 1}, {gateways: [null, 1, {}, {name: "x", address: "javascript:1", http_port: 1},
                                                               {name: "", address: "10.0.0.1", http_port: 1},
                                                               {name: "x", address: "10.0.0.1", http_port: "1"}]}]) {
      expect(parseGateways(data)).toEqual([]);
    }
  });
});

describe("on a phone without AbortSignal.timeout()", () => {
  const pageUrl = new URL("http://10.0.0.2/");
  afterEach(() => vi.unstubAllGlobals());

  it("finds gateways, and knows whether the host answers", async () => {
    vi.stubGlobal("AbortSignal", class {});
    const gateways = {gateways: [{name: "x", address: "10.0.0.1", http_port: 1}]};
    vi.stubGlobal("fetch", vi.fn(() => Promise.resolve({ok: true, json: () => Promise.resolve(gateways)})));
    expect(await findGateways(pageUrl.href)).toEqual([{name: "x", address: "10.0.0.1:1"}]);
    expect(await new WebSocketTransport(pageUrl).somethingAnswers()).toBe(true);
  });

  it("gives up what does not answer", async () => {
    vi.useFakeTimers();
    vi.stubGlobal("fetch", (_: URL, {signal}: RequestInit) =>
      new Promise((_, reject) => signal!.addEventListener("abort", () => reject(new Error("aborted")))));
    const answers = new WebSocketTransport(pageUrl).somethingAnswers();
    await vi.advanceTimersByTimeAsync(2000);
    expect(await answers).toBe(false);
    vi.useRealTimers();
  });
});
