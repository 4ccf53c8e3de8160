import {create} from "@bufbuild/protobuf";
import {describe, expect, it} from "vitest";
import {readJointGroups, readUrdf} from "../../test_support/nao_files";
import {JointGroupSchema} from "../protocol/generated/remote_pb";
import {jointsOfChange, jointsOfGroups, limbOf} from "./limbs";

const folder = new URL("../../../../data/robots/nao", import.meta.url).pathname;
const urdf = readUrdf(folder);
const groups = readJointGroups(folder).map((group) => create(JointGroupSchema, group));

describe("limbs", () => {
  it("are the groups on one branch of the torso", () => {
    expect(limbOf(urdf, groups, "left elbow")).toEqual(["left shoulder", "left elbow", "left wrist", "left hand"]);
    expect(limbOf(urdf, groups, "right knee")).toContain("right ankle");
    expect(limbOf(urdf, groups, "right knee")).not.toContain("left knee");
    expect(limbOf(urdf, groups, "head")).toEqual(["head"]);
    expect(limbOf(urdf, groups, "tail")).toEqual([]);
  });

  it("have the joints of their groups", () => {
    expect(jointsOfGroups(groups, ["left elbow", "head"]).sort())
        .toEqual(["HeadPitch", "HeadYaw", "LElbowRoll", "LElbowYaw"]);
  });

  it("move with their mirror image if both sides move", () => {
    const joints = [{name: "LElbowYaw", mirrorJoint: "RElbowYaw"}, {name: "LElbowRoll", mirrorJoint: "RElbowRoll"}];
    expect(jointsOfChange(groups, joints, "left elbow", false)).toEqual(["LElbowYaw", "LElbowRoll"]);
    expect(jointsOfChange(groups, joints, "left elbow", true))
        .toEqual(["LElbowYaw", "LElbowRoll", "RElbowYaw", "RElbowRoll"]);
  });
});
