//! The bands of a range are those of a longer range, cut at its ends, also if an end is at an event or next to it.

use faer::c64;
use sawflutter::model::evenly_spaced;
use sawflutter::model::plate::Plate;
use sawflutter::model::scene::{Scene, SceneFile, SpeedRange, rpm};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{
    NamedCriticalSpeed, SpectralModel, Strategy as Solver, companion_eigenpairs,
};
use sawflutter::stability::{Instability, InstabilityKind, chart, undamped_bands};

use crate::damped_bands::holds;
use crate::draws::*;

/// Relative distances of the ends of a range from an event.
const OFFSETS: [f64; 11] = [
    0.0, 1e-7, -1e-7, 1e-6, -1e-6, 1e-5, -1e-5, 1e-4, -1e-4, 2e-4, -2e-4,
];
/// A list may omit bands and parts of bands narrower than this share of the speed: their edges differ as much between
/// two reduced models, whose frequencies are accurate to 1e-8.
const NARROWEST: f64 = 5e-8;

/// The method of a search.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Way {
    /// The search of a chart.
    Chart,
    /// The search of a study and of `place`.
    Bands,
}

struct Saw {
    plate: Plate,
    system: GyroscopicSystem,
    critical: Vec<NamedCriticalSpeed>,
    top: f64,
    /// The bands of the range from rest to the top.
    bands: Vec<Instability>,
}

impl Saw {
    fn new(file: &SceneFile, top: f64) -> Self {
        let plate = Plate::new(&scene(file), SMALL);
        let critical = if plate.is_conservative() {
            SpectralModel::critical_speeds(&plate).unwrap()
        } else {
            SpectralModel::critical_speeds(&plate.conservative()).unwrap()
        };
        let mut saw = Saw {
            system: GyroscopicSystem::of_plate(&plate),
            plate,
            critical,
            top,
            bands: Vec::new(),
        };
        saw.bands = saw.bands_of(SpeedRange::new(0.0, top), Way::Chart);
        saw
    }

    /// Bands of a range, whose certificate must not fail.
    fn bands_of(&self, range: SpeedRange, way: Way) -> Vec<Instability> {
        let (plate, critical) = (self.plate.clone(), self.critical.clone());
        let model = |strategy| {
            SpectralModel::with_critical(plate.clone(), critical.clone(), range, strategy).unwrap()
        };
        let (bands, certificate) = match way {
            Way::Bands => {
                let found = undamped_bands(&model(Solver::Bands), range, 25).unwrap();
                (found.instabilities, found.certificate)
            }
            Way::Chart => {
                let chart = chart(&model(Solver::Reduced), range, 5, &|_, _| ()).unwrap();
                (chart.instabilities, chart.certificate)
            }
        };
        assert!(certificate.is_clean(), "{}: {certificate:?}", told(range));
        let unproven = certificate.unproven_rad_per_s.iter().flatten();
        for open in unproven {
            assert!(open.width() > 0.0 && open.within(range) == *open);
        }
        bands
    }

    /// Speeds at which a band begins or ends.
    fn events(&self) -> Vec<f64> {
        let edges = |b: &Instability| [b.from_rad_per_s, b.to_rad_per_s];
        let mut events: Vec<f64> = self.bands.iter().flat_map(edges).collect();
        events.extend(self.critical.iter().map(|c| c.speed_rad_per_s));
        events.retain(|speed| *speed < 0.999 * self.top);
        events.sort_by(f64::total_cmp);
        events.dedup_by(|x, y| (*x / *y - 1.0).abs() < NARROWEST);
        events
    }

    /// Growing eigenvalues of the full model.
    fn growing(&self, speed: f64) -> Vec<c64> {
        let all = companion_eigenpairs(&self.system, speed)
            .unwrap()
            .into_iter()
            .map(|(lambda, _)| lambda);
        // Smaller growth may be rounding of zero divided by damping, or its root.
        all.filter(|lambda| lambda.re > 1e-3).collect()
    }
}

fn told(range: SpeedRange) -> String {
    let [from, to] = range.ends().map(rpm);
    format!("{from} to {to} rpm")
}

/// The bands of a longer range within a shorter one: kind, edges, and whether the band is complete.
fn cut(bands: &[Instability], range: SpeedRange) -> Vec<(InstabilityKind, f64, f64, bool)> {
    let part = |b: &Instability| {
        let part = b.range().within(range);
        let [begin, end] = part.ends();
        (b.kind, begin, end, part == b.range() && b.closed)
    };
    let mut parts: Vec<_> = bands.iter().map(part).collect();
    parts.retain(|(_, from, to, _)| to - from > NARROWEST * to);
    parts.sort_by(|x, y| x.1.total_cmp(&y.1).then(x.2.total_cmp(&y.2)));
    parts
}

fn assert_cut(saw: &Saw, range: SpeedRange, way: Way) {
    let bands = saw.bands_of(range, way);
    let (found, expected) = (cut(&bands, range), cut(&saw.bands, range));
    let lists = || format!("{}, {way:?}:\n{found:?}\n{expected:?}", told(range));
    assert_eq!(found.len(), expected.len(), "{}", lists());
    for (x, y) in found.iter().zip(&expected) {
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < NARROWEST;
        assert!((x.0, x.3) == (y.0, y.3), "{}", lists());
        assert!(near(x.1, y.1) && near(x.2, y.2), "{}", lists());
    }
    for band in &bands {
        assert!(band.range().within(range) == band.range());
        assert!(band.range().contains(band.peak_rad_per_s));
        assert_peak(saw, band, range);
    }
}

