/** Keyboard and gamepad: what is held walks the robot, or turns the joint that is selected. All that is held, on the screen
 * too, is released from here. */
import type {Commander} from "../commander";
import type {Messages} from "../messages";
import {isStale} from "../store";
import type {Store} from "../store";
import {say} from "../text/texts";
import {Gamepads, listenToKeys} from "./held_keys";
import type {PadListener} from "./held_keys";
import type {JointDriver} from "./joint_driver";
import {driveFromKeys, isDeflected, stickFromKeys} from "./keys";
import {addDrives, driveFromSticks} from "./stick";
import type {WalkSender} from "./walk_sender";

export class HeldControls {
  private readonly gamepads: Gamepads;
  private isPadHeld = false;
  /** The sticks of all gamepads must come to rest before they count again. */
  private mustRest = false;
  private releaseKeys: () => void = () => {};
  /** Releases what is held on the screen. */
  releaseScreen: () => void = () => {};

  constructor(private readonly store: Store, private readonly walk: WalkSender, private readonly joints: JointDriver,
              private readonly listener: PadListener, now?: () => number) {
    this.gamepads = new Gamepads(listener, now);
    walk.onHeldUp = () => void this.release();
  }

  /** @param isActive  whether keys count at the moment. */
  listen(isActive: () => boolean): void {
    this.releaseKeys = listenToKeys(isActive, (held, isSlow) => this.keysChanged(held, isSlow),
                                    (button) => this.listener.pressed(button));
  }

  /** What is held counts no more: keys and the screen until they are pressed anew, gamepads until their sticks have been at
   * rest. @return true if something was held. */
  release(): boolean {
    const wasHeld = this.walk.isHeld || this.joints.isHeld;
    this.releaseKeys();
    this.mustRest = true;
    this.releaseScreen();
    this.joints.setStick(null);
    this.walk.release();
    return wasHeld;
  }

  /** The robot stands while what is seen of it is old; what is still held then goes on, unless the link was lost.
   * @param stopped  called when something was held. */
  lockWhileStale(stopped: () => void): void {
    this.store.watch(isStale, (isLocked) => {
      if (isLocked && (this.walk.isHeld || this.joints.isHeld)) stopped();
      this.walk.lock(isLocked);
      this.joints.lock(isLocked);
    });
    this.store.watch((state) => state.phase !== "connected", (isLost) => {
      if (isLost) this.release();
    });
  }

  /** A motion that ends a walk releases the held controls, which are notified. */
  yieldTo(commander: Commander, messages: Messages): void {
    commander.onMotion = () => {
      if (this.release()) messages.show("info", say("drive.released"));
    };
  }

  /** Reads the gamepads; once a frame. */
  poll(): void {
    const held = this.gamepads.poll().filter(isDeflected);
    this.mustRest &&= held.length > 0;
    const isHeld = held.length > 0 && !this.mustRest;
    const {isJointsMode} = this.store.get();
    if (isHeld || this.isPadHeld) {
      this.walk.set("gamepad", isHeld && !isJointsMode
          ? addDrives(held.map(({walk, turn}) => driveFromSticks(walk, turn))) : null);
      if (isJointsMode) this.joints.setStick(isHeld ? held[0]!.walk : null);
    }
    this.isPadHeld = isHeld;
  }

  private keysChanged(held: ReadonlySet<string>, isSlow: boolean): void {
    const {isJointsMode} = this.store.get();
    this.joints.setStick(isJointsMode ? stickFromKeys(held, isSlow) : null);
    this.walk.set("keys", isJointsMode ? null : driveFromKeys(held, isSlow));
  }
}
