//! The mean stiffness compared with an integral and with its limits; deflections compared with those of a linear guide.

use std::f64::consts::TAU;

use super::*;
use crate::model::scene::{Accuracy, ContactLaw, FrictionFile, Scene, SideForceFile};
use crate::motion::stretched_blade::{Deviation, PressedBlade};

fn lifting(gap_m: f64) -> Scene {
    let scene = Scene::paper().edited(|file| {
        (file.accuracy, file.operating_rpm) = (Accuracy::Draft, Some(1000.0));
        file.sweep = Some(crate::model::scene::SweepFile {
            from_rpm: 0.0,
            to_rpm: 2000.0,
        });
        let pad = &mut file.guides[0];
        (pad.contact, pad.gap_m) = (ContactLaw::OneSided, Some(gap_m));
    });
    scene.unwrap()
}

/// Independent value: the first Fourier coefficient of the force of a spring behind a gap, summed over a period.
#[test]
fn the_mean_stiffness_is_the_first_harmonic_of_the_force() {
    let count = 200_000;
    for ratio in [0.5, 1.0, 1.001, 1.1, 2.0, 30.0_f64] {
        let force = |k: usize| {
            let sin = (TAU * (k as f64 + 0.5) / count as f64).sin();
            sin * ((ratio * sin - 1.0).max(0.0) - (-ratio * sin - 1.0).max(0.0))
        };
        let harmonic = 2.0 / count as f64 * (0..count).map(force).sum::<f64>() / ratio;
        let found = equivalent_share(ratio);
        assert!(
            (found - harmonic).abs() < 1e-8,
            "{ratio}: {found} {harmonic}"
        );
    }
    assert!(equivalent_share(1e6) > 0.999_998);
}

/// The rows approach the free blade and the linear chart, and the critical speeds cross their mean at the amplitude half way.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_chart_over_the_amplitude_joins_the_free_blade_and_the_linear_one() {
    let limited = lifting(4e-5).edited(|file| {
        file.limits.get_or_insert_default().max_deviation_m = Some(3e-4);
    });
    let scene = limited.unwrap();
    let chart = gap(&scene, &Options::default()).unwrap();
    let first = |at: &AtAmplitude| at.critical_rpm[0];
    let free = Scene::paper().edited(|file| {
        file.accuracy = Accuracy::Draft;
        file.guides.clear();
    });
    let free = Analysis::new(&free.unwrap()).unwrap();
    let expected = rpm(free.model.critical[0].speed_rad_per_s);
    assert!((first(&chart.free) / expected - 1.0).abs() < 2e-3);
    let lowest = &chart.amplitudes[0];
    assert!((first(lowest) / first(&chart.free) - 1.0).abs() < 0.02);
    let highest = chart.amplitudes.last().unwrap();
    assert!((first(highest) / first(&chart.linear) - 1.0).abs() < 2e-3);
    let half = chart.half_way_amplitude_m.unwrap();
    let middle = 0.5 * (first(&chart.free) + first(&chart.linear));
    let rows = chart.amplitudes.iter();
    for at in rows {
        let is_below = at.amplitude_m.unwrap() < half;
        assert_eq!(
            first(at) < middle,
            is_below == (first(&chart.free) < middle)
        );
    }
    // The force of the pad balances the side force for every gap.
    let map = &chart.deviation;
    for (row, factor) in map.pad_forces_n[0].iter().zip(&map.gap_factors) {
        for (pad_n, force) in row.iter().zip(&map.forces_n) {
            assert!((pad_n.unwrap() + force).abs() < 1e-5 * force, "{factor}");
        }
    }
    // The two maps have the speed and the force of the options in common.
    let over_speeds = &map.deflection_over_gap_and_speed_m;
    for (over_force, over_speed) in map.deflection_m.iter().zip(over_speeds) {
        let [one, other] = [over_force, over_speed].map(|row| row[6].unwrap());
        assert!((one / other - 1.0).abs() < 1e-9);
    }
    let error = map.basis_error.unwrap();
    assert!(error.share < 2e-3, "{error:?}");
    // The limits of speed are those at which the deflection passes the limit, none beyond the first critical speed.
    let analysis = Analysis::new(&scene).unwrap();
    let size = analysis.model.plate.resolution;
    let blade = PressedBlade::new(&scene, size, 2000.0, deviation::MODES).unwrap();
    let mut found = 0;
    for (factor, speed) in map.gap_factors.iter().zip(&map.speed_within_rpm) {
        let speed = speed.unwrap_or_default();
        assert!(speed <= first(&chart.linear), "{factor} {speed}");
        if *factor > 0.0 && speed > 0.0 && speed < first(&chart.linear) {
            let blade = blade.with_gaps(*factor);
            let at = |speed: f64| blade.deviation(map.force_n, speed).unwrap();
            let keeps = |speed: f64| at(speed).is_some_and(|at| at.deviation_m.abs() <= 3e-4);
            assert!(keeps(speed) && !keeps(speed + 0.1), "{factor} {speed}");
            found += 1;
        }
    }
    assert!(found > 0, "{:?}", map.speed_within_rpm);
    // A wider gap allows a larger deflection.
    for gaps in map.deflection_m[1..].windows(2) {
        let [narrow, wide] = [&gaps[0], &gaps[1]].map(|row| row[2].unwrap());
        assert!(wide > narrow, "{narrow} {wide}");
    }
}

