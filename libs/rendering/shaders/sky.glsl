// Background of all pixels that nothing else covers.
// A grid of cells over the image: the way of light through the air changes so slowly that it is
// computed at their corners.
#ifdef VERTEX
uniform mat4 world_from_clip;
uniform float bottom;  // of the grid, in clip coordinates
uniform ivec2 num_cells;
noperspective out float air;  // 1 at the horizon, 0 at the zenith
void main() {
  int cell = gl_VertexID / 6;
  int corner = gl_VertexID % 6;  // of two triangles
  ivec2 place = ivec2(cell % num_cells.x, cell / num_cells.x);
  place.x += corner == 1 || corner == 2 || corner == 4 ? 1 : 0;
  place.y += corner == 2 || corner == 4 || corner == 5 ? 1 : 0;
  vec2 fraction = vec2(place) / vec2(num_cells);
  vec2 at = vec2(2.0 * fraction.x - 1.0, mix(bottom, 1.0, fraction.y));
  vec3 direction = normalize((world_from_clip * vec4(at, 1.0, 1.0)).xyz);
  air = 1.0 - clamp(direction.z, 0.0, 1.0);
  gl_Position = vec4(at, 1.0, 1.0);
}
#else
noperspective in float air;
out vec4 screen;
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);
const vec3 kZenith = vec3(0.20, 0.33, 0.55);
const vec3 kLow = sqrt(kHorizon);
const vec3 kHigh = sqrt(kZenith);
const vec3 kBend = 4.0 * sqrt((kHorizon + kZenith) / 2.0) - 2.0 * (kLow + kHigh);
// The square root of the light, by a parabola that is at most 1 of 255 off and faster.
void main() {
  float part = air * air;
  screen = vec4(mix(kHigh, kLow, part) + part * (1.0 - part) * kBend, 1.0);
}
#endif
