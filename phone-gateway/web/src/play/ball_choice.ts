/** A tap on the ball offers what the robot can do with it: go there, or kick it. */
import {Offer} from "../controls/offer";
import {el} from "../dom";
import {Play_Behavior} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";
import {behaviorName} from "./play_words";

export class BallChoice {
  readonly element = el("div", {class: "ball-choice", role: "group", "aria-label": say("play.ball"), hidden: true},
    this.button(Play_Behavior.GO_TO_BALL), this.button(Play_Behavior.KICK));
  private readonly choice = new Offer(this.element);

  constructor(private readonly choose: (behavior: Play_Behavior) => void) {}

  /** Above a point of the page, px. */
  offer(x: number, y: number): void {
    this.choice.show(x, y, window.innerWidth);
  }

  clear(): void {
    this.choice.clear();
  }

  private button(behavior: Play_Behavior): HTMLButtonElement {
    const name = behaviorName(behavior);
    return el("button", {class: "button primary", "data-name": name, onclick: () => {
      this.clear();
      this.choose(behavior);
    }}, say(`play.${name}`));
  }
}
