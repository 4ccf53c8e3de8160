// Background of all pixels that nothing else covers.
// A grid of cells over the image: the slope of the ray through a pixel changes so slowly that it is
// computed at their corners.
#ifdef VERTEX
uniform mat4 world_from_clip;
uniform float bottom;  // of the grid, in clip coordinates
uniform ivec2 num_cells;
noperspective out float slope;  // sine of the elevation
void main() {
  int cell = gl_VertexID / 6;
  int corner = gl_VertexID % 6;  // of two triangles
  ivec2 place = ivec2(cell % num_cells.x, cell / num_cells.x);
  place.x += corner == 1 || corner == 2 || corner == 4 ? 1 : 0;
  place.y += corner == 2 || corner == 4 || corner == 5 ? 1 : 0;
  vec2 fraction = vec2(place) / vec2(num_cells);
  vec2 at = vec2(2.0 * fraction.x - 1.0, mix(bottom, 1.0, fraction.y));
  slope = normalize((world_from_clip * vec4(at, 1.0, 1.0)).xyz).z;
  gl_Position = vec4(at, 1.0, 1.0);
}
#else
noperspective in float slope;
out vec4 screen;
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);
const vec3 kZenith = vec3(0.20, 0.33, 0.55);
// Encoded, and what a parabola through them and their mean needs. It is faster than square roots
// at each pixel, and differs from them by at most 1 of 255.
const vec3 kEncodedHorizon = sqrt(kHorizon);
const vec3 kEncodedZenith = sqrt(kZenith);
const vec3 kCurvature =
    4.0 * sqrt((kHorizon + kZenith) / 2.0) - 2.0 * (kEncodedHorizon + kEncodedZenith);
const vec3 kRise = kEncodedHorizon - kEncodedZenith + kCurvature;
void main() {
  float root = 1.0 - max(slope, 0.0);
  float part = root * root;  // of the horizon's light
  screen = vec4(kEncodedZenith + part * (kRise - part * kCurvature), 1.0);
}
#endif
