//! A trial of the reduced model by waves, beside every eigenvalue of the full matrices and beside today's bands.
//!
//! `cargo bench --bench waves -- TRIAL [E]`: see [`main`]. E is the time of one LAPACK eigvals of order 528 in ms on
//! the same machine, in which times are given.
//!
//! Near waves, and the displacements of strong dampers, are kept ([`near`]). All others are eliminated to second order
//! in λ ([`series`], [`reduced`], [`dense`]) in two stages ([`stages`]), as series in the speed ([`interval`]). The search for bands then works on
//! K̃ + λC̃ + λ²M̃ ([`search`]).

#[path = "../../tests/common/bands.rs"]
mod bands;
#[path = "../../tests/common/damped.rs"]
mod damped;
mod dense;
#[path = "../../tests/common/draws.rs"]
#[allow(dead_code, reason = "helpers of other tests")]
mod draws;
mod interval;
mod near;
mod reduced;
mod scenes;
mod search;
mod series;
mod stages;
mod trial;
mod waves;

fn main() {
    let mut arguments = std::env::args().skip(1).filter(|a| a != "--bench");
    let trial = arguments.next().unwrap_or_default();
    let rest: Vec<String> = arguments.collect();
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.expect("a thread pool")
        .install(|| trial::run(&trial, &rest));
}