/// Independent value: a deflection that rises with the square of the force, or that is not known beyond a speed.
#[test]
fn limits_are_found_between_the_places_of_a_map() {
    let at = |deviation_m: f64| {
        Some(Deviation {
            deviation_m,
            largest_m: deviation_m,
            pad_forces_n: Vec::new(),
            face_forces_n: Vec::new(),
            distances_left_m: Vec::new(),
        })
    };
    let places = [1.0, 2.0, 4.0];
    let found = |of: &dyn Fn(f64) -> Option<Deviation>, limit_m: f64| {
        let row = places.map(of);
        deviation::within(&places, &row, limit_m, |place| Ok(of(place))).unwrap()
    };
    let square = |place: f64| at(1e-5 * place * place);
    assert_eq!(found(&square, 1.7e-4), Some(4.0));
    assert_eq!(found(&square, 0.9e-5), None);
    let limit = found(&square, 9e-5).unwrap();
    assert!((limit - 3.0).abs() < 1e-3 && limit <= 3.0, "{limit}");
    let ends = |place: f64| if place < 2.5 { at(1e-5) } else { None };
    let limit = found(&ends, 1.2e-4).unwrap();
    assert!((limit - 2.5).abs() < 1e-3, "{limit}");
}

/// A pad whose offset exceeds its gap presses on the flat blade, and every guide is named with its own gap.
#[test]
fn a_preloaded_pad_holds_the_blade_and_each_gap_is_named() {
    let scene = lifting(4e-5)
        .edited(|file| {
            let pad = file.guides[0].clone();
            file.guides.push(crate::model::scene::GuideFile {
                angle_deg: 120.0,
                gap_m: Some(9e-5),
                offset_m: 1.5e-4,
                ..pad
            });
        })
        .unwrap();
    let said = crate::analyses::campbell::lifting_off(&scene).unwrap();
    assert!(
        said.contains(
            "guides[0] lifts off: within its gap of 0.04 mm nothing of it holds the blade"
        ),
        "{said}"
    );
    assert!(
        said.contains("guides[1] lifts off: its offset of 0.15 mm exceeds its gap of 0.09 mm"),
        "{said}"
    );
    assert!(shifting(&scene).unwrap().contains("guides[1] also push"));
    assert!(shifting(&lifting(4e-5)).is_none());
    let json = include_str!("../../../tests/golden/reports/gap-all.json");
    let mut report: GapReport = serde_json::from_str(json).unwrap();
    report.scene.guides = scene.file().guides.clone();
    let text = report.summary();
    let words: Vec<&str> = text.split_whitespace().collect();
    let text = words.join(" ");
    assert!(
        text.contains("gaps 0.04 mm of guides[0], 0.09 mm of guides[1]"),
        "{text}"
    );
    assert!(text.contains("smallest gap"), "{text}");
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let options = Options::default();
    let refused = options.checked(&Scene::paper()).unwrap_err();
    assert_eq!(refused.key, "guides[].contact");
    let scene = lifting(4e-5);
    let backwards = Options {
        rpm: Some(-1.0),
        ..options
    };
    assert_eq!(backwards.checked(&scene).unwrap_err().key, "rpm");
    let idle = scene.edited(|file| file.side_force = Some(SideForceFile::of(0.0)));
    let refused = options.checked(&idle.unwrap()).unwrap_err();
    assert_eq!(refused.key, "side_force.force_n");
}

