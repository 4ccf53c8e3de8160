/** Loads the page again: where a sentence says that this helps. */
import {el} from "../dom";
import {say} from "../text/texts";

export function reloadButton(): HTMLButtonElement {
  return el("button", {class: "button primary", type: "button", onclick: () => location.reload()}, say("connection.reload"));
}
