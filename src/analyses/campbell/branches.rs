//! Numbers and names of the branches of a Campbell diagram, unique in every output.

use std::f64::consts::TAU;

use faer::{Col, c64};

use super::chart::BranchCurve;
use crate::model::scene::rpm;
use crate::modes::branches::{Branch, Campbell};
use crate::modes::{
    Direction, EventName, Mode, ModeKind, NamedCriticalSpeed, NamedMode, SpectralModel,
};
use crate::stability::{Analysis, Instability, InstabilityKind};

/// Smallest likeness of a mode and the wave of a critical speed for which the mode is taken for this wave. The
/// likeness of a travelling and a standing wave is a half.
const LEAST_LIKENESS: f64 = 0.4;

/// The branches of an analysis in the order of their numbers.
pub struct Numbered<'a> {
    analysis: &'a Analysis,
    /// Index, in this order, of each branch of the diagram.
    place: Vec<usize>,
    names: Vec<BranchName>,
}

#[derive(Clone)]
struct BranchName {
    words: String,
    short: String,
}

impl<'a> Numbered<'a> {
    /// Numbers the branches in the order of their first speeds; branches that begin at one speed in the order of
    /// their frequencies, those that decay without oscillating last.
    pub fn new(analysis: &'a Analysis) -> Self {
        let campbell = &analysis.chart.campbell;
        let start = |b: usize| {
            let first = campbell.branches[b].points[0];
            let mode = &campbell.mode(first).mode;
            (first.0, mode.is_overdamped(), mode.frequency_rad_per_s())
        };
        let mut order: Vec<usize> = (0..campbell.branches.len()).collect();
        order.sort_by(|x, y| {
            let (x, y) = (start(*x), start(*y));
            (x.0, x.1).cmp(&(y.0, y.1)).then(x.2.total_cmp(&y.2))
        });
        let mut place = vec![0; order.len()];
        for (at, branch) in order.iter().enumerate() {
            place[*branch] = at;
        }
        let named = order
            .iter()
            .map(|b| BranchName::new(analysis, &campbell.branches[*b]));
        Numbered {
            analysis,
            place,
            names: named.collect(),
        }
    }

    /// Name of the branch with this number.
    pub fn name(&self, number: usize) -> String {
        self.names[number - 1].words.clone()
    }

    /// Branches as entries of the report, in the order of their numbers.
    pub fn entries(&self) -> Vec<BranchCurve> {
        let branches = self.campbell().branches.iter().zip(&self.place);
        let mut entries: Vec<BranchCurve> = branches
            .map(|(branch, place)| self.entry(branch, *place))
            .collect();
        entries.sort_by_key(|entry| entry.branch);
        entries
    }

    /// Number of the branch that begins at a mode at rest, if the sweep begins at rest; `index` counts the
    /// oscillating modes from 0.
    pub fn of_mode_at_rest(&self, index: usize) -> Option<usize> {
        let first = self
            .campbell()
            .samples
            .first()
            .filter(|sample| sample.speed_rad_per_s == 0.0)?;
        let modes = first.modes.iter().enumerate();
        let mut oscillating = modes.filter(|(_, mode)| !mode.mode.is_overdamped());
        self.at((0, oscillating.nth(index)?.0))
    }

    /// Numbers of the growing branch of a band and of its mirror image, at the speed of largest growth.
    pub fn of_band(&self, band: &Instability) -> Vec<usize> {
        let growing = self.at_peak(band, self.growing_kind(band));
        let conservative = self.analysis.model.is_conservative();
        let partner = match (band.kind, conservative) {
            (InstabilityKind::Divergence, _) => None,
            (InstabilityKind::Flutter, true) => self.at_peak(band, ModeKind::Decaying),
            (InstabilityKind::Flutter, false) => self.damped_partner(band),
        };
        let both = [growing, partner].into_iter().flatten();
        both.filter_map(|point| self.at(point)).collect()
    }

