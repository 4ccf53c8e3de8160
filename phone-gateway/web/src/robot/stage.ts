/** The 3D stage: robot, ground, light, eye. Draws one frame per animation frame while something moves, and
 * nothing while all stands still: a phone's battery, and the next movement, have the gain. */
import {
  ACESFilmicToneMapping, DirectionalLight, Group, HemisphereLight, PCFShadowMap,
  PerspectiveCamera, Plane, Raycaster, Scene, Vector2, Vector3, WebGLRenderer,
} from "three";
import type {Object3D} from "three";
import type {JointGroup} from "../protocol/generated/remote_pb";
import {openDrawingContext} from "./drawing_context";
import {Floor} from "./floor";
import {headingOf, makeRobotAxes, robotToScene} from "./frames";
import {Orbit} from "./orbit";
import type {View} from "./orbit";
import {PixelBudget} from "./pixel_budget";
import {calcHeight, kUnknownHeight} from "./robot_height";
import {groupAt} from "./link_at";
import type {PostureFigure} from "./posture_figure";
import type {Postures} from "./posture_file";
import {RobotSurface} from "./robot_surface";
import type {RobotTree} from "./robot_tree";
import type {SmoothEdges} from "./smooth_edges";

/** View over the right shoulder, from behind: the robot's forward direction is up on the screen. */
export const kDriveView: View = {azimuth: -0.42, elevation: 0.30};
/** Face to face. */
export const kJointsView: View = {azimuth: Math.PI - 0.35, elevation: 0.14};

const kFieldOfViewDeg = 32;
/** Device pixels per CSS pixel at the least. Below the first, pixels are seen as squares; a processor that draws
 * smooths the edges of larger ones. */
const kMinPixelRatio = 0.75;
const kSoftwarePixelRatio = 0.75;
const kMinSoftwarePixelRatio = 0.42;
/** Time between two frames at the least where a processor draws, ms: two of the screen's, 30 a second. More would take what
 * simulates the robot, perhaps on the same processor. */
const kSoftwareFramePeriodMs = 30;
/** The same where that is too much. */
const kSlowFramePeriodMs = 50;
/** Where a processor draws, what stands still for so long, ms, is drawn once more with so many pixels: smooth edges. */
const kRestMs = 500;
const kRestPixelRatio = 1.5;
/** The eye has moved if it did so by more than this, m. */
const kSeenMove = 0.0002;
/** A movement's first frame goes as far as any other, s. */
const kWakeTime = 1 / 60;
/** What shall fit the free part of the screen, in heights of the robot: all of it with some air, arms stretched. */
const kShownHeight = 1.15;
const kShownWidth = 0.87;
/** The point looked at: so high over the ground, in heights of the robot, and more by a part of the torso's height:
 * it is lower when the robot lies or sits, but not on the ground. */
const kFocusHeight = 0.28;
const kFocusShare = 0.35;
/** The sun from the robot, and how far around the robot shadows reach, in heights of the robot. */
const kSunBehind = 1;
const kSunLeft = 1.9;
const kSunAbove = 3.8;
const kShadowReach = 1.2;
const kShadowDepth = 7;

const kGround = new Plane(new Vector3(0, 1, 0));

export class Stage {
  readonly orbit = new Orbit(kDriveView);
  readonly floor = new Floor();
  readonly camera = new PerspectiveCamera(kFieldOfViewDeg, 1, 0.05, 20);
  /** Called at each animation frame with the time since the last one, s. Returns whether something moved. */
  onFrame: (dt: number) => boolean = () => false;
  /** What the robot's links are made of. */
  readonly surface: RobotSurface;
  /** Frames drawn so far. */
  numFrames = 0;

  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  /** Everything in here is given in the robot's axes. */
  readonly robotAxes = new Group();
  private readonly sun = new DirectionalLight(0xfff2e0, 2.6);
  private edges: SmoothEdges | null = null;
  private readonly budget: PixelBudget;
  private readonly framePeriodMs: number;
  /** The robot that is shown; null before the first. Only read by others, as its height, m. */
  robot: RobotTree | null = null;
  robotHeight = kUnknownHeight;
  private lastFrameMs = 0;
  private isRunning = false;
  private drawnMs = -Infinity;
  private isOutdated = true;
  private isChanging = false;
  private isAhead = false;
  private isSharp = false;
  private width = 1;
  private height = 1;
  private freeArea: DOMRect | null = null;
  private readonly eye = new Vector3();
  private readonly drawnEye = new Vector3();
  private readonly drawnFocus = new Vector3();
  private readonly place = new Vector3();

