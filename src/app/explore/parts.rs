//! Parts of a scene that the page adds, with values that compute and that a designer would begin with.

use serde::Deserialize;

use super::initial_part::{
    SPLINE, USUAL_GAP_M, between, guide, inner, mount, next_row, rim, side_force, usual_teeth,
};
use super::refusal::Refusal;
use crate::model::scene::typical_block::rounded;
use crate::model::scene::{
    ContactLaw, CutFile, CutSpeedFile, DampingFile, ExcitationFile, FrictionFile, GuideArmFile,
    GuideControllerFile, GuideFile, GuideFilmFile, LimitsFile, ModeRatioRow, ProbeFile,
    ResidualStressRow, ResponseFile, RimFile, RollBandFile, Scene, SceneFile, SlotsFile,
    StraightEdgeFile, SweepFile, TemperatureFile, TemperatureRow, ThicknessRow, USUAL_MARGIN,
    WaveFactorRow, WoodFile, typical_block, typical_value,
};

/// A request for a part.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Asked {
    scene: serde_json::Value,
    /// Path of the part, with `[]` at its end for another entry of a list.
    path: String,
    /// Kind of the mount: `collar` or `spline`. It is only used if the part is the mount.
    #[serde(default)]
    kind: String,
}

/// Returns the scene of a request with one more part.
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
        "friction" => {
            let coefficient = const { typical_value("friction.coefficient") };
            scene.friction = Some(FrictionFile::of(coefficient));
        }
        "limits" => {
            scene.limits = Some(LimitsFile {
                margin: Some(USUAL_MARGIN),
                ..LimitsFile::default()
            });
        }
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
                to_rpm: rounded(2.0 * typical_block::operating_rpm(scene), 2),
            });
        }
        "side_force" => scene.side_force = Some(side_force(scene)),
        "runup" => {
            scene.runup = serde_json::from_value(typical_block::runup(scene)).ok()?;
            let usual = side_force(scene);
            scene.side_force.get_or_insert(usual);
        }
        "response" => {
            scene.response = Some(ResponseFile::default());
        }
        "damping.mode_ratios[]" => {
            let rows = &mut scene.damping.get_or_insert_default().mode_ratios;
            let next = rows.iter().map(|row| row.diameters + 1).max();
            rows.push(ModeRatioRow {
                diameters: next.unwrap_or(0),
                damping_ratio: const { typical_value("damping.mode_ratios[].damping_ratio") },
            });
        }
        _ => match path.split_once('.').unwrap_or((path, "")) {
            (guide, "gap_m") => add_gap(scene, guide)?,
            (guide, "arm") => pad(scene, guide)?.arm = Some(ARM),
            (guide, "film") => add_film(pad(scene, guide)?),
            (guide, "controller") => pad(scene, guide)?.controller = Some(velocity_controller()),
            ("blade", part) => add_to_blade(scene, part)?,
            ("cut", part) => add_to_cut(scene, part)?,
            ("membrane", part) => add_to_membrane(scene, part)?,
            _ => return None,
        },
    }
    Some(())
}

/// A usual arm of a guide.
const ARM: GuideArmFile = GuideArmFile {
    stiffness_n_per_m: typical_value("guides[].arm.stiffness_n_per_m"),
    mass_kg: typical_value("guides[].arm.mass_kg"),
    damping_n_s_per_m: 0.0,
    loss_factor: 0.0,
};

/// The guide named like `guides[0]`.
fn pad<'a>(scene: &'a mut SceneFile, guide: &str) -> Option<&'a mut GuideFile> {
    let index = guide.strip_prefix("guides[")?.strip_suffix(']')?;
    scene.guides.get_mut(index.parse::<usize>().ok()?)
}