/// The pad of the paper's saw reaches from 0.1 to 0.355 m at most. Between collars of 200 mm the blade has a slope of 0.1
/// if it deflects there in a straight line by a tenth of the distance; without collars it moves as a whole. No basis
/// is made, and the same holds for the numbers of a study.
#[test]
fn a_gap_that_the_blade_cannot_cross_is_refused_before_any_work() {
    let clamped = |gap_m: f64| {
        let scene = lifting(gap_m).edited(|file| {
            file.mount = crate::model::scene::Mount::Collar {
                diameter_m: 0.2,
                in_plane: crate::model::scene::InPlane::Free,
                clamp_stiffness_n_m_per_rad_per_m: None,
            };
            file.guides[0].radius_m = 0.2;
            (
                file.guides[0].radial_length_m,
                file.guides[0].tangential_length_m,
            ) = (0.0, 0.0);
        });
        scene.unwrap()
    };
    let options = Options::default();
    let checked = |gap_m: f64| options.checked(&clamped(gap_m));
    assert!(checked(0.0099).is_ok());
    let refused = checked(0.02).unwrap_err();
    assert_eq!(refused.key, "guides[0].gap_m");
    let message = refused.to_string();
    assert!(message.contains("must be at most 0.01 m"), "{message}");
    assert!(message.contains("(you gave 0.02)"), "{message}");
    let study = GapCase::new(&clamped(0.02), &options, None).unwrap_err();
    assert_eq!(study.to_string(), message);
    // A cancelled computation ends before its first eigenproblem.
    let cancelled = crate::modes::Cancellation::default();
    cancelled.cancel();
    let answer = cancelled.watched(|| gap(&clamped(0.02), &options));
    assert_eq!(answer.unwrap().unwrap_err().to_string(), message);
    assert!(options.checked(&lifting(0.02)).is_ok());
}

/// Hoop strain ρ(Ωb)²/E of the rim of 0.1, as for the end of a sweep.
#[test]
fn a_speed_that_tears_the_blade_is_refused_before_any_work() {
    let scene = lifting(1e-4);
    let blade = scene.blade();
    let hoop = |rpm: f64| {
        let material = blade.material;
        let speed = rpm * std::f64::consts::TAU / 60.0 * blade.outer_radius_m;
        material.density_kg_per_m3 * speed * speed / material.youngs_modulus_pa
    };
    let fastest_rpm = (0.1 / hoop(1.0)).sqrt();
    let at = |rpm: f64| {
        let options = Options {
            rpm: Some(rpm),
            ..Options::default()
        };
        options.checked(&scene)
    };
    assert!(at(0.999 * fastest_rpm).is_ok());
    let message = at(1e8).unwrap_err().to_string();
    let begin = format!("rpm must be at most {fastest_rpm:.0} (you gave 1e8)");
    assert!(message.starts_with(&begin), "{message}");
    // Above the speeds for which the basis was chosen it lacks waves that stand still.
    let options = Options {
        rpm: Some(0.5 * fastest_rpm),
        ..Options::default()
    };
    let message = gap(&scene, &options).unwrap_err().to_string();
    assert!(
        message.contains("with the sweep of this scene"),
        "{message}"
    );
    let operated = scene.edited(|file| file.operating_rpm = Some(1e7)).unwrap();
    let message = Options::default()
        .checked(&operated)
        .unwrap_err()
        .to_string();
    assert!(message.starts_with("operating_rpm must be"), "{message}");
}

