// Background of all pixels that nothing else covers.
// A grid of cells over the image, at the depth of the far plane: the sky changes so slowly that its
// color is computed at their corners.
#ifdef VERTEX
uniform mat4 world_from_clip;
uniform float bottom;  // of the grid, in clip coordinates
uniform ivec2 num_cells;
out vec3 color;
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);
const vec3 kZenith = vec3(0.20, 0.33, 0.55);
void main() {
  int cell = gl_VertexID / 6;
  int corner = gl_VertexID % 6;  // of two triangles
  ivec2 place = ivec2(cell % num_cells.x, cell / num_cells.x);
  place.x += corner == 1 || corner == 2 || corner == 4 ? 1 : 0;
  place.y += corner == 2 || corner == 4 || corner == 5 ? 1 : 0;
  vec2 fraction = vec2(place) / vec2(num_cells);
  vec2 at = vec2(2.0 * fraction.x - 1.0, mix(bottom, 1.0, fraction.y));
  vec3 direction = normalize((world_from_clip * vec4(at, 1.0, 1.0)).xyz);
  float depth = 1.0 - clamp(direction.z, 0.0, 1.0);
  color = sqrt(mix(kZenith, kHorizon, depth * depth));
  gl_Position = vec4(at, 1.0, 1.0);
}
#else
in vec3 color;
out vec4 screen;
void main() {
  screen = vec4(color, 1.0);
}
#endif
