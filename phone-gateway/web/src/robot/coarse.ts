/** Shapes of fewer triangles, for where a processor draws: there each triangle costs as much as many pixels. */
import {BufferAttribute} from "three";
import type {BufferGeometry} from "three";
import {MeshoptSimplifier} from "three/examples/jsm/libs/meshopt_simplifier.module.js";

/** How far the surface may move, m. Chosen: one pixel of a robot of 0.6 m on a phone's screen. */
const kError = 0.0015;

/** The same corners, with fewer triangles between them. */
export async function coarse(geometry: BufferGeometry): Promise<BufferGeometry> {
  await MeshoptSimplifier.ready;
  const places = geometry.getAttribute("position");
  const positions = new Float32Array(3 * places.count);
  for (let i = 0; i < places.count; i++) positions.set([places.getX(i), places.getY(i), places.getZ(i)], 3 * i);
  const index = geometry.index ? Uint32Array.from(geometry.index.array) : Uint32Array.from({length: places.count}, (_, i) => i);
  const [fewer] = MeshoptSimplifier.simplify(index, positions, 3, 0, kError, ["ErrorAbsolute"]);
  return geometry.clone().setIndex(new BufferAttribute(fewer, 1));
}
