//! Changes of the ends of an undamped band by a larger basis, to first order: where two modes coalesce, or where λ = 0, by
//! δΩ = −yᴴ(δL)x / yᴴ(∂L/∂Ω)x with the right and the left vector x, y (Lancaster, *Lambda-Matrices and Vibrating Systems*, 1966).

use faer::{Col, Mat, c64};

use crate::modes::{BasisError, SpectralModel, derivative, split};
use crate::stability::band::{BandEnd, Instability};

/// Relative distance within which the end of a band is a critical speed.
const SAME_SPEED: f64 = 1e-6;

/// Largest relative change of the ends of a band; `None` if that of an end is unknown. An end of the range does not change.
pub fn change_of_ends(
    model: &SpectralModel,
    basis_error: &BasisError,
    band: &Instability,
) -> Option<f64> {
    let ends = band.range().ends().into_iter().zip(band.ends);
    let changes = ends.map(|(speed, end)| match end {
        BandEnd::Critical => critical(model, basis_error, speed),
        BandEnd::Coalescence(lambda) => coalescence(model, basis_error, speed, lambda),
        BandEnd::Range => Some(0.0),
        BandEnd::Growth | BandEnd::Interpolated => None,
    });
    changes.reduce(|x, y| Some(x?.max(y?)))?
}

fn critical(model: &SpectralModel, basis_error: &BasisError, speed: f64) -> Option<f64> {
    let mut critical = model.critical.iter();
    let found = critical.find(|c| (c.speed_rad_per_s / speed - 1.0).abs() < SAME_SPEED)?;
    Some(basis_error.critical_error(&model.components, found))
}

fn coalescence(
    model: &SpectralModel,
    basis_error: &BasisError,
    speed: f64,
    lambda: c64,
) -> Option<f64> {
    // A guided blade without damping has one component.
    const COMPONENT: usize = 0;
    let component = &model.components[COMPONENT];
    let found = model.double_eigenvalue(COMPONENT, speed, lambda)?;
    let speed = found.speed_rad_per_s;
    let x = component.lifted(speed, found.lambda, &found.right);
    // L(λ)ᴴ = L(−λ̄).
    let y = component.lifted(speed, -found.lambda.conj(), &found.left);
    let (real_x, imaginary_x) = split(&x);
    let (real_y, imaginary_y) = split(&y);
    let columns: [Col<f64>; 4] = [real_x, imaginary_x, real_y, imaginary_y];
    let columns = Mat::from_fn(x.nrows(), 4, |i, k| columns[k][i]);
    let softening = basis_error.softening(COMPONENT, speed, &columns);
    let s = |row: usize, column: usize| softening[(row, column)];
    let softened = c64::new(s(2, 0) + s(3, 1), s(2, 1) - s(3, 0));
    let system = &component.full;
    let change = derivative::of_coalescence_by(system, speed, found.lambda, [&x, &y], -softened);
    let share = (change / speed).abs();
    share.is_finite().then_some(share)
}
