//! The search for bands at the ends of a sweep, near rest, and at double critical speeds.

use sawflutter::model::scene::{Accuracy, Scene, SweepFile, rpm};
use sawflutter::stability::{Analysis, InstabilityKind};

fn read(name: &str, accuracy: Accuracy) -> Scene {
    let path = crate::common::path(&format!("tests/reference/{name}.json"));
    let edited = Scene::from_path(path)
        .unwrap()
        .edited(|file| file.accuracy = accuracy);
    edited.unwrap()
}

/// Flutter grows by 6.918 1/s at 2989.9 rpm, by dense eigenvalues, and by at most 7.03 1/s, near 3000 rpm.
#[test]
fn a_sweep_that_ends_within_a_band_does_not_contradict_its_growth() {
    let scene = read("sweep_ends_in_band", Accuracy::Design);
    for to_rpm in [2970.0, 3000.0, 3050.0] {
        let sweep = SweepFile {
            from_rpm: 0.0,
            to_rpm,
        };
        let swept = scene.edited(|file| file.sweep = Some(sweep));
        let analysis = Analysis::new(&swept.unwrap()).unwrap();
        let certificate = &analysis.chart.certificate;
        assert!(certificate.is_clean(), "{to_rpm}: {certificate:?}");
        let band = analysis.bands().last().unwrap();
        assert_eq!(band.kind, InstabilityKind::Flutter);
        let least = if to_rpm < 2989.9 { 5.8 } else { 6.918 };
        assert!(
            (least..7.05).contains(&band.peak_growth_per_s),
            "{to_rpm}: {band}"
        );
    }
}

/// A pad at a point leaves a wave of every number of nodal diameters that stands still with the pad at rest, because heave of the loose
/// blade makes up for the deflection there: the critical speeds are double, and nothing diverges between them. The tilt that nothing
/// holds turns with a frequency in proportion to the speed, which is nearly zero near rest.
#[test]
fn a_point_pad_on_a_loose_blade_takes_few_speeds_and_has_no_divergence() {
    let analysis = Analysis::new(&read("point_pad_on_spline", Accuracy::Draft)).unwrap();
    let certificate = &analysis.chart.certificate;
    assert!(certificate.is_clean(), "{certificate:?}");
    assert!(certificate.speeds_checked < 500, "{certificate:?}");
    for pair in analysis.model.critical[..8].chunks_exact(2) {
        let [one, other] = [0, 1].map(|k| pair[k].speed_rad_per_s);
        assert!((other / one - 1.0).abs() < 1e-9);
    }
    let flutter: Vec<f64> = analysis
        .bands()
        .iter()
        .filter(|band| band.kind == InstabilityKind::Flutter)
        .map(|band| rpm(band.from_rad_per_s).round())
        .collect();
    assert_eq!(flutter.len(), analysis.bands().len());
    assert_eq!(flutter, [1862.0, 2284.0, 2317.0, 2663.0, 2715.0, 2759.0]);
}

/// On a basis of the accuracy `reference` divergence ends at 40765.09 rpm, where two real λ coalesce and flutter begins. The shapes of
/// both need far more functions than the waves that stand still at the critical speeds.
#[test]
fn an_end_of_divergence_at_flutter_has_an_error_of_its_own() {
    let analysis = Analysis::new(&read("thick_ring", Accuracy::Draft)).unwrap();
    let near = |speed: f64| (rpm(speed) / 40765.09 - 1.0).abs();
    let estimates = analysis.estimates.as_ref().unwrap();
    let mut ends = 0;
    for (band, error) in analysis.bands().iter().zip(&estimates.bands) {
        for off in band.range().ends().map(near) {
            if off < 1e-3 {
                let stated = error.speed.unwrap();
                assert!(
                    (off..10.0 * off).contains(&stated),
                    "{band}: {stated:e} {off:e}"
                );
                ends += 1;
            }
        }
    }
    assert_eq!(ends, 2);
}
