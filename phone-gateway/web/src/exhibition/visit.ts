/** The phone of an exhibition's visitor: waits in the queue, drives with a countdown, is thanked. Fetched only where there is
 * an exhibition. */
import {create} from "@bufbuild/protobuf";
import type {Commander} from "../commander";
import {el, setText} from "../dom";
import {AttendSchema, ErrorCode, Exhibition_Phase as Phase} from "../protocol/generated/remote_pb";
import type {Exhibition} from "../protocol/generated/remote_pb";
import {randomKey} from "../random_key";
import {keep, recall} from "../storage";
import type {Store} from "../store";
import {getLanguage} from "../text/texts";
import {vibrate} from "../vibrate";
import {setWords, tell} from "./exhibition_texts";
import {challengeInWords, challengeTime, driverInWords, waitInWords} from "./words";
import {clockInWords} from "../text/clock";
import css from "./visit.css?inline";

const kKey = "nao-remote-visitor";
/** Felt at the turn's begin, and when it is warned; ms on, off, on. */
const kBeginPattern = [200, 100, 200];
const kWarnPattern = [100, 60, 100];

/** Random text by which the gateway knows this phone again; in a browser without memory it is new at each visit. */
function visitorKey(memory: Storage | null): string {
  const known = recall<string>(memory, kKey);
  if (typeof known === "string") return known;
  const key = randomKey();
  keep(memory, kKey, key);
  return key;
}

export class Visit {
  private readonly key: string;
  private readonly title = el("h1");
  private readonly big = el("p", {class: "visit-big"});
  private readonly detail = el("p", {class: "visit-detail"});
  private readonly note = el("p", {class: "quiet"});
  private readonly act = el("button", {class: "button wide", onclick: () => this.pressed()});
  private readonly sheet = el("section", {class: "visit", role: "status", hidden: true},
      el("div", {class: "visit-card"}, this.title, this.big, this.detail, this.note, this.act));
  private readonly time = el("strong");
  private readonly challenge = el("span");
  private readonly chip = el("div", {class: "visit-turn", role: "timer", hidden: true}, this.time, this.challenge,
      el("button", {class: "button small", onclick: () => void this.attend({leaves: true})}, tell("end")));
  private phase = Phase.NONE;
  private wasWarned = false;
  private isFull = false;
  /** The gateway knows whose phone this is. */
  private isKnown = false;

  /** @param notes  where messages to the driver are. @param letGo  releases what is held. */
  static async begin(...parts: ConstructorParameters<typeof Visit>): Promise<void> {
    await setWords(getLanguage());
    new Visit(...parts);
  }

  constructor(private readonly store: Store, private readonly commander: Commander, private readonly root: HTMLElement, notes: HTMLElement,
              memory: Storage | null, private readonly letGo: () => void) {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(css);
    document.adoptedStyleSheets.push(sheet);
    this.key = visitorKey(memory);
    root.append(this.sheet);
    notes.prepend(this.chip);
    // After each connection: the gateway knows by it whose phone this is.
    store.watch((state) => state.phase, (phase) => {
      this.isKnown = false;
      if (phase === "connected") void this.attend({});
    });
    store.watch((state) => state.exhibition, (exhibition) => {
      if (exhibition && this.isKnown) this.show(exhibition);
    });
  }

  private async attend(options: {leaves?: boolean; again?: boolean}): Promise<void> {
    if (options.leaves) this.letGo();
    const value = create(AttendSchema, {visitorKey: this.key, ...options});
    const response = await this.commander.fetch({case: "attend", value});
    if (response?.result.case !== "exhibition") return;
    this.isFull = response.error === ErrorCode.TOO_MANY_CLIENTS;
    this.isKnown = true;
    this.store.set({exhibition: response.result.value});
  }

  private pressed(): void {
    if (this.phase === Phase.WAITING) void this.attend({leaves: true});
    else void this.attend({again: true});
  }

  private show(exhibition: Exhibition): void {
    const {phase, isPaused, isResting} = exhibition;
    const isDriving = phase === Phase.DRIVING;
    const mayDrive = isDriving && !isPaused && !isResting;
    if (isDriving && this.phase !== Phase.DRIVING) vibrate(kBeginPattern);
    if (exhibition.isWarned && isDriving && !this.wasWarned) vibrate(kWarnPattern);
    if (this.phase === Phase.DRIVING && !isDriving) this.letGo();
    this.phase = phase;
    this.wasWarned = exhibition.isWarned;
    this.sheet.hidden = mayDrive;
    this.root.dataset["visit"] = mayDrive ? "driving" : "waiting";
    this.chip.hidden = !mayDrive;
    this.chip.classList.toggle("warned", exhibition.isWarned);
    setText(this.time, tell("warned", {time: clockInWords(exhibition.turnLeft)}));
    setText(this.challenge, challengeInWords(exhibition));
    this.showCard(exhibition);
  }

  private showCard(exhibition: Exhibition): void {
    const {phase, nickname, place, driver, bestTime, bestNickname} = exhibition;
    const isWaiting = phase === Phase.WAITING;
    const isServed = phase === Phase.SERVED;
    const isHalted = exhibition.isPaused || exhibition.isResting || exhibition.isRobotAway;
    setText(this.title, this.isFull ? tell("full") : isServed ? tell("thanks") : nickname ? tell("you", {name: nickname}) : tell("left"));
    setText(this.big, !isWaiting ? "" : place === 1 ? tell("next") : tell("place", {place}));
    setText(this.detail, isHalted ? driverInWords(exhibition) : isWaiting ? waitInWords(exhibition) : "");
    const best = bestTime > 0 ? tell("best", {time: challengeTime(bestTime), name: bestNickname}) : "";
    setText(this.note, isWaiting ? `${driver && !isHalted ? `${driverInWords(exhibition)}. ` : ""}${tell("keep")}` : best);
    setText(this.act, isWaiting ? tell("leave") : isServed ? tell("again") : tell("join"));
    this.act.classList.toggle("primary", !isWaiting);
    this.act.hidden = phase === Phase.DRIVING;
  }
}
