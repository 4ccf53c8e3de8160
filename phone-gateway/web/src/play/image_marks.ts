/** Boxes of what the robot sees, over the camera's image; a button switches them on and off. */
import {button} from "../controls/press";
import {icon, shape} from "../dom";
import {Vision_Detection_Kind} from "../protocol/generated/remote_pb";
import type {Vision} from "../protocol/generated/remote_pb";
import type {Actions} from "../screens/actions";
import type {Store} from "../store";
import {say} from "../text/texts";

/** An analysed image is so much older than the shown one at most, ms; then its boxes disappear. */
const kShownMs = 700;
const kBoxesIcon = "M4 4h6M4 4v6M20 4h-6M20 4v6M4 20h6M4 20v-6M20 20h-6M20 20v-6M9 9h6v6H9z";
const kColors: {readonly [kind in Vision_Detection_Kind]?: string} = {
  [Vision_Detection_Kind.BALL]: "#ffb84d", [Vision_Detection_Kind.LINE]: "#6cf0c0",
  [Vision_Detection_Kind.GOAL_POST]: "#ffffff", [Vision_Detection_Kind.ROBOT]: "#ff6a6a",
};
/** Crossings, circle and mark of the field's lines. */
const kOtherColor = "#6cc8ff";

export class ImageMarks {
  /** In fractions of the image, which covers its place, or fits it where that has its shape. */
  private readonly marks = shape("g", {transform: "scale(4 3)"});
  readonly element = shape("svg", {class: "image-marks", viewBox: "0 0 4 3", preserveAspectRatio: "xMidYMid slice", "aria-hidden": "true"}, this.marks);
  readonly button: HTMLButtonElement;
  private timer: ReturnType<typeof setTimeout> | undefined;

  constructor(private readonly store: Store, act: Actions) {
    this.button = button({class: "image-boxes", hidden: true, "aria-label": say("play.boxes")},
                         () => act.keep({hasBoxes: !this.isOn}), icon(kBoxesIcon));
    store.watch((state) => state.settings.hasBoxes, (isOn) => {
      this.marks.replaceChildren();
      this.button.setAttribute("aria-pressed", String(isOn));
    });
  }

  private get isOn(): boolean {
    return this.store.get().settings.hasBoxes;
  }

  /** @param camera  whose image is shown. */
  show(vision: Vision | null, camera: string): void {
    // Where nothing is analysed there is nothing to switch.
    this.button.hidden = vision === null;
    if (vision && vision.camera !== camera) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.marks.replaceChildren(), kShownMs);
    this.marks.replaceChildren(...(this.isOn ? vision?.detections ?? [] : []).map(({kind, box, line}) => {
      const [x1 = 0, y1 = 0, x2 = 0, y2 = 0] = line.length === 4 ? line : box;
      const stroke = kColors[kind] ?? kOtherColor;
      return line.length === 4 ? shape("line", {x1, y1, x2, y2, stroke})
          : shape("rect", {x: x1, y: y1, width: x2 - x1, height: y2 - y1, stroke});
    }));
  }
}
