/** What the robot sees, on the 3D stage: ball, lines, goal posts and robots at their estimated places, with ellipses
 * of two standard deviations. */
import {
  BufferAttribute, BufferGeometry, CapsuleGeometry, CylinderGeometry, DynamicDrawUsage, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, RingGeometry, SphereGeometry,
} from "three";
import type {Material, Vector2Like} from "three";
import {mergeGeometries} from "three/examples/jsm/utils/BufferGeometryUtils.js";
import {Vision_Detection_Kind} from "../protocol/generated/remote_pb";
import type {State, Vision} from "../protocol/generated/remote_pb";
import type {Stage} from "../robot/stage";
import {ballOf, ellipseOf, placedOf, toOdometry} from "./seen";

const kBallRadius = 0.05;
const kMaxLines = 64;
const kMaxThings = 12;
/** Over the ground, so that they are not hidden in it, m. */
const kLineHeight = 0.006;
const kRingHeight = 0.004;

/** A thing with the ellipse of its uncertainty. */
class Mark {
  readonly object = new Group();
  private readonly ring: Mesh;

  constructor(readonly thing: Mesh, color: number) {
    this.ring = new Mesh(new RingGeometry(0.94, 1, 48),
                         new MeshBasicMaterial({color, transparent: true, opacity: 0.8, depthWrite: false}));
    this.ring.position.z = kRingHeight;
    this.object.add(thing, this.ring);
    this.object.visible = false;
  }

  show(place: Vector2Like, covariance: readonly number[], heading = 0): void {
    this.object.visible = true;
    this.object.position.set(place.x, place.y, 0);
    const ellipse = ellipseOf(covariance);
    this.ring.visible = ellipse !== null;
    if (!ellipse) return;
    this.ring.scale.set(Math.max(ellipse.a, 0.01), Math.max(ellipse.b, 0.01), 1);
    this.ring.rotation.z = heading + ellipse.angle;
  }
}

/** Parts of a robot that is seen, as fractions of its height, over the ground and to its left: legs, trunk with arms, head. */
const kParts = [{radius: 0.08, length: 0.3, z: 0.23, y: 0.105}, {radius: 0.08, length: 0.3, z: 0.23, y: -0.105},
                {radius: 0.15, length: 0.16, z: 0.6, y: 0}, {radius: 0.053, length: 0.23, z: 0.58, y: 0.22},
                {radius: 0.053, length: 0.23, z: 0.58, y: -0.22}, {radius: 0.11, length: 0.02, z: 0.88, y: 0}];

/** A robot in outline, of one mesh and the height 1: which one it is, and how it stands, is not known. */
function figure(material: Material): Mesh {
  const mesh = new Mesh(mergeGeometries(kParts.map(({radius, length, z, y}) =>
      new CapsuleGeometry(radius, length, 4, 12).rotateX(Math.PI / 2).translate(0, y, z))), material);
  mesh.castShadow = true;
  return mesh;
}

/** A column from the ground up. */
function column(radius: number, height: number, material: Material): Mesh {
  const mesh = new Mesh(new CylinderGeometry(radius, radius, height, 20).rotateX(Math.PI / 2), material);
  mesh.position.z = height / 2;
  return mesh;
}

export class SeenObjects {
  private readonly group = new Group();
  private readonly ball: Mark;
  private readonly robots: Mark[] = [];
  private readonly posts: Mark[] = [];
  private readonly red = new MeshLambertMaterial({color: 0xd8595c});
  /** Of a robot that would hide the one that is driven. */
  private readonly glass = new MeshLambertMaterial({color: 0xd8595c, transparent: true, opacity: 0.3, depthWrite: false});
  private readonly lines: LineSegments;
  private readonly ends = new Float32Array(kMaxLines * 6);

  constructor(private readonly stage: Stage) {
    const sphere = new Mesh(new SphereGeometry(kBallRadius, 24, 16), new MeshLambertMaterial({color: 0xf4f4f4}));
    sphere.position.z = kBallRadius;
    this.ball = new Mark(sphere, 0xffb84d);
    const white = new MeshLambertMaterial({color: 0xf4f7f9});
    for (let i = 0; i < kMaxThings; i++) {
      this.robots.push(new Mark(figure(this.red), 0xff6a6a));
      this.posts.push(new Mark(column(0.05, 0.8, white), 0xf4f7f9));
    }
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(this.ends, 3).setUsage(DynamicDrawUsage));
    this.lines = new LineSegments(geometry, new LineBasicMaterial({color: 0x6cf0c0, transparent: true, opacity: 0.9}));
    this.lines.frustumCulled = false;
    this.group.add(this.ball.object, this.lines, ...this.robots.map(({object}) => object),
                   ...this.posts.map(({object}) => object));
    stage.robotAxes.add(this.group);
  }

  /** Where the ball is drawn, m in the odometry frame; null: not drawn. */
  get ballPlace(): Vector2Like | null {
    const {object} = this.ball;
    return object.visible ? {x: object.position.x, y: object.position.y} : null;
  }

  show(vision: Vision | null, state: State | null): void {
    const ball = ballOf(vision);
    this.ball.object.visible = ball !== null;
    if (ball) this.ball.show(ball, ball.covariance);
    this.showThings(this.robots, Vision_Detection_Kind.ROBOT, vision, state);
    // Robots that play with this one are as tall.
    for (const {thing} of this.robots) {
      thing.scale.setScalar(this.stage.robotHeight);
      thing.material = this.stage.isBeforeRobot(thing) ? this.glass : this.red;
    }
    this.showThings(this.posts, Vision_Detection_Kind.GOAL_POST, vision, state);
    this.showLines(vision, state);
    this.stage.outdate();
  }

  private showThings(marks: readonly Mark[], kind: Vision_Detection_Kind, vision: Vision | null,
                     state: State | null): void {
    const things = vision && state ? placedOf(vision, kind) : [];
    for (const [i, mark] of marks.entries()) {
      const thing = things[i];
      mark.object.visible = thing !== undefined;
      if (!thing || !state) continue;
      const [x = 0, y = 0] = thing.position;
      mark.show(toOdometry({x, y}, state), thing.covariance, this.stage.heading);
    }
  }

  private showLines(vision: Vision | null, state: State | null): void {
    const lines = vision && state ? placedOf(vision, Vision_Detection_Kind.LINE) : [];
    let count = 0;
    for (const {position: [x1 = 0, y1 = 0, x2, y2]} of lines.slice(0, kMaxLines)) {
      if (!state || x2 === undefined || y2 === undefined) continue;
      const from = toOdometry({x: x1, y: y1}, state);
      const to = toOdometry({x: x2, y: y2}, state);
      this.ends.set([from.x, from.y, kLineHeight, to.x, to.y, kLineHeight], 6 * count++);
    }
    this.lines.geometry.setDrawRange(0, 2 * count);
    this.lines.geometry.getAttribute("position").needsUpdate = true;
  }
}
