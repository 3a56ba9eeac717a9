//! What the numbers of a scene are, in which unit, and between which values those of saws lie.

use serde::Serialize;
use serde_json::Value;

use super::SceneFile;

/// A number of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quantity {
    /// Its JSON path, with `[]` for any place in a list.
    pub path: &'static str,
    /// What it is, as an axis or a table calls it.
    pub name: &'static str,
    /// Its unit as it is written; empty for a mere number.
    pub unit: &'static str,
    /// Between which values those of all saws lie, generously. Zero is always a number of none.
    pub usual: (f64, f64),
}

const fn q(
    path: &'static str,
    name: &'static str,
    unit: &'static str,
    from: f64,
    to: f64,
) -> Quantity {
    Quantity {
        path,
        name,
        unit,
        usual: (from, to),
    }
}

/// Every number that a scene may have, in the order of the schema. The bounds are those of
/// machines that are built: from slitting saws of 50 mm to saws for stone of 4 m, from aluminium
/// to tungsten carbide, from a felt pad to a steel one.
#[rustfmt::skip]
pub const QUANTITIES: [Quantity; 82] = [
    q("blade.outer_diameter_m", "outer diameter", "m", 0.04, 5.0),
    q("blade.inner_diameter_m", "bore diameter", "m", 0.003, 2.0),
    q("blade.thickness_m", "thickness of the blade", "m", 1e-4, 0.04),
    q("blade.profile[].radius_m", "radius", "m", 1e-3, 2.5),
    q("blade.profile[].thickness_m", "thickness", "m", 1e-4, 0.04),
    q("blade.teeth", "number of teeth", "", 1.0, 1000.0),
    q("blade.rim.mass_per_tooth_kg", "mass of a tooth", "kg", 1e-6, 10.0),
    q("blade.rim.radius_m", "radius of the mass of teeth", "m", 0.02, 2.5),
    q("blade.material.youngs_modulus_pa", "Young's modulus", "Pa", 4e10, 7.5e11),
    q("blade.material.poisson_ratio", "Poisson's ratio", "", 0.15, 0.45),
    q("blade.material.density_kg_per_m3", "density", "kg/m³", 2e3, 2e4),
    q("mount.diameter_m", "collar diameter", "m", 0.01, 3.0),
    q("guides[].radius_m", "radius of the guide", "m", 0.005, 2.5),
    q("guides[].angle_deg", "angle of the guide", "°", -360.0, 360.0),
    q("guides[].radial_length_m", "radial length of the guide", "m", 1e-4, 1.0),
    q("guides[].tangential_length_m", "tangential length of the guide", "m", 1e-4, 1.0),
    q("guides[].stiffness_n_per_m", "stiffness of the guide", "N/m", 2.5e4, 1e10),
    q("guides[].damping_n_s_per_m", "damping of the guide", "N·s/m", 1e-2, 1e6),
    q("guides[].gap_m", "gap of the guide", "m", 1e-6, 5e-3),
    q("damping.material_retardation_time_s", "retardation time of the material", "s", 1e-10, 1e-2),
    q("damping.air_n_s_per_m3", "air damping", "N·s/m³", 1e-3, 1e5),
    q("damping.air_rotation_share", "speed of the air over that of the blade", "", 0.0, 1.0),
    q("membrane.temperature.expansion_per_k", "thermal expansion", "1/K", 3e-6, 3e-5),
    q("membrane.temperature.rim_rise_k", "temperature rise of the rim", "K", -200.0, 600.0),
    q("membrane.temperature.from_radius_m", "radius where the rise begins", "m", 1e-3, 2.5),
    q("membrane.temperature.exponent", "exponent of the rise", "", 0.1, 20.0),
    q("membrane.temperature.table[].radius_m", "radius", "m", 1e-3, 2.5),
    q("membrane.temperature.table[].rise_k", "temperature rise", "K", -200.0, 600.0),
    q("membrane.roll_tension[].radius_m", "radius of the rolled band", "m", 1e-3, 2.5),
    q("membrane.roll_tension[].width_m", "width of the rolled band", "m", 1e-4, 1.0),
    q("membrane.roll_tension[].eigenstrain", "rolling strain", "", -0.02, 0.02),
    q("membrane.residual_stress[].radius_m", "radius", "m", 1e-3, 2.5),
    q("membrane.residual_stress[].hoop_pa", "hoop stress", "Pa", -3e9, 3e9),
    q("membrane.residual_stress[].radial_pa", "radial stress", "Pa", -3e9, 3e9),
    q("spline.teeth", "number of spline teeth", "", 1.0, 200.0),
    q("spline.pressure_angle_deg", "pressure angle", "°", 0.0, 60.0),
    q("spline.contact_stiffness_n_per_m_3_2", "contact stiffness", "N/m^(3/2)", 1e3, 1e14),
    q("spline.contact_damping_n_s_3_2_per_m_3_2", "contact damping", "N·(s/m)^(3/2)", 1e-3, 1e9),
    q("spline.clearance_m", "clearance of the spline", "m", 1e-7, 0.02),
    q("spline.pitch_radius_m", "pitch radius of the spline", "m", 1e-3, 1.0),
    q("spline.weight_angle_deg", "direction of the weight", "°", -360.0, 360.0),
    q("operating_rpm", "operating speed", "rpm", 30.0, 6e4),
    q("excitation.orders", "largest multiple of the speed", "", 0.0, 60.0),
    q("excitation.tooth_passing", "largest multiple of tooth passing", "", 0.0, 10.0),
    q("sweep.from_rpm", "first speed of the sweep", "rpm", 0.0, 1e5),
    q("sweep.to_rpm", "last speed of the sweep", "rpm", 30.0, 2e5),
    q("flutter_threshold_per_s", "growth rate that counts as flutter", "1/s", 1e-6, 1e3),
    q("tolerance", "tolerance", "", 0.0, 1.0),
    q("cut.angle_deg", "angle of the cut", "°", -360.0, 360.0),
    q("cut.depth_m", "depth of cut", "m", 1e-4, 3.0),
    q("cut.teeth_in_cut", "teeth in the cut", "", 1.0, 1000.0),
    q("cut.tangential_n_per_tooth", "tangential force on a tooth", "N", -1e5, 1e5),
    q("cut.radial_n_per_tooth", "radial force on a tooth", "N", -1e5, 1e5),
    q("cut.lateral_n_per_tooth", "lateral force on a tooth", "N", -1e5, 1e5),
    q("cut.power_w", "power of the cut", "W", 100.0, 2e6),
    q("cut.feed_m_per_s", "feed", "m/s", 1e-5, 10.0),
    q("cut.board_length_m", "length of the board", "m", 0.01, 50.0),
    q("cut.idle_s", "time before and after the cut", "s", 0.0, 600.0),
    q("cut.chart_rpm", "speed of the cut of the chart", "rpm", 30.0, 6e4),
    q("cut.wood.stiffness_n_per_m", "stiffness of the wood", "N/m", 1.0, 1e9),
    q("cut.wood.damping_n_s_per_m", "damping of the wood", "N·s/m", 1e-3, 1e6),
    q("cut.wood.depth_m", "depth of the contact with the wood", "m", 1e-4, 2.0),
    q("cut.wood.arc_deg", "arc of the contact with the wood", "°", 0.01, 360.0),
    q("cut.washboarding.stiffness_n_per_m", "lateral cutting stiffness", "N/m", 10.0, 1e8),
    q("cut.washboarding.overlap", "overlap with the tooth before", "", 0.0, 1.0),
    q("cut.washboarding.arc_deg", "arc of the teeth in the cut", "°", 0.01, 360.0),
    q("cut.washboarding.pitches_deg[]", "pitch of a tooth", "°", 0.1, 360.0),
    q("cut.speeds[].rpm", "speed of the cut", "rpm", 30.0, 6e4),
    q("cut.speeds[].tangential_n_per_tooth", "tangential force on a tooth", "N", -1e5, 1e5),
    q("cut.speeds[].radial_n_per_tooth", "radial force on a tooth", "N", -1e5, 1e5),
    q("cut.speeds[].lateral_n_per_tooth", "lateral force on a tooth", "N", -1e5, 1e5),
    q("cut.speeds[].power_w", "power of the cut", "W", 100.0, 2e6),
    q("cut.speeds[].feed_m_per_s", "feed", "m/s", 1e-5, 10.0),
    q("runup.from_rpm", "first speed of the run-up", "rpm", 0.0, 1e5),
    q("runup.to_rpm", "last speed of the run-up", "rpm", 30.0, 2e5),
    q("runup.duration_s", "duration of the run-up", "s", 0.0, 3600.0),
    q("runup.force_n", "lateral force", "N", -1e5, 1e5),
    q("runup.angle_deg", "angle of the force", "°", -360.0, 360.0),
    q("probe.radius_m", "radius of the probe", "m", 0.005, 2.5),
    q("probe.angle_deg", "angle of the probe", "°", -360.0, 360.0),
    q("measured.rows[].rpm", "rotation speed", "rpm", 0.0, 1e5),
    q("measured.rows[].frequencies_hz[]", "frequency", "Hz", 0.0, 1e5),
];

