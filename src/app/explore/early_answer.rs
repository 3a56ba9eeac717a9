//! Results of a saw that are known before its diagram: critical speeds, and later bands with the verdict.

use serde::Serialize;

use super::answer::{ShownVerdict, Told, of_bands, of_critical};
use crate::analyses::campbell::InstabilityBand;
use crate::analyses::verdict::Judge;
use crate::model::scene::{Scene, rpm};
use crate::page::figure::{Band, Item, Upright};
use crate::page::outline::Fact;
use crate::stability::{Evidence, Instability, Interim, ListedBand, flutter_onsets};

/// Results before the diagram, equal to those of the diagram.
#[derive(Debug, Serialize)]
pub struct Ahead {
    /// Lines of the critical speeds in the diagram.
    critical: Vec<Item>,
    /// Shaded bands in the diagram; null before they are known.
    bands: Option<Vec<Item>>,
    /// Numbers that follow from the critical speeds and the bands.
    facts: Vec<Fact>,
    /// Verdict at the operating speed; null before the bands are known, and without an operating speed.
    verdict: Option<ShownVerdict>,
}

impl Ahead {
    /// Results of an analysis that is not complete.
    pub fn new(scene: &Scene, interim: Interim<'_>) -> Self {
        let critical: Vec<f64> = interim.critical.iter().map(|c| c.speed_rad_per_s).collect();
        let uprights: Vec<Upright> = interim
            .critical
            .iter()
            .take_while(|c| c.speed_rad_per_s <= interim.range_rad_per_s.to_rad_per_s)
            .map(|c| Upright::critical(rpm(c.speed_rad_per_s), &c.name.in_words()))
            .collect();
        let operating = scene.operating_rad_per_s();
        let share = operating.zip(critical.first());
        // Without an operating speed, the first critical speed matters only in the sweep.
        let in_sweep = uprights.first().map(|upright| upright.x);
        let first = share.map(|(_, lowest)| rpm(*lowest)).or(in_sweep);
        let mut ahead = Ahead {
            facts: of_critical(first, share.map(|(speed, lowest)| speed / lowest)).into(),
            critical: uprights.into_iter().map(Item::Upright).collect(),
            bands: None,
            verdict: None,
        };
        if let Some(bands) = interim.bands {
            let threshold_per_s = scene.flutter_threshold_per_s();
            // The errors of edges are estimated when the diagram is complete.
            let listed = |band| ListedBand::new(band, threshold_per_s, Some(0.0));
            let evidence = Evidence {
                bands: bands.iter().map(listed).collect(),
                has_failed: false,
                critical_rad_per_s: &critical,
                threshold_per_s,
                range_rad_per_s: interim.range_rad_per_s,
                not_covered: scene.file().not_covered(critical.first().copied()),
                floquet: None,
            };
            ahead.add_bands(bands, &evidence);
            let judge = Judge {
                found: &evidence,
                limits: &scene.limits(),
                rim_radius_m: scene.blade().outer_radius_m,
                is_held: interim.is_held,
                accuracy: scene.accuracy(),
            };
            let verdict = || Told::verdict(&judge.verdict(operating, Vec::new()));
            // Multipliers of slotted saws beside guides come with the complete diagram.
            let is_known = scene.file().slot_passing().is_none();
            ahead.verdict = operating.filter(|_| is_known).map(|_| verdict());
        }
        ahead
    }

    fn add_bands(&mut self, bands: &[Instability], evidence: &Evidence<'_>) {
        let threshold = evidence.threshold_per_s;
        let range_rpm = evidence.range_rad_per_s.ends().map(rpm);
        let shaded = |band: &Instability| {
            let entry = InstabilityBand::new(band, threshold);
            Item::Band(Band::new(&entry, range_rpm))
        };
        self.bands = Some(bands.iter().map(shaded).collect());
        let onsets = flutter_onsets(bands, threshold)
            .map(|onset| onset.map(|onset| rpm(onset.speed_rad_per_s)));
        let growths = bands.iter().map(|band| band.peak_growth_per_s);
        self.facts.extend(of_bands(onsets, growths));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use serde_json::Value;

    use super::super::charts::{Charts, Fidelity};
    use super::*;

    /// Items of the first panel of a diagram whose `key` has this value, without their names.
    fn drawn(chart: &Value, key: &str, value: &str) -> Vec<Value> {
        let items = chart["figure"]["panels"][0]["items"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|item| item[key] == value);
        unnamed(items)
    }

    fn unnamed<'a>(items: impl Iterator<Item = &'a Value>) -> Vec<Value> {
        let items = items.cloned().map(|mut item| {
            item.as_object_mut().unwrap().remove("name");
            item
        });
        items.collect()
    }

    /// Critical speeds, bands, numbers and verdict that come before a diagram equal those of the diagram, also if the
    /// first critical speed is beyond the sweep, and with damping.
    #[test]
    fn results_before_a_diagram_are_its_own() {
        let paper = Scene::paper();
        let slow = paper.edited(|file| {
            file.operating_rpm = Some(900.0);
            file.sweep.as_mut().unwrap().to_rpm = 1000.0;
        });
        let damped = paper.edited(|file| file.guides[0].damping_n_s_per_m = 50.0);
        for scene in [paper, slow.unwrap(), damped.unwrap()] {
            let scene = serde_json::to_string(scene.file()).unwrap();
            let charts = Charts::new(|| 0.0);
            let alone =
                serde_json::to_value(charts.critical_speeds("one", &scene).unwrap()).unwrap();
            let written = Mutex::new(Vec::new());
            let tell = |line: String| written.lock().unwrap().push(line);
            let answer = charts.chart("one", &scene, Fidelity::Draft, &tell);
            let chart: Value = serde_json::from_str(&answer.unwrap()).unwrap();
            let lines = written.into_inner().unwrap();
            let stages: Vec<Value> = lines
                .iter()
                .map(|line| serde_json::from_str::<Value>(line).unwrap()["ahead"].take())
                .collect();
            let [first, second] = stages.as_slice() else {
                panic!("{stages:?}");
            };
            assert_eq!(alone, *first);
            assert!(first["bands"].is_null() && first["verdict"].is_null());
            for stage in &stages {
                let critical = unnamed(stage["critical"].as_array().unwrap().iter());
                assert_eq!(critical, drawn(&chart, "role", "critical"));
                for fact in stage["facts"].as_array().unwrap() {
                    let all = chart["told"]["facts"].as_array().unwrap();
                    assert!(all.contains(fact), "{fact} {all:?}");
                }
            }
            let bands = unnamed(second["bands"].as_array().unwrap().iter());
            assert_eq!(bands, drawn(&chart, "item", "band"));
            assert_eq!(second["facts"].as_array().unwrap().len(), 5);
            for key in ["answer", "word"] {
                let of_chart = &chart["told"]["verdict"][key];
                assert_eq!(second["verdict"][key], *of_chart);
            }
        }
    }
}
