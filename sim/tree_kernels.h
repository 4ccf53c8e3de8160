#pragma once

#include <Eigen/Core>

#include "sim/constant_count.h"

namespace nao::sim {

/** A vector of three numbers and a 0: with AVX2 one instruction works on all of them. */
struct alignas(32) Packed3 {
  double x = 0;
  double y = 0;
  double z = 0;
  double zero = 0;

  Packed3() = default;
  // Implicit: another form of the same vector.
  Packed3(const Eigen::Vector3d& v) : x(v[0]), y(v[1]), z(v[2]) {}
  operator Eigen::Vector3d() const { return {x, y, z}; }
};

/** Columns of a 3 x 3 matrix. */
struct PackedMatrix {
  Packed3 columns[3];

  PackedMatrix() = default;
  PackedMatrix(const Eigen::Matrix3d& m)
      : columns{Eigen::Vector3d(m.col(0)), Eigen::Vector3d(m.col(1)), Eigen::Vector3d(m.col(2))} {}
  operator Eigen::Matrix3d() const {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i) m.col(i) = Eigen::Vector3d(columns[i]);
    return m;
  }
};

/** SpatialVector and SpatialInertia of tree_dynamics.h. */
struct PackedSpatial {
  Packed3 angular;
  Packed3 linear;
};
struct PackedInertia {
  double mass = 0;
  Packed3 moment;
  PackedMatrix inertia;
};

/** A TreeBody as the kernels read it. */
struct BodyConstants {
  int parent = -1;
  int dof = 0;
  bool is_parallel = true;
  /** Of its row of the mass matrix: first entry, and place of its own dof; -1 if the body is not in
   * series. */
  int row = 0;
  int place = 0;
  double ratio = 1;
  double offset = 0;
  double mass = 0;
  Packed3 axis;
  Packed3 origin_in_parent;
  PackedMatrix rotation_in_parent;
  Packed3 center_of_mass;
  PackedMatrix inertia;
};

/** What TreeDynamics computes for a body; W's axes, spatial quantities about O. */
struct BodyState {
  /** Body frame B in W. */
  PackedMatrix rotation;
  Packed3 position;
  /** Center of mass, from O. */
  Packed3 com_from_O;
  /** Motion of the body per unit of its joint's dof (Featherstone's S), and the dof's rate. */
  PackedSpatial motion;
  double rate = 0;
  PackedSpatial velocity;
  /** Inertia of the body, and of the body with all its descendants. */
  PackedInertia inertia;
  PackedInertia composite;
  /** Force for a unit acceleration of the joint. */
  PackedSpatial unit_force;
  /** Terms of the recursive Newton-Euler algorithm with generalized accelerations of 0. */
  PackedSpatial acceleration;
  PackedSpatial force;
};

/** A row of a matrix with the tree's pattern: entries for the dof's ancestors, rising, and for the
 * dof itself, in doubles from the matrix' begin. Rows begin at multiples of 4 and are so long. */
struct MatrixRow {
  int first = 0;
  /** Number of ancestors, and where their rows begin. */
  int depth = 0;
  const int* ancestors = nullptr;
};

/** The passes over a tree's bodies that take most of a step's time, compiled for processors with
 * AVX2 and for all: the same operations in the same order, and the same bits. All lists are by
 * body, the root first. */
struct TreeKernels {
  /** Poses, motions, velocities and inertias; pose and velocity of the root are given.
   * @param coordinate, velocity  (num_dofs). */
  void (*update_kinematics)(const BodyConstants* bodies, int count, const double* coordinate,
                            const double* velocity, BodyState* states);
  /** Velocities of all bodies but the root, motions given. */
  void (*update_velocities)(const BodyConstants* bodies, int count, const double* velocity,
                            BodyState* states);
  /** Composite inertias, unit forces, and the rows of the mass matrix of bodies in series, which it
   * adds to. */
  void (*add_mass_rows)(const BodyConstants* bodies, int count, bool is_root_fixed,
                        BodyState* states, double* mass);
  /** Bias forces: see TreeDynamics::calc_bias(). @param bias  Zero, receives those of the joints;
   * the root's are its state's force. */
  void (*calc_bias)(const BodyConstants* bodies, int count, const double* gravity,
                    BodyState* states, double* bias);
  /** L of M + diagonal = L^T L, and L^-1: see TreeDynamics::factorize().
   * @param order  Of the joints' dofs: those that share an ancestor among them fall.
   * @param factor  M, becomes L. @param squares  Receives the squared lengths of the rows of L^-1.
   */
  void (*factorize)(const MatrixRow* rows, const int* order, int num_dofs, const double* diagonal,
                    double* factor, double* inverse, double* squares);
  /** Rows of a body: see TreeDynamics::calc_body_rows(). @param inverse  L^-1, with 0 behind the
   * diagonal. @param row_length  Of the result's rows, a multiple of 2. */
  void (*calc_body_rows)(const BodyConstants* bodies, const BodyState* states,
                         const MatrixRow* rows, const double* inverse, bool is_root_fixed, int body,
                         int row_length, double* result);
};

/** Those that are fastest on this processor. */
const TreeKernels& tree_kernels();
/** For any processor, and for those with AVX2; null where the program has none. */
const TreeKernels& generic_tree_kernels();
const TreeKernels* avx2_tree_kernels();

}  // namespace nao::sim
