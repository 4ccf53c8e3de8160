// The bodies of tree_kernels.cpp and tree_kernels_avx2.cpp, which define in their own namespaces:
// Vec, a vector of three numbers, and Quad, four entries of a row, with the operations on them.

/** a x. */
inline Vec product(const Vec* a, const Packed3& x) {
  return a[0] * x.x + a[1] * x.y + a[2] * x.z;
}

struct Spatial {
  Vec angular;
  Vec linear;
};

inline Spatial load(const PackedSpatial& v) {
  return {load(v.angular), load(v.linear)};
}
inline void store(const Spatial& v, PackedSpatial& to) {
  store(v.angular, to.angular);
  store(v.linear, to.linear);
}

// Spatial inertia times spatial velocity, both about O: angular momentum I w + h x v and linear
// momentum m v - h x w, with the first moment h = m c.
inline Spatial multiply(const PackedInertia& i, const PackedSpatial& v) {
  const Vec inertia[3] = {load(i.inertia.columns[0]), load(i.inertia.columns[1]),
                          load(i.inertia.columns[2])};
  const Vec moment = load(i.moment);
  return {product(inertia, v.angular) + cross(moment, load(v.linear)),
          load(v.linear) * i.mass - cross(moment, load(v.angular))};
}

// Power of a spatial force on a spatial motion; their dual pairing needs no metric.
inline double dot(const PackedSpatial& motion, const Spatial& force) {
  return dot(load(motion.angular), force.angular) + dot(load(motion.linear), force.linear);
}

/** Rotation by an angle about a unit axis (Rodrigues' formula): its columns. */
inline void rotation_about(const Packed3& a, double angle, PackedMatrix& r) {
  const double s = std::sin(angle);
  const double c = std::cos(angle);
  const double rest = 1 - c;
  const double tx = rest * a.x;
  const double ty = rest * a.y;
  const double tz = rest * a.z;
  r.columns[0].x = tx * a.x + c;
  r.columns[0].y = tx * a.y + s * a.z;
  r.columns[0].z = tx * a.z - s * a.y;
  r.columns[1].x = tx * a.y - s * a.z;
  r.columns[1].y = ty * a.y + c;
  r.columns[1].z = ty * a.z + s * a.x;
  r.columns[2].x = tx * a.z + s * a.y;
  r.columns[2].y = ty * a.z - s * a.x;
  r.columns[2].z = tz * a.z + c;
}

/** Inertia about O in W's axes: rotated, and moved by the parallel axis theorem. */
inline void turn_inertia(const BodyConstants& body, const Vec* r, const Vec& com, BodyState& now) {
  const PackedMatrix& rotation = now.rotation;
  store(com, now.com_from_O);
  const Packed3& c = now.com_from_O;
  const Vec moment = com * body.mass;
  now.inertia.mass = body.mass;
  store(moment, now.inertia.moment);
  Vec half[3];
  for (int i = 0; i < 3; ++i) half[i] = product(r, body.inertia.columns[i]);
  // r s r^T is symmetric: its lower triangle serves for both halves.
  const Packed3* columns = rotation.columns;
  Vec x = half[0] * columns[0].x + half[1] * columns[1].x + half[2] * columns[2].x;
  Vec y = half[0] * columns[0].y + half[1] * columns[1].y + half[2] * columns[2].y;
  Vec z = half[0] * columns[0].z + half[1] * columns[1].z + half[2] * columns[2].z;
  mirror(x, y, z);
  add_diagonal(body.mass * dot(com, com), x, y, z);
  store(x - moment * c.x, now.inertia.inertia.columns[0]);
  store(y - moment * c.y, now.inertia.inertia.columns[1]);
  store(z - moment * c.z, now.inertia.inertia.columns[2]);
}