/// A point pad touches a clamped blade at one place. The power follows from its force, and the temperature is that of the
/// closed form for this power; the heat changes the critical speed.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn the_heat_of_a_point_pad_is_that_of_its_force() {
    let json = include_str!("../../../scenes/collar-400mm.json");
    let scene = Scene::from_json(json).unwrap().edited(|file| {
        file.accuracy = Accuracy::Draft;
        file.side_force = Some(SideForceFile::of(30.0));
        file.guides = vec![crate::model::scene::GuideFile {
            radius_m: 0.17,
            angle_deg: 0.0,
            radial_length_m: 0.0,
            tangential_length_m: 0.0,
            stiffness_n_per_m: 1e6,
            contact: ContactLaw::OneSided,
            gap_m: Some(1e-5),
            ..Scene::paper().file().guides[0].clone()
        }];
    });
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let friction = FrictionFile::of(0.2);
    let heat = FrictionHeat::new(&analysis, friction, 2000.0).unwrap();
    assert!(heat.settled && heat.repetitions > 1, "{heat:?}");
    let force_n = heat.pad_forces_n[0].abs();
    // The spring of the pad is pressed in by its force.
    let left_m = heat.pads[0].gap_left_m.unwrap();
    assert!((left_m / (-force_n / 1e6) - 1.0).abs() < 1e-9, "{left_m}");
    let power_w = 0.2 * force_n * rad_per_s(2000.0) * 0.17;
    let found_w = heat.power_w.unwrap();
    assert!((found_w / power_w - 1.0).abs() < 1e-9, "{found_w}");
    // A point touches with one face.
    let [one, other] = heat.pads[0].face_forces_n.unwrap();
    assert!(
        (one - other).abs() == force_n && one.min(other) == 0.0,
        "{one} {other}"
    );
    let blade = analysis.scene.blade();
    let disk = crate::model::analytical::ring_source::CooledDisk {
        inner_radius_m: blade.inner_radius_m,
        outer_radius_m: blade.outer_radius_m,
        thickness_m: blade.thickness_m,
        conductivity_w_per_m_k: friction.conductivity_w_per_m_k,
        convection_w_per_m2_k: friction.convection_w_per_m2_k,
    };
    let peak = disk.rise_k(0.17, power_w, 0.17);
    for (r, found) in heat.radii_m.iter().zip(&heat.rise_k) {
        let exact = disk.rise_k(*r, power_w, 0.17);
        assert!((found - exact).abs() < 5e-3 * peak, "{r}: {found} {exact}");
    }
    let [cold, hot] = [heat.cold_first_critical_rpm, heat.first_critical_rpm].map(Option::unwrap);
    assert!((hot / cold - 1.0).abs() > 1e-3, "{hot} {cold}");

    // Ten times the friction buckles the blade: it has no steady state, and no numbers of one. Below the speed of the runaway the
    // temperature settles.
    let many = FrictionFile::of(2.0);
    let heat = FrictionHeat::new(&analysis, many, 2000.0).unwrap();
    assert!(
        !heat.settled && heat.first_critical_rpm.is_none(),
        "{heat:?}"
    );
    assert!(heat.power_w.is_none() && heat.rise_k.is_empty() && heat.pad_forces_n.is_empty());
    let runaway = heat.runaway_rpm.unwrap();
    assert!(heat.unsettled().unwrap().contains("runs away from"));
    let below = FrictionHeat::new(&analysis, many, 0.95 * runaway).unwrap();
    assert!(
        below.settled && below.runaway_rpm.is_none(),
        "{runaway} {below:?}"
    );
    assert!(
        !FrictionHeat::new(&analysis, many, 1.02 * runaway)
            .unwrap()
            .settled,
        "{runaway}"
    );
}

