//! The value at which a saw begins, or ceases, to keep its limits.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::SizeError;
use super::saw::{Question, SizedSaw};

/// Two saws between whose values the limits begin, or cease, to be kept.
#[derive(Debug, Clone)]
pub struct Bracket {
    /// The saw that keeps all limits.
    pub kept: SizedSaw,
    /// The saw that does not.
    pub broken: SizedSaw,
}

/// Largest number of saws in the search for one edge.
const STEPS: usize = 40;
/// Share of its value to which an edge is known: at first, and with the tolerance of the scene.
const NEAR: f64 = 1e-3;
const CLOSE: f64 = 1e-4;
/// Share of the value by which the edge may differ between the two tolerances.
const SHIFT: f64 = 2e-2;

impl Bracket {
    /// The bracket of two saws; `None` if both keep all limits, or neither does.
    pub fn between(x: SizedSaw, y: SizedSaw) -> Option<Self> {
        match (x.is_kept(), y.is_kept()) {
            (true, false) => Some(Bracket { kept: x, broken: y }),
            (false, true) => Some(Bracket { kept: y, broken: x }),
            _ => None,
        }
    }

    fn width(&self) -> f64 {
        (self.broken.value - self.kept.value).abs()
    }

    /// Closes in on the edge: by the secant through the distances from the limits (Illinois), which are continuous where one limit
    /// binds, and by halves where they jump.
    fn closed_to(mut self, share: f64, ask: &Ask<'_>) -> Result<Self, SizeError> {
        let mut weights = [self.kept.margin(), self.broken.margin()];
        let mut last = None;
        let mut is_slow = false;
        for _ in 0..STEPS {
            let width = self.width();
            if width <= share * self.kept.value.abs().max(self.broken.value.abs()) {
                break;
            }
            let secant = weights[0] / (weights[0] - weights[1]);
            let at = if is_slow || !(1e-3..=1.0 - 1e-3).contains(&secant) {
                0.5
            } else {
                secant
            };
            let next = ask.ask(self.kept.value + at * (self.broken.value - self.kept.value))?;
            let is_kept = next.is_kept();
            weights[usize::from(!is_kept)] = next.margin();
            if is_kept {
                self.kept = next;
            } else {
                self.broken = next;
            }
            if last == Some(is_kept) {
                weights[usize::from(is_kept)] *= 0.5;
            }
            last = Some(is_kept);
            is_slow = self.width() > 0.5 * width;
        }
        Ok(self)
    }
}

/// A question that counts its saws.
struct Ask<'a> {
    question: &'a Question<'a>,
    asked: &'a AtomicUsize,
}

impl Ask<'_> {
    fn ask(&self, value: f64) -> Result<SizedSaw, SizeError> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        self.question.ask(value)
    }
}

/// The edge within a bracket with the tolerance of the scene, after a search with a larger one.
///
/// # Errors
/// [`SizeError`] if the computation was cancelled.
pub fn closed_in(
    quick: &Question<'_>,
    exact: &Question<'_>,
    bracket: &Bracket,
    asked: &AtomicUsize,
) -> Result<Bracket, SizeError> {
    let [quick, exact] = [quick, exact].map(|question| Ask { question, asked });
    if quick.question.tolerance.is_none() {
        return bracket.clone().closed_to(CLOSE, &exact);
    }
    let near = bracket.clone().closed_to(NEAR, &quick)?;
    let outward = (near.broken.value - near.kept.value).signum() * SHIFT;
    let ends = [
        near.kept.value - outward * near.kept.value.abs(),
        near.broken.value + outward * near.broken.value.abs(),
    ];
    let [low, high] = [
        bracket.kept.value.min(bracket.broken.value),
        bracket.kept.value.max(bracket.broken.value),
    ];
    for ends in [
        ends.map(|end| end.clamp(low, high)),
        [bracket.kept.value, bracket.broken.value],
    ] {
        if let Some(around) = Bracket::between(exact.ask(ends[0])?, exact.ask(ends[1])?) {
            return around.closed_to(CLOSE, &exact);
        }
    }
    // The edge is beside the bracket by less than the error of the search.
    Ok(near)
}
