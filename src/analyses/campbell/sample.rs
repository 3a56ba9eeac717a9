//! Synthetic reports for tests. The frequencies ω of their waves on the blade are those of ω² = ω₀² + sΩ², with the
//! rotation speed Ω.

use super::{
    BandCertificate, BasisAccuracy, BranchCurve, CampbellDiagram, CriticalSpeed, Direction,
    InstabilityBand, InstabilityKind, Report, RootLoci, RootPath, SolveCounts,
};
use crate::analyses::verdict::Verdict;
use crate::model::scene::{
    Accuracy, BladeFile, GuideFile, Material, Measured, MeasuredRow, Mount, SceneFile,
};

/// A report of a blade of 864 mm without results.
pub fn empty_report(name: &str) -> Report {
    let material = Material {
        youngs_modulus_pa: 210e9,
        poisson_ratio: 0.3,
        density_kg_per_m3: 7850.0,
    };
    let scene = SceneFile {
        schema: None,
        friction: None,
        name: name.to_owned(),
        notes: Vec::new(),
        blade: BladeFile {
            outer_diameter_m: 0.864,
            inner_diameter_m: 0.15,
            thickness_m: 0.0023,
            profile: Vec::new(),
            rim: None,
            slots: None,
            wave_factors: Vec::new(),
            teeth: None,
            material,
        },
        mount: Mount::Spline {},
        guides: Vec::new(),
        damping: None,
        membrane: None,
        spline: None,
        limits: None,
        excitation: None,
        cut: None,
        side_force: None,
        runup: None,
        response: None,
        probe: None,
        operating_rpm: None,
        sweep: None,
        accuracy: Accuracy::Draft,
        tolerance: None,
        flutter_threshold_per_s: 0.25,
        measured: None,
    };
    Report {
        sawflutter: "0".to_owned(),
        scene,
        condition: "idling".to_owned(),
        terms: Vec::new(),
        modes_at_rest: Vec::new(),
        overdamped_modes_at_rest: 0,
        critical_speeds_without_damping: false,
        critical_speeds: Vec::new(),
        instabilities: Vec::new(),
        split_pairs: None,
        first_critical_rpm: None,
        flutter_rpm: None,
        first_merge_rpm: None,
        flutter_threshold_per_s: 0.25,
        verdict: Verdict {
            answer: None,
            rpm: None,
            cause: None,
            reason: "the scene has no operating_rpm".to_owned(),
            allowed_to_rpm: None,
            allowed_by: None,
            windows_rpm: Vec::new(),
            limits: Vec::new(),
            floquet: None,
        },
        operating: None,
        whirl: None,
        shapes: Vec::new(),
        accuracy: BasisAccuracy {
            name: Accuracy::Draft,
            max_diameters: 8,
            complete_to_rpm: 5000.0,
            radial_functions: 4,
            degrees_of_freedom: 68,
            tolerance: 1e-2,
            reached: true,
            estimated_relative_error: None,
            estimated_resting_error: None,
            estimated_drawn_error: None,
        },
        work: SolveCounts::default(),
        certificate: BandCertificate {
            statement: "no speed was checked".to_owned(),
            speeds_checked: 0,
            gave_up: false,
            interpolated: 0,
            krein_violations: 0,
            violating_rpm: Vec::new(),
            full_basis_counts: 0,
            uncertain_counts: 0,
            miscounted_modes: Vec::new(),
            searched_again: false,
            proven_share: None,
            unproven_rpm: Vec::new(),
            unproven_growth_per_s: None,
            unproven_counting_rpm: Vec::new(),
            mismatches: Vec::new(),
            max_backward_error: 0.0,
            max_listed_backward_error: None,
        },
        campbell: CampbellDiagram {
            from_rpm: 0.0,
            to_rpm: 0.0,
            complete_to_hz: 0.0,
            branches: Vec::new(),
        },
        root_loci: None,
        in_cut: None,
        excitation: None,
        membrane: None,
        sensitivities: Vec::new(),
        unusual_numbers: Vec::new(),
        warnings: Vec::new(),
    }
}

