use std::sync::LazyLock;

use faer::c64;

use super::*;
use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{Accuracy, Scene, SpeedRange, rad_per_s, rpm};
use crate::modes::Strategy;
use crate::stability::Analysis;
use crate::stability::band::CurvePoint;
use crate::stability::growth_curve::between;
use crate::stability::undamped::search_speeds;

fn paper(accuracy: Accuracy) -> (SpectralModel, Vec<f64>) {
    let range = SpeedRange::between_rpm(0.0, 3000.0);
    let plate = Plate::new(&Scene::paper(), Resolution::of(accuracy));
    let model = SpectralModel::new(plate, range, Strategy::Reduced).unwrap();
    let speeds = search_speeds(&model, range, 25);
    (model, speeds)
}

/// Range from rest to the last speed of a search, so that no band is cut.
fn whole(speeds: &[f64]) -> SpeedRange {
    SpeedRange::new(0.0, speeds[speeds.len() - 1])
}

/// The paper's saw, its bands, and the speeds of their search.
struct Sound {
    model: SpectralModel,
    speeds: Vec<f64>,
    bands: Vec<Instability>,
}

static SOUND: LazyLock<Sound> = LazyLock::new(|| {
    let (model, speeds) = paper(Accuracy::Draft);
    let found = searched(&model, whole(&speeds), &speeds, Depth::Proof, Extent::Bands)
        .unwrap()
        .found;
    let (bands, certificate) = (found.instabilities, found.certificate);
    assert!(certificate.is_clean(), "{certificate:?}");
    assert!(certificate.full_basis_counts > 80);
    Sound {
        model,
        speeds,
        bands,
    }
});

/// Certificate of a list of bands, which may be wrong, with samples that a function may make wrong.
fn certified(sound: &Sound, bands: &[Instability], change: impl Fn(&mut Sample)) -> Certificate {
    let checked = CheckedModes::new(&sound.model, Extent::Bands);
    let pieces = searched_pieces(&checked, &sound.speeds).unwrap();
    let mut samples = checked.samples();
    samples.iter_mut().for_each(change);
    let full = ModeCounts::new(&sound.model).unwrap();
    let checks = Checks {
        checked: &checked,
        full: &full,
        pieces: &pieces,
        bands,
        samples: &samples,
    };
    checks.certificate(Depth::Proof).unwrap()
}

/// A point between two points of a band is the eigenvalue there, and uncounted; where the curve is wrong and no mode grows, it is
/// interpolated, and the certificate counts it.
#[test]
fn points_of_bands_without_a_growing_mode_are_counted() {
    let checked = CheckedModes::new(&SOUND.model, Extent::Bands);
    let band = &SOUND.bands[flutter_bands(&SOUND.bands)[0]];
    let lambda = c64::new(band.peak_growth_per_s, band.frequency_rad_per_s);
    let middle = |speed: f64| {
        let point = |share: f64| CurvePoint::new(share * speed, (lambda * lambda, c64::ZERO));
        between(&checked, [point(1.0 - 1e-9), point(1.0 + 1e-9)], 0.5).unwrap()
    };
    let found = middle(band.peak_rad_per_s).number.sqrt();
    assert!(
        (found - lambda).norm() < 1e-5 * lambda.norm(),
        "{found} {lambda}"
    );
    assert_eq!(checked.certificate().interpolated, 0);
    let beside = middle(rad_per_s(500.0));
    assert_eq!(beside.number, lambda * lambda);
    assert_eq!(checked.certificate().interpolated, 1);
}

/// Bands and certificate without a proof.
fn searched_once(model: &SpectralModel, speeds: &[f64]) -> FoundBands {
    searched(model, whole(speeds), speeds, Depth::Counts, Extent::Bands)
        .unwrap()
        .found
}

fn open_rad_per_s(certificate: &Certificate) -> f64 {
    let unproven = certificate.unproven_rad_per_s.iter().flatten();
    unproven.map(SpeedRange::width).sum()
}

fn flutter_bands(bands: &[Instability]) -> Vec<usize> {
    let is_flutter = |k: &usize| bands[*k].kind == InstabilityKind::Flutter;
    (0..bands.len()).filter(is_flutter).collect()
}

#[test]
fn nearly_all_speeds_are_proven_and_the_others_are_at_edges() {
    let sound = &*SOUND;
    let certificate = certified(sound, &sound.bands, |_| ());
    assert!(certificate.is_clean(), "{certificate:?}");
    let unproven = certificate.unproven_rad_per_s.unwrap();
    let open: f64 = unproven.iter().map(SpeedRange::width).sum();
    assert!(open < 0.005 * rad_per_s(3000.0), "{} rpm", rpm(open));
    for range in unproven {
        assert!(rpm(range.width()) < 1.0, "{range:?}");
    }
}

