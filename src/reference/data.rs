//! Published data as references: columns of the tables in `references/`, named in `references.yaml`.
//!
//! ```yaml
//! references:
//!   dong_2006:
//!     meaning: final solids fraction against fluid density
//!     value: {column: solid_fraction, unit: "1"}
//!     by: {fluid.density: {column: rho_f_kg_m3, unit: kg/m³}}
//! ```
//!
//! `by` looks rows up by settings of the run. With `over`, a column of times, what is left is a curve; without
//! it, a single value. Units are SI units; `factor` brings a column to them.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::library::{DataSet, Library};
use super::settings::Case;
use super::{Entry, Expected, Points, ReferenceError};

/// A setting is that of a row when they differ by less than this, relative to the row.
const SAME: f64 = 1e-6;

/// What `references.yaml` says of a reference.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataReference {
    pub meaning: String,
    pub value: DataColumn,
    /// Times of a curve.
    pub over: Option<DataColumn>,
    /// Settings of the run, as dotted paths, and the columns they are looked up in.
    #[serde(default)]
    pub by: BTreeMap<String, DataColumn>,
    /// Where the file cites more than this reference needs.
    pub citation_keys: Option<Vec<String>>,
}

/// A column with its unit.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataColumn {
    pub column: String,
    /// SI unit of the column times `factor`.
    pub unit: String,
    #[serde(default = "one")]
    pub factor: f64,
}

fn one() -> f64 {
    1.0
}

/// A reference with the table it stands in.
pub(super) struct Named<'a> {
    name: &'a str,
    file: &'a str,
    reference: &'a DataReference,
    library: &'a Library,
}

/// The data reference of that name, if there is one.
pub(super) fn find(name: &str) -> Result<Option<Named<'static>>, ReferenceError> {
    Ok(all(Library::carried()?).find(|named| named.name == name))
}

/// Lines for `kynch list`; empty when the index is at fault, which [`find`] reports.
pub(super) fn list() -> Vec<Entry> {
    let Ok(library) = Library::carried() else {
        return Vec::new();
    };
    let entries = library.datasets().iter().flat_map(|set| {
        set.references.iter().map(|(name, reference)| Entry {
            name,
            meaning: &reference.meaning,
            source: &set.title,
        })
    });
    entries.collect()
}

fn all(library: &Library) -> impl Iterator<Item = Named<'_>> {
    library.datasets().iter().flat_map(move |set| {
        set.references.iter().map(move |(name, reference)| Named {
            name,
            file: &set.file,
            reference,
            library,
        })
    })
}

impl DataColumn {
    /// In SI units.
    fn read(&self, table: &DataSet) -> Result<Vec<f64>, ReferenceError> {
        let mut values = table.numbers(&self.column)?;
        values.iter_mut().for_each(|value| *value *= self.factor);
        Ok(values)
    }
}

impl Named<'static> {
    pub fn scalar(&self, case: &Case) -> Result<Expected, ReferenceError> {
        if self.is_curve() {
            return Err(self.fault("is a measured curve: compare a series with it, at its own times"));
        }
        let table = self.library.dataset(self.file)?;
        let rows = self.rows(&table, case)?;
        let [row] = rows[..] else {
            return Err(self.fault(&format!(
                "has {} rows for these settings, one is needed: give it another column under `by`",
                rows.len()
            )));
        };
        Ok(Expected {
            values: vec![self.reference.value.read(&table)?[row]],
            unit: &self.reference.value.unit,
            source: self.source()?,
        })
    }

    pub fn points(&self, case: &Case) -> Result<Points, ReferenceError> {
        let table = self.library.dataset(self.file)?;
        let (times, values) = self.curve(&table, case)?;
        Ok(Points {
            times,
            values,
            unit: &self.reference.value.unit,
            source: self.source()?,
        })
    }
}

impl Named<'_> {
    pub fn is_curve(&self) -> bool {
        self.reference.over.is_some()
    }

    fn source(&self) -> Result<String, ReferenceError> {
        match &self.reference.citation_keys {
            Some(keys) => self.library.cited(self.file, keys),
            None => self.library.source(self.file),
        }
    }

    fn curve(&self, table: &DataSet, case: &Case) -> Result<(Vec<f64>, Vec<f64>), ReferenceError> {
        let rows = self.rows(table, case)?;
        let over = self.reference.over.as_ref();
        let times = over.map_or(Ok(Vec::new()), |over| over.read(table))?;
        let values = self.reference.value.read(table)?;
        let times: Vec<f64> = rows.iter().filter_map(|&row| times.get(row).copied()).collect();
        if let Some(pair) = times.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(self.fault(&format!(
                "is not sorted: after {} s comes {} s; times of a curve must rise",
                pair[0], pair[1]
            )));
        }
        Ok((times, rows.into_iter().map(|row| values[row]).collect()))
    }

    /// Rows that belong to the settings; never empty.
    fn rows(&self, table: &DataSet, case: &Case) -> Result<Vec<usize>, ReferenceError> {
        let mut rows: Vec<usize> = (0..table.len()).collect();
        for (path, column) in &self.reference.by {
            let setting = case.chosen_number(path).ok_or_else(|| {
                self.fault(&format!(
                    "is looked up by `{path}`, a number that the settings of `{}` do not have",
                    case.kind
                ))
            })?;
            let keys = column.read(table)?;
            let here: Vec<f64> = rows.iter().map(|&row| keys[row]).collect();
            rows.retain(|&row| (setting - keys[row]).abs() <= SAME * keys[row].abs());
            if rows.is_empty() {
                return Err(self.fault(&format!(
                    "has no row with `{path}` {}; there are {}",
                    with_unit(setting, &column.unit),
                    listed(here, &column.unit)
                )));
            }
        }
        match rows.is_empty() {
            true => Err(self.fault("has no rows")),
            false => Ok(rows),
        }
    }

    fn fault(&self, what: &str) -> ReferenceError {
        ReferenceError(format!("the reference `{}` ({}) {what}", self.name, self.file))
    }
}

fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "1" => value.to_string(),
        unit => format!("{value} {unit}"),
    }
}

/// Distinct values in rising order: `500, 795.9, 1005.1 kg/m³`.
fn listed(mut values: Vec<f64>, unit: &str) -> String {
    values.sort_by(f64::total_cmp);
    values.dedup_by(|a, b| (*a - *b).abs() <= SAME * b.abs());
    // A factor leaves digits behind that the table does not have.
    let round = |value: f64| format!("{value:.9e}").parse::<f64>().unwrap_or(value).to_string();
    let list: Vec<String> = values.into_iter().map(round).collect();
    match unit {
        "1" => list.join(", "),
        unit => format!("{} {unit}", list.join(", ")),
    }
}

#[cfg(test)]
mod tests;
