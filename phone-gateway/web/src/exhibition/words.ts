/** Times of an exhibition in words. Pure. */
import type {Exhibition} from "../protocol/generated/remote_pb";
import {tell} from "./exhibition_texts";

/** When a visitor's turn will begin. */
export function waitInWords({wait}: Exhibition): string {
  return wait < 60 ? tell("soon") : tell("minutes", {minutes: Math.round(wait / 60)});
}

/** Who drives, or why nobody does. */
export function driverInWords({driver, isPaused, isResting, isRobotAway}: Exhibition): string {
  return isRobotAway ? tell("away") : isResting ? tell("resting") : isPaused ? tell("paused") : driver ? tell("drives", {name: driver}) : tell("free");
}

/** What the driver is to try, or the time in which it was done; nothing where there is no challenge. */
export function challengeInWords({hasChallenge, challengeIsGoal, challengeTime: time, driver}: Exhibition): string {
  return !hasChallenge ? "" : time > 0 && driver ? tell("time", {time: challengeTime(time)}) : tell(challengeIsGoal ? "goal" : "challenge");
}

/** A time of the challenge, s. */
export function challengeTime(seconds: number): string {
  return seconds.toFixed(1);
}
