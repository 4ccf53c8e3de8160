// The plane z = 0.
// Analytic antialiasing: the fraction of a pixel that a shape covers, where a pixel is taken as an
// axis-aligned box on the ground.
#ifdef VERTEX
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
out vec3 position_in_world;
void main() {
  position_in_world = position;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
#else
in vec3 position_in_world;
out vec4 screen;

// Fraction of the interval of length f about x that lies between low and high.
vec2 overlap(vec2 low, vec2 high, vec2 x, vec2 f) {
  return clamp((min(x + 0.5 * f, high) - max(x - 0.5 * f, low)) / f, 0.0, 1.0);
}
// Fraction of a pixel at x of extent f that a rectangle covers.
float rectangle(vec2 low, vec2 high, vec2 x, vec2 f) {
  vec2 fraction = overlap(low, high, x, f);
  return fraction.x * fraction.y;
}
// Extent of a pixel on the ground, m.
vec2 pixel_extent(vec2 x) {
  return max(max(abs(dFdx(x)), abs(dFdy(x))), vec2(1e-5));
}
// Pixel of ground of this color.
vec4 pixel(vec3 albedo) {
  float fraction = direct_fraction(light_place(position_in_world));
  return vec4(encoded(seen(albedo, fraction, transmittance(position_in_world))), 1.0);
}
#endif
