import {afterEach, beforeEach, describe, expect, it, vi} from "vitest";
import type {Commander} from "../commander";
import type {UseCase} from "../protocol/codec";
import {Store} from "../store";
import {HandGuide, kDragPeriodMs, kStiffnessMs} from "./hand_guide";

describe("HandGuide", () => {
  let sent: UseCase[];
  let guide: HandGuide;

  beforeEach(() => {
    vi.useFakeTimers();
    sent = [];
    guide = new HandGuide(new Store(), {
      stream: (useCase: UseCase) => sent.push(useCase),
      command: async (useCase: UseCase) => sent.push(useCase) > 0,
    } as unknown as Commander);
  });
  afterEach(() => {
    vi.useRealTimers();
  });

  it("relaxes all groups of a limb at once, and is done when they are limp", async () => {
    let isDone = false;
    void guide.toggle(["shoulder", "elbow"]).then(() => isDone = true);
    await vi.advanceTimersByTimeAsync(kStiffnessMs - 1);
    expect(sent).toHaveLength(2);
    expect(isDone).toBe(false);
    await vi.advanceTimersByTimeAsync(1);
    expect(isDone).toBe(true);
  });

  it("repeats a pull while the finger holds it, at the finger's last place", () => {
    guide.drag({link: "wrist", targetX: 0.1, targetZ: 0.3});
    guide.drag({link: "wrist", targetX: 0.4, targetZ: 0.3});
    expect(sent).toHaveLength(1);
    vi.advanceTimersByTime(2 * kDragPeriodMs);
    expect(sent).toHaveLength(3);
    expect(sent[2]).toMatchObject({case: "drag", value: {link: "wrist", targetX: 0.4, targetZ: 0.3}});
    guide.endDrag();
    vi.advanceTimersByTime(10 * kDragPeriodMs);
    expect(sent).toHaveLength(3);
  });
});
