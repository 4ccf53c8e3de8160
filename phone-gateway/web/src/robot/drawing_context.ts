/** How the stage draws: with a graphics chip, or in software, where every pixel is dear. */

/** The browser has no WebGL 2. */
export class CannotDraw extends Error {}

/** @return isSoftware: the processor draws. @throws CannotDraw if the browser cannot draw in 3D. */
export function openDrawingContext(canvas: HTMLCanvasElement) {
  // Antialiasing is requested before the renderer is known: a second canvas reports the renderer.
  const isSoftware = isSoftwareRenderer(nameOfRenderer());
  const gl = canvas.getContext("webgl2", {
    alpha: true, antialias: !isSoftware, powerPreference: "high-performance"});
  if (!gl) throw new CannotDraw("WebGL 2 is missing");
  return {gl, isSoftware};
}

/** True for the names of the renderers that browsers fall back to: SwiftShader, Mesa's llvmpipe and
 * softpipe, Windows's WARP and Apple's. (failIfMajorPerformanceCaveat lets SwiftShader pass.) */
export function isSoftwareRenderer(name: string): boolean {
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

function nameOfRenderer(): string {
  const gl = document.createElement("canvas").getContext("webgl2");
  const info = gl?.getExtension("WEBGL_debug_renderer_info");
  const name = gl ? String(gl.getParameter(info?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER)) : "";
  gl?.getExtension("WEBGL_lose_context")?.loseContext();
  return name;
}
