//! What a run gives back.

use super::cake::layers;
use super::series::{begun, series, surface_shear};
use super::watch::{Row, Watch};
use crate::outcome::{Column, Outcome, Scalar, Table};
use crate::scene::course::work_of;
use crate::scene::sedimentation::growth::Growth;
use crate::scene::sedimentation::observe::{porosity_interior, profile, whole_area_porosity};
use crate::scene::{Dimensions, Floor, Sides};

/// Share of the run, at its end, over which a balance of erosion and deposition shows [-].
const END: f64 = 0.1;
/// Growth over that share, over the thickness, below which the cake counts as stopped [-].
const STOPPED: f64 = 0.02;
/// Between these shares of the deposit at the end it grows evenly [-].
const GROWING: [f64; 2] = [0.2, 0.8];
/// Share of the flux at the start below which it has begun to fall [-].
const FALLEN: f64 = 0.98;
/// Share of the grains fed that must be in flight then [-].
const IN_FLIGHT: f64 = 0.01;

/// `snapshots` makes their table from the contacts of each place.
pub fn outcome(watch: &Watch, snapshots: impl Fn(&[u16]) -> Option<Table>) -> Outcome {
    let bed = &watch.bed;
    let mut tables = vec![
        series(watch),
        porosity_profile(watch),
        permeability_profile(watch),
    ];
    let settled = watch.settled.as_ref();
    tables.extend(snapshots(
        settled.map_or(&[][..], |settled| settled.contacts.as_slice()),
    ));
    Outcome {
        scalars: scalars(watch),
        tables,
        counters: work_of(bed),
    }
}

fn scalars(watch: &Watch) -> Vec<Scalar> {
    let mut scalars = Vec::new();
    let mut add = |name, unit, value| scalars.push(Scalar { name, unit, value });
    of_shape(watch, &mut add);
    of_medium(watch, &mut add);
    of_flow_across(watch, &mut add);
    of_cake(watch, &mut add);
    of_filtrate(watch, &mut add);
    of_grains(watch, &mut add);
    of_growth(watch, &mut add);
    of_run(watch, &mut add);
    scalars
}

type Add<'a> = &'a mut dyn FnMut(&'static str, &'static str, f64);

fn last(watch: &Watch) -> Row {
    watch.rows.last().copied().unwrap_or_default()
}

fn of_shape(watch: &Watch, add: Add) {
    let (scene, row) = (&watch.scene.bed, last(watch));
    if scene.dimensions == Dimensions::Two {
        add("area_porosity", "1", row.measures.area_porosity);
        let whole = watch.settled.as_ref().map_or(f64::NAN, |settled| {
            whole_area_porosity(scene, &watch.bed, settled, row.measures.thickness)
        });
        add("area_porosity_whole", "1", whole);
    } else if scene.container.sides == Sides::Walls {
        let known = row.cake.deposited > 0;
        let interior = porosity_interior(scene, &watch.bed, row.measures.slice);
        add("porosity_interior", "1", if known { interior } else { f64::NAN });
    }
}

fn of_medium(watch: &Watch, add: Add) {
    let (scene, grains) = (&watch.scene.bed, &watch.bed.grains);
    if let Floor::Grains(floor) = scene.container.floor {
        add("medium_grain_diameter", "m", floor.diameter);
        add("medium_grains", "1", (grains.len() - grains.moving) as f64);
        add("medium_pitch", "m", floor.pitch(scene.container.width));
    }
}

fn of_flow_across(watch: &Watch, add: Add) {
    let Some(stream) = watch.scene.stream() else {
        return;
    };
    let row = last(watch);
    add(
        "wall_shear",
        "Pa",
        watch.scene.viscosity() * stream.shear(stream.bottom),
    );
    add("surface_shear", "Pa", surface_shear(watch, &row));
    add("erosion_thickness", "m", erosion_thickness(watch));
    add("grain_flux", "m/s", row.cake.grain_flux);
}

/// Mean thickness [m] over the end of the run where it has stopped to grow with grains in flight.
fn erosion_thickness(watch: &Watch) -> f64 {
    let end = last(watch);
    let late: Vec<&Row> = watch
        .rows
        .iter()
        .filter(|row| row.time >= (1.0 - END) * end.time)
        .collect();
    let mean = |rows: &[&Row]| {
        rows.iter().map(|row| row.cake.thickness_mean).sum::<f64>() / rows.len().max(1) as f64
    };
    let (first, second) = late.split_at(late.len() / 2);
    let whole = mean(&late);
    let stopped = (mean(second) - mean(first)).abs() <= 0.5 * STOPPED * whole;
    let flying = end.cake.in_flight as f64 >= IN_FLIGHT * end.fed as f64;
    if stopped && flying && whole > 0.0 {
        whole
    } else {
        f64::NAN
    }
}

fn of_cake(watch: &Watch, add: Add) {
    let Row { measures, cake, .. } = last(watch);
    add("thickness", "m", measures.thickness);
    add("thickness_mean", "m", cake.thickness_mean);
    add("porosity", "1", measures.porosity);
    add("porosity_half", "1", measures.porosity_half);
    add("porosity_centre", "1", measures.porosity_centre);
    add("porosity_whole", "1", cake.porosity_whole);
    add("solids_fraction", "1", 1.0 - measures.porosity);
    add("permeability", "m²", cake.permeability);
    add("coordination", "1", measures.coordination);
}

