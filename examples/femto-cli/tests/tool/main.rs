//! The tool as its users have it: what it prints, writes and refuses.

mod bad_scenes;
mod bake;
mod bodies;
mod demo;
mod endurance;
mod factors;
mod fuzz_replay;
mod info;
mod materials;
mod outside;
mod run;
mod suggest;
mod support;
