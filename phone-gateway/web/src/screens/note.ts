/** A sentence about what was done or what is wrong, with a button for what helps. */
import {button} from "../controls/press";
import {el} from "../dom";

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
    this.element.replaceChildren(el("p", {}, text), ...(remedy ? [button({class: "button small", type: "button"}, pressed, remedy)] : []));
    this.element.scrollIntoView?.({block: "nearest"});
  }
}
