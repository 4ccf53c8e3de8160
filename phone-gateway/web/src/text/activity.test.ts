import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {ActivitySchema, CommandKind, Mode} from "../protocol/generated/remote_pb";
import {activityInWords, modeInWords} from "./activity";
import {readLabels} from "../../test_support/nao_files";
import {setLabels, setLanguage} from "./texts";

const inWords = (kind: CommandKind, name = "", needsHelp = false): string =>
    activityInWords(create(ActivitySchema, {kind, name, needsHelp}));

describe("activityInWords", () => {
  it("names postures and actions as their buttons do", async () => {
    setLabels(readLabels(new URL("../../../../data/robots/nao", import.meta.url).pathname));
    await setLanguage("de");
    expect(inWords(CommandKind.POSTURE, "StandInit")).toBe("Startklar");
    expect(inWords(CommandKind.ACTION, "kick-left")).toBe("Schuss links");
    expect(inWords(CommandKind.ACTION, "_draft")).toBe("Neue Bewegung");
    setLanguage("en");
    expect(inWords(CommandKind.POSTURE, "Headstand")).toBe("Headstand");
  });
  it("omits what the mode says", () => {
    expect(inWords(CommandKind.WALK)).toBe("");
    expect(inWords(CommandKind.STOP)).toBe("");
    expect(activityInWords(undefined)).toBe("");
  });
  it("names the goal of a walk and the need for help", () => {
    expect(inWords(CommandKind.MOVE_TO)).toBe("to the marked spot");
    expect(inWords(CommandKind.NONE, "", true)).toBe("please put it on its feet");
  });
});

describe("modeInWords", () => {
  it("has a text for every mode, and for one of a newer gateway", () => {
    for (const mode of Object.values(Mode)) if (typeof mode === "number") expect(modeInWords(mode)).toMatch(/^[A-Z]/);
    expect(modeInWords(Mode.GETTING_UP)).toBe("Getting up");
    expect(modeInWords(99 as Mode)).toBe(modeInWords(Mode.NO_ROBOT));
  });
  it("does not say that a robot waits which acts by itself", () => {
    expect(modeInWords(Mode.HOLDING)).toBe("Standing by");
    expect(modeInWords(Mode.HOLDING, true)).toBe("Playing by itself");
    expect(modeInWords(Mode.WALKING, true)).toBe("Walking");
  });
});
