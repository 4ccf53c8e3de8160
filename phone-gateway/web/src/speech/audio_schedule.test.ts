import {describe, expect, it} from "vitest";
import {AudioSchedule, toFloats} from "./audio_schedule";

const second = (speech: number): {speech: number; sampleRate: number; samples: Uint8Array; isLast: boolean} =>
    ({speech, sampleRate: 8000, samples: new Uint8Array(16000), isLast: false});

describe("AudioSchedule", () => {
  it("plays pieces one after the other, the first at once", () => {
    const schedule = new AudioSchedule();
    const first = schedule.place(second(1), 10);
    expect(first.isStop).toBe(true);
    expect(first.start).toBeGreaterThan(10);
    expect(first.start).toBeLessThan(10.2);
    const next = schedule.place(second(1), 10.4);
    expect(next.isStop).toBe(false);
    expect(next.start).toBeCloseTo(first.start + 1);
  });
  it("begins anew after a gap, and with another text", () => {
    const schedule = new AudioSchedule();
    schedule.place(second(1), 10);
    expect(schedule.place(second(1), 20).start).toBeCloseTo(20.08);
    const other = schedule.place(second(2), 20.1);
    expect(other.isStop).toBe(true);
    expect(other.start).toBeCloseTo(20.18);
  });
  it("stops at a piece without samples, and plays nothing that no browser can", () => {
    const schedule = new AudioSchedule();
    schedule.place(second(1), 10);
    const stop = schedule.place({...second(1), samples: new Uint8Array(0), isLast: true}, 10.1);
    expect(stop.isStop).toBe(true);
    expect(stop.start).toBeNaN();
    expect(schedule.place({...second(1), sampleRate: 5}, 11).start).toBeNaN();
    expect(schedule.place({...second(1), samples: new Uint8Array(1)}, 12).start).toBeNaN();
  });
  it("never gets more than two seconds ahead", () => {
    const schedule = new AudioSchedule();
    for (let i = 0; i < 50; i++) {
      expect(schedule.place(second(1), 10).start).toBeLessThan(12.1);
    }
  });
});

describe("toFloats", () => {
  it("reads signed 16-bit numbers, low byte first", () => {
    expect([...toFloats(new Uint8Array([0, 0, 0, 64, 0, 128, 9]))]).toEqual([0, 0.5, -1]);
  });
});
