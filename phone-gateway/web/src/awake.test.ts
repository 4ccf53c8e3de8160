/** A phone as it is: it sleeps, is locked, takes calls, and takes the drawing context. */
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import {kRestoreMs, watchContext} from "./robot/lost_context";
import {Sound} from "./sound";
import {WakeLock} from "./wake_lock";

afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("WakeLock", () => {
  const locks: {released: boolean; release: () => Promise<void>}[] = [];
  const last = () => locks.at(-1)!;
  const settle = () => new Promise((resolve) => setTimeout(resolve));

  beforeEach(() => {
    locks.length = 0;
    vi.stubGlobal("navigator", {wakeLock: {request: async () => {
      const lock = {released: false, release: async () => void (lock.released = true)};
      locks.push(lock);
      return lock;
    }}});
  });

  it("is held, and taken again when the page is shown after the browser has released it", async () => {
    const screen = new WakeLock();
    screen.hold();
    await settle();
    await screen.renew();
    expect(locks).toHaveLength(1);
    last().released = true;
    await screen.renew();
    expect(locks).toHaveLength(2);
    screen.release();
    expect(last().released).toBe(true);
    await screen.renew();
    expect(locks).toHaveLength(2);
  });

  it("is released when it arrives too late", async () => {
    const screen = new WakeLock();
    screen.hold();
    screen.release();
    await settle();
    expect(last().released).toBe(true);
  });

  it("is done without where the browser has none, or refuses", async () => {
    for (const wakeLock of [undefined, {request: () => Promise.reject(new Error("NotAllowedError"))}]) {
      vi.stubGlobal("navigator", {wakeLock});
      new WakeLock().hold();
      await settle();
    }
  });
});

describe("Sound", () => {
  it("returns after a call or a lock, at the next touch or when the page is shown", async () => {
    const page = Object.assign(new EventTarget(), {visibilityState: "visible"});
    vi.stubGlobal("document", page);
    const contexts: {state: string; resume: () => Promise<void>}[] = [];
    vi.stubGlobal("AudioContext", function AudioContext(this: {state: string; resume: () => Promise<void>}) {
      this.state = "suspended";
      this.resume = async () => void (this.state = "running");
      contexts.push(this);
    });
    const sound = new Sound();
    page.dispatchEvent(new Event("visibilitychange"));
    expect(sound.running).toBeNull();
    for (const way of ["pointerup", "visibilitychange", "pointerdown", "keydown"]) {
      page.dispatchEvent(new Event(way));
      expect(sound.running, way).not.toBeNull();
      contexts[0]!.state = "interrupted";
      expect(sound.running).toBeNull();
    }
    expect(contexts).toHaveLength(1);
  });
});

describe("a lost drawing context", () => {
  it("is told if it does not return, and no more when it does", () => {
    vi.useFakeTimers();
    const canvas = new EventTarget();
    const told: boolean[] = [];
    watchContext(canvas, (isLost) => told.push(isLost));
    const lost = new Event("webglcontextlost", {cancelable: true});
    canvas.dispatchEvent(lost);
    expect(lost.defaultPrevented).toBe(true);
    vi.advanceTimersByTime(kRestoreMs - 1);
    expect(told).toEqual([]);
    vi.advanceTimersByTime(1);
    expect(told).toEqual([true]);
    canvas.dispatchEvent(new Event("webglcontextrestored"));
    expect(told).toEqual([true, false]);
    canvas.dispatchEvent(new Event("webglcontextlost"));
    canvas.dispatchEvent(new Event("webglcontextrestored"));
    vi.advanceTimersByTime(2 * kRestoreMs);
    expect(told).toEqual([true, false, false]);
  });
});
