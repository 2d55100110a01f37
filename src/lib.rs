//! Soft bodies of tetrahedra, at a cost per step that is fixed before the step begins.
//!
//! femto is the corotated finite element method with linearly implicit time integration, its
//! system matrix never assembled, solved by a conjugate gradient that is stopped on purpose after a
//! few iterations (Dahl and Bargteil, "Early Termination of Conjugate Gradients for Corotated Finite
//! Elements", MIG 2019). Three promises:
//!
//! 1. **Fixed cost.** What a step does depends on the mesh, the scene's parts and the budget, never on
//!    the state: not on how deformed, inverted or broken the body is.
//! 2. **The same bits everywhere.** One input, one result, bit for bit, at every optimisation level and
//!    lane width: a step uses only correctly rounded operations, in one written order.
//! 3. **Known error.** The step's energy behaviour is a theorem that the tests check; its solution is
//!    compared with an independent dense solver in f64; the tool reports the error of a budget beside
//!    its cost.
//!
//! # The method in half a page
//!
//! A tetrahedron has rest volume V and shape-function gradients g_i; its nodes are at x_i.
//!
//! ```text
//! (1)  F  = Σ_i x_i g_iᵀ = Q S                                    deformation gradient, polar decomposition
//! (2)  σ  = λ tr(ε) I + 2 μ ε,  ε = sym(QᵀF) − I                  Hooke in the rotated frame
//! (3)  f_i  = −V Q σ g_i                                          elastic force on node i
//! (4)  K_ij = V Q [λ g_i g_jᵀ + μ (g_i·g_j) I + μ g_j g_iᵀ] Qᵀ    stiffness, positive semidefinite
//! (5)  (K u)_i = S G_i,  S = λV tr(H) I + μV (H + Hᵀ),  H = Σ_j (u_j − u_0) G_jᵀ,  G_i = Q g_i
//! (6)  A v⁺ = b,  A = M + h²K + hD,  b = M v + h (f(x) + f_ext),  D = αM + βK
//! (7)  x⁺ = x + h v⁺                                              backward Euler; θ = ½ is in [`step`]
//! ```
//!
//! (1) takes a fixed number of Jacobi sweeps from the last step's Q ([`polar`]). (5) is (4) from nine
//! numbers a tetrahedron ([`element`]), summed over the mesh without a matrix ([`operator`]). (6) is
//! solved by conjugate gradients in the complement of a small space W ([`settings::Start`]): the last
//! velocities, and for a free body its translations and rotations. Then v⁺ is the Galerkin solution over
//! W and the Krylov space at every iteration count, and while rotations are frozen, external forces
//! constant and pins at rest,
//!
//! ```text
//! (8)  E(v⁺, x⁺) ≤ E(v, x) − ½‖v⁺ − v‖²_M − ½h²‖v⁺‖²_K − h‖v⁺‖²_D
//! ```
//!
//! so a budget of one iteration, or none, is as stable as an exact solve; a start from v(t) without W is
//! not. For a free body linear momentum is exact at every budget. (Proof of (8): take v⁺ᵀ(Av⁺ − b) = 0 and
//! expand. In f32 v⁺ ⟂ r holds to rounding in the first iterations, and from rest always, by a line search at
//! the end; elsewhere conjugate gradients lose some of it later on ill-conditioned systems, and the tests ask
//! that E never rises.)
//!
//! (8) speaks of the rotations that the step has frozen. Fitting them anew afterwards feeds a body a little
//! energy, of fourth order in the angle it turns in a step, which a solve has to take back; so keep v(t)
//! in W (`galerkin-1` or more), and where bodies are stiff, take a preconditioner that reaches them.
//!
//! Preconditioners ([`preconditioner`]) go from A's diagonal, which needs nothing and suits soft bodies, to a
//! factor of the matrix at rest that is made once on a host and turned with the body, which leaves
//! one or two iterations of work however stiff it is.
//!
//! Materials may differ from one tetrahedron to another ([`material::Materials`]) and, in the dense layout, from one
//! direction to another ([`elasticity`]). With the feature `plasticity` a body keeps part of its deformation, with
//! `fracture` it breaks; what that takes is in the state, where it has room for it, and at the end of a step.
//!
//! Pins and contact with colliders are one projection per node ([`constraint`]).
//!
//! # The step as a pipeline
//!
//! ```text
//! x, Q → G, f → b → filter → W → k × { precondition, apply, dots } → v⁺ → x⁺ → Q⁺ → report
//! ```
//!
//! # A body
//!
//! ```
//! use femto::{Body, Material, Mesh, Scene, Settings, blocks, glam::Vec3};
//!
//! // All-zero bits: costs no flash. 4 nodes, 1 tetrahedron in blocks of eight.
//! static BODY: std::sync::Mutex<Body<4, { blocks(1) }>> = std::sync::Mutex::new(Body::new());
//!
//! let nodes = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
//! let mesh = Mesh::new(&nodes, &[[0, 1, 2, 3]])?;
//! let mut body = BODY.lock()?;
//! body.fill(&mesh, &Material::new(1e6, 0.4, 1000.0)?)?;
//!
//! let scene = Scene { gravity: Vec3::new(0.0, -9.81, 0.0), ..Scene::default() };
//! let settings = Settings::new(1.0 / 150.0)?;
//! let report = body.step(&scene, &settings);
//! assert!(report.advanced());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With the feature `alloc`, `OwnedBody` is the same for meshes known at run time. Where everything
//! lives, and how rest data and workspace are shared by several bodies: [`body`]. Bodies that are baked on a
//! host, with a factor of their matrix, and read in place from flash: [`asset`].
//!
//! # Several bodies
//!
//! Bodies that touch, are joined, or are rigid are one mesh of several pieces with a list of *couplings* between them (feature
//! `contact`, modules `coupling`, `rigid`, `detect`, and `join` to make the mesh): contact both ways in one implicit
//! solve, so that the energy bound and the exact momentum hold for all of them together.
//!
//! # Limits
//!
//! Linear tetrahedra lock as Poisson's ratio nears 0.5. The step is one of f32: bodies far from the
//! origin (compared to their elements) lose digits of their strain. The count of instructions is fixed
//! where the target has f32 in hardware; soft-float routines and a software square root depend on
//! their data.
#![no_std]
#![warn(missing_docs)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub use glam;

