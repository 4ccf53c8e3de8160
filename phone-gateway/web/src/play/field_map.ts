/** A small map of the field: where the robot takes itself to be, with its uncertainty, and the ball. It is there while
 * the robot is localised. Drawn in meters of the field, the opponent's goal on the right. */
import {shape} from "../dom";
import type {State, Vision} from "../protocol/generated/remote_pb";
import type {FieldLines} from "../robot/load_field";
import {headingOf} from "../robot/frames";
import {say} from "../text/texts";
import {ballOf, ellipseOf} from "./seen";

/** Carpet around the field, and half the length of the arrow that stands for the robot, m. */
const kBorder = 0.6;
const kRobotSize = 0.28;
const kBallRadius = 0.12;

export class FieldMap {
  readonly element = shape("svg", {class: "field-map", role: "img", "aria-label": say("play.map"), hidden: ""});
  /** What moves on it; y is up. */
  private readonly things = shape("g", {transform: "scale(1 -1)"});
  private hasField = false;

  setField({length, width, lineWidth, centreCircleDiameter, penaltyAreaLength, penaltyAreaWidth}: FieldLines): void {
    const box = (x: number, boxLength: number, boxWidth: number) =>
        shape("rect", {x, y: -boxWidth / 2, width: boxLength, height: boxWidth});
    this.element.setAttribute("viewBox", [-length / 2 - kBorder, -width / 2 - kBorder, length + 2 * kBorder, width + 2 * kBorder].join(" "));
    this.element.replaceChildren(
      shape("g", {class: "lines", "stroke-width": 2 * lineWidth},
        box(-length / 2, length / 2, width), box(0, length / 2, width), box(-length / 2, penaltyAreaLength, penaltyAreaWidth),
        box(length / 2 - penaltyAreaLength, penaltyAreaLength, penaltyAreaWidth),
        shape("circle", {r: centreCircleDiameter / 2})), this.things);
    this.hasField = true;
  }

  show(vision: Vision | null, state: State | null): void {
    const pose = vision?.fieldPose;
    this.element.toggleAttribute("hidden", !pose || !this.hasField);
    if (!pose || !this.hasField) return;
    const degrees = (angle: number) => angle * 180 / Math.PI;
    const ball = ballOf(vision);
    const [torsoX = 0, torsoY = 0] = state?.torsoPosition ?? [];
    const ellipse = ellipseOf(pose.covariance);
    const corners = [0, 2.5, -2.5].map((angle) => `${kRobotSize * Math.cos(angle)},${kRobotSize * Math.sin(angle)}`).join(" ");
    this.things.replaceChildren(shape("g", {transform: `translate(${pose.x} ${pose.y})`},
      ellipse && shape("ellipse", {rx: ellipse.a, ry: ellipse.b, transform: `rotate(${degrees(ellipse.angle)})`}),
      // From the odometry to the field, by the torso's place in both.
      ball && state && shape("circle", {cx: ball.x - torsoX, cy: ball.y - torsoY, r: kBallRadius,
                                        transform: `rotate(${degrees(pose.theta - headingOf(state.torsoOrientation))})`}),
      shape("polygon", {points: corners, transform: `rotate(${degrees(pose.theta)})`})));
  }
}
