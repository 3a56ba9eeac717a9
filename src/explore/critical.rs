//! Critical speeds of a saw that is being changed, which are known long before its diagram.

use serde::Serialize;

use super::charts::drafted;
use super::refusal::Refusal;
use super::told::{Fact, of_critical};
use crate::figure::Upright;
use crate::scene::{Scene, rpm};
use crate::stability::ChosenBasis;

/// Critical speeds with the accuracy of a draft, equal to those of its diagram.
#[derive(Debug, Serialize)]
pub struct CriticalSpeeds {
    /// Their lines in the diagram.
    uprights: Vec<Upright>,
    /// Numbers that follow from them.
    facts: [Fact; 2],
}

/// Critical speeds of a scene.
///
/// # Errors
/// [`Refusal`] if the scene is refused or the computation fails or is cancelled.
pub fn answer(scene: &str) -> Result<CriticalSpeeds, Refusal> {
    let scene = drafted(&Scene::from_json(scene)?)?;
    let chosen = ChosenBasis::new(&scene, scene.tolerance())?;
    let lowest = chosen.critical.first().map(|c| c.speed_rad_per_s);
    let share = scene.operating_rad_per_s().zip(lowest);
    let within = chosen.critical.iter();
    let within = within.take_while(|c| c.speed_rad_per_s <= chosen.range_rad_per_s.1);
    let uprights: Vec<Upright> = within
        .map(|c| Upright::critical(rpm(c.speed_rad_per_s), &c.name.in_words()))
        .collect();
    let first = uprights.first().map(|upright| upright.x);
    Ok(CriticalSpeeds {
        facts: of_critical(first, share.map(|(operating, lowest)| operating / lowest)),
        uprights,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::charts::{Charts, Fidelity};

    /// They are those of the diagram that follows, also if the first lies beyond the sweep.
    #[test]
    fn critical_speeds_before_a_diagram_are_its_own() {
        let paper = Scene::paper();
        let slow = paper.edited(|file| {
            file.operating_rpm = Some(900.0);
            file.sweep.as_mut().unwrap().to_rpm = 1000.0;
        });
        for scene in [paper, slow.unwrap()] {
            let scene = serde_json::to_string(scene.file()).unwrap();
            let ahead = serde_json::to_value(answer(&scene).unwrap()).unwrap();
            let chart = Charts::new(|| 0.0).chart("one", &scene, Fidelity::Draft);
            let chart: serde_json::Value = serde_json::from_str(&chart.unwrap()).unwrap();
            let items = chart["figure"]["panels"][0]["items"].as_array().unwrap();
            let drawn = items.iter().filter(|item| item["role"] == "critical");
            let places = |all: &mut dyn Iterator<Item = &serde_json::Value>| {
                all.map(|upright| (upright["x"].clone(), upright["name"].clone()))
                    .collect::<Vec<_>>()
            };
            let found = ahead["uprights"].as_array().unwrap();
            let found = places(&mut found.iter());
            assert_eq!(found, places(&mut { drawn }));
            for fact in ahead["facts"].as_array().unwrap() {
                let all = chart["told"]["facts"].as_array().unwrap();
                assert!(all.contains(fact), "{fact} {all:?}");
            }
        }
    }
}
