/** What can be done with something that was tapped: buttons above the place for some seconds, where the finger does not cover
 * them. */
import {el} from "../dom";

const kShownMs = 6000;
/** Between it and the side of what it lies in, px. */
const kAir = 12;

export interface Choice {
  name: string;
  label: string;
  act(): void;
}

export class Offer {
  readonly element: HTMLElement;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** @param ended  called when it is taken back, and after a choice. */
  constructor(className: string, label: string, choices: readonly Choice[], private readonly ended: () => void = () => {}) {
    this.element = el("div", {class: `offer ${className}`, role: "group", "aria-label": label, hidden: true},
      ...choices.map((choice) => el("button", {class: "button primary", "data-name": choice.name, onclick: () => {
        choice.act();
        this.clear();
      }}, choice.label)));
  }

  /** @param x,y  px from the top left of what it lies in. @param width  of that, px. */
  show(x: number, y: number, width: number): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.clear(), kShownMs);
    this.element.hidden = false;
    const margin = this.element.offsetWidth / 2 + kAir;
    const left = Math.min(Math.max(x, margin), width - margin);
    this.element.style.transform = `translate(${left}px, ${y}px) translate(-50%, calc(-100% - 30px))`;
  }

  clear(): void {
    clearTimeout(this.timer);
    this.element.hidden = true;
    this.ended();
  }
}
