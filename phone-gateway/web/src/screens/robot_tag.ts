/** How a robot of several is called: its name, on its team's color with its number. */
import {el} from "../dom";
import type {RobotList_Robot} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

/** "Red team, number 3"; empty without either. */
export function teamInWords({team, number}: RobotList_Robot): string {
  const first = team === undefined ? "" : say(team === 0 ? "lobby.team0" : "lobby.team1");
  const second = number > 0 ? say("lobby.number", {number}) : "";
  return first && second ? say("lobby.list", {first, second}) : first || second;
}

/** The number on the team's color; what it means is said for those who do not see it. */
export function shirt(robot: RobotList_Robot): HTMLElement {
  const words = teamInWords(robot);
  return el("span", {class: "shirt", "data-team": robot.team, role: "img", "aria-label": words || undefined, "aria-hidden": words ? undefined : "true"},
            robot.number > 0 ? String(robot.number) : "");
}
