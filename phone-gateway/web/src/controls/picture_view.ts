/** The head camera's picture. Decodes off the main thread; a picture that comes while the last one is
 * still being decoded is dropped, for a newer one follows. */
import {el, icon} from "../dom";
import type {Picture} from "../protocol/generated/remote_pb";
import {Camera} from "../protocol/generated/remote_pb";
import {say} from "../text/texts";

/** Fields of view of the head cameras, rad: a drag over the whole picture turns the head by as much, so
 * that what is under the finger stays there. Source: robot.yaml, cameras. */
const kHorizontalView = 1.062906;
const kVerticalView = 0.830777;
/** A touch that moves less is a tap, px. */
const kTapTravel = 8;
/** Not more often than this while dragging, ms. */
const kLookPeriodMs = 60;

const kCameraIcon = "M4 8h3l2-2h6l2 2h3v11H4zM12 16.5a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7z";

export class PictureView {
  readonly element: HTMLElement;
  /** Pictures drawn so far. */
  numPictures = 0;
  isLarge = false;
  camera: Camera = Camera.TOP;
  private readonly canvas = el("canvas", {width: 320, height: 240, "aria-hidden": "true"});
  private readonly cameraName = el("span");
  private readonly enlarge: HTMLButtonElement;
  private readonly switcher: HTMLButtonElement;
  private isBusy = false;
  private drag: {pointer: number; x: number; y: number; travel: number; sentMs: number} | null = null;

  /** @param wished  called when the person wants another camera or size.
   * @param look  called when the head shall turn: left and down, rad. */
  constructor(private readonly wished: () => void,
              private readonly look: (yaw: number, pitch: number) => void) {
    this.enlarge = el("button", {
      class: "picture-main",
      onclick: (event: MouseEvent) => this.clicked(event),
      onpointerdown: (event: PointerEvent) => this.dragStarts(event),
      onpointermove: (event: PointerEvent) => this.dragged(event),
      onpointerup: (event: PointerEvent) => this.lifted(event),
      onlostpointercapture: (event: PointerEvent) => this.dragged(event, true),
    },
                      this.canvas, el("span", {class: "picture-empty"}, say("drive.pictureWaiting")));
    this.switcher = el("button", {class: "picture-camera", onclick: () => this.switchCamera()},
                       el("span", {class: "picture-label"}, icon(kCameraIcon), this.cameraName));
    this.element = el("section", {class: "picture", "aria-label": say("drive.picture")},
                      this.enlarge, this.switcher);
    this.relabel();
  }

  show(picture: Picture): void {
    if (this.isBusy || picture.camera !== this.camera) return;
    this.isBusy = true;
    const blob = new Blob([picture.jpeg as Uint8Array<ArrayBuffer>], {type: "image/jpeg"});
    createImageBitmap(blob).then((bitmap) => this.draw(bitmap), () => {
      // Not a JPEG: the next picture may be.
    }).finally(() => this.isBusy = false);
  }

  private draw(bitmap: ImageBitmap): void {
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
    }
    this.canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
    bitmap.close();
    this.numPictures++;
    this.element.classList.add("has-picture");
  }

  private dragStarts(event: PointerEvent): void {
    this.enlarge.setPointerCapture(event.pointerId);
    this.drag = {pointer: event.pointerId, x: event.clientX, y: event.clientY, travel: 0, sentMs: 0};
  }

  private dragged(event: PointerEvent, isLast = false): void {
    const drag = this.drag;
    if (!drag || event.pointerId !== drag.pointer) return;
    const dx = event.clientX - drag.x;
    const dy = event.clientY - drag.y;
    if (drag.travel < kTapTravel) {
      drag.travel = Math.hypot(dx, dy);
    } else if (isLast || event.timeStamp - drag.sentMs > kLookPeriodMs) {
      drag.x = event.clientX;
      drag.y = event.clientY;
      drag.sentMs = event.timeStamp;
      if (dx !== 0 || dy !== 0) {
        this.look(dx / this.canvas.clientWidth * kHorizontalView,
                  -dy / this.canvas.clientHeight * kVerticalView);
      }
    }
    if (isLast) this.drag = null;
  }

  /** A tap is told by the finger's own way: browsers swallow the click of one that follows a drag at once. */
  private lifted(event: PointerEvent): void {
    if (this.drag && event.pointerId === this.drag.pointer && this.drag.travel < kTapTravel) this.toggleSize();
  }

  private clicked(event: MouseEvent): void {
    if (event.detail === 0) this.toggleSize(); // by keyboard
  }

  private toggleSize(): void {
    this.isLarge = !this.isLarge;
    this.element.classList.toggle("large", this.isLarge);
    this.relabel();
    this.wished();
  }

  private switchCamera(): void {
    this.camera = this.camera === Camera.TOP ? Camera.BOTTOM : Camera.TOP;
    this.relabel();
    this.wished();
  }

  private relabel(): void {
    this.enlarge.setAttribute("aria-label", say(this.isLarge ? "drive.shrink" : "drive.enlarge"));
    const name = say(this.camera === Camera.TOP ? "drive.cameraTop" : "drive.cameraBottom");
    this.switcher.setAttribute("aria-label", `${say("drive.camera")} (${name})`);
    this.cameraName.textContent = name;
  }
}