mod algebra;
pub mod asset;
pub mod body;
mod cg;
#[doc = include_str!("choosing.md")]
pub mod choosing {}
pub mod collider;
pub mod constraint;
pub mod cost;
#[cfg(feature = "contact")]
pub mod coupling;
#[cfg(not(feature = "contact"))]
mod coupling {
    #[path = "hook.rs"]
    pub(crate) mod hook;
}
#[cfg(feature = "contact")]
pub mod detect;
pub mod elasticity;
pub mod element;
pub mod energy;
mod fan;
#[cfg(feature = "fracture")]
pub mod fracture;
pub mod frame;
mod inelastic;
#[cfg(feature = "alloc")]
pub mod join;
pub mod lane;
pub mod load;
pub mod material;
pub mod math;
pub mod mesh;
pub mod operator;
#[cfg(feature = "alloc")]
pub mod order;
#[cfg(feature = "alloc")]
pub mod owned;
mod pair;
#[cfg(feature = "plasticity")]
pub mod plasticity;
pub mod polar;
pub mod preconditioner;
pub mod report;
pub mod rest;
#[cfg(feature = "contact")]
pub mod rigid;
pub mod scene;
pub mod settings;
mod space;
mod stages;
pub mod state;
pub mod step;
#[cfg(feature = "alloc")]
pub mod surface;
pub mod vector;
pub mod workspace;

pub use asset::{Asset, AssetError};
pub use body::Body;
pub use collider::Collider;
pub use constraint::Pin;
#[cfg(feature = "contact")]
pub use coupling::{Coupling, Couplings};
#[cfg(feature = "fracture")]
pub use fracture::Fracture;
pub use frame::Frame;
pub use lane::blocks;
pub use material::{Material, Materials, Regions};
pub use mesh::Mesh;
#[cfg(feature = "alloc")]
pub use owned::OwnedBody;
#[cfg(feature = "plasticity")]
pub use plasticity::Plasticity;
pub use preconditioner::{Factor, Preconditioner};
pub use report::{Refusal, StepReport};
pub use scene::Scene;
pub use settings::{Budget, Settings, Start};
