/** A value between two buttons, less and more: for values that are changed rarely and exactly. */
import {el, icon, setText} from "../dom";
import {button} from "./press";

const kMinusIcon = "M6 12h12";
const kPlusIcon = "M12 6v12M6 12h12";

export class Stepper {
  readonly element: HTMLElement;
  private readonly less: HTMLButtonElement;
  private readonly more: HTMLButtonElement;
  private readonly output = el("output", {});

  /** @param label  of the value. @param step  called with -1 or 1. */
  constructor(private readonly label: string, step: (direction: number) => void) {
    this.less = button({class: "round"}, () => step(-1), icon(kMinusIcon));
    this.more = button({class: "round"}, () => step(1), icon(kPlusIcon));
    this.element = el("div", {class: "stepper", role: "group", "aria-label": label}, this.less, this.output, this.more);
  }

  /** @param text  value in words. @param less,more  what the buttons do, in words. */
  show(text: string, less: string, more: string, label = this.label): void {
    this.element.setAttribute("aria-label", label);
    this.less.setAttribute("aria-label", less);
    this.more.setAttribute("aria-label", more);
    setText(this.output, text);
  }
}
