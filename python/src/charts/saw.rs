//! A saw in axial view.

use pyo3::prelude::*;
use sawflutter::model::scene::{Scene, SceneFile};
use sawflutter::page::figure::{AxisData, ChartData, Hue, Item, Line, PanelData, Points};
use sawflutter::page::text::shown_to;

use super::written;
use crate::arguments;

/// Arc of the cut where the scene gives no number of teeth in it, and ends of the arrow of the rotation, in degrees.
const CUT_DEG: f64 = 12.0;
const ARROW_DEG: [f64; 2] = [20.0, 60.0];
/// Points of a circle.
const CIRCLE: u32 = 180;

/// A scene in axial view: blade, guides, cut and probe, and the positive directions of angles and rotation.
#[pyfunction]
pub fn saw_chart(scene: &str) -> PyResult<String> {
    let scene = arguments::scene(scene)?;
    let file = scene.file();
    let rim = 0.5 * file.blade.outer_diameter_m;
    let frame = [-1.2 * rim, 1.2 * rim];
    let panel = PanelData {
        equal: true,
        ..PanelData::new(
            AxisData::new("x, angle 0 to the right", "m").within(frame),
            AxisData::new("y", "m").within(frame),
            saw_items(file, collar_m(&scene), rim),
        )
    };
    let facts = vec![
        format!(
            "{} mm outside",
            shown_to(6, 1e3 * file.blade.outer_diameter_m)
        ),
        format!("{} guides", file.guides.len()),
    ];
    written(&ChartData::new(&file.name, facts, vec![panel]))
}

fn saw_items(file: &SceneFile, collar_m: Option<f64>, rim: f64) -> Vec<Item> {
    let circle = |radius, colour, name| Item::Line(arc(radius, [0.0, 360.0], colour, name));
    let mut items = vec![
        circle(rim, Hue::Ink, "rim"),
        circle(0.5 * file.blade.inner_diameter_m, Hue::Ink, "bore"),
    ];
    items.extend(collar_m.map(|radius| circle(radius, Hue::Quiet, "collar")));
    for (place, guide) in file.guides.iter().enumerate() {
        let corners = guide.outline_m();
        let closed: Vec<_> = corners.iter().chain(corners.first()).copied().collect();
        let (name, mm) = (
            format!("guides[{place}]"),
            shown_to(4, 1e3 * guide.radius_m),
        );
        let (angle, stiffness) = (guide.angle_deg, shown_to(4, guide.stiffness_n_per_m));
        let said = format!("{name}\n{mm} mm, {angle}°\n{stiffness} N/m");
        items.push(Item::Line(Line {
            said: vec![said; closed.len()],
            ..Line::new(closed, Hue::Forward, &name)
        }));
    }
    if let Some(cut) = &file.cut {
        let teeth = cut.teeth_in_cut.zip(file.blade.teeth.filter(|of| *of > 0));
        let half = match (teeth, cut.depth_m) {
            (Some((teeth, of)), _) => 180.0 * f64::from(teeth) / f64::from(of),
            (None, Some(depth)) => 0.5 * (depth / rim).to_degrees(),
            (None, None) => 0.5 * CUT_DEG,
        };
        let ends = [cut.angle_deg - half, cut.angle_deg + half];
        items.push(Item::Line(Line {
            width: 4.0,
            end: "cut".to_owned(),
            ..arc(rim, ends, Hue::Alarm, "cut")
        }));
    }
    if let Some(probe) = &file.probe {
        let at = polar(probe.radius_m.unwrap_or(rim), probe.angle_deg);
        items.push(Item::Points(Points::new([at], Hue::Backward, 7.0, "probe")));
    }
    let radius = 1.08 * rim;
    let head = [(0.97, 4.0), (1.0, 0.0), (1.03, 4.0)];
    let head = head.map(|(share, before)| polar(share * radius, ARROW_DEG[1] - before));
    items.push(Item::Line(Line {
        end: "rotation, positive angles".to_owned(),
        ..arc(radius, ARROW_DEG, Hue::Quiet, "rotation")
    }));
    items.push(Item::Line(Line::new(head, Hue::Quiet, "rotation")));
    items
}

fn arc(radius_m: f64, [begin, end]: [f64; 2], colour: Hue, name: &str) -> Line {
    let step = (end - begin) / f64::from(CIRCLE);
    let places = (0..=CIRCLE).map(|k| polar(radius_m, begin + f64::from(k) * step));
    Line::new(places, colour, name)
}

fn polar(radius_m: f64, angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    [radius_m * cos, radius_m * sin]
}

/// Radius of the edge of a collar or flange; none on a spline.
fn collar_m(scene: &Scene) -> Option<f64> {
    let bore_m = 0.5 * scene.file().blade.inner_diameter_m;
    let inner_m = scene.blade().inner_radius_m;
    (inner_m > bore_m).then_some(inner_m)
}
