use super::*;
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::map::{Map, MappedSaw, Options, Range};
use crate::analyses::study::{Found, Outcome, Saw};
use crate::model::scene::Scene;
use crate::page::figure::layout::sheet;
use crate::page::figure::tidiness::texts;
use crate::stability::InstabilityKind;

/// Synthetic saws whose flutter speed rises with x and falls with y.
fn report(with_y: bool) -> MapReport {
    let range = |path: &str, from, to| Range {
        path: path.into(),
        from,
        to,
    };
    let options = Options {
        y: with_y.then(|| range("guides[0].stiffness_n_per_m", 1e6, 1e8)),
        points: Some(9),
        rpm: Some(2200.0),
        ..Options::over(range("blade.thickness_m", 0.0024, 0.0032))
    };
    let map = Map::new(Scene::paper(), &options).unwrap();
    let saw = |index: usize| {
        let (x, y) = ((index % 9) as f64, (index / 9) as f64);
        let flutter = 2000.0 + 60.0 * x - 10.0 * y;
        let band = |kind, from_rpm: f64, width: f64, counts: bool| {
            let edges = [from_rpm, from_rpm + width];
            InstabilityBand {
                peak_growth_per_s: 0.4,
                counted_rpm: Vec::from_iter(counts.then_some(edges)),
                ..InstabilityBand::between(kind, edges)
            }
        };
        let found = Found {
            first_critical_rpm: Some(0.7 * flutter),
            flutter_rpm: Some(flutter),
            critical_rpm: vec![0.7 * flutter, 0.9 * flutter],
            bands: vec![
                band(InstabilityKind::Divergence, 0.7 * flutter, 40.0, true),
                band(InstabilityKind::Flutter, 0.9 * flutter, 3.0, false),
                band(InstabilityKind::Flutter, flutter, 200.0, true),
            ],
            ..Found::default()
        };
        Saw {
            index,
            values: map.study().values(index),
            outcome: match index {
                4 => Outcome::Refused("too thin".into()),
                _ => Outcome::Analysed(found),
            },
        }
    };
    let saws: Vec<Saw> = (0..map.study().count()).map(saw).collect();
    map.report(&saws)
}

#[test]
fn nothing_is_cut_off_and_the_key_names_what_is_drawn() {
    for with_y in [false, true] {
        let report = report(with_y);
        let sheet = sheet(&chart(&report));
        let all = texts(&sheet);
        assert!(all.iter().any(|text| text.contains("[mm]")), "{all:?}");
        assert!(all.contains(&"not analysed"), "{all:?}");
        assert_eq!(all.contains(&"2100"), with_y, "{all:?}");
    }
    let without = MapReport {
        rpm: None,
        saws: report(true)
            .saws
            .into_iter()
            .map(|saw| MappedSaw {
                verdict: None,
                ..saw
            })
            .collect(),
        ..report(true)
    };
    let _drawn = sheet(&chart(&without));
}
