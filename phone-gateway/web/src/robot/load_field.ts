/** The lines of the field, from the scene file that simulator and camera read too. */
import type {FieldLines} from "./floor";

const kKeys: Record<keyof FieldLines, string> = {
  length: "length",
  width: "width",
  lineWidth: "line_width",
  centreCircleDiameter: "centre_circle_diameter",
  penaltyAreaLength: "penalty_area_length",
  penaltyAreaWidth: "penalty_area_width",
};

/** Lines in a scene file: "key: number" below "field:". Null if it has no field, or not all of it.
 * A whole YAML parser would cost more than the lines are worth. */
export function parseFieldLines(text: string): FieldLines | null {
  const start = text.search(/^field:/m);
  if (start < 0) return null;
  const block = text.slice(start).split(/\n(?=\S)/)[0]!;
  const lines: Partial<FieldLines> = {};
  for (const [name, key] of Object.entries(kKeys)) {
    const value = Number(new RegExp(`^ +${key}: *([\\d.]+)`, "m").exec(block)?.[1]);
    if (!Number.isFinite(value)) return null;
    lines[name as keyof FieldLines] = value;
  }
  return lines as FieldLines;
}

/** Null where the gateway has no such scene: the ground is shown without lines then. */
export async function loadFieldLines(pageUrl: string): Promise<FieldLines | null> {
  const response = await fetch(new URL("/scene.yaml", pageUrl)).catch(() => null);
  return response?.ok ? parseFieldLines(await response.text()) : null;
}