/// Adds a film of usual lag, and a damper if the pad has none.
fn add_film(pad: &mut GuideFile) {
    if pad.damping_n_s_per_m == 0.0 {
        pad.damping_n_s_per_m = USUAL_DAMPING_N_S_PER_M;
    }
    pad.film = Some(GuideFilmFile {
        lag_s: const { typical_value("guides[].film.lag_s") },
    });
}

/// Damping by a film or a controller that is added.
const USUAL_DAMPING_N_S_PER_M: f64 = 300.0;

/// A controller that damps: the velocity times 300 N·s/m through a low pass of 1 ms.
fn velocity_controller() -> GuideControllerFile {
    GuideControllerFile {
        numerator: vec![USUAL_DAMPING_N_S_PER_M, 0.0],
        denominator: vec![1e-3, 1.0],
    }
}

/// Adds a gap to the guide named like `guides[0]`, which then lifts off.
fn add_gap(scene: &mut SceneFile, guide: &str) -> Option<()> {
    let pad = pad(scene, guide)?;
    pad.contact = ContactLaw::OneSided;
    pad.gap_m.get_or_insert(USUAL_GAP_M);
    Some(())
}

/// Number of expansion slots of a usual blade, and their depth as a share of the width of the moving ring.
const USUAL_SLOTS: u32 = 4;
const SLOT_DEPTH: f64 = 0.2;

/// Nodal diameters of the first wave whose stiffness is given, the lowest that can stand still, and that of a plain blade.
const FIRST_FACTOR: u32 = 2;
const PLAIN: f64 = 1.0;

