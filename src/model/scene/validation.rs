//! Validates a [`SceneFile`]: the [`Scene`] that results is in SI units and radians.

use super::blade::RimMass;
use super::cut::Cut;
use super::guide::guide;
use super::membrane::Membrane;
use super::rule::{MAX_GUIDES, refuse};
use super::slots::{Slots, SlottedRing, SplitBranch};
use super::speed_range::check_rise;
use super::thickness::ThicknessProfile;
use super::wave_factors::WaveFactors;
use super::{
    Blade, Bore, ExcitationLine, MeasuredRow, Mount, RefusedValue, Scene, SceneError, SceneFile,
};
use crate::page::text::shown;

impl TryFrom<SceneFile> for Scene {
    type Error = SceneError;

    fn try_from(file: SceneFile) -> Result<Self, SceneError> {
        file.check_numbers()?;
        let blade = blade(&file)?;
        if file.guides.len() > MAX_GUIDES {
            let remedy = "join pads that lie side by side";
            let (count, allowed) = (file.guides.len(), format!("at most {MAX_GUIDES} pads"));
            return Err(refuse("guides", count as f64, allowed, remedy));
        }
        let guides = file
            .guides
            .iter()
            .enumerate()
            .map(|(index, pad)| guide(index, pad, &blade))
            .collect::<Result<Vec<_>, _>>()?;
        check_measured(&file)?;
        if let Some(damping) = &file.damping {
            damping.checked()?;
        }
        if let Some(sweep) = &file.sweep {
            let remedy = "a sweep runs from a lower to a higher speed";
            check_rise("sweep", sweep.from_rpm, sweep.to_rpm, remedy)?;
        }
        if let Some(runup) = &file.runup {
            runup.checked()?;
        }
        if let Some(probe) = &file.probe {
            probe.checked(&blade)?;
        }
        if let Some(spline) = &file.spline {
            spline.checked(&file.mount, &blade)?;
        }
        if let Some(force) = &file.side_force {
            force.checked(&blade)?;
        }
        Ok(Scene {
            cut: file
                .cut
                .as_ref()
                .map(|cut| Cut::new(cut, file.operating_rpm, file.blade.teeth, &blade))
                .transpose()?,
            membrane: file
                .membrane
                .as_ref()
                .map(|membrane| Membrane::new(membrane, &blade, 0.5 * file.blade.inner_diameter_m))
                .transpose()?,
            blade,
            guides: guides.into_iter().filter(|pad| pad.typed.acts()).collect(),
            excitation: ExcitationLine::of(file.excitation, file.blade.teeth)?,
            file,
        })
    }
}

fn blade(file: &SceneFile) -> Result<Blade, SceneError> {
    let typed = &file.blade;
    let (outer, bore_diameter) = (typed.outer_diameter_m, typed.inner_diameter_m);
    let thickness_m = typed.thickness_m;
    if bore_diameter >= outer {
        let allowed = format!("less than blade.outer_diameter_m ({})", shown(outer));
        let remedy = "a bore is smaller than its blade; were the two exchanged?";
        return Err(refuse(
            "blade.inner_diameter_m",
            bore_diameter,
            allowed,
            remedy,
        ));
    }
    let (inner, bore, clamp) = match file.mount {
        Mount::Spline {} => (bore_diameter, Bore::Free, None),
        Mount::Collar {
            diameter_m,
            in_plane,
            clamp_stiffness_n_m_per_rad_per_m: clamp,
        } => {
            if !(bore_diameter..outer).contains(&diameter_m) {
                let allowed = format!(
                    "from the bore ({}) to below the rim ({})",
                    shown(bore_diameter),
                    shown(outer)
                );
                let remedy = "give the outer diameter of the collar";
                return Err(refuse("mount.diameter_m", diameter_m, allowed, remedy));
            }
            (diameter_m, Bore::Clamped(in_plane), clamp)
        }
    };
    if inner > 0.999 * outer {
        let allowed = format!("at most 0.999 of blade.outer_diameter_m ({})", shown(outer));
        let remedy = "a narrower ring is a wire, which plate theory does not describe";
        let key = match bore {
            Bore::Free => "blade.inner_diameter_m",
            Bore::Clamped(_) => "mount.diameter_m",
        };
        return Err(refuse(key, inner, allowed, remedy));
    }
    let width = 0.5 * (outer - inner);
    if thickness_m > width {
        let allowed = format!("at most the width of the moving ring ({} m)", shown(width));
        let remedy = "a body thicker than wide is no plate; is the thickness in metres?";
        return Err(refuse("blade.thickness_m", thickness_m, allowed, remedy));
    }
    let plain = Blade {
        inner_radius_m: 0.5 * inner,
        outer_radius_m: 0.5 * outer,
        thickness_m,
        profile: None,
        rim: None,
        slots: None,
        wave_factors: None,
        split_branch: SplitBranch::default(),
        material: typed.material,
        bore,
        clamp_n_m_per_rad_per_m: clamp,
    };
    let ring = SlottedRing {
        radii_m: [plain.inner_radius_m, plain.outer_radius_m],
        thickness_m,
        has_membrane: file.membrane.is_some(),
    };
    Ok(Blade {
        profile: ThicknessProfile::new(
            &typed.profile,
            thickness_m,
            plain.inner_radius_m,
            plain.outer_radius_m,
        )?,
        rim: RimMass::new(typed, &plain)?,
        slots: typed
            .slots
            .map(|slots| Slots::new(slots, &ring))
            .transpose()?,
        wave_factors: WaveFactors::new(
            &typed.wave_factors,
            typed.slots.is_some(),
            file.membrane.is_some(),
        )?,
        ..plain
    })
}

