use super::contour::contours;
use super::{Contour, Contoured};
use crate::analyses::campbell::InstabilityBand;
use crate::model::scene::{SpeedRange, rad_per_s};
use crate::stability::{Evidence, InstabilityKind, StabilityState};

fn grid(size: usize, value: impl Fn(f64, f64) -> f64) -> Vec<Vec<Option<f64>>> {
    let row = |y: usize| (0..size).map(|x| Some(value(x as f64, y as f64))).collect();
    (0..size).map(row).collect()
}

fn lines(rows: &[Vec<Option<f64>>]) -> Vec<Contour> {
    let rows: Vec<&[Option<f64>]> = rows.iter().map(Vec::as_slice).collect();
    contours(Contoured::FlutterSpeed, &rows, |place| place)
}

/// Reference: the contours of a plane are straight lines, those of a cone closed circles.
#[test]
fn contours_of_a_plane_and_of_a_cone_are_lines_and_circles() {
    let plane = lines(&grid(9, |x, y| 1000.0 + 30.0 * x + 10.0 * y));
    assert_eq!(plane.len(), 6, "every 50 rpm from 1050 to 1300");
    for line in &plane {
        for [x, y] in &line.points {
            assert!((1000.0 + 30.0 * x + 10.0 * y - line.rpm).abs() < 1e-9);
        }
    }
    let middle = 20.0;
    let cone = lines(&grid(41, |x, y| (x - middle).hypot(y - middle)));
    let within: Vec<&Contour> = cone.iter().filter(|line| line.rpm < 19.0).collect();
    assert!(within.len() >= 3);
    for line in within {
        assert_eq!(line.points.first(), line.points.last());
        for [x, y] in &line.points {
            let radius = (x - middle).hypot(y - middle);
            // The distance of the chord in a cell from the circle is at most 1/(8 r).
            assert!((radius - line.rpm).abs() < 0.2 / line.rpm, "{radius}");
        }
    }
    let hole = lines(&[vec![Some(1.0), None], vec![Some(2.0), Some(3.0)]]);
    assert!(hole.is_empty());
    assert!(lines(&grid(3, |_, _| 7.0)).is_empty());
}

#[test]
fn divergence_counts_before_flutter() {
    let band = |kind, counted: &[[f64; 2]]| InstabilityBand {
        counted_rpm: counted.to_vec(),
        estimated_relative_error: Some(1e-6),
        ..InstabilityBand::between(kind, [1000.0, 1100.0])
    };
    let flutter = band(InstabilityKind::Flutter, &[[1020.0, 1080.0]]);
    let divergence = band(InstabilityKind::Divergence, &[[1000.0, 1050.0]]);
    let bands = [flutter, divergence];
    let state_at = |bands: &[InstabilityBand], rpm| {
        let evidence = Evidence {
            bands: bands.iter().map(InstabilityBand::listed).collect(),
            has_failed: false,
            critical_rad_per_s: &[],
            threshold_per_s: 0.25,
            range_rad_per_s: SpeedRange::new(0.0, rad_per_s(2000.0)),
            not_covered: Vec::new(),
            floquet: None,
        };
        evidence.verdict(rad_per_s(rpm)).state
    };
    use StabilityState::{Divergence, Flutter, Stable, TooClose};
    let states = [990.0, 1010.0, 1030.0, 1060.0, 1090.0].map(|rpm| state_at(&bands, rpm));
    assert_eq!(states, [Stable, Divergence, Divergence, Flutter, Stable]);
    // An edge of which the error exceeds the distance.
    let known = bands.map(|band| InstabilityBand {
        estimated_relative_error: Some(0.002),
        ..band
    });
    let states = [997.0, 999.0, 1001.0, 1003.0].map(|rpm| state_at(&known, rpm));
    assert_eq!(states, [Stable, TooClose, TooClose, Divergence]);
    // An edge of which the error is unknown.
    let unknown = known.map(|band| InstabilityBand {
        estimated_relative_error: None,
        ..band
    });
    let states = [985.0, 995.0, 1005.0].map(|rpm| state_at(&unknown, rpm));
    assert_eq!(states, [Stable, TooClose, TooClose]);
}
