//! Limits of a saw in its cut at one speed: no vibration grows, the deflection stays within the model, the speed keeps its distance from
//! critical speeds, and the rim moves little.

use super::{CutFinding, CutStability};
use crate::analyses::verdict::{
    Answer, Criterion, LimitSource, STABILITY, Verdict, of_critical, of_margin,
};
use crate::model::scene::{Scene, rpm};
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::motion::transient::{LINEAR_THICKNESSES, linear_limit_m};
use crate::page::text::shown_to;

/// Results at one speed of a cut from which its verdict follows.
pub(super) struct InCut<'a> {
    pub speed_rad_per_s: f64,
    pub stability: CutStability,
    /// The finding of fastest growth among those that decide.
    pub decisive: Option<&'a CutFinding>,
    /// Whether the record leaves the model, linear or with stretching.
    pub leaves_model: bool,
    pub is_stretched: bool,
    /// Critical speeds with and without the forces, ascending.
    pub critical_rad_per_s: &'a [f64],
    /// Largest deflection of the rim, if it is within the model.
    pub largest_deflection_m: Option<f64>,
}

impl InCut<'_> {
    /// The verdict by the limits of the scene.
    pub fn verdict(&self, scene: &Scene) -> Verdict {
        let speed = self.speed_rad_per_s;
        let limits = vec![
            self.of_growth(),
            self.of_model(scene),
            of_critical(self.critical_rad_per_s, speed),
            self.of_margin(scene),
            self.of_width(scene),
        ];
        let verdict = Verdict::at_one_speed(rpm(speed), limits);
        let growing = self
            .decisive
            .filter(|_| self.stability == CutStability::Unstable);
        let cause = growing.map(|found| match found.frequency_hz {
            Some(0.0) => "divergence".to_owned(),
            _ => "flutter".to_owned(),
        });
        Verdict {
            cause: cause.or(verdict.cause),
            ..verdict
        }
    }

    fn of_growth(&self) -> Criterion {
        let grows = self.stability == CutStability::Unstable;
        let finding = match self.decisive.filter(|_| grows) {
            Some(found) => in_words(found),
            None if grows => "a vibration grows".to_owned(),
            None => "no vibration grows".to_owned(),
        };
        let source = LimitSource::Stability;
        self.criterion(
            STABILITY,
            "no growing vibration in the cut",
            finding,
            source,
            !grows,
        )
    }

    /// Critical speeds are searched only as far as this limit requires.
    fn of_margin(&self, scene: &Scene) -> Criterion {
        let first = self.critical_rad_per_s.first();
        let found = of_margin(&scene.limits(), first, self.speed_rad_per_s);
        let finding = match first {
            Some(_) => found.finding,
            None => format!("no critical speed up to {:.0} rpm", found.asked_rpm),
        };
        Criterion { finding, ..found }
    }

    fn of_model(&self, scene: &Scene) -> Criterion {
        let finding = match (self.leaves_model, self.is_stretched) {
            (false, _) => "within the model".to_owned(),
            (true, true) => format!(
                "slopes of the blade exceed {LARGEST_SLOPE}, where the model with stretching ends"
            ),
            (true, false) => format!(
                "more than {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm), where the linear model ends, more than any kerf",
                1e3 * linear_limit_m(scene.blade())
            ),
        };
        let source = LimitSource::Practice;
        self.criterion(
            "validity",
            "deflection within the model",
            finding,
            source,
            !self.leaves_model,
        )
    }

    /// A rim that moves by more than the thickness of the blade cuts a kerf that is as much wider.
    fn of_width(&self, scene: &Scene) -> Criterion {
        let thickness_m = scene.blade().thickness_range_m()[0];
        let found = self.largest_deflection_m;
        let finding = found.map_or("unknown".to_owned(), |found_m| {
            format!("{} mm", shown_to(3, 1e3 * found_m))
        });
        let is_narrow = found.is_none_or(|found_m| found_m <= thickness_m);
        let name = "motion of the rim of at most the thickness of the blade";
        self.criterion("width", name, finding, LimitSource::Practice, is_narrow)
    }

    fn criterion(
        &self,
        key: &str,
        name: &str,
        finding: String,
        source: LimitSource,
        is_kept: bool,
    ) -> Criterion {
        Criterion {
            key: key.to_owned(),
            name: name.to_owned(),
            finding,
            found_rpm: None,
            asked_rpm: rpm(self.speed_rad_per_s),
            source,
            answer: Answer::Yes,
        }
        .kept_if(is_kept)
    }
}

/// Growth rate, frequency, and the criterion that decides.
fn in_words(found: &CutFinding) -> String {
    let frequency = match found.frequency_hz {
        Some(hz) if hz > 0.0 => format!(" at {hz:.2} Hz"),
        Some(_) => " without oscillation".into(),
        None => String::new(),
    };
    format!(
        "growth of {:.3} 1/s{frequency} ({})",
        found.growth_per_s, found.criterion
    )
}
