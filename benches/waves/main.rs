//! The reduced model by waves beside every eigenvalue of the full matrices.
//!
//! [`sawflutter::modes::waves`] states the equations. The library searches damped saws for bands on it; here undamped
//! saws are searched too, with their Krein signs ([`vectors`], [`search`]).
//!
//! `cargo bench --bench waves [PART OF A NAME]` compares saws with dense eigenvalues, fails where a count of growing
//! modes differs, and prints sizes, errors and run times. With `E_MS=83` times are in units of 83 ms, one LAPACK eigvals
//! of order 528.

#![allow(
    clippy::disallowed_methods,
    reason = "the solvers of the library are private; the matrices are small and in units of the window"
)]

mod scenes;
mod search;
mod trial;
mod vectors;

fn main() {
    let word = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let all_right = pool
        .expect("a thread pool")
        .install(|| trial::run(&word.unwrap_or_default()));
    assert!(all_right, "a saw differs from its dense eigenvalues");
}
