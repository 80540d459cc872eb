use serde_json::{Value, json};

use super::*;
use crate::reference::{self, Facts};

fn settling(density: f64) -> Value {
    json!({"sedimentation": {"fluid": {"still": {"density": density, "viscosity": 1e-3}}}})
}

fn bead(diameter: f64) -> Value {
    json!({"single_sphere": {"grains": {"diameter": diameter, "density": 2560.0},
        "fluid": {"still": {"density": 1000.0, "viscosity": 8.9e-4}}}})
}

fn facts(settings: &Value) -> Facts<'_> {
    Facts {
        settings,
        scalars: &|_| None,
    }
}

fn scalar(name: &str, settings: &Value) -> Result<Expected, ReferenceError> {
    reference::scalar(name, &facts(settings))
}

/// A library of one table, for faults that the carried one does not have.
fn fault_of(reference: &str, table: &str, settings: &Value) -> String {
    let folder = tempfile::tempdir().unwrap();
    let index = format!(
        "citations: {{}}\ndatasets:\n- {{file: t.csv, title: t, citation_keys: [], provenance: p, confidence: c, \
         references: {{bed: {{meaning: m, {reference}}}}}}}\n"
    );
    std::fs::write(folder.path().join("references.yaml"), index).unwrap();
    std::fs::write(folder.path().join("t.csv"), table).unwrap();
    let library = match Library::open(folder.path()) {
        Ok(library) => Box::leak(Box::new(library)),
        Err(error) => return error.0,
    };
    let named = all(library).next().unwrap();
    let facts = facts(settings);
    let case = Case::of(&facts).unwrap();
    match named.is_curve() {
        true => named.points(&case).unwrap_err().0,
        false => named.scalar(&case).unwrap_err().0,
    }
}

#[test]
fn a_row_is_found_by_the_setting_of_the_run_whatever_the_fluid_model() {
    let quoted = scalar("dong_2006", &settling(2403.1)).unwrap();
    assert_eq!((quoted.values, quoted.unit), (vec![0.5487], "1"));
    assert!(quoted.source.contains("145505") && quoted.source.contains("Alvim"));
    let column = json!({"sedimentation": {"fluid": {"column": {"density": 500.0, "viscosity": 1e-3}}}});
    assert_eq!(scalar("alvim_2016_table7", &column).unwrap().values, [0.5977]);
    // Within a millionth it is the same density, beyond it is another.
    assert!(scalar("dong_2006", &settling(2403.1 * (1.0 + 0.9e-6))).is_ok());
    assert!(scalar("dong_2006", &settling(2403.1 * (1.0 + 1.1e-6))).is_err());
}

#[test]
fn a_setting_without_a_row_is_told_what_there_is() {
    assert_eq!(
        scalar("dong_2006", &settling(2000.0)).unwrap_err().0,
        "the reference `dong_2006` (alvim2016_table7_solid_fraction.csv) has no row with `fluid.density` 2000 kg/m³; \
         there are 500, 795.9, 1005.1, 1204.1, 1398, 1602, 1801, 1994.9, 2102, 2204.1, 2295.9, 2352, 2403.1 kg/m³"
    );
    assert_eq!(
        scalar("mordant_pinton_2000_terminal", &bead(1e-3)).unwrap_err().0,
        "the reference `mordant_pinton_2000_terminal` (mordant_pinton_2000_single_sphere.csv) has no row with \
         `grains.diameter` 0.001 m; there are 0.0005, 0.0008, 0.0015 m"
    );
    assert_eq!(
        scalar("dong_2006", &json!({"rehearsal": {"limit": 1.0}}))
            .unwrap_err()
            .0,
        "the reference `dong_2006` (alvim2016_table7_solid_fraction.csv) is looked up by `fluid.density`, a number \
         that the settings of `rehearsal` do not have"
    );
}

#[test]
fn a_curve_keeps_its_own_times_and_a_value_is_a_level() {
    let settings = bead(0.5e-3);
    let points = reference::points("mordant_pinton_2000_velocity", &facts(&settings)).unwrap();
    let points = points.expect("a curve");
    assert_eq!((points.times[0], points.values[0]), (0.0, 0.0));
    assert_eq!(points.times.len(), points.values.len());
    // At its own time to 95 % the fit stands at 95 % of its terminal velocity.
    let time = scalar("mordant_pinton_2000_time", &settings).unwrap().values[0];
    let terminal = scalar("mordant_pinton_2000_terminal", &settings).unwrap().values[0];
    let at = points.times.iter().position(|t| (t - time).abs() < 1e-9).unwrap();
    assert!((points.values[at] / terminal - 0.9502).abs() < 1e-4);

    assert_eq!(
        scalar("mordant_pinton_2000_velocity", &settings).unwrap_err().0,
        "the reference `mordant_pinton_2000_velocity` (mordant_pinton_2000_velocity.csv) is a measured curve: compare \
         a series with it, at its own times"
    );
    let level = reference::series("mordant_pinton_2000_terminal", &facts(&settings), &[0.0, 9.0]).unwrap();
    assert_eq!(level.values, [0.0741, 0.0741]);
    assert_eq!(
        reference::points("mordant_pinton_2000_terminal", &facts(&settings)),
        Ok(None)
    );
    assert_eq!(
        reference::points("terminal_velocity", &facts(&settings)),
        Ok(None)
    );
}

#[test]
fn a_data_set_at_fault_says_what_is_wrong_with_it() {
    let value = "value: {column: v, unit: m/s}";
    let by = "by: {fluid.density: {column: rho, unit: kg/m³}}";
    let curve = "over: {column: t, unit: s}";
    for (reference, table, message) in [
        (
            format!("{value}, {by}"),
            "rho,u\n1000,1\n",
            "t.csv: no column `v`; there are rho, u",
        ),
        (
            format!("{value}, {by}"),
            "rho,v\n1000,fast\n",
            "t.csv: `fast` in column `v` is no number",
        ),
        (
            format!("{value}, {by}"),
            "rho,v\n1000,1\n1000,2\n",
            "the reference `bed` (t.csv) has 2 rows for these settings, one is needed: give it another column under `by`",
        ),
        (value.to_owned(), "v\n", "the reference `bed` (t.csv) has no rows"),
        (
            format!("{value}, {curve}"),
            "t,v\n0,0\n2,1\n1,2\n",
            "the reference `bed` (t.csv) is not sorted: after 2 s comes 1 s; times of a curve must rise",
        ),
    ] {
        assert_eq!(fault_of(&reference, table, &settling(1000.0)), message);
    }
    let unknown = fault_of("value: {column: v, units: m/s}", "v\n1\n", &settling(1.0));
    assert!(unknown.contains("units"), "{unknown}");
}

#[test]
fn every_reference_of_the_index_reads_from_its_table() {
    let mut names = Vec::new();
    for named in all(Library::carried().unwrap()) {
        let table = named.library.dataset(named.file).unwrap();
        let columns = [Some(&named.reference.value), named.reference.over.as_ref()];
        let columns = columns.into_iter().flatten().chain(named.reference.by.values());
        for column in columns {
            let values = column.read(&table).unwrap();
            assert!(
                !values.is_empty() && values.iter().all(|value| value.is_finite()),
                "{}",
                named.name
            );
        }
        assert!(named.source().unwrap().contains('('), "{}", named.name);
        names.push(named.name);
    }
    let count = names.len();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), count, "two data sets share a name: {names:?}");
}
