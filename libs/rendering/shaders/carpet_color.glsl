// WITH_WEAR: the carpet has a texture and the lines are worn, which is expensive.
// As in SceneAppearance.
uniform vec3 carpet_color;
uniform float carpet_texture;

// Value noise in 0 to 1 with cells of 1 m.
float hash(vec2 cell) {
  return fract(sin(dot(cell, vec2(12.9898, 78.233))) * 43758.547);
}
float noise(vec2 x) {
  vec2 cell = floor(x);
  vec2 t = fract(x);
  t = t * t * (3.0 - 2.0 * t);
  return mix(mix(hash(cell), hash(cell + vec2(1, 0)), t.x),
             mix(hash(cell + vec2(0, 1)), hash(cell + vec2(1, 1)), t.x), t.y);
}

// Color of the ground around the carpet.
const vec3 kHall = vec3(0.46, 0.47, 0.49);

// Color of the carpet in a pixel of extent f at p.
vec3 carpet(vec2 p, vec2 f) {
  // Faint variation of the color over meters, as a carpet has; no measured source.
  vec3 wave = abs(fract(vec3(0.33 * p.x, 0.27 * p.y, 0.71 * p.x + 0.47 * p.y)) - 0.5);
  vec3 green = carpet_color * (0.96 + 0.32 * wave.x * wave.y + 0.05 * wave.z);
#ifdef WITH_WEAR
  float grain = 0.6 * noise(p * 60.0) * clamp(0.02 / max(f.x, f.y), 0.0, 1.0) + 0.4 * noise(p * 3.0);
  green *= 1.0 + 2.0 * carpet_texture * (grain - 0.5);
#endif
  return green;
}
