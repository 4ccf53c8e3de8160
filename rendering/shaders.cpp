#include "rendering/shaders.h"

namespace nao::shaders {
namespace {

const char* const kHeader = "#version 330 core\n";

/** What every lit surface shares. Light comes from one lamp far away, weakly from the opposite
 * side, and from sky and ground. */
const char* const kLight = R"(
uniform vec3 eye_position;
uniform vec3 light_direction;
uniform mat4 shadow_from_world;
uniform sampler2DShadow shadow_map;

const vec3 kLampLight = vec3(0.66, 0.64, 0.59);
const vec3 kFillLight = vec3(0.22, 0.22, 0.23);
const vec3 kSkyLight = vec3(0.42, 0.45, 0.49);
const vec3 kGroundLight = vec3(0.26, 0.29, 0.26);
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);

// Share of the lamp's light that reaches a point.
float lamp_share(vec3 position) {
#ifdef WITH_SHADOW
  vec3 in_map = (shadow_from_world * vec4(position, 1.0)).xyz;
  return texture(shadow_map, vec3(in_map.xy, min(in_map.z, 0.999)));
#else
  return 1.0;
#endif
}

vec3 lit(vec3 albedo, vec3 normal, vec3 position, float gloss) {
  // A few millimetres out of the surface, where the coarse map does not shade it by itself.
  float share = lamp_share(position + 0.004 * normal);
  float direct = max(dot(normal, light_direction), 0.0) * share;
  float fill = max(dot(normal, vec3(-light_direction.xy, 0.0)), 0.0);
  vec3 ambient = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.z);
  vec3 halfway = normalize(light_direction + normalize(eye_position - position));
  float shine = max(dot(normal, halfway), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  return albedo * (ambient + direct * kLampLight + fill * kFillLight) + gloss * shine * share * kLampLight;
}

// Linear light to screen values; a square root stands for the exact curve.
vec3 encoded(vec3 light) {
  return sqrt(min(light, vec3(1.0)));
}
)";

const char* const kSolidVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 encoded_color;
uniform mat4 clip_from_mesh;
uniform mat4 world_from_mesh;
uniform mat4 normal_from_mesh;
uniform vec4 tint;
out vec3 position_in_world;
out vec3 position_in_mesh;
out vec3 normal_in_world;
flat out vec4 color;
void main() {
  position_in_world = (world_from_mesh * vec4(position, 1.0)).xyz;
  position_in_mesh = position;
  normal_in_world = mat3(normal_from_mesh) * normal;
  color = vec4(encoded_color.rgb * encoded_color.rgb, encoded_color.a) * tint;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
)";

const char* const kSolidFragment = R"(
in vec3 position_in_world;
in vec3 normal_in_world;
flat in vec4 color;
out vec4 screen;
void main() {
  vec3 light = lit(color.rgb, normalize(normal_in_world), position_in_world, 0.18);
  screen = vec4(encoded(light), color.a);
}
)";

// A point of the ball belongs to the face whose plane its ray meets first. Distances of the planes
// from the centre, edge length 1: 2.3274 (pentagons), 2.2673 (hexagons); geometry of the truncated
// icosahedron. By symmetry one of each opposite pair of faces is enough.
const char* const kBallFragment = R"(
in vec3 position_in_world;
in vec3 position_in_mesh;
in vec3 normal_in_world;
out vec4 screen;
const float kA = 0.5257311;  // vertices of the icosahedron: (0, +-a, +-b) and its rotations
const float kB = 0.8506508;
const float kC = 0.5773503;  // vertices of the dodecahedron: (+-c, +-c, +-c), (0, +-d, +-e), ...
const float kD = 0.3568221;
const float kE = 0.9341724;
void main() {
  vec3 n = abs(normalize(position_in_mesh));
  float pentagon = max(max(kA * n.y + kB * n.z, kA * n.z + kB * n.x), kA * n.x + kB * n.y) / 2.3274;
  vec4 hexagons = vec4(kC * (n.x + n.y + n.z), kE * n.y + kD * n.z, kE * n.z + kD * n.x,
                       kE * n.x + kD * n.y) / 2.2673;
  float hexagon = max(max(hexagons.x, hexagons.y), max(hexagons.z, hexagons.w));
  float edge = fwidth(pentagon) + 1e-5;
  float dark = clamp((pentagon - hexagon) / edge + 0.5, 0.0, 1.0);
  vec3 albedo = mix(vec3(0.86), vec3(0.012), dark);
  vec3 light = lit(albedo, normalize(normal_in_world), position_in_world, 0.12);
  screen = vec4(encoded(light), 1.0);
}
)";

