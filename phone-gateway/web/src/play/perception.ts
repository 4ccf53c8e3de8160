/** What the robot sees, wherever the app shows it: on the stage, over the image, on the map; and taps on the ball. */
import type {ImageView} from "../controls/image_view";
import {Offer} from "../controls/offer";
import {Play_Behavior} from "../protocol/generated/remote_pb";
import type {Stage} from "../robot/stage";
import type {Actions} from "../screens/actions";
import type {Store} from "../store";
import {say} from "../text/texts";
import {FieldMap} from "./field_map";
import {ImageMarks} from "./image_marks";
import type {PlayStrip} from "./play_strip";
import {behaviorName} from "./play_words";
import {isBallAt, isBallInImage} from "./seen";
import {SeenObjects} from "./seen_objects";

export class Perception {
  readonly map = new FieldMap();
  readonly choice: Offer;
  readonly objects: SeenObjects;
  private readonly marks: ImageMarks;

  constructor(private readonly store: Store, private readonly stage: Stage, image: ImageView, play: PlayStrip, act: Actions) {
    this.objects = new SeenObjects(stage);
    this.marks = new ImageMarks(store, act);
    this.choice = new Offer("ball-choice", say("play.ball"), [Play_Behavior.GO_TO_BALL, Play_Behavior.KICK].map((behavior) => {
      const name = behaviorName(behavior);
      return {name, label: say(`play.${name}`), act: () => play.begin(behavior)};
    }));
    image.addMarks(this.marks.element, this.marks.button);
    image.onTap = (x, y, pageX, pageY) => this.canPlay && isBallInImage(this.store.get().vision, x, y) &&
        this.offer(pageX, pageY + 60);
    store.watch((state) => state.vision, (vision) => {
      this.objects.show(vision, store.get().state);
      this.marks.show(vision, image.camera);
      this.map.show(vision, store.get().state);
    });
    store.watch((state) => state.playState?.behavior ?? Play_Behavior.NONE, () => this.choice.clear());
  }

  /** A tap on the stage, px from its top left. @return true if it met the ball. */
  tapped(x: number, y: number): boolean {
    this.choice.clear();
    const spot = this.stage.groundAt(x, y);
    return this.canPlay && spot !== null && isBallAt(this.store.get().vision, spot) &&
        this.offer(...this.stage.onPage(x, y));
  }

  private get canPlay(): boolean {
    return this.store.get().playState !== null;
  }

  private offer(x: number, y: number): true {
    this.choice.show(x, y, window.innerWidth);
    return true;
  }
}
