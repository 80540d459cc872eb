//! Curves of runs that differ in nothing but the seed, as their mean and scatter.

use crate::judge::select::same;
use crate::judge::statistics::Sample;
use crate::store::model::{Column, Run, Scalar, Table};

/// Column of the sample standard deviation of another: no observable has a name with a space.
pub fn deviation_of(column: &str) -> String {
    format!("{column} deviation")
}

/// One run per setting, its tables averaged over seeds at the abscissae of the first; nothing when no
/// setting has several seeds. Averages end where the shortest run ends.
pub fn averaged(runs: &[&Run]) -> Option<Vec<Run>> {
    let mut settings: Vec<Vec<&Run>> = Vec::new();
    for run in runs {
        match settings.iter_mut().find(|members| same_setting(members[0], run)) {
            Some(members) => members.push(run),
            None => settings.push(vec![run]),
        }
    }
    if settings.len() == runs.len() {
        return None;
    }
    let mean = |members: &Vec<&Run>| {
        let first = members[0];
        let averaged = first.tables.iter().filter_map(|table| average(members, table));
        Run {
            tables: averaged.collect(),
            scalars: scalars(members),
            ..first.clone()
        }
    };
    Some(settings.iter().map(mean).collect())
}

/// Means of the scalars that all have.
fn scalars(runs: &[&Run]) -> Vec<Scalar> {
    let mean = |scalar: &Scalar| {
        let values: Option<Vec<f64>> = runs
            .iter()
            .map(|run| Some(run.scalar(&scalar.name)?.value))
            .collect();
        Some(Scalar {
            value: Sample::of(values?).mean,
            ..scalar.clone()
        })
    };
    runs[0].scalars.iter().filter_map(mean).collect()
}

/// For the caption.
pub fn note(runs: &[&Run], settings: usize) -> String {
    let mut seeds: Vec<u64> = runs.iter().map(|run| run.seed).collect();
    seeds.sort_unstable();
    seeds.dedup();
    let whole = seeds.len() * settings == runs.len();
    let count = match whole {
        true => format!("{} seeds", seeds.len()),
        false => format!("up to {} seeds", seeds.len()),
    };
    format!("Lines: means over {count}; bands: ± one sample standard deviation.")
}

fn same_setting(one: &Run, other: &Run) -> bool {
    let pairs = one.axes.iter().zip(&other.axes);
    one.scene == other.scene
        && one.axes.len() == other.axes.len()
        && pairs
            .into_iter()
            .all(|((name, value), (other, found))| name == other && same(value, found))
}

/// The table over all of these runs; nothing where one lacks it or its abscissa does not rise.
fn average(runs: &[&Run], table: &Table) -> Option<Table> {
    let tables: Option<Vec<&Table>> = runs.iter().map(|run| run.table(&table.name)).collect();
    let tables = tables?;
    let rises = |table: &&Table| {
        let first = table.columns.first();
        first.is_some_and(|first| first.values.windows(2).all(|pair| pair[1] > pair[0]))
    };
    if !tables.iter().all(rises) {
        return None;
    }
    let last = |table: &&Table| {
        table
            .columns
            .first()
            .and_then(|first| first.values.last().copied())
    };
    let end = tables.iter().filter_map(last).fold(f64::INFINITY, f64::min);
    let begin = tables.iter().filter_map(|table| table.columns[0].values.first());
    let begin = begin.copied().fold(f64::NEG_INFINITY, f64::max);
    let mut abscissa = table.columns[0].clone();
    abscissa.values.retain(|at| (begin..=end).contains(at));
    let mut columns = vec![abscissa.clone()];
    for column in &table.columns[1..] {
        let found: Option<Vec<(&[f64], &[f64])>> = tables
            .iter()
            .map(|table| {
                Some((
                    table.columns[0].values.as_slice(),
                    table.column(&column.name)?.values.as_slice(),
                ))
            })
            .collect();
        let found = found?;
        let samples: Vec<Sample> = abscissa
            .values
            .iter()
            .map(|at| Sample::of(found.iter().map(|(x, y)| between(x, y, *at))))
            .collect();
        let of = |name: String, number: fn(&Sample) -> f64| Column {
            name,
            unit: column.unit.clone(),
            values: samples.iter().map(number).collect(),
        };
        columns.push(of(column.name.clone(), |sample| sample.mean));
        columns.push(of(deviation_of(&column.name), |sample| sample.deviation));
    }
    Some(Table {
        name: table.name.clone(),
        columns,
    })
}

/// Linear between neighbours; `x` rises.
fn between(x: &[f64], y: &[f64], at: f64) -> f64 {
    let above = x.partition_point(|place| *place < at);
    match (above.checked_sub(1), x.get(above)) {
        (Some(below), Some(next)) => {
            let share = (at - x[below]) / (next - x[below]);
            y[below] + share * (y[above] - y[below])
        }
        (Some(below), None) => y[below],
        (None, _) => y.first().copied().unwrap_or(f64::NAN),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::store::model::{PointId, Status, Timing};

    fn run(seed: u64, times: &[f64], slope: f64) -> Run {
        let column = |name: &str, values: Vec<f64>| Column {
            name: name.into(),
            unit: "1".into(),
            values,
        };
        let values = times.iter().map(|time| slope * time).collect();
        Run {
            id: PointId(seed.to_string()),
            study: String::new(),
            scene: "bed".into(),
            axes: Vec::new(),
            seed,
            settings: serde_json::Value::Null,
            status: Status::Completed,
            reason: None,
            scalars: Vec::new(),
            counters: Vec::new(),
            tables: vec![Table {
                name: "time_series".into(),
                columns: vec![column("time", times.to_vec()), column("height", values)],
            }],
            derived: Vec::new(),
            timing: Timing::default(),
        }
    }

    #[test]
    fn curves_at_other_instants_meet_at_those_of_the_first() {
        let (one, other) = (run(1, &[0.0, 1.0, 2.0, 3.0], 1.0), run(2, &[0.0, 0.7, 2.2], 3.0));
        let mean = averaged(&[&one, &other]).unwrap();
        let table = mean[0].table("time_series").unwrap();
        assert_eq!(table.columns[0].values, [0.0, 1.0, 2.0]);
        for (found, expected) in table.column("height").unwrap().values.iter().zip([0.0, 2.0, 4.0]) {
            assert!((found - expected).abs() < 1e-12);
        }
        let scatter = &table.column(&deviation_of("height")).unwrap().values;
        assert!((scatter[2] - 2.0 * 2f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn single_seeds_stay_what_they_are() {
        let one = run(1, &[0.0, 1.0], 1.0);
        let mut other = run(1, &[0.0, 1.0], 1.0);
        other.scene = "block".into();
        assert!(averaged(&[&one, &other]).is_none());
    }
}
