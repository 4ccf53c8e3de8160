/** Commands to the robot: takes the wheel first where nobody has it, and tells what came of it. */
import type {Messages} from "./messages";
import type {UseCase} from "./protocol/codec";
import {ErrorCode, Notice_Kind, Notice_Outcome} from "./protocol/generated/remote_pb";
import type {Notice, Response} from "./protocol/generated/remote_pb";
import * as useCases from "./protocol/use_cases";
import type {Store} from "./store";
import {isText, say} from "./text/texts";

/** The part of Connection that commands need. */
export interface Requester {
  request(useCase: UseCase): Promise<Response | null>;
  isCongested(): boolean;
}

export class Commander {
  /** Called when the robot refuses something: the controller makes it felt. */
  onRefusal: () => void = () => {};
  private taking: Promise<boolean> | null = null;

  constructor(private readonly requester: Requester, private readonly store: Store,
              private readonly messages: Messages) {}

  /** Sends one command. @return true if the gateway passed it on. */
  async command(useCase: UseCase): Promise<boolean> {
    if (!(await this.haveControl())) return false;
    return this.report(await this.requester.request(useCase));
  }

  /** Sends a command that is repeated anyway: left out while the link is behind. The end of a walk is
   * not: it comes once. */
  stream(useCase: UseCase): void {
    if (isWalkEnd(useCase) || !this.requester.isCongested()) void this.command(useCase);
  }

  /** Anybody may stop the robot, driver or not. */
  async stop(): Promise<boolean> {
    return this.report(await this.requester.request(useCases.stop()));
  }

  /** Asks for the wheel, also from somebody who holds it. */
  async takeControl(): Promise<boolean> {
    const response = await this.requester.request(useCases.takeControl());
    return this.report(response);
  }

  async releaseControl(): Promise<boolean> {
    return this.report(await this.requester.request(useCases.releaseControl()));
  }

  /** What the gateway tells unasked. */
  notice(notice: Notice): void {
    switch (notice.kind) {
      case Notice_Kind.COMMAND_OUTCOME: this.outcome(notice); break;
      case Notice_Kind.CONTROL_CHANGED: this.controlChanged(notice); break;
      case Notice_Kind.PART_CHANGED: this.partChanged(notice); break;
      case Notice_Kind.CLOSING: this.messages.tell("bad", notice.message); break;
    }
  }

  private haveControl(): Promise<boolean> {
    const control = this.store.get().control;
    if (control?.isMine) return Promise.resolve(true);
    if (control && control.driverId !== 0) {
      this.messages.tell("info", say("control.other", {name: control.driverName}));
      return Promise.resolve(false);
    }
    // Two thumbs at once ask once.
    this.taking ??= this.takeControl().finally(() => this.taking = null);
    return this.taking;
  }

  private report(response: Response | null): boolean {
    if (!response) return false;
    if (response.result.case === "control") this.store.set({control: response.result.value});
    if (response.error === ErrorCode.OK) return true;
    if (response.error === ErrorCode.NO_CONTROL) this.forgetControl();
    this.refused(this.inWords(response));
    return false;
  }

  /** What a code says, in the page's language; else the gateway's own words. */
  private inWords({error, message, result}: Response): string {
    switch (error) {
      case ErrorCode.STOPPED: return say("refusal.stopped");
      case ErrorCode.CONTROL_TAKEN:
        return result.case === "control" ? say("control.other", {name: result.value.driverName}) : message;
      case ErrorCode.ROBOT_UNAVAILABLE: {
        const {missingParts} = this.store.get();
        return missingParts.includes("motion") ? say("part.motion")
            : missingParts.includes("robot") ? say("part.robot") : message;
      }
      default: return message;
    }
  }

  /** The gateway says that we do not drive although we thought so: ask again with the next command. */
  private forgetControl(): void {
    const control = this.store.get().control;
    if (control?.isMine) this.store.set({control: {...control, isMine: false, driverId: 0}});
  }

  private outcome(notice: Notice): void {
    this.store.set({lastOutcome: notice});
    const isBad = notice.outcome === Notice_Outcome.REFUSED ||
        notice.outcome === Notice_Outcome.FAILED;
    if (isBad) this.refused(notice.message);
  }

  private refused(message: string): void {
    if (this.messages.tell("bad", message || say("outcome.failed"))) this.onRefusal();
  }

  private controlChanged(notice: Notice): void {
    const before = this.store.get().control;
    const control = notice.control ?? null;
    this.store.set({control});
    if (control?.isMine && !before?.isMine) this.messages.tell("good", say("control.taken"));
    if (before?.isMine && control && !control.isMine && control.driverId !== 0) {
      this.messages.tell("info", say("control.lost", {name: control.driverName}));
    }
  }

  private partChanged(notice: Notice): void {
    const others = this.store.get().missingParts.filter((part) => part !== notice.part);
    this.store.set({missingParts: notice.available ? others : [...others, notice.part]});
    const key = `part.${notice.part}${notice.available ? ".back" : ""}`;
    this.messages.tell(notice.available ? "good" : "bad", isText(key) ? say(key) : notice.message);
  }
}

function isWalkEnd(useCase: UseCase): boolean {
  if (useCase.case !== "walkTurn") return false;
  const {x, y, theta} = useCase.value;
  return x === 0 && y === 0 && theta === 0;
}
