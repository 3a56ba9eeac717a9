//! Remarks on slots: what the model makes of them, and what it does not cover.

use crate::model::plate::Plate;
use crate::model::scene::{Blade, Scene, SceneFile, SlotPassing, rpm};
use crate::page::text::shown_to;
use crate::stability::Analysis;

/// Share of a wave in one mode below which the wave is said to be mixed with others.
const MIXED: f64 = 0.9;

/// Names the blade for which an error is estimated, unless it is that of the scene.
pub(super) fn of_model(scene: &SceneFile) -> &'static str {
    if scene.blade.slots.is_some() || !scene.blade.wave_factors.is_empty() {
        " of the axisymmetric blade"
    } else {
        ""
    }
}

/// Names the waves that slots split, and those that they mix with others.
pub(super) fn slotted(plate: &Plate) -> Option<String> {
    let slotted = plate.slotted()?;
    let waves = || slotted.waves.iter().enumerate().skip(2);
    let split = waves().filter_map(|(n, own)| match own.as_slice() {
        [low, high] => {
            let apart = 100.0 * ((high.bending / low.bending).sqrt() - 1.0);
            Some(format!("n = {n} by {} %", shown_to(2, apart)))
        }
        _ => None,
    });
    let split: Vec<String> = split.take(3).collect();
    let split = if split.is_empty() {
        String::new()
    } else {
        format!(
            "; pairs of waves are split at rest ({}), and critical speeds are those of the lower branch",
            split.join(", ")
        )
    };
    let mut mixed = waves().filter(|(_, own)| own.iter().any(|branch| branch.share < MIXED));
    let mixed = mixed.next().map_or(String::new(), |(n, _)| {
        format!(
            "; from {n} nodal diameters on, modes of the slotted blade mix several waves, for which single waves with a mean stand here"
        )
    });
    Some(format!(
        "the slots are cuts of width zero without holes, in an axisymmetric blade of the same bending and mean stress, whose critical \
         speeds are up to 0.7 % too high{split}{mixed}"
    ))
}

/// Names the waves whose stiffness is given against that of a plain blade.
pub(super) fn factored(blade: &Blade) -> Option<String> {
    let factors = blade.wave_factors.as_ref()?;
    let listed = factors.rows().iter().map(|row| row.diameters.to_string());
    let listed: Vec<String> = listed.collect();
    let widest = factors.rows().iter().filter(|row| row.split > 0.0);
    let widest = widest.max_by(|x, y| x.split.total_cmp(&y.split));
    let split = widest.map_or(String::new(), |row| {
        format!(
            "; pairs of waves are split at rest (n = {} by {} %), and critical speeds are those of the lower branch",
            row.diameters,
            shown_to(2, 100.0 * row.split)
        )
    });
    Some(format!(
        "waves of {} nodal diameters have the stiffness that blade.wave_factors give; others have the factors of the next listed ones with \
         more diameters, and beyond these the smallest of all{split}",
        listed.join(", ")
    ))
}

/// Says what is not covered where slots pass guides.
pub(super) fn passing(scene: &Scene, analysis: &Analysis) -> Option<String> {
    let where_covered = match scene.file().slot_passing()? {
        SlotPassing::Inside if analysis.hull().is_some() => {
            "all guides end well inside the slots, and the speeds given as unstable or not certain, the hull of the bands with the lower \
             branch, the mean and the upper branch of split pairs and 1 % beside them, contained all growth above the first critical speed \
             of the saws that were tried"
        }
        SlotPassing::Inside => {
            "all guides end well inside the slots, where this matters above the first critical speed: no speed above it is called stable"
        }
        SlotPassing::Beside => {
            "a guide or wood lies beside the slots or close to their ends, where most speeds may grow: no speed is called stable"
        }
        SlotPassing::Unplaced => {
            "no speed is called stable, since blade.wave_factors do not say where the slots are: give blade.slots"
        }
    };
    let computed = match &analysis.floquet {
        None => "is not computed".to_owned(),
        Some(Err(why)) => format!("is not computed, not at the operating speed either: {why}"),
        Some(Ok(nearby)) => {
            let operating = rpm(nearby.at[1].speed_rad_per_s);
            format!(
                "is computed by Floquet multipliers of the slotted blade at {} rpm and 1 % beside it alone",
                shown_to(6, operating)
            )
        }
    };
    Some(format!(
        "slots turn and guides do not, so that vibrations may also grow at speeds outside the listed bands (parametric resonance), which \
         {computed}; elsewhere {where_covered}"
    ))
}

/// Names the loads that act on the blade as if it had no slots.
pub(super) fn loaded(scene: &Scene) -> Option<String> {
    let slots = scene.file().blade.slots?;
    let in_cut = scene.cut().is_some_and(|cut| cut.chart.is_some());
    in_cut.then(|| {
        format!(
            "the forces of the cut stress the blade here as if it had no slots; it has {}",
            slots.count
        )
    })
}
