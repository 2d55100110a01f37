// Soft bodies of tetrahedra at a fixed cost per step. Written by cbindgen from examples/c/src: do not edit.

#ifndef FEMTO_H
#define FEMTO_H

#include <stddef.h>
#include <stdint.h>

// A body lives in three pieces of memory that the caller owns; femto_*_bytes give their sizes:
//
// * rest data: read-only once made, may be shared by bodies; or an asset, read in place;
// * state: all that a snapshot must copy (by memcpy, to a place of the same alignment);
// * workspace: scratch, may be shared by bodies.
//
// All three start at a multiple of FEMTO_ALIGNMENT and do not overlap, nor does anything else that is passed.
// There is no global state and no allocation. A call that does not return FEMTO_STATUS_OK has changed nothing but
// the workspace and memory that it was to initialise. Pointers may be wrong in the ways that the codes name;
// what cannot be told from outside (memory that is not there, or is smaller than said) is the caller's word.


// Colliders of a step, at most.
#define FEMTO_MAX_COLLIDERS 8

// Aggregates of a two-level preconditioner, at most.
#define FEMTO_MAX_AGGREGATES 16

// Every piece of memory starts at a multiple of this.
#define FEMTO_ALIGNMENT 32

// Start from rest.
#define FEMTO_START_ZERO 0

// Start from the velocity.
#define FEMTO_START_VELOCITY 1

// Start from the velocity after an explicit step.
#define FEMTO_START_VELOCITY_FORCE 2

// Galerkin over the last velocities: the usual choice, with one.
#define FEMTO_START_GALERKIN 3

// The same with the rotations of the body.
#define FEMTO_START_RIGID 4

// No preconditioner.
#define FEMTO_PRECONDITIONER_IDENTITY 0

// The lumped mass.
#define FEMTO_PRECONDITIONER_MASS 1

// The diagonal: the usual choice.
#define FEMTO_PRECONDITIONER_JACOBI 2

// The 3x3 diagonal blocks.
#define FEMTO_PRECONDITIONER_BLOCK_JACOBI 3

// The factor of an asset of the same mesh: `factor` and `factor_bytes`.
#define FEMTO_PRECONDITIONER_FACTORED 4

// Block Jacobi and the rigid motions of aggregates: `aggregates` and `aggregate_count`. The workspace must have
// femto_coarse_bytes more.
#define FEMTO_PRECONDITIONER_TWO_LEVEL 5

// Keeps normal . x >= distance.
#define FEMTO_COLLIDER_HALF_SPACE 0

// Keeps nodes out of a ball.
#define FEMTO_COLLIDER_SPHERE 1

// What a call says.
typedef enum FemtoStatus {
  // Done.
  FEMTO_STATUS_OK = 0,
  // A pointer is null.
  FEMTO_STATUS_NULL = 1,
  // A pointer is not a multiple of what it must be: FEMTO_ALIGNMENT for a piece of memory, 4 for an array, 8 for
  // a struct with a pointer in it.
  FEMTO_STATUS_MISALIGNED = 2,
  // A piece of memory is smaller than needed, or a length is absurd.
  FEMTO_STATUS_TOO_SMALL = 3,
  // Two pieces of memory overlap.
  FEMTO_STATUS_OVERLAP = 4,
  // The piece does not hold what it should: not initialised, of another body, or overwritten.
  FEMTO_STATUS_WRONG_BYTES = 5,
  // The mesh is empty, has a bad index, an unused node, a flat or inverted tetrahedron, or leaves the range of float.
  FEMTO_STATUS_MESH = 6,
  // A parameter of the material is out of its range.
  FEMTO_STATUS_MATERIAL = 7,
  // A setting is out of its range, or a choice is not one of the list.
  FEMTO_STATUS_SETTINGS = 8,
  // A pin, a force list or a collider is not usable.
  FEMTO_STATUS_SCENE = 9,
  // A position or velocity that was given is not finite.
  FEMTO_STATUS_NON_FINITE = 10,
  // The step would have given a state that is not finite, or left the range of float; the state is as it was.
  FEMTO_STATUS_REFUSED = 11,
  // The bytes are no asset of this version, are damaged or cut off, or more than the asset's; or they have no factor,
  // where one is asked for.
  FEMTO_STATUS_ASSET = 12,
} FemtoStatus;

// Where the solver starts. 0 zero, 1 velocity, 2 velocity and force, 3 Galerkin, 4 rigid.
typedef struct FemtoStart {
  // FEMTO_START_...
  uint32_t kind;
  // Velocities that Galerkin and rigid keep, 0 to 255; else 0.
  uint32_t velocities;
} FemtoStart;

// FemtoMaterial, SI units, with Rayleigh damping.
typedef struct FemtoMaterial {
  // Young's modulus, Pa.
  float young;
  // Poisson's ratio.
  float poisson;
  // Density, kg/m^3.
  float density;
  // Mass-proportional damping, 1/s.
  float alpha;
  // Stiffness-proportional damping, s.
  float beta;
} FemtoMaterial;

// A node whose velocity is prescribed.
typedef struct FemtoPin {
  // The node.
  uint32_t node;
  // Its velocity, m/s.
  float velocity[3];
} FemtoPin;