/// Both faces of a tilted pad rub. Independent values: the virtual work of rubbing, μΩ Σ N r over the faces, which lies between that of
/// all forces at the inner and at the outer end of the pads, and the force of a pad as the difference of the forces on its faces.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn power_is_that_of_the_forces_on_both_faces() {
    let json = include_str!("../../../scenes/collar-400mm.json");
    let scene = Scene::from_json(json).unwrap().edited(|file| {
        file.accuracy = Accuracy::Draft;
        file.side_force = Some(SideForceFile::of(20.0));
        let pad = |angle_deg: f64| crate::model::scene::GuideFile {
            radius_m: 0.16,
            angle_deg,
            radial_length_m: 0.05,
            tangential_length_m: 0.05,
            stiffness_n_per_m: 1e7,
            contact: ContactLaw::OneSided,
            gap_m: Some(2e-6),
            ..Scene::paper().file().guides[0].clone()
        };
        file.guides = vec![pad(-30.0), pad(30.0)];
    });
    let analysis = Analysis::new(&scene.unwrap()).unwrap();
    let heat = FrictionHeat::new(&analysis, FrictionFile::of(0.05), 1500.0).unwrap();
    assert!(heat.settled, "{heat:?}");
    let faces: Vec<[f64; 2]> = heat
        .pads
        .iter()
        .filter_map(|pad| pad.face_forces_n)
        .collect();
    let gross: f64 = faces.iter().flatten().sum();
    let at = |radius_m: f64| 0.05 * gross * rad_per_s(1500.0) * radius_m;
    let power_w = heat.power_w.unwrap();
    assert!(
        (at(0.135)..at(0.185)).contains(&power_w),
        "{power_w} {heat:?}"
    );
    // One face of each pad has a share that the force of the pad does not show.
    let net: f64 = heat.pad_forces_n.iter().map(|force| force.abs()).sum();
    assert!(gross > 1.02 * net, "{gross} {net}");
    for ([one, other], force) in faces.iter().zip(&heat.pad_forces_n) {
        assert!(
            (other - one - force).abs() < 1e-9 * gross,
            "{one} {other} {force}"
        );
    }
    // The temperature may be typed as that of a scene.
    let typed = analysis.scene.edited(|file| {
        let rows = heat.radii_m.iter().zip(&heat.rise_k);
        let table = rows.map(|(radius_m, rise_k)| crate::model::scene::TemperatureRow {
            radius_m: *radius_m,
            rise_k: *rise_k,
        });
        file.membrane.get_or_insert_default().temperature =
            Some(crate::model::scene::TemperatureFile {
                expansion_per_k: heat.expansion_per_k,
                rim_rise_k: None,
                from_radius_m: None,
                exponent: None,
                table: table.collect(),
            });
    });
    let critical = &Analysis::new(&typed.unwrap()).unwrap().model.critical[0];
    let expected = heat.first_critical_rpm.unwrap();
    assert!((rpm(critical.speed_rad_per_s) / expected - 1.0).abs() < 1e-3);
}

/// A blade on three pads heaves without force, so that pads with one common offset move it by this offset.
#[test]
#[cfg_attr(debug_assertions, ignore = "many eigenproblems: run it in release")]
fn pads_with_one_offset_move_the_blade_by_it() {
    let of = |offset_m: f64| {
        let scene = lifting(4e-5)
            .edited(|file| {
                let pad = file.guides[0].clone();
                file.guides = [-55.0, 65.0, 185.0]
                    .map(|angle_deg| crate::model::scene::GuideFile {
                        angle_deg,
                        offset_m,
                        controller: pad.controller.clone(),
                        ..pad
                    })
                    .to_vec();
            })
            .unwrap();
        let resolution = crate::model::plate::Resolution {
            max_diameters: 8,
            radial_functions: 4,
        };
        let blade = PressedBlade::new(&scene, resolution, 1000.0, 24).unwrap();
        blade.deviation(3.0, 1000.0).unwrap().unwrap()
    };
    let (flat, moved) = (of(0.0), of(1.2e-4));
    let difference = moved.deviation_m - flat.deviation_m;
    assert!((difference - 1.2e-4).abs() < 1e-8, "{difference:e}");
    for (one, other) in flat.pad_forces_n.iter().zip(&moved.pad_forces_n) {
        assert!((one - other).abs() < 1e-3, "{one} {other}");
    }
}

/// Independent value: the first harmonic of the force of a pad with an offset, summed over a period.
#[test]
fn an_offset_changes_the_mean_stiffness() {
    let count = 200_000;
    for (offset, amplitude) in [(0.5, 1.2), (0.5, 3.0), (1.5, 0.3), (1.5, 2.0_f64)] {
        let force = |k: usize| {
            let sin = (TAU * (k as f64 + 0.5) / count as f64).sin();
            let w = amplitude * sin - offset;
            sin * ((w - 1.0).max(0.0) - (-w - 1.0).max(0.0))
        };
        let harmonic = 2.0 / count as f64 * (0..count).map(force).sum::<f64>() / amplitude;
        let guide = crate::model::scene::GuideFile {
            stiffness_n_per_m: 1.0,
            gap_m: Some(1.0),
            offset_m: offset,
            ..Scene::paper().file().guides[0].clone()
        };
        let found = amplitude::equivalent_stiffness(&guide, amplitude);
        assert!(
            (found - harmonic).abs() < 1e-7,
            "{offset} {amplitude}: {found} {harmonic}"
        );
    }
}