/// What people write instead, and what one of it is in the unit of the quantity: in the order in
/// which it is asked about.
const MISTAKEN: [(&str, &str, f64); 14] = [
    ("m", "mm", 1e-3),
    ("m", "cm", 1e-2),
    ("m", "inches", 0.0254),
    ("kg", "g", 1e-3),
    ("kg/m³", "g/cm³", 1e3),
    ("kg/m³", "kg/mm³", 1e9),
    ("kg/m³", "t/mm³", 1e12),
    ("Pa", "GPa", 1e9),
    ("Pa", "MPa", 1e6),
    ("N/m", "N/mm", 1e3),
    ("rpm", "thousands of rpm", 1e3),
    ("rpm", "turns per second", 60.0),
    ("W", "kW", 1e3),
    ("m/s", "m/min", 1.0 / 60.0),
];

impl Quantity {
    /// The quantity of a path as errors write it, like `guides[0].radius_m`.
    pub fn of(path: &str) -> Option<&'static Self> {
        let mut general = String::new();
        let mut inside = false;
        for character in path.chars() {
            inside &= character != ']';
            if !inside {
                general.push(character);
            }
            inside |= character == '[';
        }
        QUANTITIES.iter().find(|quantity| quantity.path == general)
    }

    /// Whether a saw may have this value.
    pub fn is_usual(&self, value: f64) -> bool {
        value == 0.0 || (self.usual.0..=self.usual.1).contains(&value)
    }

    /// The unit that makes a saw's number of an unusual one, and that number.
    fn mistaken(&self, value: f64) -> Option<(&'static str, f64)> {
        let of_unit = MISTAKEN.iter().filter(|(own, _, _)| *own == self.unit);
        let mut meant = of_unit.map(|(_, unit, factor)| (*unit, value * factor));
        meant.find(|(_, value)| self.is_usual(*value))
    }

    fn remark(&self, path: &str, value: f64) -> String {
        let (unit, (from, to)) = (self.unit, self.usual);
        let space = if unit.is_empty() { "" } else { " " };
        let remedy = match self.mistaken(value) {
            Some((other, meant)) => {
                let meant = short(meant);
                format!("are these {other}? That would be {meant}{space}{unit}")
            }
            None => "is it in the unit that ends the key's name?".into(),
        };
        let [value, from, to] = [value, from, to].map(short);
        format!(
            "{path} is {value}{space}{unit}, but those of saws lie between {from} and \
             {to}{space}{unit}; {remedy}"
        )
    }
}

