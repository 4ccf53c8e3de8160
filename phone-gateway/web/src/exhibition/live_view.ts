/** The robot in 3D and the image of its head camera, for pages on which nobody drives. */
import {el} from "../dom";
import {Connection} from "../connection";
import {loadFieldLines} from "../robot/load_field";
import {RobotView} from "../robot/robot_view";
import {kJointsView, Stage} from "../robot/stage";
import type {Store} from "../store";
import {WebSocketTransport} from "../transport";

const kStateRateHz = 30;
const kImageRateHz = 10;
const kImageWidth = 640;

export class LiveView {
  readonly canvas = el("canvas", {class: "stage"});
  readonly image = el("img", {alt: "", class: "live-image", hidden: true});
  readonly connection: Connection;
  private readonly stage = new Stage(this.canvas);
  private readonly view: RobotView;
  private imageUrl = "";

  constructor(private readonly store: Store) {
    this.view = new RobotView(store, this.stage, () => {});
    this.stage.onFrame = (dt) => this.view.step(dt);
    this.stage.orbit.setView(kJointsView);
    this.connection = new Connection(new WebSocketTransport(new URL(location.href)), store, {
      connected: () => void this.connected(),
      state: (state) => {
        this.view.setTarget(state);
        store.set({state});
      },
      image: ({jpeg}) => this.showImage(jpeg as Uint8Array<ArrayBuffer>),
      notice: () => {},
    });
    void loadFieldLines(location.href).then((lines) => {
      if (lines) this.stage.floor.setField(lines);
      this.stage.outdate();
    });
  }

  private async connected(): Promise<void> {
    const camera = this.store.get().robot?.cameras[0] ?? "";
    void this.connection.request({case: "subscribe", value: {
      stateRate: kStateRateHz, imageRate: kImageRateHz, image: {camera, width: kImageWidth}}});
    this.stage.start();
    await this.view.showConnected();
  }

  private showImage(jpeg: Uint8Array<ArrayBuffer>): void {
    const before = this.imageUrl;
    this.imageUrl = URL.createObjectURL(new Blob([jpeg], {type: "image/jpeg"}));
    this.image.src = this.imageUrl;
    this.image.hidden = false;
    if (before) URL.revokeObjectURL(before);
  }
}
