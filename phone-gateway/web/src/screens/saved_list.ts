/** The motions saved on the robot's host: play, change, download, delete with undo, upload. */
import {button} from "../controls/press";
import {el, icon} from "../dom";
import type {MotionFile} from "../protocol/generated/remote_pb";
import type {Store} from "../store";
import type {DraftEditor} from "../teach/draft_editor";
import {fromMotion} from "../teach/motion_draft";
import {kMaxFileBytes} from "../teach/motion_host";
import type {MotionHost, MotionSource} from "../teach/motion_host";
import {say, sayName} from "../text/texts";
import {kDeleteIcon, kDownloadIcon, kEditIcon, kPlayIcon, kUploadIcon} from "./icons";
import {Note} from "./note";

export class SavedList {
  readonly element: HTMLElement;
  private readonly list = el("ul", {class: "saved-motions"});
  private readonly none = el("p", {class: "quiet"}, say("motion.noneSaved"));
  /** What happened to a file or a deleted motion, and what to do about it. */
  private readonly note = new Note();
  private readonly input = el("input", {type: "file", accept: ".yaml,.yml,text/yaml", hidden: true,
                                        "aria-label": say("motion.upload")});

  /** @param played  called when the robot begins to play a motion. @param opened  when one became the draft. */
  constructor(store: Store, private readonly editor: DraftEditor, private readonly host: MotionHost,
              private readonly played: () => void, private readonly opened: () => void) {
    const upload = el("button", {class: "button wide motion-upload"}, icon(kUploadIcon), say("motion.upload"));
    // A click, for a browser opens the choice of files for nothing else.
    upload.addEventListener("click", () => this.input.click());
    this.input.addEventListener("change", () => void this.upload());
    this.element = el("section", {class: "saved", "aria-label": say("motion.savedOnes")},
                      el("h3", {}, say("motion.savedOnes")), this.none, this.list, this.note.element, upload, this.input);
    store.watch((state) => state.savedMotions, (names) => this.show(names));
    store.watch((state) => state.motionFault, (fault) => {
      if (!fault?.isUpload) return;
      this.note.tellFault({...fault, repairText: say("motion.openRepaired")}, () => {
        this.editor.change(fromMotion(fault.repaired!));
        this.opened();
      });
    });
  }

  private show(names: readonly string[]): void {
    this.none.hidden = names.length > 0;
    this.list.replaceChildren(...names.map((name) => el("li", {"data-name": name},
      el("span", {class: "saved-name"}, sayName("action", name)),
      this.makeButton("motion.playNamed", name, kPlayIcon, () => void this.play(name)),
      this.makeButton("motion.editNamed", name, kEditIcon, () => void this.edit(name)),
      this.makeButton("motion.downloadNamed", name, kDownloadIcon, () => void this.download(name)),
      this.makeButton("motion.removeNamed", name, kDeleteIcon, () => void this.remove(name)))));
  }

  private async play(name: string): Promise<void> {
    this.played();
    await this.host.playSaved(name);
  }

  private async edit(name: string): Promise<void> {
    const motion = (await this.host.get(name))?.motion;
    if (!motion) return;
    this.editor.change({...fromMotion(motion), name});
    this.opened();
  }

  private async download(name: string): Promise<void> {
    const file = await this.host.get(name);
    if (file) saveFile(`${name}.yaml`, file.yaml);
  }

  private async remove(name: string): Promise<void> {
    const file = await this.host.remove(name);
    if (!file) return;
    this.note.tell("good", say("motion.removed", {name: sayName("action", name)}), say("motion.undo"),
              () => void this.restore(file));
  }

  /** Saves what was deleted. */
  private async restore({motion, yaml}: MotionFile): Promise<void> {
    const result = await this.host.save(yaml ? {yaml} : {motion: motion!}, false);
    if (result === "saved") this.note.hide();
  }

  private async upload(): Promise<void> {
    const file = this.input.files?.[0];
    // The same file may be chosen again after it was changed.
    if (!file) return;
    if (file.size > kMaxFileBytes) {
      this.note.tell("bad", say("motion.fileTooLarge", {size: kMaxFileBytes / 1000}));
    } else {
      await this.saveText({yaml: await file.text()}, file.name, false);
    }
    this.input.value = "";
  }

  private async saveText(source: MotionSource, name: string, isReplacing: boolean): Promise<void> {
    this.note.tell("good", say("teach.checking"));
    const result = await this.host.save(source, isReplacing);
    if (result === "saved") this.note.tell("good", say("motion.uploaded"));
    else if (result === "refused") this.note.hide();
    else if (result === "name-in-use" && isReplacing) this.note.tell("bad", say("motion.nameBuiltIn"));
    else if (result === "name-in-use") {
      this.note.tell("bad", say("motion.nameInUse", {name}), say("motion.replace"),
                () => void this.saveText(source, name, true));
    }
  }

  private makeButton(key: "motion.playNamed" | "motion.editNamed" | "motion.downloadNamed" | "motion.removeNamed",
                     name: string, path: string, act: () => void): HTMLButtonElement {
    const label = say(key, {name: sayName("action", name)});
    return button({class: "round", "aria-label": label, "data-act": key}, act, icon(path));
  }
}

/** Lets the browser save a text as a file. */
function saveFile(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], {type: "text/yaml"}));
  const link = el("a", {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  // The browser reads it after the click.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}
