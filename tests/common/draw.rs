//! Valid and absurd scenes from bytes, for the fuzzers: the tests pass random bytes, and `fuzz/` those of libFuzzer.

use sawflutter::analyses::campbell::Report;
use sawflutter::analyses::washboard::{WashboardReport, washboard};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{
    Accuracy, CutFile, DampingFile, ExcitationFile, GuideFile, InPlane, Mount, RimFile, Scene,
    SceneFile, SpeedRange, SweepFile, ThicknessRow, WashboardingFile, WoodFile, rad_per_s,
};
use sawflutter::modes::{SpectralModel, Strategy};
use sawflutter::stability::{Analysis, chart};

/// Reads numbers from bytes, and zeros after the last byte.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    fn next(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().unwrap_or((&0, &[]));
        self.0 = rest;
        *first
    }

    /// A number between 0 and 1.
    fn unit(&mut self) -> f64 {
        f64::from(u16::from_le_bytes([self.next(), self.next()])) / 65535.0
    }

    fn one_in(&mut self, count: u8) -> bool {
        self.next().is_multiple_of(count)
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + self.unit() * (high - low)
    }

    /// A number around a usual value, sometimes many orders of magnitude away from it or not a number.
    fn near(&mut self, value: f64) -> f64 {
        if self.one_in(40) {
            let absurd = [
                0.0,
                -value,
                f64::NAN,
                f64::INFINITY,
                1e300,
                5e-324,
                1e-12,
                1e15,
            ];
            return absurd[usize::from(self.next()) % absurd.len()];
        }
        let decades = if self.one_in(6) { 8.0 } else { 0.7 };
        value * 10_f64.powf(self.between(-decades, decades))
    }
}

fn guide(bytes: &mut Bytes<'_>, outer_m: f64) -> GuideFile {
    let point = bytes.one_in(5);
    let side = |bytes: &mut Bytes<'_>| {
        if point {
            0.0
        } else {
            bytes.near(0.3 * outer_m)
        }
    };
    GuideFile {
        radius_m: bytes.between(0.0, 1.1) * outer_m,
        angle_deg: bytes.between(-400.0, 400.0),
        radial_length_m: side(bytes),
        tangential_length_m: side(bytes),
        stiffness_n_per_m: bytes.near(1e6),
        damping_n_s_per_m: if bytes.one_in(6) {
            bytes.near(10.0)
        } else {
            0.0
        },
        ..GuideFile::default()
    }
}

/// A scene. Most are valid, some almost.
pub fn scene_file(bytes: &mut Bytes<'_>) -> SceneFile {
    let mut file = Scene::paper().file().clone();
    file.measured = None;
    // Removes the blocks of the paper's own blade.
    (file.spline, file.cut, file.runup, file.probe) = (None, None, None, None);
    file.guides.clear();
    file.accuracy = Accuracy::Draft;
    let outer = bytes.near(0.5);
    let inner = outer * bytes.between(0.0, 1.02);
    let blade = &mut file.blade;
    blade.outer_diameter_m = outer;
    blade.inner_diameter_m = inner;
    blade.thickness_m = (outer - inner) * 10_f64.powf(bytes.between(-5.0, 0.0));
    blade.material.youngs_modulus_pa = bytes.near(2e11);
    blade.material.density_kg_per_m3 = bytes.near(7800.0);
    blade.material.poisson_ratio = bytes.between(-1.0, 0.5);
    if bytes.one_in(3) {
        file.mount = Mount::Collar {
            diameter_m: inner + bytes.between(0.0, 1.0) * (outer - inner),
            in_plane: if bytes.one_in(2) {
                InPlane::Fixed
            } else {
                InPlane::Free
            },
            clamp_stiffness_n_m_per_rad_per_m: None,
        };
    }
    for _ in 0..bytes.next() % 4 {
        let pad = guide(bytes, 0.5 * outer);
        file.guides.push(pad);
    }
    if bytes.one_in(5) {
        file.damping = Some(DampingFile {
            material_retardation_time_s: bytes.near(1e-6),
            air_n_s_per_m3: bytes.near(1.0),
            air_rotation_share: 0.0,
            ..DampingFile::default()
        });
    }
    file.sweep = bytes.one_in(3).then(|| SweepFile {
        from_rpm: if bytes.one_in(2) {
            0.0
        } else {
            bytes.near(100.0)
        },
        to_rpm: bytes.near(2000.0),
    });
    file.operating_rpm = bytes.one_in(2).then(|| bytes.near(1000.0));
    file.flutter_threshold_per_s = bytes.near(0.25);
    file
}

