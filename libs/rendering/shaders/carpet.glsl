// Patches of the carpet without lines, without wear.
// Color and light of a carpet without texture, and of the hall around it, change so slowly that
// they are computed at the corners of patches; where they may be in shadow, once with and once
// without direct light. is_hall: the ground around the carpet.
#ifdef VERTEX
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
#else
#ifdef WITH_SHADOW
in vec3 lit;
in vec3 shadowed;
in vec4 place;
out vec4 screen;
void main() {
  screen = vec4(encoded(mix(shadowed, lit, direct_fraction(place))), 1.0);
}
#else
in vec3 color;
out vec4 screen;
void main() {
  screen = vec4(color, 1.0);
}
#endif
#endif