/// The largest growth within a band is that of an eigenvalue of the full model, and no eigenvalue of its kind that is
/// covered by this band alone grows faster.
fn assert_peak(saw: &Saw, band: &Instability, range: SpeedRange) {
    let (from, to, peak) = (
        band.from_rad_per_s,
        band.to_rad_per_s,
        band.peak_growth_per_s,
    );
    let diverges = band.kind == InstabilityKind::Divergence;
    let same_kind = |l: &c64| diverges == (l.im.abs() < 1e-6 * l.norm());
    let nearest = saw
        .growing(band.peak_rad_per_s)
        .into_iter()
        .filter(same_kind)
        .map(|l| (l.re - peak).abs())
        .fold(peak, f64::min);
    let what = format!("{} in {}: {nearest}", band, told(range));
    assert!(nearest <= 0.02 * peak + 2e-3, "{what}");
    let alone = |speed: &f64| {
        let covering = saw.bands.iter().filter(|b| {
            let ends = b.from_rad_per_s..=b.to_rad_per_s;
            b.kind == band.kind && ends.contains(speed)
        });
        covering.count() == 1
    };
    let within = evenly_spaced([from, to], 3).into_iter().filter(alone);
    for speed in within {
        let fastest = saw
            .growing(speed)
            .into_iter()
            .filter(same_kind)
            .map(|l| l.re)
            .fold(0.0, f64::max);
        assert!(
            fastest <= 1.02 * peak + 2e-3,
            "{what} {fastest} at {}",
            rpm(speed)
        );
    }
}

/// Ranges that begin and end at events and beside them, each event with each offset.
fn ranges(saw: &Saw) -> Vec<SpeedRange> {
    let events = saw.events();
    let mut ranges = Vec::new();
    for (k, event) in events.iter().enumerate() {
        for (j, offset) in OFFSETS.iter().enumerate() {
            let end = event * (1.0 + offset);
            let other = events[(5 * k + 3 * j) % events.len()] * (1.0 + OFFSETS[(k + j) % 11]);
            let far = (end / other - 1.0).abs() > 1e-3;
            ranges.push(match (j % 3, far) {
                (0, true) => SpeedRange::new(end.min(other), end.max(other)),
                (1, _) => SpeedRange::new(end, saw.top),
                _ => SpeedRange::new(0.0, end),
            });
        }
    }
    ranges
}

/// The paper's saw from rest to a multiple of its first critical speed, with damping in its pad.
fn paper(multiple: f64, damping_n_s_per_m: f64) -> Saw {
    let mut file = Scene::paper().file().clone();
    file.guides[0].damping_n_s_per_m = damping_n_s_per_m;
    let top = multiple * first_critical(&file);
    Saw::new(&file, top)
}

#[test]
fn bands_of_a_range_that_ends_at_an_event_are_those_of_a_longer_one() {
    let saw = paper(1.45, 0.0);
    let ranges = ranges(&saw);
    assert!(ranges.len() > 50, "{}", ranges.len());
    for (k, range) in ranges.iter().enumerate().skip(1).step_by(9) {
        assert_cut(
            &saw,
            *range,
            if k % 2 == 0 { Way::Bands } else { Way::Chart },
        );
    }
}

#[test]
#[ignore = "minutes: run it after a change of the search"]
fn bands_of_every_range_that_ends_at_an_event_are_those_of_a_longer_one() {
    let saw = paper(1.97, 0.0);
    for range in ranges(&saw) {
        assert_cut(&saw, range, Way::Bands);
        assert_cut(&saw, range, Way::Chart);
    }
    check(12, any_saw(), |file| {
        let top = 1.6 * first_critical(&file);
        let saw = Saw::new(&file, top);
        for range in ranges(&saw).into_iter().step_by(5) {
            assert_cut(&saw, range, Way::Bands);
        }
        Ok(())
    });
}

/// The bands of a range, compared with every eigenvalue, up to both ends: the speed that separates two maxima of one
/// range of growth depends on both ends, so that lists may differ.
fn assert_grows(saw: &Saw, range: SpeedRange) {
    let bands = saw.bands_of(range, Way::Chart);
    for band in &bands {
        let (from, to) = (band.from_rad_per_s, band.to_rad_per_s);
        assert!(
            range.from_rad_per_s <= from && to <= range.to_rad_per_s,
            "{band} in {}",
            told(range)
        );
        let ends = [from == range.from_rad_per_s, to == range.to_rad_per_s];
        assert!(
            band.closed || ends.contains(&true),
            "{band} in {}",
            told(range)
        );
    }
    let mut speeds = evenly_spaced(range.ends(), 6);
    speeds.extend([
        range.from_rad_per_s * (1.0 + 1e-9),
        range.to_rad_per_s * (1.0 - 1e-9),
    ]);
    let events = saw.events();
    let is_clear = |s: &f64| events.iter().all(|event| (event / s - 1.0).abs() > 1e-5);
    speeds.retain(|s| range.from_rad_per_s < *s && *s < range.to_rad_per_s && is_clear(s));
    for speed in speeds {
        let all: Vec<c64> = companion_eigenpairs(&saw.system, speed)
            .unwrap()
            .into_iter()
            .map(|(lambda, _)| lambda)
            .collect();
        let held = holds(&bands, &all, speed);
        assert!(held.is_ok(), "{}: {}", told(range), held.unwrap_err());
    }
}

#[test]
fn stretches_of_growth_of_a_damped_saw_reach_to_the_end_of_a_range() {
    let saw = paper(1.1, 5.0);
    let ranges = ranges(&saw);
    for range in ranges.iter().skip(2).step_by(16) {
        assert_grows(&saw, *range);
    }
}

#[test]
#[ignore = "minutes: run it after a change of the search"]
fn stretches_of_growth_of_a_damped_saw_reach_to_the_end_of_every_range() {
    let saw = paper(1.97, 5.0);
    for range in ranges(&saw) {
        assert_grows(&saw, range);
    }
}