const char* const kGroundVertex = R"(
uniform mat4 clip_from_world;
uniform float reach;
out vec3 position_in_world;
void main() {
  vec2 corner = vec2(gl_VertexID == 1 || gl_VertexID == 2 || gl_VertexID == 4 ? 1.0 : -1.0,
                     gl_VertexID == 2 || gl_VertexID == 4 || gl_VertexID == 5 ? 1.0 : -1.0);
  position_in_world = vec3(reach * corner, 0.0);
  gl_Position = clip_from_world * vec4(position_in_world, 1.0);
}
)";

/** Coverage of pixels by rectangles: each pixel is taken as a box on the ground. */
const char* const kCoverage = R"(
in vec3 position_in_world;
out vec4 screen;

// Share of the interval of length f about x that lies between low and high.
vec2 overlap(vec2 low, vec2 high, vec2 x, vec2 f) {
  return clamp((min(x + 0.5 * f, high) - max(x - 0.5 * f, low)) / f, 0.0, 1.0);
}
float rectangle(vec2 low, vec2 high, vec2 x, vec2 f) {
  vec2 share = overlap(low, high, x, f);
  return share.x * share.y;
}
vec2 footprint(vec2 x) {
  return max(max(abs(dFdx(x)), abs(dFdy(x))), vec2(1e-5));
}
// Half of the light comes through 17 m of haze. A fraction stands for the exponential: it is cheaper.
vec3 with_haze(vec3 light, vec3 position) {
  vec3 way = position - eye_position;
  float clear = 1.0 / (1.0 + 0.0014 * dot(way, way));
  return mix(kHorizon, light, clear * clear);
}
)";

const char* const kFieldFragment = R"(
uniform vec2 half_field;
uniform vec2 half_carpet;
uniform float half_line;
uniform vec2 goal_area;     // length, half width
uniform vec2 penalty_area;  // length, half width
uniform vec2 penalty_mark;  // distance from the centre, half size
uniform vec2 centre;        // radius of the circle, half length of the mark

// Outline of the rectangle between low and high.
float frame(vec2 low, vec2 high, vec2 x, vec2 f) {
  vec2 h = vec2(half_line);
  return rectangle(low - h, high + h, x, f) - rectangle(low + h, high - h, x, f);
}

void main() {
  vec2 p = position_in_world.xy;
  vec2 f = footprint(p);
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
  line = max(line, rectangle(vec2(-centre.y, -h.y), vec2(centre.y, h.y), q, f));
  float r = length(p);
  vec2 radial = vec2(r, 0.0);
  vec2 fr = vec2(dot(f, q) / max(r, 1e-4), 1.0);
  line = max(line, overlap(vec2(centre.x - h.x), vec2(centre.x + h.x), radial, fr).x);

  float carpet = rectangle(-half_carpet, half_carpet, q, f);
  // Broad, faint unevenness, as carpet rolls have.
  vec3 wave = abs(fract(vec3(0.33 * p.x, 0.27 * p.y, 0.71 * p.x + 0.47 * p.y)) - 0.5);
  vec3 green = vec3(0.055, 0.235, 0.075) * (0.96 + 0.32 * wave.x * wave.y + 0.05 * wave.z);
  vec3 hall = vec3(0.46, 0.47, 0.49);
  vec3 albedo = mix(hall, mix(green, vec3(0.80), line), carpet);

  float share = lamp_share(position_in_world);
  vec3 light = albedo * (kSkyLight + share * light_direction.z * kLampLight);
  screen = vec4(encoded(with_haze(light, position_in_world)), 1.0);
}
)";

