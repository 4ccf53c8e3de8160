/** A match in words; no page, no time. */
import {Match_Event, Match_Phase} from "../protocol/generated/remote_pb";
import type {Match} from "../protocol/generated/remote_pb";
import {nameOf} from "../protocol/names";
import {clockInWords} from "../text/clock";
import {isText, say} from "../text/texts";

export function phaseInWords({phase, half, timeLeft}: Match): string {
  return say(`match.${nameOf(Match_Phase, phase, "playing")}`,
             {half: say(half === 2 ? "match.half2" : "match.half1"), clock: clockInWords(timeLeft)});
}

/** What has just happened; empty: nothing that a person wants to know. */
export function eventInWords({event, eventTeam, eventRobot: robot, score0: blue, score1: red}: Match): string {
  const key = `match.event.${nameOf(Match_Event, event, "none")}`;
  const team = say(eventTeam === 1 ? "lobby.team1" : "lobby.team0");
  return isText(key) ? say(key, {team, robot, blue, red}) : "";
}

/** Seconds for which a robot's penalty lasts; 0: it has none. */
export function penaltyOf(match: Match | null, robot: string): number {
  return match?.penalties.find((penalty) => penalty.robot === robot)?.timeLeft ?? 0;
}
