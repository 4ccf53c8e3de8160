#include "rendering/shader_parts.h"

namespace nao::shaders {
namespace {

/** Lighting of all lit surfaces: one directional light, a weak one from the opposite side, and
 * ambient light of sky and ground; SceneAppearance has their intensities. */
const char* const kLighting = R"(
uniform vec3 eye_position;
uniform vec3 light_direction;
uniform mat4 shadow_from_world;
uniform sampler2DShadow shadow_map;
// As in SceneAppearance.
uniform vec3 direct_light;
uniform vec3 ambient_light;
uniform vec4 shade;
uniform float shade_depth;

// Linear red, green, blue.
const vec3 kFillLight = vec3(0.22, 0.22, 0.23);
const vec3 kSkyLight = vec3(0.42, 0.45, 0.49);
const vec3 kGroundLight = vec3(0.26, 0.29, 0.26);
const vec3 kHorizon = vec3(0.70, 0.77, 0.84);

// 1 in the shaded stripe, 0 outside, with a penumbra of 4 cm.
float shade_fraction(vec3 position) {
  return clamp((shade.w - abs(dot(shade.xy, position.xy) - shade.z)) / 0.04, 0.0, 1.0);
}

// Fraction of the direct light that reaches a point: 0 in shadow, 1 outside.
float direct_fraction(vec3 position) {
  float lit_part = 1.0 - shade_depth * shade_fraction(position);
#ifdef WITH_SHADOW
  vec3 in_map = (shadow_from_world * vec4(position, 1.0)).xyz;
  return lit_part * texture(shadow_map, vec3(in_map.xy, min(in_map.z, 0.999)));
#else
  return lit_part;
#endif
}

// Light that a surface sends to the eye: the reflection model of J. Blinn (SIGGRAPH 1977) with
// hemispherical ambient light.
vec3 lit(vec3 albedo, vec3 normal, vec3 position, float gloss) {
  // The shadow is looked up 4 mm outside of the surface: on it, the coarse map would shadow it.
  float fraction = direct_fraction(position + 0.004 * normal);
  float direct = max(dot(normal, light_direction), 0.0) * fraction;
  float fill = max(dot(normal, vec3(-light_direction.xy, 0.0)), 0.0);
  vec3 ambient = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.z);
  vec3 halfway = normalize(light_direction + normalize(eye_position - position));
  float specular = max(dot(normal, halfway), 0.0);
  specular *= specular; specular *= specular; specular *= specular; specular *= specular;
  specular *= specular;  // to the power of 32
  return albedo * (ambient_light * (ambient + fill * kFillLight) + direct * direct_light) +
         gloss * specular * fraction * direct_light;
}

// Linear light to screen values: a square root approximates the sRGB curve.
vec3 encoded(vec3 light) {
  return sqrt(min(light, vec3(1.0)));
}
)";

}  // namespace

std::string lit_header(bool with_shadow) {
  return std::string(kHeader) + (with_shadow ? "#define WITH_SHADOW\n" : "") + kLighting;
}

}  // namespace nao::shaders
