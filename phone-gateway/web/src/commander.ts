/** Commands to the robot: takes control first if no client has it, and shows the results. */
import type {Connection} from "./connection";
import type {Messages} from "./messages";
import type {UseCase} from "./protocol/codec";
import {ErrorCode, Notice_Component, Notice_Kind, Notice_Status} from "./protocol/generated/remote_pb";
import type {Notice, Response} from "./protocol/generated/remote_pb";
import {nameOf} from "./protocol/names";
import type {Store} from "./store";
import {reasonInWords, say} from "./text/texts";

/** Motions that end a walk; joints turn beside it. */
const kEndsWalk: readonly UseCase["case"][] = ["goToPosture", "doAction", "moveTo", "play"];

export class Commander {
  /** Called when a command is refused: the controller vibrates. */
  onRefusal: () => void = () => {};
  /** Called when a motion is commanded that ends a walk: what is held must not begin another one. */
  onMotion: () => void = () => {};
  private taking: Promise<boolean> | null = null;

  constructor(private readonly requester: Pick<Connection, "request" | "isCongested">, private readonly store: Store,
              private readonly messages: Messages) {}

  /** Sends one command. @return true if the gateway passed it on. */
  async command(useCase: UseCase): Promise<boolean> {
    if (kEndsWalk.includes(useCase.case)) this.onMotion();
    if (!(await this.haveControl())) return false;
    return this.report(await this.requester.request(useCase));
  }

  /** Sends a request that needs control and returns its answer, refusals among them; null if it was not sent or the
   * link broke. */
  async ask(useCase: UseCase): Promise<Response | null> {
    return (await this.haveControl()) ? this.requester.request(useCase) : null;
  }

  /** Sends a request that every client may send, whether it drives or not. */
  fetch(useCase: UseCase): Promise<Response | null> {
    return this.requester.request(useCase);
  }

  /** Sends a command of a repeated stream; skipped while the link is congested. The end of a walk is
   * never skipped, since it is sent once. */
  stream(useCase: UseCase): void {
    if (isWalkEnd(useCase) || !this.requester.isCongested()) void this.command(useCase);
  }

  /** Every client may stop the robot, whether it drives or not. */
  async stop(): Promise<boolean> {
    return this.report(await this.requester.request({case: "stop", value: {}}));
  }

  /** Requests control, also while another client has it.
   * @param robot  name of another robot than the one that is watched. */
  async takeControl(robot = ""): Promise<boolean> {
    const response = await this.requester.request({case: "takeControl", value: {robot}});
    // The controls do not show who drives a robot that is not watched.
    if (response && response.error !== ErrorCode.OK && robot && robot !== this.store.get().robot?.name) {
      this.refused(this.inWords(response));
      return false;
    }
    return this.report(response);
  }

  /** Watches another robot. */
  async watchRobot(robot: string): Promise<boolean> {
    return this.report(await this.requester.request({case: "watchRobot", value: {robot}}));
  }

  /** Takes control, or tells the driver that this client waits for it. */
  async askForControl(): Promise<boolean> {
    const response = await this.requester.request({case: "takeControl", value: {wait: true}});
    const control = response?.result.case === "control" ? response.result.value : null;
    if (control?.nextId !== this.store.get().clientId) return this.report(response);
    this.store.set({control});
    this.messages.show("info", say("control.asked", {name: control.driverName}));
    return false;
  }

  async releaseControl(): Promise<boolean> {
    return this.report(await this.requester.request({case: "releaseControl", value: {}}));
  }

  /** Control goes to the client that waits for it. */
  async handOver(): Promise<boolean> {
    this.onMotion();
    return this.report(await this.requester.request({case: "releaseControl", value: {successorId: this.store.get().control?.nextId}}));
  }

