/** The connected robot on the stage: loads it, lets it follow the state, and finds its balls. */
import {CommandKind} from "../protocol/generated/remote_pb";
import type {State} from "../protocol/generated/remote_pb";
import type {Store} from "../store";
import {JointBalls} from "./joint_balls";
import {LinkDrag} from "./link_drag";
import {loadRobot} from "./load_robot";
import {PoseMirror} from "./pose_mirror";
import {PostureFigure} from "./posture_figure";
import {loadPostures} from "./posture_file";
import type {Posture} from "./posture_file";
import type {RobotTree} from "./robot_tree";
import type {Stage} from "./stage";

/** So long a posture is shown before the robot takes it: later both would be in each other's way, ms. */
const kGhostMs = 1500;

export class RobotView {
  tree: RobotTree | null = null;
  balls: JointBalls | null = null;
  private figure: PostureFigure | null = null;
  private ghostTimer: ReturnType<typeof setTimeout> | undefined;
  private path = "";
  private mirror: PoseMirror | null = null;

  /** @param warn  called with the names of the meshes that cannot be drawn. */
  constructor(private readonly store: Store, private readonly stage: Stage,
              private readonly warn: (meshes: readonly string[]) => void) {
    store.watch((state) => state.isJointsMode, (isOn) => {
      this.balls?.show(isOn);
      stage.outdate();
    });
    store.watch((state) => state.state?.activity?.kind === CommandKind.POSTURE ? state.state.activity.name : "",
                (name) => this.showGhost(store.get().postures.get(name) ?? null));
    store.watch((state) => state.selectedGroup, (group) => {
      this.balls?.select(group);
      stage.outdate();
    });
  }

  /** True once the robot is drawn in its pose. */
  get hasPose(): boolean {
    return this.mirror?.hasPose ?? false;
  }

  /** Shows the robot of the description in the store. */
  async showConnected(): Promise<void> {
    const {robot} = this.store.get();
    if (robot && robot.urdfPath !== this.path) await this.load();
    else this.makeMirror();
  }

  /** Fetches the robot's files; the store knows how far it is, and why it failed. */
  async load(): Promise<void> {
    const path = this.store.get().robot?.urdfPath ?? "";
    this.store.set({loading: {done: 0, total: 0, error: ""}});
    let hasFailed = false;
    const missing: string[] = [];
    const isWanted = (): boolean => path === this.store.get().robot?.urdfPath && !hasFailed;
    try {
      const tree = await loadRobot(new URL(path, location.href), this.stage.surface, (done, total) => {
        if (isWanted()) this.store.set({loading: {done, total, error: ""}});
      }, (mesh) => missing.push(mesh));
      // Another robot was chosen meanwhile: its own loading shows it.
      if (!isWanted()) return;
      this.tree = tree;
      this.path = path;
      this.stage.setRobot(this.tree);
      void this.drawPostures(new PostureFigure(this.tree), new URL(path, location.href));
      this.balls = new JointBalls(this.tree, this.stage.surface, this.store.get().robot?.jointGroups ?? []);
      this.balls.show(this.store.get().isJointsMode);
      this.makeMirror();
      if (missing.length > 0) this.warn(missing);
    } catch (error) {
      // What is still on its way must not hide the error.
      hasFailed = true;
      const why = error instanceof Error ? error.message : String(error);
      this.store.set({loading: {done: 0, total: 0, error: why}});
    }
  }

  /** The posture that the robot goes to, where it stands. */
  private showGhost(posture: Posture | null): void {
    if (!this.figure || !this.tree) return;
    this.figure.standAt(posture, this.tree.torso, this.stage.heading);
    this.stage.outdate();
    clearTimeout(this.ghostTimer);
    if (posture) this.ghostTimer = setTimeout(() => this.showGhost(null), kGhostMs);
  }

  private async drawPostures(figure: PostureFigure, urdfUrl: URL): Promise<void> {
    const postures = await loadPostures(urdfUrl);
    if (figure.tree.urdf !== this.tree?.urdf) return;
    this.figure?.standAt(null, this.tree.torso, 0);
    this.store.set({postures, drawings: await this.stage.drawPostures(figure, postures)});
    figure.becomeGhost(this.stage.robotAxes);
    this.figure = figure;
  }

  setTarget(state: State): void {
    this.mirror?.setTarget(state);
    this.stage.wake();
  }

  /** @param dt  s since the last frame. @return true if the robot looks different from the last frame. */
  step(dt: number): boolean {
    const hasMoved = this.mirror?.step(dt) ?? false;
    if (hasMoved) this.balls?.update();
    return hasMoved;
  }

  /** Group of the ball under a finger; empty if there is none. @param x,y  px from the canvas's top left. */
  ballAt(x: number, y: number): string {
    return this.balls?.pick(x, y, this.stage) ?? "";
  }

  /** The link of the ball under a finger, if it is one of `groups`. */
  holdBall(x: number, y: number, groups: readonly string[]): {link: string; drag: LinkDrag} | null {
    const group = this.ballAt(x, y);
    const link = groups.includes(group) ? this.balls?.linkOf(group) : null;
    return !link || !this.tree ? null : {link: link.name, drag: new LinkDrag(link, this.tree.torso, this.stage, x, y)};
  }

  private makeMirror(): void {
    const {robot, state} = this.store.get();
    if (!robot || !this.tree) return;
    this.mirror = new PoseMirror(this.tree, robot.joints);
    if (state) this.mirror.setTarget(state);
  }
}
