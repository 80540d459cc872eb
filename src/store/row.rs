//! The table `runs`: one row per run, parameters and results as typed columns.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::canonical::canonical;
use super::cells::{Cell, Reader, counts, numbers, texts, typed};
use super::error::StoreError;
use super::file::Series;
use super::model::{PointId, Run, Scalar, Status, Timing};
use super::series::TableFile;
use super::timing;
use super::units::unit_of;
use crate::study::model::AxisValue;

pub(super) const IDENTITY: &str = "identity";
pub(super) const AXIS: &str = "axis";
pub(super) const SETTING: &str = "setting";
pub(super) const RESULT: &str = "result";
pub(super) const COUNTER: &str = "counter";

/// Columns that every store has.
const FIXED: [&str; 9] = [
    "id",
    "study",
    "scene",
    "kind",
    "seed",
    "status",
    "reason",
    "settings_json",
    "contents_json",
];

/// A run without its tables, and where those are.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Row {
    pub run: Run,
    pub tables: Vec<TableFile>,
}

/// Order, names and units of what a row holds: what columns alone do not tell.
#[derive(Serialize, Deserialize)]
struct Contents {
    axes: Vec<(String, Value)>,
    scalars: Vec<(String, String)>,
    counters: Vec<String>,
    tables: Vec<TableFile>,
}

/// The columns of `runs` for these rows, in a fixed order.
pub(super) fn columns(
    rows: &[&Row],
    axis_units: &BTreeMap<String, String>,
) -> Result<Vec<Series>, StoreError> {
    let mut all = identity_columns(rows);
    all.extend(axis_columns(rows, axis_units));
    all.extend(setting_columns(rows));
    all.extend(result_columns(rows));
    all.extend(counter_columns(rows));
    let settings = texts(rows.iter().map(|row| Some(canonical(&row.run.settings))));
    let contents = rows
        .iter()
        .map(|row| contents(row))
        .collect::<Result<Vec<_>, _>>()?;
    let contents = texts(contents.into_iter().map(Some));
    all.push(Series::new(
        "settings_json",
        IDENTITY,
        "settings_json",
        None,
        settings,
    ));
    all.push(Series::new(
        "contents_json",
        IDENTITY,
        "contents_json",
        None,
        contents,
    ));
    Ok(all)
}

fn identity_columns(rows: &[&Row]) -> Vec<Series> {
    let text = |name, read: fn(&Run) -> Option<&str>| {
        Series::new(
            name,
            IDENTITY,
            name,
            None,
            texts(rows.iter().map(|row| read(&row.run))),
        )
    };
    let seeds = counts(rows.iter().map(|row| Some(row.run.seed)));
    vec![
        text("id", |run| Some(&run.id.0)),
        text("study", |run| Some(&run.study)),
        text("scene", |run| Some(&run.scene)),
        text("kind", |run| kind(&run.settings).map(|(name, _)| name)),
        Series::new("seed", IDENTITY, "seed", None, seeds),
        text("status", |run| Some(run.status.name())),
        text("reason", |run| run.reason.as_deref()),
    ]
}

/// The kind of a scene and its fields, from settings of the form `{kind: {…}}`.
fn kind(settings: &Value) -> Option<(&str, &Value)> {
    let fields = settings.as_object().filter(|fields| fields.len() == 1)?;
    let (name, inner) = fields.iter().next()?;
    inner.is_object().then_some((name.as_str(), inner))
}

fn axis_columns(rows: &[&Row], units: &BTreeMap<String, String>) -> Vec<Series> {
    let names: BTreeSet<&String> = rows
        .iter()
        .flat_map(|row| row.run.axes.iter().map(|(name, _)| name))
        .collect();
    let column = |name: &String| {
        let cells: Vec<_> = rows.iter().map(|row| row.run.axis(name).map(cell)).collect();
        let unit = units.get(name).map(String::as_str).or_else(|| unit_of(name));
        let unit = unit.filter(|unit| !unit.is_empty());
        Series::new(&format!("axes.{name}"), AXIS, name, unit, typed(&cells))
    };
    names.into_iter().map(column).collect()
}