void update_kinematics(const BodyConstants* bodies, int count, const double* coordinate,
                       const double* velocity, BodyState* states) {
  const Vec origin = load(states[0].position);
  // Parents come before their children, so that one pass from the root outwards suffices.
  for (int index = 0; index < count; ++index) {
    const BodyConstants& body = bodies[index];
    BodyState& now = states[index];
    Vec r[3];
    Vec position;
    if (index == 0) {
      for (int i = 0; i < 3; ++i) r[i] = load(now.rotation.columns[i]);
      position = origin;
    } else {
      const BodyState& parent = states[body.parent];
      PackedMatrix turn;
      rotation_about(body.axis, body.ratio * coordinate[body.dof] + body.offset, turn);
      const Vec parents[3] = {load(parent.rotation.columns[0]), load(parent.rotation.columns[1]),
                              load(parent.rotation.columns[2])};
      Vec before[3] = {parents[0], parents[1], parents[2]};
      if (!body.is_parallel) {
        for (int i = 0; i < 3; ++i)
          before[i] = product(parents, body.rotation_in_parent.columns[i]);
      }
      for (int i = 0; i < 3; ++i) {
        r[i] = product(before, turn.columns[i]);
        store(r[i], now.rotation.columns[i]);
      }
      // R_WB = R_WP R_PB(0) R(axis, angle) above, p_WB = p_WP + R_WP p_PB here.
      position = load(parent.position) + product(parents, body.origin_in_parent);
      store(position, now.position);
      // The joint's axis is the same in B at all angles.
      const Vec axis = product(r, body.axis) * body.ratio;
      // Spatial motion S of a revolute joint about O: angular part the axis, linear part the
      // velocity of the point at O, which is (p_WB - O) x axis. The ratio is 1 unless the joint is
      // a mimic.
      const Spatial motion{axis, cross(position - origin, axis)};
      store(motion, now.motion);
      now.rate = velocity[body.dof];
      store({load(parent.velocity.angular) + motion.angular * now.rate,
             load(parent.velocity.linear) + motion.linear * now.rate},
            now.velocity);
    }
    turn_inertia(body, r, product(r, body.center_of_mass) + (position - origin), now);
  }
}

void update_velocities(const BodyConstants* bodies, int count, const double* velocity,
                       BodyState* states) {
  // With the poses unchanged the motions S are unchanged: velocities are sums of rate * S.
  for (int index = 1; index < count; ++index) {
    BodyState& now = states[index];
    const PackedSpatial& above = states[bodies[index].parent].velocity;
    now.rate = velocity[bodies[index].dof];
    store({load(above.angular) + load(now.motion.angular) * now.rate,
           load(above.linear) + load(now.motion.linear) * now.rate},
          now.velocity);
  }
}

void add_mass_rows(const BodyConstants* bodies, int count, bool is_root_fixed, BodyState* states,
                   double* mass) {
  // Composite rigid bodies: M(i, j) = S_j . (I_i S_i), where I_i is the inertia of everything that
  // joint i carries, and j is an ancestor of i.
  for (int index = 0; index < count; ++index) states[index].composite = states[index].inertia;
  for (int index = count - 1; index > 0; --index) {
    const BodyConstants& body = bodies[index];
    BodyState& now = states[index];
    PackedInertia& above = states[body.parent].composite;
    above.mass += now.composite.mass;
    store(load(above.moment) + load(now.composite.moment), above.moment);
    for (int i = 0; i < 3; ++i) {
      store(load(above.inertia.columns[i]) + load(now.composite.inertia.columns[i]),
            above.inertia.columns[i]);
    }
    // A mimic's body adds to the row of its leader's dof: the sum over both bodies, with their
    // ratios in S, is T^T M T of the coupled system.
    const Spatial force = multiply(now.composite, now.motion);
    store(force, now.unit_force);
    double* row = mass + body.row;
    if (body.place >= 0) {
      // The body's chain: the root's six, then a joint for each body on the way.
      int place = body.place;
      row[place] += dot(now.motion, force);
      for (int other = body.parent; other > 0; other = bodies[other].parent) {
        row[--place] += dot(states[other].motion, force);
      }
    }
    if (is_root_fixed) continue;
    // Row of the joint, columns of the root: for the root S is the unit matrix, so that the entries
    // are the force itself.
    row[0] += now.unit_force.angular.x;
    row[1] += now.unit_force.angular.y;
    row[2] += now.unit_force.angular.z;
    row[3] += now.unit_force.linear.x;
    row[4] += now.unit_force.linear.y;
    row[5] += now.unit_force.linear.z;
  }
}