/// Adds steps, teeth, gaps, rotating air, a cut and lines of excitation to a scene.
pub fn with_details(bytes: &mut Bytes<'_>, mut file: SceneFile) -> SceneFile {
    blade_details(bytes, &mut file);
    if bytes.one_in(2) {
        let outer_m = 0.5 * file.blade.outer_diameter_m;
        file.cut = Some(cut(bytes, outer_m));
    }
    if bytes.one_in(4) {
        file.excitation = Some(ExcitationFile {
            orders: u32::from(bytes.next() % 5),
            tooth_passing: u32::from(bytes.next() % 3),
        });
    }
    file
}

/// Adds steps, tapers, heavy teeth, gaps and rotating air.
fn blade_details(bytes: &mut Bytes<'_>, file: &mut SceneFile) {
    let blade = &mut file.blade;
    let (inner, outer) = (0.5 * blade.inner_diameter_m, 0.5 * blade.outer_diameter_m);
    if bytes.one_in(3) {
        let mut radius_m = inner;
        for _ in 0..1 + bytes.next() % 3 {
            if !bytes.one_in(3) {
                radius_m += bytes.between(0.0, 0.5) * (outer - inner);
            }
            blade.profile.push(ThicknessRow {
                radius_m,
                thickness_m: blade.thickness_m * bytes.between(0.1, 2.0),
            });
        }
    }
    if bytes.one_in(4) {
        let radius_m = inner + bytes.between(0.0, 1.0) * (outer - inner);
        blade.rim = Some(RimFile {
            mass_per_tooth_kg: bytes.near(1e-3),
            radius_m: (!bytes.one_in(2)).then_some(radius_m),
        });
    }
    for guide in &mut file.guides {
        guide.gap_m = bytes.one_in(3).then(|| bytes.near(1e-4));
    }
    if let Some(damping) = &mut file.damping {
        damping.air_rotation_share = bytes.between(0.0, 1.0);
    }
}

/// Forces, wood and washboarding, included in the chart or not.
fn cut(bytes: &mut Bytes<'_>, outer_m: f64) -> CutFile {
    CutFile {
        angle_deg: bytes.between(-400.0, 400.0),
        teeth_in_cut: Some(1 + u32::from(bytes.next() % 6)),
        tangential_n_per_tooth: Some(bytes.near(10.0)),
        radial_n_per_tooth: Some(bytes.near(1.0)),
        feed_m_per_s: bytes.one_in(2).then(|| bytes.near(0.5)),
        chart_rpm: bytes.one_in(2).then(|| bytes.near(1000.0)),
        wood: bytes.one_in(2).then(|| WoodFile {
            stiffness_n_per_m: bytes.near(1e4),
            damping_n_s_per_m: if bytes.one_in(2) {
                bytes.near(1.0)
            } else {
                0.0
            },
            depth_m: bytes.between(0.0, 0.3) * outer_m,
            arc_deg: bytes.one_in(2).then(|| bytes.between(0.0, 370.0)),
        }),
        washboarding: bytes.one_in(2).then(|| washboarding(bytes)),
        ..CutFile::default()
    }
}

/// Washboarding of even teeth, or of pitches that usually do not fit the teeth.
pub fn washboarding(bytes: &mut Bytes<'_>) -> WashboardingFile {
    WashboardingFile {
        stiffness_n_per_m: bytes.near(1e4),
        overlap: bytes.between(0.0, 1.05),
        arc_deg: bytes.one_in(2).then(|| bytes.between(0.0, 370.0)),
        pitches_deg: if bytes.one_in(6) {
            vec![bytes.near(8.0), bytes.near(8.0)]
        } else {
            Vec::new()
        },
    }
}

