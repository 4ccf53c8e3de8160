/** Where things are that the robot sees; pure. */
import {Vector2} from "three";
import type {Vector2Like} from "three";
import {Vision_Detection_Kind} from "../protocol/generated/remote_pb";
import type {State, Vision, Vision_Detection} from "../protocol/generated/remote_pb";
import {headingOf} from "../robot/frames";

/** Size of the ellipses that show an uncertainty, in standard deviations: they hold 86 % of all places. */
const kSigmas = 2;
/** A finger meets a ball in the image within its box and this fraction of the image around it. */
const kImageReach = 0.04;
/** A finger meets a ball on the ground within this distance, m. */
const kGroundReach = 0.25;
/** A ball that was not seen for this long is not shown, s. */
const kShownAge = 5;

/** @param covariance  xx, xy, yy, m^2; empty: unknown.
 * @return half axes a and b, m, and the direction of the first one, rad; null if it is unknown. */
export function ellipseOf(covariance: readonly number[]) {
  const [xx, xy, yy] = covariance;
  if (xx === undefined || xy === undefined || yy === undefined) return null;
  // Eigenvalues of a symmetric 2x2 matrix: mean +- root((xx - yy)^2 / 4 + xy^2).
  const mean = (xx + yy) / 2;
  const root = Math.hypot((xx - yy) / 2, xy);
  return {
    a: kSigmas * Math.sqrt(Math.max(mean + root, 0)),
    b: kSigmas * Math.sqrt(Math.max(mean - root, 0)),
    angle: Math.atan2(2 * xy, xx - yy) / 2,
  };
}

/** A place ahead and left of the torso, m, in the odometry frame. */
export function toOdometry({x, y}: Vector2Like, state: State): Vector2Like {
  const [torsoX = 0, torsoY = 0] = state.torsoPosition;
  return new Vector2(x, y).rotateAround(new Vector2(), headingOf(state.torsoOrientation)).add({x: torsoX, y: torsoY});
}

/** The tracked ball, if it was seen lately. */
export function ballOf(vision: Vision | null): NonNullable<Vision["ball"]> | null {
  return vision?.ball && vision.ball.age < kShownAge ? vision.ball : null;
}

/** Whether a ball is seen at a point of the image. @param x,y  fractions of its size. */
export function isBallInImage(vision: Vision | null, x: number, y: number): boolean {
  return (vision?.detections ?? []).some(({kind, box}) => {
    const [left = 1, top = 1, right = 0, bottom = 0] = box;
    return kind === Vision_Detection_Kind.BALL && x > left - kImageReach && x < right + kImageReach &&
        y > top - kImageReach && y < bottom + kImageReach;
  });
}

/** Whether the tracked ball lies at a spot, m in the odometry frame. */
export function isBallAt(vision: Vision | null, spot: Vector2Like): boolean {
  const ball = ballOf(vision);
  return ball !== null && Math.hypot(spot.x - ball.x, spot.y - ball.y) < kGroundReach;
}

/** Objects of a kind whose place is known. */
export function placedOf(vision: Vision, kind: Vision_Detection_Kind): Vision_Detection[] {
  return vision.detections.filter((seen) => seen.kind === kind && seen.position.length >= 2);
}
