//! The time series of a run.

use super::watch::{Row, Watch};
use crate::outcome::{Column, Table};
use crate::scene::Dimensions;

#[rustfmt::skip]
pub fn series(watch: &Watch) -> Table {
    let column = |name, unit, value: &dyn Fn(&Row) -> f64| Column {
        name,
        unit,
        values: watch.rows.iter().map(value).collect(),
    };
    let area = watch.scene.area();
    let mut columns = vec![
        column("time", "s", &|row| row.time),
        column("thickness", "m", &|row| row.measures.thickness),
        column("thickness_mean", "m", &|row| row.cake.thickness_mean),
        column("porosity", "1", &|row| row.measures.porosity),
        column("porosity_whole", "1", &|row| row.cake.porosity_whole),
        column("permeability", "m²", &|row| row.cake.permeability),
        column("flux", "m/s", &|row| row.flux),
        column("pressure_drop", "Pa", &|row| row.pressure_drop),
        column("cake_resistance", "1/m", &|row| row.cake.resistance),
        column("specific_resistance", "m/kg", &|row| row.cake.specific_resistance(area)),
        column("filtrate_volume", "m", &|row| row.filtrate),
        column("volume_since_deposit", "m", &|row| since_deposit(watch, row).1),
        column("time_over_volume", "s/m", &|row| time_over_volume(watch, row)),
        column("cake_solids_error", "1", &|row| row.cake.solids_error),
        column("deposited", "1", &|row| row.cake.deposited as f64),
        column("deposited_volume", "m³", &|row| row.cake.volume),
        column("deposited_mass", "kg", &|row| row.cake.mass),
        column("fed", "1", &|row| row.fed as f64),
        column("waiting", "1", &|row| row.waiting as f64),
        column("in_flight", "1", &|row| row.cake.in_flight as f64),
        column("passed", "1", &|row| row.passed as f64),
        column("volume_error", "1", &|row| row.cake.volume_error),
        column("settled_share", "1", &|row| row.measures.settled_share),
        column("centre_of_mass", "m", &|row| row.measures.centre_of_mass),
        column("top_height", "m", &|row| row.measures.top_height),
        column("mean_speed", "m/s", &|row| row.measures.mean_speed),
        column("kinetic_energy", "J", &|row| row.measures.kinetic_energy),
        column("coordination", "1", &|row| row.measures.coordination),
        column("largest_overlap", "1", &|row| row.deepest),
    ];
    if watch.scene.bed.dimensions == Dimensions::Two {
        columns.push(column("area_porosity", "1", &|row| row.measures.area_porosity));
    }
    if watch.scene.crossflow.is_some() {
        columns.push(column("surface_shear", "Pa", &|row| surface_shear(watch, row)));
        columns.push(column("grain_flux", "m/s", &|row| row.cake.grain_flux));
    }
    Table { name: "time_series", columns }
}

/// Time [s] and filtrate per area [m] since the cake began; no numbers before.
fn since_deposit(watch: &Watch, row: &Row) -> (f64, f64) {
    match begun(watch) {
        Some(first) if row.time >= first.time => (row.time - first.time, row.filtrate - first.filtrate),
        _ => (f64::NAN, f64::NAN),
    }
}

/// t/V [s/m] since the cake began.
fn time_over_volume(watch: &Watch, row: &Row) -> f64 {
    let (time, volume) = since_deposit(watch, row);
    time / volume
}

/// The first row with a cake.
pub fn begun<'a>(watch: &'a Watch) -> Option<&'a Row> {
    watch.rows.iter().find(|row| row.cake.deposited > 0)
}

/// Of the stream at the height of the surface [Pa]: the stream itself does not know the cake.
pub fn surface_shear(watch: &Watch, row: &Row) -> f64 {
    watch.scene.stream().map_or(f64::NAN, |stream| {
        watch.scene.viscosity() * stream.shear(stream.bottom + row.cake.thickness_mean)
    })
}
