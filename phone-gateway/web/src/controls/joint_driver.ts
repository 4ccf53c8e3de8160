/** Turns the selected joint group while the joystick or the slider is held. */
import type {JointGroup} from "../protocol/generated/remote_pb";
import type {Axis} from "../robot/joint_axes";
import {changeFromStick, isNoChange} from "./joint_change";
import type {JointChange} from "./joint_change";
import {Repeater} from "./repeater";
import type {StickValue} from "./stick";

export const kJointPeriodMs = 50;

export class JointDriver {
  group: JointGroup | null = null;
  /** True: the other side does the same as in a mirror. */
  isMirrored = false;
  isInFront: () => boolean = () => false;
  private isLocked = false;
  private stick: StickValue | null = null;
  private readonly repeater = new Repeater(() => this.step(), kJointPeriodMs);

  /** @param send  takes a change to the robot. */
  constructor(private readonly send: (change: JointChange) => void) {}

  /** Joystick position; null: released. The first deflection is sent at once. */
  setStick(stick: StickValue | null): void {
    this.stick = stick;
    if (isPushed(stick) && !this.isLocked) this.repeater.start();
    else this.repeater.stop();
  }

  /** While it is locked nothing turns. */
  lock(isLocked: boolean): void {
    this.isLocked = isLocked;
    this.setStick(this.stick);
  }

  get isHeld(): boolean {
    return isPushed(this.stick);
  }

  /** Turns about one axis by `change` rad at once. */
  turn(axis: Axis, change: number): void {
    if (this.group) this.sendChange({group: this.group.name, [axis]: change});
  }

  private step(): void {
    if (!this.group || !this.stick) return;
    this.sendChange(changeFromStick(this.group, this.stick, this.isInFront(), kJointPeriodMs / 1000));
  }

  private sendChange(change: JointChange): void {
    if (!isNoChange(change)) this.send({...change, bothSides: this.isMirrored});
  }
}

function isPushed(stick: StickValue | null): boolean {
  return stick !== null && (stick.right !== 0 || stick.up !== 0);
}
