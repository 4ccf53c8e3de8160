/** What the app needs of a URDF: links with their meshes, joints with their axes. Pure; the document
 * comes from the browser's DOMParser, or from a test's. */

export interface UrdfVisual {
  /** As written in the file, relative to it. */
  mesh: string;
  /** Factors of the mesh's own axes. */
  scale: Triple;
  /** Shape frame in the link frame: m, and roll, pitch, yaw in rad. */
  xyz: Triple;
  rpy: Triple;
}

export interface UrdfLink {
  name: string;
  visuals: UrdfVisual[];
}

export interface UrdfJoint {
  name: string;
  type: "revolute" | "fixed";
  parent: string;
  child: string;
  /** Joint frame in the parent link's frame: m, and roll, pitch, yaw in rad. */
  xyz: Triple;
  rpy: Triple;
  /** Unit axis in the joint frame. */
  axis: Triple;
  /** rad. */
  lower: number;
  upper: number;
  /** The joint that this one follows, if any: angle = multiplier * other + offset. */
  mimic: {joint: string; multiplier: number; offset: number} | null;
}

export interface Urdf {
  name: string;
  root: string;
  links: UrdfLink[];
  /** Parents before children. */
  joints: UrdfJoint[];
}

export type Triple = [number, number, number];

/** @throws Error that says what is wrong with the file. */
export function parseUrdf(document: Document): Urdf {
  const robot = document.documentElement;
  if (robot?.tagName !== "robot") throw new Error("the robot's description is no URDF");
  const links = children(robot, "link").map(parseLink);
  const joints = children(robot, "joint").map(parseJoint);
  const names = new Set(links.map((link) => link.name));
  for (const joint of joints) {
    for (const end of [joint.parent, joint.child]) {
      if (!names.has(end)) throw new Error(`joint ${joint.name} names link ${end}, which is not there`);
    }
  }
  const childNames = new Set(joints.map((joint) => joint.child));
  const roots = links.filter((link) => !childNames.has(link.name));
  if (roots.length !== 1) throw new Error(`the robot has ${roots.length} root links instead of one`);
  const root = roots[0]!.name;
  return {name: required(robot, "name"), root, links, joints: sortByDepth(root, joints)};
}

function parseLink(element: Element): UrdfLink {
  const visuals: UrdfVisual[] = [];
  for (const visual of children(element, "visual")) {
    const geometry = children(visual, "geometry")[0];
    const mesh = geometry && children(geometry, "mesh")[0];
    if (mesh) visuals.push({mesh: required(mesh, "filename"), scale: triple(mesh.getAttribute("scale"), [1, 1, 1]), ...parseOrigin(visual)});
  }
  return {name: required(element, "name"), visuals};
}

function parseJoint(element: Element): UrdfJoint {
  const name = required(element, "name");
  const type = required(element, "type");
  const limit = children(element, "limit")[0];
  const mimic = children(element, "mimic")[0];
  return {
    name,
    type: type === "fixed" ? "fixed" : "revolute",
    parent: required(only(element, "parent"), "link"),
    child: required(only(element, "child"), "link"),
    ...parseOrigin(element),
    axis: normalized(triple(children(element, "axis")[0]?.getAttribute("xyz"), [1, 0, 0])),
    lower: Number(limit?.getAttribute("lower") ?? 0),
    upper: Number(limit?.getAttribute("upper") ?? 0),
    mimic: mimic ? {
      joint: required(mimic, "joint"),
      multiplier: Number(mimic.getAttribute("multiplier") ?? 1),
      offset: Number(mimic.getAttribute("offset") ?? 0),
    } : null,
  };
}

function parseOrigin(element: Element): {xyz: Triple; rpy: Triple} {
  const origin = children(element, "origin")[0];
  return {
    xyz: triple(origin?.getAttribute("xyz"), [0, 0, 0]),
    rpy: triple(origin?.getAttribute("rpy"), [0, 0, 0]),
  };
}

function sortByDepth(root: string, joints: UrdfJoint[]): UrdfJoint[] {
  const sorted: UrdfJoint[] = [];
  for (let parents = [root]; parents.length > 0 && sorted.length <= joints.length;) {
    const next = joints.filter(({parent}) => parents.includes(parent));
    sorted.push(...next);
    parents = next.map(({child}) => child);
  }
  if (sorted.length !== joints.length) throw new Error("the robot's joints form a loop");
  return sorted;
}

function children(element: Element, tag: string): Element[] {
  return Array.from(element.childNodes).filter((node): node is Element => node.nodeName === tag);
}

function only(element: Element, tag: string): Element {
  const found = children(element, tag)[0];
  if (!found) throw new Error(`${nameOf(element)} has no <${tag}>`);
  return found;
}

function required(element: Element, attribute: string): string {
  const value = element.getAttribute(attribute);
  if (!value) throw new Error(`${nameOf(element)} has no ${attribute}`);
  return value;
}

function nameOf(element: Element): string {
  return `<${element.tagName}> ${element.getAttribute("name") ?? ""}`.trim();
}

function triple(text: string | null | undefined, otherwise: Triple): Triple {
  if (text === null || text === undefined) return otherwise;
  const numbers = text.trim().split(/\s+/).map(Number);
  if (numbers.length !== 3 || !numbers.every(Number.isFinite)) {
    throw new Error(`"${text}" is not three numbers`);
  }
  return numbers as Triple;
}

function normalized([x, y, z]: Triple): Triple {
  const length = Math.hypot(x, y, z);
  if (length === 0) throw new Error("a joint's axis has length 0");
  return [x / length, y / length, z / length];
}
