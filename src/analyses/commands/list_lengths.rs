//! Lists of a report that belong together, such as speeds and frequencies, have equal lengths. A report is input, too: figures and tables
//! read such lists side by side, so that another length is refused where the report is read.

use serde_json::{Map, Value};

/// Lists with one entry for each entry of another one: key of their block, the lists, and the list of each level, `*` for a level of any
/// length. The other list is in the same block or in one around it, `a.b` in its block `a`. A list with a question mark may be empty.
const TOGETHER: &[(&str, &[&str], &[&str])] = &[
    ("", &["board_deviation_m", "deflection_m"], &["rpm"]),
    ("limits", &["margins"], &["values"]),
    ("response", &["board_deviation_m"], &["rpm"]),
    (
        "branches",
        &[
            "frequency_hz",
            "body_frequency_hz",
            "growth_per_s",
            "krein_sign",
            "dominant_harmonics",
        ],
        &["rpm"],
    ),
    (
        "curves",
        &[
            "deflection_m",
            "largest_deflection_m",
            "negative_eigenvalues",
            "before_hz",
            "fitted_hz",
            "rise_k",
        ],
        &["rpm"],
    ),
    (
        "arcs",
        &[
            "deflection_m",
            "largest_deflection_m",
            "largest_slope",
            "frequencies_hz",
        ],
        &["rpm"],
    ),
    ("arcs", &["pad_forces_n"], &["*", "rpm"]),
    (
        "deviation",
        &["deflection_m", "largest_deflection_m"],
        &["gap_factors", "forces_n"],
    ),
    (
        "deviation",
        &["pad_forces_n"],
        &["*", "gap_factors", "forces_n"],
    ),
    (
        "deviation",
        &["deflection_over_gap_and_speed_m"],
        &["gap_factors", "speeds_rpm"],
    ),
    (
        "deviation",
        &["force_within_n?", "speed_within_rpm?"],
        &["gap_factors"],
    ),
    ("deviation", &["deflection_over_speed_m"], &["speeds_rpm"]),
    (
        "deviation",
        &["pad_forces_over_speed_n"],
        &["*", "speeds_rpm"],
    ),
    (
        "oscillation",
        &[
            "neglected_share",
            "probe_mean_m",
            "probe_amplitude_m",
            "cut_mean_m",
            "cut_amplitude_m",
        ],
        &["rpm"],
    ),
    (
        "lines",
        &["probe_m", "amplitude_m", "phase_deg", "at_cut_m"],
        &["rpm"],
    ),
    ("operating", &["amplitude_m"], &["lines"]),
    (
        "points",
        &["receptance_m_per_n", "phase_deg"],
        &["frequency_hz"],
    ),
    ("friction", &["rise_k?"], &["radii_m"]),
    ("friction", &["pad_forces_n?"], &["pads"]),
    (
        "lobes",
        &[
            "critical_stiffness_n_per_m",
            "frequency_hz",
            "stable_to_n_per_m",
            "confirmed",
        ],
        &["rpm"],
    ),
    ("rim_stiffness", &["n_per_m"], &["rpm"]),
    ("map", &["goal_rpm", "kept"], &["y", "x"]),
    ("map", &["growth_per_s", "verdict"], &["load_level"]),
    ("membrane", &["radial_pa", "hoop_pa"], &["radius_m"]),
    ("heat", &["profile_k"], &["radius_m"]),
    ("critical_speeds", &["rise_k"], &["rpm"]),
    ("harmonics", &["cosine", "sine"], &["radius_m"]),
    ("cosine", &["re", "im"], &["radius_m"]),
    ("sine", &["re", "im"], &["radius_m"]),
    (
        "response",
        &["receptance_m_per_n"],
        &["rpm", "frequency_hz"],
    ),
    ("stretching", &["amplitude_m"], &["rpm", "frequency_hz"]),
    ("runs", &["deflection_m"], &["time_s"]),
    ("flutter", &["quantiles"], &["first_critical.quantiles"]),
    (
        "deflection_at_cut",
        &["quantiles"],
        &["first_critical.quantiles"],
    ),
    (
        "largest_pad_force",
        &["quantiles"],
        &["first_critical.quantiles"],
    ),
    (
        "critical_at_amplitude",
        &["quantiles"],
        &["first_critical.quantiles"],
    ),
    ("differences", &["values"], &["saws"]),
];

