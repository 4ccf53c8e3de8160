/** Felt where the phone can, once it was touched; silently nothing where it cannot. Patterns are ms on, off, on. */
export const kTapPattern = 12;
export const kLimitPattern = 30;
export const kRefusalPattern = [25, 60, 25];

export function vibrate(pattern: VibratePattern): void {
  // Browsers complain of what shakes before the first touch.
  if (navigator.userActivation?.hasBeenActive !== false) navigator.vibrate?.(pattern);
}
