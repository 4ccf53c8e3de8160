/** What the fake gateway must know of the robot, read from the robot's own files. */
import {readFileSync} from "node:fs";
import {join} from "node:path";
import {DOMParser} from "@xmldom/xmldom";
import {parsePostures} from "../src/robot/posture_file";
import {parseUrdf} from "../src/robot/urdf";
import type {Urdf} from "../src/robot/urdf";
import type {FakeGatewayOptions, FakePosture} from "./fake_gateway";

/** @param folder  holds nao.urdf. */
export function readUrdf(folder: string): Urdf {
  const text = readFileSync(join(folder, "nao.urdf"), "utf8");
  return parseUrdf(new DOMParser().parseFromString(text, "application/xml") as unknown as Document);
}

/** Speed of the fake joints, rad/s: any that is not 0, for times of keyframes. */
const kMaxVelocity = 6;

/** Motor joints in the URDF file's order, with their mirror images: lines like "- {name: Hand, left: LHand,
 * right: RHand, sign: 1}" in robot.yaml. */
export function readJoints(folder: string): FakeGatewayOptions["joints"] {
  const order = [...readFileSync(join(folder, "nao.urdf"), "utf8").matchAll(/<joint name="(\w+)"/g)]
      .map((match) => match[1]!);
  const mirrors = new Map<string, {mirrorJoint: string; mirrorSign: number}>();
  const text = readFileSync(join(folder, "robot.yaml"), "utf8");
  for (const [, left, right = left, sign] of text.matchAll(/\{name: \w+, left: (\w+)(?:, right: (\w+))?, sign: (-?1)\}/g)) {
    mirrors.set(left!, {mirrorJoint: right!, mirrorSign: Number(sign)});
    mirrors.set(right!, {mirrorJoint: left!, mirrorSign: Number(sign)});
  }
  return readUrdf(folder).joints
      .filter((joint) => joint.type === "revolute" && !joint.mimic)
      .sort((a, b) => order.indexOf(a.name) - order.indexOf(b.name))
      .map(({name, lower, upper}) => ({name, lower, upper, maxVelocity: kMaxVelocity, ...mirrors.get(name)}));
}

/** Joint groups: lines like "- {name: head, yaw: HeadYaw, pitch: HeadPitch}" in robot.yaml. */
export function readJointGroups(folder: string): FakeGatewayOptions["jointGroups"] {
  const text = readFileSync(join(folder, "robot.yaml"), "utf8");
  const section = text.slice(text.indexOf("joint_groups:")).split(/\n\s*\n/)[0]!;
  return [...section.matchAll(/\{name: ([^,}]+)([^}]*)\}/g)].map((match) => ({
    name: match[1]!,
    yawJoint: /yaw: (\w+)/.exec(match[2]!)?.[1] ?? "",
    pitchJoint: /(?:pitch|opening): (\w+)/.exec(match[2]!)?.[1] ?? "",
    rollJoint: /roll: (\w+)/.exec(match[2]!)?.[1] ?? "",
    isOpening: /opening:/.test(match[2]!),
  }));
}

/** Torso heights over the ground of the standing postures, m. */
const kHeights: Record<string, number> = {
  StandZero: 0.333, StandInit: 0.320, Stand: 0.3315, Crouch: 0.229, Sit: 0.11, SitRelax: 0.11,
  LyingBack: 0.06, LyingBelly: 0.06,
};

export function readPostures(folder: string): Record<string, FakePosture> {
  const postures = parsePostures(readFileSync(join(folder, "postures.yaml"), "utf8"));
  return Object.fromEntries([...postures].filter(([name]) => name in kHeights).map(([name, {angles, family}]) => {
    const pitch = family === "lying-back" ? -Math.PI / 2 : family === "lying-belly" ? Math.PI / 2 : 0;
    return [name, {angles, height: kHeights[name]!, pitch}];
  }));
}

/** Actions: lines like "- {name: kick-left, does: kick, side: left}" in robot.yaml. */
export function readActionRoles(folder: string): {name: string; kind: string; side: string}[] {
  const text = readFileSync(join(folder, "robot.yaml"), "utf8");
  return [...text.matchAll(/\{name: ([\w-]+), does: ([\w-]+)(?:, side: (\w+))?/g)]
      .map((match) => ({name: match[1]!, kind: match[2]!, side: match[3] ?? ""}));
}

/** Names of the actions in robot.yaml. */
export function readActions(folder: string): string[] {
  return readActionRoles(folder).map(({name}) => name);
}

/** Words of labels.yaml: lines like "Crouch: {en: Crouch, pt: Agachar, de: Hocken}" below "postures:". */
export function readLabels(folder: string): {kind: string; name: string; language: string; text: string}[] {
  const labels = [];
  let kind = "";
  for (const line of readFileSync(join(folder, "labels.yaml"), "utf8").split("\n")) {
    const section = /^(\w+)s:$/.exec(line);
    if (section) kind = section[1]!;
    const entry = /^ {2}([^:]+): \{(.*)\}$/.exec(line);
    for (const word of entry?.[2]?.split(", ") ?? []) {
      const [language, text] = word.split(": ");
      labels.push({kind, name: entry![1]!, language: language!, text: text!.replaceAll('"', "")});
    }
  }
  return labels;
}
