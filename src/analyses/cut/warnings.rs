//! Remarks on the forces and the validity of a cut.

use std::f64::consts::TAU;

use super::{CutAtSpeed, CutCriterion, CutStability};
use crate::analyses::campbell::Verdict;
use crate::motion::stretched_blade::LARGEST_SLOPE;
use crate::motion::transient::LINEAR_THICKNESSES;

/// Beyond this many thicknesses a plate stretches as it bends and is stiffer than the linear model.
const SMALL_THICKNESSES: f64 = 1.0;

pub(super) fn warnings(run: &CutAtSpeed, teeth: f64, thickness_m: f64) -> Vec<String> {
    let all = [
        single_blows(run, teeth),
        against_power(run),
        without_lateral_force(run),
        moving_loads_alone(run),
        large_deflection(run, thickness_m),
        moving_loads_deflect(run, thickness_m),
        contradicted(run),
    ];
    all.into_iter().flatten().collect()
}

fn single_blows(run: &CutAtSpeed, teeth: f64) -> Option<String> {
    (teeth < 1.0).then(|| {
        format!(
            "at {:.0} rpm a tooth is in the cut for {:.0} % of the time: the mean forces leave the blows of single teeth out, which only the criterion of moving tooth loads includes",
            run.rpm,
            100.0 * teeth
        )
    })
}

fn contradicted(run: &CutAtSpeed) -> Option<String> {
    let certificate = &run.certificate;
    (!certificate.is_clean()).then(|| {
        format!(
            "at {:.0} rpm the checks contradict the growing modes: {}",
            run.rpm, certificate.statement
        )
    })
}

fn against_power(run: &CutAtSpeed) -> Option<String> {
    let by_power = run.by_power.as_ref()?;
    let ratio = run.tangential_n_per_tooth / by_power.tangential_n_per_tooth;
    ((ratio - 1.0).abs() > 0.05).then(|| {
        format!(
            "at {:.0} rpm the given tangential force, {:.0} N per tooth, is {ratio:.1} times the {:.0} N that correspond to the power; with the latter {}",
            run.rpm,
            run.tangential_n_per_tooth,
            by_power.tangential_n_per_tooth,
            match by_power.verdict {
                Verdict::Stable => "no vibration grows".to_owned(),
                Verdict::Unstable => format!("a vibration grows by {:.2} 1/s", by_power.growth_per_s),
            }
        )
    })
}

fn without_lateral_force(run: &CutAtSpeed) -> Option<String> {
    (run.lateral_n_per_tooth == 0.0).then(|| {
        format!(
            "at {:.0} rpm no lateral force excites the blade, so the time history contains no motion; give cut.lateral_n_per_tooth",
            run.rpm
        )
    })
}

/// Remark if moving teeth excite a resonance that stationary and mean loads do not.
fn moving_loads_alone(run: &CutAtSpeed) -> Option<String> {
    let passing = &run.tooth_passing;
    let others = passing
        .standing_growth_per_s
        .max(passing.mean_growth_per_s)
        .max(run.growth_per_s);
    let alone = run.decided_by == CutCriterion::MovingToothLoads
        && run.stability == CutStability::Unstable
        && others < 0.5 * passing.passing_growth_per_s;
    // The resonance is about as wide as the change of speed that changes the tooth frequency, in rad/s, by
    // the growth rate.
    let width_rpm = run.rpm * passing.passing_growth_per_s / (TAU * passing.tooth_frequency_hz);
    alone.then(|| {
        format!(
            "at {:.0} rpm only the moving tooth loads are unstable: two modes are in resonance with the teeth, {:.0} of which pass in a second; such a resonance is narrow, here of the order of {} rpm, and its exact speed depends on modes of equally high frequency",
            run.rpm,
            passing.tooth_frequency_hz,
            one_digit(width_rpm)
        )
    })
}

fn seconds(seconds: f64) -> String {
    if seconds >= 1e-3 {
        format!("{seconds:.3} s")
    } else {
        "less than a millisecond".into()
    }
}

fn one_digit(value: f64) -> String {
    let decimals = (-value.max(1e-6).log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.decimals$}")
}

/// Remark if the moving loads alone cause this deflection.
fn moving_loads_deflect(run: &CutAtSpeed, thickness_m: f64) -> Option<String> {
    if run.stretching.is_some() {
        return run.tooth_passing.passing_deflection_m.is_none().then(|| format!(
            "at {:.0} rpm the moving tooth loads, which are computed without stretching, deflect the rim by more than {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm); the record with stretching has stationary loads",
            run.rpm,
            1e3 * LINEAR_THICKNESSES * thickness_m
        ));
    }
    let alone = run.linear_until_s.is_none() && run.tooth_passing.passing_deflection_m.is_none();
    alone.then(|| {
        format!(
            "at {:.0} rpm the moving tooth loads deflect the rim by more than {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm), beyond the linear model; stationary loads do not",
            run.rpm,
            1e3 * LINEAR_THICKNESSES * thickness_m
        )
    })
}

/// Time after the start or the end of the forces, as text.
fn moment(run: &CutAtSpeed, until_s: f64) -> String {
    if until_s > run.forces_to_s {
        format!("{} after the cut", seconds(until_s - run.forces_to_s))
    } else {
        format!("{} into the cut", seconds(until_s - run.forces_from_s))
    }
}

fn large_deflection(run: &CutAtSpeed, thickness_m: f64) -> Option<String> {
    if let Some(found) = &run.stretching {
        return found.valid_until_s.map(|until_s| {
            format!(
                "at {:.0} rpm slopes of the blade exceed {LARGEST_SLOPE} {}: the model with stretching ends there, and the record with it",
                run.rpm,
                moment(run, until_s)
            )
        });
    }
    if let Some(until_s) = run.linear_until_s {
        return Some(format!(
            "at {:.0} rpm the deflection of the rim exceeds {LINEAR_THICKNESSES} thicknesses of the blade ({:.1} mm) {}: the linear model ends there, and the record with it; the growth rate of small motions remains right",
            run.rpm,
            1e3 * LINEAR_THICKNESSES * thickness_m,
            moment(run, until_s),
        ));
    }
    let largest = [
        run.largest_deflection_in_cut_m,
        run.largest_deflection_after_m,
    ];
    let largest_m = largest.into_iter().flatten().fold(0.0_f64, f64::max);
    (largest_m > SMALL_THICKNESSES * thickness_m).then(|| {
        format!(
            "at {:.0} rpm the deflection reaches {:.1} mm, {:.1} times the thickness of the blade: beyond one thickness a blade stretches as it bends, which the linear model neglects and `cut.stretching` includes",
            run.rpm,
            1e3 * largest_m,
            largest_m / thickness_m
        )
    })
}
