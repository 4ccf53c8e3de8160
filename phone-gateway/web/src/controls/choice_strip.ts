/** A row of buttons for what the robot can do by name; slides sideways when there are many. */
import {el} from "../dom";
import {button} from "./press";

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

  /** @param className  of style sheets. */
  constructor(label: string, className: string, private readonly choose: (name: string) => void) {
    this.element = el("div", {class: `strip ${className}`, role: "group", "aria-label": label});
  }

  setChoices(choices: readonly Choice[]): void {
    this.buttons.clear();
    for (const {name, label, kind} of choices) {
      this.buttons.set(name, button({class: "chip", "data-name": name, "data-kind": kind}, () => this.choose(name), el("span", {}, label)));
    }
    this.element.replaceChildren(...this.buttons.values());
    this.setDrawings(this.drawings);
  }

  /** Puts a drawing over each label. @param drawings  by name. */
  setDrawings(drawings: ReadonlyMap<string, HTMLCanvasElement>): void {
    this.drawings = drawings;
    for (const [name, element] of this.buttons) {
      element.querySelector("canvas")?.remove();
      const drawing = drawings.get(name);
      if (!drawing) continue;
      drawing.setAttribute("aria-hidden", "true");
      element.prepend(drawing);
    }
  }

  /** Marks the one that holds now; none if the name is empty. */
  mark(current: string): void {
    for (const [name, element] of this.buttons) {
      if (name !== current) element.removeAttribute("aria-current");
      else if (!element.hasAttribute("aria-current")) this.markButton(element);
    }
  }

  private markButton(chosen: HTMLButtonElement): void {
    chosen.setAttribute("aria-current", "true");
    // Into sight, without moving anything but this row.
    const {element} = this;
    const strip = element.getBoundingClientRect();
    const box = chosen.getBoundingClientRect();
    if (strip.width > 0) element.scrollBy({left: box.left + box.width / 2 - strip.left - strip.width / 2});
  }
}
