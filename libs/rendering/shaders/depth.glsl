// Depth only, for the shadow map and for translucent bodies.
#ifdef VERTEX
layout(location = 0) in vec3 position;
uniform mat4 clip_from_mesh;
void main() {
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
#else
void main() {}
#endif
