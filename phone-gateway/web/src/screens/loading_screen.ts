/** What is seen while the robot's model is fetched. */
import {el} from "../dom";
import type {Store} from "../store";
import {say} from "../text/texts";

/** @param retry  called when the person wants another attempt. */
export function loadingScreen(store: Store, retry: () => void): HTMLElement {
  const bar = el("progress", {max: 1, "aria-label": say("loading.robot")});
  const text = el("p", {class: "loading-text", role: "status"});
  const again = el("button", {class: "button primary", onclick: retry}, say("loading.again"));
  store.watch((state) => state.loading, ({done, total, error}) => {
    if (total > 0) bar.value = done / total;
    else bar.removeAttribute("value");
    bar.hidden = error !== "";
    again.hidden = error === "";
    text.textContent = error ? `${say("loading.failed")}: ${error}` : say(total > 0 ? "loading.robot" : "loading.app");
  });
  return el("section", {class: "screen loading-screen"}, el("img", {class: "logo", src: "icon.svg", alt: ""}), bar, text, again);
}
