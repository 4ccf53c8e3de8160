/** A tap on the ball offers what the robot can do with it: go there, or kick it. */
import {el} from "../dom";
import {Play_Behavior} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

const kShownMs = 6000;
/** Half the choice's width and some air, px. */
const kMargin = 110;

export class BallChoice {
  readonly element: HTMLElement;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly choose: (behavior: Play_Behavior) => void) {
    this.element = el("div", {class: "ball-choice", role: "group", "aria-label": say("play.ball"), hidden: true},
      this.button("go-to-ball", Play_Behavior.GO_TO_BALL), this.button("kick", Play_Behavior.KICK));
  }

  /** Above a point of the page, px. */
  offer(x: number, y: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.clear(), kShownMs);
    const left = Math.min(Math.max(x, kMargin), window.innerWidth - kMargin);
    this.element.style.transform = `translate(${left}px, ${y}px) translate(-50%, calc(-100% - 30px))`;
    this.element.hidden = false;
  }

  clear(): void {
    clearTimeout(this.timer);
    this.element.hidden = true;
  }

  private button(name: "go-to-ball" | "kick", behavior: Play_Behavior): HTMLButtonElement {
    return el("button", {class: "button primary", "data-name": name, onclick: () => {
      this.clear();
      this.choose(behavior);
    }}, say(`play.${name}`));
  }
}
