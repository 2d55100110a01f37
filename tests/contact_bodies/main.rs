//! Contact between bodies of one system: momentum, energy, friction, rest, rigid bodies, overflow, and one step
//! against a dense solve in f64.

#[path = "../support/mod.rs"]
mod support;

mod damage;
mod edges;
mod free;
mod guard;
mod limits;
mod oracle;
mod pull;
mod rest;
mod rigid;
mod search;
mod world;
