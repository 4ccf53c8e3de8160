import {describe, expect, it} from "vitest";
import {activityInWords} from "./activity";
import {setLanguage} from "./texts";

describe("activityInWords", () => {
  it("names postures and actions as their buttons do", () => {
    setLanguage("de");
    expect(activityInWords("posture StandInit")).toBe("Startklar");
    expect(activityInWords("action kick-left")).toBe("Schuss links");
    setLanguage("en");
    expect(activityInWords("posture Headstand")).toBe("Headstand");
  });
  it("leaves out what the mode says", () => {
    expect(activityInWords("walk 0.10 0.00 0.00")).toBe("");
    expect(activityInWords("stop")).toBe("");
    expect(activityInWords("")).toBe("");
  });
  it("says where it goes, and that it needs a hand", () => {
    expect(activityInWords("move-to 0.5 0 0")).toBe("to the marked spot");
    expect(activityInWords("needs help")).toBe("please put it on its feet");
  });
  it("says as it is what it does not know", () => {
    expect(activityInWords("dance waltz")).toBe("dance waltz");
  });
});
