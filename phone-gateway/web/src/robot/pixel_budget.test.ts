import {describe, expect, it} from "vitest";
import {PixelBudget} from "./pixel_budget";

/** A fast frame, s. */
const kFast = 1 / 60;

/** Frames of a length, for some seconds. @return how often the quality changed. */
function run(budget: PixelBudget, dt: number, seconds: number): number {
  let numChanges = 0;
  for (let time = 0; time < seconds; time += dt) {
    if (budget.frame(dt)) numChanges++;
  }
  return numChanges;
}

describe("PixelBudget", () => {
  it("leaves a fast phone alone", () => {
    const budget = new PixelBudget(2, 0.75);
    expect(run(budget, kFast, 60)).toBe(0);
    expect(budget).toMatchObject({pixelRatio: 2, isLeast: false});
  });
  it("draws fewer pixels on a slow phone, then the least, within seconds", () => {
    const budget = new PixelBudget(2, 0.75);
    run(budget, 0.05, 3);
    expect(budget.pixelRatio).toBeLessThan(2);
    expect(budget.isLeast).toBe(false);
    run(budget, 0.05, 8);
    expect(budget).toMatchObject({pixelRatio: 0.75, isLeast: true});
  });
  it("forgives single slow frames", () => {
    const budget = new PixelBudget(2, 0.75);
    for (let i = 0; i < 50; i++) {
      budget.frame(0.2);
      run(budget, kFast, 0.5);
    }
    expect(budget.pixelRatio).toBe(2);
  });
  it("has all pixels again some seconds after a busy moment", () => {
    const budget = new PixelBudget(0.75, 0.5);
    run(budget, 0.05, 6);
    expect(budget).toMatchObject({pixelRatio: 0.5, isLeast: true});
    run(budget, kFast, 45);
    expect(budget).toMatchObject({pixelRatio: 0.75, isLeast: false});
  });
  it("does not pump on a phone that is slow with more pixels", () => {
    const budget = new PixelBudget(2, 0.75);
    let numChanges = 0;
    for (let time = 0; time < 1800; time += 1) numChanges += run(budget, budget.pixelRatio > 1.2 ? 0.05 : kFast, 1);
    expect(budget.pixelRatio).toBeLessThan(1.2);
    expect(numChanges).toBeLessThan(25);
  });
});
