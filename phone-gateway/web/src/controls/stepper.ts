/** A value between two buttons, less and more: for values that are changed rarely and exactly. */
import {el, icon} from "../dom";
import {onPress} from "./press";

const kMinusIcon = "M6 12h12";
const kPlusIcon = "M12 6v12M6 12h12";

export class Stepper {
  readonly element: HTMLElement;
  private readonly less: HTMLButtonElement;
  private readonly more: HTMLButtonElement;
  private readonly output = el("output", {});

  /** @param label  of the value. @param step  called with -1 or 1. */
  constructor(private readonly label: string, step: (direction: number) => void) {
    this.less = el("button", {class: "round"}, icon(kMinusIcon));
    this.more = el("button", {class: "round"}, icon(kPlusIcon));
    onPress(this.less, () => step(-1));
    onPress(this.more, () => step(1));
    this.element = el("div", {class: "stepper", role: "group", "aria-label": label}, this.less, this.output, this.more);
  }

  /** @param text  value in words. @param less,more  what the buttons do, in words. */
  show(text: string, less: string, more: string, label = this.label): void {
    this.element.setAttribute("aria-label", label);
    this.less.setAttribute("aria-label", less);
    this.more.setAttribute("aria-label", more);
    if (this.output.textContent !== text) this.output.textContent = text;
  }
}
