/** Read-only view of the app for tests and automation. Scripts drive the app by its controls, as a
 * person does. */
import type {ImageView} from "./controls/image_view";
import type {JointBalls} from "./robot/joint_balls";
import type {RobotTree} from "./robot/robot_tree";
import type {Stage} from "./robot/stage";
import type {AppState, Store} from "./store";
import {kModeNames} from "./text/activity";

export interface Automation {
  /** State of the app. */
  readonly state: Readonly<AppState>;
  /** Mode of the robot: "walking"; empty before the first state. */
  readonly mode: string;
  /** Images drawn so far. */
  readonly numImages: number;
  /** Frames drawn so far. */
  readonly numFrames: number;
  /** Angles that the 3D robot shows, rad, by joint name, mimics among them. */
  jointAngles(): Record<string, number>;
  /** Position of the 3D robot's torso, m, in the odometry frame. */
  torsoPosition(): [number, number, number];
  /** Positions of the balls of joints mode on the page, px, by joint group. */
  ballPlaces(): Record<string, [number, number]>;
}

declare global {
  interface Window {
    naoRemote?: Automation;
  }
}

export function exposeAutomation(store: Store, stage: Stage, image: ImageView,
                                 robot: () => RobotTree | null,
                                 balls: () => JointBalls | null): void {
  window.naoRemote = {
    get state() {
      return store.get();
    },
    get mode() {
      const {state} = store.get();
      return state ? kModeNames[state.mode] : "";
    },
    get numImages() {
      return image.numImages;
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
