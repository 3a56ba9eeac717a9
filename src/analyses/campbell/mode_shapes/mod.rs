//! Shapes of the blade at critical speeds, in bands and at single speeds, seen along the axis.

mod blade;

use super::{EventShape, Report, ShapeOccasion};
use crate::model::scene::SceneFile;
use crate::page::figure::canvas::{Anchor, Lettering, Sheet};
use crate::page::figure::heading;
use crate::page::figure::items::{Heat, Item};
use crate::page::figure::key;
use crate::page::figure::palette::Hue;
use crate::page::figure::style::{
    BETWEEN_FACTS, INK, LABEL_SIZE, MARGIN, QUIET, Weight, broken, shorten,
};
use crate::page::figure::tidiness::tidy;
use blade::{GUIDE_WIDTH, NODAL_WIDTH, SLOT_WIDTH, colour};

/// Number of panels in a row.
const COLUMNS: usize = 4;
/// Largest number of panels of a figure.
const MOST: usize = 16;
/// Width and height of a panel.
const PANEL: [f64; 2] = [266.0, 352.0];
/// Height and largest number of lines of the name of a shape.
const LINE: f64 = 16.0;
const LINES: usize = 2;
const TOP: f64 = 86.0;
const BELOW: f64 = 56.0;
/// Largest number of harmonics listed below a shape.
const NAMED: usize = 3;
/// Smallest share of a harmonic in this list.
const LEAST_NAMED: f64 = 0.01;

/// Draws a panel for each shape; `None` if the report contains no shapes.
pub fn sheet(report: &Report) -> Option<Sheet> {
    let shown = shown(&report.shapes);
    if shown.is_empty() {
        return None;
    }
    let rows = shown.len().div_ceil(COLUMNS);
    let width = COLUMNS as f64 * PANEL[0] + 2.0 * MARGIN;
    let height = TOP + rows as f64 * PANEL[1] + BELOW;
    let mut sheet = Sheet::new(width as u32, height as u32);
    heading::draw(&mut sheet, &report.scene.name, &facts(report, shown.len()));
    for (place, shape) in shown.iter().enumerate() {
        let (column, row) = ((place % COLUMNS) as f64, (place / COLUMNS) as f64);
        let corner = [MARGIN + column * PANEL[0], TOP + row * PANEL[1]];
        panel(&mut sheet, corner, report, shape);
    }
    let at = [MARGIN, height - 38.0];
    let samples = samples(&report.scene);
    key::draw(&mut sheet, &samples, at, width - 2.0 * MARGIN);
    Some(tidy(sheet))
}

/// The shapes that fit into the figure. If not all of them fit, critical speeds and bands are omitted before the
/// operating speed and requested speeds.
fn shown(shapes: &[EventShape]) -> Vec<&EventShape> {
    let is_event = |shape: &&EventShape| {
        !matches!(
            shape.occasion,
            ShapeOccasion::OperatingSpeed | ShapeOccasion::AskedSpeed
        )
    };
    let (events, singles): (Vec<_>, Vec<_>) = shapes.iter().partition(is_event);
    let room = MOST.saturating_sub(singles.len());
    events
        .into_iter()
        .take(room)
        .chain(singles)
        .take(MOST)
        .collect()
}

fn facts(report: &Report, shown: usize) -> String {
    let mut facts = vec![
        report.condition.clone(),
        "deflection seen along the axis, in units of its largest".to_owned(),
        "rotation counterclockwise".to_owned(),
        "n: shares in the name".to_owned(),
    ];
    if shown < report.shapes.len() {
        let all = report.shapes.len();
        facts.push(format!("{shown} of {all} shapes; report.json has all"));
    }
    facts.join(BETWEEN_FACTS)
}

fn panel(sheet: &mut Sheet, [left, top]: [f64; 2], report: &Report, shape: &EventShape) {
    let centre = [left + 0.5 * PANEL[0], top + 54.0 + LINE + blade::RADIUS];
    blade::draw(sheet, centre, report, shape);
    let room = PANEL[0] - 14.0;
    let mut write = |y: f64, em: f64, colour, weight, text: &str| {
        let letters = Lettering {
            weight,
            ..Lettering::regular(em, colour, Anchor::Middle)
        };
        let text = shorten(text, em, weight, room);
        sheet.text([centre[0], y], letters, &text);
    };
    write(top + 14.0, 14.0, INK, Weight::SemiBold, &heading_of(shape));
    for (k, line) in name(shape, room).iter().enumerate() {
        let y = top + 33.0 + LINE * k as f64;
        write(y, LABEL_SIZE, INK, Weight::Regular, line);
    }
    let bottom = centre[1] + blade::RADIUS + 20.0;
    write(bottom, LABEL_SIZE, QUIET, Weight::Regular, &shares(shape));
    let below = bottom + 17.0;
    write(below, LABEL_SIZE, QUIET, Weight::Regular, &motion(shape));
}

/// The name of a shape in lines of a width; what does not fit into the last one is left out.
fn name(shape: &EventShape, room: f64) -> Vec<String> {
    let mut lines = broken(&shape.name, room);
    if lines.len() > LINES {
        let last = lines.split_off(LINES - 1).join(" ");
        lines.push(last);
    }
    lines
}

/// Speed and kind of a shape: "1531 rpm, critical", "2261 rpm, flutter".
fn heading_of(shape: &EventShape) -> String {
    let what = match shape.occasion {
        ShapeOccasion::CriticalSpeed => "critical",
        ShapeOccasion::Divergence => "divergence",
        ShapeOccasion::Flutter => "flutter",
        ShapeOccasion::OperatingSpeed => "operating speed",
        ShapeOccasion::AskedSpeed => "mode",
    };
    format!("{:.0} rpm, {what}", shape.rpm)
}

