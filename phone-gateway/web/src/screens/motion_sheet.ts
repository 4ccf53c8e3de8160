/** The sheet of motions: names, changes and saves the draft, and lists what is saved. Stop is at hand. */
import {iconButton, onPressDown} from "../controls/press";
import {Stepper} from "../controls/stepper";
import {el, icon} from "../dom";
import type {MotionFault, Store} from "../store";
import type {DraftEditor} from "../teach/draft_editor";
import {mirror, setRepetitions, setSpeed, timeOf, toMotion} from "../teach/motion_draft";
import type {MotionDraft} from "../teach/motion_draft";
import type {MotionHost} from "../teach/motion_host";
import {freeName, motionName} from "../teach/motion_name";
import type {Teach} from "../teach/teach";
import {say, sayName} from "../text/texts";
import {kCloseIcon, kMirrorIcon, kPlayIcon, kStopIcon, kUndoIcon} from "./icons";
import {KeyframeList, secondsInWords} from "./keyframe_list";
import {Note} from "./note";
import {SavedList} from "./saved_list";
import {sheet} from "./sheet";

const kSpeedStep = 0.1;

export class MotionSheet {
  readonly element: HTMLDialogElement;
  private readonly name = el("input", {name: "motion-name", maxlength: 40, autocomplete: "off", enterkeyhint: "done"});
  private readonly save = el("button", {class: "button primary", type: "submit"}, say("teach.save"));
  private readonly note = new Note();
  private readonly draft: HTMLElement;
  private readonly none = el("p", {class: "quiet"}, say("motion.none"));
  private readonly speed = new Stepper(say("motion.speed"), false, (direction) => this.changeSpeed(direction));
  private readonly repeat = new Stepper(say("motion.repeat"), false, (direction) =>
      this.editor.change(setRepetitions(this.editor.draft, this.editor.draft.repetitions + direction)));
  private readonly undo = iconButton("button small", kUndoIcon, say("motion.undo"), () => this.editor.undo());
  private readonly length = el("small", {class: "quiet"});
  private readonly isDraftShown = () => this.store.get().draft.keyframes.length > 0;

  constructor(private readonly store: Store, private readonly editor: DraftEditor, private readonly host: MotionHost,
              private readonly teach: Teach) {
    this.name.addEventListener("input", () => this.editor.note({...this.editor.draft, name: this.name.value}));
    this.draft = this.makeDraft();
    const saved = new SavedList(store, editor, host, () => this.element.close(), () => this.element.scrollTop = 0);
    const stop = el("button", {class: "button small stop-small"}, icon(kStopIcon), say("drive.stop"));
    onPressDown(stop, () => teach.stop());
    this.element = sheet("motions", say("motion.title"), stop, this.none, this.draft, saved.element);
    store.watch((state) => state.draft, (draft) => this.show(draft));
    store.watch((state) => state.canUndoDraft, () => this.show(store.get().draft));
    store.watch((state) => state.isCheckingMotion, (isChecking) => {
      this.save.disabled = isChecking;
      this.save.textContent = say(isChecking ? "teach.checking" : "teach.save");
    });
    store.watch((state) => state.motionFault, (fault) => this.showFault(fault));
  }

  open(): void {
    const {draft, savedMotions} = this.store.get();
    if (draft.keyframes.length > 0 && !draft.name) {
      const name = freeName(say("teach.draftName"), savedMotions);
      this.editor.note({...draft, name: name.replaceAll("-", " ")});
    }
    this.element.showModal();
    this.element.scrollTop = 0;
  }

  private makeDraft(): HTMLElement {
    const {editor, teach} = this;
    const form = el("form", {class: "motion-name", onsubmit: (event: Event) => {
      event.preventDefault();
      void this.saveDraft(false);
    }}, el("label", {}, el("span", {class: "label"}, say("motion.name")), this.name), this.save);
    const play = iconButton("button small", kPlayIcon, say("teach.play"), () => teach.play());
    const mirrorButton = iconButton("button small", kMirrorIcon, say("motion.mirror"), () =>
        editor.change(mirror(editor.draft, this.store.get().robot?.joints ?? [])));
    const clear = iconButton("button small", kCloseIcon, say("motion.clear"), () => editor.clear());
    const list = new KeyframeList(this.store, editor, teach);
    return el("section", {class: "draft", "aria-label": say("motion.new")}, form, this.note.element, list.element,
      el("div", {class: "row"}, el("span", {}, say("motion.speed"), this.length), this.speed.element),
      el("div", {class: "row"}, el("span", {}, say("motion.repeat")), this.repeat.element),
      el("div", {class: "draft-buttons"}, play, mirrorButton, this.undo, clear));
  }

  private show(draft: MotionDraft): void {
    const {canUndoDraft} = this.store.get();
    const isShown = this.isDraftShown() || canUndoDraft;
    this.draft.hidden = !isShown;
    this.draft.classList.toggle("empty", !this.isDraftShown());
    this.none.hidden = this.isDraftShown();
    this.undo.disabled = !canUndoDraft;
    if (this.name.value !== draft.name) this.name.value = draft.name;
    this.speed.show(say("motion.percent", {value: Math.round(draft.speed * 100)}));
    this.repeat.show(say("motion.times", {value: draft.repetitions}));
    this.length.textContent = secondsInWords(timeOf(draft) * draft.repetitions);
  }

  private showFault(fault: MotionFault | null): void {
    this.note.hide();
    if (fault && !fault.isUpload) this.note.tellFault(fault, () => this.teach.repair());
  }

  private async saveDraft(isReplacing: boolean): Promise<void> {
    const {draft, robot, savedMotions} = this.store.get();
    const name = motionName(draft.name);
    const isSaved = savedMotions.includes(name);
    this.note.hide();
    if (!name) return this.note.tell("bad", say("motion.nameMissing"));
    if (!isSaved && robot?.actions.includes(name)) return this.note.tell("bad", say("motion.nameBuiltIn"));
    const askToReplace = (): void => this.note.tell("bad", say("motion.nameInUse", {name: sayName("action", name)}),
                                               say("motion.replace"), () => void this.saveDraft(true));
    if (isSaved && !isReplacing) return askToReplace();
    const result = await this.host.save({motion: toMotion(draft, name)}, isReplacing);
    if (result === "name-in-use") return isReplacing ? this.note.tell("bad", say("motion.nameBuiltIn")) : askToReplace();
    if (result !== "saved") return;
    this.note.tell("good", say("motion.saved", {name: sayName("action", name)}));
  }

  private changeSpeed(direction: number): void {
    const {draft} = this.editor;
    this.editor.change(setSpeed(draft, Math.round((draft.speed + direction * kSpeedStep) * 10) / 10));
  }
}
