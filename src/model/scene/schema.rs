//! The JSON schema of a scene: keys and types as in [`SceneFile`], numbers as in the table of quantities.

use serde_json::{Map, Value, json};

use super::SceneFile;
use super::quantity::Quantity;

/// A key of a schema.
#[cfg_attr(
    not(feature = "cli"),
    allow(dead_code, reason = "the command `keys` prints them")
)]
pub(crate) struct Key {
    /// JSON path, with `[]` for any index of a list. The entries of a list of numbers are keys of their own.
    pub path: String,
    /// JSON pointer to the schema of its value.
    pub pointer: String,
    /// Whether its block must have it.
    pub is_required: bool,
    /// Kind of the block, if its keys depend on its kind.
    pub of_kind: Option<String>,
}

/// JSON schema of a scene file. Numbers have their range, and their unit, name, usual range, if it is narrower, and typical value
/// as `x-unit`, `x-name`, `x-usual` and `x-typical`.
pub fn json_schema() -> Value {
    let mut schema = schemars::schema_for!(SceneFile).to_value();
    for key in keys(&schema) {
        let quantity = Quantity::of(&key.path).filter(|quantity| quantity.path == key.path);
        let node = schema.pointer_mut(&key.pointer);
        if let Some((quantity, Value::Object(node))) = quantity.zip(node) {
            describe(quantity, node);
        }
    }
    schema
}

/// Adds what the table has of a number to its schema.
fn describe(quantity: &Quantity, node: &mut Map<String, Value>) {
    let allowed = quantity.allowed;
    node.remove("minimum");
    let ends = [
        (
            "minimum",
            "exclusiveMinimum",
            allowed.is_open_below,
            allowed.from,
        ),
        (
            "maximum",
            "exclusiveMaximum",
            allowed.is_open_above,
            allowed.to,
        ),
    ];
    for (closed, open, is_open, end) in ends {
        node.insert(if is_open { open } else { closed }.to_owned(), json!(end));
    }
    node.insert("x-name".to_owned(), json!(quantity.name));
    if !quantity.unit.is_empty() {
        node.insert("x-unit".to_owned(), json!(quantity.unit));
    }
    if quantity.usual != (allowed.from, allowed.to) {
        node.insert("x-usual".to_owned(), json!(quantity.usual));
    }
    if let Some(typical) = quantity.typical {
        node.insert("x-typical".to_owned(), json!(typical));
        let known = node
            .get("description")
            .and_then(Value::as_str)
            .unwrap_or_default()
            .to_owned();
        let description = json!(format!("{known} {}", typical.sentence()));
        node.insert("description".to_owned(), description);
        if typical.is_number() {
            node.insert("examples".to_owned(), json!([typical.value]));
        }
    }
}

/// All keys of a schema in their order, each before the keys that it contains.
pub(crate) fn keys(schema: &Value) -> Vec<Key> {
    let mut found = Vec::new();
    below(schema, "", "", None, &mut found);
    found
}

/// Collects the keys below a node of a schema; `of_kind` is the kind of the block that the node describes.
fn below(schema: &Value, pointer: &str, path: &str, of_kind: Option<&str>, found: &mut Vec<Key>) {
    let node = schema.pointer(pointer).unwrap_or(&Value::Null);
    if let Some(name) = node["$ref"].as_str() {
        below(schema, name.trim_start_matches('#'), path, of_kind, found);
    }
    for word in ["anyOf", "oneOf"] {
        for (k, variant) in listed(&node[word]).iter().enumerate() {
            let kind = variant["properties"]["kind"]["const"].as_str();
            below(schema, &format!("{pointer}/{word}/{k}"), path, kind, found);
        }
    }
    let required = listed(&node["required"]);
    let mut add = |path: String, pointer: String, name: &str| {
        if found.iter().any(|key| key.path == path) {
            return;
        }
        found.push(Key {
            path: path.clone(),
            pointer: pointer.clone(),
            is_required: required.iter().any(|own| own == name),
            of_kind: of_kind.filter(|_| name != "kind").map(str::to_owned),
        });
        below(schema, &pointer, &path, None, found);
    };
    if !node["items"].is_null() {
        add(format!("{path}[]"), format!("{pointer}/items"), "");
    }
    for (name, _) in node["properties"].as_object().into_iter().flatten() {
        let dot = if path.is_empty() { "" } else { "." };
        add(
            format!("{path}{dot}{name}"),
            format!("{pointer}/properties/{name}"),
            name,
        );
    }
}

fn listed(list: &Value) -> &[Value] {
    list.as_array().map_or(&[], Vec::as_slice)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The texts are those of the reference of JSON Schema 2020-12.
    #[test]
    fn numbers_have_range_unit_and_typical_value() {
        let schema = json_schema();
        let node = |path: &str| {
            let key = keys(&schema).into_iter().find(|key| key.path == path);
            schema
                .pointer(&key.expect(path).pointer)
                .expect(path)
                .clone()
        };
        let poisson = node("blade.material.poisson_ratio");
        assert_eq!(poisson["exclusiveMinimum"], -1.0);
        assert_eq!(poisson["exclusiveMaximum"], 0.5);
        assert_eq!(
            (&poisson["minimum"], &poisson["x-unit"]),
            (&Value::Null, &Value::Null)
        );
        let share = node("damping.loss_factor");
        assert_eq!(
            (&share["minimum"], &share["maximum"]),
            (&json!(0.0), &json!(1.0))
        );
        let stiffness = node("guides[].stiffness_n_per_m");
        assert_eq!(stiffness["x-unit"], "N/m");
        assert_eq!(stiffness["examples"][0], 1e7);
        let words = stiffness["description"].as_str().expect("a description");
        assert!(
            words.contains("Typically 1e7, from 1e6 to 2e8 ("),
            "{words}"
        );
        assert_eq!(node("mount.diameter_m")["x-unit"], "m");
        assert_eq!(node("cut.washboarding.pitches_deg[]")["x-unit"], "°");
    }
}
