/** The robot's surface: one mesh per link, with the colour of each part in its corners, and one material
 * for all links. Sixty meshes with a material each cost a phone more than their triangles do. */
import {
  BufferAttribute, Color, Mesh, MeshStandardMaterial,
} from "three";
import type {BufferGeometry, Object3D} from "three";
import {mergeGeometries} from "three/examples/jsm/utils/BufferGeometryUtils.js";
import {PlainMaterial} from "./plain_material";

const kGhostOpacity = 0.42;
/** Satin plastic. */
const kRoughness = 0.45;

export class RobotSurface {
  private readonly material: MeshStandardMaterial | PlainMaterial;

  /** @param isPlain  true where a processor draws: without highlights. */
  constructor(readonly isPlain: boolean) {
    this.material = isPlain ? new PlainMaterial()
        : new MeshStandardMaterial({vertexColors: true, roughness: kRoughness, metalness: 0});
  }

  /** One mesh of all meshes in a file's scene. Null if there is none. */
  async meshOf(scene: Object3D): Promise<Mesh | null> {
    const coarse = this.isPlain ? (await import("./coarse")).coarse : null;
    const meshes: Mesh[] = [];
    scene.updateMatrixWorld(true);
    scene.traverse((object) => {
      if ((object as Mesh).isMesh) meshes.push(object as Mesh);
    });
    const parts = await Promise.all(meshes.map(async (mesh) =>
        painted(mesh, coarse ? await coarse(mesh.geometry) : mesh.geometry.clone())));
    if (parts.length === 0) return null;
    const mesh = new Mesh(mergeGeometries(parts), this.material);
    mesh.castShadow = true;
    mesh.receiveShadow = true;
    return mesh;
  }

  /** True: one sees through it, to what is inside; it throws no shadow then. */
  setGhost(isGhost: boolean, robot: Object3D): void {
    this.material.transparent = isGhost;
    this.material.opacity = isGhost ? kGhostOpacity : 1;
    if (this.material instanceof PlainMaterial) this.material.setOpacity(this.material.opacity);
    this.material.needsUpdate = true;
    robot.traverse((object) => {
      const mesh = object as Mesh;
      if (mesh.isMesh && mesh.material === this.material) mesh.castShadow = !isGhost;
    });
  }
}

/** The shape of a mesh in the scene's frame, with its material's colour in each corner. What shines by
 * itself is brighter than white. */
function painted(mesh: Mesh, shape: BufferGeometry): BufferGeometry {
  const {color, emissive} = mesh.material as MeshStandardMaterial;
  const {r, g, b} = new Color().copy(color).add(emissive);
  const geometry = shape.applyMatrix4(mesh.matrixWorld);
  const numCorners = geometry.getAttribute("position").count;
  const colors = new Float32Array(3 * numCorners);
  for (let i = 0; i < numCorners; i++) colors.set([r, g, b], 3 * i);
  return geometry.setAttribute("color", new BufferAttribute(colors, 3));
}