/// A basis so small that thousands of scenes can be computed.
const SMALL: Resolution = Resolution {
    max_diameters: 3,
    radial_functions: 3,
};

/// Critical speeds, and all modes below and above the lowest. The result is finite or an error.
pub fn survives_two_speeds(scene: &Scene) {
    let plate = Plate::new(scene, SMALL);
    let Ok(critical) = SpectralModel::critical_speeds(&plate) else {
        return;
    };
    let mut speeds = critical.iter().map(|c| c.speed_rad_per_s);
    assert!(speeds.clone().all(|speed| speed.is_finite() && speed > 0.0));
    let lowest = speeds.next().unwrap_or(rad_per_s(1000.0));
    let Ok(model) = SpectralModel::new(plate, SpeedRange::new(0.0, lowest), Strategy::Dense) else {
        return;
    };
    for speed in [0.0, 0.7 * lowest, 1.4 * lowest] {
        let modes = model.all_modes(speed).unwrap_or_default();
        for described in model.describe(speed, modes) {
            let lambda = described.mode.lambda;
            assert!(lambda.is_finite(), "{lambda}");
            assert!(described.backward_error.is_finite());
            assert!(described.shape.is_all_finite());
        }
    }
}

/// Bands over the lowest three critical speeds.
pub fn survives_chart(scene: &Scene) {
    let plate = Plate::new(scene, SMALL);
    let Ok(critical) = SpectralModel::critical_speeds(&plate) else {
        return;
    };
    let mut speeds = critical.iter().take(3).map(|c| 1.1 * c.speed_rad_per_s);
    let top = speeds.next_back().unwrap_or(rad_per_s(1000.0));
    let Ok(model) = SpectralModel::new(plate, SpeedRange::new(0.0, top), Strategy::Dense) else {
        return;
    };
    let Ok(chart) = chart(&model, SpeedRange::new(0.0, top), 5, &|_, _| ()) else {
        return;
    };
    for band in &chart.instabilities {
        let numbers = [
            band.from_rad_per_s,
            band.to_rad_per_s,
            band.peak_rad_per_s,
            band.peak_growth_per_s,
            band.frequency_rad_per_s,
        ];
        assert!(
            numbers.iter().all(|x| x.is_finite()) && band.from_rad_per_s <= band.to_rad_per_s,
            "{band:?}"
        );
    }
}

/// Computes everything that `sawflutter analyze` does. JSON has no NaN: it would be written as null, which no number of
/// a report may be.
pub fn survives_analysis(scene: &Scene) -> bool {
    let Ok(analysis) = Analysis::new(scene) else {
        return false;
    };
    let report = analysis.report();
    let json = serde_json::to_string(&report).expect("a report is JSON");
    let read: Report =
        serde_json::from_str(&json).unwrap_or_else(|error| panic!("{error}: {json}"));
    assert!(read == report);
    let csv = String::from_utf8(report.campbell_csv().expect("CSV")).expect("UTF-8");
    assert!(!csv.contains("NaN") && !csv.contains("inf"), "{csv}");
    true
}

/// Computes everything that `sawflutter washboard` does. The result is false if the scene is refused.
pub fn survives_washboard(scene: &Scene) -> bool {
    let rpm = scene.file().operating_rpm;
    let run = scene.cut().zip(rpm).map(|(cut, rpm)| cut.at_rpm(rpm));
    let Some(Ok(run)) = run else {
        return false;
    };
    let Ok(report) = washboard(scene, &run, &|_, _| ()) else {
        return false;
    };
    let json = serde_json::to_string(&report).expect("a report is JSON");
    let read: WashboardReport =
        serde_json::from_str(&json).unwrap_or_else(|error| panic!("{error}: {json}"));
    assert!(read == report);
    true
}
