//! Goal: critical speeds and bands are named by the waves that make them. A very soft guide makes bands where the waves
//! of the blade without guides cross, and they have the names of these waves.

use sawflutter::analyses::campbell::{BranchCurve, InstabilityKind, Report};
use sawflutter::model::plate::{Plate, Resolution};
use sawflutter::model::scene::{Accuracy, Scene};
use sawflutter::modes::{Direction, SpectralModel};
use sawflutter::stability::Analysis;

fn with_pad(stiffness_n_per_m: Option<f64>) -> Report {
    let saw = Scene::paper().edited(|saw| {
        saw.accuracy = Accuracy::Draft;
        match stiffness_n_per_m {
            Some(stiffness) => saw.guides[0].stiffness_n_per_m = stiffness,
            None => saw.guides.clear(),
        }
    });
    Analysis::new(&saw.unwrap()).unwrap().report()
}

/// Frequency and Krein sign of a branch at a speed between two of its own.
fn at(branch: &BranchCurve, rpm: f64) -> Option<(f64, i8)> {
    let after = branch.rpm.partition_point(|r| *r < rpm);
    let before = after.checked_sub(1)?;
    let end = *branch.rpm.get(after)?;
    let share = (rpm - branch.rpm[before]) / (end - branch.rpm[before]);
    let hz = [before, after].map(|k| branch.frequency_hz[k]);
    let sign = branch.krein_sign[before];
    (sign == branch.krein_sign[after]).then(|| (hz[0] + share * (hz[1] - hz[0]), sign))
}

fn named(branch: &BranchCurve, sign: i8) -> String {
    let direction = match branch.direction[branch.direction.len() / 2] {
        _ if sign < 0 => "reflected",
        Direction::Forward => "forward",
        _ => "backward",
    };
    let circles = match branch.nodal_circles {
        0 => String::new(),
        1 => ", 1 circle".to_owned(),
        more => format!(", {more} circles"),
    };
    match branch.nodal_diameters {
        0 => format!("0 diameters{circles}"),
        1 => format!("1 diameter{circles}, {direction}"),
        n => format!("{n} diameters{circles}, {direction}"),
    }
}

#[test]
fn events_of_a_weak_pad_have_the_names_of_free_waves() {
    let (free, weak) = (with_pad(None), with_pad(Some(3e4)));
    let mut checked = 0;
    for band in &weak.instabilities {
        let crossing: Vec<(f64, String)> = match band.kind {
            InstabilityKind::Divergence => {
                let of = |c: &sawflutter::analyses::campbell::CriticalSpeed| {
                    (c.rpm - band.peak_rpm).abs()
                };
                let near = free
                    .critical_speeds
                    .iter()
                    .min_by(|x, y| of(x).total_cmp(&of(y)));
                let name = format!("{} diameters", near.unwrap().nodal_diameters);
                vec![(0.0, name)]
            }
            InstabilityKind::Flutter => {
                let branches = free.campbell.branches.iter();
                let mut here: Vec<(f64, i8, String)> = branches
                    .filter_map(|b| Some((b, at(b, band.peak_rpm)?)))
                    .map(|(b, (hz, sign))| ((hz - band.frequency_hz).abs(), sign, named(b, sign)))
                    .collect();
                here.sort_by(|x, y| x.0.total_cmp(&y.0));
                let of = |wanted: i8| here.iter().find(|(_, sign, _)| *sign == wanted).unwrap();
                [of(-1), of(1)]
                    .map(|(off, _, name)| (*off, name.clone()))
                    .to_vec()
            }
        };
        // A motion of the rigid blade on the pad is not a wave of the blade without it.
        if crossing.iter().any(|(off, _)| *off > 0.1) {
            continue;
        }
        let expected: Vec<String> = crossing.into_iter().map(|(_, name)| name).collect();
        println!(
            "{:.1} rpm, {:.2} Hz: {:?} {expected:?}",
            band.peak_rpm, band.frequency_hz, band.name
        );
        assert_eq!(band.modes, expected, "{band:?}");
        checked += 1;
    }
    assert!(checked >= 6, "{checked}");
    for critical in &weak.critical_speeds {
        let of = |c: &sawflutter::analyses::campbell::CriticalSpeed| (c.rpm - critical.rpm).abs();
        let near = free
            .critical_speeds
            .iter()
            .min_by(|x, y| of(x).total_cmp(&of(y)));
        let expected = near.unwrap().nodal_diameters;
        assert_eq!(critical.nodal_diameters, expected, "{critical:?}");
        assert_eq!(critical.name, format!("{expected} diameters"));
    }
}

/// Rotation stiffens waves of zero or one nodal diameter more than it softens them.
#[test]
fn no_critical_speed_is_named_by_none_or_one_diameter() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/gallery");
    let mut speeds = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let saw = Scene::from_json(&text).unwrap();
        let resolution = Resolution {
            max_diameters: 6,
            radial_functions: 4,
        };
        let critical = SpectralModel::critical_speeds(&Plate::new(&saw, resolution)).unwrap();
        for critical in &critical {
            let waves = &critical.name.waves;
            assert_eq!(waves.len(), 1);
            let least = waves[0].shares.iter().map(|wave| wave.diameters).min();
            assert!(least >= Some(2), "{}: {critical:?}", path.display());
            speeds += 1;
        }
    }
    assert!(speeds > 100, "{speeds}");
}