const char* const kFloorFragment = R"(
void main() {
  vec2 p = position_in_world.xy;
  vec2 f = footprint(p);
  // Thin joints between tiles of 0.5 m.
  vec2 tile = abs(fract(2.0 * p) - 0.5) * 0.5;
  vec2 joint = overlap(vec2(0.246), vec2(0.254), tile, f);
  vec2 cell = floor(2.0 * p);
  float checker = mod(cell.x + cell.y, 2.0);
  float blur = clamp(1.0 - 2.0 * max(f.x, f.y), 0.0, 1.0);
  float tone = 0.40 + 0.05 * (checker - 0.5) * blur;
  vec3 albedo = mix(vec3(tone), vec3(0.22), 0.6 * max(joint.x, joint.y));
  float share = lamp_share(position_in_world);
  vec3 light = albedo * (kSkyLight + share * light_direction.z * kLampLight);
  screen = vec4(encoded(with_haze(light, position_in_world)), 1.0);
}
)";

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
  float share = 1.0 - (1.0 - height) * (1.0 - height);
  screen = vec4(sqrt(mix(kHorizon, kZenith, share)), 1.0);
}
)";

const char* const kDepthVertex = R"(
layout(location = 0) in vec3 position;
uniform mat4 clip_from_mesh;
void main() {
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
)";

const char* const kDepthFragment = R"(
void main() {}
)";

const char* const kNetVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 data;  // position on the net, m
uniform mat4 clip_from_world;
out vec2 on_net;
void main() {
  on_net = data.xy;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char* const kNetFragment = R"(
in vec2 on_net;
out vec4 screen;
const float kMesh = 0.08;    // distance between strings, m
const float kString = 0.004; // width of a string, m
void main() {
  vec2 f = max(fwidth(on_net), vec2(1e-5));
  vec2 from_string = abs(fract(on_net / kMesh) - 0.5) * kMesh;
  vec2 share = clamp((0.5 * kString + 0.5 * f - (0.5 * kMesh - from_string)) / f, 0.0, 1.0);
  share = min(share, kString / f);
  // Where a pixel holds several meshes, their mean.
  share = mix(share, vec2(kString / kMesh), clamp(f / kMesh * 2.0 - 0.5, 0.0, 1.0));
  screen = vec4(vec3(0.93), 0.9 * (1.0 - (1.0 - share.x) * (1.0 - share.y)));
}
)";

const char* const kPlainVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 clip_from_world;
flat out vec4 flat_color;
void main() {
  flat_color = color;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
)";

const char* const kPlainFragment = R"(
flat in vec4 flat_color;
out vec4 screen;
void main() {
  screen = vec4(sqrt(flat_color.rgb), flat_color.a);
}
)";

std::string lit_header(bool with_shadow) {
  return std::string(kHeader) + (with_shadow ? "#define WITH_SHADOW\n" : "") + kLight;
}

}  // namespace

Source solid(bool with_shadow) {
  return {std::string(kHeader) + kSolidVertex, lit_header(with_shadow) + kSolidFragment};
}

Source ball(bool with_shadow) {
  return {std::string(kHeader) + kSolidVertex, lit_header(with_shadow) + kBallFragment};
}

Source field(bool with_shadow) {
  return {std::string(kHeader) + kGroundVertex,
          lit_header(with_shadow) + kCoverage + kFieldFragment};
}

Source floor(bool with_shadow) {
  return {std::string(kHeader) + kGroundVertex,
          lit_header(with_shadow) + kCoverage + kFloorFragment};
}

Source sky() {
  return {std::string(kHeader) + kSkyVertex, std::string(kHeader) + kSkyFragment};
}

Source depth() {
  return {std::string(kHeader) + kDepthVertex, std::string(kHeader) + kDepthFragment};
}

Source net() {
  return {std::string(kHeader) + kNetVertex, std::string(kHeader) + kNetFragment};
}

Source plain() {
  return {std::string(kHeader) + kPlainVertex, std::string(kHeader) + kPlainFragment};
}

}  // namespace nao::shaders
