//! Parts of a scene that the page adds, with values that compute and that a designer would begin with.

use serde::{Deserialize, Serialize};

use super::refusal::Refusal;
use crate::scene::{
    CutFile, CutSpeedFile, DampingFile, ExcitationFile, GuideFile, InPlane, ModeRatioRow, Mount,
    ProbeFile, ResidualStressRow, ResponseFile, RimFile, RollBandFile, RunUpFile, Scene, SceneFile,
    SplineFile, SweepFile, TemperatureFile, TemperatureRow, ThicknessRow, WashboardingFile,
    WoodFile,
};
use crate::text::shown_to;

/// A request.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    scene: serde_json::Value,
    /// Path of the part, with `[]` at its end for another entry of a list.
    path: String,
    /// Kind of the mount.
    #[serde(default)]
    kind: String,
}

/// A condition for a part or a task.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct Need {
    /// Path of the part, or name of the task.
    of: &'static str,
    /// Of these values of the scene it needs one.
    any: &'static [Condition],
    /// Message otherwise.
    otherwise: &'static str,
}

#[derive(Debug, Clone, Copy, Serialize)]
struct Condition {
    path: &'static str,
    /// The value; null if any is sufficient.
    is: Option<&'static str>,
}

const GUIDES: Condition = Condition {
    path: "guides",
    is: None,
};
const HELD: &[Condition] = &[
    GUIDES,
    Condition {
        path: "mount.kind",
        is: Some("collar"),
    },
];
const NOT_HELD: &str = "This needs a guide or a collar that holds the blade.";

/// Conditions that a scene of the page may lack.
pub const NEEDS: &[Need] = &[
    Need {
        of: "spline",
        any: &[Condition {
            path: "mount.kind",
            is: Some("spline"),
        }],
        otherwise: "A spline needs the mount of that name.",
    },
    Need {
        of: "runup",
        any: HELD,
        otherwise: NOT_HELD,
    },
    Need {
        of: "cut.washboarding",
        any: HELD,
        otherwise: NOT_HELD,
    },
    Need {
        of: "fit",
        any: &[Condition {
            path: "measured",
            is: None,
        }],
        otherwise: "The scene has no measured frequencies yet.",
    },
    Need {
        of: "place",
        any: &[GUIDES],
        otherwise: "The scene has no guide to place yet.",
    },
];

/// The scene of a request with one more part.
///
/// # Errors
/// [`Refusal`] if the scene cannot be read, or the path is not that of a part.
pub fn with_part(asked: &str) -> Result<SceneFile, Refusal> {
    let asked: Asked = serde_json::from_str(asked).map_err(|error| Refusal::of(&error))?;
    let mut scene = Scene::file_from_json(&asked.scene.to_string())?;
    match add(&mut scene, &asked.path, &asked.kind) {
        Some(()) => Ok(scene),
        None => Err(Refusal::with_message(format!(
            "{} {} is not a part that can be added",
            asked.path, asked.kind
        ))),
    }
}

/// Adds a part, the block that it belongs to, and other values that it needs.
fn add(scene: &mut SceneFile, path: &str, kind: &str) -> Option<()> {
    match path {
        "mount" => scene.mount = mount(scene, kind)?,
        "guides[]" => scene.guides.push(guide(scene)),
        "damping" => scene.damping = Some(DampingFile::default()),
        "excitation" => scene.excitation = Some(ExcitationFile::default()),
        "spline" => scene.spline = Some(SPLINE),
        "probe" => {
            scene.probe = Some(ProbeFile {
                radius_m: None,
                angle_deg: 90.0,
            });
        }
        "sweep" => {
            scene.sweep = Some(SweepFile {
                from_rpm: 0.0,
                to_rpm: round(2.0 * operating(scene), 2),
            });
        }
        "runup" => scene.runup = Some(runup(scene)),
        "response" => {
            scene.response = Some(ResponseFile {
                force_n: 1.0,
                ..ResponseFile::default()
            });
        }
        "damping.mode_ratios[]" => {
            let rows = &mut scene.damping.get_or_insert_default().mode_ratios;
            let next = rows.iter().map(|row| row.diameters + 1).max();
            rows.push(ModeRatioRow {
                diameters: next.unwrap_or(0),
                damping_ratio: 1e-3,
            });
        }
        _ => match path.split_once('.').unwrap_or((path, "")) {
            ("blade", part) => add_to_blade(scene, part)?,
            ("cut", part) => add_to_cut(scene, part)?,
            ("membrane", part) => add_to_membrane(scene, part)?,
            _ => return None,
        },
    }
    Some(())
}

