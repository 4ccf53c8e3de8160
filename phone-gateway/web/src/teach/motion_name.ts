/** Names of motions as the robot's host accepts them: letters, digits, '-' and '_', at most 40. */

const kMaxLength = 40;
/** A name that begins with '_' is temporary: neither listed nor kept. */
export const kTemporaryName = "_draft";

/** A name for what a person wrote: "Olá Ana!" becomes "Ola-Ana". Empty if nothing of it is left. */
export function motionName(text: string): string {
  return text.normalize("NFD").replace(/\p{M}/gu, "").replace(/ß/g, "ss").trim()
      .replace(/[^A-Za-z0-9_-]+/g, "-").replace(/^[-_]+|-+$/g, "").slice(0, kMaxLength);
}

/** "wave", or the first of "wave-2", "wave-3" that is free. @param text  as a person would write it; "motion" if nothing is left. */
export function freeName(text: string, used: readonly string[]): string {
  const name = motionName(text) || "motion";
  for (let i = 1; ; i++) {
    const tried = i === 1 ? name : `${name}-${i}`;
    if (!used.includes(tried)) return tried;
  }
}
