//! What crosses the border: plain structs, and status codes. Choices are numbers, since a C caller may put any
//! number there.

/// Every piece of memory starts at a multiple of this.
pub const FEMTO_ALIGNMENT: usize = 32;

/// What a call says.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FemtoStatus {
    /// Done.
    Ok = 0,
    /// A pointer is null.
    Null = 1,
    /// A pointer is not a multiple of what it must be: FEMTO_ALIGNMENT for a piece of memory, 4 for an array, 8 for
    /// a struct with a pointer in it.
    Misaligned = 2,
    /// A piece of memory is smaller than needed, or a length is absurd.
    TooSmall = 3,
    /// Two pieces of memory overlap.
    Overlap = 4,
    /// The piece does not hold what it should: not initialised, of another body, or overwritten.
    WrongBytes = 5,
    /// The mesh is empty, has a bad index, an unused node, a flat or inverted tetrahedron, or leaves the range of float.
    Mesh = 6,
    /// A parameter of the material is out of its range.
    Material = 7,
    /// A setting is out of its range, or a choice is not one of the list.
    Settings = 8,
    /// A pin, a force list or a collider is not usable.
    Scene = 9,
    /// A position or velocity that was given is not finite.
    NonFinite = 10,
    /// The step would have given a state that is not finite, or left the range of float; the state is as it was.
    Refused = 11,
    /// The bytes are no asset of this version, are damaged or cut off, or more than the asset's; or they have no factor,
    /// where one is asked for.
    Asset = 12,
}

/// FemtoMaterial, SI units, with Rayleigh damping.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoMaterial {
    /// Young's modulus, Pa.
    pub young: f32,
    /// Poisson's ratio.
    pub poisson: f32,
    /// Density, kg/m^3.
    pub density: f32,
    /// Mass-proportional damping, 1/s.
    pub alpha: f32,
    /// Stiffness-proportional damping, s.
    pub beta: f32,
}

/// Where the solver starts. 0 zero, 1 velocity, 2 velocity and force, 3 Galerkin, 4 rigid.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoStart {
    /// FEMTO_START_...
    pub kind: u32,
    /// Velocities that Galerkin and rigid keep, 0 to 255; else 0.
    pub velocities: u32,
}

/// Start from rest.
pub const FEMTO_START_ZERO: u32 = 0;
/// Start from the velocity.
pub const FEMTO_START_VELOCITY: u32 = 1;
/// Start from the velocity after an explicit step.
pub const FEMTO_START_VELOCITY_FORCE: u32 = 2;
/// Galerkin over the last velocities: the usual choice, with one.
pub const FEMTO_START_GALERKIN: u32 = 3;
/// The same with the rotations of the body.
pub const FEMTO_START_RIGID: u32 = 4;

/// No preconditioner.
pub const FEMTO_PRECONDITIONER_IDENTITY: u32 = 0;
/// The lumped mass.
pub const FEMTO_PRECONDITIONER_MASS: u32 = 1;
/// The diagonal: the usual choice.
pub const FEMTO_PRECONDITIONER_JACOBI: u32 = 2;
/// The 3x3 diagonal blocks.
pub const FEMTO_PRECONDITIONER_BLOCK_JACOBI: u32 = 3;
/// The factor of an asset of the same mesh: `factor` and `factor_bytes`.
pub const FEMTO_PRECONDITIONER_FACTORED: u32 = 4;
/// Block Jacobi and the rigid motions of aggregates: `aggregates` and `aggregate_count`. The workspace must have
/// femto_coarse_bytes more.
pub const FEMTO_PRECONDITIONER_TWO_LEVEL: u32 = 5;

/// How a step is taken. What the preconditioner does not use may be 0.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoSettings {
    /// Time step, s.
    pub dt: f32,
    /// 1 is backward Euler, 0.5 the trapezoidal rule.
    pub theta: f32,
    /// Iterations of the solver.
    pub iterations: u32,
    /// Sweeps of the polar decomposition.
    pub polar_sweeps: u32,
    /// Start of the solver; the one that the state was made for, or one that needs less.
    pub start: FemtoStart,
    /// FEMTO_PRECONDITIONER_...
    pub preconditioner: u32,
    /// How many aggregates there are.
    pub aggregate_count: u32,
    /// The aggregate of every node, by femto_aggregates_init or of your own: below the count, or 255 for none.
    pub aggregates: *const u8,
    /// An asset that passed femto_asset_open.
    pub factor: *const core::ffi::c_void,
    /// Its bytes.
    pub factor_bytes: usize,
}

/// What an asset says of itself.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoAsset {
    /// Nodes of its mesh.
    pub nodes: usize,
    /// Tetrahedra of its mesh.
    pub tets: usize,
    /// Nodes to hold, which its factor knows of: within the asset.
    pub pins: *const FemtoPin,
    /// Their number.
    pub pin_count: usize,
    /// What it was made for, with its factor if it has one.
    pub settings: FemtoSettings,
}

/// A node whose velocity is prescribed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoPin {
    /// The node.
    pub node: u32,
    /// Its velocity, m/s.
    pub velocity: [f32; 3],
}

/// Keeps normal . x >= distance.
pub const FEMTO_COLLIDER_HALF_SPACE: u32 = 0;
/// Keeps nodes out of a ball.
pub const FEMTO_COLLIDER_SPHERE: u32 = 1;

/// A shape that nodes cannot enter.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoCollider {
    /// FEMTO_COLLIDER_...
    pub kind: u32,
    /// The normal of a half-space, or the centre of a sphere (m).
    pub vector: [f32; 3],
    /// The distance of a half-space from the origin along its normal, or the radius of a sphere, m.
    pub length: f32,
    /// Coulomb's coefficient of friction.
    pub friction: f32,
    /// Velocity of the surface, m/s.
    pub velocity: [f32; 3],
}

/// What acts on a body.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoScene {
    /// Acceleration of gravity, m/s^2.
    pub gravity: [f32; 3],
    /// Forces, N, one a node; or null.
    pub forces: *const [f32; 3],
    /// As many as nodes, or 0.
    pub force_count: usize,
    /// Pins, or null.
    pub pins: *const FemtoPin,
    /// Their number.
    pub pin_count: usize,
    /// Colliders, or null.
    pub colliders: *const FemtoCollider,
    /// Their number.
    pub collider_count: usize,
}

/// What a step says of itself.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct FemtoReport {
    /// Norm of the right-hand side, N s.
    pub rhs: f32,
    /// Norm of the residual before the first iteration, N s.
    pub residual_before: f32,
    /// ... after the last one.
    pub residual_after: f32,
    /// Iterations that moved the solution.
    pub updates: u32,
    /// Contacts between nodes and colliders.
    pub contacts: u32,
}
