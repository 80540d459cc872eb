//! One text for one tree of settings: keys sorted, no blanks, shortest exact numbers.

use serde_json::Value;

/// Canonical JSON. Two equal trees give the same text whatever the order of their keys; the text
/// parses back to the same numbers, bit for bit.
pub fn canonical(tree: &Value) -> String {
    let mut text = String::new();
    write(tree, &mut text);
    text
}

fn write(tree: &Value, text: &mut String) {
    match tree {
        Value::Object(fields) => {
            let mut names: Vec<&String> = fields.keys().collect();
            names.sort();
            text.push('{');
            for (position, name) in names.into_iter().enumerate() {
                separate(position, text);
                text.push_str(&Value::from(name.as_str()).to_string());
                text.push(':');
                write(&fields[name], text);
            }
            text.push('}');
        }
        Value::Array(items) => {
            text.push('[');
            for (position, item) in items.iter().enumerate() {
                separate(position, text);
                write(item, text);
            }
            text.push(']');
        }
        leaf => text.push_str(&leaf.to_string()),
    }
}

fn separate(position: usize, text: &mut String) {
    if position > 0 {
        text.push(',');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn key_order_does_not_matter_at_any_depth() {
        let one: Value =
            serde_json::from_str(r#"{"b": {"y": 1, "x": [2.5, {"q": 1, "p": 2}]}, "a": 0.1}"#).unwrap();
        let other: Value =
            serde_json::from_str(r#"{"a": 0.1, "b": {"x": [2.5, {"p": 2, "q": 1}], "y": 1}}"#).unwrap();
        assert_eq!(canonical(&one), canonical(&other));
    }

    #[test]
    fn numbers_survive_bit_for_bit() {
        for number in [0.1, 1.0 / 3.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, -0.0, 8.9e-4] {
            let text = canonical(&serde_json::json!({ "x": number }));
            let back: Value = serde_json::from_str(&text).unwrap();
            assert_eq!(
                back["x"].as_f64().unwrap().to_bits(),
                f64::to_bits(number),
                "{text}"
            );
        }
    }
}
