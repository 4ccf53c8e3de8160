/** A row of buttons for what the robot can do by name; slides sideways when there are many. */
import {el} from "../dom";
import {onPress} from "./press";

export interface Choice {
  name: string;
  label: string;
  /** What style sheets know it by. */
  kind?: string;
}

export class ChoiceStrip {
  readonly element: HTMLElement;
  private readonly buttons = new Map<string, HTMLButtonElement>();
  private drawings: ReadonlyMap<string, HTMLCanvasElement> = new Map();

  constructor(label: string, private readonly choose: (name: string) => void) {
    this.element = el("div", {class: "strip", role: "group", "aria-label": label});
  }

  setChoices(choices: readonly Choice[]): void {
    this.buttons.clear();
    for (const {name, label, kind} of choices) {
      const button = el("button", {class: "chip", "data-name": name, "data-kind": kind}, el("span", {}, label));
      onPress(button, () => this.choose(name));
      this.buttons.set(name, button);
    }
    this.element.replaceChildren(...this.buttons.values());
    this.setDrawings(this.drawings);
  }

  /** Puts a drawing over each label. @param drawings  by name. */
  setDrawings(drawings: ReadonlyMap<string, HTMLCanvasElement>): void {
    this.drawings = drawings;
    for (const [name, button] of this.buttons) {
      button.querySelector("canvas")?.remove();
      const drawing = drawings.get(name);
      if (!drawing) continue;
      drawing.setAttribute("aria-hidden", "true");
      button.prepend(drawing);
    }
  }

  /** Marks the one that holds now; none if the name is empty. */
  mark(current: string): void {
    for (const [name, button] of this.buttons) {
      if (name !== current) button.removeAttribute("aria-current");
      else if (!button.hasAttribute("aria-current")) this.markButton(button);
    }
  }

  private markButton(button: HTMLButtonElement): void {
    button.setAttribute("aria-current", "true");
    // Into sight, without moving anything but this row.
    const {element} = this;
    const strip = element.getBoundingClientRect();
    const box = button.getBoundingClientRect();
    if (strip.width > 0) element.scrollBy({left: box.left + box.width / 2 - strip.left - strip.width / 2});
  }
}
