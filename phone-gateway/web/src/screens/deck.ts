/** What the robot can do by one touch: what fits the moment; the rest one touch further. */
import type {Commander} from "../commander";
import {ChoiceStrip} from "../controls/choice_strip";
import {el} from "../dom";
import {ballOf} from "../play/seen";
import type {PlayStrip} from "../play/play_strip";
import {isByItself} from "../play/play_words";
import {Mode} from "../protocol/generated/remote_pb";
import type {AppState, Store} from "../store";
import {say, sayName} from "../text/texts";

/** Relaxed and lying: it can get up. Ball: it can play. */
export type Moment = "relaxed" | "lying" | "ball" | "standing";

/** Pure. */
export function momentOf({state, postures, playState, vision}: Readonly<AppState>): Moment {
  if (state?.mode === Mode.RELAXED) return "relaxed";
  const family = postures.get(state?.posture ?? "")?.family ?? "";
  if (state?.mode === Mode.FALLEN || family.startsWith("lying")) return "lying";
  return playState && (isByItself(playState) || ballOf(vision)) ? "ball" : "standing";
}

export class Deck {
  readonly element: HTMLElement;
  private readonly postures: ChoiceStrip;
  private readonly actions: ChoiceStrip;

  /** @param map  of the field, shown with the rest. */
  constructor(private readonly store: Store, commander: Commander, play: PlayStrip, map: Element) {
    this.postures = new ChoiceStrip(say("drive.postures"), "postures", (name) =>
        void commander.command({case: "goToPosture", value: {posture: name}}));
    this.actions = new ChoiceStrip(say("drive.actions"), "actions", (name) =>
        void commander.command({case: "doAction", value: {action: name}}));
    this.element = el("div", {class: "strips"}, play.element, this.postures.element, this.actions.element, map);
    store.watch((state) => state.robot, (robot) => {
      this.postures.setChoices((robot?.postures ?? []).map((name) => ({name, label: sayName("posture", name)})));
      this.showActions();
    });
    store.watch((state) => state.drawings, (drawings) => this.postures.setDrawings(drawings));
    store.watch((state) => state.savedMotions, () => this.showActions());
    store.watch((state) => state.state?.posture ?? "", (posture) => this.postures.mark(posture));
    store.watch(momentOf, (moment) => {
      this.element.dataset["moment"] = moment;
      this.element.scrollTop = 0;
    });
  }

  /** The robot's own actions, and the motions that people have saved. */
  private showActions(): void {
    const {robot, savedMotions} = this.store.get();
    const own = (robot?.actions ?? []).filter((name) => !robot?.savedMotions.includes(name));
    this.actions.setChoices([...own, ...savedMotions].map((name) => ({
      name, label: sayName("action", name), kind: robot?.actionRoles.find((role) => role.name === name)?.kind ?? "gesture"})));
  }
}
