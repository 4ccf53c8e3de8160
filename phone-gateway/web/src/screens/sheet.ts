/** A sheet over everything, with a title. It is closed by its button, or by a tap beside it, as people expect. */
import {el, icon} from "../dom";
import {say} from "../text/texts";
import {kCloseIcon} from "./icons";

/** @param className  of style sheets. @param beside  the title. */
export function sheet(className: string, title: string, beside: Node | null, ...content: (Node | null)[]): HTMLDialogElement {
  const close = () => dialog.close();
  const dialog = el("dialog", {class: `menu ${className}`, "aria-label": title,
                               onclick: (event: Event) => event.target === dialog && close()},
    el("header", {}, el("h2", {}, title), beside,
       el("button", {class: "round", "aria-label": say("menu.close"), onclick: close}, icon(kCloseIcon))),
    ...content);
  return dialog;
}
