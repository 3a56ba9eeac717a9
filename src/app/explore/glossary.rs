//! The glossary of the documentation, which the page shows beside its words.

use std::collections::BTreeMap;

const PAGE: &str = include_str!("../../../docs/reference/glossary.md");
/// Formulas of the glossary as plain text.
const SYMBOLS: [(&str, &str); 7] = [
    ("\\operatorname{Re}", "Re "),
    ("\\operatorname{Im}", "Im "),
    ("\\lambda", "λ"),
    ("\\mathrm{e}^{λ t}", "exp(λt)"),
    ("\\,", " "),
    ("$", ""),
    ("`", ""),
];

/// Returns the terms whose definitions can be written without formulas, in small letters, with their definitions.
pub fn glossary() -> BTreeMap<String, String> {
    let lines: Vec<&str> = PAGE.lines().collect();
    let entries = lines.windows(2).filter_map(|pair| {
        let definition = pair[1].strip_prefix("  ").map(plain)?;
        let is_plain = !definition.contains(['\\', '{', '^']);
        is_plain.then(|| (pair[0].to_lowercase(), definition))
    });
    entries.collect()
}

/// Removes references, and replaces links and formulas by their text.
fn plain(markdown: &str) -> String {
    let mut text = SYMBOLS
        .iter()
        .fold(without(markdown, " ({eq}`", ")"), |text, (from, to)| {
            text.replace(from, to)
        });
    text = without(&text, "](", ")");
    text.replace('[', "")
}

/// Removes each part of a text from `from` to the next `to`.
fn without(text: &str, from: &str, to: &str) -> String {
    let mut parts = text.split(from);
    let mut kept = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        kept.push_str(part.split_once(to).map_or(part, |(_, after)| after));
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn definitions_are_plain_text() {
        let all = glossary();
        let of = |term: &str| all.get(term).map(String::as_str);
        let lacking = all
            .values()
            .filter(|text| text.contains(['$', '`', '[', ']', '\\', '{']));
        assert_eq!(lacking.count(), 0);
        assert_eq!(of("growth rate"), Some("Re λ, in 1/s; negative for decay."));
        assert_eq!(
            of("critical speed"),
            Some("A speed at which an eigenvalue is zero in space: a wave stands still there.")
        );
        let certificate = of("certificate").unwrap();
        assert!(certificate.ends_with("see what the certificate proves."));
        assert!(all.len() > 45, "{}", all.len());
    }
}