/// A number as people write it, without what rounding adds.
fn short(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    match rounded != 0.0 && !(1e-4..1e6).contains(&rounded.abs()) {
        true => format!("{rounded:e}"),
        false => rounded.to_string(),
    }
}

/// What to say of a number that no saw has, called `label`, of the quantity of a path.
pub fn unusual_number(label: &str, path: &str, value: f64) -> Option<String> {
    let quantity = Quantity::of(path).filter(|quantity| !quantity.is_usual(value))?;
    Some(quantity.remark(label, value))
}

/// A number that no saw has, and what it would be in the unit that it looks like.
struct Unusual {
    path: String,
    value: f64,
    meant: f64,
}

/// What to say of the numbers of a scene that no saw has: a line each, and one for all that look
/// like the same other unit.
pub fn unusual(scene: &SceneFile) -> Vec<String> {
    let json = serde_json::to_value(scene).expect("numbers of a scene are finite");
    let mut numbers = Vec::new();
    leaves(&json, String::new(), &mut numbers);
    let mut of_unit: Vec<(&str, Vec<Unusual>)> = Vec::new();
    let mut remarks = Vec::new();
    for (path, value) in numbers {
        let Some(quantity) = Quantity::of(&path).filter(|q| !q.is_usual(value)) else {
            continue;
        };
        let Some((unit, meant)) = quantity.mistaken(value) else {
            remarks.push(quantity.remark(&path, value));
            continue;
        };
        let one = Unusual { path, value, meant };
        match of_unit.iter_mut().find(|(known, _)| *known == unit) {
            Some((_, all)) => all.push(one),
            None => of_unit.push((unit, vec![one])),
        }
    }
    let together = of_unit.into_iter().map(|(unit, all)| together(unit, &all));
    together.chain(remarks).collect()
}

