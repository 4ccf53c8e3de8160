import {describe, expect, it} from "vitest";
import {PixelBudget} from "./pixel_budget";

/** Frames of a length, for some seconds. */
function run(budget: PixelBudget, dt: number, seconds: number): void {
  for (let time = 0; time < seconds; time += dt) budget.frame(dt);
}

describe("PixelBudget", () => {
  it("leaves a fast phone alone", () => {
    const budget = new PixelBudget(2, true, 0.75);
    run(budget, 1 / 60, 60);
    expect(budget).toMatchObject({pixelRatio: 2, hasShadow: true, isExhausted: false});
  });
  it("draws fewer pixels on a slow phone, then no shadow, within seconds; then it is exhausted", () => {
    const budget = new PixelBudget(2, true, 0.75);
    run(budget, 0.05, 3);
    expect(budget.pixelRatio).toBeLessThan(2);
    expect(budget.hasShadow).toBe(true);
    run(budget, 0.05, 8);
    expect(budget).toMatchObject({pixelRatio: 0.75, hasShadow: false, isExhausted: true});
  });
  it("forgives single slow frames", () => {
    const budget = new PixelBudget(2, true, 0.75);
    for (let i = 0; i < 50; i++) {
      budget.frame(0.2);
      run(budget, 1 / 60, 0.5);
    }
    expect(budget.pixelRatio).toBe(2);
  });
});
