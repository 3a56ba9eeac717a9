//! Numbers of a scene that are zero.

use sawflutter::analyses::report::{Options, report};
use sawflutter::model::scene::Scene;
use sawflutter::page::text::shown_to;

/// A pad that only damps. A percent of its stiffness changes nothing: tolerances move the first critical speed by 59 rpm, as they do
/// without the pad, in proportion to the thickness, √E and 1/√ρ.
#[test]
fn a_stiffness_of_zero_takes_nothing_of_a_margin() {
    let scene = Scene::from_json(
        r#"{"name": "damper", "accuracy": "draft", "operating_rpm": 4000, "sweep": {"from_rpm": 0, "to_rpm": 4900},
            "blade": {"outer_diameter_m": 0.305, "inner_diameter_m": 0.0254, "thickness_m": 0.0014, "material":
                {"youngs_modulus_pa": 2.06e11, "poisson_ratio": 0.3, "density_kg_per_m3": 7850}},
            "mount": {"kind": "collar", "diameter_m": 0.076, "in_plane": "fixed"},
            "guides": [{"radius_m": 0.13, "angle_deg": -60, "radial_length_m": 0.03, "tangential_length_m": 0.03,
                "stiffness_n_per_m": 0, "damping_n_s_per_m": 50}]}"#,
    );
    let found = report(&scene.unwrap(), &Options::default(), &|_| ()).unwrap();
    let [critical, _] = found.speeds.as_slice() else {
        panic!("{:?}", found.speeds);
    };
    let (rpm, tolerance) = (critical.rpm.unwrap(), critical.tolerance_rpm.unwrap());
    assert!((tolerance / rpm / (1e-2 * 1.5_f64.sqrt()) - 1.0).abs() < 1e-3);
    assert_eq!(shown_to(2, tolerance), "59");
    let mut varied = found.idling.sensitivities.iter();
    assert!(varied.all(|number| number.parameter != "guides[0].stiffness_n_per_m"));
}
