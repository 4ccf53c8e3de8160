/** A second robot that takes any posture: drawn small for the buttons, and as a ghost where the robot is going to. */
import {
  Box3, Color, DirectionalLight, Group, HemisphereLight, LinearSRGBColorSpace, Mesh, MeshBasicMaterial, OrthographicCamera, Scene,
  Vector3, WebGLRenderTarget,
} from "three";
import type {Object3D, WebGLRenderer} from "three";
import {makeRobotAxes} from "./frames";
import type {Posture, Postures} from "./posture_file";
import {quaternionFromRpy, RobotTree} from "./robot_tree";

/** Edge of a small drawing, pixels: twice its CSS size. */
export const kPictureSize = 128;
/** Between two drawings, ms. */
const kPauseMs = 60;
/** The eye of a drawing: to the right of the robot's front, a little above. */
const kEye = new Vector3(3, 1.4, 2.6);
const kGhostOpacity = 0.4;
/** Turn of the torso in the lying families, pitch, rad. */
const kPitch: Readonly<Record<string, number>> = {"lying-back": -Math.PI / 2, "lying-belly": Math.PI / 2};

export class PostureFigure {
  readonly tree: RobotTree;
  private readonly ghost = new MeshBasicMaterial({color: 0x6cc8ff, transparent: true, opacity: kGhostOpacity});
  private readonly meshes: Mesh[] = [];

  /** @param model  the robot, whose meshes it shares. */
  constructor(model: RobotTree) {
    this.tree = new RobotTree(model.urdf);
    for (const {name} of model.urdf.links) {
      for (const child of model.link(name).children) {
        const mesh = child as Mesh;
        if (!mesh.isMesh || !mesh.castShadow) continue;
        const copy = mesh.clone();
        this.meshes.push(copy);
        this.tree.link(name).add(copy);
      }
    }
  }

  take({family, angles}: Posture): void {
    for (const [joint, angle] of Object.entries(angles)) this.tree.setJoint(joint, angle);
    this.tree.torso.quaternion.copy(quaternionFromRpy([0, kPitch[family] ?? 0, 0]));
  }

  /** From now on one sees through it, and it throws no shadow. @param axes  the robot's, where it stands from then on. */
  becomeGhost(axes: Object3D): void {
    for (const mesh of this.meshes) {
      mesh.material = this.ghost;
      mesh.castShadow = mesh.receiveShadow = false;
    }
    this.tree.torso.visible = false;
    axes.add(this.tree.torso);
  }

  /** Stands where a robot is, in a posture; null: nowhere. @param torso  the robot's. @param heading  rad. */
  standAt(posture: Posture | null, torso: Object3D, heading: number): void {
    this.tree.torso.visible = posture !== null;
    if (!posture) return;
    this.take(posture);
    this.tree.torso.quaternion.premultiply(quaternionFromRpy([0, 0, heading]));
    this.tree.torso.position.set(torso.position.x, torso.position.y, 0);
    // Its lowest point is on the ground.
    this.tree.torso.position.z = -new Box3().setFromObject(this.tree.torso).min.y;
  }

  /** A drawing of each posture, one after the other: a processor that draws must answer the robot meanwhile.
   * @param isLinear  the surface leaves it to the screen to encode its colors. */
  async draw(renderer: WebGLRenderer, postures: Postures, isLinear: boolean): Promise<Map<string, HTMLCanvasElement>> {
    const scene = new Scene();
    const sun = new DirectionalLight(0xffffff, 2);
    sun.position.set(1, 3, 2);
    const axes = new Group();
    makeRobotAxes(axes);
    axes.add(this.tree.torso);
    scene.add(new HemisphereLight(0xffffff, 0x8899aa, 2), sun, axes);
    const target = new WebGLRenderTarget(kPictureSize, kPictureSize);
    const drawings = new Map<string, HTMLCanvasElement>();
    for (const [name, posture] of postures) {
      await new Promise((resolve) => setTimeout(resolve, kPauseMs));
      this.take(posture);
      renderer.setRenderTarget(target);
      renderer.render(scene, cameraFor(axes));
      const pixels = new Uint8Array(4 * kPictureSize * kPictureSize);
      renderer.readRenderTargetPixels(target, 0, 0, kPictureSize, kPictureSize, pixels);
      renderer.setRenderTarget(null);
      drawings.set(name, canvasOf(pixels, isLinear));
    }
    target.dispose();
    return drawings;
  }
}

/** All of an object fits its image. */
function cameraFor(object: Object3D): OrthographicCamera {
  object.updateMatrixWorld(true);
  const box = new Box3().setFromObject(object);
  const middle = box.getCenter(new Vector3());
  const reach = box.getSize(new Vector3()).length() / 2;
  const camera = new OrthographicCamera(-reach, reach, reach, -reach, 0.01, 20);
  camera.position.copy(middle).addScaledVector(kEye.clone().normalize(), 5);
  camera.lookAt(middle);
  return camera;
}

/** Pixels of a render target: premultiplied, the lowest row first. */
function canvasOf(pixels: Uint8Array, isLinear: boolean): HTMLCanvasElement {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = kPictureSize;
  const image = new ImageData(kPictureSize, kPictureSize);
  const color = new Color();
  for (let i = 0; i < kPictureSize * kPictureSize; i++) {
    const from = 4 * i;
    const to = 4 * ((kPictureSize - 1 - Math.floor(i / kPictureSize)) * kPictureSize + i % kPictureSize);
    const alpha = pixels[from + 3]!;
    if (alpha === 0) continue;
    color.setRGB(pixels[from]! / alpha, pixels[from + 1]! / alpha, pixels[from + 2]! / alpha, LinearSRGBColorSpace);
    const {r, g, b} = isLinear ? color.convertLinearToSRGB() : color;
    image.data.set([255 * r, 255 * g, 255 * b, alpha], to);
  }
  canvas.getContext("2d")?.putImageData(image, 0, 0);
  return canvas;
}