fn cell(value: &AxisValue) -> Cell {
    match value {
        AxisValue::Number(number) => Cell::Number(*number),
        AxisValue::Flag(flag) => Cell::Flag(*flag),
        AxisValue::Word(word) => Cell::Text(word.clone()),
    }
}

fn setting_columns(rows: &[&Row]) -> Vec<Series> {
    let trees: Vec<BTreeMap<String, Cell>> = rows
        .iter()
        .map(|row| {
            let mut leaves = BTreeMap::new();
            let tree = kind(&row.run.settings).map_or(&row.run.settings, |(_, inner)| inner);
            flatten(tree, "", &mut leaves);
            leaves
        })
        .collect();
    let names: BTreeSet<&String> = trees.iter().flat_map(BTreeMap::keys).collect();
    let column = |name: &String| {
        let cells: Vec<_> = trees.iter().map(|leaves| leaves.get(name).cloned()).collect();
        let values = typed(&cells);
        let field = name.rsplit('.').next().unwrap_or(name);
        let unit = unit_of(field).filter(|_| values.data_type().is_numeric());
        Series::new(&format!("settings.{name}"), SETTING, name, unit, values)
    };
    names.into_iter().map(column).collect()
}

/// Leaves of a tree by dotted path. Lists become text; absent values have no column entry.
fn flatten(tree: &Value, path: &str, leaves: &mut BTreeMap<String, Cell>) {
    let value = match tree {
        Value::Object(fields) => {
            for (name, branch) in fields {
                let separator = if path.is_empty() { "" } else { "." };
                flatten(branch, &format!("{path}{separator}{name}"), leaves);
            }
            return;
        }
        Value::Null => return,
        Value::Bool(flag) => Cell::Flag(*flag),
        Value::Number(number) => match number.as_i64() {
            Some(integer) => Cell::Integer(integer),
            None => Cell::Number(number.as_f64().unwrap_or(f64::NAN)),
        },
        Value::String(word) => Cell::Text(word.clone()),
        Value::Array(_) => Cell::Text(canonical(tree)),
    };
    leaves.insert(path.to_string(), value);
}

fn result_columns(rows: &[&Row]) -> Vec<Series> {
    let mut units: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
    for scalar in rows.iter().flat_map(|row| &row.run.scalars) {
        units.entry(&scalar.name).or_default().insert(&scalar.unit);
    }
    let mut all = Vec::new();
    for (name, units) in units {
        let taken = FIXED.contains(&name) || timing::NAMES.contains(&name);
        let plain = if taken {
            format!("result.{name}")
        } else {
            name.to_string()
        };
        for unit in &units {
            // The same name with two units is two quantities: never in one column.
            let column = if units.len() > 1 {
                format!("{plain} [{unit}]")
            } else {
                plain.clone()
            };
            let value = |row: &&Row| {
                let mut scalars = row.run.scalars.iter();
                scalars
                    .find(|scalar| scalar.name == name && scalar.unit == **unit)
                    .map(|scalar| scalar.value)
            };
            let values = numbers(rows.iter().map(value));
            all.push(Series::new(&column, RESULT, name, Some(unit), values));
        }
    }
    all
}

fn counter_columns(rows: &[&Row]) -> Vec<Series> {
    let names: BTreeSet<&String> = rows
        .iter()
        .flat_map(|row| row.run.counters.iter().map(|(name, _)| name))
        .collect();
    let column = |name: &String| {
        let value = |row: &&Row| {
            let mut counters = row.run.counters.iter();
            counters
                .find(|(counter, _)| counter == name)
                .map(|(_, value)| *value)
        };
        let values = counts(rows.iter().map(value));
        Series::new(&format!("counters.{name}"), COUNTER, name, Some("1"), values)
    };
    names.into_iter().map(column).collect()
}

