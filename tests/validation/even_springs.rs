//! Goal: the verdict on a blade between equal, evenly spaced springs follows Chen's rules, band by
//! band, with the growth of first-order theory and the eigenvalues of the exact equation.
//!
//! Source: `sawflutter::model::analytical::wave_coupling` and `point_springs`. The 400 mm blade between collars is swept past
//! several critical speeds, with springs so weak that its bands lie apart and first order is valid. The program
//! computes the unguided waves, one radial eigenproblem for each n; the test computes where they cross and what the
//! springs do there.

use nalgebra::{DMatrix, DVector, SymmetricEigen};
use sawflutter::model::analytical::point_springs::{BodyWave, EvenSprings};
use sawflutter::model::analytical::wave_coupling::{Meeting, SpaceWave};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{GuideFile, Scene, SpeedRange};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::modes::{SpectralModel, Strategy, companion_eigenpairs};
use sawflutter::stability::{Instability, InstabilityKind, undamped_bands};

use super::saws::collar;
use crate::common::{Worst, relative_error};

const RADIUS_M: f64 = 0.18;
const RESOLUTION: Resolution = Resolution {
    max_diameters: 6,
    radial_functions: 5,
};

fn blade_on(springs: EvenSprings) -> Scene {
    let spring = |k: usize| GuideFile {
        radius_m: RADIUS_M,
        angle_deg: 17.0 + 360.0 * k as f64 / springs.count as f64,
        radial_length_m: 0.0,
        tangential_length_m: 0.0,
        stiffness_n_per_m: springs.stiffness_n_per_m,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    };
    let scene = collar().edited(|file| {
        file.sweep = None;
        file.guides = (0..springs.count).map(spring).collect();
    });
    scene.unwrap()
}

/// The waves of one n of the unguided blade at a speed, by frequency on the blade.
fn waves_of(plate: &Plate, n: usize, speed: f64) -> Vec<BodyWave> {
    let block = &plate.harmonics[n];
    let size = block.bending.nrows();
    let inertia = DMatrix::identity(size, size) * (n * n) as f64;
    let eigen = SymmetricEigen::new(&block.bending + (&block.spin + inertia) * (speed * speed));
    let functions = plate.functions_at(RADIUS_M, 0.0);
    let values = DVector::from_row_slice(&functions[plate.offset(n)..plate.offset(n) + size]);
    let mut waves: Vec<BodyWave> = (0..size)
        .map(|k| BodyWave {
            nodal_diameters: n,
            frequency_rad_per_s: eigen.eigenvalues[k].sqrt(),
            amplitude_per_sqrt_kg: eigen.eigenvectors.column(k).dot(&values),
        })
        .collect();
    waves.sort_by(|x, y| x.frequency_rad_per_s.total_cmp(&y.frequency_rad_per_s));
    waves
}

fn all_waves(plate: &Plate, speed: f64) -> Vec<BodyWave> {
    let waves = (0..=plate.max_diameters()).flat_map(|n| waves_of(plate, n, speed));
    waves.collect()
}

/// One of the two waves of a mode in the fixed frame; `circle` counts the modes of one n.
#[derive(Debug, Clone, Copy)]
struct Seen {
    circle: usize,
    diameters: usize,
    wave: SpaceWave,
}

impl Seen {
    fn body(&self, plate: &Plate, speed: f64) -> BodyWave {
        waves_of(plate, self.diameters, speed)[self.circle]
    }

    /// ω = pΩ + ω_b, or nΩ − ω_b for a reflected wave.
    fn frequency(&self, plate: &Plate, speed: f64) -> f64 {
        let on_blade = self.body(plate, speed).frequency_rad_per_s;
        let carried = self.wave.wave_number as f64 * speed;
        let sign = if self.wave.reflected { -1.0 } else { 1.0 };
        carried + sign * on_blade
    }
}

/// Two waves of the unguided blade whose frequencies in space are equal at a speed.
#[derive(Debug, Clone, Copy)]
struct Met {
    pair: [Seen; 2],
    speed: f64,
}

/// Every crossing of two waves below a speed, for the lowest two modes of each n.
fn meetings(plate: &Plate, top: f64) -> Vec<Met> {
    let mut seen = Vec::new();
    for diameters in 0..=plate.max_diameters() {
        for circle in 0..2 {
            let mut kinds = vec![SpaceWave::forward(diameters)];
            if diameters > 0 {
                kinds.push(SpaceWave::backward(diameters));
                kinds.push(SpaceWave::reflected(diameters));
            }
            seen.extend(kinds.into_iter().map(|wave| Seen {
                circle,
                diameters,
                wave,
            }));
        }
    }
    let mut met = Vec::new();
    for (k, first) in seen.iter().enumerate() {
        for second in &seen[..k] {
            met.extend(meetings_of([*first, *second], plate, top));
        }
    }
    met
}

