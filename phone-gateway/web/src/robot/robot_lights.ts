/** The robot's lights: discs and rings on its links, in the colours that the state tells. */
import {
  CircleGeometry, DoubleSide, Mesh, MeshBasicMaterial, Quaternion, RingGeometry, Vector3,
} from "three";
import type {Light} from "../protocol/generated/remote_pb";
import type {RobotTree} from "./robot_tree";

const kSegments = 24;
/** Where three.js's discs look to. */
const kForward = new Vector3(0, 0, 1);

export class RobotLights {
  private readonly materials: MeshBasicMaterial[] = [];
  private readonly discs: Mesh[] = [];
  private readonly shown: number[] = [];

  /** @param lights  the order of State.light_rgb. A light on a link that the robot does not have is left out. */
  constructor(readonly tree: RobotTree, lights: readonly Light[]) {
    for (const light of lights) {
      const material = new MeshBasicMaterial({transparent: true, opacity: 0, side: DoubleSide, toneMapped: false,
                                              depthWrite: false});
      material.visible = false;
      this.materials.push(material);
      this.shown.push(0);
      if (!tree.urdf.links.some(({name}) => name === light.link)) continue;
      for (const disc of light.discs) {
        const mesh = new Mesh(disc.innerRadius > 0 ? new RingGeometry(disc.innerRadius, disc.radius, kSegments)
            : new CircleGeometry(disc.radius, kSegments), material);
        mesh.position.set(disc.center[0] ?? 0, disc.center[1] ?? 0, disc.center[2] ?? 0);
        const normal = new Vector3(disc.normal[0] ?? 0, disc.normal[1] ?? 0, disc.normal[2] ?? 1);
        mesh.quaternion.copy(new Quaternion().setFromUnitVectors(kForward, normal.normalize()));
        this.discs.push(mesh);
        tree.link(light.link).add(mesh);
      }
    }
  }

  /** @param rgb  0xRRGGBB of each light; those that are missing are dark. @return true if one looks different now. */
  show(rgb: readonly number[]): boolean {
    let isChanged = false;
    this.materials.forEach((material, i) => {
      const color = rgb[i] ?? 0;
      if (color === this.shown[i]) return;
      this.shown[i] = color;
      isChanged = true;
      // A dim light is a translucent one: it does not darken what is behind it.
      const parts = [color >> 16 & 255, color >> 8 & 255, color & 255];
      const brightest = Math.max(...parts);
      material.visible = brightest > 0;
      if (brightest === 0) return;
      material.opacity = brightest / 255;
      material.color.setRGB(parts[0]! / brightest, parts[1]! / brightest, parts[2]! / brightest, "srgb");
    });
    return isChanged;
  }

  /** Takes the lights off the robot. */
  dispose(): void {
    for (const disc of this.discs) disc.removeFromParent();
    for (const material of this.materials) material.dispose();
  }
}