void calc_bias(const BodyConstants* bodies, int count, const double* gravity, BodyState* states,
               double* bias) {
  // Recursive Newton-Euler with generalized accelerations of 0. Outwards: velocity-product
  // accelerations, and the forces that they need. Gravity is an upward acceleration of the root. A
  // root whose velocity is constant has the spatial acceleration -omega x v (Featherstone 2.11).
  Packed3 down;
  down.x = gravity[0];
  down.y = gravity[1];
  down.z = gravity[2];
  for (int index = 0; index < count; ++index) {
    BodyState& now = states[index];
    const Spatial v = load(now.velocity);
    if (index == 0) {
      store({Vec{}, -cross(v.angular, v.linear) - load(down)}, now.acceleration);
    } else {
      // a = a_parent + v x (S q'): the time derivative of S q' in a fixed frame, as spatial cross
      // product (w x w_s, w x v_s + v x w_s).
      const PackedSpatial& above = states[bodies[index].parent].acceleration;
      const Vec turning = load(now.motion.angular) * now.rate;
      const Vec moving = load(now.motion.linear) * now.rate;
      store({load(above.angular) + cross(v.angular, turning),
             load(above.linear) + cross(v.angular, moving) + cross(v.linear, turning)},
            now.acceleration);
    }
    // f = I a + v x* (I v): the momentum's rate of change, with the force cross product (w x n + v
    // x f, w x f).
    const Spatial momentum = multiply(now.inertia, now.velocity);
    Spatial force = multiply(now.inertia, now.acceleration);
    force.angular =
        force.angular + (cross(v.angular, momentum.angular) + cross(v.linear, momentum.linear));
    force.linear = force.linear + cross(v.angular, momentum.linear);
    store(force, now.force);
  }
  // Inwards: forces through the joints.
  for (int index = count - 1; index > 0; --index) {
    const BodyState& now = states[index];
    const Spatial force = load(now.force);
    // Generalized bias force: power of the joint's motion.
    bias[bodies[index].dof] += dot(now.motion, force);
    PackedSpatial& above = states[bodies[index].parent].force;
    store({load(above.angular) + force.angular, load(above.linear) + force.linear}, above);
  }
}

/** Most quads of a row whose depth is a constant of factorize(). */
constexpr int kMostQuads = 3;

/** Scales the row of L of a dof, and subtracts its outer product from its ancestors' rows from the
 * one at place `first_ancestor` on. */
template <class Depth>
[[gnu::always_inline]] inline void eliminate(const MatrixRow& row, Depth depth, int first_ancestor,
                                             double diagonal, double* factor, double* inverse) {
  double* entries = factor + row.first;
  const double root = __builtin_sqrt(entries[depth] + diagonal);
  const double scale = 1 / root;
  if constexpr (std::is_same_v<Depth, int>) {
    for (int i = 0; i < depth; ++i) entries[i] *= scale;
    entries[depth] = 0;
    // Schur complement. What this adds behind the diagonal of an ancestor's row is never read.
    for (int a = first_ancestor; a < depth; ++a) {
      double* target = factor + row.ancestors[a];
      for (int i = 0; i <= a; ++i) target[i] -= entries[a] * entries[i];
    }
  } else {
    // The same, with the row in registers.
    Quad quads[kMostQuads];
    for (int q = 0; 4 * q < depth; ++q) {
      quads[q] = load_quad(entries + 4 * q) * scale;
      store_quad(quads[q], entries + 4 * q);
    }
    for (int a = first_ancestor; a < depth; ++a) {
      double* target = factor + row.ancestors[a];
      for (int q = 0; q <= a / 4; ++q) {
        store_quad(load_quad(target + 4 * q) - quads[q] * entries[a], target + 4 * q);
      }
    }
  }
  entries[depth] = root;
  inverse[row.first + depth] = scale;
}

/** Dofs of the root, the first ones. */
constexpr int kRootDofs = 6;

/** Subtracts the outer products of the joints' rows from the root's, which stay in registers. */
inline void eliminate_from_root(const MatrixRow* rows, int num_dofs, double* factor) {
  // Entries 0 to 3 of each row, and 4 and 5 of the last two.
  Quad low[kRootDofs];
  Quad high[kRootDofs];
  for (int a = 0; a < kRootDofs; ++a) {
    low[a] = load_quad(factor + rows[a].first);
    high[a] = load_quad(factor + rows[a].first + 4);
  }
  for (int k = num_dofs - 1; k >= kRootDofs; --k) {
    const double* entries = factor + rows[k].first;
    const Quad first = load_quad(entries);
    const Quad second = load_quad(entries + 4);
    for (int a = 0; a < kRootDofs; ++a) {
      low[a] = low[a] - first * entries[a];
      if (a >= 4) high[a] = high[a] - second * entries[a];
    }
  }
  for (int a = 0; a < kRootDofs; ++a) {
    store_quad(low[a], factor + rows[a].first);
    if (a >= 4) store_quad(high[a], factor + rows[a].first + 4);
  }
}

