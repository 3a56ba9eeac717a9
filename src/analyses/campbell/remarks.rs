//! Terms of the equation of motion that were assembled, and remarks on the validity of the result.

use std::f64::consts::TAU;

use crate::model::plate::{MembraneSource, Plate};
use crate::model::scene::{Blade, Bore, Guide, PadLaw, Scene, SceneFile, rpm};
use crate::modes::DescribedMode;
use crate::page::text::{shown, shown_to};
use crate::stability::{Analysis, CHARTED, Shortened, is_cut_short, usual_end};

use super::certificate::BandCertificate;
use super::pad_places::{beside_the_blade, overlapping};
use super::slot_remarks::{factored, loaded, passing, slotted};

/// Relative rounding error above which a frequency has fewer than six valid digits.
const LEAST_DIGITS: f64 = 1e-6;

/// Stiffness of the stiffest pad in the trials that calibrated the error estimate.
const CALIBRATED_N_PER_M: f64 = 1e9;

/// How far a side force at the cut deflects the blade at a speed, from the factor of
/// [`OperatingPoint::side_force_factor`](super::OperatingPoint::side_force_factor); `None` without a factor.
pub fn side_force_in_words(rpm: f64, factor: Option<f64>, scene: &SceneFile) -> Option<String> {
    let factor = factor?;
    let touching = if scene.has_gaps() {
        ", with guides that touch it"
    } else {
        ""
    };
    let direction = if factor < 0.0 {
        ", in the opposite direction"
    } else {
        ""
    };
    Some(format!(
        "at {} rpm a side force at the cut deflects the blade {} times as far as at rest{direction}{touching}",
        shown_to(6, rpm),
        shown_to(2, factor.abs())
    ))
}

/// Terms of the equation of motion that were assembled.
pub fn terms(scene: &Scene, plate: &Plate) -> Vec<String> {
    let always = [
        "bending K_b",
        "centrifugal stress K_sigma",
        "rotation N",
        "gyroscopic G",
    ];
    let mut terms: Vec<String> = always.map(String::from).to_vec();
    let mut add = |present: bool, name: &str| {
        if present {
            terms.push(name.to_owned());
        }
    };
    add(
        plate.blade.profile.is_some(),
        "thickness over the radius in M, K_b and K_sigma",
    );
    add(plate.blade.rim.is_some(), "mass of teeth in M and K_sigma");
    add(plate.blade.slots.is_some(), "slots in K_b and K_sigma");
    add(
        plate.blade.wave_factors.is_some(),
        "factors of waves in K_b and K_sigma",
    );
    for (source, name) in [
        (MembraneSource::Heat, "heat K_m"),
        (MembraneSource::RollTension, "roll tension K_m"),
        (MembraneSource::Residual, "residual stress K_m"),
    ] {
        let membrane = plate.membrane.as_ref();
        add(membrane.is_some_and(|stress| stress.has(source)), name);
    }
    add(plate.edge_stiffness.is_some(), "forces of the cut K_e");
    let guides = scene.guides().iter();
    let stiff = guides
        .clone()
        .any(|guide| guide.typed.stiffness_n_per_m > 0.0);
    add(stiff, "guide stiffness K_g");
    let damped = guides
        .clone()
        .any(|guide| guide.typed.damping_n_s_per_m > 0.0);
    add(damped, "guide damping C");
    let films = guides.clone().any(|guide| guide.typed.film.is_some());
    add(films, "lag of guide films");
    let controlled = guides.clone().any(|guide| guide.typed.controller.is_some());
    add(controlled, "guide controllers");
    let in_cut = scene.cut().filter(|cut| cut.chart.is_some());
    let wood = in_cut.and_then(|cut| cut.wood);
    add(
        wood.is_some_and(|wood| wood.typed.stiffness_n_per_m > 0.0),
        "wood stiffness K_g",
    );
    add(
        wood.is_some_and(|wood| wood.typed.damping_n_s_per_m > 0.0),
        "wood damping C",
    );
    let damping = plate.damping.as_ref();
    add(
        damping.is_some_and(|d| d.air_n_s_per_m3 > 0.0),
        "air damping C",
    );
    add(
        damping.is_some_and(|d| d.air_n_s_per_m3 * d.air_rotation_share > 0.0),
        "turning air K_circ",
    );
    let material = damping.is_some_and(|d| d.is_material());
    add(material, "material damping C and K_circ");
    terms
}