    /// Name of a band by its waves; `None` if no mode grows at the speed of the diagram that is nearest to the peak.
    pub fn event(&self, band: &Instability) -> Option<EventName> {
        let point = self.at_peak(band, self.growing_kind(band))?;
        let growing = self.campbell().mode(point).mode.clone();
        let speed = self.campbell().samples[point.0].speed_rad_per_s;
        let model = &self.analysis.model;
        let described = model.describe(speed, vec![growing]).pop()?;
        Some(EventName::growing(
            &model.plate,
            &described.mode,
            &described.shape,
            speed,
        ))
    }

    fn growing_kind(&self, band: &Instability) -> ModeKind {
        match band.kind {
            _ if !self.analysis.model.is_conservative() => ModeKind::Damped,
            InstabilityKind::Divergence => ModeKind::Divergent,
            InstabilityKind::Flutter => ModeKind::Flutter,
        }
    }

    /// The mode of a kind that is nearest to the mode of largest growth of a band, or to its mirror image.
    fn at_peak(&self, band: &Instability, kind: ModeKind) -> Option<(usize, usize)> {
        let index = self.campbell().solved_near(band.peak_rad_per_s)?;
        let modes = self.campbell().samples[index].modes.iter().enumerate();
        let grows = |m: &NamedMode| kind != ModeKind::Damped || m.mode.lambda.re > 0.0;
        let same = modes.filter(|(_, m)| m.mode.kind == kind && grows(m));
        let wanted = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
        let off = |m: &NamedMode| {
            let lambda = m.mode.lambda;
            (c64::new(lambda.re.abs(), lambda.im) - wanted).norm()
        };
        let nearest = same.min_by(|x, y| off(x.1).total_cmp(&off(y.1)))?;
        Some((index, nearest.0))
    }

    fn damped_partner(&self, band: &Instability) -> Option<(usize, usize)> {
        let index = self.campbell().solved_near(band.peak_rad_per_s)?;
        let growing = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
        let partner = damped_partner(&self.campbell().samples[index].modes, growing)?;
        Some((index, partner))
    }

    /// Number of the branch whose wave stands still at a critical speed.
    pub fn of_critical(&self, critical: &NamedCriticalSpeed) -> Option<usize> {
        let samples = &self.campbell().samples;
        let above = samples.partition_point(|s| s.speed_rad_per_s < critical.speed_rad_per_s);
        let model = &self.analysis.model;
        let is_solved = |index: &usize| samples[*index].is_solved();
        let beside = [
            (0..above).rev().find(is_solved),
            (above..samples.len()).find(is_solved),
        ];
        let candidates: Vec<_> = beside
            .into_iter()
            .flatten()
            .flat_map(|index| {
                let modes = samples[index].modes.iter().enumerate();
                let own = modes.filter(|(_, m)| m.mode.component == critical.component);
                own.map(move |(k, m)| (standing_likeness(model, critical, &m.mode), m, (index, k)))
            })
            .collect();
        let best = candidates.iter().map(|c| c.0).fold(0.0, f64::max);
        // The two waves of a harmonic of a blade without guides have the same shape; near the critical speed
        // the one that stands still has the smaller frequency.
        let alike = candidates.iter().filter(|c| c.0 >= ALIKE * best);
        let found =
            alike.min_by(|x, y| x.1.mode.lambda.norm().total_cmp(&y.1.mode.lambda.norm()))?;
        self.at(found.2).filter(|_| found.0 >= LEAST_LIKENESS)
    }

