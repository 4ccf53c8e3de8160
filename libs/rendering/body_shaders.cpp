#include "rendering/shaders.h"

#include "rendering/shader_parts.h"

namespace nao::shaders {
namespace {

// Colors of meshes are stored as square roots (see encode_color()) and become linear light by
// squaring.
const char* const kMeshVertex = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 encoded_color;
uniform mat4 clip_from_mesh;
uniform mat4 world_from_mesh;
uniform mat4 normal_from_mesh;
uniform vec4 tint;
)";

// Light is computed at the vertices, which are fewer than pixels (H. Gouraud, "Continuous shading
// of curved surfaces", 1971); shadows, too, or at each pixel.
const char* const kSolidVertex = R"(
#ifdef SHADOW_AT_PIXELS
out vec3 ambient;
out vec3 direct;
out vec4 place;
#else
out vec3 color;
#endif
flat out float opacity;
void main() {
  vec3 position_in_world = (world_from_mesh * vec4(position, 1.0)).xyz;
  vec3 unit_normal = normalize(mat3(normal_from_mesh) * normal);
  vec3 albedo = encoded_color.rgb * encoded_color.rgb * tint.rgb;
  vec3 ambient_light_sent = ambient_part(albedo, unit_normal);
  vec3 direct_light_sent = direct_part(albedo, unit_normal, position_in_world, 0.18);
  vec4 light_place_here = surface_light_place(position_in_world, unit_normal);
#ifdef SHADOW_AT_PIXELS
  ambient = ambient_light_sent;
  direct = direct_light_sent;
  place = light_place_here;
#else
  color = encoded(ambient_light_sent + direct_fraction(light_place_here) * direct_light_sent);
#endif
  opacity = encoded_color.a * tint.a;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
)";

const char* const kSolidFragment = R"(
#ifdef SHADOW_AT_PIXELS
in vec3 ambient;
in vec3 direct;
in vec4 place;
#else
in vec3 color;
#endif
flat in float opacity;
out vec4 screen;
void main() {
#ifdef SHADOW_AT_PIXELS
  vec3 color = encoded(ambient + direct_fraction(place) * direct);
#endif
  screen = vec4(color, opacity);
}
)";

const char* const kBallVertex = R"(
out vec3 position_in_world;
out vec3 position_in_mesh;
out vec3 normal_in_world;
void main() {
  position_in_world = (world_from_mesh * vec4(position, 1.0)).xyz;
  position_in_mesh = position;
  normal_in_world = mat3(normal_from_mesh) * normal;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
)";

// The pattern of a truncated icosahedron: a point belongs to the face whose plane its ray from the
// center meets first. Distances of the planes from the center for edges of length 1: 2.3274
// (pentagons) and 2.2673 (hexagons). By symmetry one of each pair of opposite faces is enough.
const char* const kBallFragment = R"(
in vec3 position_in_world;
in vec3 position_in_mesh;
in vec3 normal_in_world;
uniform vec4 tint;  // albedo of the hexagons; of the pentagons
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
  vec3 albedo = mix(tint.rgb, vec3(tint.a), dark);
  vec3 normal = normalize(normal_in_world);
  float fraction = direct_fraction(surface_light_place(position_in_world, normal));
  vec3 light = ambient_part(albedo, normal) +
               fraction * direct_part(albedo, normal, position_in_world, 0.12);
  screen = vec4(encoded(light), 1.0);
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

}  // namespace

Source solid(bool with_shadow, bool at_pixels) {
  const std::string header =
      lit_header(with_shadow) + (at_pixels ? "#define SHADOW_AT_PIXELS\n" : "");
  return {header + kMeshVertex + kSolidVertex, header + kSolidFragment};
}

Source ball(bool with_shadow) {
  return {lit_header(with_shadow) + kMeshVertex + kBallVertex,
          lit_header(with_shadow) + kBallFragment};
}

Source depth() {
  return {std::string(kHeader) + kDepthVertex, std::string(kHeader) + kDepthFragment};
}

}  // namespace nao::shaders
