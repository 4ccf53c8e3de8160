/** Read-only view of the app for tests and automation. Scripts drive the app by its controls, as a
 * person does. */
import {Vector3} from "three";
import type {ImageView} from "./controls/image_view";
import type {SeenObjects} from "./play/seen_objects";
import {robotToScene} from "./robot/frames";
import {Mode} from "./protocol/generated/remote_pb";
import {nameOf} from "./protocol/names";
import type {RobotView} from "./robot/robot_view";
import type {Stage} from "./robot/stage";
import type {Store} from "./store";

declare global {
  interface Window {
    naoRemote?: ReturnType<typeof automationOf>;
  }
}

export function automationOf(store: Store, stage: Stage, image: ImageView, view: RobotView, seen: SeenObjects) {
  return {
    /** State of the app. */
    get state() {
      return store.get();
    },
    /** Mode of the robot: "walking"; empty before the first state. */
    get mode() {
      const {state} = store.get();
      return state ? nameOf(Mode, state.mode, "no-robot") : "";
    },
    /** Images drawn so far. */
    get numImages() {
      return image.numImages;
    },
    /** Frames drawn so far. */
    get numFrames() {
      return stage.numFrames;
    },
    /** Angles that the 3D robot shows, rad, by joint name, mimics among them. */
    jointAngles: () => Object.fromEntries((view.tree?.movingJoints() ?? []).map((name) => [name, view.tree!.jointAngle(name)])),
    /** Position of the 3D robot's torso, m, in the odometry frame. */
    torsoPosition: () => view.tree?.torso.position.toArray() ?? [NaN, NaN, NaN],
    /** Where the soccer ball is drawn, m, in the odometry frame; null: it is not. */
    soccerBall: () => seen.ballPlace,
    /** The point of the page where a spot on the ground is drawn, px. */
    pagePlace: (x: number, y: number) => stage.onPage(...stage.onCanvas(robotToScene(x, y, 0, new Vector3()))),
    /** Positions of the balls of joints mode on the page, px, by joint group. */
    ballPlaces: () => Object.fromEntries((view.balls?.places(stage) ?? []).map(([group, place]) => [group, stage.onPage(...place)])),
  };
}
