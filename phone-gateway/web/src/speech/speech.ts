/** Speech and lights: the sheet, what this phone plays, and the lights on the robot that is drawn. */
import type {Commander} from "../commander";
import {Say_Operation} from "../protocol/generated/remote_pb";
import type {Audio} from "../protocol/generated/remote_pb";
import {RobotLights} from "../robot/robot_lights";
import type {Stage} from "../robot/stage";
import {SpeechSheet} from "../screens/speech_sheet";
import type {Sound} from "../sound";
import type {Store} from "../store";
import {say} from "../text/texts";
import {AudioPlayer} from "./audio_player";
import {keepPhrase, loadSpeechSettings, saveSpeechSettings} from "./speech_settings";
import type {SpeechSettings} from "./speech_settings";

export class Speech {
  readonly sheet: SpeechSheet;
  private readonly player: AudioPlayer;
  private settings: SpeechSettings;
  private lights: RobotLights | null = null;

  /** @param subscribe  called when this phone begins or ends to play. */
  constructor(private readonly store: Store, commander: Commander, private readonly stage: Stage,
              private readonly storage: Storage | null, sound: Sound, subscribe: () => void) {
    this.player = new AudioPlayer(sound);
    this.settings = loadSpeechSettings(storage);
    this.sheet = new SpeechSheet(this.settings.isPlaying, {
      say: (text, language) => void commander.command({case: "say", value: {text, language}}),
      stop: () => void commander.command({case: "say", value: {operation: Say_Operation.STOP}}),
      setLights: (names, rgb) => void commander.command({case: "setLights", value: {lightNames: [...names], lightRgb: names.map(() => rgb)}}),
      keep: (phrase) => this.setPhrases(keepPhrase(this.phrases, phrase)),
      forget: (phrase) => this.setPhrases(this.phrases.filter((other) => other !== phrase)),
      setLanguage: (language) => this.keep({language}),
      setPlaying: (isPlaying) => {
        this.keep({isPlaying});
        if (!isPlaying) this.player.stop();
        subscribe();
      },
    });
    this.sheet.setPhrases(this.phrases);
    store.watch((state) => state.robot, (robot) => {
      this.sheet.setLanguages(robot?.languages ?? [], this.settings.language);
      this.sheet.setLights((robot?.lights ?? []).map(({name}) => name));
    });
    store.watch((state) => state.state, (state) => this.showLights(state?.lightRgb ?? []));
  }

  /** True if this phone plays what the robot says. */
  get isPlaying(): boolean {
    return this.settings.isPlaying;
  }

  play(audio: Audio): void {
    if (this.isPlaying) this.player.play(audio);
  }

  private get phrases(): readonly string[] {
    return this.settings.phrases ??
        [say("speech.phraseHello"), say("speech.phraseThanks"), say("speech.phrasePass")];
  }

  private setPhrases(phrases: readonly string[]): void {
    this.keep({phrases});
    this.sheet.setPhrases(phrases);
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

  private keep(settings: Partial<SpeechSettings>): void {
    this.settings = {...this.settings, ...settings};
    saveSpeechSettings(this.storage, this.settings);
  }
}
