// Lit meshes.
// Light is computed at the vertices, which are fewer than pixels (H. Gouraud, "Continuous shading
// of curved surfaces", 1971); shadows, too, or, with SHADOW_AT_PIXELS, at each pixel.
#ifdef VERTEX
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
#else
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
#endif
