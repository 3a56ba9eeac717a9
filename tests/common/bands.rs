//! A list of bands, compared with every eigenvalue of the full model.
//!
//! Saws of 250 to 1200 mm on one to four pads or points of 3e4 to 3e8 N/m, spline or collar, over the default sweep. At
//! even speeds and in the middle between neighbouring edges and critical speeds the eigenvalues of the companion
//! matrix, which the search for bands never computes, give the growing modes: their number is that of the bands that
//! cover the speed, they are of the same kind, and none grows faster than the peak of its band.
#![allow(dead_code)]

use faer::{Mat, Scale, c64};
use rayon::prelude::*;
use sawflutter::model::scene::{
    Accuracy, GuideFile, InPlane, Mount, Scene, SceneFile, SpeedRange, rpm,
};
use sawflutter::model::system::GyroscopicSystem;
use sawflutter::stability::{Analysis, Instability, InstabilityKind};

/// Growth that a list of bands has to account for, in 1/s: eigenvalues next to a coalescence are accurate to √ε of the
/// largest frequency of the model only, a few hundredths of 1/s.
const CERTAIN_PER_S: f64 = 0.05;
/// Growth below this may be rounding, in 1/s.
const POSSIBLE_PER_S: f64 = 2e-3;
/// Relative tolerance of a peak: the reduced model is accurate to 1e-6 of a frequency, and growth is a difference of
/// frequencies.
const PEAK_TOLERANCE: f64 = 2e-3;

/// Numbers of a saw, spread by a generator with a period of 2⁶⁴ (Steele, Lea and Flood,
/// OOPSLA 2014), so that saw k is the same on every machine.
struct Draw(u64);

impl Draw {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }

    fn log_between(&mut self, low: f64, high: f64) -> f64 {
        low * (high / low).powf(self.unit())
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.unit() * (count as f64) < 1.0
    }
}

