/** A finger that holds a link: which point of space it pulls the link to. The finger moves in the plane
 * through the link that faces the eye. */
import {Plane, Raycaster, Vector2, Vector3} from "three";
import type {Camera, Object3D} from "three";

export class LinkDrag {
  private readonly plane: Plane;
  private readonly offset = new Vector3();
  private readonly ray = new Raycaster();
  private readonly hit = new Vector3();

  /** @param x,y  where the finger is, px from the top left of a canvas of `width` by `height`. */
  constructor(link: Object3D, private readonly torso: Object3D, private readonly camera: Camera,
              private readonly width: number, private readonly height: number, x: number, y: number) {
    const held = link.getWorldPosition(new Vector3());
    this.plane = new Plane().setFromNormalAndCoplanarPoint(camera.getWorldDirection(new Vector3()), held);
    // The link does not jump under the finger: what was between them stays between them.
    if (this.meet(x, y)) this.offset.copy(held).sub(this.hit);
  }

  /** Where the link shall go for a finger at x, y: m in the torso's frame; null if the finger points away. */
  targetAt(x: number, y: number): Vector3 | null {
    if (!this.meet(x, y)) return null;
    return this.torso.worldToLocal(this.hit.clone().add(this.offset));
  }

  private meet(x: number, y: number): boolean {
    this.ray.setFromCamera(new Vector2(2 * x / this.width - 1, 1 - 2 * y / this.height), this.camera);
    return this.ray.ray.intersectPlane(this.plane, this.hit) !== null;
  }
}
