/** Smooth edges where a processor draws, and several samples for each pixel would cost as much as the robot: what the robot covers
 * is drawn once more, blended along edges of brightness. Source: T. Lottes, FXAA, NVIDIA white paper, 2009. */
import {
  Box3, FramebufferTexture, LinearFilter, Mesh, PlaneGeometry, ShaderMaterial, Vector2, Vector4,
} from "three";
import type {Camera, Object3D, WebGLRenderer} from "three";

/** area: the middle and half the size of what is drawn, from -1 to 1 of the canvas. */
const kVertexShader = `
  uniform vec4 area;
  void main() {
    gl_Position = vec4(area.xy + area.zw * position.xy, 0.0, 1.0);
  }`;

/** An edge is where three neighbors around a pixel differ by 0.1 in brightness; it is followed up to 2 pixels both ways. Chosen by
 * eye. corner: the image's on the canvas, pixels. */
const kFragmentShader = `
  uniform sampler2D image;
  uniform vec2 corner;
  float bright(vec4 color) {
    return dot(color, vec4(0.3, 0.6, 0.1, 0.2));
  }
  void main() {
    vec2 spot = gl_FragCoord.xy - corner;
    ivec2 at = ivec2(spot);
    float sw = bright(texelFetch(image, at + ivec2(-1, -1), 0));
    float se = bright(texelFetch(image, at + ivec2(1, -1), 0));
    float n = bright(texelFetch(image, at + ivec2(0, 1), 0));
    if (max(n, max(sw, se)) - min(n, min(sw, se)) < 0.1) discard;
    float nw = bright(texelFetch(image, at + ivec2(-1, 1), 0));
    float ne = bright(texelFetch(image, at + ivec2(1, 1), 0));
    vec2 along = vec2(sw + se - nw - ne, nw + sw - ne - se);
    along /= min(abs(along.x), abs(along.y)) + max((nw + ne + sw + se) / 32.0, 1.0 / 128.0);
    vec2 pixel = 1.0 / vec2(textureSize(image, 0));
    vec2 place = spot * pixel;
    vec2 way = clamp(along, -8.0, 8.0) * pixel / 4.0;
    gl_FragColor = 0.5 * (texture(image, place - way) + texture(image, place + way));
  }`;

export class SmoothEdges {
  /** What the robot covers; pixels. Grows, and then by more than it must: each growth costs a texture. */
  private image = new FramebufferTexture(0, 0);
  private readonly corner = new Vector2();
  private readonly area = new Vector4();
  private readonly material = new ShaderMaterial({
    vertexShader: kVertexShader, fragmentShader: kFragmentShader, depthTest: false, depthWrite: false,
    uniforms: {image: {value: this.image}, corner: {value: this.corner}, area: {value: this.area}}});
  private readonly quad = new Mesh(new PlaneGeometry(2, 2), this.material);

  constructor() {
    this.quad.frustumCulled = false;
  }

  /** Smooths what was drawn last, where an object is seen. */
  draw(renderer: WebGLRenderer, object: Object3D, camera: Camera): void {
    const toCanvas = camera.projectionMatrix.clone().multiply(camera.matrixWorldInverse);
    const {min, max} = new Box3().setFromObject(object).applyMatrix4(toCanvas);
    // Where the object is seen, from -1 to 1 of the canvas.
    const least = new Vector2().copy(min).clampScalar(-1, 1);
    const most = new Vector2().copy(max).clampScalar(-1, 1);
    if (most.x <= least.x || most.y <= least.y) return;
    const half = renderer.getDrawingBufferSize(new Vector2()).divideScalar(2);
    const size = most.clone().sub(least);
    this.area.set((least.x + most.x) / 2, (least.y + most.y) / 2, size.x / 2, size.y / 2);
    // A pixel is compared with those beside it.
    this.corner.copy(least).addScalar(1).multiply(half).floor().subScalar(1);
    this.fit(size.multiply(half).addScalar(2));
    renderer.copyFramebufferToTexture(this.image, this.corner);
    renderer.autoClear = false;
    renderer.render(this.quad, camera);
    renderer.autoClear = true;
  }

  private fit({x, y}: Vector2): void {
    const {width, height} = this.image.image;
    if (width > x && height > y) return;
    this.image.dispose();
    this.image = new FramebufferTexture(Math.max(width, Math.ceil(1.2 * x) + 1), Math.max(height, Math.ceil(1.2 * y) + 1));
    this.image.minFilter = this.image.magFilter = LinearFilter;
    this.material.uniforms["image"]!.value = this.image;
  }
}
