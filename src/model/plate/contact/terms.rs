//! The terms of contacts in the equation of motion.

use faer::{Mat, Scale};

/// Terms of all contacts in the equation of motion, N × N each; zero terms are `None`.
#[derive(Debug, Clone, Default)]
pub struct ContactTerms {
    stiffness: Option<Mat<f64>>,
    damping: Option<Mat<f64>>,
    nonconservative: Option<Mat<f64>>,
}

impl ContactTerms {
    /// Adds to the stiffness K_g, in 1/s². An antisymmetric part above rounding has no potential and is added as
    /// by [`ContactTerms::add_nonconservative_stiffness`].
    pub fn add_stiffness(&mut self, term: &Mat<f64>) {
        let symmetric = Scale(0.5) * (term + term.transpose());
        let skew = term - &symmetric;
        if skew.norm_max() > ROUNDING * term.norm_max() {
            add(&mut self.nonconservative, skew);
        }
        add(&mut self.stiffness, symmetric);
    }

    /// Adds a term to K_g that is exactly symmetric.
    pub fn add_symmetric_stiffness(&mut self, term: Mat<f64>) {
        add(&mut self.stiffness, term);
    }

    /// Adds to the damping C, in 1/s, symmetric.
    pub fn add_damping(&mut self, term: &Mat<f64>) {
        add(&mut self.damping, term.clone());
    }

    /// Adds forces that depend on the deflection and have no potential, K_n in 1/s², of any symmetry:
    /// follower loads, friction. With them a saw is not conservative: its modes have no Krein signs, and its
    /// bands are searched as those of a damped saw.
    pub fn add_nonconservative_stiffness(&mut self, term: &Mat<f64>) {
        add(&mut self.nonconservative, term.clone());
    }

    /// Stiffness K_g, in 1/s²; `None` if it is zero.
    pub fn stiffness(&self) -> Option<&Mat<f64>> {
        self.stiffness.as_ref()
    }

    /// Damping C of the contacts, in 1/s; `None` if it is zero.
    pub fn damping(&self) -> Option<&Mat<f64>> {
        self.damping.as_ref()
    }

    /// Stiffness K_n without a potential, in 1/s²; `None` if it is zero.
    pub fn nonconservative_stiffness(&self) -> Option<&Mat<f64>> {
        self.nonconservative.as_ref()
    }

    /// The terms that have a potential.
    pub fn conservative(&self) -> Self {
        ContactTerms {
            stiffness: self.stiffness.clone(),
            ..ContactTerms::default()
        }
    }

    /// Whether all terms have a potential.
    pub fn is_conservative(&self) -> bool {
        self.damping.is_none() && self.nonconservative.is_none()
    }

    /// Whether there are no terms.
    pub fn is_empty(&self) -> bool {
        self.stiffness.is_none() && self.is_conservative()
    }
}

/// An antisymmetric part below this share of the largest entry of a matrix is rounding.
const ROUNDING: f64 = 1e-12;

fn add(sum: &mut Option<Mat<f64>>, term: Mat<f64>) {
    match sum {
        Some(sum) => *sum += term,
        None => *sum = Some(term),
    }
}
