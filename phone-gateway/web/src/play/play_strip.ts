/** Buttons for what the robot can do by itself. They are there where its host runs nao-play. */
import type {Commander} from "../commander";
import {ChoiceStrip} from "../controls/choice_strip";
import {Notice_Kind, Notice_Status, Play_Behavior} from "../protocol/generated/remote_pb";
import type {Notice} from "../protocol/generated/remote_pb";
import type {Messages} from "../messages";
import type {Store} from "../store";
import {say} from "../text/texts";
import {behaviorName} from "./play_words";

const kOffered = [Play_Behavior.SCORE, Play_Behavior.KEEP_GOAL, Play_Behavior.GO_TO_BALL, Play_Behavior.KICK, Play_Behavior.DRIBBLE];

export class PlayStrip {
  private readonly strip = new ChoiceStrip(say("play.strip"), "play-strip", (name) => this.chosen(name));
  readonly element = this.strip.element;
  /** The behaviour that this page has begun last: its end is reported. */
  private begun: Play_Behavior = Play_Behavior.NONE;

  constructor(private readonly store: Store, private readonly commander: Commander,
              private readonly messages: Messages) {
    this.strip.setChoices(kOffered.map(behaviorName).map((name) => ({name, label: say(`play.${name}`)})));
    store.watch((state) => state.playState !== null, (isThere) => this.element.hidden = !isThere);
    store.watch((state) => state.playState?.behavior ?? Play_Behavior.NONE,
                (behavior) => this.strip.mark(behaviorName(behavior)));
    store.watch((state) => state.lastResult, (notice) => notice && this.ended(notice));
  }

  /** @param target  where the ball shall go, m, in the odometry frame; none: the opponent's goal. */
  begin(behavior: Play_Behavior, target?: {x: number; y: number}): void {
    this.begun = behavior;
    void this.commander.command({case: "play", value: {behavior, targetX: target?.x, targetY: target?.y}});
  }

  /** The page is hidden or left: nothing moves without its driver. */
  letGo(): void {
    const {control, playState} = this.store.get();
    const isRunning = (playState?.behavior ?? Play_Behavior.NONE) !== Play_Behavior.NONE;
    if (isRunning && control?.isMine) this.begin(Play_Behavior.NONE);
  }

  /** A second tap on what runs ends it. */
  private chosen(name: string): void {
    const behavior = kOffered.find((one) => behaviorName(one) === name)!;
    const isRunning = this.store.get().playState?.behavior === behavior;
    this.begin(isRunning ? Play_Behavior.NONE : behavior);
  }

  private ended(notice: Notice): void {
    const isDone = notice.kind === Notice_Kind.COMMAND_RESULT && notice.status === Notice_Status.DONE;
    const name = behaviorName(this.begun);
    if (!isDone || this.begun === Play_Behavior.NONE || notice.reasonArguments[0] !== name) return;
    this.begun = Play_Behavior.NONE;
    this.messages.show("good", say("play.done", {what: say(`play.${name}`)}));
  }
}
