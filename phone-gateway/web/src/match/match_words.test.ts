import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {Match_Event, Match_Phase, MatchSchema} from "../protocol/generated/remote_pb";
import {Messages} from "../messages";
import {Store} from "../store";
import {reportMatch} from "./match_events";
import {tonesOf} from "./match_sound";
import {clockInWords} from "../text/clock";
import {eventInWords, penaltyOf, phaseInWords} from "./match_words";

describe("a match in words", () => {
  it("shows the clock as minutes and seconds", () => {
    expect([300, 247, 60, 9, 0].map(clockInWords)).toEqual(["5:00", "4:07", "1:00", "0:09", "0:00"]);
  });

  it("names the phase", () => {
    const match = create(MatchSchema, {phase: Match_Phase.PLAYING, half: 2, timeLeft: 61});
    expect(phaseInWords(match)).toBe("Second half, 1:01 left");
    expect(phaseInWords(create(MatchSchema, {phase: Match_Phase.READY, half: 1}))).toBe("Take your places");
    expect(phaseInWords(create(MatchSchema, {phase: Match_Phase.FINISHED, half: 2}))).toBe("The match is over");
  });

  it("tells a goal with its team and the score", () => {
    const match = create(MatchSchema, {event: Match_Event.GOAL, eventTeam: 1, score0: 2, score1: 1});
    expect(eventInWords(match)).toBe("Goal for the Red team! 2:1");
    expect(eventInWords(create(MatchSchema, {}))).toBe("");
    for (const event of [1, 2, 3, 4, 5, 6, 7]) {
      expect(eventInWords(create(MatchSchema, {event, eventRobot: "NAO2"}))).not.toMatch(/^$|[{}]/);
    }
  });

  it("knows a robot's penalty", () => {
    const match = create(MatchSchema, {penalties: [{robot: "NAO2", timeLeft: 12}]});
    expect([penaltyOf(match, "NAO2"), penaltyOf(match, "NAO1"), penaltyOf(null, "NAO2")]).toEqual([12, 0, 0]);
  });

  it("has a sound for what the referee whistles", () => {
    expect(tonesOf(Match_Event.GOAL).length).toBe(4);
    expect(tonesOf(Match_Event.PENALTY)).toEqual([]);
  });
});

describe("events of a match", () => {
  const store = new Store();
  const told = (): string[] => store.get().messages.map(({text}) => text);
  reportMatch(store, new Messages(store), {running: null});
  const set = (eventId: bigint, score0: number) =>
      store.set({match: create(MatchSchema, {half: 1, eventId, event: Match_Event.GOAL, eventTeam: 0, score0})});

  it("tells each once, and none that was before", () => {
    set(4n, 1);
    expect(told()).toEqual([]);
    set(5n, 2);
    set(5n, 2);
    expect(told()).toEqual(["Goal for the Blue team! 2:0"]);
    store.set({match: null});
    set(6n, 3);
    expect(told().length).toBe(1);
  });
});
