import {BoxGeometry, Color, Group, Mesh, MeshStandardMaterial} from "three";
import {describe, expect, it} from "vitest";
import {PlainMaterial} from "./plain_material";
import {RobotSurface} from "./robot_surface";

/** A scene as a mesh file gives it: a red box, and a lamp 1 m above it. */
function makeScene(): Group {
  const scene = new Group();
  const lamp = new Mesh(new BoxGeometry(), new MeshStandardMaterial({color: 0x000000, emissive: 0x0000ff}));
  lamp.position.z = 1;
  scene.add(new Mesh(new BoxGeometry(), new MeshStandardMaterial({color: 0xff0000})), lamp);
  return scene;
}

describe("RobotSurface", () => {
  it("makes one mesh of a file's parts, each where it was and in its colour", () => {
    const mesh = new RobotSurface(false).meshOf(makeScene())!;
    const places = mesh.geometry.getAttribute("position");
    const colors = mesh.geometry.getAttribute("color");
    expect(places.count).toBe(48);
    for (let i = 0; i < places.count; i++) {
      // The box's 24 corners come first.
      expect([colors.getX(i), colors.getY(i), colors.getZ(i)]).toEqual(
          (i < 24 ? new Color(0xff0000) : new Color(0x0000ff)).toArray());
    }
    mesh.geometry.computeBoundingBox();
    expect(mesh.geometry.boundingBox!.max.z).toBeCloseTo(1.5, 6);
  });

  it("has one material for all links, a plain one where pixels are dear", () => {
    const surface = new RobotSurface(true);
    const [a, b] = [surface.meshOf(makeScene())!, surface.meshOf(makeScene())!];
    expect(a.material).toBe(b.material);
    expect(a.material).toBeInstanceOf(PlainMaterial);
  });

  it("lets one see through the robot, which throws no shadow then, and back", () => {
    const surface = new RobotSurface(false);
    const robot = new Group();
    const mesh = surface.meshOf(makeScene())!;
    robot.add(mesh);
    surface.setGhost(true, robot);
    expect(mesh).toMatchObject({castShadow: false, material: {transparent: true}});
    surface.setGhost(false, robot);
    expect(mesh).toMatchObject({castShadow: true, material: {transparent: false, opacity: 1}});
  });

  it("has nothing to show for a file without meshes", () => {
    expect(new RobotSurface(false).meshOf(new Group())).toBeNull();
  });
});
