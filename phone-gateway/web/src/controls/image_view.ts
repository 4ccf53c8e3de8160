/** The head camera's image. Decodes off the main thread; an image that arrives while the previous one is
 * being decoded is dropped. */
import {el, icon, setHidden, setText} from "../dom";
import type {Image} from "../protocol/generated/remote_pb";
import {say, sayName} from "../text/texts";

/** The camera beside the field of a simulated world: no drag turns it. */
const kOverview = "overview";
/** Fields of view of the head cameras, rad: a drag over the whole image turns the head by this angle, so
 * that the point under the finger stays there. Source: robot.yaml, cameras. */
const kHorizontalView = 1.062906;
const kVerticalView = 0.830777;
/** A touch that moves less is a tap, px. */
const kTapTravel = 8;
/** Not more often than this while dragging, ms. */
const kLookPeriodMs = 60;

const kCameraIcon = "M4 8h3l2-2h6l2 2h3v11H4zM12 16.5a3.5 3.5 0 1 0 0-7 3.5 3.5 0 0 0 0 7z";

/** Ages of the image, ms: above the first it is shown on it, above the second the image is grey. Chosen: twice what a person
 * perceives as a delay; where nothing is driven by it (store.ts). */
const kShownAgeMs = 300;
const kGreyAgeMs = 500;

export class ImageView {
  readonly element: HTMLElement;
  /** A tap that this handles does not change the image's size. x, y: fractions of it; pageX, pageY: px on the page. */
  onTap: (x: number, y: number, pageX: number, pageY: number) => boolean = () => false;
  /** Called when it has become the large view, or the small one. */
  onSwap: (isLarge: boolean) => void = () => {};
  /** Images drawn so far. */
  numImages = 0;
  isLarge = false;
  /** Selected camera; empty before setCameras(). */
  camera = "";
  private cameras: readonly string[] = [];
  private readonly canvas = el("canvas", {width: 320, height: 240, "aria-hidden": "true"});
  private readonly empty = el("span", {class: "image-empty"}, say("drive.imageWaiting"));
  private readonly cameraName = el("span");
  private readonly age = el("span", {class: "image-age", hidden: true});
  private readonly enlarge: HTMLButtonElement;
  private readonly switcher: HTMLButtonElement;
  private isBusy = false;
  private drag: {pointer: number; x: number; y: number; travel: number; sentMs: number} | null = null;

  /** @param requestChanged  called when another camera or size is selected.
   * @param look  called with the head turn of a drag: left and down, rad. */
  constructor(private readonly requestChanged: () => void,
              private readonly look: (yaw: number, pitch: number) => void) {
    this.enlarge = el("button", {
      class: "image-main",
      // By keyboard.
      onclick: (event: MouseEvent) => event.detail === 0 && this.swap(),
      onpointerdown: (event: PointerEvent) => this.dragStarts(event),
      onpointermove: (event: PointerEvent) => this.dragged(event),
      onpointerup: (event: PointerEvent) => this.lifted(event),
      onlostpointercapture: (event: PointerEvent) => this.dragged(event, true),
    },
                      this.canvas, this.empty);
    this.switcher = el("button", {class: "image-camera", onclick: () => this.switchCamera()},
                       el("span", {class: "image-label"}, icon(kCameraIcon), this.cameraName));
    this.element = el("section", {class: "image", "aria-label": say("drive.image")},
                      this.enlarge, this.switcher, this.age);
    this.relabel();
  }

  /** Puts a drawing over the image, and a button on it. */
  addMarks(marks: Element, button: HTMLButtonElement): void {
    this.canvas.after(marks);
    this.element.append(button);
  }

  /** Sets the cameras of the connected robot; keeps the selected one if the robot has it. */
  setCameras(cameras: readonly string[]): void {
    // At a desk there is room to see as the robot does.
    if (this.cameras.length === 0 && cameras.length > 0 && !this.isLarge && getComputedStyle(this.element).getPropertyValue("--begins-large")) this.swap();
    this.cameras = cameras;
    if (!cameras.includes(this.camera)) this.camera = cameras[0] ?? "";
    this.relabel();
  }

  /** True: the last image stays, with the words that the camera sends none. */
  setOff(isOff: boolean): void {
    this.element.classList.toggle("off", isOff);
    this.empty.textContent = say(isOff ? "component.camera" : "drive.imageWaiting");
  }

  show(image: Image): void {
    if (this.isBusy || image.camera !== this.camera) return;
    this.isBusy = true;
    const blob = new Blob([image.jpeg as Uint8Array<ArrayBuffer>], {type: "image/jpeg"});
    createImageBitmap(blob).then((bitmap) => this.draw(bitmap), () => {
      // Not a JPEG: the next image may be.
    }).finally(() => this.isBusy = false);
  }

  /** @param ageMs  of the newest image, ms; negative: there is none. */
  showAge(ageMs: number): void {
    setHidden(this.age, ageMs < kShownAgeMs);
    if (!this.age.hidden) setText(this.age, say("drive.imageAge", {seconds: (ageMs / 1000).toFixed(1)}));
    const isOld = ageMs >= kGreyAgeMs;
    if (isOld !== this.element.classList.contains("old")) this.element.classList.toggle("old");
  }

  private draw(bitmap: ImageBitmap): void {
    if (this.canvas.width !== bitmap.width || this.canvas.height !== bitmap.height) {
      this.canvas.width = bitmap.width;
      this.canvas.height = bitmap.height;
    }
    this.canvas.getContext("2d")?.drawImage(bitmap, 0, 0);
    bitmap.close();
    this.numImages++;
    if (this.numImages === 1) this.element.classList.add("has-image");
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
      if ((dx !== 0 || dy !== 0) && this.camera !== kOverview) {
        this.look(dx / this.canvas.clientWidth * kHorizontalView,
                  -dy / this.canvas.clientHeight * kVerticalView);
      }
    }
    if (isLast) this.drag = null;
  }

  /** Detects a tap by the finger's travel: browsers suppress the click of a tap right after a drag. */
  private lifted(event: PointerEvent): void {
    if (!this.drag || event.pointerId !== this.drag.pointer || this.drag.travel >= kTapTravel) return;
    const box = this.canvas.getBoundingClientRect();
    const {clientX, clientY} = event;
    if (!this.onTap((clientX - box.left) / box.width, (clientY - box.top) / box.height, clientX, clientY)) this.swap();
  }

  /** The large view becomes the small one, and the other way round. */
  swap(): void {
    this.isLarge = !this.isLarge;
    this.element.classList.toggle("large", this.isLarge);
    this.relabel();
    this.onSwap(this.isLarge);
    this.requestChanged();
  }

  private switchCamera(): void {
    const next = (this.cameras.indexOf(this.camera) + 1) % this.cameras.length;
    this.camera = this.cameras[next] ?? "";
    this.relabel();
    this.requestChanged();
  }

  private relabel(): void {
    this.enlarge.setAttribute("aria-label", say(this.isLarge ? "drive.shrink" : "drive.enlarge"));
    const name = sayName("camera", this.camera);
    this.switcher.hidden = this.cameras.length < 2;
    this.switcher.setAttribute("aria-label", `${say("drive.camera")} (${name})`);
    this.cameraName.textContent = name;
  }
}
