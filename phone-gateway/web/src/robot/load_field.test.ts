import {readFileSync} from "node:fs";
import {describe, expect, it} from "vitest";
import {parseFieldLines} from "./load_field";

describe("parseFieldLines", () => {
  it("reads the scene file of this project", () => {
    const text = readFileSync(new URL("../../../../data/scenes/soccer.yaml", import.meta.url), "utf8");
    expect(parseFieldLines(text)).toMatchObject({
      length: 9, width: 6, lineWidth: 0.05, centreCircleDiameter: 1.5,
      penaltyAreaLength: 1.65, penaltyAreaWidth: 4,
    });
  });
  it("gives nothing where there is no whole field", () => {
    expect(parseFieldLines("name: empty\n")).toBeNull();
    expect(parseFieldLines("field:\n  length: 9\nball:\n  width: 6\n")).toBeNull();
  });
});