fn add_to_blade(scene: &mut SceneFile, part: &str) -> Option<()> {
    match part {
        "rim" => {
            let teeth = *scene.blade.teeth.get_or_insert(usual_teeth(scene));
            // A triangle of the blade's thickness, half as high as the pitch.
            let pitch = std::f64::consts::TAU * rim(scene) / f64::from(teeth.max(1));
            let per_area = scene.blade.material.density_kg_per_m3 * scene.blade.thickness_m;
            scene.blade.rim = Some(RimFile {
                mass_per_tooth_kg: round(per_area * 0.25 * pitch * pitch, 1),
                radius_m: None,
            });
        }
        "profile[]" => {
            let rows = scene.blade.profile.iter();
            let rows: Vec<_> = rows.map(|row| (row.radius_m, row.thickness_m)).collect();
            let (radius_m, thickness_m) = next_row(scene, &rows, scene.blade.thickness_m);
            let profile = &mut scene.blade.profile;
            profile.push(ThicknessRow {
                radius_m,
                thickness_m,
            });
            profile.sort_by(|x, y| x.radius_m.total_cmp(&y.radius_m));
        }
        _ => return None,
    }
    Some(())
}

fn add_to_cut(scene: &mut SceneFile, part: &str) -> Option<()> {
    let speed = CutSpeedFile {
        rpm: operating(scene),
        ..CutSpeedFile::default()
    };
    if scene.cut.is_none() {
        scene.blade.teeth.get_or_insert(usual_teeth(scene));
        scene.cut = Some(CutFile {
            depth_m: Some(round(0.25 * rim(scene), 2)),
            tangential_n_per_tooth: Some(100.0),
            radial_n_per_tooth: Some(10.0),
            lateral_n_per_tooth: Some(1.0),
            idle_s: 0.5,
            speeds: vec![speed.clone()],
            ..CutFile::default()
        });
    }
    let cut = scene.cut.as_mut()?;
    match part {
        "" => (),
        "speeds[]" => cut.speeds.push(speed),
        "wood" => cut.wood = Some(WoodFile::default()),
        "washboarding" => {
            cut.washboarding = Some(WashboardingFile {
                stiffness_n_per_m: 2e4,
                overlap: 1.0,
                arc_deg: None,
                pitches_deg: Vec::new(),
            });
            scene.operating_rpm.get_or_insert(OPERATING_RPM);
            // Without damping the smallest delayed force makes some mode grow.
            scene.damping.get_or_insert(DampingFile {
                material_retardation_time_s: 1e-6,
                ..DampingFile::default()
            });
        }
        _ => return None,
    }
    Some(())
}

fn add_to_membrane(scene: &mut SceneFile, part: &str) -> Option<()> {
    let mut membrane = scene.membrane.clone().unwrap_or_default();
    let heat = || TemperatureFile {
        expansion_per_k: 1.2e-5,
        rim_rise_k: Some(0.0),
        from_radius_m: None,
        exponent: None,
        table: Vec::new(),
    };
    match part {
        "" => (),
        "temperature" => membrane.temperature = Some(heat()),
        "temperature.table[]" => {
            let temperature = membrane.temperature.get_or_insert_with(heat);
            let rows = temperature.table.iter();
            let rows: Vec<_> = rows.map(|row| (row.radius_m, row.rise_k)).collect();
            let (radius_m, rise_k) = next_row(scene, &rows, 0.0);
            // A table and a rise at the rim exclude each other.
            (temperature.rim_rise_k, temperature.from_radius_m) = (None, None);
            temperature.exponent = None;
            temperature.table.push(TemperatureRow { radius_m, rise_k });
            let in_order =
                |x: &TemperatureRow, y: &TemperatureRow| x.radius_m.total_cmp(&y.radius_m);
            temperature.table.sort_by(in_order);
        }
        "roll_tension[]" => membrane.roll_tension.push(RollBandFile {
            radius_m: between(scene, 0.5),
            width_m: round(0.1 * (rim(scene) - inner(scene)), 2),
            eigenstrain: 1e-4,
        }),
        "residual_stress[]" => {
            let rows = membrane.residual_stress.iter();
            let rows: Vec<_> = rows.map(|row| (row.radius_m, row.hoop_pa)).collect();
            let (radius_m, hoop_pa) = next_row(scene, &rows, 0.0);
            let stress = &mut membrane.residual_stress;
            stress.push(ResidualStressRow {
                radius_m,
                hoop_pa,
                radial_pa: None,
            });
            stress.sort_by(|x, y| x.radius_m.total_cmp(&y.radius_m));
        }
        _ => return None,
    }
    scene.membrane = Some(membrane);
    Some(())
}

