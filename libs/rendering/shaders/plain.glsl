// Unlit colored lines and triangles.
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 color;
uniform mat4 clip_from_world;
flat out vec4 flat_color;
void main() {
  flat_color = color;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
#else
flat in vec4 flat_color;
out vec4 screen;
void main() {
  screen = vec4(sqrt(flat_color.rgb), flat_color.a);
}
#endif
