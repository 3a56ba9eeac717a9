//! Curves of equilibria over speed, through their folds.

use faer::linalg::solvers::Solve;
use faer::{Col, Mat, Scale};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::equilibrium::{ITERATIONS, LAST};
use super::{Equilibrium, StretchedBlade, StretchedError, finite};
use crate::model::scene::SpeedRange;

/// A curve of equilibria.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Equilibria in the order of the curve.
    pub equilibria: Vec<Equilibrium>,
    /// Points at which ∂²V/∂p² is singular, in the order of the curve.
    pub turns: Vec<Turn>,
    /// Where the curve ends.
    pub end: BranchEnd,
}

/// End of a curve of equilibria.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BranchEnd {
    /// Where its extent says.
    Reached,
    /// At the largest number of equilibria.
    Most,
    /// Within the range of speeds, because no shorter step leads to another equilibrium.
    Lost,
}

/// A fold or a bifurcation of a curve of equilibria.
#[derive(Debug, Clone, PartialEq)]
pub struct Turn {
    /// Kind of the point.
    pub kind: TurnKind,
    /// The equilibrium at this point, with the number of negative eigenvalues that the curve has before it.
    pub equilibrium: Equilibrium,
}

/// Kinds of points at which ∂²V/∂p² is singular.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum TurnKind {
    /// The curve turns back in speed.
    Fold,
    /// Another curve crosses.
    Bifurcation,
}

/// Longest step along the curve, as a share of the range of speeds, or of [`StretchedBlade::size`] in
/// deflection.
const LONGEST: f64 = 0.02;
/// Smallest step, as a share of the longest.
const SHORTEST: f64 = 1e-4;
/// Largest number of iterations of a correction. If it does not converge the step is halved; after fewer than three
/// iterations it is doubled.
const CORRECTIONS: usize = 6;
/// Largest number of equilibria of a curve.
const MOST: usize = 4000;
/// Largest number of equilibria of a curve in a figure.
const DRAWN: usize = 500;

/// End of a curve within its range of speeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// At an end of the range.
    Whole,
    /// At an end of the range, with no more equilibria than a figure shows.
    Drawn,
    /// At the first fold or bifurcation.
    ToTurn,
}

impl Extent {
    /// Largest number of equilibria.
    fn most(self) -> usize {
        if self == Extent::Drawn { DRAWN } else { MOST }
    }
}

/// A point of the curve, and the direction of the curve there, of unit length in the units of [`Curve`].
struct Place {
    equilibrium: Equilibrium,
    direction: Col<f64>,
}

impl StretchedBlade {
    /// Follows a curve from an equilibrium, towards higher or lower speeds, to an end of the range of speeds, or to
    /// the earlier end that `extent` names.
    ///
    /// # Errors
    /// [`StretchedError::Value`] for an empty range or one that does not contain the start;
    /// [`StretchedError::Axisymmetric`]; [`StretchedError::NotFound`] if the curve has no direction at the start, or no equilibrium at
    /// the end of the range.
    pub fn branch(
        &self,
        start: &Equilibrium,
        upwards: bool,
        range: SpeedRange,
        extent: Extent,
    ) -> Result<Branch, StretchedError> {
        let [from_rad_per_s, to_rad_per_s] = range.ends();
        finite("the lower end of the range in rad/s", from_rad_per_s)?;
        finite("the upper end of the range in rad/s", to_rad_per_s)?;
        let speed = start.speed_rad_per_s;
        if !range.contains(speed) || from_rad_per_s == to_rad_per_s {
            return Err(StretchedError::Value {
                what: "the speed of the start in rad/s",
                value: speed,
                allowed: " within the range of speeds, which must not be empty",
            });
        }
        self.directed(&start.coordinates)?;
        let curve = Curve {
            blade: self,
            size: self.size(),
            range_rad_per_s: range.width(),
        };
        let order = self.force.nrows();
        let towards = Col::from_fn(order + 1, |i| match (i == order, upwards) {
            (false, _) => 0.0,
            (true, true) => 1.0,
            (true, false) => -1.0,
        });
        let mut place = Place {
            direction: curve.direction(
                start,
                &self.hessian(&start.coordinates, speed)?,
                &towards,
            )?,
            equilibrium: start.clone(),
        };
        let mut branch = Branch {
            equilibria: vec![start.clone()],
            turns: Vec::new(),
            end: BranchEnd::Most,
        };
        let mut step = 0.1 * LONGEST;
        while branch.equilibria.len() < extent.most() {
            let Some((next, iterations)) = curve.advanced(&place, step)? else {
                step *= 0.5;
                if step < SHORTEST * LONGEST {
                    branch.end = BranchEnd::Lost;
                    break;
                }
                continue;
            };
            branch.turns.extend(curve.turn(&place, &next, step)?);
            let outside = next.equilibrium.speed_rad_per_s;
            if !range.contains(outside) {
                let edge = outside.clamp(from_rad_per_s, to_rad_per_s);
                let last = self.equilibrium(edge, Some(&next.equilibrium.coordinates))?;
                branch
                    .turns
                    .retain(|turn| range.contains(turn.equilibrium.speed_rad_per_s));
                branch.equilibria.push(last);
                branch.end = BranchEnd::Reached;
                break;
            }
            branch.equilibria.push(next.equilibrium.clone());
            if extent == Extent::ToTurn && !branch.turns.is_empty() {
                branch.end = BranchEnd::Reached;
                break;
            }
            place = next;
            if iterations < 3 {
                step = (2.0 * step).min(LONGEST);
            }
        }
        Ok(branch)
    }
}

