/** The ground: turf with the lines of the field, fading out around the robot. Lines are computed
 * per pixel, as in the head camera's image, so that they stay sharp without a texture. */
import {
  CircleGeometry, Color, Group, LinearSRGBColorSpace, Mesh, MeshBasicMaterial, PlaneGeometry, RingGeometry, ShaderMaterial,
  ShadowMaterial, Vector2, Vector4,
} from "three";
import type {FieldLines} from "./load_field";

/** Beyond this distance from the robot the ground has faded out, m. */
const kVisibleRadius = 4.5;
/** Width of the line to a spot that was tapped, m. Chosen. */
const kPathWidth = 0.018;
/** Radius of the shadow around the feet, m: a little wider than they stand. Chosen. */
const kContactWidth = 0.17;

const kVertexShader = `
  varying vec2 place;
  void main() {
    vec4 world = modelMatrix * vec4(position, 1.0);
    place = vec2(world.x, -world.z);
    gl_Position = projectionMatrix * viewMatrix * world;
  }`;

/** Colors as the screen shows them: blended without a conversion, which would cost a processor more than the lines.
 * field: half length, half width, half line width, circle radius; penalty area: length, half width; contact: squared radius over
 * the squared width of a soft darkness around the feet, about exp(-contact d^2), where shadows cost too much as well.
 * cover(): fraction of a pixel, 1 / perPixel wide, that is so far inside a line of half width w. Lines are those across and along
 * (goal lines and halfway line, sidelines), and those of the penalty area. */
const kFragmentShader = `
  varying vec2 place;
  uniform vec2 centre;
  uniform float radius;
  uniform vec4 field;
  uniform vec2 penalty;
  uniform vec3 turf;
  uniform vec3 lines;
  uniform float contact;

  vec2 cover(vec2 inside, float w, vec2 perPixel) {
    return clamp(inside * perPixel + 0.5, 0.0, 1.0) * min(vec2(1.0), 2.0 * w * perPixel + 0.15);
  }
  float drawn(vec2 p, vec2 pixel) {
  #ifdef HAS_FIELD
    vec2 a = abs(p);
    float w = field.z;
    float depth = field.x - a.x;
    vec2 across = vec2(w) - vec2(min(abs(depth), a.x), abs(a.y - field.y));
    vec2 box = vec2(w) - abs(vec2(depth, a.y) - penalty);
    vec2 inBox = step(vec2(a.y, depth), penalty.yx + w);
    vec2 l = cover(max(across, mix(vec2(-1.0), box, inBox)), w, 1.0 / pixel) * step(a.x, field.x + w) * step(a.y, field.y + w);
    float far = length(p);
    return 0.95 * max(max(l.x, l.y), cover(vec2(w - abs(far - field.w)), w, vec2(far / dot(a, pixel))).x);
  #else
    vec2 l = cover(0.002 - abs(fract(p / 0.25 + 0.5) - 0.5) * 0.25, 0.002, 1.0 / pixel);
    return 0.26 * max(l.x, l.y);
  #endif
  }
  void main() {
    vec3 color = mix(turf, lines, drawn(place, fwidth(place) + 1e-6));
    float d = distance(place, centre) / radius;
    float near = max(0.0, 1.0 - 0.25 * contact * d * d);
    near *= near;
    color *= 1.0 - 0.24 * near * near;
    float fade = 1.0 - smoothstep(0.3, 1.0, d);
    gl_FragColor = vec4(color * fade, fade);
  }`;

export class Floor {
  readonly object = new Group();
  private readonly uniforms = {
    centre: {value: new Vector2()},
    radius: {value: kVisibleRadius},
    field: {value: new Vector4()},
    penalty: {value: new Vector2()},
    turf: {value: new Color()},
    lines: {value: new Color()},
    contact: {value: (kVisibleRadius / kContactWidth) ** 2},
  };
  private readonly material = new ShaderMaterial({
    vertexShader: kVertexShader, fragmentShader: kFragmentShader, depthWrite: false, uniforms: this.uniforms});
  private readonly ground = new Group();
  /** The robot's, on it. */
  readonly shadow = new Mesh(undefined, new ShadowMaterial({opacity: 0.45, depthWrite: false}));
  /** Ring around a spot that was tapped. */
  private readonly marker = new Mesh(
      new RingGeometry(0.06, 0.075, 40).rotateX(-Math.PI / 2),
      new MeshBasicMaterial({color: 0x6cc8ff, transparent: true, opacity: 0.9, depthWrite: false}));

  /** The way there. */
  private readonly path = new Mesh(new PlaneGeometry(1, kPathWidth).rotateX(-Math.PI / 2), this.marker.material);

  constructor() {
    const plane = new CircleGeometry(kVisibleRadius, 64).rotateX(-Math.PI / 2);
    const ground = new Mesh(plane, this.material);
    // After what is opaque, over nothing: without blending, which costs a processor more than the lines.
    ground.renderOrder = 1;
    const {shadow} = this;
    shadow.geometry = plane;
    shadow.receiveShadow = true;
    shadow.renderOrder = -1;
    shadow.position.y = 0.001;
    this.ground.add(ground, shadow);
    this.mark(null);
    this.object.add(this.ground, this.marker, this.path);
  }

  /** Shows the lines of a field; without, a plain grid of 0.25 m. */
  setField(lines: FieldLines): void {
    const {field, penalty} = this.uniforms;
    this.material.defines["HAS_FIELD"] = "";
    this.material.needsUpdate = true;
    field.value.set(lines.length / 2, lines.width / 2, lines.lineWidth / 2, lines.centreCircleDiameter / 2);
    penalty.value.set(lines.penaltyAreaLength, lines.penaltyAreaWidth / 2);
  }

  /** @param turf,lines  as in style sheets. */
  setColors(turf: string, lines: string): void {
    this.uniforms.turf.value.setStyle(turf, LinearSRGBColorSpace);
    this.uniforms.lines.value.setStyle(lines, LinearSRGBColorSpace);
  }

  /** Marks a spot and the way from another one to it, m in the robot's axes; null: none. */
  mark(spot: {x: number; y: number} | null, from = spot): void {
    this.marker.visible = this.path.visible = spot !== null;
    if (!spot || !from) return;
    this.marker.position.set(spot.x, 0.003, -spot.y);
    this.path.position.set((spot.x + from.x) / 2, 0.002, -(spot.y + from.y) / 2);
    this.path.scale.x = Math.hypot(spot.x - from.x, spot.y - from.y);
    this.path.rotation.y = Math.atan2(spot.y - from.y, spot.x - from.x);
  }

  /** Keeps the visible part around the robot, m in the robot's axes. */
  moveTo(x: number, y: number): void {
    this.ground.position.set(x, 0, -y);
    this.uniforms.centre.value.set(x, y);
  }
}
