import {create} from "@bufbuild/protobuf";
import {Group, Mesh, PerspectiveCamera, Vector3} from "three";
import type {Material} from "three";
import {expect, it} from "vitest";
import {StateSchema, Vision_Detection_Kind, VisionSchema} from "../protocol/generated/remote_pb";
import {makeRobotAxes} from "../robot/frames";
import {Stage} from "../robot/stage";
import {SeenObjects} from "./seen_objects";

/** A stage without a canvas: the robot at the origin, the eye 2 m behind it. */
function makeStage(): Stage {
  const robotAxes = new Group();
  makeRobotAxes(robotAxes);
  const camera = new PerspectiveCamera();
  camera.position.set(-2, 0.5, 0);
  return Object.assign(Object.create(Stage.prototype) as object, {
    robotAxes, camera, robot: {torso: new Group()}, robotHeight: 0.6, place: new Vector3(), outdate: () => {}}) as unknown as Stage;
}

it("one sees through a robot that stands between the eye and the driven one", () => {
  const stage = makeStage();
  const objects = new SeenObjects(stage);
  const kind = Vision_Detection_Kind.ROBOT;
  objects.show(create(VisionSchema, {detections: [{kind, position: [1, 0]}, {kind, position: [-1, 0]}]}), create(StateSchema, {}));
  const isClear = new Map<number, boolean>();
  stage.robotAxes.traverse((object) => {
    if (object instanceof Mesh && object.castShadow && object.parent!.visible) isClear.set(object.parent!.position.x, (object.material as Material).transparent);
  });
  expect([...isClear]).toEqual([[1, false], [-1, true]]);
});
