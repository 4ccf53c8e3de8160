import {DOMParser} from "@xmldom/xmldom";
import {describe, expect, it} from "vitest";
import {parseUrdf} from "./urdf";

const parse = (text: string) =>
    parseUrdf(new DOMParser().parseFromString(text, "application/xml") as unknown as Document);
const joint = (name: string, parent: string, child: string, more = "") =>
    `<joint name="${name}" type="revolute"><parent link="${parent}"/><child link="${child}"/>${more}</joint>`;
const robot = (body: string) => `<robot name="r">${body}</robot>`;

describe("parseUrdf", () => {
  it("reads origins, axes, limits and mimics", () => {
    const {root, joints} = parse(robot(`<link name="a"/><link name="b"/><link name="c"/>
        ${joint("second", "b", "c", '<mimic joint="first" multiplier="-2" offset="0.1"/>')}
        ${joint("first", "a", "b", `<origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><axis xyz="0 3 4"/>
                                    <limit lower="-1" upper="2"/>`)}`));
    expect(root).toBe("a");
    expect(joints.map(({name}) => name)).toEqual(["first", "second"]);
    expect(joints[0]).toMatchObject({xyz: [1, 2, 3], rpy: [0.1, 0.2, 0.3], axis: [0, 0.6, 0.8],
                                     lower: -1, upper: 2, mimic: null});
    expect(joints[1]!.mimic).toEqual({joint: "first", multiplier: -2, offset: 0.1});
  });

  it.each([
    ["another document", "<html/>", /no URDF/],
    ["two roots", robot('<link name="a"/><link name="b"/>'), /2 root links/],
    ["a missing link", robot(`<link name="a"/>${joint("j", "a", "ghost")}`), /ghost/],
    ["a loop", robot(`<link name="r"/><link name="a"/><link name="b"/>${joint("j", "a", "b")}${joint("k", "b", "a")}`), /loop/],
    ["a number that is none", robot(`<link name="a"/><link name="b"/>${joint("j", "a", "b", '<origin xyz="0 x 0"/>')}`), /three numbers/],
    ["an axis of no length", robot(`<link name="a"/><link name="b"/>${joint("j", "a", "b", '<axis xyz="0 0 0"/>')}`), /length 0/],
  ])("refuses %s and says why", (_, text, why) => {
    expect(() => parse(text)).toThrow(why);
  });
});
