/** How a robot of several is called: its name, on its team's color with its number. */
import {el} from "../dom";
import type {RobotList_Robot} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

/** The number on the team's color; what it means is said for those who do not see it. */
export function shirt({team, number}: RobotList_Robot): HTMLElement {
  const words = [team === undefined ? "" : say(team === 0 ? "lobby.team0" : "lobby.team1"),
                 number > 0 ? say("lobby.number", {number}) : ""].filter((word) => word !== "");
  return el("span", {class: "shirt", "data-team": team, role: "img", "aria-label": words.join(", ") || undefined,
                     "aria-hidden": words.length === 0 ? "true" : undefined},
            number > 0 ? String(number) : "");
}

/** "Red team, number 3"; empty without a team. */
export function teamInWords({team, number}: RobotList_Robot): string {
  if (team === undefined) return "";
  const name = say(team === 0 ? "lobby.team0" : "lobby.team1");
  return number > 0 ? `${name}, ${say("lobby.number", {number})}` : name;
}
