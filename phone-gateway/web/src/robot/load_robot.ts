/** Fetches the robot's description and meshes, and reports how far it is. */
import type {Mesh} from "three";
import {GLTFLoader} from "three/examples/jsm/loaders/GLTFLoader.js";
import type {RobotSurface} from "./robot_surface";
import {quaternionFromRpy, RobotTree} from "./robot_tree";
import {parseUrdf} from "./urdf";
import type {UrdfVisual} from "./urdf";

/** @param urdfUrl   where the URDF lies; its meshes lie beside it.
 * @param surface   what the links look like.
 * @param progress  called with files done and files in all.
 * @param warn      called with the name of each mesh that is missing or damaged: its link is not drawn.
 * @throws Error that names the file which could not be had. */
export async function loadRobot(urdfUrl: URL, surface: RobotSurface, progress: (done: number, total: number) => void,
                                warn: (mesh: string) => void): Promise<RobotTree> {
  const text = await (await fetchFile(urdfUrl)).text();
  const tree = new RobotTree(parseUrdf(new DOMParser().parseFromString(text, "application/xml")));
  const loader = new GLTFLoader();
  const visuals = tree.urdf.links.flatMap((link) => link.visuals.map((visual) => ({link, visual})));
  // A mesh and its mirror image are one file.
  const files = [...new Set(visuals.map(({visual}) => visual.mesh))];
  let done = 1;
  progress(done, files.length + 1);
  await Promise.all(files.map(async (file) => {
    const mesh = await loadMesh(loader, meshUrl(urdfUrl, file), surface);
    if (!mesh) warn(file);
    for (const {link, visual} of mesh ? visuals.filter((one) => one.visual.mesh === file) : []) {
      tree.link(link.name).add(place(mesh!.clone(), visual));
    }
    progress(++done, files.length + 1);
  }));
  return tree;
}

/** @return null if there is nothing to draw in it. @throws NoAnswer if the host is away. */
async function loadMesh(loader: GLTFLoader, url: URL, surface: RobotSurface): Promise<Mesh | null> {
  try {
    const bytes = await (await fetchFile(url)).arrayBuffer();
    return await surface.meshOf((await loader.parseAsync(bytes, "")).scene);
  } catch (error) {
    if (error instanceof NoAnswer) throw error;
    return null;
  }
}

function place(mesh: Mesh, visual: UrdfVisual): Mesh {
  mesh.position.set(...visual.xyz);
  mesh.quaternion.copy(quaternionFromRpy(visual.rpy));
  mesh.scale.set(...visual.scale);
  // It does not move in its link.
  mesh.updateMatrix();
  mesh.matrixAutoUpdate = false;
  return mesh;
}

/** A mesh's URL: "package://nao/meshes/Head.glb" and "meshes/Head.glb" both lie beside the URDF. */
function meshUrl(urdfUrl: URL, name: string): URL {
  return new URL(name.replace(/^package:\/\/[^/]+\//, "").replace(/^file:\/\//, ""), urdfUrl);
}

async function fetchFile(url: URL): Promise<Response> {
  const response = await fetch(url).catch(() => null);
  if (!response) throw new NoAnswer(`${url.pathname}: no answer`);
  if (!response.ok) throw new Error(`${url.pathname}: status ${response.status}`);
  return response;
}

class NoAnswer extends Error {}
