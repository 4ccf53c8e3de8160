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
// Light after haze, of which half is left after 17 m. A rational function approximates the exponential
// of Beer's law because it is faster.
vec3 with_haze(vec3 light, vec3 position) {
  vec3 ray = position - eye_position;
  float transmittance = 1.0 / (1.0 + 0.0014 * dot(ray, ray));
  return mix(kHorizon, light, transmittance * transmittance);
}
// What the camera sees of ground of this color.
vec4 seen(vec3 albedo) {
  float fraction = direct_fraction(light_place(position_in_world));
  vec3 light = albedo * (ambient_light * kSkyLight + fraction * light_direction.z * direct_light);
  return vec4(encoded(with_haze(light, position_in_world)), 1.0);
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

const char* const kCarpetFragment = R"(
void main() {
  vec2 p = position_in_world.xy;
  screen = seen(carpet(p, pixel_extent(p)));
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
  vec3 hall = vec3(0.46, 0.47, 0.49);
  screen = seen(mix(hall, mix(carpet(p, f), line_color, line), inside));
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
  screen = seen(albedo);
}
)";

// One triangle that covers the whole image, at the depth of the far plane.
const char* const kSkyVertex = R"(
uniform mat4 world_from_clip;
out vec3 direction;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  direction = (world_from_clip * vec4(corner, 1.0, 1.0)).xyz;
  gl_Position = vec4(corner, 1.0, 1.0);
}
)";

const char* const kSkyFragment = R"(
in vec3 direction;
out vec4 screen;
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);
const vec3 kZenith = vec3(0.20, 0.33, 0.55);
void main() {
  float height = clamp(direction.z / length(direction), 0.0, 1.0);
  float fraction = 1.0 - (1.0 - height) * (1.0 - height);
  screen = vec4(sqrt(mix(kHorizon, kZenith, fraction)), 1.0);
}
)";

std::string carpet_header(bool with_shadow, bool with_wear) {
  return lit_header(with_shadow) + (with_wear ? "#define WITH_WEAR\n" : "") + kCoverage + kCarpet;
}

}  // namespace

Source field(bool with_shadow, bool with_wear) {
  return {std::string(kHeader) + kGroundVertex,
          carpet_header(with_shadow, with_wear) + kFieldFragment};
}

Source carpet(bool with_shadow, bool with_wear) {
  return {std::string(kHeader) + kGroundVertex,
          carpet_header(with_shadow, with_wear) + kCarpetFragment};
}

Source floor(bool with_shadow) {
  return {std::string(kHeader) + kGroundVertex,
          lit_header(with_shadow) + kCoverage + kFloorFragment};
}

Source sky() {
  return {std::string(kHeader) + kSkyVertex, std::string(kHeader) + kSkyFragment};
}

}  // namespace nao::shaders
