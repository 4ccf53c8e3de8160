/** Keyboard and gamepad to the same commands as the joysticks; pure. */
import {addDrives, stickValue} from "./stick";
import type {Drive, StickValue} from "./stick";

/** Keys that walk, by their place on the keyboard, and what each adds to the drive. */
const kDriveKeys: Record<string, Drive> = {
  KeyW: {x: 1, y: 0, theta: 0}, ArrowUp: {x: 1, y: 0, theta: 0},
  KeyS: {x: -1, y: 0, theta: 0}, ArrowDown: {x: -1, y: 0, theta: 0},
  KeyA: {x: 0, y: 1, theta: 0}, KeyD: {x: 0, y: -1, theta: 0},
  KeyQ: {x: 0, y: 0, theta: 1}, ArrowLeft: {x: 0, y: 0, theta: 1},
  KeyE: {x: 0, y: 0, theta: -1}, ArrowRight: {x: 0, y: 0, theta: -1},
};

export function isDriveKey(code: string): boolean {
  return code in kDriveKeys;
}

/** What the held keys ask for; null if none of them walks. `isSlow`: Shift is held. */
export function driveFromKeys(held: ReadonlySet<string>, isSlow: boolean): Drive | null {
  const drives = [...held].flatMap((code) => kDriveKeys[code] ?? []);
  const {x, y, theta} = addDrives(drives);
  const scale = isSlow ? 0.4 : 1;
  return drives.length > 0 ? {x: x * scale, y: y * scale, theta: theta * scale} : null;
}

/** The same keys on a joint: where the pad would be. */
export function stickFromKeys(held: ReadonlySet<string>, isSlow: boolean): StickValue | null {
  const drive = driveFromKeys(held, isSlow);
  return drive && {up: drive.x, right: -(drive.y || drive.theta)};
}

export type PadButton = "stop" | "ready" | "stand" | "crouch" | "lock" | "kick-left" | "kick-right" | "next-group" | "previous-group";

/** Keys that do something once, by their place on the keyboard. */
export const kButtonKeys: Readonly<Record<string, PadButton>> = {
  Space: "stop", Escape: "stop", KeyL: "lock", KeyR: "ready", KeyC: "crouch", Digit1: "kick-left", Digit2: "kick-right",
  Period: "next-group", Comma: "previous-group",
};

/** Buttons of the standard layout, by their number there. */
const kPadButtons: Record<number, PadButton> = {
  0: "ready", 1: "stop", 2: "crouch", 3: "stand", 4: "kick-left", 5: "kick-right", 9: "lock",
};

/** Dead zone of a gamepad's sticks, whose middle drifts with their age. Source: XINPUT_GAMEPAD_RIGHT_THUMB_DEADZONE,
 * 8689 of 32767. */
const kPadDeadZone = 0.265;

export interface PadSticks {
  walk: StickValue;
  turn: StickValue;
}

export function isDeflected({walk, turn}: PadSticks): boolean {
  return walk.right !== 0 || walk.up !== 0 || turn.right !== 0;
}

/** Left and right stick of a gamepad with the standard layout (axes: right and down, -1 to 1). */
export function sticksFromPad(axes: readonly number[]): PadSticks {
  const [x = 0, y = 0, turn = 0] = axes;
  return {walk: stickValue(x, y, 1, kPadDeadZone), turn: stickValue(turn, 0, 1, kPadDeadZone)};
}

/** Buttons that went down since the last look. @param before  is brought up to date. */
export function pressedButtons(pressed: readonly boolean[], before: boolean[]): PadButton[] {
  const found = pressed.flatMap((isPressed, i) => isPressed && !before[i] ? kPadButtons[i] ?? [] : []);
  before.splice(0, Infinity, ...pressed);
  return found;
}