// How a step is taken. What the preconditioner does not use may be 0.
typedef struct FemtoSettings {
  // Time step, s.
  float dt;
  // 1 is backward Euler, 0.5 the trapezoidal rule.
  float theta;
  // Iterations of the solver.
  uint32_t iterations;
  // Sweeps of the polar decomposition.
  uint32_t polar_sweeps;
  // Start of the solver; the one that the state was made for, or one that needs less.
  struct FemtoStart start;
  // FEMTO_PRECONDITIONER_...
  uint32_t preconditioner;
  // How many aggregates there are.
  uint32_t aggregate_count;
  // The aggregate of every node, by femto_aggregates_init or of your own: below the count, or 255 for none.
  const uint8_t *aggregates;
  // An asset that passed femto_asset_open.
  const void *factor;
  // Its bytes.
  size_t factor_bytes;
} FemtoSettings;

// What an asset says of itself.
typedef struct FemtoAsset {
  // Nodes of its mesh.
  size_t nodes;
  // Tetrahedra of its mesh.
  size_t tets;
  // Nodes to hold, which its factor knows of: within the asset.
  const struct FemtoPin *pins;
  // Their number.
  size_t pin_count;
  // What it was made for, with its factor if it has one.
  struct FemtoSettings settings;
} FemtoAsset;

// A shape that nodes cannot enter.
typedef struct FemtoCollider {
  // FEMTO_COLLIDER_...
  uint32_t kind;
  // The normal of a half-space, or the centre of a sphere (m).
  float vector[3];
  // The distance of a half-space from the origin along its normal, or the radius of a sphere, m.
  float length;
  // Coulomb's coefficient of friction.
  float friction;
  // Velocity of the surface, m/s.
  float velocity[3];
} FemtoCollider;

// What acts on a body.
typedef struct FemtoScene {
  // Acceleration of gravity, m/s^2.
  float gravity[3];
  // Forces, N, one a node; or null.
  const float (*forces)[3];
  // As many as nodes, or 0.
  size_t force_count;
  // Pins, or null.
  const struct FemtoPin *pins;
  // Their number.
  size_t pin_count;
  // Colliders, or null.
  const struct FemtoCollider *colliders;
  // Their number.
  size_t collider_count;
} FemtoScene;

// What a step says of itself.
typedef struct FemtoReport {
  // Norm of the right-hand side, N s.
  float rhs;
  // Norm of the residual before the first iteration, N s.
  float residual_before;
  // ... after the last one.
  float residual_after;
  // Iterations that moved the solution.
  uint32_t updates;
  // Contacts between nodes and colliders.
  uint32_t contacts;
} FemtoReport;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Bytes of the rest data of a mesh; 0 if there is no such mesh.
size_t femto_rest_bytes(size_t nodes, size_t tets);

// Bytes of a body's state for a start; 0 if there is no such mesh or start.
size_t femto_state_bytes(size_t nodes, size_t tets, struct FemtoStart start);

// Bytes of the workspace of a step; 0 if there is no such mesh or start. A two-level preconditioner needs
// femto_coarse_bytes more.
size_t femto_workspace_bytes(size_t nodes, size_t tets, struct FemtoStart start);

// Bytes that so many aggregates add to the workspace; 0 if there are none, or more than FEMTO_MAX_AGGREGATES.
size_t femto_coarse_bytes(uint32_t aggregates);

// Makes the rest data of a mesh: nodes in metres, four node numbers a tetrahedron, positively oriented.
enum FemtoStatus femto_rest_init(void *rest,
                                 size_t rest_bytes,
                                 const float (*nodes)[3],
                                 size_t node_count,
                                 const uint32_t (*tets)[4],
                                 size_t tet_count,
                                 const struct FemtoMaterial *material);

// Checks an asset (of the tool `femto bake`), every number of it, and says what it is of. It is read in place: where
// rest data is asked for, it may be passed instead, and its factor where FemtoSettings names it. `asset_bytes` is
// exact. Call it once: all other calls trust the numbers of an asset.
enum FemtoStatus femto_asset_open(const void *asset,
                                  size_t asset_bytes,
                                  struct FemtoAsset *out);

// Divides a body into aggregates for a two-level preconditioner: writes one number a node. 8 are the usual choice,
// FEMTO_MAX_AGGREGATES the most. Goes through the mesh many times: at load, not in every step.
enum FemtoStatus femto_aggregates_init(uint8_t *aggregates,
                                       size_t node_count,
                                       const void *rest,
                                       size_t rest_bytes,
                                       uint32_t count);

// Puts a body at rest in the rest shape, with the history that the start needs.
enum FemtoStatus femto_state_init(void *state,
                                  size_t state_bytes,
                                  const void *rest,
                                  size_t rest_bytes,
                                  struct FemtoStart start);

// Places a body: positions (m) and velocities (m/s), `count` each, as many as it has nodes. Forgets its history.
enum FemtoStatus femto_place(void *state,
                             size_t state_bytes,
                             const void *rest,
                             size_t rest_bytes,
                             const float (*x)[3],
                             const float (*v)[3],
                             size_t count);

// Advances a body by one step. `report` may be null.
enum FemtoStatus femto_step(void *state,
                            size_t state_bytes,
                            const void *rest,
                            size_t rest_bytes,
                            void *workspace,
                            size_t workspace_bytes,
                            const struct FemtoSettings *settings,
                            const struct FemtoScene *scene,
                            struct FemtoReport *report);

// Where the positions (m) and velocities (m/s) of a body are, `*count` of each, within its state. Any of the three
// may be null.
enum FemtoStatus femto_read(const void *state,
                            size_t state_bytes,
                            const float (**x)[3],
                            const float (**v)[3],
                            size_t *count);

// The hash of a body's positions and velocities: the same on every target for the same state.
enum FemtoStatus femto_hash(const void *state, size_t state_bytes, uint64_t *hash);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* FEMTO_H */
