//! The least-squares problem in the form that `basin` expects, and its statistics.

use std::sync::{Mutex, MutexGuard, PoisonError};

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, DenseMatrix, Executor, Jacobian,
    Residual, TrustRegionReflective,
};
use faer::Mat;
use statrs::distribution::{ContinuousCDF, StudentsT};

use crate::model::linalg::RightSingular;
use crate::modes::SpectrumError;

use super::model::{Model, Solved};

/// Shares at a minimum, and the root mean square of the residuals there.
#[derive(Debug, Clone)]
pub struct Found {
    pub shares: Vec<f64>,
    pub rms_hz: f64,
}

struct Problem<'a> {
    model: &'a Model<'a>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// Shares and modes of the last residual: where a step is taken, the derivatives need the same modes.
    last: Mutex<Option<(Vec<f64>, Option<Solved>)>>,
}

impl Constraints for Problem<'_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl Residual for Problem<'_> {
    type Param = Vec<f64>;
    type Output = Vec<f64>;
    type Error = SpectrumError;

    fn residual(&self, shares: &Vec<f64>) -> Result<Vec<f64>, SpectrumError> {
        let solved = self.model.solved(shares)?;
        let residuals = self.model.residuals_of(solved.as_ref());
        *self.last() = Some((shares.clone(), solved));
        Ok(residuals)
    }
}

impl Jacobian for Problem<'_> {
    type Jacobian = DenseMatrix<f64>;

    fn jacobian(&self, shares: &Vec<f64>) -> Result<DenseMatrix<f64>, SpectrumError> {
        Ok(self.residual_and_jacobian(shares)?.1)
    }

    fn residual_and_jacobian(
        &self,
        shares: &Vec<f64>,
    ) -> Result<(Vec<f64>, DenseMatrix<f64>), SpectrumError> {
        if let Some((_, solved)) = self.last().as_ref().filter(|(at, _)| at == shares) {
            let solved = solved.as_ref();
            let slopes = self.model.slopes_of(shares, solved);
            return Ok((self.model.residuals_of(solved), slopes));
        }
        self.model.residuals_and_slopes(shares)
    }
}

impl Problem<'_> {
    fn last(&self) -> MutexGuard<'_, Option<(Vec<f64>, Option<Solved>)>> {
        self.last.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Where a search ends.
#[derive(Debug, Clone, Copy)]
pub struct Ends {
    /// Step, as a share of the distance between the bounds, below which the search ends.
    step: f64,
    /// Relative decrease of the sum of squares below which the search ends.
    decrease: f64,
}

impl Ends {
    /// At the digits of a report.
    pub const EXACT: Ends = Ends {
        step: 1e-8,
        decrease: 1e-12,
    };
    /// Where the minimum is known well enough to compare it with others, and to refine it.
    pub const COARSE: Ends = Ends {
        step: 1e-5,
        decrease: 1e-7,
    };
}

/// Largest number of steps.
const MAX_STEPS: u64 = 100;

/// The minimum reached from a start (trust-region reflective method, as in SciPy). `None` if the start is not a valid
/// saw, or the search fails.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn minimum(
    model: &Model<'_>,
    start: &[f64],
    ends: Ends,
) -> Result<Option<Found>, SpectrumError> {
    let count = start.len();
    let problem = Problem {
        model,
        lower: vec![0.0; count],
        upper: vec![1.0; count],
        last: Mutex::new(None),
    };
    let at_start = problem.residual(&start.to_vec())?;
    if at_start.iter().any(|r| r.is_nan()) {
        return Ok(None);
    }
    let solver = TrustRegionReflective::new()
        .with_relative_cost_change_tolerance(ends.decrease)
        .with_relative_step_tolerance(ends.step);
    let run = Executor::from_start(problem, solver, start.to_vec())
        .max_iter(MAX_STEPS)
        .run();
    let result = match run {
        Ok(result) => result,
        Err(basin::ConstraintSolveError::Evaluation(error)) => return Err(error),
        Err(_) => return Ok(None),
    };
    let rms_hz = (2.0 * result.cost() / at_start.len() as f64).sqrt();
    Ok(rms_hz.is_finite().then(|| Found {
        shares: result.param().clone(),
        rms_hz,
    }))
}

/// Confidence intervals and correlations of the fitted numbers.
#[derive(Debug)]
pub struct Spread {
    /// Half width of the interval of each share; `None` at a bound, and if the data do not distinguish the
    /// number from others.
    pub half_widths: Vec<Option<f64>>,
    /// Correlation of each pair; zero if one of them has no interval.
    pub correlation: Vec<Vec<f64>>,
    /// Number of measured frequencies minus number of free numbers.
    pub degrees_of_freedom: usize,
}

