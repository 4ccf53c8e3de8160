// Goal nets: quads whose strings cover a fraction of each pixel.
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 data;  // position on the net, m
uniform mat4 clip_from_world;
out vec2 on_net;
void main() {
  on_net = data.xy;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
#else
in vec2 on_net;
out vec4 screen;
const float kMesh = 0.08;     // distance between strings, m
const float kString = 0.004;  // width of a string, m
void main() {
  vec2 f = max(fwidth(on_net), vec2(1e-5));
  vec2 from_string = abs(fract(on_net / kMesh) - 0.5) * kMesh;
  vec2 fraction = clamp((0.5 * kString + 0.5 * f - (0.5 * kMesh - from_string)) / f, 0.0, 1.0);
  fraction = min(fraction, kString / f);
  // Where a pixel holds several meshes: their mean coverage.
  fraction = mix(fraction, vec2(kString / kMesh), clamp(f / kMesh * 2.0 - 0.5, 0.0, 1.0));
  screen = vec4(vec3(0.93), 0.9 * (1.0 - (1.0 - fraction.x) * (1.0 - fraction.y)));
}
#endif
