//! Names, units and usual ranges of the numbers of a scene.

use serde::Serialize;

/// Name, unit and usual range of a number of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Quantity {
    /// JSON path, with `[]` for any index of a list.
    pub path: &'static str,
    /// Name, used in axis labels and tables.
    pub name: &'static str,
    /// Unit; empty for a dimensionless number.
    pub unit: &'static str,
    /// Range that includes all saws in use. Zero is always accepted, because it means that the feature is
    /// absent.
    pub usual: (f64, f64),
    /// Kind, which determines how the number varies in production and in searches.
    pub kind: Kind,
}

/// Kind of a number. Each kind has its own tolerances of production and its own usual bounds of a search.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Radius of a guide, anywhere on the blade.
    GuideRadius,
    /// Radius of anything but a guide.
    Radius,
    /// Angle of a guide, a force, the cut or the probe.
    Angle,
    /// Stiffness of a contact, known by its power of ten.
    Stiffness,
    /// Damping of a contact, known by its power of ten.
    Damping,
    /// Gap of a guide.
    Gap,
    /// Any other number.
    Other,
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
        kind: Kind::Other,
    }
}

impl Quantity {
    const fn of_kind(self, kind: Kind) -> Self {
        Quantity { kind, ..self }
    }
}

/// All numbers that a scene may contain, in the order of the schema. The ranges include all machines that are
/// built: diameters from 50 mm (slitting saws) to 4 m (stone saws), materials from aluminium to tungsten
/// carbide, guides from felt to steel.
#[rustfmt::skip]
pub const QUANTITIES: [Quantity; 98] = [
    q("blade.outer_diameter_m", "outer diameter", "m", 0.04, 5.0),
    q("blade.inner_diameter_m", "bore diameter", "m", 0.003, 2.0),
    q("blade.thickness_m", "thickness of the blade", "m", 1e-4, 0.04),
    q("blade.profile[].radius_m", "radius", "m", 1e-3, 2.5).of_kind(Kind::Radius),
    q("blade.profile[].thickness_m", "thickness", "m", 1e-4, 0.04),
    q("blade.teeth", "number of teeth", "", 1.0, 1000.0),
    q("blade.rim.mass_per_tooth_kg", "mass of a tooth", "kg", 1e-6, 10.0),
    q("blade.rim.radius_m", "radius of the mass of teeth", "m", 0.02, 2.5).of_kind(Kind::Radius),
    q("blade.material.youngs_modulus_pa", "Young's modulus", "Pa", 4e10, 7.5e11),
    q("blade.material.poisson_ratio", "Poisson's ratio", "", 0.15, 0.45),
    q("blade.material.density_kg_per_m3", "density", "kg/m³", 2e3, 2e4),
    q("mount.diameter_m", "collar diameter", "m", 0.01, 3.0),
    q("guides[].radius_m", "radius of the guide", "m", 0.005, 2.5).of_kind(Kind::GuideRadius),
    q("guides[].angle_deg", "angle of the guide", "°", -360.0, 360.0).of_kind(Kind::Angle),
    q("guides[].radial_length_m", "radial length of the guide", "m", 1e-4, 1.0),
    q("guides[].tangential_length_m", "tangential length of the guide", "m", 1e-4, 1.0),
    q("guides[].stiffness_n_per_m", "stiffness of the guide", "N/m", 2.5e4, 1e10).of_kind(Kind::Stiffness),
    q("guides[].damping_n_s_per_m", "damping of the guide", "N·s/m", 1e-2, 1e6).of_kind(Kind::Damping),
    q("guides[].gap_m", "gap of the guide", "m", 1e-6, 5e-3).of_kind(Kind::Gap),
    q("guides[].film_stiffness_n_per_m", "stiffness within the gap of the guide", "N/m", 10.0, 1e10),
    q("guides[].offset_m", "offset of the guide", "m", -5e-3, 5e-3),
    q("damping.material_retardation_time_s", "retardation time of the material", "s", 1e-10, 1e-2),
    q("damping.loss_factor", "loss factor of the blade", "", 1e-6, 0.3),
    q("damping.mode_ratios[].diameters", "number of nodal diameters", "", 0.0, 60.0),
    q("damping.mode_ratios[].damping_ratio", "damping ratio", "", 1e-6, 0.15),
    q("damping.air_n_s_per_m3", "air damping", "N·s/m³", 1e-3, 1e5),
    q("damping.air_rotation_share", "speed of the air over that of the blade", "", 0.0, 1.0),
    q("membrane.temperature.expansion_per_k", "thermal expansion", "1/K", 3e-6, 3e-5),
    q("membrane.temperature.rim_rise_k", "temperature rise of the rim", "K", -200.0, 600.0),
    q("membrane.temperature.from_radius_m", "radius where the rise begins", "m", 1e-3, 2.5),
    q("membrane.temperature.exponent", "exponent of the rise", "", 0.1, 20.0),
    q("membrane.temperature.table[].radius_m", "radius", "m", 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.temperature.table[].rise_k", "temperature rise", "K", -200.0, 600.0),
    q("membrane.roll_tension[].radius_m", "radius of the rolled band", "m", 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.roll_tension[].width_m", "width of the rolled band", "m", 1e-4, 1.0),
    q("membrane.roll_tension[].eigenstrain", "rolling strain", "", -0.02, 0.02),
    q("membrane.roll_tension[].groove_depth_m", "depth of the rolled groove", "m", 1e-7, 5e-4),
    q("membrane.residual_stress[].radius_m", "radius", "m", 1e-3, 2.5).of_kind(Kind::Radius),
    q("membrane.residual_stress[].hoop_pa", "hoop stress", "Pa", -3e9, 3e9),
    q("membrane.residual_stress[].radial_pa", "radial stress", "Pa", -3e9, 3e9),
    q("membrane.straight_edge.length_m", "length of the straight edge", "m", 0.02, 5.0),
    q("membrane.straight_edge.support_radius_m", "radius of the supports", "m", 0.01, 2.5).of_kind(Kind::Radius),
    q("membrane.straight_edge.measured_gap_m", "light gap", "m", -0.02, 0.02),
    q("spline.teeth", "number of spline teeth", "", 1.0, 200.0),
    q("spline.pressure_angle_deg", "pressure angle", "°", 5.0, 60.0),
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
    q("cut.angle_deg", "angle of the cut", "°", -360.0, 360.0).of_kind(Kind::Angle),
    q("cut.depth_m", "depth of cut", "m", 1e-4, 3.0),
    q("cut.teeth_in_cut", "teeth in the cut", "", 1.0, 1000.0),
    q("cut.tangential_n_per_tooth", "tangential force on a tooth", "N", -1e5, 1e5),
    q("cut.radial_n_per_tooth", "radial force on a tooth", "N", -1e5, 1e5),
    q("cut.lateral_n_per_tooth", "lateral force on a tooth", "N", -1e5, 1e5),
    q("cut.power_w", "power of the cut", "W", 100.0, 2e6),
    q("cut.feed_m_per_s", "feed", "m/s", 1e-5, 10.0),
    q("cut.board_length_m", "length of the board", "m", 0.01, 50.0),
    q("cut.idle_s", "time before and after the cut", "s", 0.0, 600.0),
    q("cut.chart_rpm", "speed of the cut in the diagram", "rpm", 30.0, 6e4),
    q("cut.wood.stiffness_n_per_m", "stiffness of the wood", "N/m", 1.0, 1e9).of_kind(Kind::Stiffness),
    q("cut.wood.damping_n_s_per_m", "damping of the wood", "N·s/m", 1e-3, 1e6).of_kind(Kind::Damping),
    q("cut.wood.depth_m", "depth of the contact with the wood", "m", 1e-4, 2.0),
    q("cut.wood.arc_deg", "arc of the contact with the wood", "°", 1.0, 360.0),
    q("cut.washboarding.stiffness_n_per_m", "lateral cutting stiffness", "N/m", 10.0, 1e8).of_kind(Kind::Stiffness),
    q("cut.washboarding.overlap", "overlap with the preceding tooth", "", 0.0, 1.0),
    q("cut.washboarding.arc_deg", "arc of the teeth in the cut", "°", 1.0, 360.0),
    q("cut.washboarding.pitches_deg[]", "pitch of a tooth", "°", 0.3, 360.0),
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
    q("runup.angle_deg", "angle of the force", "°", -360.0, 360.0).of_kind(Kind::Angle),
    q("response.force_n", "lateral force", "N", -1e5, 1e5),
    q("response.radius_m", "radius of the force", "m", 0.005, 2.5).of_kind(Kind::Radius),
    q("response.angle_deg", "angle of the force", "°", -360.0, 360.0).of_kind(Kind::Angle),
    q("response.runout_m", "run-out of the rim", "m", 1e-6, 5e-3),
    q("response.flatness_m", "lack of flatness at the rim", "m", 1e-6, 5e-3),
    q("response.imbalance_kg_m2", "imbalance beside the middle plane", "kg·m²", 1e-9, 1.0),
    q("response.tooth_force_n", "lateral force with tooth passing", "N", -1e4, 1e4),
    q("probe.radius_m", "radius of the probe", "m", 0.005, 2.5).of_kind(Kind::Radius),
    q("probe.angle_deg", "angle of the probe", "°", -360.0, 360.0).of_kind(Kind::Angle),
    q("measured.rows[].rpm", "rotation speed", "rpm", 0.0, 1e5),
    q("measured.rows[].frequencies_hz[]", "frequency", "Hz", 0.0, 1e5),
];

impl Quantity {
    /// The quantity of a path such as `guides[0].radius_m`; `None` if scenes have no such number.
    pub fn of(path: &str) -> Option<&'static Self> {
        let general = general(path);
        QUANTITIES.iter().find(|quantity| quantity.path == general)
    }

    /// The kind of the number at a path.
    pub fn kind_of(path: &str) -> Kind {
        Self::of(path).map_or(Kind::Other, |quantity| quantity.kind)
    }

    /// Whether a value is zero or in the usual range.
    pub fn is_usual(&self, value: f64) -> bool {
        value == 0.0 || (self.usual.0..=self.usual.1).contains(&value)
    }
}

/// A path with `[]` for the index of a list.
pub(super) fn general(path: &str) -> String {
    let mut general = String::new();
    let mut inside = false;
    for character in path.chars() {
        inside &= character != ']';
        if !inside {
            general.push(character);
        }
        inside |= character == '[';
    }
    general
}

#[cfg(test)]
mod tests {
    use serde_json::Value;

    use super::*;
    use crate::scene::json_schema;

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
    fn kinds_follow_from_the_last_key_and_from_guides() {
        let kinds = [
            ("guides[2].radius_m", Kind::GuideRadius),
            ("probe.radius_m", Kind::Radius),
            ("cut.angle_deg", Kind::Angle),
            ("cut.wood.stiffness_n_per_m", Kind::Stiffness),
            ("guides[0].damping_n_s_per_m", Kind::Damping),
            ("blade.thickness_m", Kind::Other),
        ];
        for (path, kind) in kinds {
            assert_eq!(Quantity::kind_of(path), kind, "{path}");
        }
        // A number that is added to the table has the kind of those with the same last key.
        for (k, one) in QUANTITIES.iter().enumerate() {
            let last = |quantity: &Quantity| quantity.path.rsplit('.').next();
            let is_guide = |quantity: &Quantity| quantity.kind == Kind::GuideRadius;
            let alike = QUANTITIES[..k]
                .iter()
                .filter(|other| last(other) == last(one));
            for other in alike.filter(|other| !is_guide(other) && !is_guide(one)) {
                assert_eq!(one.kind, other.kind, "{} {}", one.path, other.path);
            }
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
}
