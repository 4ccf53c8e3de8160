import {describe, expect, it} from "vitest";
import {ClockRelation} from "./clock_relation";

describe("ClockRelation", () => {
  it("knows nothing before a ping has been answered", () => {
    const clocks = new ClockRelation();
    expect(clocks.transitMs(5, 1000)).toBeNull();
    clocks.add(0, 10, 0);
    expect(clocks.transitMs(5, 1000)).toBeNull();
  });
  it("tells how long a message was under way, whatever the clocks show", () => {
    const clocks = new ClockRelation();
    // The gateway's clock is 60 s ahead.
    clocks.add(1000, 1040, 61.02);
    expect(clocks.transitMs(62, 2150)).toBeCloseTo(150);
  });
  it("trusts the fastest ping", () => {
    const clocks = new ClockRelation();
    clocks.add(0, 10, 60.005);
    // Its answer waited for 0.6 s.
    clocks.add(1000, 1700, 61.01);
    expect(clocks.transitMs(62, 2020)).toBeCloseTo(20);
  });
  it("forgets a fast ping after twenty others, as clocks drift", () => {
    const clocks = new ClockRelation();
    clocks.add(0, 10, 60.005);
    for (let i = 1; i <= 20; i++) clocks.add(i * 1000, i * 1000 + 20, 60.06 + i);
    expect(clocks.transitMs(90, 30_000)).toBeCloseTo(50);
  });
});
