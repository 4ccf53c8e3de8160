/** The link and its age: three bars and the delay; a touch says it in words. */
import {el, setText} from "../dom";
import type {Messages} from "../messages";
import {isStale} from "../store";
import type {AppState, Store} from "../store";
import {say} from "../text/texts";

/** Above this the age of the state is shown, ms. Chosen: twice what a person perceives as a delay. */
export const kShownAgeMs = 300;

export function linkSign(store: Store, messages: Messages): HTMLButtonElement {
  const text = el("bdi", {dir: "ltr"});
  const explain = (): void => {
    const words = linkInWords(store.get());
    messages.show("info", linkQuality(store.get()) === "poor" ? `${words}. ${say("drive.linkPoor")}` : words);
  };
  const sign = el("button", {class: "link", onclick: explain},
                  el("span", {class: "bars", "aria-hidden": "true"}, el("i"), el("i"), el("i")), text);
  const show = (): void => {
    const state = store.get();
    sign.hidden = state.latencyMs < 0;
    setText(text, state.phase === "connected" ? `${Math.round(linkDelay(state))} ms` : "–");
    sign.dataset["quality"] = linkQuality(state);
    sign.setAttribute("aria-label", linkInWords(state));
  };
  store.watch((state) => `${state.latencyMs} ${ageWhileSilent(state)}`, show);
  return sign;
}

/** Changes each tenth of a second while nothing new comes. */
export function ageWhileSilent({phase, stateAgeMs}: Readonly<AppState>): string {
  return phase !== "connected" || stateAgeMs > kShownAgeMs ? `${phase} ${stateAgeMs}` : "";
}

/** What the link sign shows, ms: the round trip, and while nothing new comes the age of what is shown. */
export function linkDelay({latencyMs, stateAgeMs}: Readonly<AppState>): number {
  return stateAgeMs > kShownAgeMs ? Math.max(latencyMs, stateAgeMs) : latencyMs;
}

/** Good: the delay is not noticeable; fair: noticeable; poor: drive slowly. */
export function linkQuality(state: Readonly<AppState>): "good" | "fair" | "poor" {
  if (isStale(state)) return "poor";
  const worst = Math.max(linkDelay(state), state.imageAgeMs / 2);
  return worst < 60 ? "good" : worst < 200 ? "fair" : "poor";
}

export function linkInWords(state: Readonly<AppState>): string {
  return say("drive.link", {latency: Math.round(linkDelay(state)), image: Math.round(Math.max(0, state.imageAgeMs))});
}
