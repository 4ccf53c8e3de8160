/** Fetches the robot's description and meshes, and reports how far it is. */
import type {Object3D} from "three";
import {GLTFLoader} from "three/examples/jsm/loaders/GLTFLoader.js";
import type {RobotSurface} from "./robot_surface";
import {quaternionFromRpy, RobotTree} from "./robot_tree";
import {parseUrdf} from "./urdf";
import type {UrdfVisual} from "./urdf";

/** @param urdfUrl   where the URDF lies; its meshes lie beside it.
 * @param surface   what the links look like.
 * @param progress  called with files done and files in all.
 * @throws Error that names the file which could not be had. */
export async function loadRobot(urdfUrl: URL, surface: RobotSurface,
                                progress: (done: number, total: number) => void): Promise<RobotTree> {
  const text = await (await fetchFile(urdfUrl)).text();
  const tree = new RobotTree(parseUrdf(new DOMParser().parseFromString(text, "application/xml")));
  const loader = new GLTFLoader();
  let done = 1;
  const visuals = tree.urdf.links.flatMap((link) => link.visuals.map((visual) => ({link, visual})));
  progress(done, visuals.length + 1);
  await Promise.all(visuals.map(async ({link, visual}) => {
    const mesh = surface.meshOf(await loadScene(loader, meshUrl(urdfUrl, visual.mesh)));
    if (mesh) {
      place(mesh, visual);
      tree.link(link.name).add(mesh);
    }
    progress(++done, visuals.length + 1);
  }));
  return tree;
}

async function loadScene(loader: GLTFLoader, url: URL): Promise<Object3D> {
  const bytes = await (await fetchFile(url)).arrayBuffer();
  return (await loader.parseAsync(bytes, "")).scene;
}

function place(mesh: Object3D, visual: UrdfVisual): void {
  mesh.position.set(...visual.xyz);
  mesh.quaternion.copy(quaternionFromRpy(visual.rpy));
}

/** A mesh's URL: "package://nao/meshes/Head.glb" and "meshes/Head.glb" both lie beside the URDF. */
function meshUrl(urdfUrl: URL, name: string): URL {
  return new URL(name.replace(/^package:\/\/[^/]+\//, "").replace(/^file:\/\//, ""), urdfUrl);
}

async function fetchFile(url: URL): Promise<Response> {
  const response = await fetch(url).catch(() => null);
  if (!response?.ok) {
    const why = response ? `status ${response.status}` : "no answer";
    throw new Error(`${url.pathname}: ${why}`);
  }
  return response;
}
