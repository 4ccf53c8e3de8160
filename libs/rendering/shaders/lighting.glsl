// Lighting of all lit surfaces: one directional light, a weak one from the opposite side, and
// ambient light of sky and ground; SceneAppearance has their intensities. Colors are linear light;
// encoded() is the last step.
// WITH_SHADOW: the light is looked up in the shadow map.
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

// Place of a point for direct_fraction(): in the shadow map, and its distance from the middle of the
// shaded stripe, m. Both are linear in the position, so that the stages between vertices and
// fragments may interpolate them.
vec4 light_place(vec3 position) {
  return vec4((shadow_from_world * vec4(position, 1.0)).xyz,
              dot(shade.xy, position.xy) - shade.z);
}

// Fraction of the direct light that reaches a point: 0 in shadow, 1 outside. The shaded stripe has a
// penumbra of 4 cm.
float direct_fraction(vec4 place) {
  float lit_part = 1.0 - shade_depth * clamp((shade.w - abs(place.w)) / 0.04, 0.0, 1.0);
#ifdef WITH_SHADOW
  return lit_part * texture(shadow_map, vec3(place.xy, min(place.z, 0.999)));
#else
  return lit_part;
#endif
}

// Place for direct_fraction() on a surface: 4 mm outside of it, since the coarse map would shadow the
// surface itself.
vec4 surface_light_place(vec3 position, vec3 normal) {
  return light_place(position + 0.004 * normal);
}

// Light that a surface sends to the eye: the reflection model of J. Blinn (SIGGRAPH 1977) with
// hemispherical ambient light, in two parts. The direct part is for a point outside of shadows.
vec3 ambient_part(vec3 albedo, vec3 normal) {
  float fill = max(dot(normal, vec3(-light_direction.xy, 0.0)), 0.0);
  vec3 ambient = mix(kGroundLight, kSkyLight, 0.5 + 0.5 * normal.z);
  return albedo * ambient_light * (ambient + fill * kFillLight);
}
vec3 direct_part(vec3 albedo, vec3 normal, vec3 position, float gloss) {
  float direct = max(dot(normal, light_direction), 0.0);
  vec3 halfway = normalize(light_direction + normalize(eye_position - position));
  float specular = max(dot(normal, halfway), 0.0);
  specular *= specular; specular *= specular; specular *= specular; specular *= specular;
  specular *= specular;  // to the power of 32
  return (albedo * direct + gloss * specular) * direct_light;
}

// Linear light to screen values: a square root approximates the sRGB curve.
vec3 encoded(vec3 light) {
  return sqrt(min(light, vec3(1.0)));
}
