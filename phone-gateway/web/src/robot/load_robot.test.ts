import {DOMParser} from "@xmldom/xmldom";
import {afterEach, beforeEach, expect, it, vi} from "vitest";
import {Store} from "../store";
import type {Stage} from "./stage";
import {loadRobot} from "./load_robot";
import {RobotSurface} from "./robot_surface";
import {RobotView} from "./robot_view";

const kUrdf = `<robot name="r"><link name="a"><visual><geometry><mesh filename="good.glb"/></geometry></visual></link>
  <link name="b"><visual><geometry><mesh filename="bad.glb"/></geometry></visual></link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>`;
const kUrl = new URL("http://robot/r.urdf");
const kGood = makeTriangle();

let files: Record<string, () => Promise<Response>>;

beforeEach(() => {
  vi.stubGlobal("DOMParser", DOMParser);
  files = {"/r.urdf": async () => new Response(kUrdf), "/good.glb": async () => new Response(kGood)};
  vi.stubGlobal("fetch", (url: URL) => files[url.pathname]?.() ?? Promise.resolve(new Response("", {status: 404})));
  vi.stubGlobal("self", globalThis);
});
afterEach(() => vi.unstubAllGlobals());

it.each([
  ["missing", new Response("", {status: 404})],
  ["no GLB", new Response("<html>")],
  ["cut", new Response(kGood.subarray(0, 100))],
  ["empty", new Response("")],
])("draws what can be drawn and warns when a mesh is %s", async (_, bad) => {
  files["/bad.glb"] = async () => bad;
  const warned: string[] = [];
  const tree = await loadRobot(kUrl, new RobotSurface(true), () => {}, (mesh) => warned.push(mesh));
  expect(warned).toEqual(["bad.glb"]);
  expect(tree.link("a").children.some((child) => child.type === "Mesh")).toBe(true);
});

it("fetches a mesh and its mirror image once", async () => {
  const paths: string[] = [];
  files["/r.urdf"] = async () => new Response(kUrdf.replace('"bad.glb"', '"good.glb" scale="1 -1 1"'));
  files["/good.glb"] = async () => {
    paths.push("good");
    return new Response(kGood);
  };
  const tree = await loadRobot(kUrl, new RobotSurface(true), () => {}, () => {});
  expect(paths).toEqual(["good"]);
  expect(["a", "b"].map((link) => tree.link(link).children.find((child) => child.type === "Mesh")!.scale.y)).toEqual([1, -1]);
});

it("keeps the error while files that are on their way arrive after it", async () => {
  vi.stubGlobal("location", {href: kUrl.href});
  let arrive: (response: Response) => void = () => {};
  files["/good.glb"] = () => new Promise((resolve) => arrive = resolve);
  files["/bad.glb"] = () => Promise.reject(new Error("offline"));
  const store = new Store();
  store.set({robot: {urdfPath: "/r.urdf"} as never});
  const stage = {surface: new RobotSurface(true), outdate: () => {}} as unknown as Stage;
  await new RobotView(store, stage, () => {}).load();
  arrive(new Response(kGood));
  await new Promise((resolve) => setTimeout(resolve));
  await vi.waitUntil(() => store.get().loading.error !== "");
  expect(store.get().loading.error).toMatch("bad.glb: no answer");
});

/** A GLB file with one triangle. Source: glTF 2.0, section 4, chunks JSON and BIN. */
function makeTriangle(): Uint8Array<ArrayBuffer> {
  const json = JSON.stringify({
    asset: {version: "2.0"}, scene: 0, scenes: [{nodes: [0]}], nodes: [{mesh: 0}], buffers: [{byteLength: 36}],
    bufferViews: [{buffer: 0, byteLength: 36}], meshes: [{primitives: [{attributes: {POSITION: 0}}]}],
    accessors: [{bufferView: 0, componentType: 5126, count: 3, type: "VEC3", min: [0, 0, 0], max: [1, 1, 0]}],
  });
  const text = new TextEncoder().encode(json.padEnd(Math.ceil(json.length / 4) * 4));
  const file = new Uint8Array(28 + text.length + 36);
  const view = new DataView(file.buffer);
  [0x46546c67, 2, file.length, text.length, 0x4e4f534a].forEach((word, i) => view.setUint32(4 * i, word, true));
  file.set(text, 20);
  view.setUint32(20 + text.length, 36, true);
  view.setUint32(24 + text.length, 0x004e4942, true);
  [0, 0, 0, 1, 0, 0, 0, 1, 0].forEach((value, i) => view.setFloat32(28 + text.length + 4 * i, value, true));
  return file;
}