type Block = Map<String, Value>;

/// Checks the lists of a report.
///
/// # Errors
/// A sentence that names a list of a wrong length.
pub fn check(report: &Value) -> Result<(), String> {
    inside(report, "", "", &mut Vec::new())
}

/// Checks the blocks of a value at a path, which is the block `name` or a list of such blocks.
fn inside<'a>(
    value: &'a Value,
    name: &str,
    path: &str,
    around: &mut Vec<&'a Block>,
) -> Result<(), String> {
    match value {
        Value::Array(entries) => entries
            .iter()
            .enumerate()
            .try_for_each(|(k, entry)| inside(entry, name, &format!("{path}[{k}]"), around)),
        Value::Object(block) => {
            around.push(block);
            let own = TOGETHER.iter().filter(|(key, ..)| *key == name);
            for (_, members, levels) in own {
                for member in *members {
                    let key = member.trim_end_matches('?');
                    let list = block.get(key).unwrap_or(&Value::Null);
                    let may_be_empty = key.len() < member.len();
                    if !(may_be_empty && list.as_array().is_some_and(Vec::is_empty)) {
                        levels_match(list, levels, &below(path, key), around)?;
                    }
                }
            }
            for (key, entry) in block {
                inside(entry, key, &below(path, key), around)?;
            }
            around.pop();
            Ok(())
        }
        _ => Ok(()),
    }
}

fn below(path: &str, key: &str) -> String {
    if path.is_empty() {
        key.to_owned()
    } else {
        format!("{path}.{key}")
    }
}

/// Checks a list, and the lists in it, against the lists of their levels.
fn levels_match(
    list: &Value,
    levels: &[&str],
    path: &str,
    around: &[&Block],
) -> Result<(), String> {
    let (Some((level, inner)), Some(entries)) = (levels.split_first(), list.as_array()) else {
        return Ok(());
    };
    let mut blocks = around.iter().rev();
    let (outer, key) = level
        .split_once('.')
        .map_or((None, *level), |(outer, key)| (Some(outer), key));
    let other = blocks.find_map(|block| match outer {
        Some(outer) => block.get(outer)?.get(key)?.as_array(),
        None => block.get(key)?.as_array(),
    });
    if let Some(expected) = other
        .map(Vec::len)
        .filter(|expected| *expected != entries.len())
    {
        return Err(format!(
            "{path} has {} entries, but must have one for each of the {expected} of {level}; compute the report anew",
            entries.len()
        ));
    }
    let mut all = entries.iter().enumerate();
    all.try_for_each(|(k, entry)| levels_match(entry, inner, &format!("{path}[{k}]"), around))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn a_list_of_another_length_is_named_with_both_lengths() {
        let report = json!({"campbell": {"branches": [
            {"rpm": [0, 1, 2], "frequency_hz": [5, 6, 7], "growth_per_s": []},
        ]}});
        let said = check(&report).unwrap_err();
        assert!(said.starts_with("campbell.branches[0].growth_per_s has 0 entries, but must have one for each of the 3 of rpm"), "{said}");
        let map = |row: serde_json::Value| json!({"deviation": {"gap_factors": [0, 1], "forces_n": [1, 2], "deflection_m": row}});
        assert_eq!(check(&map(json!([[1, null], [3, 4]]))), Ok(()));
        let said = check(&map(json!([[1, 2], [3]]))).unwrap_err();
        assert!(
            said.starts_with("deviation.deflection_m[1] has 1 entries")
                && said.contains("the 2 of forces_n"),
            "{said}"
        );
        // The speeds of the lines are those of the report around them.
        assert!(check(&json!({"rpm": [1], "lines": [{"at_cut_m": []}]})).is_err());
    }
}
