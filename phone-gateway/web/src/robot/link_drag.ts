/** A finger that holds a link: which point of space it pulls the link to. The finger moves in the plane
 * through the link that faces the eye. */
import {Plane, Vector3} from "three";
import type {Object3D} from "three";
import type {Stage} from "./stage";

export class LinkDrag {
  private readonly plane: Plane;
  private readonly offset = new Vector3();

  /** @param x,y  where the finger is, px from the canvas's top left. */
  constructor(link: Object3D, private readonly torso: Object3D, private readonly stage: Pick<Stage, "camera" | "rayAt">,
              x: number, y: number) {
    const held = link.getWorldPosition(new Vector3());
    this.plane = new Plane().setFromNormalAndCoplanarPoint(stage.camera.getWorldDirection(new Vector3()), held);
    // The link does not jump under the finger: what was between them stays between them.
    const met = this.meet(x, y);
    if (met) this.offset.copy(held).sub(met);
  }

  /** Where the link shall go for a finger at x, y: m in the torso's frame; null if the finger points away. */
  targetAt(x: number, y: number): Vector3 | null {
    const met = this.meet(x, y);
    return met && this.torso.worldToLocal(met.add(this.offset));
  }

  private meet(x: number, y: number): Vector3 | null {
    return this.stage.rayAt(x, y).ray.intersectPlane(this.plane, new Vector3());
  }
}
