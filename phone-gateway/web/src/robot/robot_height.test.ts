import {BoxGeometry, Group, Mesh} from "three";
import {describe, expect, it} from "vitest";
import {calcHeight} from "./robot_height";

/** A torso of 0.2 m with a head and a foot, centers at heights relative to the torso, 0.1 m each. */
function makeTorso(head: number, foot: number): Group {
  const torso = new Group();
  torso.add(new Mesh(new BoxGeometry(0.3, 0.3, 0.2)));
  for (const height of [head, foot]) {
    const link = new Group();
    link.position.z = height;
    link.add(new Mesh(new BoxGeometry(0.1, 0.1, 0.1)));
    torso.add(link);
  }
  return torso;
}

describe("calcHeight", () => {
  it("reaches from the lowest to the highest shell", () => {
    expect(calcHeight(makeTorso(0.35, -0.75))).toBeCloseTo(1.2, 6);
  });

  it("does not depend on the torso's place", () => {
    const torso = makeTorso(0.35, -0.75);
    torso.position.set(3, 2, 0.7);
    expect(calcHeight(torso)).toBeCloseTo(1.2, 6);
  });

  it("is a guess without shells", () => {
    expect(calcHeight(new Group())).toBeGreaterThan(0);
  });
});