/// An end of an interval along a curve in which a turn is.
struct End {
    step: f64,
    /// The quantity that is zero at the turn.
    value: f64,
    /// The value that false position uses.
    weight: f64,
    equilibrium: Equilibrium,
}

/// The coordinates and the speed at a share of the line from one equilibrium to another, with the number of eigenvalues of the first.
fn between(from: &Equilibrium, to: &Equilibrium, share: f64) -> Equilibrium {
    Equilibrium {
        speed_rad_per_s: from.speed_rad_per_s + share * (to.speed_rad_per_s - from.speed_rad_per_s),
        coordinates: &from.coordinates + Scale(share) * (&to.coordinates - &from.coordinates),
        negative_eigenvalues: from.negative_eigenvalues,
    }
}

/// A curve in the units of its steps.
struct Curve<'a> {
    blade: &'a StretchedBlade,
    /// Unit of p, in √kg·m: one thickness over the whole blade.
    size: f64,
    range_rad_per_s: f64,
}

impl Curve<'_> {
    /// The point one step further along the direction, and the number of iterations; `None` if they do not
    /// converge, or if the direction changes too much.
    fn advanced(&self, place: &Place, step: f64) -> Result<Option<(Place, usize)>, StretchedError> {
        let order = place.direction.nrows() - 1;
        let begun = self.scaled(&place.equilibrium);
        let mut x = &begun + Scale(step) * &place.direction;
        for iteration in 1..=CORRECTIONS {
            let (p, speed) = self.unscaled(&x);
            let tension = self.blade.stretching().tension(&p)?;
            let rest = self.blade.residual_with(&p, &tension, speed);
            let along = place.direction.transpose() * (&x - &begun) - step;
            let right = Col::from_fn(order + 1, |i| if i < order { rest[i] } else { along });
            let hessian = self.blade.hessian_with(&p, &tension, speed);
            let correction = self
                .bordered(&hessian, (&p, speed), &place.direction)
                .partial_piv_lu()
                .solve(&right);
            x -= &correction;
            if !correction.norm_l2().is_finite() {
                return Ok(None);
            }
            if correction.norm_l2() <= LAST * step {
                let (p, speed) = self.unscaled(&x);
                let hessian = self.blade.hessian(&p, speed)?;
                let equilibrium = Equilibrium::with_hessian(p, speed, &hessian)?;
                let Ok(direction) = self.direction(&equilibrium, &hessian, &place.direction) else {
                    return Ok(None);
                };
                // A change of the direction is accepted up to the angle with the cosine 0.9, 26 degrees.
                let straight = direction.transpose() * &place.direction > 0.9;
                let next = Place {
                    equilibrium,
                    direction,
                };
                return Ok(straight.then_some((next, iteration)));
            }
        }
        Ok(None)
    }

    /// The unit tangent of the curve at an equilibrium, on the side of the direction `towards`.
    fn direction(
        &self,
        equilibrium: &Equilibrium,
        hessian: &Mat<f64>,
        towards: &Col<f64>,
    ) -> Result<Col<f64>, StretchedError> {
        let order = towards.nrows() - 1;
        let Equilibrium {
            coordinates,
            speed_rad_per_s,
            ..
        } = equilibrium;
        let matrix = self.bordered(hessian, (coordinates, *speed_rad_per_s), towards);
        let last = Col::from_fn(order + 1, |i| if i == order { 1.0 } else { 0.0 });
        let direction = matrix.partial_piv_lu().solve(&last);
        let length = direction.norm_l2();
        if length.is_finite() && length > 0.0 {
            Ok(Scale(1.0 / length) * direction)
        } else {
            Err(self.blade.not_found(coordinates, *speed_rad_per_s))
        }
    }

    /// The matrix [∂²V/∂p² · size, ∂²V/∂p∂Ω · range; tᵀ] in the units of the curve.
    fn bordered(&self, hessian: &Mat<f64>, (p, speed): (&Col<f64>, f64), t: &Col<f64>) -> Mat<f64> {
        let order = p.nrows();
        let softening = self.blade.softening(p, speed);
        Mat::from_fn(order + 1, order + 1, |i, k| match (i < order, k < order) {
            (true, true) => hessian[(i, k)] * self.size,
            (true, false) => softening[i] * self.range_rad_per_s,
            (false, _) => t[k],
        })
    }

    /// Finds the point between two others at which ∂²V/∂p² is singular. False position gives the step at which the
    /// speed is largest or smallest, or at which the eigenvalue that changes its sign is zero.
    fn turn(&self, from: &Place, to: &Place, step: f64) -> Result<Option<Turn>, StretchedError> {
        let order = from.direction.nrows() - 1;
        let counts = [from, to].map(|place| place.equilibrium.negative_eigenvalues);
        let turns_back = from.direction[order] * to.direction[order] < 0.0;
        if counts[0] == counts[1] && !turns_back {
            return Ok(None);
        }
        let value = |place: &Place| -> Result<f64, StretchedError> {
            if turns_back {
                return Ok(place.direction[order]);
            }
            let e = &place.equilibrium;
            let values = self.blade.stiffnesses(&e.coordinates, e.speed_rad_per_s)?;
            Ok(values[counts[0].min(counts[1])])
        };
        let end = |step: f64, place: &Place| -> Result<End, StretchedError> {
            let value = value(place)?;
            Ok(End {
                step,
                value,
                weight: value,
                equilibrium: place.equilibrium.clone(),
            })
        };
        let mut ends = [end(0.0, from)?, end(step, to)?];
        let scale = ends[0].value.abs().max(ends[1].value.abs());
        for _ in 0..ITERATIONS {
            let [low, high] = &ends;
            let width = high.step - low.step;
            let middle = low.step - low.weight * width / (high.weight - low.weight);
            // At a bifurcation the equations of a correction are singular, so that next to it none may converge, or one converges
            // to the other curve: there the interval is made shorter from both ends.
            let either = [0.5 * (low.step + middle), 0.5 * (middle + high.step)];
            let asked = match self.advanced(from, middle)? {
                Some(found) => [Some((middle, found)), None],
                None => {
                    let of = |step: f64| -> Result<_, StretchedError> {
                        Ok(self.advanced(from, step)?.map(|found| (step, found)))
                    };
                    [of(either[0])?, of(either[1])?]
                }
            };
            let mut is_found = asked.iter().all(Option::is_none) || width <= LAST * step;
            for (step, (place, _)) in asked.into_iter().flatten() {
                if !(ends[0].step..=ends[1].step).contains(&step) {
                    continue;
                }
                let new = end(step, &place)?;
                is_found |= new.value.abs() < LAST * scale;
                // The weight of the end that is kept is halved at every step, a variant of the Illinois method.
                let is_low = (new.value < 0.0) == (ends[0].value < 0.0);
                ends[usize::from(is_low)].weight *= 0.5;
                ends[usize::from(!is_low)] = new;
            }
            if is_found {
                break;
            }
        }
        let [low, high] = &ends;
        // A value that is zero within rounding at both ends does not change its sign.
        let share = (low.value / (low.value - high.value)).clamp(0.0, 1.0);
        let share = if share.is_nan() { 0.5 } else { share };
        let mut found = between(&low.equilibrium, &high.equilibrium, share);
        found.negative_eigenvalues = counts[0];
        // If the curve turns back while the number of negative eigenvalues stays the same, the point is not a
        // fold but a pitchfork, at which the curve touches another one.
        let kind = if turns_back && counts[0] != counts[1] {
            TurnKind::Fold
        } else {
            TurnKind::Bifurcation
        };
        Ok(Some(Turn {
            kind,
            equilibrium: found,
        }))
    }

    fn scaled(&self, equilibrium: &Equilibrium) -> Col<f64> {
        let p = &equilibrium.coordinates;
        Col::from_fn(p.nrows() + 1, |i| {
            if i < p.nrows() {
                p[i] / self.size
            } else {
                equilibrium.speed_rad_per_s / self.range_rad_per_s
            }
        })
    }

    fn unscaled(&self, x: &Col<f64>) -> (Col<f64>, f64) {
        let order = x.nrows() - 1;
        let p = Col::from_fn(order, |i| x[i] * self.size);
        (p, x[order] * self.range_rad_per_s)
    }
}
