import {create} from "@bufbuild/protobuf";
import {readFileSync} from "node:fs";
import {describe, expect, it} from "vitest";
import {BodySchema, RobotDescriptionSchema} from "../protocol/generated/remote_pb";
import {readLabels} from "../../test_support/nao_files";
import {batteryInWords, bodyInWords, warningsInWords} from "./body";
import {isText, setLabels, setLanguage} from "./texts";

const robot = create(RobotDescriptionSchema, {
  jointGroups: [{name: "left-knee", pitchJoint: "LKneePitch"}],
});

describe("bodyInWords", () => {
  it("tells battery, hottest motor and warnings in three languages", async () => {
    setLabels(readLabels(new URL("../../../../data/robots/nao", import.meta.url).pathname));
    const body = create(BodySchema, {
      batteryCharge: 0.634, isCharging: true, hottestJoint: "LKneePitch", hottestTemperature: 76.4,
      warnings: ["joint-hot", "shell-open"], faultyJoints: ["LKneePitch", "LKneePitch", "Tail"],
    });
    await setLanguage("de");
    expect(bodyInWords(body, robot)).toEqual([
      "Akku 63 %, lädt", expect.stringMatching(/^Wärmster Motor: .+, 76 °C$/),
      expect.stringMatching(/^Ein Motor ist heiß \(.+, Tail\): lass den Roboter sitzen\.$/), "shell-open"]);
    await setLanguage("pt");
    expect(bodyInWords(body, robot)[0]).toBe("Bateria 63 %, a carregar");
    setLanguage("en");
    expect(warningsInWords(body, robot)).toHaveLength(2);
  });
  it("says when nothing is known, and when all is well", () => {
    expect(bodyInWords(undefined, robot)).toEqual(["Nothing is known of it, as of a simulated robot's."]);
    expect(batteryInWords(create(BodySchema, {}))).toBe("");
    expect(bodyInWords(create(BodySchema, {batteryCharge: 0}), robot)).toEqual(["Battery 0 %", "No warnings."]);
  });
  it("has a text for every code of the protocol", () => {
    const protocol = readFileSync(new URL("../../../PROTOCOL.md", import.meta.url), "utf8");
    const start = protocol.indexOf("**Body.**");
    const table = protocol.slice(start, protocol.indexOf("###", start));
    const codes = [...table.matchAll(/^\| `([a-z-]+)` \|/gm)].map((match) => match[1]);
    expect(codes).toHaveLength(5);
    for (const code of codes) expect(isText(`body.${code}`)).toBe(true);
  });
});