    fn campbell(&self) -> &'a Campbell {
        &self.analysis.chart.campbell
    }

    /// Number of the branch through a point.
    pub fn at(&self, point: (usize, usize)) -> Option<usize> {
        let branches = &self.campbell().branches;
        let is_through = |branch: &Branch| {
            let place = branch.points.binary_search_by_key(&point.0, |p| p.0);
            place.is_ok_and(|at| branch.points[at] == point)
        };
        let branch = branches.iter().position(is_through)?;
        Some(self.place[branch] + 1)
    }

    fn entry(&self, branch: &Branch, place: usize) -> BranchCurve {
        let campbell = self.campbell();
        let modes: Vec<&NamedMode> = branch.points.iter().map(|&p| campbell.mode(p)).collect();
        let list = |value: fn(&NamedMode) -> f64| modes.iter().map(|m| value(m)).collect();
        let speed = |&(s, _): &(usize, usize)| rpm(campbell.samples[s].speed_rad_per_s);
        let harmonics = |m: &&NamedMode| {
            let diameters = |place: usize| m.name.harmonics.get(place).map_or(0, |h| h.diameters);
            [diameters(0), diameters(1)]
        };
        let body = branch
            .points
            .iter()
            .zip(&modes)
            .map(|((sample, _), named)| {
                let speed = campbell.samples[*sample].speed_rad_per_s;
                named.name.body_frequency_rad_per_s(&named.mode, speed) / TAU
            });
        let named = &modes[naming_point(self.analysis, branch)].name;
        let name = &self.names[place];
        BranchCurve {
            branch: place + 1,
            name: name.words.clone(),
            label: format!("{}: {}", place + 1, name.short),
            nodal_diameters: named.diameters,
            nodal_circles: named.circles,
            direction: modes.iter().map(|m| m.name.direction.on_blade()).collect(),
            rpm: branch.points.iter().map(speed).collect(),
            frequency_hz: list(|m| m.mode.frequency_rad_per_s() / TAU),
            body_frequency_hz: body.collect(),
            growth_per_s: list(|m| m.mode.growth_per_s()),
            krein_sign: modes.iter().map(|m| m.mode.krein_sign()).collect(),
            dominant_harmonics: modes.iter().map(harmonics).collect(),
        }
    }
}

/// Index of the point whose mode names a branch: the first, or, for a blade without guides, the second,
/// because the two waves of a harmonic cannot be distinguished at rest.
fn naming_point(analysis: &Analysis, branch: &Branch) -> usize {
    usize::from(analysis.model.plate.is_axisymmetric() && branch.points.len() > 1)
}

impl BranchName {
    fn new(analysis: &Analysis, branch: &Branch) -> Self {
        let campbell = &analysis.chart.campbell;
        let point = branch.points[naming_point(analysis, branch)];
        let name = &campbell.mode(point).name;
        // With guides, modes at rest are standing waves, which have no direction.
        let at_rest = campbell.samples[point.0].speed_rad_per_s == 0.0;
        let direction = match name.direction.on_blade() {
            _ if at_rest => None,
            Direction::Forward => Some("forward"),
            Direction::Backward => Some("backward"),
            Direction::Standing | Direction::Reflected => None,
        };
        let of = |name: String, between: &str| match direction {
            Some(direction) => format!("{name}{between}{direction}"),
            None => name,
        };
        BranchName {
            words: of(name.in_shares(), ", "),
            short: of(name.in_short(), " "),
        }
    }
}

/// A mode is a candidate for the wave of a critical speed if its likeness is at least this share of the largest.
const ALIKE: f64 = 0.8;

/// |xᵀq|² of the shape x at a critical speed and the waves q that name a mode, both of length one.
fn standing_likeness(model: &SpectralModel, critical: &NamedCriticalSpeed, mode: &Mode) -> f64 {
    let waves = model.naming_waves(std::slice::from_ref(mode));
    let own: Col<c64> = model.components[critical.component].coordinates(&waves[0]);
    let product: c64 = (0..own.nrows()).map(|i| own[i] * critical.shape[i]).sum();
    product.norm_sqr()
}

/// The mode with which a growing mode of a damped blade has coalesced: the two eigenvalues are λ = c ± g, of
/// nearly equal frequency and different growth. A wave that damping alone destabilizes has no such partner.
fn damped_partner(modes: &[NamedMode], growing: c64) -> Option<usize> {
    let off = |m: &NamedMode| (m.mode.lambda.im - growing.im).abs();
    let is_near = |m: &NamedMode| off(m) < growing.re - m.mode.lambda.re;
    let modes = modes.iter().enumerate();
    let partners = modes.filter(|(_, m)| m.mode.lambda.re < 0.0 && is_near(m));
    let nearest = partners.min_by(|x, y| off(x.1).total_cmp(&off(y.1)));
    nearest.map(|(k, _)| k)
}