/// A share nearer to a bound than this is taken for the bound, because the solver remains strictly inside.
const AT_BOUND: f64 = 1e-4;
/// If the columns of the Jacobian, scaled to unit length, are dependent to within this tolerance, a
/// combination of numbers is undetermined.
const DEPENDENT: f64 = 1e-6;

/// Whether a share is taken for a bound.
pub fn at_bound(share: f64) -> bool {
    !(AT_BOUND..=1.0 - AT_BOUND).contains(&share)
}

/// Intervals and correlations by linear theory at the minimum: the covariance s² (JᵀJ)⁻¹ with s² = ‖r‖²/(m − p), and
/// Student's distribution of m − p degrees of freedom (Seber and Wild, *Nonlinear Regression*, 1989, §5.1). The errors of
/// high frequencies may be larger than those of low ones: where it is larger, the variance of HC3 counts, which assumes
/// no equal errors, (JᵀJ)⁻¹ Jᵀ diag(r_i²/(1 − h_i)²) J (JᵀJ)⁻¹ with the leverages h_i (MacKinnon and White, *Journal of
/// Econometrics* 29, 1985). Shares at a bound count as known.
///
/// # Errors
/// [`SpectrumError`] when an eigenproblem fails.
pub fn statistics(
    model: &Model<'_>,
    shares: &[f64],
    confidence: f64,
) -> Result<Spread, SpectrumError> {
    let (residuals, slopes) = model.residuals_and_slopes(shares)?;
    let free: Vec<usize> = (0..shares.len())
        .filter(|&k| !at_bound(shares[k]))
        .collect();
    let degrees_of_freedom = residuals.len().saturating_sub(free.len());
    let mut spread = Spread {
        half_widths: vec![None; shares.len()],
        correlation: vec![vec![0.0; shares.len()]; shares.len()],
        degrees_of_freedom,
    };
    if free.is_empty() {
        return Ok(spread);
    }
    let jacobian = Mat::from_fn(residuals.len(), free.len(), |i, k| slopes.get(i, free[k]));
    let lengths: Vec<f64> = jacobian.col_iter().map(|column| column.norm_l2()).collect();
    let student = StudentsT::new(0.0, 1.0, degrees_of_freedom as f64);
    let (Ok(student), true) = (student, lengths.iter().all(|length| *length > 0.0)) else {
        return Ok(spread);
    };
    let unit = Mat::from_fn(residuals.len(), free.len(), |i, k| {
        jacobian[(i, k)] / lengths[k]
    });
    let Ok(RightSingular { values, vectors }) = RightSingular::new(unit.as_ref()) else {
        return Ok(spread);
    };
    let variance = residuals.iter().map(|r| r * r).sum::<f64>() / degrees_of_freedom as f64;
    let quantile = student.inverse_cdf(0.5 + 0.5 * confidence);
    let open = |i: usize| values[i] < DEPENDENT;
    let loose: Vec<bool> = (0..free.len())
        .map(|k| (0..free.len()).any(|i| open(i) && vectors[(k, i)].abs() > DEPENDENT.sqrt()))
        .collect();
    let inverse = |k: usize, l: usize| -> f64 {
        let known = (0..free.len()).filter(|&i| !open(i));
        let terms = known.map(|i| vectors[(k, i)] * vectors[(l, i)] / values[i].powi(2));
        terms.sum::<f64>()
    };
    let inverse = Mat::from_fn(free.len(), free.len(), inverse);
    let by_residual = &inverse * unit.transpose();
    // The residual that a frequency has if the numbers are fitted without it.
    let left_out_hz: Vec<f64> = (0..residuals.len())
        .map(|i| {
            let leverage: f64 = (0..free.len())
                .map(|k| unit[(i, k)] * by_residual[(k, i)])
                .sum();
            residuals[i] / (1.0 - leverage).max(DEPENDENT)
        })
        .collect();
    for k in (0..free.len()).filter(|&k| !loose[k]) {
        let of_equal = variance * inverse[(k, k)];
        let moved = left_out_hz.iter().enumerate();
        let of_unequal: f64 = moved
            .map(|(i, hz)| (by_residual[(k, i)] * hz).powi(2))
            .sum();
        let deviation = of_equal.max(of_unequal).sqrt() / lengths[k];
        spread.half_widths[free[k]] = Some(quantile * deviation);
        for l in (0..free.len()).filter(|&l| !loose[l]) {
            let together = inverse[(k, l)] / (inverse[(k, k)] * inverse[(l, l)]).sqrt();
            spread.correlation[free[k]][free[l]] = together;
        }
    }
    Ok(spread)
}
