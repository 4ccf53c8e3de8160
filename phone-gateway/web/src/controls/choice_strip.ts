/** A row of buttons for what the robot can do by name; slides sideways when there are many. */
import {el} from "../dom";
import {onPress} from "./press";

export interface Choice {
  name: string;
  label: string;
}

export class ChoiceStrip {
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(label: string, private readonly choose: (name: string) => void) {
    this.element = el("div", {class: "strip", role: "group", "aria-label": label});
  }

  setChoices(choices: readonly Choice[]): void {
    this.buttons.clear();
    for (const {name, label} of choices) {
      const button = el("button", {class: "chip", "data-name": name}, label);
      onPress(button, () => this.choose(name));
      this.buttons.set(name, button);
    }
    this.element.replaceChildren(...this.buttons.values());
  }

  private markButton(button: HTMLButtonElement): void {
    if (button.hasAttribute("aria-current")) return;
    button.setAttribute("aria-current", "true");
    // Into sight, without moving anything but this row.
    const {element} = this;
    const left = button.offsetLeft - (element.clientWidth - button.offsetWidth) / 2;
    if (element.offsetParent) element.scrollTo({left});
  }

  /** Marks the one that holds now; none if the name is empty. */
  mark(current: string): void {
    for (const [name, button] of this.buttons) {
      if (name === current) this.markButton(button);
      else button.removeAttribute("aria-current");
    }
  }
}