/// Refuses a measured frequency that is not finite, and nodal diameters that do not belong to the frequencies of a row. JSON
/// has null in place of a number that is not finite, which means that it was not measured.
fn check_measured(file: &SceneFile) -> Result<(), SceneError> {
    for (index, row) in file.measured.iter().flat_map(|m| m.rows.iter()).enumerate() {
        let lost = |hz: &Option<f64>| hz.is_some_and(|hz| !hz.is_finite());
        if let Some(column) = row.frequencies_hz.iter().position(lost) {
            let key = format!("measured.rows[{index}].frequencies_hz[{column}]");
            let remedy = "give none where it was not measured";
            return Err(RefusedValue::new(key, "no finite number", "a frequency", remedy).into());
        }
        if let Some(diameters) = &row.diameters {
            check_diameters(&format!("measured.rows[{index}]"), row, diameters)?;
        }
    }
    Ok(())
}

/// Refuses nodal diameters of a row that turns, of another number than the frequencies, or of more frequencies than such
/// modes have.
fn check_diameters(key: &str, row: &MeasuredRow, diameters: &[u32]) -> Result<(), SceneError> {
    if row.rpm != 0.0 {
        let remedy = "leave out diameters, and give the frequencies in ascending order, since rotation splits every pair";
        let key = format!("{key}.rpm");
        return Err(refuse(
            &key,
            row.rpm,
            "0 for frequencies with diameters",
            remedy,
        ));
    }
    let (given, expected) = (diameters.len(), row.frequencies_hz.len());
    if given != expected {
        let allowed = format!("{expected} numbers, one for each of frequencies_hz");
        let remedy = "give the nodal diameters of every frequency, or of none";
        return Err(RefusedValue::new(format!("{key}.diameters"), given, allowed, remedy).into());
    }
    for (k, n) in diameters.iter().enumerate() {
        let most = if *n == 0 { 1 } else { 2 };
        if diameters[..k].iter().filter(|other| *other == n).count() == most {
            let key = format!("{key}.diameters[{k}]");
            let allowed = "0 once, and other numbers twice at most";
            let remedy = "leave out other frequencies: a mode without nodal diameters is single, others are pairs";
            return Err(refuse(&key, f64::from(*n), allowed, remedy));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measured_diameters_belong_to_the_frequencies_of_a_row_at_rest() {
        for (rpm, diameters, said) in [
            (0.0, vec![1, 0, 1], None),
            (300.0, vec![0, 1, 2], Some("measured.rows[0].rpm must be 0")),
            (0.0, vec![0, 1], Some("must be 3 numbers")),
            (0.0, vec![1, 1, 1], Some("diameters[2] must be 0 once")),
            (0.0, vec![0, 2, 0], Some("diameters[2] must be 0 once")),
        ] {
            let found = with(|file| {
                let rows = &mut file.measured.as_mut().unwrap().rows;
                rows.truncate(1);
                rows[0].rpm = rpm;
                rows[0].frequencies_hz = vec![Some(10.0), Some(12.0), None];
                rows[0].diameters = Some(diameters);
            });
            let error = found.err().map(|error| error.to_string());
            match said {
                None => assert_eq!(error, None),
                Some(said) => assert!(
                    error.as_ref().is_some_and(|e| e.contains(said)),
                    "{error:?}"
                ),
            }
        }
    }

    fn with(change: impl FnOnce(&mut SceneFile)) -> Result<Scene, SceneError> {
        Scene::paper().edited(change)
    }

    #[test]
    fn a_guide_without_stiffness_is_not_in_the_scene() {
        let scene = with(|f| f.guides[0].stiffness_n_per_m = 0.0).unwrap();
        assert!(scene.guides.is_empty());
    }
}