template <class Depth>
[[gnu::always_inline]] inline void invert(const MatrixRow& row, Depth depth, const double* factor,
                                          double* inverse) {
  const double* entries = factor + row.first;
  double* result = inverse + row.first;
  const double scale = result[depth];
  if constexpr (std::is_same_v<Depth, int>) {
    for (int i = 0; i < depth; ++i) result[i] = 0;
    for (int k = 0; k < depth; ++k) {
      const double weight = -scale * entries[k];
      const double* above = inverse + row.ancestors[k];
      for (int i = 0; i <= k; ++i) result[i] += weight * above[i];
    }
  } else {
    Quad sums[kMostQuads];
    for (int q = 0; 4 * q < depth; ++q) sums[q] = Quad{};
    for (int k = 0; k < depth; ++k) {
      const double weight = -scale * entries[k];
      const double* above = inverse + row.ancestors[k];
      for (int q = 0; q <= k / 4; ++q) sums[q] = sums[q] + load_quad(above + 4 * q) * weight;
    }
    for (int q = 0; 4 * q < depth; ++q) store_quad(sums[q], result + 4 * q);
  }
  result[depth] = scale;
}

void factorize(const MatrixRow* rows, const int* order, int num_dofs, const double* diagonal,
               double* factor, double* inverse, double* squares) {
  // L^T L of a tree (Featherstone, table 6.3): eliminates the leaves first, so that no fill-in
  // occurs. Row k of L is sqrt on the diagonal and M(k, j) / sqrt for its ancestors j. Each row
  // changes those of its ancestors only, whose rows are as long as their places in the row: the
  // entries of one are for the same dofs as the first ones of the other. The root's rows, which all
  // change, come when all others are done.
  for (int i = 0; i < num_dofs - kRootDofs; ++i) {
    const int k = order[i];
    with_constant<6, 11>(rows[k].depth, [&](auto depth) {
      eliminate(rows[k], depth, kRootDofs, diagonal[k], factor, inverse);
    });
  }
  eliminate_from_root(rows, num_dofs, factor);
  for (int k = kRootDofs - 1; k >= 0; --k) {
    eliminate(rows[k], rows[k].depth, 0, diagonal[k], factor, inverse);
  }
  // L L^-1 = 1, row by row: L_dd (L^-1)_d = e_d - sum of L_da (L^-1)_a over the ancestors a of d,
  // whose rows are beginnings of the row of d, as their ancestors are the first ones of d's.
  for (int k = 0; k < num_dofs; ++k) {
    with_constant<1, 11>(rows[k].depth,
                         [&](auto depth) { invert(rows[k], depth, factor, inverse); });
  }
  for (int k = 0; k < num_dofs; ++k) {
    const double* row = inverse + rows[k].first;
    Quad sum = load_quad(row) * load_quad(row);
    for (int i = 4; i <= rows[k].depth; i += 4) {
      sum = sum + load_quad(row + i) * load_quad(row + i);
    }
    squares[k] = sum_of(sum);
  }
}

void calc_body_rows(const BodyConstants* bodies, const BodyState* states, const MatrixRow* rows,
                    const double* inverse, bool is_root_fixed, int body, int row_length,
                    double* result) {
  // Four entries at a time, so that the six sums stay in registers.
  for (int first = 0; first < row_length; first += 4) {
    Quad sum[6];
    // The root's J is the unit matrix.
    const bool has_root = first < 6 && !is_root_fixed;
    for (int axis = 0; axis < 6; ++axis) {
      sum[axis] = has_root ? load_quad(inverse + rows[axis].first + first) : Quad{};
    }
    // Joints between the body and the root: their motions, once for each of their entries.
    for (int index = body; index > 0; index = bodies[index].parent) {
      const MatrixRow& row = rows[bodies[index].dof];
      if (row.depth < first) {
        if (bodies[body].place >= 0) break;
        continue;
      }
      const PackedSpatial& motion = states[index].motion;
      const Quad entries = load_quad(inverse + row.first + first);
      sum[0] = sum[0] + entries * motion.angular.x;
      sum[1] = sum[1] + entries * motion.angular.y;
      sum[2] = sum[2] + entries * motion.angular.z;
      sum[3] = sum[3] + entries * motion.linear.x;
      sum[4] = sum[4] + entries * motion.linear.y;
      sum[5] = sum[5] + entries * motion.linear.z;
    }
    for (int axis = 0; axis < 6; ++axis) {
      double* to = result + axis * row_length + first;
      if (first + 4 <= row_length) {
        store_quad(sum[axis], to);
      } else {
        store_pair(sum[axis], to);
      }
    }
  }
}

constexpr TreeKernels kKernels{update_kinematics, update_velocities, add_mass_rows,
                               calc_bias,         factorize,         calc_body_rows};
