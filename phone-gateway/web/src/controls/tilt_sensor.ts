/** The phone's tilt, where the page may have it (secure pages only). */
import type {Vector3} from "three";
import {tiltFromAngles} from "./tilt";

type WithPermission = typeof DeviceOrientationEvent & {requestPermission?: () => Promise<string>};

/** Within this time the first tilt comes, ms, or the device has no sensor, as most computers: chosen, phones take 0.1 s. */
const kFirstTiltMs = 1000;

export class TiltSensor {
  /** Newest tilt; null before the first and while off. */
  tilt: Vector3 | null = null;
  /** Called at each change. */
  onChange: (tilt: Vector3) => void = () => {};
  /** Called when the page turns against the phone: what was held lies in other axes then. */
  onTurn: () => void = () => {};
  private angle = NaN;
  private isOn = false;
  private heard: () => void = () => {};

  static isAvailable(): boolean {
    return window.isSecureContext && "DeviceOrientationEvent" in window;
  }

  /** Asks for the sensor; some phones want a tap for it. @return false if it may not be had. */
  async switchOn(): Promise<boolean> {
    if (!TiltSensor.isAvailable()) return false;
    const ask = (DeviceOrientationEvent as WithPermission).requestPermission;
    if (ask && (await ask.call(DeviceOrientationEvent).catch(() => "denied")) !== "granted") return false;
    if (!this.isOn) window.addEventListener("deviceorientation", this.changed);
    this.isOn = true;
    if (this.tilt) return true;
    return new Promise((resolve) => {
      this.heard = () => resolve(true);
      setTimeout(() => resolve(false), kFirstTiltMs);
    });
  }

  switchOff(): void {
    window.removeEventListener("deviceorientation", this.changed);
    this.isOn = false;
    this.tilt = null;
  }

  private readonly changed = ({beta, gamma}: DeviceOrientationEvent): void => {
    if (beta === null || gamma === null) return;
    const angle = pageAngle();
    if (angle !== this.angle) this.onTurn();
    this.angle = angle;
    this.tilt = tiltFromAngles(beta, gamma, angle);
    this.heard();
    this.onChange(this.tilt);
  };
}

/** Angle by which the page is turned against the phone's natural position, degrees. iOS before 16.4 has no
 * screen.orientation. */
export function pageAngle(): number {
  return screen.orientation?.angle ?? window.orientation ?? 0;
}