  constructor(readonly canvas: HTMLCanvasElement) {
    const {gl, isSoftware} = openDrawingContext(canvas);
    this.renderer = new WebGLRenderer({canvas, context: gl, alpha: true});
    this.surface = new RobotSurface(isSoftware);
    this.framePeriodMs = isSoftware ? kSoftwareFramePeriodMs : 0;
    this.budget = isSoftware ? new PixelBudget(kSoftwarePixelRatio, kMinSoftwarePixelRatio)
        : new PixelBudget(Math.min(window.devicePixelRatio, 2), kMinPixelRatio);
    this.renderer.toneMapping = ACESFilmicToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    makeRobotAxes(this.robotAxes);
    this.addLights();
    this.scene.add(this.robotAxes, this.floor.object);
    this.takeColors();
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  setRobot(robot: RobotTree): void {
    if (this.robot) this.robotAxes.remove(this.robot.torso);
    this.robot = robot;
    this.robotHeight = calcHeight(robot.torso);
    this.robotAxes.add(robot.torso);
    this.fitShadow();
    this.frameRobot();
  }

  /** The ground has the colors of the style sheet. */
  takeColors(): void {
    const style = getComputedStyle(document.documentElement);
    this.floor.setColors(style.getPropertyValue("--turf"), style.getPropertyValue("--turf-line"));
    this.outdate();
  }

  /** Something else than the robot's pose or the eye looks different: the next frame is drawn. */
  outdate(): void {
    this.isOutdated = true;
  }

  start(): void {
    if (this.isRunning) return;
    this.isRunning = true;
    this.lastFrameMs = performance.now();
    requestAnimationFrame(this.frame);
  }

  stop(): void {
    this.isRunning = false;
  }

  /** What is shown may have begun to move: draws at once if all stood still, for the browser shows with its
   * next frame what is drawn by then. */
  wake(): void {
    if (!this.isRunning || this.isChanging) return;
    this.advance(performance.now(), kWakeTime);
    this.isAhead = this.isChanging;
  }

  private readonly frame = (nowMs: number): void => {
    if (!this.isRunning) return;
    requestAnimationFrame(this.frame);
    // Drawn already, by wake(): once more would hold it up.
    if (!this.isAhead) this.advance(nowMs, 0);
    this.isAhead = false;
  };

  /** One frame. @param leastTime  it counts as at least so long, s. */
  private advance(nowMs: number, leastTime: number): void {
    const dt = Math.max(leastTime, Math.min(Math.max(nowMs - this.lastFrameMs, 0), 100) / 1000);
    this.lastFrameMs = nowMs;
    const hasMoved = this.onFrame(dt);
    this.followRobot(dt);
    // The pause before a movement says nothing about how long a frame takes.
    if (this.isChanging && this.budget.frame(dt)) this.resize();
    this.isOutdated ||= hasMoved || this.hasEyeMoved();
    this.isChanging = this.isOutdated;
    const period = this.framePeriodMs > 0 && this.budget.isLeast ? kSlowFramePeriodMs : this.framePeriodMs;
    if (this.isOutdated && nowMs - this.drawnMs >= period) this.draw(nowMs);
    else if (this.framePeriodMs > 0 && !this.isSharp && nowMs - this.drawnMs > kRestMs) this.draw(nowMs, true);
  }

  /** @param isSharp  with the pixels of what stands still. */
  private draw(nowMs: number, isSharp = false): void {
    if (isSharp !== this.isSharp) {
      this.isSharp = isSharp;
      this.renderer.setPixelRatio(isSharp ? kRestPixelRatio : this.budget.pixelRatio);
    }
    this.isOutdated = false;
    this.drawnMs = nowMs;
    this.drawnEye.copy(this.camera.position);
    this.drawnFocus.copy(this.eye);
    this.renderer.render(this.scene, this.camera);
    if (this.robot && !isSharp && this.hasFewPixels) this.edges?.draw(this.renderer, this.robot.torso, this.camera);
    this.numFrames++;
  }

  private hasEyeMoved(): boolean {
    return this.camera.position.distanceTo(this.drawnEye) > kSeenMove ||
        this.eye.distanceTo(this.drawnFocus) > kSeenMove;
  }

  private followRobot(dt: number): void {
    if (this.robot) {
      const {position} = this.robot.torso;
      this.orbit.follow(position.x, position.y, kFocusHeight * this.robotHeight + kFocusShare * position.z,
                        this.heading, dt);
      this.floor.moveTo(position.x, position.y);
      robotToScene(position.x, position.y, 0, this.sun.target.position);
      robotToScene(position.x - kSunBehind * this.robotHeight, position.y + kSunLeft * this.robotHeight,
                   kSunAbove * this.robotHeight, this.sun.position);
    }
    this.orbit.eye(this.eye);
    robotToScene(this.eye.x, this.eye.y, this.eye.z, this.camera.position);
    this.camera.lookAt(robotToScene(this.orbit.x, this.orbit.y, this.orbit.z, this.eye));
  }

  private addLights(): void {
    this.scene.add(new HemisphereLight(0xcfe4ff, 0x24303a, 1.5));
    const rim = new DirectionalLight(0x7fb4ff, 0.9);
    rim.position.set(2, 1.2, 1.5);
    this.sun.shadow.mapSize.set(1024, 1024);
    this.sun.shadow.radius = 4;
    this.sun.shadow.bias = -0.0008;
    this.fitShadow();
    this.scene.add(this.sun, this.sun.target, rim);
  }

  private fitShadow(): void {
    const {camera} = this.sun.shadow;
    const reach = kShadowReach * this.robotHeight;
    camera.left = camera.bottom = -reach;
    camera.right = camera.top = reach;
    camera.near = 0.5 * this.robotHeight;
    camera.far = kShadowDepth * this.robotHeight;
    camera.updateProjectionMatrix();
  }

  private resize(): void {
    const {clientWidth, clientHeight} = this.canvas;
    this.width = Math.max(clientWidth, 1);
    this.height = Math.max(clientHeight, 1);
    this.isSharp = false;
    this.renderer.setPixelRatio(this.budget.pixelRatio);
    this.renderer.setSize(this.width, this.height, false);
    // Where it is fetched in vain the edges are as they are.
    if (this.hasFewPixels) void import("./smooth_edges").then(({SmoothEdges}) => this.edges ??= new SmoothEdges(), () => {});
    const hasShadow = this.framePeriodMs === 0 && !this.budget.isLeast;
    this.renderer.shadowMap.enabled = this.sun.castShadow = this.floor.shadow.visible = hasShadow;
    this.camera.aspect = this.width / this.height;
    // The canvas is empty now.
    this.drawnMs = -Infinity;
    this.frameRobot();
  }

  /** Only where a processor draws. */
  private get hasFewPixels(): boolean {
    return this.budget.pixelRatio < kSoftwarePixelRatio;
  }

  /** A drawing of each posture. */
  drawPostures(figure: PostureFigure, postures: Postures): Promise<Map<string, HTMLCanvasElement>> {
    return figure.draw(this.renderer, postures, !this.surface.isPlain);
  }

  /** Joint group that moves the part of the robot under a point, px from the top left; empty if there is none. */
  groupAt(x: number, y: number, groups: readonly JointGroup[]): string {
    return this.robot ? groupAt(this.robot, groups, this.rayAt(x, y), this.robotHeight) : "";
  }

  /** Places the robot in the middle of an area, px from the canvas's top left, as large as fits; null: of all. */
  setFreeArea(area: DOMRect | null): void {
    this.freeArea = area;
    this.frameRobot();
  }

  /** Heading of the robot shown, rad. */
  get heading(): number {
    const q = this.robot?.torso.quaternion;
    return q ? headingOf([q.w, q.x, q.y, q.z]) : 0;
  }

  /** The ray from the eye through a point of the canvas, px from the top left. */
  readonly rayAt = (x: number, y: number): Raycaster => {
    const ray = new Raycaster();
    ray.setFromCamera(new Vector2(2 * x / this.width - 1, 1 - 2 * y / this.height), this.camera);
    return ray;
  };

  /** Where a point of the scene is on the canvas, px from its top left. @param point  is changed. */
  readonly onCanvas = (point: Vector3): [number, number] => {
    const {x, y} = point.project(this.camera);
    return [(x + 1) / 2 * this.width, (1 - y) / 2 * this.height];
  };

  /** True for what stands nearer to the eye than the robot. */
  isBeforeRobot(object: Object3D): boolean {
    const distance = (one: Object3D) => one.getWorldPosition(this.place).distanceTo(this.camera.position);
    return this.robot !== null && distance(object) < distance(this.robot.torso);
  }

  /** A point of the canvas on the page, px from its top left. */
  onPage(x: number, y: number): [number, number] {
    const {left, top} = this.canvas.getBoundingClientRect();
    return [left + x, top + y];
  }

  /** The spot on the ground under a point of the canvas, m in the robot's axes; null above the horizon.
   * @param x,y  px from the top left. */
  groundAt(x: number, y: number): {x: number; y: number} | null {
    const hit = this.rayAt(x, y).ray.intersectPlane(kGround, new Vector3());
    return hit && {x: hit.x, y: -hit.z};
  }

  private frameRobot(): void {
    const {width, height, camera} = this;
    const area = this.freeArea ?? new DOMRect(0, 0, width, height);
    const freeWidth = Math.max(area.width, 0.2 * width);
    const freeHeight = Math.max(area.height, 0.2 * height);
    const pixelsPerMetre = Math.min(freeWidth / (kShownWidth * this.robotHeight),
                                    freeHeight / (kShownHeight * this.robotHeight));
    const tangent = Math.tan((kFieldOfViewDeg * Math.PI) / 360);
    this.orbit.fitDistance = height / (2 * tangent * pixelsPerMetre);
    camera.setViewOffset(width, height, (width - area.left - area.right) / 2,
                         (height - area.top - area.bottom) / 2, width, height);
    camera.updateProjectionMatrix();
    this.outdate();
  }
}
