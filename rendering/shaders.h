#pragma once

#include <string>

/** The shaders' sources. Colours inside are linear light; the last step encodes them for the
 * screen. */
namespace nao::shaders {

struct Source {
  std::string vertex;
  std::string fragment;
};

/** Lit meshes. @param with_shadow  Whether they receive shadows from the shadow map. */
Source solid(bool with_shadow);

/** The soccer ball: as solid(), with the pattern of a truncated icosahedron. */
Source ball(bool with_shadow);

/** Ground plane, as carpet with lines or as plain floor. */
Source field(bool with_shadow);
Source floor(bool with_shadow);

/** Background behind everything. */
Source sky();

/** Depth alone, for the shadow map and for translucent bodies. */
Source depth();

/** Goal nets: quads whose strings cover a share of each pixel. */
Source net();

/** Unlit coloured lines and triangles. */
Source plain();

}  // namespace nao::shaders
