import {describe, expect, it} from "vitest";
import {Store} from "../store";
import {linkDelay, linkInWords, linkQuality} from "./link_sign";

describe("the link sign", () => {
  const state = (stateAgeMs: number, latencyMs = 43) => {
    const store = new Store();
    store.set({phase: "connected", latencyMs, stateAgeMs});
    return store.get();
  };

  it("shows the round trip while states come", () => {
    expect(linkDelay(state(60))).toBe(43);
    expect(linkQuality(state(60))).toBe("good");
  });
  it("shows the age of what is seen while nothing comes", () => {
    expect(linkDelay(state(400))).toBe(400);
    expect(linkQuality(state(400))).toBe("poor");
    expect(linkInWords(state(5200))).toContain("5200 ms");
  });
  it("is poor without a connection, whatever was measured before", () => {
    const store = new Store();
    store.set({phase: "waiting", latencyMs: 3, stateAgeMs: 20});
    expect(linkQuality(store.get())).toBe("poor");
  });
});
