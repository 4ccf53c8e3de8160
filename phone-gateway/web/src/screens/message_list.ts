/** The messages to the user, over the controller and the list of robots. */
import {el} from "../dom";
import type {Store} from "../store";

export function messageList(store: Store): HTMLElement {
  const list = el("div", {class: "messages", role: "status", "aria-live": "polite"});
  store.watch((state) => state.messages, (messages) => list.replaceChildren(
      ...messages.map(({kind, text}) => el("p", {class: `message ${kind}`}, text))));
  return list;
}