/// A branch with a number of nodal diameters, the frequency `rest_hz` at rest, and a backward wave that stands still
/// in space at `critical_rpm`.
fn branch(
    diameters: usize,
    direction: Direction,
    rest_hz: f64,
    critical_rpm: f64,
    rpm: &[f64],
) -> BranchCurve {
    let n = diameters as f64;
    let turns = critical_rpm / 60.0;
    let stiffening = n * n - (rest_hz / turns).powi(2);
    let body = |rpm: &f64| (rest_hz.powi(2) + stiffening * (rpm / 60.0).powi(2)).sqrt();
    let sign = match direction {
        Direction::Forward => 1.0,
        Direction::Standing => 0.0,
        _ => -1.0,
    };
    let seen: Vec<f64> = rpm.iter().map(|r| body(r) + sign * n * r / 60.0).collect();
    BranchCurve {
        branch: 0,
        name: String::new(),
        label: format!("{diameters} {direction:?}").to_lowercase(),
        nodal_diameters: diameters,
        nodal_circles: 0,
        direction: vec![direction; rpm.len()],
        rpm: rpm.to_vec(),
        frequency_hz: seen.iter().map(|hz| hz.abs()).collect(),
        body_frequency_hz: rpm.iter().map(body).collect(),
        growth_per_s: vec![0.0; rpm.len()],
        krein_sign: seen
            .iter()
            .map(|hz| if *hz < 0.0 { -1 } else { 1 })
            .collect(),
        dominant_harmonics: vec![[diameters, 0]; rpm.len()],
    }
}

/// A band between two speeds in rpm, with its largest growth in 1/s and its frequency in Hz.
pub fn band(kind: InstabilityKind, from: f64, to: f64, growth: f64, hz: f64) -> InstabilityBand {
    InstabilityBand {
        kind,
        from_rpm: from,
        to_rpm: to,
        closed: true,
        peak_rpm: (from + to) / 2.0,
        peak_growth_per_s: growth,
        frequency_hz: hz,
        name: None,
        branches: Vec::new(),
        modes: Vec::new(),
        felt_rpm: Vec::new(),
        counted_rpm: vec![[from, to]],
        saturated_amplitude_m: None,
        amplitude_not_computed: None,
        estimated_relative_error: None,
        estimated_relative_growth_error: None,
    }
}

/// A report of a guided blade with branches, bands, critical speeds, an operating speed and measured frequencies.
pub fn busy_report() -> Report {
    let mut report = empty_report("Guided blade, 864 mm");
    report.instabilities = bands();
    let bands = report.instabilities.iter();
    let standing = bands.filter(|band| band.frequency_hz == 0.0);
    let critical = |(i, rpm)| CriticalSpeed {
        rpm,
        branch: None,
        name: String::new(),
        nodal_diameters: 2 + i / 2,
        nodal_circles: 0,
        estimated_relative_error: None,
    };
    let ends = standing.flat_map(|band| [band.from_rpm, band.to_rpm]);
    report.critical_speeds = ends.enumerate().map(critical).collect();
    report.flutter_rpm = Some(2392.0);
    report.campbell = CampbellDiagram {
        from_rpm: 0.0,
        to_rpm: 3000.0,
        complete_to_hz: 160.0,
        branches: branches(&report.instabilities),
    };
    report.certificate.statement = "Krein index matches at 567 of 567 speeds".to_owned();
    report.certificate.speeds_checked = 567;
    report.certificate.max_backward_error = 1.294e-8;
    report.accuracy.estimated_relative_error = Some(0.0014056);
    report.scene.operating_rpm = Some(1800.0);
    report.scene.guides = vec![guide(); 2];
    report.scene.measured = Some(measured());
    report
}

fn bands() -> Vec<InstabilityBand> {
    use InstabilityKind::{Divergence, Flutter};
    vec![
        band(Divergence, 1530.7, 1551.5, 15.0, 0.0),
        band(Flutter, 1902.5, 1905.5, 0.1, 6.0),
        band(Divergence, 2091.0, 2129.6, 22.0, 0.0),
        band(Flutter, 2258.0, 2263.0, 0.5, 4.1),
        band(Flutter, 2392.0, 2404.0, 0.6, 8.0),
        band(Divergence, 2560.3, 2607.5, 30.0, 0.0),
        band(Flutter, 2702.0, 2706.0, 0.4, 6.0),
        band(Flutter, 2847.0, 2849.0, 0.2, 13.0),
        band(Flutter, 2872.0, 2900.0, 2.7, 9.0),
    ]
}