fn of_filtrate(watch: &Watch, add: Add) {
    let row = last(watch);
    add("flux", "m/s", row.flux);
    add("initial_flux", "m/s", watch.operation.flux);
    add("pressure_drop", "Pa", row.pressure_drop);
    add("medium_resistance", "1/m", watch.operation.medium_resistance);
    add("cake_resistance", "1/m", row.cake.resistance);
    let specific = row.cake.specific_resistance(watch.scene.area());
    add("specific_resistance", "m/kg", specific);
    add("filtrate_volume", "m", row.filtrate);
}

fn of_grains(watch: &Watch, add: Add) {
    let row = last(watch);
    add("deposited", "1", row.cake.deposited as f64);
    add("deposited_volume", "m³", row.cake.volume);
    add("deposited_mass", "kg", row.cake.mass);
    add("fed", "1", row.fed as f64);
    add("waiting", "1", row.waiting as f64);
    add("in_flight", "1", row.cake.in_flight as f64);
    add("passed", "1", row.passed as f64);
    let errors = watch.rows.iter().map(|row| row.cake.volume_error);
    add("volume_error", "1", errors.fold(0.0, f64::max));
    let errors = watch.rows.iter().map(|row| row.cake.solids_error);
    add("cake_solids_error", "1", errors.fold(0.0, f64::max));
    add("settled_share", "1", row.measures.settled_share);
    add("feed_depth", "1", watch.feed_depth());
}

fn of_growth(watch: &Watch, add: Add) {
    add(
        "first_deposit_time",
        "s",
        begun(watch).map_or(f64::NAN, |row| row.time),
    );
    add("deposit_onset", "s", deposit_onset(watch));
    let fallen = |row: &&Row| row.flux < FALLEN * watch.operation.flux;
    let fallen = watch.rows.iter().find(fallen);
    add(
        "flux_fall_time",
        "s",
        fallen.map_or(watch.scene.bed.duration, |row| row.time),
    );
    let total = watch.scene.bed.grains() as usize;
    let under_way = |row: &Row| row.cake.in_flight > 0 || row.fed < total;
    let unsettled = watch.rows.iter().rposition(under_way);
    let settled = watch.rows.get(unsettled.map_or(0, |row| row + 1));
    add("settling_time", "s", settled.map_or(f64::NAN, |row| row.time));
    let times: Vec<f64> = watch.rows.iter().map(|row| row.time).collect();
    let thicknesses: Vec<f64> = watch.rows.iter().map(|row| row.measures.thickness).collect();
    let growth = Growth::of(&times, &thicknesses);
    add("plateau_time", "s", growth.plateau_time);
    add("growth_linearity", "1", growth.linearity);
    add("final_growth_rate", "m/s", growth.final_rate);
}

fn of_run(watch: &Watch, add: Add) {
    let deepest = watch.rows.iter().map(|row| row.deepest);
    add("largest_overlap", "1", deepest.fold(0.0, f64::max));
    add("momentum_error", "1", watch.bed.momentum_error());
    add("time_step", "s", watch.limits.time_step);
    add("contact_time", "s", watch.limits.contact_time);
    let work = &watch.bed.work;
    add("pairs_per_search", "1", work.looked_at as f64 / work.lists as f64);
}

/// Time [s] at which the straight line of least squares through the deposited volume, from 20 to 80 % of
/// that at the end, begins; no number for fewer than three rows. The first grain comes before the others:
/// they are fed into a zone of some height.
fn deposit_onset(watch: &Watch) -> f64 {
    let [from, to] = GROWING.map(|share| share * last(watch).cake.volume);
    let growing = |row: &&Row| row.cake.volume > from && row.cake.volume < to;
    let points: Vec<(f64, f64)> = watch
        .rows
        .iter()
        .filter(growing)
        .map(|row| (row.time, row.cake.volume))
        .collect();
    if points.len() < 3 {
        return f64::NAN;
    }
    let count = points.len() as f64;
    let time = points.iter().map(|point| point.0).sum::<f64>() / count;
    let volume = points.iter().map(|point| point.1).sum::<f64>() / count;
    let spread: f64 = points.iter().map(|point| (point.0 - time).powi(2)).sum();
    let common: f64 = points
        .iter()
        .map(|point| (point.0 - time) * (point.1 - volume))
        .sum();
    time - volume * spread / common
}

fn porosity_profile(watch: &Watch) -> Table {
    let [heights, porosities] = profile(&watch.scene.bed, &watch.bed);
    Table {
        name: "porosity_profile",
        columns: vec![
            Column {
                name: "height",
                unit: "m",
                values: heights,
            },
            Column {
                name: "porosity",
                unit: "1",
                values: porosities,
            },
        ],
    }
}

fn permeability_profile(watch: &Watch) -> Table {
    let row = last(watch);
    let layers = if row.cake.deposited > 0 {
        layers(watch.scene, &watch.bed, row.measures.ends)
    } else {
        Vec::new()
    };
    let of = |name, unit, value: fn(&super::cake::Layer) -> f64| Column {
        name,
        unit,
        values: layers.iter().map(value).collect(),
    };
    Table {
        name: "permeability_profile",
        columns: vec![
            of("height", "m", |layer| 0.5 * (layer.ends[0] + layer.ends[1])),
            of("permeability", "m²", |layer| layer.permeability),
            of("porosity", "1", |layer| layer.porosity),
        ],
    }
}
