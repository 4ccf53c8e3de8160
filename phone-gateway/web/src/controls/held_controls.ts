/** Keyboard and gamepad: what is held walks the robot, or turns the joint that is selected. */
import type {Store} from "../store";
import {Gamepads, listenToKeys} from "./held_keys";
import type {JointDriver} from "./joint_driver";
import {driveFromKeys, stickFromKeys, sticksFromPad} from "./keys";
import type {PadButton} from "./keys";
import {driveFromSticks} from "./stick";
import type {WalkSender} from "./walk_sender";

export class HeldControls {
  private readonly gamepads = new Gamepads();
  private isPadHeld = false;

  constructor(private readonly store: Store, private readonly walk: WalkSender, private readonly joints: JointDriver,
              private readonly pressed: (button: PadButton) => void) {}

  /** @param isActive  whether keys count at the moment. */
  listen(isActive: () => boolean): void {
    listenToKeys(isActive, {
      heldChanged: (held, isSlow) => this.keysChanged(held, isSlow),
      pressed: this.pressed,
    });
  }

  /** Reads the gamepad; once a frame. */
  poll(): void {
    // One that was unplugged is at rest: what it held must not go on.
    this.padMoved(this.gamepads.poll(this.pressed) ?? []);
  }

  private keysChanged(held: ReadonlySet<string>, isSlow: boolean): void {
    const {isJointsMode} = this.store.get();
    this.joints.setStick(isJointsMode ? stickFromKeys(held, isSlow) : null);
    this.walk.set("keys", isJointsMode ? null : driveFromKeys(held, isSlow));
  }

  private padMoved(axes: readonly number[]): void {
    const {walk, turn} = sticksFromPad(axes);
    const drive = driveFromSticks(walk, turn);
    const isHeld = drive.x !== 0 || drive.y !== 0 || drive.theta !== 0;
    const {isJointsMode} = this.store.get();
    if (isHeld || this.isPadHeld) {
      this.walk.set("gamepad", isHeld && !isJointsMode ? drive : null);
      if (isJointsMode) this.joints.setStick(isHeld ? walk : null);
    }
    this.isPadHeld = isHeld;
  }
}
