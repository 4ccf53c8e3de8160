/** Speech and lights: the sheet, what this phone plays, and the lights on the robot that is drawn. */
import type {Commander} from "../commander";
import type {Audio} from "../protocol/generated/remote_pb";
import {RobotLights} from "../robot/robot_lights";
import type {Stage} from "../robot/stage";
import {SpeechSheet} from "../screens/speech_sheet";
import type {Sound} from "../sound";
import type {Store} from "../store";
import {AudioPlayer} from "./audio_player";
import {loadSpeechSettings, saveSpeechSettings} from "./speech_settings";

export class Speech {
  readonly sheet: SpeechSheet;
  private readonly player: AudioPlayer;
  private lights: RobotLights | null = null;

  /** @param subscribe  called when this phone begins or ends to play. */
  constructor(private readonly store: Store, commander: Commander, private readonly stage: Stage,
              storage: Storage | null, sound: Sound, subscribe: () => void) {
    this.player = new AudioPlayer(sound);
    store.set({speech: loadSpeechSettings(storage)});
    this.sheet = new SpeechSheet(store, commander, (change) =>
        store.set({speech: saveSpeechSettings(storage, {...store.get().speech, ...change})}));
    store.watch(({speech}) => speech.isPlaying, (isPlaying) => {
      if (!isPlaying) this.player.stop();
      subscribe();
    });
    store.watch(({state}) => state, (state) => this.showLights(state?.lightRgb ?? []));
  }

  play(audio: Audio): void {
    if (this.store.get().speech.isPlaying) this.player.play(audio);
  }

  private showLights(rgb: readonly number[]): void {
    const {robot} = this.store.get();
    const tree = this.stage.robot;
    if (!robot || !tree) return;
    if (this.lights?.tree !== tree) {
      this.lights?.dispose();
      this.lights = new RobotLights(tree, robot.lights);
    }
    if (this.lights.show(rgb)) this.stage.outdate();
  }
}
