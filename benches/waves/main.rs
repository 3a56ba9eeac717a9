//! A reduced model by waves, beside every eigenvalue of the full matrices: a trial of the core that is to come.
//!
//! The equation of motion in space is L(λ)q = (λ² + λ(2ΩG + C) + K + Ω²S + ΩN) q = 0. Near waves x of the free blade,
//! those with ω − nΩ below a cut or reflected, and the displacements of strong dampers are kept ([`near`]). With all
//! others eliminated, L = [A B; C F],
//!
//! (A − B F⁻¹ C)(λ) = K̃ + λC̃ + λ²M̃ + λ³s₃ + λ⁴s₄ + …
//!
//! ([`series`], [`reduced`], [`dense`]), in two stages ([`stages`]) and as a series in the speed ([`interval`]). The
//! eigenvalues are those of K̃ + λC̃ + λ²M̃; the next two terms give the error of each, −yᴴ(λ³s₃ + λ⁴s₄)x / yᴴL′x, within
//! a few percent. The search for bands follows them over the speed ([`search`]).
//!
//! `cargo bench --bench waves [PART OF A NAME]` compares saws with dense eigenvalues, fails where a count of growing
//! modes differs or an eigenvalue is further away than its estimate says, and prints sizes and run times. With
//! `E_MS=83` times are in units of 83 ms, one LAPACK eigvals of order 528.

#![allow(
    clippy::disallowed_methods,
    reason = "the solvers of the library are private; the matrices are small and in units of the window"
)]

mod dense;
mod interval;
mod near;
mod reduced;
mod scenes;
mod search;
mod series;
mod stages;
mod trial;
mod vectors;
mod waves;

fn main() {
    let word = std::env::args().skip(1).find(|a| !a.starts_with("--"));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let all_right = pool
        .expect("a thread pool")
        .install(|| trial::run(&word.unwrap_or_default()));
    assert!(all_right, "a saw differs from its dense eigenvalues");
}
