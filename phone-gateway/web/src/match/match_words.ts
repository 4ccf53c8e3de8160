/** A match in words; no page, no time. */
import {Match_Event, Match_Phase} from "../protocol/generated/remote_pb";
import type {Match} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

/** "4:07". */
export function clockInWords(seconds: number): string {
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;
}

export function phaseInWords(match: Match): string {
  switch (match.phase) {
    case Match_Phase.INITIAL: return say("match.initial");
    case Match_Phase.READY: return say("match.ready");
    case Match_Phase.SET: return say("match.set");
    case Match_Phase.FINISHED: return say("match.finished");
    default: return say("match.playing", {half: say(match.half === 2 ? "match.half2" : "match.half1"),
                                          clock: clockInWords(match.timeLeft)});
  }
}

/** What has just happened; empty: nothing that a person wants to know. */
export function eventInWords(match: Match): string {
  const team = say(match.eventTeam === 1 ? "lobby.team1" : "lobby.team0");
  const score = {blue: match.score0, red: match.score1};
  switch (match.event) {
    case Match_Event.KICK_OFF: return say("match.kickOff", {team});
    case Match_Event.GOAL: return say("match.goal", {team, ...score});
    case Match_Event.BALL_OUT: return say("match.ballOut", {team});
    case Match_Event.PENALTY: return say("match.penalty", {robot: match.eventRobot});
    case Match_Event.PENALTY_END: return say("match.penaltyEnd", {robot: match.eventRobot});
    case Match_Event.HALF_END: return say("match.halfEnd");
    case Match_Event.MATCH_END: return say("match.end", score);
    default: return "";
  }
}

/** Seconds for which a robot's penalty lasts; 0: it has none. */
export function penaltyOf(match: Match | null, robot: string): number {
  return match?.penalties.find((penalty) => penalty.robot === robot)?.timeLeft ?? 0;
}
