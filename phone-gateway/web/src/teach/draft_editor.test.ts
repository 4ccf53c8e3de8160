import {beforeEach, describe, expect, it} from "vitest";
import {Store} from "../store";
import {DraftEditor, readDraft} from "./draft_editor";
import {addPose, kEmptyDraft, mirror, setSpeed, touch} from "./motion_draft";

/** As much of a browser's storage as is used. */
class FakeStorage {
  readonly items = new Map<string, string>();
  isFull = false;
  getItem(key: string): string | null {
    return this.items.get(key) ?? null;
  }
  setItem(key: string, value: string): void {
    if (this.isFull) throw new Error("quota");
    this.items.set(key, value);
  }
}

describe("DraftEditor", () => {
  let store: Store;
  let storage: FakeStorage;
  let editor: DraftEditor;
  const open = () => new DraftEditor(store, storage as unknown as Storage);

  beforeEach(() => {
    store = new Store();
    storage = new FakeStorage();
    editor = open();
  });

  it("keeps the draft over a reload", () => {
    editor.change(addPose(touch(kEmptyDraft, ["A"], {A: 0}), {A: 1}, []));
    editor.note({...editor.draft, name: "Wave"});
    const {draft} = editor;
    store = new Store();
    expect(open().draft).toEqual(draft);
    expect(store.get().draft).toEqual(draft);
  });

  it("takes back one step after the other, but not the name", () => {
    editor.change(addPose(kEmptyDraft, {A: 1}, []));
    editor.change(setSpeed(editor.draft, 0.5));
    editor.note({...editor.draft, name: "Wave"});
    expect(store.get().canUndoDraft).toBe(true);
    editor.undo();
    expect(editor.draft).toMatchObject({speed: 1, name: "Wave"});
    editor.undo();
    expect(editor.draft.keyframes).toEqual([]);
    expect(store.get().canUndoDraft).toBe(false);
    editor.undo();
    expect(editor.draft.keyframes).toEqual([]);
  });

  it("brings back a draft that was thrown away", () => {
    editor.change(addPose(kEmptyDraft, {A: 1}, []));
    const {draft} = editor;
    editor.clear();
    expect(editor.draft).toEqual(kEmptyDraft);
    editor.undo();
    expect(editor.draft).toEqual(draft);
  });

  it("forgets a fault with the next change", () => {
    store.set({motionFault: {keyframe: 0, text: "too fast", repairText: "", repaired: null, isUpload: false}});
    editor.change(mirror(addPose(kEmptyDraft, {A: 1}, []), []));
    expect(store.get().motionFault).toBeNull();
  });

  it("works where nothing can be stored", () => {
    storage.isFull = true;
    editor.change(addPose(kEmptyDraft, {A: 1}, []));
    expect(editor.draft.keyframes).toHaveLength(1);
    expect(new DraftEditor(new Store(), null).draft).toEqual(kEmptyDraft);
  });

  it.each(["{", "7", "null", "[]", '{"keyframes":[null]}', '{"keyframes":[{"duration":"1","pause":0,"pose":{}}]}',
           '{"keyframes":[{"duration":1,"pause":0,"pose":{"A":"x"}}]}', '{"keyframes":[{"duration":1,"pause":0}]}'])(
      "begins anew when %s is stored", (text) => {
    storage.items.set("nao-remote-draft", text);
    expect(readDraft(storage as unknown as Storage)).toEqual(kEmptyDraft);
  });
});
