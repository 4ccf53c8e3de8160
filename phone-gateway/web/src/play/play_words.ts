/** What the robot does by itself, in the page's language; pure. */
import {Play_Behavior, PlayState_Phase} from "../protocol/generated/remote_pb";
import type {PlayState} from "../protocol/generated/remote_pb";
import {nameOf} from "../protocol/names";
import {reasonInWords, say} from "../text/texts";

/** "keep-goal". */
export const behaviorName = (behavior: Play_Behavior) => nameOf(Play_Behavior, behavior, "none");

/** Whether the robot acts by itself, by a behaviour or in a match. */
export function isByItself(state: PlayState | null): boolean {
  return state !== null && (state.playsMatch || state.behavior !== Play_Behavior.NONE);
}

/** "Score: walks to the ball", with the reason why it waits; empty if the robot does nothing by itself. */
export function playInWords(state: PlayState | null): string {
  if (!state || !isByItself(state)) return "";
  const name = state.playsMatch ? "auto" : behaviorName(state.behavior);
  // In a match not only a keeper stands where it should be.
  const isInPlace = state.playsMatch && state.phase === PlayState_Phase.GUARD;
  const phase = isInPlace ? "place" : nameOf(PlayState_Phase, state.phase, "idle");
  const words = `${say(`play.${name}`)}: ${say(`phase.${phase}`)}`;
  // A search says in its phase what its reason says.
  if (!state.reasonCode || state.reasonCode === "ball-not-in-sight") return words;
  const {reason: message, reasonCode} = state;
  return `${words}. ${reasonInWords({message, reasonCode, reasonArguments: []})}`;
}
