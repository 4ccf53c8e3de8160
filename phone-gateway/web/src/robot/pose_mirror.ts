/** Makes the tree follow the robot's state. States come in steps, uneven over Wi-Fi; each frame goes
 * most of the way to the newest one, so that the eye sees a movement and not the network. */
import {Quaternion, Vector3} from "three";
import type {State} from "../protocol/generated/remote_pb";
import type {RobotTree} from "./robot_tree";

/** Time in which 63 % of the distance to the newest state is covered, s: less than a frame, so that a joystick does not
 * wait for its robot; uneven states are still spread over two or three. */
const kFollowTime = 0.012;
/** An invisible difference, rad and m: less than half a pixel of a robot as tall as a phone's screen. */
const kSeenAngle = 0.0008;
const kSeenLength = 0.0003;
/** A jump farther than this is shown at once: the robot was placed elsewhere, not moved; m. */
const kJump = 0.5;

export class PoseMirror {
  private readonly target: Float64Array;
  private readonly shown: Float64Array;
  private readonly position = new Vector3();
  private readonly orientation = new Quaternion();
  private hasState = false;
  /** True once the tree has taken a state's pose. */
  hasPose = false;

  /** @param joints  the order of State.joint_position. */
  constructor(private readonly tree: RobotTree, private readonly joints: readonly {name: string}[]) {
    this.target = new Float64Array(joints.length);
    this.shown = new Float64Array(joints.length);
  }

  /** Takes a state; values that are missing or not finite leave what was there. */
  setTarget(state: State): void {
    for (let i = 0; i < this.target.length; i++) {
      const angle = state.jointPosition[i];
      if (angle !== undefined && Number.isFinite(angle)) this.target[i] = angle;
    }
    const [x = NaN, y = NaN, z = NaN] = state.torsoPosition;
    if (Number.isFinite(x + y + z)) this.position.set(x, y, z);
    const [w = NaN, i = NaN, j = NaN, k = NaN] = state.torsoOrientation;
    const length = Math.hypot(w, i, j, k);
    if (length > 0.5 && Number.isFinite(length)) this.orientation.set(i / length, j / length, k / length, w / length);
    if (!this.hasState) this.jump();
    this.hasState = true;
  }

  /** Moves the tree towards the newest state. @param dt  s since the last call.
   * @return true if the tree looks different now. */
  step(dt: number): boolean {
    if (!this.hasState || (this.hasPose && this.isThere())) return false;
    this.hasPose = true;
    if (this.tree.torso.position.distanceTo(this.position) > kJump) this.jump();
    const share = 1 - Math.exp(-dt / kFollowTime);
    for (let i = 0; i < this.target.length; i++) {
      this.shown[i]! += share * (this.target[i]! - this.shown[i]!);
      this.tree.setJoint(this.joints[i]!.name, this.shown[i]!);
    }
    this.tree.torso.position.lerp(this.position, share);
    this.tree.torso.quaternion.slerp(this.orientation, share);
    return true;
  }

  private isThere(): boolean {
    const {position, quaternion} = this.tree.torso;
    if (position.distanceTo(this.position) > kSeenLength) return false;
    if (quaternion.angleTo(this.orientation) > kSeenAngle) return false;
    for (let i = 0; i < this.target.length; i++) {
      if (Math.abs(this.shown[i]! - this.target[i]!) > kSeenAngle) return false;
    }
    return true;
  }

  private jump(): void {
    this.shown.set(this.target);
    this.tree.torso.position.copy(this.position);
    this.tree.torso.quaternion.copy(this.orientation);
  }
}
