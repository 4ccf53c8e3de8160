// The plane z = 0 as a tiled floor.
#ifndef VERTEX
void main() {
  vec2 p = position_in_world.xy;
  vec2 f = pixel_extent(p);
  // Thin joints between tiles of 0.5 m.
  vec2 tile = abs(fract(2.0 * p) - 0.5) * 0.5;
  vec2 joint = overlap(vec2(0.246), vec2(0.254), tile, f);
  vec2 cell = floor(2.0 * p);
  float checker = mod(cell.x + cell.y, 2.0);
  float blur = clamp(1.0 - 2.0 * max(f.x, f.y), 0.0, 1.0);
  float tone = 0.40 + 0.05 * (checker - 0.5) * blur;
  vec3 albedo = mix(vec3(tone), vec3(0.22), 0.6 * max(joint.x, joint.y));
  screen = pixel(albedo);
}
#endif
