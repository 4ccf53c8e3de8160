import {readFileSync} from "node:fs";
import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import type {Drive} from "./stick";
import {kWalkPeriodMs, kWalkTimeoutMs, WalkSender} from "./walk_sender";

const ahead = {x: 1, y: 0, theta: 0};
const zero = {x: 0, y: 0, theta: 0};

describe("WalkSender", () => {
  let sent: Drive[];
  let locked: boolean[];
  let sender: WalkSender;

  beforeEach(() => {
    vi.useFakeTimers();
    sent = [];
    locked = [];
    sender = new WalkSender((drive, isLocked) => {
      sent.push(drive);
      locked.push(isLocked);
    }, () => Date.now());
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it("sends at once, then at least every 0.2 s while held", () => {
    sender.set("sticks", ahead);
    expect(sent).toEqual([ahead]);
    vi.advanceTimersByTime(1000);
    expect(kWalkPeriodMs).toBeLessThanOrEqual(200);
    expect(sent.length).toBe(1 + 1000 / kWalkPeriodMs);
  });

  it("knows the time-out of the gateway", () => {
    const limits = readFileSync(new URL("../../../server/core/gateway_limits.h", import.meta.url), "utf8");
    expect(limits).toContain(`double walk_timeout = ${kWalkTimeoutMs / 1000};`);
  });

  it("tells a stick that is held while locked from one that is released", () => {
    sender.set("sticks", ahead);
    sender.lock(true);
    expect(sent.at(-1)).toEqual(zero);
    expect(locked.at(-1)).toBe(true);
    sender.set("sticks", null);
    expect(sent.at(-1)).toEqual(zero);
    expect(locked.at(-1)).toBe(false);
    const count = sent.length;
    sender.lock(false);
    vi.advanceTimersByTime(1000);
    expect(sent.length).toBe(count);
  });

  it("ends the walk at once, and once, when released", () => {
    sender.set("sticks", ahead);
    sender.set("sticks", null);
    expect(sent.at(-1)).toEqual(zero);
    const count = sent.length;
    vi.advanceTimersByTime(1000);
    sender.release();
    expect(sent.length).toBe(count);
  });

  it("goes on while another source is held", () => {
    sender.set("sticks", ahead);
    sender.set("keys", {x: 0, y: 0, theta: 0.5});
    sender.set("sticks", null);
    vi.advanceTimersByTime(kWalkPeriodMs);
    expect(sent.at(-1)).toEqual({x: 0, y: 0, theta: 0.5});
  });

  it("does not flood the link when a finger moves fast", () => {
    for (let i = 0; i < 200; i++) {
      sender.set("sticks", {x: i / 200, y: 0, theta: 0});
      vi.advanceTimersByTime(5);
    }
    expect(sent.length).toBeLessThanOrEqual(50);
  });
});
