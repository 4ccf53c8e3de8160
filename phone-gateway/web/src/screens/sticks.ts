/** The two sticks of drive mode: walk and turn, or walk by tilting the phone. */
import type {Vector3} from "three";
import {Joystick} from "../controls/joystick";
import {driveFromSticks} from "../controls/stick";
import {driveFromTilt} from "../controls/tilt";
import type {TiltSensor} from "../controls/tilt_sensor";
import type {WalkSender} from "../controls/walk_sender";
import type {Store} from "../store";
import {say} from "../text/texts";

const kNoStick = {right: 0, up: 0};

export class Sticks {
  /** Called when one of them drives. */
  onUse: () => void = () => {};
  readonly walkStick: Joystick;
  readonly turnStick: Joystick;
  private neutral: Vector3 | null = null;

  constructor(store: Store, private readonly walk: WalkSender, private readonly tilt: TiltSensor) {
    this.walkStick = new Joystick(say("drive.walk"), "walk", false, () => this.changed(), ["W", "A", "S", "D"]);
    this.turnStick = new Joystick(say("drive.turn"), "turn", true, () => this.changed(), ["", "Q", "", "E"]);
    tilt.onChange = () => this.changed();
    tilt.onTurn = () => this.walkStick.release();
    store.watch((state) => state.isTilting, (isOn) => {
      this.walkStick.relabel(say(isOn ? "drive.holdTilt" : "drive.walk"));
      this.walkStick.element.classList.toggle("tilting", isOn);
    });
  }

  release(): void {
    this.walkStick.release();
    this.turnStick.release();
  }

  private changed(): void {
    const turnValue = this.turnStick.value;
    const walkValue = this.tilt.tilt ? null : this.walkStick.value;
    const isHeld = walkValue !== null || turnValue !== null;
    this.walk.set("sticks", isHeld ? driveFromSticks(walkValue ?? kNoStick, turnValue ?? kNoStick) : null);
    this.tiltChanged();
    if (this.walk.isHeld) this.onUse();
  }

  /** Tilt drives only while the pad is touched: a phone that falls or is handed on must not drive. */
  private tiltChanged(): void {
    const {tilt} = this.tilt;
    if (!tilt || this.walkStick.value === null) {
      this.neutral = null;
      this.walk.set("tilt", null);
      return;
    }
    this.neutral ??= tilt;
    this.walk.set("tilt", driveFromTilt(tilt, this.neutral));
  }
}
