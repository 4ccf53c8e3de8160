// The bodies of tree_kernels.cpp and tree_kernels_avx2.cpp, which define in their own namespaces:
// Vec, a vector of three numbers; load(), store(), dot(), cross(), splat(), and the operators.

/** a x. */
inline Vec product(const Vec* a, const Packed3& x) {
  return a[0] * x.x + a[1] * x.y + a[2] * x.z;
}

struct Spatial {
  Vec angular;
  Vec linear;
};

inline Spatial load(const PackedSpatial& v) { return {load(v.angular), load(v.linear)}; }
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

constexpr TreeKernels kKernels{update_kinematics, update_velocities, add_mass_rows, calc_bias};
