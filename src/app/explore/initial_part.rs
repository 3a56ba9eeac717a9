//! Initial values of parts for a blade of any size.

use crate::model::scene::typical_block::rounded;
use crate::model::scene::{
    GuideFile, InPlane, Mount, SceneFile, SideForceFile, SplineFile, typical_value,
};

const LEAST_TEETH: f64 = 12.0;
/// Gap of a guide in m, which is also the example in the message for a missing one.
pub const USUAL_GAP_M: f64 = 4e-5;
/// Spline of the saw in the paper, with assumed values for the numbers that the paper does not give.
pub const SPLINE: SplineFile = SplineFile {
    teeth: 20,
    pressure_angle_deg: 30.0,
    contact_stiffness_n_per_m_3_2: 7e9,
    contact_damping_n_s_3_2_per_m_3_2: 4700.0,
    clearance_m: 0.25e-3,
    pitch_radius_m: None,
    weight_angle_deg: None,
};

pub fn rim(scene: &SceneFile) -> f64 {
    0.5 * scene.blade.outer_diameter_m
}

/// Radius of the collar or the bore, outside of which the blade deflects.
pub fn inner(scene: &SceneFile) -> f64 {
    0.5 * match scene.mount {
        Mount::Collar { diameter_m, .. } => diameter_m,
        Mount::Spline {} => scene.blade.inner_diameter_m,
    }
}

/// Radius at a share of the way from the collar or bore to the rim.
pub fn between(scene: &SceneFile, share: f64) -> f64 {
    rounded(inner(scene) + share * (rim(scene) - inner(scene)), 3)
}

pub fn usual_teeth(scene: &SceneFile) -> u32 {
    let count =
        (std::f64::consts::TAU * rim(scene) / const { typical_value("blade.teeth") }).round();
    count.max(LEAST_TEETH) as u32
}

pub fn mount(scene: &SceneFile, kind: &str) -> Option<Mount> {
    Some(match kind {
        "spline" => Mount::Spline {},
        "collar" => Mount::Collar {
            diameter_m: collar_diameter(scene),
            in_plane: InPlane::Fixed,
            clamp_stiffness_n_m_per_rad_per_m: None,
        },
        _ => return None,
    })
}

/// Diameter of a collar: 35 % of that of the blade, but larger than the bore and inside the guides.
fn collar_diameter(scene: &SceneFile) -> f64 {
    let (bore, outer) = (scene.blade.inner_diameter_m, scene.blade.outer_diameter_m);
    let usual = if 0.35 * outer > bore {
        0.35 * outer
    } else {
        bore + 0.2 * (outer - bore)
    };
    let edges = scene
        .guides
        .iter()
        .map(|pad| 2.0 * pad.radius_m - pad.radial_length_m);
    let widest = edges.fold(outer, f64::min);
    rounded(usual.min(0.9 * widest), 2).max(bore)
}

/// A guide like the last one, at the angle farthest from those of the existing guides.
pub fn guide(scene: &SceneFile) -> GuideFile {
    let length = rounded(0.3 * (rim(scene) - inner(scene)), 2);
    let first = GuideFile {
        radius_m: between(scene, 0.6),
        radial_length_m: length,
        tangential_length_m: length,
        stiffness_n_per_m: const { typical_value("guides[].stiffness_n_per_m") },
        ..GuideFile::default()
    };
    GuideFile {
        angle_deg: free_angle(&scene.guides),
        ..scene.guides.last().cloned().unwrap_or(first)
    }
}

fn free_angle(guides: &[GuideFile]) -> f64 {
    match guides {
        [] => -55.0,
        [only] if only.angle_deg > 0.0 => only.angle_deg - 180.0,
        [only] => only.angle_deg + 180.0,
        _ => {
            let apart = |x: f64, y: f64| ((x - y + 540.0).rem_euclid(360.0) - 180.0).abs();
            let distance = |angle: f64| {
                let others = guides.iter().map(|other| apart(angle, other.angle_deg));
                others.fold(f64::INFINITY, f64::min)
            };
            let all = (0..72).map(|k| 5.0 * f64::from(k) - 175.0);
            all.fold(-175.0, |best, angle| {
                if distance(angle) > distance(best) {
                    angle
                } else {
                    best
                }
            })
        }
    }
}

/// Radius and value of another row of a table over the radius. The first row is at the collar or bore and has the given
/// value. A later one is between the last row and the rim or, if the last row is at the rim, where rows are farthest
/// apart; its value is the mean of its neighbours.
pub fn next_row(scene: &SceneFile, rows: &[[f64; 2]], value: f64) -> [f64; 2] {
    let rim = rim(scene);
    let end = |k: usize| rows.get(k + 1).map_or(rim, |next| next[0]);
    let gap = |k: &usize| end(*k) - rows[*k][0];
    let Some(last) = rows.len().checked_sub(1) else {
        return [rounded(inner(scene), 3), value];
    };
    let at = if gap(&last) > 1e-3 * rim {
        last
    } else {
        let widest = (0..=last).max_by(|x, y| gap(x).total_cmp(&gap(y)));
        widest.unwrap_or(last)
    };
    let next = rows.get(at + 1).unwrap_or(&rows[at]);
    [
        rounded(0.5 * (rows[at][0] + end(at)), 4),
        0.5 * (rows[at][1] + next[1]),
    ]
}

/// A side force in N. Without a collar, it deflects the guides by about 1 % of the thickness of the blade at most, because the
/// model of a run-up is linear.
pub fn side_force(scene: &SceneFile) -> SideForceFile {
    let usual_n = const { typical_value("side_force.force_n") };
    let force_n = match scene.mount {
        Mount::Collar { .. } => usual_n,
        Mount::Spline {} => {
            let stiffness: f64 = scene.guides.iter().map(|pad| pad.stiffness_n_per_m).sum();
            let gentle_n = 0.01 * scene.blade.thickness_m * stiffness;
            rounded(gentle_n.clamp(1e-3, usual_n), 1)
        }
    };
    SideForceFile::of(force_n)
}
