import {describe, expect, it} from "vitest";
import {freeName, motionName} from "./motion_name";

describe("motionName", () => {
  it.each([
    ["wave", "wave"], ["  Olá, Ana!  ", "Ola-Ana"], ["Grüße", "Grusse"], ["_secret", "secret"], ["a  b--c", "a-b--c"],
    ["!!!", ""], ["", ""], ["手", ""], ["Wave_2", "Wave_2"], ["x".repeat(60), "x".repeat(40)],
  ])("makes of %j the name %j", (text, name) => {
    expect(motionName(text)).toBe(name);
  });
});

describe("freeName", () => {
  it("counts up until a name is free", () => {
    expect(freeName("My motion", [])).toBe("My-motion");
    expect(freeName("My motion", ["My-motion", "My-motion-2"])).toBe("My-motion-3");
    expect(freeName("手", ["motion"])).toBe("motion-2");
  });
});