/// Speed of a saw that has none.
const OPERATING_RPM: f64 = 1800.0;
/// Usual pitch of teeth.
const PITCH_M: f64 = 0.03;
const LEAST_TEETH: f64 = 12.0;
/// The paper's arbor.
const SPLINE: SplineFile = SplineFile {
    teeth: 20,
    pressure_angle_deg: 30.0,
    contact_stiffness_n_per_m_3_2: 7e9,
    contact_damping_n_s_3_2_per_m_3_2: 4700.0,
    clearance_m: 0.25e-3,
    pitch_radius_m: None,
    weight_angle_deg: None,
};

fn operating(scene: &SceneFile) -> f64 {
    scene.operating_rpm.unwrap_or(OPERATING_RPM)
}

fn rim(scene: &SceneFile) -> f64 {
    0.5 * scene.blade.outer_diameter_m
}

/// Radius from which on the blade moves.
fn inner(scene: &SceneFile) -> f64 {
    0.5 * match scene.mount {
        Mount::Collar { diameter_m, .. } => diameter_m,
        Mount::Spline {} => scene.blade.inner_diameter_m,
    }
}

/// Radius at a share of the way from the collar or bore to the rim.
fn between(scene: &SceneFile, share: f64) -> f64 {
    round(inner(scene) + share * (rim(scene) - inner(scene)), 3)
}

fn round(value: f64, digits: usize) -> f64 {
    shown_to(digits, value).parse().unwrap_or(value)
}

fn usual_teeth(scene: &SceneFile) -> u32 {
    let count = (std::f64::consts::TAU * rim(scene) / PITCH_M).round();
    count.max(LEAST_TEETH) as u32
}

fn mount(scene: &SceneFile, kind: &str) -> Option<Mount> {
    Some(match kind {
        "spline" => Mount::Spline {},
        "collar" => Mount::Collar {
            diameter_m: collar_diameter(scene),
            in_plane: InPlane::Fixed,
        },
        _ => return None,
    })
}

/// A third of the blade, between the bore and the guides.
fn collar_diameter(scene: &SceneFile) -> f64 {
    let (bore, outer) = (scene.blade.inner_diameter_m, scene.blade.outer_diameter_m);
    let usual = match 0.35 * outer > bore {
        true => 0.35 * outer,
        false => bore + 0.2 * (outer - bore),
    };
    let edges = scene.guides.iter();
    let edges = edges.map(|pad| 2.0 * pad.radius_m - pad.radial_length_m);
    let widest = edges.fold(outer, f64::min);
    round(usual.min(0.9 * widest), 2).max(bore)
}

