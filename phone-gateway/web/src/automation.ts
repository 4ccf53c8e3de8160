/** A window for tests and automation: what a person sees, as numbers. Reads only, so that a script
 * drives the app by its controls as a person does. */
import type {PictureView} from "./controls/picture_view";
import type {JointBalls} from "./robot/joint_balls";
import type {RobotTree} from "./robot/robot_tree";
import type {Stage} from "./robot/stage";
import type {AppState, Store} from "./store";

export interface Automation {
  /** What the app knows. */
  readonly state: Readonly<AppState>;
  /** Pictures drawn so far. */
  readonly numPictures: number;
  /** Frames drawn so far. */
  readonly numFrames: number;
  /** Angles that the 3D robot shows, rad, by joint name, mimics among them. */
  jointAngles(): Record<string, number>;
  /** Where the 3D robot's torso is, m, in the odometry frame. */
  torsoPosition(): [number, number, number];
  /** Where the balls of joints mode are on the page, px, by joint group. */
  ballPlaces(): Record<string, [number, number]>;
}

declare global {
  interface Window {
    naoRemote?: Automation;
  }
}

export function exposeAutomation(store: Store, stage: Stage, picture: PictureView,
                                 robot: () => RobotTree | null,
                                 balls: () => JointBalls | null): void {
  window.naoRemote = {
    get state() {
      return store.get();
    },
    get numPictures() {
      return picture.numPictures;
    },
    get numFrames() {
      return stage.numFrames;
    },
    jointAngles() {
      const tree = robot();
      const names = tree?.movingJoints() ?? [];
      return Object.fromEntries(names.map((name) => [name, tree!.jointAngle(name)]));
    },
    ballPlaces() {
      return balls()?.places(stage.camera, stage.size.width, stage.size.height) ?? {};
    },
    torsoPosition() {
      const position = robot()?.torso.position;
      return [position?.x ?? NaN, position?.y ?? NaN, position?.z ?? NaN];
    },
  };
}
