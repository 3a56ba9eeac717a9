//! Bounds of L along a line.

/// Coefficients of a block of a bound, (1 + share) B_n + more − (ω ± nΩ)².
pub struct BoundedBlock {
    pub share: f64,
    pub more: f64,
    /// (ω + nΩ)² and (ω − nΩ)².
    pub turning: [f64; 2],
}

/// Lower or upper bound of L along a line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bound {
    Low,
    High,
}

impl Bound {
    pub fn sign(self) -> f64 {
        match self {
            Bound::Low => -1.0,
            Bound::High => 1.0,
        }
    }

    /// Value of the square, of a number between two, that gives this bound of L.
    pub fn of_square(self, ends: [f64; 2]) -> f64 {
        let [x, y] = ends.map(|end| end * end);
        match self {
            Bound::Low => x.max(y),
            Bound::High if ends[0] * ends[1] <= 0.0 => 0.0,
            Bound::High => x.min(y),
        }
    }
}
