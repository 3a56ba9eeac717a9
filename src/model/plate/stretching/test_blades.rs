//! Blades and deflections for the tests of stretching.

use faer::Col;

use crate::model::plate::{Plate, Resolution};
use crate::model::scene::{InPlane, Mount, Scene, SceneFile, ThicknessRow};

/// The paper's blade without guides, modified.
pub fn plate(resolution: [usize; 2], edit: impl FnOnce(&mut SceneFile)) -> Plate {
    let scene = Scene::paper().edited(|saw| {
        saw.guides.clear();
        saw.cut = None;
        edit(saw);
    });
    let resolution = Resolution {
        max_diameters: resolution[0],
        radial_functions: resolution[1],
    };
    Plate::new(&scene.expect("a saw"), resolution)
}

/// A hub, a taper and a step, between the radii 0.1 and 0.355 m.
pub fn profiled(saw: &mut SceneFile) {
    let row = |radius_m, thickness_m| ThicknessRow {
        radius_m,
        thickness_m,
    };
    saw.blade.profile = vec![
        row(0.15, 2.8e-3),
        row(0.22, 2.2e-3),
        row(0.3, 2.2e-3),
        row(0.3, 3.1e-3),
    ];
}

/// A collar of 0.24 m.
pub fn collar(saw: &mut SceneFile, in_plane: InPlane) {
    saw.mount = Mount::Collar {
        diameter_m: 0.24,
        in_plane,
        clamp_stiffness_n_m_per_rad_per_m: None,
    };
}

/// Blades on a spline, in both kinds of collar, and with a profile on a spline and in a collar.
pub fn all(resolution: [usize; 2]) -> [Plate; 5] {
    [
        plate(resolution, |_| ()),
        plate(resolution, |saw| collar(saw, InPlane::Free)),
        plate(resolution, |saw| collar(saw, InPlane::Fixed)),
        plate(resolution, profiled),
        plate(resolution, |saw| {
            profiled(saw);
            collar(saw, InPlane::Fixed);
        }),
    ]
}

/// Number n of nodal diameters, and the factors of cos nθ and sin nθ over the radius.
pub type Wave<'a> = (usize, [&'a dyn Fn(f64) -> f64; 2]);

/// The coordinates of w = Σ cₙ(r) cos nθ + sₙ(r) sin nθ, `waves` being (n, cₙ, sₙ).
pub fn projected(plate: &Plate, waves: &[Wave<'_>]) -> Col<f64> {
    let mut q = Col::zeros(plate.degrees_of_freedom());
    let size = plate.basis.count();
    for (n, parts) in waves {
        for (part, of_radius) in parts.iter().enumerate().take(if *n == 0 { 1 } else { 2 }) {
            let first = plate.offset(*n) + part * size;
            for (r, w) in plate.basis.rule().iter() {
                let weight = w * r * plate.blade.thickness_ratio(r) * plate.angular_norm(*n);
                for (j, value) in plate.basis.evaluate(*n, r).value.iter().enumerate() {
                    q[first + j] += weight * value * of_radius(r);
                }
            }
        }
    }
    q
}

/// A deflection that contains every function, about as large as the thickness.
pub fn any(plate: &Plate) -> Col<f64> {
    Col::from_fn(plate.degrees_of_freedom(), |i| {
        1e-3 * (1.3 * i as f64 + 0.2).sin() / (1.0 + i as f64 / 6.0)
    })
}
