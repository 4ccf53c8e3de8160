import {Group, PerspectiveCamera, Raycaster, Vector2} from "three";
import {describe, expect, it} from "vitest";
import {LinkDrag} from "./link_drag";

/** A torso that is turned and moved, with a link 0.2 m from it; an eye 1 m away sees them on a canvas of 400 px. */
function scene() {
  const torso = new Group();
  torso.position.set(0.1, 0.3, 0);
  torso.rotation.set(0, Math.PI / 2, 0);
  const link = new Group();
  link.position.set(0, 0.2, 0);
  torso.add(link);
  torso.updateMatrixWorld(true);
  const camera = new PerspectiveCamera(90, 1, 0.05, 20);
  camera.position.set(0.1, 0.3, 1);
  camera.updateMatrixWorld(true);
  const ray = new Raycaster();
  const rayAt = (x: number, y: number): Raycaster => {
    ray.setFromCamera(new Vector2(x / 200 - 1, 1 - y / 200), camera);
    return ray;
  };
  return {torso, link, stage: {camera, rayAt}};
}

describe("LinkDrag", () => {
  it("leaves the link where it is until the finger moves, also if it did not quite meet it", () => {
    const {torso, link, stage} = scene();
    const drag = new LinkDrag(link, torso, stage, 210, 170);
    const [x, y, z] = drag.targetAt(210, 170)!;
    expect(x).toBeCloseTo(0);
    expect(y).toBeCloseTo(0.2);
    expect(z).toBeCloseTo(0);
  });

  it("follows the finger in the plane that faces the eye, in the torso's frame", () => {
    const {torso, link, stage} = scene();
    const drag = new LinkDrag(link, torso, stage, 200, 160);
    // 1 m away, half the canvas is 1 m: 40 px are 0.2 m. The screen's right is the torso's z.
    const [x, y, z] = drag.targetAt(240, 120)!;
    expect(x).toBeCloseTo(0);
    expect(y).toBeCloseTo(0.4);
    expect(z).toBeCloseTo(0.2);
  });
});
