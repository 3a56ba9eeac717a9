//! Goal: every number has an independent source: closed forms, other programs, other
//! formulations, invariants.

#![allow(
    clippy::disallowed_methods,
    reason = "tests compare with the solvers themselves"
)]

#[path = "../common/mod.rs"]
mod common;

mod annulus;
mod at_rest;
mod chosen_sweep;
mod clamp;
mod collar_saw;
mod damping;
mod edge_load;
mod even_springs;
mod event_names;
mod excitation;
mod floquet;
mod follower;
mod guide_arm;
mod guide_states;
mod heat_limits;
mod in_cut;
mod light_gap;
mod membrane;
mod paper;
mod paper_free_blade;
mod published;
mod rigid_motions;
mod rim;
mod run_up;
mod saws;
mod sensitivity;
mod shapes;
mod slot_hull;
mod slots;
mod slots_beside_guides;
mod spline;
mod static_deflection;
mod thickness_profile;
mod washboarding;
mod wave_factors;
mod witness;
mod zeros;