/// Frequency and growth: "6.01 Hz, +0.487 1/s"; empty for a wave that stands still.
fn motion(shape: &EventShape) -> String {
    let mut parts = Vec::new();
    if shape.frequency_hz > 0.0 {
        parts.push(format!("{:.2} Hz", shape.frequency_hz));
    }
    if shape.growth_per_s.abs() >= 5e-4 {
        let growth = format!("{:+.3} 1/s", shape.growth_per_s);
        parts.push(growth.replace('-', "\u{2212}"));
    }
    parts.join(", ")
}

/// Largest shares of harmonics in the name: "n = 2: 78 %, 3: 15 %".
fn shares(shape: &EventShape) -> String {
    let all = shape.harmonics.iter();
    let shares = all
        .filter(|h| h.share >= LEAST_NAMED)
        .take(NAMED)
        .map(|h| format!("{}: {:.0} %", h.nodal_diameters, 1e2 * h.share));
    format!("n = {}", shares.collect::<Vec<_>>().join(", "))
}

fn samples(scene: &SceneFile) -> Vec<Item> {
    let side = |of: f64, name| Item::Heat(Heat::class([&[], &[]], |_, _| false, colour(of), name));
    let line = |width, name| Item::line_sample(width, false, Hue::Ink, name);
    let has_guides = !scene.guides.is_empty();
    let guide = has_guides.then(|| line(GUIDE_WIDTH, "guide"));
    let is_slotted = scene.blade.slots.is_some();
    let slot = is_slotted
        .then(|| Item::line_sample(SLOT_WIDTH, false, Hue::Quiet, "slot, at this moment"));
    let nodal = "nodal line, of a wave that travels at this moment";
    [
        side(1.0, "towards the viewer"),
        side(-1.0, "away"),
        line(NODAL_WIDTH, nodal),
    ]
    .into_iter()
    .chain(slot)
    .chain(guide)
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::scene::{Accuracy, Scene, SlotsFile};
    use crate::page::figure::canvas::Mark;
    use crate::page::figure::tidiness::texts;
    use crate::stability::Analysis;

    fn report(speeds_rpm: &[f64]) -> Report {
        let scene = Scene::paper().edited(|file| file.accuracy = Accuracy::Draft);
        let analysis = Analysis::new(&scene.unwrap()).unwrap();
        let mut report = analysis.report();
        let asked: Vec<f64> = speeds_rpm
            .iter()
            .map(|rpm| crate::model::scene::rad_per_s(*rpm))
            .collect();
        report.add_shapes(&analysis, &asked).unwrap();
        report
    }

    #[test]
    fn every_event_has_a_panel_and_nothing_is_cut_off() {
        let report = report(&[1000.0]);
        let sheet = sheet(&report).unwrap();
        let all = texts(&sheet);
        // The name "4 diameters" is above, and its shares are below the shape.
        let at = all.iter().rposition(|text| *text == "4 diameters").unwrap();
        assert!(all[at + 1].starts_with("n = 4: "), "{all:?}");
        let critical = format!("{:.0} rpm, critical", report.critical_speeds[0].rpm);
        assert!(all.contains(&critical.as_str()), "{all:?}");
        assert!(all.contains(&"1000 rpm, mode"), "{all:?}");
        assert!(all.contains(&"guide"), "{all:?}");
        // The name of the two waves of a band is complete.
        let flutter = report
            .shapes
            .iter()
            .find(|s| s.occasion == ShapeOccasion::Flutter)
            .unwrap();
        let written = all.join(" ");
        assert!(
            written.contains(&flutter.name),
            "{} {written}",
            flutter.name
        );
        let mut free = report.clone();
        free.scene.guides.clear();
        free.scene.blade.slots = Some(SlotsFile {
            count: 7,
            depth_m: 0.05,
            width_m: None,
            inclination_deg: None,
            hole_diameter_m: None,
        });
        let slotted = super::sheet(&free).unwrap();
        assert!(!all.contains(&"slot, at this moment"));
        assert!(texts(&slotted).contains(&"slot, at this moment"));
        free.scene.blade.slots = None;
        let without_guides = super::sheet(&free).unwrap();
        // Each panel has seven lines more, and the key one.
        let more = slotted.marks().len() - without_guides.marks().len();
        assert!(more >= 7 * shown(&free.shapes).len(), "{more}");
        assert!(!texts(&without_guides).contains(&"guide"));
        let without = Report {
            shapes: Vec::new(),
            ..report
        };
        assert!(super::sheet(&without).is_none());
    }

    /// The tiles cover the blade: their areas sum up to that between two regular polygons.
    #[test]
    fn the_tiles_of_a_shape_cover_the_blade_once() {
        let report = report(&[]);
        let mut sheet = Sheet::new(400, 400);
        blade::draw(&mut sheet, [200.0, 200.0], &report, &report.shapes[0]);
        let twice_area = |points: &[[f64; 2]]| {
            let next = points.iter().cycle().skip(1);
            let pairs = points.iter().zip(next);
            pairs.map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>()
        };
        let tiles = sheet.marks().iter().filter_map(|mark| match mark {
            Mark::Polygon(points, _) => Some(0.5 * twice_area(points).abs()),
            _ => None,
        });
        let found: f64 = tiles.sum();
        let inner = 0.2 / 0.71 * blade::RADIUS;
        let sector = std::f64::consts::TAU / blade::ANGLES as f64;
        let polygon = 0.5 * blade::ANGLES as f64 * sector.sin();
        let expected = polygon * (blade::RADIUS.powi(2) - inner.powi(2));
        assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
    }
}
