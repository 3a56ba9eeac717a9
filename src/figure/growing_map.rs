//! The map of a placement in progress: first samples, then cells, with the axes and colours of the final one.

use super::canvas::{Sheet, Stroke};
use super::heading;
use super::place_map::{PANEL, Shades, draw_panel, empty, goals, title};
use super::style::{INK, PAPER};
use crate::report::GrowingMapEntry;

pub fn sheet(growing: &GrowingMapEntry) -> Sheet {
    let map = &growing.map;
    let known = growing.is_computed.iter().flatten().filter(|known| **known);
    let (known, of) = (known.count(), map.x.len() * map.y.len());
    let facts = match known {
        0 => format!(
            "so far: {} samples between the bounds",
            growing.samples.len()
        ),
        _ => format!("so far: {known} of {of} saws of the map"),
    };
    let mut sheet = empty();
    heading::draw(&mut sheet, title(growing.goal), &facts);
    let is_known = |column: usize, row: usize| growing.is_computed[row][column];
    let sampled = growing.samples.iter().filter_map(|(_, goal)| *goal);
    let shades = Shades::of(goals(map, is_known).chain(sampled));
    let (x, y) = draw_panel(&mut sheet, map, &shades, |column, row| {
        match is_known(column, row) {
            true => shades.cell(map, column, row),
            false => PAPER,
        }
    });
    for ([across, up], goal) in &growing.samples {
        let up = match map.y_path {
            Some(_) => y.at(*up),
            None => (PANEL.top + PANEL.bottom) / 2.0,
        };
        let inside = goal.map_or(PAPER, |rpm| shades.colour(rpm));
        sheet.ring([x.at(*across), up], 6.0, Stroke::solid(INK, 1.0), inside);
    }
    sheet
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::tidy::{assert_tidy, texts};
    use crate::report::{GoalEntry, MapEntry};

    /// Three of six cells and two samples are computed; for one sample there is no saw.
    #[test]
    fn what_is_not_computed_yet_is_left_white_and_what_is_known_is_counted() {
        let mut growing = GrowingMapEntry {
            goal: GoalEntry::FlutterSpeed,
            map: MapEntry {
                x_path: "guides[0].radius_m".into(),
                x: vec![0.2, 0.25, 0.3],
                y_path: Some("guides[0].stiffness_n_per_m".into()),
                y: vec![1e6, 1e8],
                goal_rpm: vec![vec![Some(2000.0), Some(2300.0), None], vec![None; 3]],
                kept: vec![vec![true, true, false], vec![false; 3]],
            },
            is_computed: vec![vec![true; 3], vec![false; 3]],
            samples: vec![([0.22, 1e7], Some(2100.0)), ([0.27, 2e7], None)],
        };
        let told = |growing: &GrowingMapEntry| {
            let sheet = sheet(growing);
            assert_tidy(&sheet);
            let all: Vec<String> = texts(&sheet)
                .iter()
                .map(|(_, text)| text.to_string())
                .collect();
            all.join("|")
        };
        assert!(told(&growing).contains("so far: 3 of 6 saws of the map"));
        growing.is_computed = vec![vec![false; 3]; 2];
        assert!(told(&growing).contains("so far: 2 samples"));
    }
}
