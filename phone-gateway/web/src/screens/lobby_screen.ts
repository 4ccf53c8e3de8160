/** The robots of a gateway of several: who drives which, to drive or to watch one. */
import {el} from "../dom";
import type {Lobby} from "../lobby";
import {scoreboard} from "../match/scoreboard";
import type {RobotList_Robot} from "../protocol/generated/remote_pb";
import type {Store} from "../store";
import {say} from "../text/texts";
import type {Actions} from "./actions";
import {shirt, teamInWords} from "./robot_tag";

/** Who drives a robot, as one word for style sheets and in words for people. */
export function driverOf({isAvailable, driverId, driverName}: RobotList_Robot, clientId: number):
    {who: "absent" | "free" | "mine" | "other"; text: string} {
  if (driverId !== 0 && driverId === clientId) return {who: "mine", text: say("control.mine")};
  if (driverId !== 0) return {who: "other", text: say("control.other", {name: driverName})};
  return isAvailable ? {who: "free", text: say("lobby.free")} : {who: "absent", text: say("lobby.absent")};
}

/** One robot of the list. Its elements stay while what they say changes: a finger may be on a button. */
class RobotCard {
  readonly element: HTMLElement;
  private readonly shirt = el("span", {class: "shirt-place"});
  private readonly kind = el("span", {class: "quiet"});
  private readonly driver = el("span", {class: "robot-driver"});
  private readonly drive: HTMLButtonElement;

  constructor(readonly name: string, lobby: Lobby) {
    this.drive = el("button", {class: "button small primary robot-drive", "aria-label": say("lobby.driveNamed", {name}),
                               onclick: () => void lobby.choose(name, true)}, say("lobby.drive"));
    this.element = el("li", {class: "robot-card", "data-robot": name}, this.shirt,
      el("div", {class: "robot-words"}, el("strong", {class: "robot-name"}, name), this.kind, this.driver),
      el("div", {class: "robot-buttons"}, this.drive,
         el("button", {class: "button small robot-watch", "aria-label": say("lobby.watchNamed", {name}),
                       onclick: () => void lobby.choose(name, false)}, say("lobby.watch"))));
  }

  update(robot: RobotList_Robot, clientId: number, isMuted: boolean): void {
    const {who, text} = driverOf(robot, clientId);
    const team = teamInWords(robot);
    this.element.dataset["driver"] = who;
    if (robot.team === undefined) delete this.element.dataset["team"];
    else this.element.dataset["team"] = String(robot.team);
    this.shirt.replaceChildren(shirt(robot));
    this.kind.textContent = team ? `${robot.model} · ${team}` : robot.model;
    this.driver.textContent = text;
    this.drive.disabled = isMuted || (who !== "free" && who !== "mine");
  }
}

export class LobbyScreen {
  readonly element: HTMLElement;
  private readonly list = el("ul", {class: "robot-cards"});
  private cards: RobotCard[] = [];

  constructor(private readonly store: Store, private readonly lobby: Lobby, act: Actions) {
    this.element = el("section", {class: "screen lobby-screen"},
      el("div", {class: "lobby"}, scoreboard(store),
         el("header", {}, el("h1", {}, say("lobby.title")), el("p", {class: "quiet"}, say("lobby.subtitle"))),
         this.list,
         el("button", {class: "button", onclick: () => act.leave()}, say("drive.leave"))));
    store.watch((state) => state.robots, () => this.show());
    store.watch((state) => state.control?.isMuted ?? false, () => this.show());
  }

  private show(): void {
    const {robots, clientId, control} = this.store.get();
    const isSame = robots.length === this.cards.length && robots.every(({name}, i) => name === this.cards[i]?.name);
    if (!isSame) {
      this.cards = robots.map(({name}) => new RobotCard(name, this.lobby));
      this.list.replaceChildren(...this.cards.map(({element}) => element));
    }
    robots.forEach((robot, i) => this.cards[i]?.update(robot, clientId, control?.isMuted ?? false));
  }
}
