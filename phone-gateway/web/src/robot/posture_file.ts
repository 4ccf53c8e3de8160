/** The robot's postures, from the file that its motion program reads too; pure but for the fetch. */

export interface Posture {
  /** "standing", "crouching", "sitting", "lying-back" or "lying-belly". */
  family: string;
  /** rad, by joint name. */
  angles: Readonly<Record<string, number>>;
}

export type Postures = ReadonlyMap<string, Posture>;

/** List items "- name: Crouch" with "family: crouching" and lines "Joint: angle" below "joints:". What is written otherwise
 * is left out. A whole YAML parser would cost more than the postures are worth. */
export function parsePostures(text: string): Postures {
  return new Map(text.split(/^ *- name: */m).slice(1).map((block) => {
    const name = /^\S*/.exec(block)![0];
    const family = /^ *family: *(\S+)/m.exec(block)?.[1] ?? "";
    const joints = block.split(/^ *joints: *$/m)[1] ?? "";
    const angles = [...joints.matchAll(/^ +(\w+): *(-?[\d.]+)\s*$/gm)].map((match) => [match[1]!, Number(match[2])]);
    return [name, {family, angles: Object.fromEntries(angles) as Record<string, number>}];
  }));
}

/** @param urdfUrl  beside which the postures lie. Empty where there are none: they are offered without drawings. */
export async function loadPostures(urdfUrl: URL): Promise<Postures> {
  const response = await fetch(new URL("postures.yaml", urdfUrl)).catch(() => null);
  return parsePostures(response?.ok ? await response.text() : "");
}
