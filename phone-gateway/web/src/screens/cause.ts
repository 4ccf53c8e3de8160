/** Why something does not work, in one sentence, and the one thing to do about it. */
import type {Commander} from "../commander";
import {button} from "../controls/press";
import {el} from "../dom";
import {Notice_Component} from "../protocol/generated/remote_pb";
import {nameOf} from "../protocol/names";
import type {AppState, Problem, Store} from "../store";
import {say} from "../text/texts";
import type {TextKey} from "../text/texts";
import type {Actions} from "./actions";

export type Remedy = "reload" | "form" | "retry" | "robots" | "hand-over";

export interface Cause {
  text: string;
  /** What the button does; null: there is nothing to do but wait. */
  remedy: Remedy | null;
  /** What it says. */
  button: string;
}

const kRemedies: Record<Problem, readonly [Remedy, TextKey]> = {
  "wrong-version": ["reload", "connection.reload"],
  "wrong-token": ["form", "connection.typeCode"],
  "not-a-robot": ["form", "connection.typeCode"],
  "too-many": ["retry", "connection.now"],
  unreachable: ["retry", "connection.now"],
  "no-bluetooth": ["retry", "connection.now"],
  silent: ["retry", "connection.now"],
  closed: ["retry", "connection.now"],
};

/** The weightiest cause; null: all is well. Pure. */
export function causeOf(state: Readonly<AppState>): Cause | null {
  const {phase, problem, robot, unavailableComponents, robots, control} = state;
  if (phase !== "connected") {
    // Before the first state the connection screen says why.
    if (!problem || !robot) return null;
    const [remedy, key] = kRemedies[problem];
    return {text: say(`problem.${problem}`), remedy, button: say(key)};
  }
  const missing = [Notice_Component.ROBOT, Notice_Component.MOTION].find((component) => unavailableComponents.includes(component));
  if (missing !== undefined) {
    const remedy = robots.length > 1 ? "robots" : null;
    return {text: say(`component.${nameOf(Notice_Component, missing, "robot")}`), remedy, button: remedy ? say("lobby.open") : ""};
  }
  if (control?.isMine && control.nextId !== 0) {
    return {text: say("control.asks", {name: control.nextName}), remedy: "hand-over",
            button: say("control.handOverTo", {name: control.nextName})};
  }
  return null;
}

export function causeBar(store: Store, commander: Commander, act: Actions): HTMLElement {
  const bar = el("div", {class: "cause", role: "status", hidden: true});
  const remedies: Record<Remedy, () => void> = {
    reload: () => location.reload(),
    form: () => store.set({isFormOpen: true}),
    retry: () => act.retry(),
    robots: () => act.changeRobot(),
    "hand-over": () => void commander.handOver(),
  };
  const show = (): void => {
    const cause = causeOf(store.get());
    bar.hidden = cause === null;
    if (!cause) return bar.replaceChildren();
    const {remedy} = cause;
    const help = remedy ? [button({class: "button small primary", "data-remedy": remedy}, remedies[remedy], cause.button)] : [];
    bar.replaceChildren(el("p", {}, cause.text), ...help);
  };
  store.watch((state) => JSON.stringify(causeOf(state)), show);
  return bar;
}
