import {create} from "@bufbuild/protobuf";
import {afterEach, describe, expect, it} from "vitest";
import {Play_Behavior, PlayState_Phase, PlayStateSchema} from "../protocol/generated/remote_pb";
import {setLanguage} from "../text/texts";
import {behaviorName, isByItself, playInWords} from "./play_words";

const state = create(PlayStateSchema, {behavior: Play_Behavior.SCORE, phase: PlayState_Phase.APPROACH});

afterEach(() => setLanguage("en"));

describe("playInWords", () => {
  it("says behaviour and phase", async () => {
    expect(playInWords(state)).toBe("Score: walks to the ball");
    await setLanguage("de");
    expect(playInWords(state)).toBe("Tor schießen: geht zum Ball");
  });
  it("says why the robot waits", async () => {
    const waits = create(PlayStateSchema, {behavior: Play_Behavior.SCORE, phase: PlayState_Phase.SEARCH,
                                           reasonCode: "vision-unavailable", reason: "No images are analysed."});
    expect(playInWords(waits)).toBe("Score: looks for the ball. No images are analysed.");
    await setLanguage("pt");
    expect(playInWords(waits)).toContain("imagens");
  });
  it("says what the robot does in a match that it plays by itself", () => {
    const plays = create(PlayStateSchema, {playsMatch: true, phase: PlayState_Phase.KICK});
    expect(isByItself(plays)).toBe(true);
    expect(playInWords(plays)).toBe("In the match: kicks");
    plays.phase = PlayState_Phase.GUARD;
    expect(playInWords(plays)).toBe("In the match: holds its place");
  });
  it("is silent without a behaviour", () => {
    expect(isByItself(null)).toBe(false);
    expect(playInWords(null)).toBe("");
    expect(playInWords(create(PlayStateSchema, {phase: PlayState_Phase.DONE}))).toBe("");
  });
});

it("names every behaviour, and has a text for it and its phases", () => {
  expect(behaviorName(Play_Behavior.KEEP_GOAL)).toBe("keep-goal");
  for (const behavior of [1, 2, 3, 4, 5]) for (const phase of [0, 1, 2, 3, 4, 5, 6, 7, 8]) {
    expect(playInWords(create(PlayStateSchema, {behavior, phase}))).toMatch(/^[A-Z][a-z ]+: [a-z ]+$/);
  }
});