fn add_to_blade(scene: &mut SceneFile, part: &str) -> Option<()> {
    match part {
        "rim" => {
            let teeth = *scene.blade.teeth.get_or_insert(usual_teeth(scene));
            // The tooth is assumed to be a triangle as thick as the blade, with the pitch as base and half
            // the pitch as height.
            let pitch = std::f64::consts::TAU * rim(scene) / f64::from(teeth.max(1));
            let per_area = scene.blade.material.density_kg_per_m3 * scene.blade.thickness_m;
            scene.blade.rim = Some(RimFile {
                mass_per_tooth_kg: rounded(per_area * 0.25 * pitch * pitch, 1),
                radius_m: None,
            });
        }
        "slots" => {
            scene.blade.slots = Some(SlotsFile {
                count: USUAL_SLOTS,
                depth_m: rounded(SLOT_DEPTH * (rim(scene) - inner(scene)), 2),
                width_m: None,
                inclination_deg: None,
                hole_diameter_m: None,
            });
        }
        "wave_factors[]" => {
            let rows = &mut scene.blade.wave_factors;
            let next = rows.iter().map(|row| row.nodal_diameters + 1).max();
            rows.push(WaveFactorRow {
                nodal_diameters: next.unwrap_or(FIRST_FACTOR),
                bending: PLAIN,
                rotation: Some(PLAIN),
                split: None,
            });
        }
        "profile[]" => {
            let rows: Vec<_> = scene
                .blade
                .profile
                .iter()
                .map(|row| [row.radius_m, row.thickness_m])
                .collect();
            let [radius_m, thickness_m] = next_row(scene, &rows, scene.blade.thickness_m);
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
        rpm: typical_block::operating_rpm(scene),
        ..CutSpeedFile::default()
    };
    if scene.cut.is_none() {
        scene.blade.teeth.get_or_insert(usual_teeth(scene));
        scene.cut = Some(CutFile {
            speeds: vec![speed.clone()],
            ..serde_json::from_value(typical_block::cut(scene)).ok()?
        });
    }
    let cut = scene.cut.as_mut()?;
    match part {
        "" => (),
        "speeds[]" => cut.speeds.push(speed),
        "wood" => cut.wood = Some(WoodFile::default()),
        "washboarding" => {
            cut.washboarding = serde_json::from_value(typical_block::washboarding()).ok()?;
            scene.operating_rpm = Some(typical_block::operating_rpm(scene));
            // Without damping even the smallest delayed force makes some mode grow.
            scene.damping.get_or_insert(DampingFile {
                material_retardation_time_s: const {
                    typical_value("damping.material_retardation_time_s")
                },
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
        expansion_per_k: const { typical_value("membrane.temperature.expansion_per_k") },
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
            let rows: Vec<_> = temperature
                .table
                .iter()
                .map(|row| [row.radius_m, row.rise_k])
                .collect();
            let [radius_m, rise_k] = next_row(scene, &rows, 0.0);
            // A scene must not have both a temperature table and a rise at the rim.
            (temperature.rim_rise_k, temperature.from_radius_m) = (None, None);
            temperature.exponent = None;
            temperature.table.push(TemperatureRow { radius_m, rise_k });
            let in_order =
                |x: &TemperatureRow, y: &TemperatureRow| x.radius_m.total_cmp(&y.radius_m);
            temperature.table.sort_by(in_order);
        }
        "roll_tension[]" => membrane.roll_tension.push(RollBandFile {
            radius_m: between(scene, 0.5),
            width_m: rounded(0.1 * (rim(scene) - inner(scene)), 2),
            eigenstrain: Some(const { typical_value("membrane.roll_tension[].eigenstrain") }),
            groove_depth_m: None,
        }),
        "straight_edge" => membrane.straight_edge = Some(StraightEdgeFile::default()),
        "residual_stress[]" => {
            let rows: Vec<_> = membrane
                .residual_stress
                .iter()
                .map(|row| [row.radius_m, row.hoop_pa])
                .collect();
            let [radius_m, hoop_pa] = next_row(scene, &rows, 0.0);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::explore::examples::examples;
    use crate::app::explore::needs::{Condition, NEEDS};

    const PARTS: [&str; 28] = [
        "blade.slots",
        "blade.wave_factors[]",
        "limits",
        "response",
        "damping.mode_ratios[]",
        "guides[]",
        "damping",
        "excitation",
        "friction",
        "spline",
        "probe",
        "sweep",
        "side_force",
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
        "membrane.straight_edge",
        "mount collar",
        "mount spline",
    ];

    /// Block of a list for which the page states what is needed.
    fn block_of(part: &str) -> &str {
        part.split_once('.').map_or(part, |(block, _)| block)
    }

    fn lacks(scene: &SceneFile, path: &str) -> bool {
        let json = serde_json::to_value(scene).unwrap();
        let is_met = |condition: &Condition| {
            let pointer = format!("/{}", condition.path.replace('.', "/"));
            let value = json.pointer(&pointer);
            let is_there = value.is_some_and(|value| !value.is_null());
            if condition.absent {
                return !is_there;
            }
            value.is_some_and(|value| condition.is.is_none_or(|is| value == is))
        };
        let mut own = NEEDS.iter().filter(|need| need.of == path);
        own.any(|need| !need.any.iter().any(is_met))
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
                // A spline or a residual stress of the scene excludes another mount.
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
                let lists = PARTS.iter().filter(|part| part.ends_with("[]"));
                for second in
                    lists.filter(|part| !lacks(&made, block_of(part)) && !lacks(&made, part))
                {
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
    fn a_guide_is_put_on_an_arm() {
        let mut scene = Scene::paper().file().clone();
        assert_eq!(add(&mut scene, "guides[1].arm", ""), None);
        add(&mut scene, "guides[0].arm", "").unwrap();
        assert_eq!(scene.guides[0].arm, Some(ARM));
        Scene::try_from(scene).unwrap();
    }

    #[test]
    fn a_guide_gets_a_film_with_its_damper_and_a_controller() {
        let mut scene = Scene::paper().file().clone();
        add(&mut scene, "guides[0].film", "").unwrap();
        add(&mut scene, "guides[0].controller", "").unwrap();
        assert_eq!(scene.guides[0].damping_n_s_per_m, USUAL_DAMPING_N_S_PER_M);
        Scene::try_from(scene).unwrap();
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
