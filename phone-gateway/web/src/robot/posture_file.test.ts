import {existsSync, readdirSync, readFileSync} from "node:fs";
import {describe, expect, it} from "vitest";
import {parsePostures} from "./posture_file";

const kRobots = new URL("../../../../data/robots/", import.meta.url);
const fileOf = (robot: string) => new URL(`${robot}/postures.yaml`, kRobots);
const read = (robot: string) => parsePostures(readFileSync(fileOf(robot), "utf8"));

describe("a robot's postures", () => {
  it.each(readdirSync(kRobots).filter((robot) => existsSync(fileOf(robot))))("of %s have families, and one number of joints each", (robot) => {
    const postures = [...read(robot).values()];
    expect(postures.length).toBeGreaterThan(1);
    expect(postures.map(({family}) => family)).toContain("standing");
    expect(new Set(postures.map(({angles}) => Object.keys(angles).length)).size).toBe(1);
    expect(Object.keys(postures[0]!.angles).length).toBeGreaterThan(20);
  });
  it("are read by name", () => {
    expect(read("nao").get("LyingBack")?.family).toBe("lying-back");
    expect(read("nao").get("StandInit")?.angles["LKneePitch"]).toBe(0.7);
  });
  it("leave out what cannot be read", () => {
    const text = "postures:\n  - name: Odd\n    joints:\n      A: one\n      B: 0.5\n";
    expect(parsePostures(text).get("Odd")).toEqual({family: "", angles: {B: 0.5}});
    expect(parsePostures("").size).toBe(0);
  });
});
