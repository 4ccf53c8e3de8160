/** Boxes of what the robot sees, over the camera's image; a button switches them on and off. */
import {onPress} from "../controls/press";
import {el, icon} from "../dom";
import {Vision_Detection_Kind} from "../protocol/generated/remote_pb";
import type {Vision} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

const kWidth = 640;
const kHeight = 480;
/** An analysed image is so much older than the shown one at most, ms; then its boxes disappear. */
const kShownMs = 700;
const kBoxesIcon = "M4 4h6M4 4v6M20 4h-6M20 4v6M4 20h6M4 20v-6M20 20h-6M20 20v-6M9 9h6v6H9z";

const kColors: Record<Vision_Detection_Kind, string> = {
  [Vision_Detection_Kind.BALL]: "#ffb84d",
  [Vision_Detection_Kind.LINE]: "#6cf0c0",
  [Vision_Detection_Kind.CROSSING_L]: "#6cc8ff",
  [Vision_Detection_Kind.CROSSING_T]: "#6cc8ff",
  [Vision_Detection_Kind.CROSSING_X]: "#6cc8ff",
  [Vision_Detection_Kind.CENTER_CIRCLE]: "#6cc8ff",
  [Vision_Detection_Kind.GOAL_POST]: "#ffffff",
  [Vision_Detection_Kind.ROBOT]: "#ff6a6a",
  [Vision_Detection_Kind.PENALTY_MARK]: "#6cc8ff",
};

export class ImageMarks {
  readonly canvas = el("canvas", {class: "image-marks", width: kWidth, height: kHeight, "aria-hidden": "true"});
  readonly button: HTMLButtonElement;
  private isOn: boolean;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** @param keep  remembers whether the boxes are shown. */
  constructor(isOn: boolean, private readonly keep: (isOn: boolean) => void) {
    this.isOn = isOn;
    this.button = el("button", {class: "image-boxes", hidden: true, "aria-label": say("play.boxes")}, icon(kBoxesIcon));
    onPress(this.button, () => this.toggle());
    this.relabel();
  }

  /** @param camera  whose image is shown. */
  show(vision: Vision | null, camera: string): void {
    // Where nothing is analysed there is nothing to switch.
    this.button.hidden = vision === null;
    if (vision && vision.camera !== camera) return;
    this.clear();
    if (!vision || !this.isOn) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.clear(), kShownMs);
    const context = this.canvas.getContext("2d");
    if (!context) return;
    context.lineWidth = 4;
    for (const {kind, box, line} of vision.detections) {
      context.strokeStyle = kColors[kind] ?? "#ffffff";
      const [left = 0, top = 0, right = 0, bottom = 0] = box;
      context.beginPath();
      if (line.length === 4) {
        context.moveTo(line[0]! * kWidth, line[1]! * kHeight);
        context.lineTo(line[2]! * kWidth, line[3]! * kHeight);
      } else {
        context.rect(left * kWidth, top * kHeight, (right - left) * kWidth, (bottom - top) * kHeight);
      }
      context.stroke();
    }
  }

  private clear(): void {
    this.canvas.getContext("2d")?.clearRect(0, 0, kWidth, kHeight);
  }

  private toggle(): void {
    this.isOn = !this.isOn;
    this.keep(this.isOn);
    this.clear();
    this.relabel();
  }

  private relabel(): void {
    this.button.setAttribute("aria-pressed", String(this.isOn));
  }
}