  /** Handles an event that does not answer a request. */
  notice(notice: Notice): void {
    switch (notice.kind) {
      case Notice_Kind.COMMAND_RESULT: this.commandResult(notice); break;
      case Notice_Kind.CONTROL_CHANGED: this.controlChanged(notice); break;
      case Notice_Kind.COMPONENT_CHANGED: this.componentChanged(notice); break;
      case Notice_Kind.MOTIONS_CHANGED: this.store.set({savedMotions: notice.motions?.names ?? []}); break;
      case Notice_Kind.WALK_ENDED:
      case Notice_Kind.CLOSING: this.messages.show("bad", reasonInWords(notice)); break;
    }
  }

  private haveControl(): Promise<boolean> {
    const control = this.store.get().control;
    if (control?.isMine) return Promise.resolve(true);
    if (control?.isMuted || control?.driverId) {
      this.messages.show("info", control.isMuted ? say("control.muted") : say("control.other", {name: control.driverName}));
      return Promise.resolve(false);
    }
    // Two controls touched at once send one request.
    this.taking ??= this.takeControl().finally(() => this.taking = null);
    return this.taking;
  }

  /** Shows why a request was refused. @return true if it was not. */
  report(response: Response | null): boolean {
    if (!response) return false;
    if (response.result.case === "control") this.store.set({control: response.result.value});
    if (response.error === ErrorCode.OK) return true;
    if (response.error === ErrorCode.NO_CONTROL) this.forgetControl();
    this.refused(this.inWords(response));
    return false;
  }

  /** What a code says, in the page's language; else the gateway's own words. */
  private inWords(response: Response): string {
    const {error, result} = response;
    switch (error) {
      case ErrorCode.STOPPED: return say("refusal.stopped");
      case ErrorCode.CONTROL_TAKEN:
        return result.case === "control" ? say("control.other", {name: result.value.driverName})
            : reasonInWords(response);
      case ErrorCode.ROBOT_UNAVAILABLE: {
        const {unavailableComponents} = this.store.get();
        return unavailableComponents.includes(Notice_Component.MOTION) ? say("component.motion")
            : unavailableComponents.includes(Notice_Component.ROBOT) ? say("component.robot")
            : reasonInWords(response);
      }
      default: return reasonInWords(response);
    }
  }

  /** The gateway reports that this client has lost control: the next command requests it again. */
  private forgetControl(): void {
    const control = this.store.get().control;
    if (control?.isMine) this.store.set({control: {...control, isMine: false, driverId: 0}});
  }

  private commandResult(notice: Notice): void {
    this.store.set({lastResult: notice});
    const isBad = notice.status === Notice_Status.REFUSED || notice.status === Notice_Status.FAILED;
    if (isBad) this.refused(reasonInWords(notice));
  }

  private refused(message: string): void {
    if (this.messages.show("bad", message || say("result.failed"))) this.onRefusal();
  }

  private controlChanged(notice: Notice): void {
    const before = this.store.get().control;
    const control = notice.control ?? null;
    this.store.set({control});
    if (control && control.isMuted !== (before?.isMuted ?? false)) {
      this.messages.show("info", reasonInWords(notice));
      return;
    }
    if (control?.isMine && !before?.isMine) this.messages.show("good", say("control.taken"));
    if (before?.isMine && control && !control.isMine && control.driverId !== 0) {
      this.messages.show("info", say("control.lost", {name: control.driverName}));
    }
  }

  private componentChanged({component, isAvailable}: Notice): void {
    const others = this.store.get().unavailableComponents.filter((other) => other !== component);
    this.store.set({unavailableComponents: isAvailable ? others : [...others, component]});
    const name = nameOf(Notice_Component, component, "robot");
    this.messages.show(isAvailable ? "good" : "bad",
                       say(isAvailable ? `component.${name}.back` : `component.${name}`));
  }
}

function isWalkEnd(useCase: UseCase): boolean {
  if (useCase.case !== "walkTurn") return false;
  const {vx, vy, wz} = useCase.value;
  return !vx && !vy && !wz;
}