fn meetings_of(pair: [Seen; 2], plate: &Plate, top: f64) -> Vec<Met> {
    let gap = |speed: f64| pair[0].frequency(plate, speed) - pair[1].frequency(plate, speed);
    let steps = 40;
    let at = |k: usize| top * k as f64 / steps as f64;
    let changes = (0..steps).filter(|k| gap(at(*k)) * gap(at(k + 1)) < 0.0);
    let speeds = changes.map(|k| {
        let (mut low, mut high) = (at(k), at(k + 1));
        let rises = gap(low) < 0.0;
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            if (gap(middle) < 0.0) == rises {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    });
    // Both waves exist: a backward one below its critical speed, a reflected one above it.
    let there = |speed: &f64| pair.iter().all(|s| s.frequency(plate, *speed) > 1.0);
    speeds
        .filter(there)
        .map(|speed| Met { pair, speed })
        .collect()
}

impl Met {
    fn what(&self, springs: EvenSprings) -> Meeting {
        springs.meeting(self.pair[0].wave, self.pair[1].wave)
    }

    /// Speed of the crossing on springs, to first order.
    fn shifted(&self, plate: &Plate, springs: EvenSprings) -> f64 {
        let shift = |s: &Seen| {
            springs.frequency_shift_rad_per_s(s.body(plate, self.speed), s.wave.reflected)
        };
        let [first, second] = &self.pair;
        let gap = |speed: f64| first.frequency(plate, speed) - second.frequency(plate, speed);
        let step = 1e-4 * self.speed;
        let slope = (gap(self.speed + step) - gap(self.speed - step)) / (2.0 * step);
        self.speed - (shift(first) - shift(second)) / slope
    }

    fn coupling_per_s(&self, plate: &Plate, springs: EvenSprings) -> f64 {
        let [first, second] = self.pair.map(|s| s.body(plate, self.speed));
        springs.coupling_per_s(first, second)
    }
}

/// Distance of a band's largest growth from the exact equation of a class, relative to the growth
/// and to the frequency of the blade's first mode.
fn off_the_exact_equation(
    plate: &Plate,
    springs: EvenSprings,
    class: i64,
    band: &Instability,
) -> [f64; 2] {
    let waves = all_waves(plate, band.peak_rad_per_s);
    let start = [band.peak_growth_per_s, band.frequency_rad_per_s];
    let growth = match springs.eigenvalue_near(class, &waves, band.peak_rad_per_s, start) {
        Some([growth, _]) => growth,
        None => f64::NAN,
    };
    let error = (band.peak_growth_per_s - growth).abs();
    [error / growth, error / waves[0].frequency_rad_per_s]
}

/// Flutter and divergence of the blade on springs up to a speed.
fn bands_of(springs: EvenSprings, top: f64, strategy: Strategy) -> [Vec<Instability>; 2] {
    let plate = Plate::new(&blade_on(springs), RESOLUTION);
    let model = SpectralModel::new(plate, SpeedRange::new(0.0, top), strategy).unwrap();
    let found = undamped_bands(&model, SpeedRange::new(0.0, top), 41).unwrap();
    let (bands, certificate) = (found.instabilities, found.certificate);
    assert_eq!(certificate.violations_rad_per_s, Vec::<f64>::new());
    let (flutter, divergence) = bands
        .into_iter()
        .partition(|band| band.kind == InstabilityKind::Flutter);
    [flutter, divergence]
}

/// The unguided blade, the highest speed, and S springs with 300 N/m in total.
fn cases() -> (Plate, f64, [EvenSprings; 5]) {
    let unguided = collar().edited(|file| file.guides.clear()).unwrap();
    let free = Plate::new(&unguided, RESOLUTION);
    let critical = SpectralModel::critical_speeds(&free).unwrap();
    let springs = [1, 2, 3, 4, 5].map(|count| EvenSprings {
        count,
        stiffness_n_per_m: 300.0 / count as f64,
    });
    (free, 1.5 * critical[0].speed_rad_per_s, springs)
}

/// The comparison of the bands.
#[derive(Default)]
struct Compared {
    /// Growth, relative to the first-order value.
    first_order: Worst,
    /// Growth, relative to the value of the exact equation.
    exact: Worst,
    /// Difference from the exact equation, relative to the first frequency of the blade.
    of_frequency: Worst,
    /// Crossings of a reflected wave with one that is not coupled to it.
    crossed: usize,
}

impl Compared {
    fn add_band(
        &mut self,
        free: &Plate,
        springs: EvenSprings,
        class: i64,
        (band, first_order): (&Instability, f64),
    ) {
        let place = || {
            format!(
                "{} springs, {:?} at {}",
                springs.count, band.kind, band.peak_rad_per_s
            )
        };
        let [exact, of_frequency] = off_the_exact_equation(free, springs, class, band);
        let first_order = relative_error(band.peak_growth_per_s, first_order);
        self.first_order.add(first_order, place);
        self.exact.add(exact, place);
        self.of_frequency.add(of_frequency, place);
    }

    /// There are as many bands as pairs of coalescing waves, each around their crossing.
    fn add_flutter(
        &mut self,
        free: &Plate,
        springs: EvenSprings,
        met: &[Met],
        bands: &[Instability],
    ) {
        let what = |met: &&Met| met.what(springs);
        let reflected = |met: &&Met| met.pair.iter().any(|s| s.wave.reflected);
        let crossing = met.iter().filter(|m| what(m) == Meeting::Crossing);
        self.crossed += crossing.filter(reflected).count();
        let mut coalescing: Vec<&Met> = met.iter().collect();
        coalescing.retain(|m| what(m) == Meeting::Coalescence);
        coalescing.sort_by(|x, y| x.speed.total_cmp(&y.speed));
        assert_eq!(bands.len(), coalescing.len(), "{} springs", springs.count);
        for (band, met) in bands.iter().zip(coalescing) {
            let speed = met.shifted(free, springs);
            assert!(
                band.from_rad_per_s < speed && speed < band.to_rad_per_s,
                "{springs:?} {met:?}"
            );
            let growth = met.coupling_per_s(free, springs);
            let class = met.pair[0].wave.wave_number;
            self.add_band(free, springs, class, (band, growth));
        }
    }

    /// There are as many bands as critical speeds that the springs split.
    fn add_divergence(
        &mut self,
        free: &Plate,
        springs: EvenSprings,
        critical: &[(usize, f64)],
        bands: &[Instability],
    ) {
        let split: Vec<_> = critical
            .iter()
            .filter(|(n, _)| springs.diverges(*n))
            .collect();
        assert_eq!(bands.len(), split.len(), "{} springs", springs.count);
        for (band, &&(n, speed)) in bands.iter().zip(&split) {
            // The wave with its nodes at the springs does not move them.
            let edge = relative_error(band.from_rad_per_s, speed);
            assert!(edge < 1e-9, "{springs:?}, {n} diameters: {edge:e}");
            let wave = waves_of(free, n, speed)[0];
            let growth = springs.coupling_per_s(wave, wave);
            self.add_band(free, springs, n as i64, (band, growth));
        }
    }
}

/// Bands of the blade on springs, compared with those that Chen's rules predict from its unguided waves.
fn compared(strategy: Strategy) -> Compared {
    let (free, top, cases) = cases();
    let mut critical: Vec<(usize, f64)> = SpectralModel::critical_speeds(&free)
        .unwrap()
        .iter()
        .map(|c| (c.name.diameters(), c.speed_rad_per_s))
        .filter(|(_, speed)| *speed < top)
        .collect();
    // The list has each speed for both waves.
    critical.dedup_by_key(|(n, _)| *n);
    let met = meetings(&free, top);
    let mut compared = Compared::default();
    for springs in cases {
        let [flutter, divergence] = bands_of(springs, top, strategy);
        compared.add_flutter(&free, springs, &met, &flutter);
        compared.add_divergence(&free, springs, &critical, &divergence);
    }
    assert!(compared.exact.count > 30 && compared.crossed > 20);
    compared
}

/// The model has few modes, as in a chart. Growth is a small difference of large numbers: it is as accurate as the
/// frequencies of the reduced model, 1e-6.
#[test]
fn verdicts_between_evenly_spaced_springs_follow_chens_rules() {
    let compared = compared(Strategy::Reduced);
    let Compared {
        first_order,
        of_frequency,
        ..
    } = &compared;
    first_order.assert_at_most("growth, against first order", 2e-2);
    of_frequency.assert_at_most("growth over frequency, against the exact equation", 1e-6);
}

#[test]
fn on_the_full_model_growth_is_that_of_the_exact_equation() {
    let compared = compared(Strategy::Dense);
    let exact = &compared.exact;
    exact.assert_at_most("growth, against the exact equation", 1e-7);
}

/// Coupled waves of one sign stay apart by twice their coupling and have no band; the test above counts the bands.
#[test]
fn coupled_waves_of_one_sign_veer_as_far_as_first_order_says() {
    let (free, top, cases) = cases();
    let met = meetings(&free, top);
    let mut worst = Worst::default();
    for springs in cases {
        let system = GyroscopicSystem::of_plate(&Plate::new(&blade_on(springs), RESOLUTION));
        for met in met.iter().filter(|m| m.what(springs) == Meeting::Veering) {
            let speed = met.shifted(&free, springs);
            let [first, second] = met.pair;
            let middle = 0.5 * (first.frequency(&free, speed) + second.frequency(&free, speed));
            let expected = 2.0 * met.coupling_per_s(&free, springs);
            let pairs = companion_eigenpairs(&system, speed).unwrap();
            let mut near: Vec<f64> = pairs.iter().map(|(l, _)| l.im - middle).collect();
            near.sort_by(|x, y| x.abs().total_cmp(&y.abs()));
            // First order is not accurate near a third wave, or where two circles weaken the coupling to the second
            // order of other waves.
            if near[2].abs() < 20.0 * expected || expected < 0.1 {
                continue;
            }
            worst.add(relative_error((near[0] - near[1]).abs(), expected), || {
                format!("{} springs, {met:?}", springs.count)
            });
        }
    }
    assert!(worst.count > 20, "{}", worst.count);
    worst.assert_at_most("distance of veering waves", 2e-2);
}
