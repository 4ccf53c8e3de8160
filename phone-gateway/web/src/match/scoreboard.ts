/** Score, clock and phase of the match, while there is one. */
import {el} from "../dom";
import type {Store} from "../store";
import {say} from "../text/texts";
import {penaltyOf, phaseInWords} from "./match_words";

export function scoreboard(store: Store): HTMLElement {
  const blue = el("b", {class: "goals", "data-team": 0});
  const red = el("b", {class: "goals", "data-team": 1});
  const score = el("span", {class: "score", role: "img"}, blue, red);
  const phase = el("span", {class: "match-phase"});
  const board = el("div", {class: "scoreboard", role: "group", "aria-label": say("match.board"), hidden: true}, score, phase);
  store.watch((state) => state.match, (match) => {
    board.hidden = match === null;
    if (!match) return;
    blue.textContent = String(match.score0);
    red.textContent = String(match.score1);
    score.setAttribute("aria-label", say("match.score", {blue: match.score0, red: match.score1}));
    const penalty = penaltyOf(match, store.get().robot?.name ?? "");
    phase.textContent = penalty > 0 ? say("match.own", {seconds: penalty}) : phaseInWords(match);
  });
  return board;
}