/// A guide like the last one, at the angle farthest from those that exist.
fn guide(scene: &SceneFile) -> GuideFile {
    let length = round(0.3 * (rim(scene) - inner(scene)), 2);
    let first = GuideFile {
        radius_m: between(scene, 0.6),
        radial_length_m: length,
        tangential_length_m: length,
        stiffness_n_per_m: 1e7,
        ..GuideFile::default()
    };
    GuideFile {
        angle_deg: free_angle(&scene.guides),
        ..scene.guides.last().copied().unwrap_or(first)
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

/// Radius and value of another row of a table over the radius, with the values of its neighbours: between the last
/// row and the rim, or where rows are farthest apart.
fn next_row(scene: &SceneFile, rows: &[(f64, f64)], value: f64) -> (f64, f64) {
    let rim = rim(scene);
    let end = |k: usize| rows.get(k + 1).map_or(rim, |next| next.0);
    let gap = |k: &usize| end(*k) - rows[*k].0;
    let Some(last) = rows.len().checked_sub(1) else {
        return (round(inner(scene), 3), value);
    };
    let widest = || (0..=last).max_by(|x, y| gap(x).total_cmp(&gap(y)));
    let at = match gap(&last) > 1e-3 * rim {
        true => last,
        false => widest().unwrap_or(last),
    };
    let next = rows.get(at + 1).unwrap_or(&rows[at]);
    (
        round(0.5 * (rows[at].0 + end(at)), 4),
        0.5 * (rows[at].1 + next.1),
    )
}

fn runup(scene: &SceneFile) -> RunUpFile {
    RunUpFile {
        from_rpm: 0.0,
        to_rpm: round(1.5 * operating(scene), 2),
        duration_s: 60.0,
        force_n: side_force(scene),
        angle_deg: 0.0,
        stretching: false,
    }
}

/// A force to which soft guides yield by less than the thickness of the blade, because the model is linear.
fn side_force(scene: &SceneFile) -> f64 {
    if matches!(scene.mount, Mount::Collar { .. }) {
        return 5.0;
    }
    let stiffness: f64 = scene.guides.iter().map(|pad| pad.stiffness_n_per_m).sum();
    round(
        (0.01 * scene.blade.thickness_m * stiffness).clamp(1e-3, 5.0),
        1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::explore::examples::examples;

    const PARTS: [&str; 22] = [
        "response",
        "damping.mode_ratios[]",
        "guides[]",
        "damping",
        "excitation",
        "spline",
        "probe",
        "sweep",
        "runup",
        "blade.rim",
        "blade.profile[]",
        "cut",
        "cut.speeds[]",
        "cut.wood",
        "cut.washboarding",
        "membrane",
        "membrane.temperature",
        "membrane.temperature.table[]",
        "membrane.roll_tension[]",
        "membrane.residual_stress[]",
        "mount collar",
        "mount spline",
    ];

    fn lacks(scene: &SceneFile, path: &str) -> bool {
        let json = serde_json::to_value(scene).unwrap();
        let Some(need) = NEEDS.iter().find(|need| need.of == path) else {
            return false;
        };
        !need.any.iter().any(|condition| {
            let pointer = format!("/{}", condition.path.replace('.', "/"));
            let value = json.pointer(&pointer);
            value.is_some_and(|value| condition.is.is_none_or(|is| value == is))
        })
    }

    /// Each part, and two parts one after the other, are accepted in each saw of the gallery.
    #[test]
    fn a_saw_of_the_gallery_with_a_part_more_is_a_saw() {
        let with = |scene: &SceneFile, part: &str| {
            let (path, kind) = part.split_once(' ').unwrap_or((part, ""));
            let mut made = scene.clone();
            add(&mut made, path, kind).expect(part);
            made
        };
        for scene in examples() {
            for first in PARTS {
                // What was measured with one mount does not hold for another.
                let residual = scene
                    .membrane
                    .as_ref()
                    .map(|m| !m.residual_stress.is_empty());
                let is_bound = scene.spline.is_some() || residual == Some(true);
                if lacks(&scene, first) || first.starts_with("mount") && is_bound {
                    continue;
                }
                let made = with(&scene, first);
                if let Err(error) = Scene::try_from(made.clone()) {
                    panic!("{}: {first}: {error}", scene.name);
                }
                for second in PARTS.iter().filter(|part| part.ends_with("[]")) {
                    let error = Scene::try_from(with(&made, second)).err();
                    assert!(
                        error.is_none(),
                        "{}: {first}, {second}: {error:?}",
                        scene.name
                    );
                }
            }
        }
    }

    #[test]
    fn a_new_guide_is_far_from_the_others() {
        let mut scene = Scene::paper().file().clone();
        for _ in 0..2 {
            add(&mut scene, "guides[]", "").unwrap();
        }
        let angles: Vec<f64> = scene.guides.iter().map(|pad| pad.angle_deg).collect();
        assert_eq!(angles, [-55.0, 125.0, -145.0]);
        assert_eq!(scene.guides[2].radius_m, scene.guides[0].radius_m);
        assert_eq!(add(&mut scene, "guides", ""), None);
    }
}