/// Warnings that this scene is near the limits of the model.
pub fn warnings(
    scene: &Scene,
    analysis: &Analysis,
    certificate: &BandCertificate,
    at_rest: &[DescribedMode],
    listed_critical: usize,
) -> Vec<String> {
    let found = [
        out_of_reach(scene, analysis),
        uncalibrated(scene),
        unstable_pads(scene),
        beside_the_blade(scene),
        overlapping(scene),
        thick(&analysis.model.plate.blade),
        out_of_balance(scene),
        rounded(analysis, at_rest),
        unsettled(analysis),
        contradicted(certificate),
        left_free(analysis),
        ended_early(scene, analysis, listed_critical),
        lifting_off(scene),
        sagging(analysis),
        rolled_alone(scene),
        passing(scene, analysis),
        slotted(&analysis.model.plate),
        factored(&analysis.model.plate.blade),
        loaded(scene),
    ];
    found.into_iter().flatten().collect()
}

/// Names the growing poles of controllers of pads.
fn unstable_pads(scene: &Scene) -> Option<String> {
    let of_guide = |guide: &Guide| {
        let poles = guide
            .controller
            .iter()
            .flat_map(PadLaw::growing_poles_per_s);
        let shown = poles.map(|pole| match pole.im {
            0.0 => format!("{} 1/s", shown_to(4, pole.re)),
            im => format!("{} ± {}i 1/s", shown_to(4, pole.re), shown_to(4, im)),
        });
        let shown: Vec<String> = shown.collect();
        let key = format!("guides[{}].controller", guide.index);
        (!shown.is_empty()).then(|| format!("{key} has the growing poles {}", shown.join(", ")))
    };
    let named: Vec<String> = scene.guides().iter().filter_map(of_guide).collect();
    (!named.is_empty()).then(|| {
        let named = named.join("; ");
        format!("{named}: the controller grows without the blade; only with it may both be stable")
    })
}

fn out_of_reach(scene: &Scene, analysis: &Analysis) -> Option<String> {
    if analysis.reaches_tolerance() {
        return None;
    }
    let error = shown_to(2, analysis.promised_error()?);
    let functions = analysis.model.plate.degrees_of_freedom();
    let tolerance = shown(scene.tolerance());
    let Some(found) = analysis.out_of_reach else {
        return Some(format!(
            "the tolerance {tolerance} is out of reach of {functions} functions; reached: {error}"
        ));
    };
    let most = if found.is_dense {
        " (the most for a saw with damping, forces at the rim or many stiff guides)"
    } else {
        ""
    };
    let guide = found.guide.map_or(String::new(), |guide| {
        format!("; guides[{guide}] causes the sharpest bending: more area or less stiffness helps")
    });
    let needed = found.functions.map_or(String::new(), |needed| {
        let hundreds = 100.0 * (needed / 100.0).ceil();
        format!("; by extrapolation some {hundreds} functions would reach it")
    });
    Some(format!(
        "the tolerance {tolerance} is out of reach of {functions} functions{most}; reached: {error}{guide}{needed}"
    ))
}

/// Warning that the sweep chosen by the program ends at a lower speed than usual, or below the first critical speed.
fn ended_early(scene: &Scene, analysis: &Analysis, listed_critical: usize) -> Option<String> {
    let critical = analysis.critical_rad_per_s();
    let usual = usual_end(scene, critical.first().copied());
    let end = analysis.range_rad_per_s.to_rad_per_s;
    let first = critical.first().filter(|first| **first > end);
    if let Some(first) = first.filter(|_| scene.sweep().is_none()) {
        return Some(format!(
            "the sweep ends at {} rpm, below the first critical speed, {} rpm: from there on rotation stretches the rim by more than a tenth",
            shown_to(5, rpm(end)),
            shown_to(6, rpm(*first))
        ));
    }
    let is_early = scene.sweep().is_none() && end < 0.99 * usual;
    let passed = critical.partition_point(|critical| *critical <= end);
    let reason = if is_cut_short(scene, &critical) && passed >= CHARTED {
        format!(
            "{listed_critical} critical speeds are below its end; name sweep.to_rpm for a longer one"
        )
    } else if analysis.shortened == Some(Shortened::Time) {
        "the search for bands would take more than a minute of processor time; name sweep.from_rpm and sweep.to_rpm to chart the speeds above"
            .to_owned()
    } else {
        "the modes of so many speeds would not fit into the memory allowed; a coarser accuracy permits a longer sweep".to_owned()
    };
    is_early.then(|| {
        format!(
            "the sweep ends at {} rpm, and not at {}: {reason}",
            shown_to(5, rpm(end)),
            shown_to(3, rpm(usual))
        )
    })
}

fn uncalibrated(scene: &Scene) -> Option<String> {
    let mut guides = scene.guides().iter();
    let stiff = guides.any(|guide| guide.typed.stiffness_n_per_m > CALIBRATED_N_PER_M);
    stiff.then(|| {
        format!(
            "a guide is stiffer than {CALIBRATED_N_PER_M:e} N/m: the estimated error is \
             calibrated on softer ones and may be too small"
        )
    })
}

