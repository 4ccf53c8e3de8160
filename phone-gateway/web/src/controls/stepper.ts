/** A value between two buttons, less and more: for values that are changed rarely and exactly. */
import {el, icon, setText} from "../dom";
import {kAddIcon, kLessIcon} from "../screens/icons";
import {say} from "../text/texts";
import {button} from "./press";

export class Stepper {
  readonly element: HTMLElement;
  private readonly output = el("output", {});

  /** @param what  is changed. @param isTime  it becomes shorter and longer. @param step  called with -1 or 1. */
  constructor(what: string, isTime: boolean, step: (direction: number) => void) {
    this.element = el("div", {class: "stepper", role: "group", "aria-label": what},
      button({class: "round", "aria-label": say(isTime ? "motion.shorter" : "motion.less", {what})}, () => step(-1), icon(kLessIcon)),
      this.output,
      button({class: "round", "aria-label": say(isTime ? "motion.longer" : "motion.more", {what})}, () => step(1), icon(kAddIcon)));
  }

  /** @param text  value in words. */
  show(text: string): void {
    setText(this.output, text);
  }
}
