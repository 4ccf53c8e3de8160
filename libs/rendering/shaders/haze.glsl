// What the camera sees of the ground.
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
