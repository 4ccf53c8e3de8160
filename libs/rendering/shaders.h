#pragma once

#include <string>

/** GLSL sources. Colors inside are linear light; the last step encodes them for the screen. */
namespace nao::shaders {

struct Source {
  std::string vertex;
  std::string fragment;
};

/** Lit meshes. @param with_shadow  Whether they receive shadows from the shadow map.
 * @param at_pixels  Whether shadows are looked up at each pixel, not only at the vertices. */
Source solid(bool with_shadow, bool at_pixels);

/** The soccer ball: as solid(), with the pattern of a truncated icosahedron. */
Source ball(bool with_shadow);

/** The plane z = 0 as a carpet with the lines of a soccer field.
 * @param with_wear  Whether the carpet has a texture and the lines are worn, which is expensive. */
Source field(bool with_shadow, bool with_wear);

/** As field(), for places with one straight line, without wear. Attribute 1: the line's unit normal
 * on the ground (x, y), the place of its middle along it, m, and 1 for the edge of the carpet, with
 * the normal outwards. */
Source field_line(bool with_shadow);

/** As field(), for patches without lines, without wear. Uniform is_hall: the ground around the
 * carpet. */
Source carpet(bool with_shadow);

/** The plane z = 0 as a tiled floor. */
Source floor(bool with_shadow);

/** Background of all pixels that nothing else covers. */
Source sky();

/** Depth only, for the shadow map and for translucent bodies. */
Source depth();

/** Goal nets: quads whose strings cover a fraction of each pixel. */
Source net();

/** Unlit colored lines and triangles. */
Source plain();

}  // namespace nao::shaders