pub fn drawn_saw(index: u64) -> SceneFile {
    let mut draw = Draw(index.wrapping_mul(0x2545_f491_4f6c_dd1d));
    let mut file = Scene::paper().file().clone();
    (file.sweep, file.measured, file.operating_rpm) = (None, None, None);
    (file.spline, file.cut, file.runup, file.probe) = (None, None, None, None);
    file.accuracy = Accuracy::Draft;
    let outer_m = draw.log_between(0.25, 1.2);
    let bore = draw.between(0.1, 0.45);
    file.blade.outer_diameter_m = outer_m;
    file.blade.inner_diameter_m = bore * outer_m;
    file.blade.thickness_m = outer_m * draw.between(0.003, 0.008);
    let mut free_from = bore;
    if draw.one_in(2) {
        free_from = draw.between(bore, 0.5);
        file.mount = Mount::Collar {
            diameter_m: free_from * outer_m,
            in_plane: [InPlane::Fixed, InPlane::Free][usize::from(draw.one_in(2))],
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    }
    let guides = 1 + (4.0 * draw.unit()) as usize;
    file.guides = (0..guides)
        .map(|_| {
            let is_point = draw.one_in(3);
            let mut side = |low: f64, high: f64| {
                if is_point {
                    0.0
                } else {
                    0.5 * outer_m * draw.between(low, high)
                }
            };
            let (radial_length_m, tangential_length_m) = (side(0.02, 0.3), side(0.02, 0.4));
            GuideFile {
                radius_m: 0.5 * outer_m * draw.between(free_from + 0.1, 0.97),
                angle_deg: draw.between(-180.0, 180.0),
                radial_length_m,
                tangential_length_m,
                stiffness_n_per_m: draw.log_between(3e4, 3e8),
                damping_n_s_per_m: 0.0,
                ..GuideFile::default()
            }
        })
        .collect();
    file
}

/// The same saw with the forces of a cut on its chart, no larger than the paper's saw tolerates, and halved until the
/// blade is stable at rest. `None` if the saw is never stable, because its guides leave a rigid motion free.
pub fn drawn_saw_in_cut(index: u64) -> Option<SceneFile> {
    let mut file = drawn_saw(index);
    let mut draw = Draw(index.wrapping_mul(0x9e6c_63d0_876a_68de) ^ 1);
    let (blade, outer_m) = (&file.blade, file.blade.outer_diameter_m);
    let bending_n = blade.material.youngs_modulus_pa * blade.thickness_m.powi(3) / outer_m.powi(2);
    let mut tangential_n = bending_n * draw.log_between(0.02, 0.14);
    let (radial, angle_deg) = (draw.between(-0.1, 0.1), draw.between(-180.0, 180.0));
    let depth_m = outer_m * draw.between(0.05, 0.25);
    for _ in 0..8 {
        let cut = serde_json::json!({
            "angle_deg": angle_deg,
            "depth_m": depth_m,
            "tangential_n_per_tooth": tangential_n,
            "radial_n_per_tooth": radial * tangential_n,
            "chart_rpm": 1000.0,
            "speeds": [{ "rpm": 1000.0 }],
        });
        file.cut = Some(serde_json::from_value(cut).unwrap());
        let scene = Scene::try_from(file.clone()).unwrap();
        if Analysis::new(&scene).is_ok() {
            return Some(file);
        }
        tangential_n *= 0.5;
    }
    None
}

/// Every eigenvalue with Im λ ≥ 0 of the full model, in 1/s.
fn all_eigenvalues(system: &GyroscopicSystem, speed_rad_per_s: f64) -> Vec<c64> {
    let (n, scale) = (system.order(), 2_f64.powi(12));
    let stiffness = Scale(scale.powi(-2)) * system.stiffness_at(speed_rad_per_s);
    let velocity = Scale(1.0 / scale) * system.velocity_at(speed_rad_per_s);
    let companion = Mat::from_fn(2 * n, 2 * n, |i, k| match (i < n, k < n) {
        (true, true) => 0.0,
        (true, false) => f64::from(u8::from(i + n == k)),
        (false, true) => -stiffness[(i - n, k)],
        (false, false) => -velocity[(i - n, k - n)],
    });
    let values = companion
        .eigenvalues()
        .unwrap()
        .into_iter()
        .map(|value: c64| value * scale);
    values.filter(|value| value.im >= 0.0).collect()
}

/// Speeds at which a list is compared with the spectrum.
fn speeds(bands: &[Instability], critical: &[f64], range: SpeedRange) -> Vec<f64> {
    let [from, to] = range.ends();
    let mut marks: Vec<f64> = bands
        .iter()
        .flat_map(|b| [b.from_rad_per_s, b.to_rad_per_s])
        .collect();
    marks.extend(critical);
    marks.extend([from, to]);
    marks.retain(|speed| range.contains(*speed));
    marks.sort_by(f64::total_cmp);
    let middles = marks
        .windows(2)
        .filter(|pair| pair[1] > pair[0] * (1.0 + 1e-6))
        .map(|pair| 0.5 * (pair[0] + pair[1]));
    let even = (1..=20).map(|k| from + (to - from) * (f64::from(k) - 0.5) / 20.0);
    let lowest = critical.first().copied().unwrap_or(0.0);
    let mut speeds: Vec<f64> = even.chain(middles).filter(|s| *s > lowest).collect();
    speeds.retain(|speed| marks.iter().all(|mark| (speed / mark - 1.0).abs() > 1e-7));
    speeds
}

/// The errors of a list of bands at a speed.
fn contradictions(bands: &[Instability], speed: f64, spectrum: &[c64]) -> Vec<String> {
    let mut wrong = Vec::new();
    for kind in [InstabilityKind::Flutter, InstabilityKind::Divergence] {
        let is_kind = |value: &&c64| (value.im > 1e-3) == (kind == InstabilityKind::Flutter);
        let mut growth: Vec<f64> = spectrum.iter().filter(is_kind).map(|v| v.re).collect();
        growth.retain(|growth| *growth > POSSIBLE_PER_S);
        growth.sort_by(|x, y| y.total_cmp(x));
        let covers = |b: &&Instability| b.kind == kind && b.range().contains(speed);
        let mut peaks: Vec<f64> = bands
            .iter()
            .filter(covers)
            .map(|b| b.peak_growth_per_s)
            .collect();
        peaks.sort_by(|x, y| y.total_cmp(x));
        // A range of divergence is one band for any number of real λ in it.
        if kind == InstabilityKind::Divergence {
            growth.truncate(1);
        }
        let certain = growth.iter().filter(|g| **g > CERTAIN_PER_S).count();
        let at_least = peaks.iter().filter(|g| **g > 20.0 * CERTAIN_PER_S).count();
        if certain > peaks.len() || at_least > growth.len() {
            wrong.push(format!(
                "{kind:?} at {:.4} rpm: growth {growth:.3?}, bands with peaks {peaks:.3?}",
                rpm(speed)
            ));
        }
        for (growth, peak) in growth.iter().zip(&peaks) {
            if *growth > peak * (1.0 + PEAK_TOLERANCE) + 2.0 * CERTAIN_PER_S {
                wrong.push(format!(
                    "{kind:?} at {:.4} rpm grows by {growth:.3}, its band by {peak:.3} at most",
                    rpm(speed)
                ));
            }
        }
    }
    wrong
}

/// All errors of the bands of a saw.
pub fn wrong_bands(file: &SceneFile) -> Vec<String> {
    let scene = Scene::try_from(file.clone()).unwrap();
    let analysis = match Analysis::new(&scene) {
        Ok(analysis) => analysis,
        Err(error) => return vec![format!("refused: {error}")],
    };
    let bands = &analysis.chart.instabilities;
    let model = &analysis.model;
    let critical: Vec<f64> = model.critical.iter().map(|c| c.speed_rad_per_s).collect();
    let mut wrong: Vec<String> = speeds(bands, &critical, analysis.range_rad_per_s)
        .into_par_iter()
        .flat_map_iter(|speed| {
            let spectrum = all_eigenvalues(&model.components[0].full, speed);
            contradictions(bands, speed, &spectrum)
        })
        .collect();
    let certificate = &analysis.chart.certificate;
    if !certificate.is_clean() {
        wrong.push(format!("certificate {certificate:?}"));
    }
    wrong
}

pub fn list(file: &SceneFile) -> String {
    let scene = Scene::try_from(file.clone()).unwrap();
    let analysis = Analysis::new(&scene).unwrap();
    let lines = analysis.chart.instabilities.iter().map(|b| {
        format!(
            "    {:?} {:.5}-{:.5} closed {} peak {:.4} at {:.4}, {:.3} rad/s",
            b.kind,
            rpm(b.from_rad_per_s),
            rpm(b.to_rad_per_s),
            b.closed,
            b.peak_growth_per_s,
            rpm(b.peak_rad_per_s),
            b.frequency_rad_per_s
        )
    });
    lines.collect::<Vec<_>>().join("\n")
}
