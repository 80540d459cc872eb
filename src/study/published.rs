//! Names and units of published data: what `references.yaml` offers to `against`.
//!
//! Only the index is read here; the values belong to the references.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use kynch_sim::scene::ObservableKind;
use serde::Deserialize;

const INDEX: &str = include_str!("../../references/references.yaml");

/// A reference of a data set.
pub struct Published {
    pub name: String,
    pub kind: ObservableKind,
    /// SI unit.
    pub unit: String,
}

#[derive(Deserialize)]
struct Index {
    datasets: Vec<DataSet>,
}

#[derive(Deserialize)]
struct DataSet {
    #[serde(default)]
    references: BTreeMap<String, Reference>,
}

#[derive(Deserialize)]
struct Reference {
    value: Column,
    over: Option<Column>,
}

#[derive(Deserialize)]
struct Column {
    unit: String,
}

/// Every reference of the data sets; none where the index is at fault, which a test excludes.
pub fn published() -> &'static [Published] {
    static LIST: LazyLock<Vec<Published>> = LazyLock::new(|| read(INDEX));
    &LIST
}

fn read(index: &str) -> Vec<Published> {
    let index: Index = serde_saphyr::from_str(index).unwrap_or(Index { datasets: Vec::new() });
    let references = index.datasets.into_iter().flat_map(|set| set.references);
    references
        .map(|(name, reference)| Published {
            name,
            kind: match reference.over {
                Some(_) => ObservableKind::Series,
                None => ObservableKind::Scalar,
            },
            unit: reference.value.unit,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::units;

    #[test]
    fn values_and_curves_of_the_index_are_known_with_units_that_parse() {
        let kind = |name: &str| {
            published()
                .iter()
                .find(|entry| entry.name == name)
                .map(|entry| entry.kind)
        };
        assert_eq!(kind("dong_2006"), Some(ObservableKind::Scalar));
        assert_eq!(kind("mordant_pinton_2000_velocity"), Some(ObservableKind::Series));
        for entry in published() {
            assert!(units::dimension(&entry.unit).is_some(), "{}", entry.unit);
        }
    }
}