fn branches(bands: &[InstabilityBand]) -> Vec<BranchCurve> {
    use Direction::{Backward, Forward, Standing};
    let rpm: Vec<f64> = (0..=1000).map(|i| 3.0 * f64::from(i)).collect();
    let mut branches = vec![
        branch(1, Backward, 7.68, 9000.0, &rpm),
        branch(1, Forward, 7.9, 9000.0, &rpm),
        branch(0, Standing, 8.3, 9000.0, &rpm),
        branch(2, Backward, 13.14, 1541.0, &rpm),
        branch(2, Forward, 13.9, 1541.0, &rpm),
        branch(3, Backward, 25.56, 2110.0, &rpm),
        branch(3, Forward, 25.7, 2110.0, &rpm),
        branch(4, Backward, 42.83, 2584.0, &rpm),
        branch(4, Forward, 43.0, 2584.0, &rpm),
        branch(1, Standing, 46.0, 9000.0, &rpm),
        branch(5, Backward, 67.0, 3020.0, &rpm),
        branch(5, Forward, 68.0, 3020.0, &rpm),
        branch(6, Backward, 70.5, 3300.0, &rpm),
    ];
    for (diverging, band) in [(3, 0), (5, 2), (7, 5)] {
        let_diverge(&mut branches[diverging], &bands[band]);
    }
    branches
}

/// Makes a branch diverge within a band.
fn let_diverge(branch: &mut BranchCurve, band: &InstabilityBand) {
    let half = (band.to_rpm - band.from_rpm) / 2.0;
    for i in 0..branch.rpm.len() {
        let off = (branch.rpm[i] - band.peak_rpm) / half;
        if off.abs() < 1.0 {
            branch.frequency_hz[i] = 0.0;
            branch.growth_per_s[i] = band.peak_growth_per_s * (1.0 - off * off).sqrt();
            branch.krein_sign[i] = 0;
        }
    }
}

fn guide() -> GuideFile {
    GuideFile {
        radius_m: 0.4,
        angle_deg: 10.0,
        radial_length_m: 0.1,
        tangential_length_m: 0.1,
        stiffness_n_per_m: 1e5,
        damping_n_s_per_m: 0.0,
        ..GuideFile::default()
    }
}

fn measured() -> Measured {
    let rows = [
        (0.0, [9.0, 10.5, 26.0, 43.0]),
        (1000.0, [3.0, 13.5, 26.5, 40.5]),
        (1750.0, [0.0, 4.0, 13.5, 26.0]),
        (2500.0, [9.0, 5.0, 0.0, 5.0]),
    ];
    let row = |(rpm, frequencies): (f64, [f64; 4])| MeasuredRow {
        rpm,
        diameters: None,
        frequencies_hz: frequencies.map(Some).to_vec(),
    };
    Measured {
        source: "read off a published table".to_owned(),
        rows: rows.map(row).to_vec(),
    }
}

/// Two modes of opposite Krein sign that coalesce at about 6 Hz; `drift` is the slope of their mean frequency over the
/// speed, in Hz/rpm.
pub fn root_loci(drift: f64) -> RootLoci {
    let (onset, end, peak) = (2255.6, 2266.52, 0.53);
    let (middle, half) = ((onset + end) / 2.0, (end - onset) / 2.0);
    let inside = |rpm: f64| ((rpm - middle) / half).abs() < 1.0;
    let rpm: Vec<f64> = (0..=42).map(|i| 2240.0 + f64::from(i)).collect();
    let apart = |rpm: f64| {
        let square = ((rpm - middle) / half).powi(2) - 1.0;
        peak * square.abs().sqrt()
    };
    let path = |name: &str, side: f64| {
        // The mode with the higher frequency below the band has the lower frequency above it.
        let turned = |rpm: f64| if rpm < middle { side } else { -side };
        let hz = |&rpm: &f64| {
            let mean = 6.0 + drift * (rpm - middle);
            if inside(rpm) {
                mean
            } else {
                mean + turned(rpm) * apart(rpm) / std::f64::consts::TAU
            }
        };
        let growth = |&rpm: &f64| if inside(rpm) { side * apart(rpm) } else { 0.0 };
        let sign = |&rpm: &f64| if inside(rpm) { 0 } else { side as i8 };
        RootPath {
            name: name.to_owned(),
            growth_per_s: rpm.iter().map(growth).collect(),
            frequency_hz: rpm.iter().map(hz).collect(),
            krein_sign: rpm.iter().map(sign).collect(),
        }
    };
    let paths = vec![
        path("4 diameters, backward", 1.0),
        path("4 diameters, reflected", -1.0),
    ];
    RootLoci {
        onset_rpm: onset,
        end_rpm: end,
        rpm,
        paths,
    }
}