fn thick(blade: &Blade) -> Option<String> {
    let share = blade.thickness_range_m()[1] / (blade.outer_radius_m - blade.inner_radius_m);
    (share > 0.1).then(|| {
        format!("the thickness is {share:.2} of the width of the ring; thin-plate theory is valid below 0.1")
    })
}

fn out_of_balance(scene: &Scene) -> Option<String> {
    let residual = scene.membrane()?.residual_stress.as_ref()?;
    (residual.imbalance != 0.0).then(|| {
        format!(
            "the measured hoop stress is out of balance by {:.1} % of its size; its mean was subtracted, because the edges of the blade are free",
            100.0 * residual.imbalance
        )
    })
}

fn rounded(analysis: &Analysis, at_rest: &[DescribedMode]) -> Option<String> {
    let rounded = |m: &&DescribedMode| analysis.model.relative_rounding(&m.mode) > LEAST_DIGITS;
    let highest = at_rest.iter().rfind(rounded)?;
    Some(format!(
        "the frequencies of this scene are so far apart that rounding leaves fewer than \
         six digits of those up to {} Hz",
        shown_to(4, highest.mode.frequency_rad_per_s() / TAU)
    ))
}

fn unsettled(analysis: &Analysis) -> Option<String> {
    let error_hz = analysis.model.unsettled_rad_per_s / TAU;
    (error_hz > 0.0).then(|| {
        format!(
            "the sweep is too long for the reduced model: its frequencies may be wrong by {} Hz; a shorter sweep avoids this",
            shown_to(2, error_hz)
        )
    })
}

/// Warning that the deflection under the straight edge is no longer small.
fn sagging(analysis: &Analysis) -> Option<String> {
    let reading = analysis.straight_edge.as_ref()?;
    let measured = reading.measured.map(|(_, found)| found);
    let found = measured.or(reading.rolled).unwrap_or(reading.plain);
    let sag_m = found.sag_m.abs().max((found.sag_m - found.gap_m).abs());
    let thickness_m = analysis.model.plate.blade.thickness_range_m()[0];
    (sag_m > thickness_m).then(|| {
        format!(
            "on the two points of membrane.straight_edge the blade sags by {} mm, {} times its thickness: the light gap is that of small deflections",
            shown_to(2, 1e3 * sag_m),
            shown_to(2, sag_m / thickness_m)
        )
    })
}

/// Warning that the light gap leaves out a measured stress, which is known for the mounted blade only.
fn rolled_alone(scene: &Scene) -> Option<String> {
    let membrane = scene.membrane()?;
    let left_out = membrane.straight_edge.is_some() && membrane.residual_stress.is_some();
    left_out.then(|| {
        "the light gap of membrane.straight_edge is that of the rolled bands alone, without residual_stress"
            .to_owned()
    })
}

fn contradicted(certificate: &BandCertificate) -> Option<String> {
    let statement = &certificate.statement;
    (!certificate.is_clean())
        .then(|| format!("{statement}: a mode or a band may be missing or wrong there"))
}

fn left_free(analysis: &Analysis) -> Option<String> {
    let free_bore = matches!(analysis.model.plate.blade.bore, Bore::Free);
    let free = free_bore && analysis.model.has_free_motions();
    free.then(|| {
        "nothing holds the blade against some rigid motion, which the list of modes excludes"
            .to_owned()
    })
}

/// Remark on the linear treatment of pads that lift off.
pub(crate) fn lifting_off(scene: &Scene) -> Option<String> {
    let lifting = scene
        .guides()
        .iter()
        .filter_map(|guide| Some((guide, guide.lifting?)));
    let each: Vec<String> = lifting
        .map(|(guide, law)| {
            let within = match law.film_stiffness_n_per_m {
                0.0 => "nothing of it holds the blade".to_owned(),
                film => format!("only its film of {} N/m holds the blade", shown(film)),
            };
            let gap_mm = shown(1e3 * law.gap_m);
            let place = guide.index;
            if law.presses_on_flat_blade() { format!(
                    "guides[{place}] lifts off: its offset of {} mm exceeds its gap of {gap_mm} mm, so that it presses on the flat blade; \
                     where the blade leaves it, {within}",
                    shown(1e3 * law.offset_m)
                ) } else { format!("guides[{place}] lifts off: within its gap of {gap_mm} mm {within}") }
        })
        .collect();
    (!each.is_empty()).then(|| {
        format!(
            "{}. The linear model (Campbell diagram, critical speeds, bands, checks) treats such a guide as a spring of its full \
             stiffness at any deflection: it describes a blade that is preloaded, or deflected far beyond the gap; deflect, \
             runup.stretching and cut.stretching follow the contact",
            each.join("; ")
        )
    })
}
