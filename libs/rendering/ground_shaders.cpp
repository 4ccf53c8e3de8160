#include "rendering/shaders.h"

#include "rendering/shader_parts.h"

namespace nao::shaders {
namespace {

const char* const kGroundVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
out vec3 position_in_world;
void main() {
  position_in_world = position;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

/** What the camera sees of the ground. */
const char* const kHaze = R"(
// Part of the light that haze lets pass, of which half is left after 17 m. A rational function
// approximates the exponential of Beer's law because it is faster.
float transmittance(vec3 position) {
  vec3 ray = position - eye_position;
  float root = 1.0 / (1.0 + 0.0014 * dot(ray, ray));
  return root * root;
}
// Light of ground of a color in a fraction of the direct light.
vec3 seen(vec3 albedo, float fraction, float passed) {
  vec3 light = albedo * (ambient_light * kSkyLight + fraction * light_direction.z * direct_light);
  return mix(kHorizon, light, passed);
}
)";

/** Analytic antialiasing: the fraction of a pixel that a shape covers, where a pixel is taken as an
 * axis-aligned box on the ground. */
const char* const kCoverage = R"(
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
)";

const char* const kCarpet = R"(
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
)";

// Color and light of a carpet without texture, and of the hall around it, change so slowly that
// they are computed at the corners of patches; where they may be in shadow, once with and once
// without direct light.
const char* const kCarpetVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_world;
uniform bool is_hall;
#ifdef WITH_SHADOW
out vec3 lit;
out vec3 shadowed;
out vec4 place;
#else
out vec3 color;
#endif
void main() {
  vec3 albedo = is_hall ? kHall : carpet(position.xy, vec2(1.0));
  float passed = transmittance(position);
#ifdef WITH_SHADOW
  lit = seen(albedo, 1.0, passed);
  shadowed = seen(albedo, 0.0, passed);
  place = light_place(position);
#else
  color = encoded(seen(albedo, 1.0, passed));
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char* const kShadowedCarpetFragment = R"(
in vec3 lit;
in vec3 shadowed;
in vec4 place;
out vec4 screen;
void main() {
  screen = vec4(encoded(mix(shadowed, lit, direct_fraction(place))), 1.0);
}
)";

const char* const kLineVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 line;  // its unit normal, its middle along it, whether it is an edge
uniform mat4 clip_from_world;
uniform vec3 line_color;
uniform float half_line;
out vec3 green;
flat out vec3 paint;
flat out vec2 reach;  // of the paint, across the line, m
out float passed;
out float across;  // the line, from its middle, m
#ifdef WITH_SHADOW
out vec4 place;
#endif
void main() {
  green = carpet(position.xy, vec2(1.0));
  bool is_edge = line.w > 0.5;
  paint = is_edge ? kHall : line_color;
  reach = is_edge ? vec2(0.0, 1e6) : vec2(-half_line, half_line);
  passed = transmittance(position);
  across = dot(line.xy, position.xy) - line.z;
#ifdef WITH_SHADOW
  place = light_place(position);
#endif
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

// As kFieldFragment, of which one line is left.
const char* const kLineFragment = R"(
in vec3 green;
flat in vec3 paint;
flat in vec2 reach;
in float passed;
in float across;
#ifdef WITH_SHADOW
in vec4 place;
#endif
out vec4 screen;
void main() {
  float f = max(max(abs(dFdx(across)), abs(dFdy(across))), 1e-5);
  float line = clamp((min(across + 0.5 * f, reach.y) - max(across - 0.5 * f, reach.x)) / f, 0.0, 1.0);
#ifdef WITH_SHADOW
  float fraction = direct_fraction(place);
#else
  float fraction = 1.0;
#endif
  screen = vec4(encoded(seen(mix(green, paint, line), fraction, passed)), 1.0);
}
)";

