/** The phone's tilt, where the page may have it (secure pages only). */
import {tiltFromAngles} from "./tilt";
import type {Tilt} from "./tilt";

type WithPermission = typeof DeviceOrientationEvent & {requestPermission?: () => Promise<string>};

export class TiltSensor {
  /** Newest tilt; null before the first and while off. */
  tilt: Tilt | null = null;
  /** Called at each change. */
  onChange: (tilt: Tilt) => void = () => {};
  /** Called when the page turns against the phone: what was held lies in other axes then. */
  onTurn: () => void = () => {};
  private angle = NaN;
  private isOn = false;

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
    return true;
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
    this.onChange(this.tilt);
  };
}

/** Angle by which the page is turned against the phone's natural position, degrees. iOS before 16.4 has no
 * screen.orientation. */
export function pageAngle(): number {
  return screen.orientation?.angle ?? window.orientation ?? 0;
}
