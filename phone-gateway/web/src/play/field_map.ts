/** A small map of the field: where the robot takes itself to be, with its uncertainty, and the ball. It is there while
 * the robot is localised. */
import {el} from "../dom";
import type {State, Vision} from "../protocol/generated/remote_pb";
import type {FieldLines} from "../robot/floor";
import {say} from "../text/texts";
import {ballOf, ellipseOf, headingOf} from "./seen";
import type {Place} from "./seen";

/** px for a metre of the canvas, and carpet around the field, m. */
const kScale = 24;
const kBorder = 0.6;
const kRobotSize = 0.28;

export class FieldMap {
  readonly element = el("canvas", {class: "field-map", role: "img", "aria-label": say("play.map"), hidden: true});
  private lines: FieldLines | null = null;

  setField(lines: FieldLines): void {
    this.lines = lines;
    this.element.width = (lines.length + 2 * kBorder) * kScale;
    this.element.height = (lines.width + 2 * kBorder) * kScale;
  }

  show(vision: Vision | null, state: State | null): void {
    const pose = vision?.fieldPose;
    this.element.hidden = !pose || !this.lines;
    const context = this.element.getContext("2d");
    if (!pose || !this.lines || !context) return;
    this.drawField(context, this.lines);
    const ball = ballOf(vision);
    if (ball && state) {
      // From the odometry to the field, by the torso's place in both.
      const [torsoX = 0, torsoY = 0] = state.torsoPosition;
      const turn = pose.theta - headingOf(state.torsoOrientation);
      const dx = ball.x - torsoX;
      const dy = ball.y - torsoY;
      const place = {x: pose.x + Math.cos(turn) * dx - Math.sin(turn) * dy,
                     y: pose.y + Math.sin(turn) * dx + Math.cos(turn) * dy};
      context.fillStyle = "#ffb84d";
      this.disc(context, place, 0.12);
      context.fill();
    }
    const ellipse = ellipseOf(pose.covariance);
    if (ellipse) {
      const {x, y} = this.toCanvas(pose);
      context.fillStyle = "rgb(108 200 255 / 30%)";
      context.beginPath();
      context.ellipse(x, y, ellipse.a * kScale, ellipse.b * kScale, -ellipse.angle, 0, 2 * Math.PI);
      context.fill();
    }
    context.fillStyle = "#6cc8ff";
    context.beginPath();
    for (const angle of [0, 2.5, -2.5]) {
      const {x, y} = this.toCanvas({x: pose.x + kRobotSize * Math.cos(pose.theta + angle),
                                    y: pose.y + kRobotSize * Math.sin(pose.theta + angle)});
      context.lineTo(x, y);
    }
    context.fill();
  }

  /** The opponent's goal on the right. */
  private toCanvas({x, y}: Place): Place {
    const {length = 0, width = 0} = this.lines ?? {};
    return {x: (x + length / 2 + kBorder) * kScale, y: (width / 2 + kBorder - y) * kScale};
  }

  private disc(context: CanvasRenderingContext2D, place: Place, radius: number): void {
    const {x, y} = this.toCanvas(place);
    context.beginPath();
    context.arc(x, y, radius * kScale, 0, 2 * Math.PI);
  }

  private drawField(context: CanvasRenderingContext2D, lines: FieldLines): void {
    context.fillStyle = "#12322b";
    context.fillRect(0, 0, this.element.width, this.element.height);
    context.strokeStyle = "rgb(255 255 255 / 65%)";
    context.lineWidth = 2;
    const rectangle = (x1: number, x2: number, halfWidth: number): void => {
      const from = this.toCanvas({x: x1, y: halfWidth});
      const to = this.toCanvas({x: x2, y: -halfWidth});
      context.strokeRect(from.x, from.y, to.x - from.x, to.y - from.y);
    };
    const half = lines.length / 2;
    rectangle(-half, 0, lines.width / 2);
    rectangle(0, half, lines.width / 2);
    rectangle(-half, -half + lines.penaltyAreaLength, lines.penaltyAreaWidth / 2);
    rectangle(half - lines.penaltyAreaLength, half, lines.penaltyAreaWidth / 2);
    this.disc(context, {x: 0, y: 0}, lines.centreCircleDiameter / 2);
    context.stroke();
  }
}