const char* const kFieldFragment = R"(
// Dimensions of the field, m.
uniform vec2 half_field;
uniform vec2 half_carpet;
uniform float half_line;
uniform vec2 goal_area;     // length, half width
uniform vec2 penalty_area;  // length, half width
uniform vec2 penalty_mark;  // distance from the center, half size
uniform vec2 center;        // radius of the circle, half length of the mark
// As in SceneAppearance.
uniform vec3 line_color;
uniform float line_wear;

// Outline of the rectangle between low and high.
float frame(vec2 low, vec2 high, vec2 x, vec2 f) {
  vec2 h = vec2(half_line);
  return rectangle(low - h, high + h, x, f) - rectangle(low + h, high - h, x, f);
}

void main() {
  vec2 p = position_in_world.xy;
  vec2 f = pixel_extent(p);
  vec2 q = abs(p);  // the lines are the same in all four quarters
  vec2 h = vec2(half_line);
  float line = frame(-half_field, half_field, q, f);
  line = max(line, rectangle(vec2(-h.x, -half_field.y), vec2(h.x, half_field.y), q, f));
  line = max(line, frame(vec2(half_field.x - penalty_area.x, -penalty_area.y),
                         vec2(half_field.x, penalty_area.y), q, f));
  line = max(line, frame(vec2(half_field.x - goal_area.x, -goal_area.y),
                         vec2(half_field.x, goal_area.y), q, f));
  vec2 m = vec2(q.x - penalty_mark.x, q.y);
  line = max(line, rectangle(vec2(-penalty_mark.y, -h.y), vec2(penalty_mark.y, h.y), m, f));
  line = max(line, rectangle(vec2(-h.x, -penalty_mark.y), vec2(h.x, penalty_mark.y), m, f));
  line = max(line, rectangle(vec2(-center.y, -h.y), vec2(center.y, h.y), q, f));
  // The circle: the same coverage along the radius.
  float r = length(p);
  vec2 radial = vec2(r, 0.0);
  vec2 fr = vec2(dot(f, q) / max(r, 1e-4), 1.0);
  line = max(line, overlap(vec2(center.x - h.x), vec2(center.x + h.x), radial, fr).x);

#ifdef WITH_WEAR
  line *= 1.0 - line_wear * smoothstep(0.35, 0.75, noise(p * 7.0));
#endif
  float inside = rectangle(-half_carpet, half_carpet, q, f);
  screen = pixel(mix(kHall, mix(carpet(p, f), line_color, line), inside));
}
)";

const char* const kFloorFragment = R"(
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
)";

// A grid of cells over the image, at the depth of the far plane: the sky changes so slowly that its
// color is computed at their corners.
const char* const kSkyVertex = R"(
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
)";

const char* const kColorFragment = R"(
in vec3 color;
out vec4 screen;
void main() {
  screen = vec4(color, 1.0);
}
)";

std::string ground_header(bool with_shadow, bool with_wear = false) {
  return lit_header(with_shadow) + (with_wear ? "#define WITH_WEAR\n" : "") + kHaze;
}

}  // namespace

Source field(bool with_shadow, bool with_wear) {
  return {std::string(kHeader) + kGroundVertex,
          ground_header(with_shadow, with_wear) + kCoverage + kCarpet + kFieldFragment};
}

Source field_line(bool with_shadow) {
  return {ground_header(with_shadow) + kCarpet + kLineVertex,
          ground_header(with_shadow) + kLineFragment};
}

Source carpet(bool with_shadow) {
  return {ground_header(with_shadow) + kCarpet + kCarpetVertex,
          with_shadow ? ground_header(true) + kShadowedCarpetFragment
                      : std::string(kHeader) + kColorFragment};
}

Source floor(bool with_shadow) {
  return {std::string(kHeader) + kGroundVertex,
          ground_header(with_shadow) + kCoverage + kFloorFragment};
}

Source sky() {
  return {std::string(kHeader) + kSkyVertex, std::string(kHeader) + kColorFragment};
}

}  // namespace nao::shaders
