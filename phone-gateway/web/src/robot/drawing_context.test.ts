import {describe, expect, it} from "vitest";
import {isSoftwareRenderer} from "./drawing_context";

describe("isSoftwareRenderer", () => {
  it.each([
    "ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device (Subzero) (0x0000C0DE)), SwiftShader driver)",
    "llvmpipe (LLVM 15.0.6, 256 bits)", "Google SwiftShader", "Apple Software Renderer",
    "ANGLE (Microsoft, Microsoft Basic Render Driver (0x0000008C) Direct3D11)",
  ])("detects software rendering: %s", (name) => expect(isSoftwareRenderer(name)).toBe(true));
  it.each([
    "Adreno (TM) 619", "Mali-G57 MC2", "Apple GPU", "ANGLE (ARM, Mali-G78, OpenGL ES 3.2)",
    "ANGLE (Intel, Mesa Intel(R) UHD Graphics 620 (KBL GT2), OpenGL 4.6)", "",
  ])("takes any other for a graphics chip: %s", (name) => expect(isSoftwareRenderer(name)).toBe(false));
});
