import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {ExhibitionSchema} from "../protocol/generated/remote_pb";
import {challengeInWords, driverInWords, waitInWords} from "./words";
import {clockInWords} from "../text/clock";

describe("words of an exhibition", () => {
  it("count a turn down", () => {
    expect(clockInWords(90)).toBe("1:30");
    expect(clockInWords(5)).toBe("0:05");
  });

  it("tell a wait in minutes, and the last one as such", () => {
    expect(waitInWords(create(ExhibitionSchema, {wait: 40}))).toBe("in less than a minute");
    expect(waitInWords(create(ExhibitionSchema, {wait: 200}))).toBe("in about 3 min");
  });

  it("tell the challenge, then its time", () => {
    const exhibition = {driver: "Vega", hasChallenge: true, challengeIsGoal: true};
    expect(challengeInWords(create(ExhibitionSchema, {}))).toBe("");
    expect(challengeInWords(create(ExhibitionSchema, exhibition))).toBe("Kick the ball into the goal");
    expect(challengeInWords(create(ExhibitionSchema, {...exhibition, challengeTime: 12.34}))).toBe("12.3 s");
  });

  it("tell why nobody drives", () => {
    const exhibition = {driver: "Vega", isPaused: true, isResting: true};
    expect(driverInWords(create(ExhibitionSchema, exhibition))).toBe("The robot rests");
    expect(driverInWords(create(ExhibitionSchema, {...exhibition, isResting: false}))).toBe("A short pause");
    expect(driverInWords(create(ExhibitionSchema, {driver: "Vega"}))).toBe("Vega drives");
    expect(driverInWords(create(ExhibitionSchema, {driver: "Vega", isRobotAway: true}))).toBe("The robot is away for a moment");
  });
});
