// The plane z = 0 as a carpet with the lines of a soccer field.
#ifndef VERTEX
// Dimensions of the field, m.
uniform vec2 half_field;
uniform vec2 half_carpet;
uniform float half_line;
uniform vec2 goal_area;     // length, half width
uniform vec2 penalty_area;  // length, half width
uniform vec2 penalty_mark;  // distance from the center, half size
uniform vec2 center;        // radius of the circle, half length of the mark
// As in SceneAppearance.
uniform vec3 line_color;
uniform float line_wear;

// Outline of the rectangle between low and high.
float frame(vec2 low, vec2 high, vec2 x, vec2 f) {
  vec2 h = vec2(half_line);
  return rectangle(low - h, high + h, x, f) - rectangle(low + h, high - h, x, f);
}

void main() {
  vec2 p = position_in_world.xy;
  vec2 f = pixel_extent(p);
  vec2 q = abs(p);  // the lines are the same in all four quarters
  vec2 h = vec2(half_line);
  float line = frame(-half_field, half_field, q, f);
  line = max(line, rectangle(vec2(-h.x, -half_field.y), vec2(h.x, half_field.y), q, f));
  line = max(line, frame(vec2(half_field.x - penalty_area.x, -penalty_area.y),
                         vec2(half_field.x, penalty_area.y), q, f));
  line = max(line, frame(vec2(half_field.x - goal_area.x, -goal_area.y),
                         vec2(half_field.x, goal_area.y), q, f));
  vec2 m = vec2(q.x - penalty_mark.x, q.y);
  line = max(line, rectangle(vec2(-penalty_mark.y, -h.y), vec2(penalty_mark.y, h.y), m, f));
  line = max(line, rectangle(vec2(-h.x, -penalty_mark.y), vec2(h.x, penalty_mark.y), m, f));
  line = max(line, rectangle(vec2(-center.y, -h.y), vec2(center.y, h.y), q, f));
  // The circle: the same coverage along the radius.
  float r = length(p);
  vec2 radial = vec2(r, 0.0);
  vec2 fr = vec2(dot(f, q) / max(r, 1e-4), 1.0);
  line = max(line, overlap(vec2(center.x - h.x), vec2(center.x + h.x), radial, fr).x);

#ifdef WITH_WEAR
  line *= 1.0 - line_wear * smoothstep(0.35, 0.75, noise(p * 7.0));
#endif
  float inside = rectangle(-half_carpet, half_carpet, q, f);
  screen = pixel(mix(kHall, mix(carpet(p, f), line_color, line), inside));
}
#endif
