/** A sentence about what was done or what is wrong, with a button for what helps. It is closed by its own button. */
import {button} from "../controls/press";
import {el, icon} from "../dom";
import type {MotionFault} from "../store";
import {say} from "../text/texts";
import {kCloseIcon} from "./icons";

export class Note {
  readonly element = el("div", {class: "note", role: "alert", hidden: true});

  hide(): void {
    this.element.hidden = true;
  }

  /** @param remedy  what the button says; empty: there is none. */
  tell(kind: "good" | "bad", text: string, remedy = "", act: () => void = () => {}): void {
    const pressed = () => {
      this.hide();
      act();
    };
    this.element.className = `note ${kind}`;
    this.element.hidden = false;
    this.element.replaceChildren(el("p", {}, text),
      button({class: "round", type: "button", "aria-label": say("teach.dismiss")}, () => this.hide(), icon(kCloseIcon)),
      ...(remedy ? [button({class: "button small primary", type: "button"}, pressed, remedy)] : []));
    this.element.scrollIntoView?.({block: "nearest"});
  }

  /** Why a motion is not safe, with the pose at which it shows. @param repair  takes the repaired motion. */
  tellFault({keyframe, text, repaired, repairText}: MotionFault, repair: () => void): void {
    this.tell("bad", keyframe < 0 ? text : say("teach.faultAt", {number: keyframe + 1, text}), repaired ? repairText : "", repair);
  }
}
