import {BoxGeometry, Color, Group, Mesh, MeshStandardMaterial, SphereGeometry, Vector3} from "three";
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
  it("makes one mesh of a file's parts, each where it was and in its colour", async () => {
    const mesh = (await new RobotSurface(false).meshOf(makeScene()))!;
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

  it("has one material for all links, a plain one where pixels are dear", async () => {
    const surface = new RobotSurface(true);
    const [a, b] = [(await surface.meshOf(makeScene()))!, (await surface.meshOf(makeScene()))!];
    expect(a.material).toBe(b.material);
    expect(a.material).toBeInstanceOf(PlainMaterial);
  });

  it("lets one see through the robot, which throws no shadow then, and back", async () => {
    const surface = new RobotSurface(false);
    const robot = new Group();
    const mesh = (await surface.meshOf(makeScene()))!;
    robot.add(mesh);
    surface.setGhost(true, robot);
    expect(mesh).toMatchObject({castShadow: false, material: {transparent: true}});
    surface.setGhost(false, robot);
    expect(mesh).toMatchObject({castShadow: true, material: {transparent: false, opacity: 1}});
  });

  it("has far fewer triangles where a processor draws, within 1.5 mm of the surface", async () => {
    const scene = new Group();
    scene.add(new Mesh(new SphereGeometry(0.05, 48, 32), new MeshStandardMaterial()));
    const numTriangles = async (isPlain: boolean) =>
        (await new RobotSurface(isPlain).meshOf(scene))!.geometry.index!.count / 3;
    expect(await numTriangles(true)).toBeLessThan(0.3 * await numTriangles(false));
    const {geometry} = (await new RobotSurface(true).meshOf(scene))!;
    const places = geometry.getAttribute("position");
    const [a, b, c] = [new Vector3(), new Vector3(), new Vector3()];
    for (let i = 0; i < geometry.index!.count; i += 3) {
      [a, b, c].forEach((corner, k) => corner.fromBufferAttribute(places, geometry.index!.getX(i + k)));
      const middle = a.clone().add(b).add(c).divideScalar(3).length();
      expect(middle).toBeGreaterThan(0.05 - 2 * 0.0015);
      expect(middle).toBeLessThan(0.05 + 1e-6);
    }
  });

  it("has nothing to show for a file without meshes", async () => {
    expect(await new RobotSurface(false).meshOf(new Group())).toBeNull();
  });
});
