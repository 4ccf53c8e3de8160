/** Read-only view of the app for tests and automation. Scripts drive the app by its controls, as a
 * person does. */
import {Vector3} from "three";
import type {ImageView} from "./controls/image_view";
import type {SeenObjects} from "./play/seen_objects";
import {robotToScene} from "./robot/frames";
import type {RobotView} from "./robot/robot_view";
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
  /** Where the soccer ball is drawn, m, in the odometry frame; null: it is not. */
  soccerBall(): {x: number; y: number} | null;
  /** The point of the page where a spot on the ground is drawn, px. */
  pagePlace(x: number, y: number): [number, number];
  /** Positions of the balls of joints mode on the page, px, by joint group. */
  ballPlaces(): Record<string, [number, number]>;
}

declare global {
  interface Window {
    naoRemote?: Automation;
  }
}

export function exposeAutomation(store: Store, stage: Stage, image: ImageView, view: RobotView,
                                 seen: SeenObjects): void {
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
      const {tree} = view;
      const names = tree?.movingJoints() ?? [];
      return Object.fromEntries(names.map((name) => [name, tree!.jointAngle(name)]));
    },
    soccerBall() {
      return seen.ballPlace;
    },
    pagePlace(x, y) {
      const point = robotToScene(x, y, 0, new Vector3()).project(stage.camera);
      return stage.onPage((point.x + 1) / 2 * stage.size.width, (1 - point.y) / 2 * stage.size.height);
    },
    ballPlaces() {
      const places = view.balls?.places(stage.camera, stage.size.width, stage.size.height) ?? {};
      return Object.fromEntries(Object.entries(places).map(([group, place]) => [group, stage.onPage(...place)]));
    },
    torsoPosition() {
      const position = view.tree?.torso.position;
      return [position?.x ?? NaN, position?.y ?? NaN, position?.z ?? NaN];
    },
  };
}
