/** What the robot does by itself, in the page's language; pure. */
import {Play_Behavior, PlayState_Phase} from "../protocol/generated/remote_pb";
import type {PlayState} from "../protocol/generated/remote_pb";
import {reasonInWords, say} from "../text/texts";

/** The last parts of the text keys "play.NAME". */
export const kBehaviorNames = {
  [Play_Behavior.NONE]: "none",
  [Play_Behavior.GO_TO_BALL]: "go-to-ball",
  [Play_Behavior.KICK]: "kick",
  [Play_Behavior.DRIBBLE]: "dribble",
  [Play_Behavior.SCORE]: "score",
  [Play_Behavior.KEEP_GOAL]: "keep-goal",
} as const satisfies Record<Play_Behavior, string>;

export type BehaviorName = (typeof kBehaviorNames)[Play_Behavior];

/** The last parts of the text keys "phase.NAME". */
const kPhaseNames = {
  [PlayState_Phase.IDLE]: "idle",
  [PlayState_Phase.SEARCH]: "search",
  [PlayState_Phase.APPROACH]: "approach",
  [PlayState_Phase.ALIGN]: "align",
  [PlayState_Phase.KICK]: "kick",
  [PlayState_Phase.GUARD]: "guard",
  [PlayState_Phase.BLOCK]: "block",
  [PlayState_Phase.RECOVER]: "recover",
  [PlayState_Phase.DONE]: "done",
} as const satisfies Record<PlayState_Phase, string>;

export function findBehavior(name: string): Play_Behavior | undefined {
  const found = Object.entries(kBehaviorNames).find(([, known]) => known === name);
  return found && Number(found[0]) as Play_Behavior;
}

/** Whether the robot acts by itself, by a behaviour or in a match. */
export function isByItself(state: PlayState | null): boolean {
  return state !== null && (state.playsMatch || state.behavior !== Play_Behavior.NONE);
}

/** "Score: walks to the ball", with the reason why it waits; empty if the robot does nothing by itself. */
export function playInWords(state: PlayState | null): string {
  if (!state || !isByItself(state)) return "";
  const name = state.playsMatch ? "auto" : kBehaviorNames[state.behavior] ?? "none";
  // In a match not only a keeper stands where it should be.
  const isInPlace = state.playsMatch && state.phase === PlayState_Phase.GUARD;
  const phase = isInPlace ? "place" : kPhaseNames[state.phase] ?? "idle";
  const words = `${say(`play.${name}`)}: ${say(`phase.${phase}`)}`;
  // A search says in its phase what its reason says.
  if (!state.reasonCode || state.reasonCode === "ball-not-in-sight") return words;
  const {reason: message, reasonCode} = state;
  return `${words}. ${reasonInWords({message, reasonCode, reasonArguments: []})}`;
}
