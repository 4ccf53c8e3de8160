// The soccer ball, with the pattern of a truncated icosahedron: a point belongs to the face whose
// plane its ray from the center meets first. Distances of the planes from the center for edges of
// length 1: 2.3274 (pentagons) and 2.2673 (hexagons). By symmetry one of each pair of opposite faces
// is enough.
#ifdef VERTEX
out vec3 position_in_world;
out vec3 position_in_mesh;
out vec3 normal_in_world;
void main() {
  position_in_world = (world_from_mesh * vec4(position, 1.0)).xyz;
  position_in_mesh = position;
  normal_in_world = mat3(normal_from_mesh) * normal;
  gl_Position = clip_from_mesh * vec4(position, 1.0);
}
#else
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
#endif
