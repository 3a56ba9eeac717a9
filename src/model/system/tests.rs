use super::*;
use crate::model::plate::Resolution;
use crate::model::scene::Scene;

#[test]
fn symmetry_follows_the_physics() {
    let resolution = Resolution {
        max_diameters: 4,
        radial_functions: 4,
    };
    let system = GyroscopicSystem::of_plate(&Plate::new(&Scene::paper(), resolution));
    let asymmetry =
        |m: &Mat<f64>, sign: f64| (m - Scale(sign) * m.transpose()).norm_max() / m.norm_max();
    assert!(asymmetry(&system.stiffness, 1.0) < 1e-15);
    assert!(asymmetry(&system.spin, 1.0) < 1e-15);
    assert_eq!(asymmetry(&system.gyroscopic, -1.0), 0.0);
    assert!(system.is_conservative());
}