/// # Errors
/// A name that occurs twice: its column could not hold both.
pub(super) fn check(run: &Run) -> Result<(), StoreError> {
    let mut seen = BTreeSet::new();
    let axes = run.axes.iter().map(|(name, _)| ("axis", name));
    let scalars = run.scalars.iter().map(|scalar| ("result", &scalar.name));
    let counters = run.counters.iter().map(|(name, _)| ("counter", name));
    let tables = run.tables.iter().map(|table| ("table", &table.name));
    for (role, name) in axes.chain(scalars).chain(counters).chain(tables) {
        if !seen.insert((role, name)) {
            return Err(StoreError::invalid(format!(
                "two of its {role} entries are called `{name}`"
            )));
        }
    }
    Ok(())
}

fn contents(row: &Row) -> Result<String, StoreError> {
    let axes = row
        .run
        .axes
        .iter()
        .map(|(name, value)| (name.clone(), exact(value)));
    let contents = Contents {
        axes: axes.collect(),
        scalars: row
            .run
            .scalars
            .iter()
            .map(|scalar| (scalar.name.clone(), scalar.unit.clone()))
            .collect(),
        counters: row.run.counters.iter().map(|(name, _)| name.clone()).collect(),
        tables: row.tables.clone(),
    };
    serde_json::to_string(&contents).map_err(|error| StoreError::invalid(error.to_string()))
}

/// JSON knows no infinities: those are written as `{"number": "inf"}`.
fn exact(value: &AxisValue) -> Value {
    match value {
        AxisValue::Number(number) if !number.is_finite() => {
            serde_json::json!({ "number": number.to_string() })
        }
        AxisValue::Number(number) => (*number).into(),
        AxisValue::Flag(flag) => (*flag).into(),
        AxisValue::Word(word) => word.as_str().into(),
    }
}

fn axis_value(value: &Value) -> Option<AxisValue> {
    match value {
        Value::Object(fields) => fields
            .get("number")?
            .as_str()?
            .parse()
            .ok()
            .map(AxisValue::Number),
        Value::Number(number) => number.as_f64().map(AxisValue::Number),
        Value::Bool(flag) => Some(AxisValue::Flag(*flag)),
        Value::String(word) => Some(AxisValue::Word(word.clone())),
        _ => None,
    }
}

/// A row read back, without its timing.
pub(super) fn decode(reader: &Reader, row: usize) -> Result<Row, StoreError> {
    let broken = |what: &str| StoreError::damaged(reader.file, format!("row {row}: `{what}` cannot be read"));
    let contents: Contents =
        serde_json::from_str(&reader.word("contents_json", row)?).map_err(|_| broken("contents_json"))?;
    let axes = contents
        .axes
        .into_iter()
        .map(|(name, value)| Some((name, axis_value(&value)?)));
    let scalar = |(name, unit): (String, String)| {
        let column = reader.find(RESULT, &name, Some(&unit))?;
        let value = reader.number_of(column, &name, row)?;
        Ok(Scalar { name, unit, value })
    };
    let counter = |name: String| {
        let column = reader.find(COUNTER, &name, None)?;
        let value = reader.count_of(column, &name, row)?;
        Ok((name, value))
    };
    let run = Run {
        id: PointId(reader.word("id", row)?),
        study: reader.word("study", row)?,
        scene: reader.word("scene", row)?,
        axes: axes.collect::<Option<_>>().ok_or_else(|| broken("axes"))?,
        seed: reader.count("seed", row)?,
        settings: serde_json::from_str(&reader.word("settings_json", row)?)
            .map_err(|_| broken("settings_json"))?,
        status: Status::from_name(&reader.word("status", row)?).ok_or_else(|| broken("status"))?,
        reason: reader.text("reason", row)?,
        scalars: contents
            .scalars
            .into_iter()
            .map(scalar)
            .collect::<Result<_, StoreError>>()?,
        counters: contents
            .counters
            .into_iter()
            .map(counter)
            .collect::<Result<_, StoreError>>()?,
        tables: Vec::new(),
        derived: Vec::new(),
        timing: Timing::default(),
    };
    Ok(Row {
        run,
        tables: contents.tables,
    })
}
