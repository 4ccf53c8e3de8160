// Colors of meshes are stored as square roots (see encode_color()) and become linear light by
// squaring.
#ifdef VERTEX
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 encoded_color;
uniform mat4 clip_from_mesh;
uniform mat4 world_from_mesh;
uniform mat4 normal_from_mesh;
uniform vec4 tint;
#endif