fn together(unit: &str, all: &[Unusual]) -> String {
    if let [Unusual { path, value, .. }] = all {
        return unusual_number(path, path, *value).unwrap_or_default();
    }
    let each = all.iter().map(|one| {
        let (value, meant) = (short(one.value), short(one.meant));
        format!("{} is {value} ({meant})", one.path)
    });
    let each: Vec<String> = each.collect();
    format!(
        "no saw has these numbers; are they {unit}? In brackets what that would be in the unit of \
         the key: {}",
        each.join(", ")
    )
}

/// Every number below a value, with its path.
fn leaves(value: &Value, path: String, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => found.extend(number.as_f64().map(|value| (path, value))),
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                leaves(item, format!("{path}[{index}]"), found);
            }
        }
        Value::Object(keys) => {
            for (key, item) in keys {
                let dot = if path.is_empty() { "" } else { "." };
                leaves(item, format!("{path}{dot}{key}"), found);
            }
        }
        _ => (),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Scene, json_schema};

    /// Paths of every number that a schema allows.
    fn numbers(schema: &Value, node: &Value, path: &str, found: &mut Vec<String>) {
        if let Some(name) = node["$ref"].as_str() {
            let target = schema.pointer(name.trim_start_matches('#'));
            numbers(schema, target.expect("a definition"), path, found);
        }
        let kind = &node["type"];
        let kinds = kind.as_array().cloned().unwrap_or(vec![kind.clone()]);
        if kinds
            .iter()
            .any(|kind| kind == "number" || kind == "integer")
        {
            found.push(path.to_owned());
        }
        for word in ["anyOf", "oneOf", "allOf"] {
            for one in node[word].as_array().into_iter().flatten() {
                numbers(schema, one, path, found);
            }
        }
        if !node["items"].is_null() {
            numbers(schema, &node["items"], &format!("{path}[]"), found);
        }
        for (key, below) in node["properties"].as_object().into_iter().flatten() {
            let dot = if path.is_empty() { "" } else { "." };
            numbers(schema, below, &format!("{path}{dot}{key}"), found);
        }
    }

    #[test]
    fn the_table_has_the_numbers_of_the_schema_and_no_others() {
        let schema = json_schema();
        let mut of_schema = Vec::new();
        numbers(&schema, &schema, "", &mut of_schema);
        let mut of_table: Vec<String> = QUANTITIES.iter().map(|q| q.path.to_owned()).collect();
        of_schema.sort();
        of_table.sort();
        assert_eq!(of_table, of_schema);
    }

    #[test]
    fn a_quantity_is_found_by_the_path_of_an_error() {
        let radius = Quantity::of("guides[12].radius_m").unwrap();
        assert_eq!((radius.name, radius.unit), ("radius of the guide", "m"));
        assert!(Quantity::of("measured.rows[0].frequencies_hz[3]").is_some());
        assert!(Quantity::of("guides[0]").is_none());
    }

    #[test]
    fn numbers_in_other_units_are_recognized() {
        let file = Scene::paper().file().clone();
        assert_eq!(unusual(&file), [""; 0]);
        let mut density = file.clone();
        density.blade.material.density_kg_per_m3 = 7.8;
        let remark = unusual(&density).join("\n");
        assert!(
            remark.contains("density_kg_per_m3 is 7.8 kg/m³"),
            "{remark}"
        );
        assert!(
            remark.contains("g/cm³? That would be 7800 kg/m³"),
            "{remark}"
        );
        let mut stiffness = file.clone();
        stiffness.guides[0].stiffness_n_per_m = 2e4;
        let remark = unusual(&stiffness).join("\n");
        assert!(remark.contains("N/mm? That would be 2e7 N/m"), "{remark}");
        let remark = unusual_number("--operating-rpm", "operating_rpm", 1.25).unwrap();
        assert!(
            remark.contains("thousands of rpm? That would be 1250 rpm"),
            "{remark}"
        );
        assert_eq!(
            unusual_number("--operating-rpm", "operating_rpm", 1250.0),
            None
        );
    }

    #[test]
    fn a_scene_wholly_in_millimetres_gets_one_remark() {
        let mut file = Scene::paper().file().clone();
        file.blade.outer_diameter_m *= 1e3;
        file.blade.inner_diameter_m *= 1e3;
        file.blade.thickness_m *= 1e3;
        file.guides[0].radius_m *= 1e3;
        let remarks = unusual(&file);
        assert_eq!(remarks.len(), 1, "{remarks:?}");
        for part in [
            "are they mm?",
            "outer_diameter_m is 710 (0.71)",
            "thickness_m is 2.8 (0.0028)",
        ] {
            assert!(remarks[0].contains(part), "no {part:?} in {remarks:?}");
        }
    }
}
