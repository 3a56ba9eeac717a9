//! What touches the blade, fixed in space, and what it adds to the equation of motion.
//!
//! A kind of contact is a type that implements [`Contact`], in a file of its own.

mod guide;
mod patch;
mod wood;

use faer::{Mat, Scale};

use super::Plate;

/// Something fixed in space that acts on the blade, linearly in its deflection and velocity.
pub trait Contact {
    /// Adds the terms of this contact to those of all, in the basis of the plate.
    fn add_to(&self, plate: &Plate, terms: &mut ContactTerms);
}

/// Terms of the equation of motion that contacts make, N × N each; what none makes is absent.
#[derive(Debug, Clone, Default)]
pub struct ContactTerms {
    stiffness: Option<Mat<f64>>,
    damping: Option<Mat<f64>>,
    nonconservative: Option<Mat<f64>>,
}

impl ContactTerms {
    /// Stiffness K_g, in 1/s². What of it is not symmetric beyond rounding has no potential, and
    /// goes where [`ContactTerms::add_nonconservative_stiffness`] puts it.
    pub fn add_stiffness(&mut self, term: &Mat<f64>) {
        let symmetric = Scale(0.5) * (term + term.transpose());
        let skew = term - &symmetric;
        if skew.norm_max() > ROUNDING * term.norm_max() {
            add(&mut self.nonconservative, skew);
        }
        add(&mut self.stiffness, symmetric);
    }

    /// The same of a term that is symmetric to the last bit.
    pub fn add_symmetric_stiffness(&mut self, term: Mat<f64>) {
        add(&mut self.stiffness, term);
    }

    /// Damping C, in 1/s, symmetric.
    pub fn add_damping(&mut self, term: &Mat<f64>) {
        add(&mut self.damping, term.clone());
    }

    /// Forces that follow the deflection without a potential, K_n in 1/s², of any symmetry:
    /// follower loads, friction. A saw that has them is not conservative, so that its modes have
    /// no Krein signs and it is charted as a damped one is.
    pub fn add_nonconservative_stiffness(&mut self, term: &Mat<f64>) {
        add(&mut self.nonconservative, term.clone());
    }

    /// K_g, if there is any.
    pub fn stiffness(&self) -> Option<&Mat<f64>> {
        self.stiffness.as_ref()
    }

    /// C of the contacts, if there is any.
    pub fn damping(&self) -> Option<&Mat<f64>> {
        self.damping.as_ref()
    }

    /// K_n, if there is any.
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

    /// Whether only terms with a potential are there.
    pub fn is_conservative(&self) -> bool {
        self.damping.is_none() && self.nonconservative.is_none()
    }

    /// Whether nothing touches the blade.
    pub fn is_empty(&self) -> bool {
        self.stiffness.is_none() && self.is_conservative()
    }
}

/// Share of the largest number of a matrix below which a difference is rounding.
const ROUNDING: f64 = 1e-12;

fn add(sum: &mut Option<Mat<f64>>, term: Mat<f64>) {
    match sum {
        Some(sum) => *sum += term,
        None => *sum = Some(term),
    }
}
