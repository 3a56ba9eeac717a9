//! All keys that an object must have and has not, by the schema of its type: the parser names the first one alone.

use schemars::{JsonSchema, schema_for};
use serde_json::Value;

/// JSON paths of the missing keys of a text.
pub(super) fn missing_keys<T: JsonSchema>(data: &Value) -> Vec<String> {
    let schema = schema_for!(T).to_value();
    let mut found = Vec::new();
    collect(&schema, &schema, data, "", &mut found);
    found
}

/// Collects the missing keys below a node of a schema.
fn collect(schema: &Value, node: &Value, data: &Value, path: &str, found: &mut Vec<String>) {
    if let Some(name) = node["$ref"].as_str() {
        let of_name = schema.pointer(name.trim_start_matches('#'));
        collect(schema, of_name.unwrap_or(&Value::Null), data, path, found);
    }
    if let Some(variant) = chosen(node, data) {
        collect(schema, variant, data, path, found);
    }
    for (index, entry) in data.as_array().into_iter().flatten().enumerate() {
        collect(
            schema,
            &node["items"],
            entry,
            &format!("{path}[{index}]"),
            found,
        );
    }
    let Some(block) = data.as_object() else {
        return;
    };
    let dot = if path.is_empty() { "" } else { "." };
    let required = node["required"].as_array().into_iter().flatten();
    let names = required.filter_map(Value::as_str);
    found.extend(
        names
            .filter(|name| !block.contains_key(*name))
            .map(|name| format!("{path}{dot}{name}")),
    );
    for (name, value) in block {
        let below = &node["properties"][name];
        collect(schema, below, value, &format!("{path}{dot}{name}"), found);
    }
}

/// The variant of a schema that a block is: the only one apart from null, or the one of its kind.
fn chosen<'a>(node: &'a Value, data: &Value) -> Option<&'a Value> {
    let variants = ["anyOf", "oneOf"]
        .iter()
        .filter_map(|word| node[word].as_array());
    let mut possible = variants.flatten().filter(|variant| {
        let kind = &variant["properties"]["kind"]["const"];
        variant["type"] != "null" && (kind.is_null() || *kind == data["kind"])
    });
    let first = possible.next()?;
    possible.next().is_none().then_some(first)
}
