/** Motions on the robot's host: checks and plays the draft, saves, fetches and deletes motions. */
import type {Commander} from "../commander";
import {ErrorCode} from "../protocol/generated/remote_pb";
import type {Motion, MotionFile, Response} from "../protocol/generated/remote_pb";
import type {MotionFault, Store} from "../store";
import {isText, reasonInWords, say} from "../text/texts";
import {toMotion} from "./motion_draft";
import type {MotionDraft} from "./motion_draft";
import {kTemporaryName} from "./motion_name";

/** Largest file that the gateway takes, in a request that it takes; bytes. */
export const kMaxFileBytes = 262_000;

/** A motion as keyframes, or as the text of a file. */
export type MotionSource = {motion: Motion} | {yaml: string};

/** What came of saving: "fault" is in the store; "refused" was shown as a message. */
export type SaveResult = "saved" | "name-in-use" | "fault" | "refused";

export class MotionHost {
  /** Counts checks, so that the answer to one that was given up is recognised. */
  private attempt = 0;

  /** @param stiffen  makes limp joints stiff; waited for before a motion is played. */
  constructor(private readonly store: Store, private readonly commander: Commander,
              private readonly stiffen: () => Promise<void>) {}

  /** Checks the draft and plays it, or shows its fault. */
  async play(draft: MotionDraft): Promise<void> {
    const attempt = this.attempt + 1;
    const result = await this.save({motion: toMotion(draft, kTemporaryName)}, true);
    // Stop was pressed while it was checked.
    if (result === "saved" && attempt === this.attempt) await this.playSaved(kTemporaryName);
  }

  /** Plays a saved motion. @return true if the robot's host passed it on. */
  async playSaved(name: string): Promise<boolean> {
    const {attempt} = this;
    await this.stiffen();
    return attempt === this.attempt && this.commander.command({case: "doAction", value: {action: name}});
  }

  /** Gives up what is being checked: it will not be played. */
  cancel(): void {
    this.attempt++;
    this.store.set({isCheckingMotion: false});
  }

  /** Checks and saves a motion. @param source  keyframes of the draft, or the text of a file. */
  async save(source: MotionSource, replace: boolean): Promise<SaveResult> {
    const attempt = ++this.attempt;
    this.store.set({isCheckingMotion: true, motionFault: null});
    const response = await this.commander.ask({case: "saveMotion", value: {motion: source, replace}});
    const isCurrent = attempt === this.attempt;
    if (isCurrent) this.store.set({isCheckingMotion: false});
    if (response?.error === ErrorCode.NAME_IN_USE) return "name-in-use";
    const fault = response && faultOf(response, "yaml" in source);
    if (!fault) return this.commander.report(response) ? "saved" : "refused";
    if (isCurrent) this.store.set({motionFault: fault});
    return "fault";
  }

  /** A saved motion as keyframes and as text; null if it could not be had. */
  async get(name: string): Promise<MotionFile | null> {
    const response = await this.commander.fetch({case: "getMotion", value: {name}});
    return this.commander.report(response) && response?.result.case === "motionFile" ? response.result.value : null;
  }

  /** Deletes a saved motion. @return what it was, for an undo; null if it was not deleted. */
  async remove(name: string): Promise<MotionFile | null> {
    const file = await this.get(name);
    return file && (await this.commander.command({case: "deleteMotion", value: {name}})) ? file : null;
  }
}

/** The fault that an answer reports; null if it reports none. */
export function faultOf(response: Response, isUpload: boolean): MotionFault | null {
  if (response.error === ErrorCode.OK || response.result.case !== "motionReport") return null;
  const {keyframe, repaired, repair} = response.result.value;
  const key = `teach.repair.${repair}`;
  return {
    keyframe, isUpload, repaired: repaired ?? null,
    text: reasonInWords(response) || say("result.failed"),
    repairText: isText(key) ? say(key) : say("teach.repair.other"),
  };
}
