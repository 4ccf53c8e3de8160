// As field.glsl, for places with one straight line, without wear. Attribute 1: the line's unit
// normal on the ground (x, y), the place of its middle along it, m, and 1 for the edge of the
// carpet, with the normal outwards.
#ifdef VERTEX
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
#else
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
#endif