/// Every band that the proof finds complete is found without it, too.
#[test]
fn a_draft_has_the_bands_of_a_proven_chart_and_says_that_it_is_not_proven() {
    let [draft, design] = [Accuracy::Draft, Accuracy::Design].map(|accuracy| {
        let scene = Scene::paper().edited(|saw| saw.accuracy = accuracy);
        Analysis::new(&scene.unwrap()).unwrap()
    });
    let unproven = |saw: &Analysis| saw.chart.certificate.unproven_rad_per_s.clone();
    assert!(unproven(&draft).is_none() && unproven(&design).is_some());
    assert!(draft.chart.certificate.is_clean() && draft.chart.certificate.full_basis_counts > 0);
    assert!(are_same(draft.bands(), design.bands(), 5e-3));
    let statement = draft.report().certificate.statement;
    assert!(statement.ends_with("searched, not proven"), "{statement}");
}

/// Reference: dense eigenvalues at random speeds in the proven intervals.
#[test]
fn proven_speeds_have_no_unstable_mode_besides_the_bands() {
    let sound = &*SOUND;
    let certificate = certified(sound, &sound.bands, |_| ());
    let unproven = certificate.unproven_rad_per_s.unwrap();
    let mut compared = 0;
    for k in 0..120 {
        let speed = rad_per_s(1400.0 + 1600.0 * drawn_share(1000 + k));
        if unproven.iter().any(|range| range.contains(speed)) {
            continue;
        }
        let modes = sound.model.full_modes(speed).unwrap();
        let sample = Sample::of_modes(speed, modes.iter());
        let covers = |b: &&Instability| b.range().contains(speed);
        let listed = sound.bands.iter().filter(covers).count();
        let unstable = sample.quadruples().count() + sample.divergences().count();
        assert!(
            unstable <= listed,
            "{} rpm: {unstable} {listed}",
            rpm(speed)
        );
        compared += 1;
    }
    assert!(compared > 100, "{compared}");
}

#[test]
fn a_missing_mode_is_found_and_a_model_with_more_waves_has_it() {
    let sound = &*SOUND;
    // A wave that takes part in bands, and one at the top of the window.
    for (speed, place) in [(2265.0, 1), (2800.0, 2)] {
        let (mut model, speeds) = paper(Accuracy::Draft);
        model.lose_wave(rad_per_s(speed), place);
        let certificate = searched_once(&model, &speeds).certificate;
        assert!(
            !certificate.miscounts.is_empty(),
            "{speed} {place}: {certificate:?}"
        );
        let FoundBands {
            instabilities: found,
            certificate,
        } = searched_once(&model.with_more_waves().unwrap(), &speeds);
        assert!(certificate.is_clean(), "{certificate:?}");
        assert!(are_same(&found, &sound.bands, 1e-6), "{speed} {place}");
    }
}

#[test]
fn two_exchanged_signs_are_found() {
    let sound = &*SOUND;
    let certificate = certified(sound, &sound.bands, |sample| {
        let opposite = |pair: &[i8]| pair[0] * pair[1] < 0;
        if let Some(place) = sample.signs.windows(2).position(opposite) {
            sample.signs.swap(place, place + 1);
        }
    });
    assert!(!certificate.miscounts.is_empty());
}

/// Whether two lists have the same edges within a relative tolerance, and the same peaks within a hundred
/// times the tolerance.
fn are_same(left: &[Instability], right: &[Instability], tolerance: f64) -> bool {
    let is_near = |x: f64, y: f64| (x / y - 1.0).abs() < tolerance;
    left.len() == right.len()
        && left.iter().zip(right).all(|(x, y)| {
            is_near(x.from_rad_per_s, y.from_rad_per_s)
                && is_near(x.to_rad_per_s, y.to_rad_per_s)
                && (x.peak_growth_per_s / y.peak_growth_per_s - 1.0).abs() < 100.0 * tolerance
        })
}

#[test]
fn bands_that_are_shifted_open_missing_or_too_low_are_found() {
    let sound = &*SOUND;
    let clean = open_rad_per_s(&certified(sound, &sound.bands, |_| ()));
    for k in flutter_bands(&sound.bands) {
        let width = sound.bands[k].to_rad_per_s - sound.bands[k].from_rad_per_s;
        let changed = |change: &dyn Fn(&mut Instability)| {
            let mut bands = sound.bands.clone();
            change(&mut bands[k]);
            certified(sound, &bands, |_| ())
        };
        let shifted = changed(&|band| {
            band.from_rad_per_s += 0.3 * width;
            band.to_rad_per_s += 0.3 * width;
        });
        assert!(!shifted.is_clean(), "band {k} shifted");
        if sound.bands[k].closed {
            let open = changed(&|band| band.to_rad_per_s = sound.speeds[sound.speeds.len() - 1]);
            assert!(!open.is_clean(), "band {k} open");
        }
        let low = changed(&|band| band.peak_growth_per_s *= 0.5);
        assert!(!low.is_clean(), "band {k} with half its peak");
        let mut bands = sound.bands.clone();
        bands.remove(k);
        let missing = certified(sound, &bands, |_| ());
        // A band missing from the list leaves its range unproven even where no speed was computed.
        assert!(
            open_rad_per_s(&missing) > clean + 0.9 * width,
            "band {k} missing"
        );
    }
}
