/** What is seen while the robot's model is fetched. */
import {el} from "../dom";
import type {Store} from "../store";
import {say} from "../text/texts";

export class LoadingScreen {
  readonly element: HTMLElement;
  private readonly bar = el("progress", {max: 1, "aria-label": say("loading.robot")});
  private readonly text = el("p", {class: "loading-text", role: "status"}, say("loading.app"));
  private readonly again: HTMLButtonElement;

  /** @param retry  called when the person wants another attempt. */
  constructor(store: Store, retry: () => void) {
    this.again = el("button", {class: "button primary", hidden: true, onclick: retry},
                    say("loading.again"));
    this.element = el("section", {class: "screen loading-screen"},
                      el("img", {class: "logo", src: "icon.svg", alt: ""}),
                      this.bar, this.text, this.again);
    store.watch((state) => state.loading, ({done, total, error}) => {
      if (total > 0) this.bar.value = done / total;
      else this.bar.removeAttribute("value");
      this.bar.hidden = error !== "";
      this.again.hidden = error === "";
      this.text.textContent = error ? `${say("loading.failed")}: ${error}`
                                    : say(total > 0 ? "loading.robot" : "loading.app");
    });
  }
}
