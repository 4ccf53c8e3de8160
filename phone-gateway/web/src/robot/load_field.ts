/** The lines of the field, from the scene file that simulator and camera read too. */

const kKeys = ["length", "width", "lineWidth", "centreCircleDiameter", "penaltyAreaLength", "penaltyAreaWidth"] as const;

/** The lines of a field, m; see data/scenes/soccer.yaml for the meaning. */
export type FieldLines = Readonly<Record<typeof kKeys[number], number>>;

/** Lines in a scene file: "key: number" below "field:". Null if it has no field, or not all of it.
 * A whole YAML parser would cost more than the lines are worth. */
export function parseFieldLines(text: string): FieldLines | null {
  const start = text.search(/^field:/m);
  if (start < 0) return null;
  const block = text.slice(start).split(/\n(?=\S)/)[0]!;
  const lines = Object.fromEntries([...block.matchAll(/^ +(\w+): *([\d.]+)/gm)].map(([, key, value]) =>
      [key!.replace(/_(\w)/g, (_, letter: string) => letter.toUpperCase()), Number(value)])) as Partial<FieldLines>;
  return kKeys.every((key) => Number.isFinite(lines[key])) ? lines as FieldLines : null;
}

/** Null where the gateway has no such scene: the ground is shown without lines then. */
export async function loadFieldLines(pageUrl: string): Promise<FieldLines | null> {
  const response = await fetch(new URL("/scene.yaml", pageUrl)).catch(() => null);
  return response?.ok ? parseFieldLines(await response.text()) : null;
}
