/** Where the eye stands: it goes after the robot, turns with it, and is moved aside by the person's
 * finger. Pure; angles in rad, lengths in m, in the robot's axes (Z up). */
import {clamp} from "../clamp";

const kMinZoom = 0.35;
const kMaxZoom = 2.2;
const kMinElevation = 0.03;
const kMaxElevation = 1.45;
/** Times in which the eye covers 63 % of its way, s: after the robot, and to another view. */
const kFollowTime = 0.35;
const kViewTime = 0.14;

/** A view to which the eye returns. Azimuth is relative to the robot's heading, 0 behind it. */
export interface View {
  azimuth: number;
  elevation: number;
}

export class Orbit {
  /** Point looked at, and the heading that the azimuth counts from. */
  x = 0;
  y = 0;
  z = 0.28;
  heading = 0;
  azimuth: number;
  elevation: number;
  zoomFactor = 1;
  /** Distance at which the whole robot fits the screen; the stage sets it. */
  fitDistance = 1.3;
  /** False for people who want no motion on screen: views change at once. */
  isGliding = true;
  private goalAzimuth: number;
  private goalElevation: number;
  private goalZoom = 1;

  constructor(private view: View) {
    this.azimuth = this.goalAzimuth = view.azimuth;
    this.elevation = this.goalElevation = view.elevation;
  }

  /** Another view to return to; goes there by the shorter way round. */
  setView(view: View): void {
    this.view = view;
    this.reset();
  }

  reset(): void {
    this.goalAzimuth = this.azimuth + wrapAngle(this.view.azimuth - this.azimuth);
    this.goalElevation = this.view.elevation;
    this.goalZoom = 1;
  }

  /** Under the finger: at once. */
  turn(azimuth: number, elevation: number): void {
    this.azimuth = this.goalAzimuth = this.azimuth + azimuth;
    this.elevation = this.goalElevation =
        clamp(this.elevation + elevation, kMinElevation, kMaxElevation);
  }

  /** @param factor above 1 goes nearer. */
  zoom(factor: number): void {
    this.zoomFactor = this.goalZoom = clamp(this.zoomFactor * factor, kMinZoom, kMaxZoom);
  }

  /** True if the eye sees the robot's front, where left on the screen is the robot's right. */
  get isInFront(): boolean {
    return Math.cos(this.azimuth) < 0;
  }

  /** Goes after the robot. @param dt s. */
  follow(x: number, y: number, z: number, heading: number, dt: number): void {
    const share = this.isGliding ? 1 - Math.exp(-dt / kFollowTime) : 1;
    this.x += share * (x - this.x);
    this.y += share * (y - this.y);
    this.z += share * (z - this.z);
    this.heading += share * wrapAngle(heading - this.heading);
    const viewShare = this.isGliding ? 1 - Math.exp(-dt / kViewTime) : 1;
    this.azimuth += viewShare * (this.goalAzimuth - this.azimuth);
    this.elevation += viewShare * (this.goalElevation - this.elevation);
    this.zoomFactor += viewShare * (this.goalZoom - this.zoomFactor);
  }

  /** Where the eye is. @return x, y, z through `out`. */
  eye(out: {x: number; y: number; z: number}): void {
    const distance = this.fitDistance / this.zoomFactor;
    const angle = this.heading + this.azimuth;
    const flat = distance * Math.cos(this.elevation);
    out.x = this.x - flat * Math.cos(angle);
    out.y = this.y - flat * Math.sin(angle);
    out.z = Math.max(0.02, this.z + distance * Math.sin(this.elevation));
  }
}

/** The same angle between -pi and pi. */
export function wrapAngle(angle: number): number {
  return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}
