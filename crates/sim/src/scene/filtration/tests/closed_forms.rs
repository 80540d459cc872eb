//! Fluxes, volumes and cakes against what can be said beforehand.

use super::*;

#[test]
fn the_flux_starts_with_what_is_given_whichever_two_are() {
    for (pressure_drop, initial_flux, medium_resistance) in [
        (Some(2000.0), Some(0.01), None),
        (Some(2000.0), None, Some(2e8)),
        (None, Some(0.01), Some(2e8)),
    ] {
        let mut scene = cell();
        scene.bed.duration = 0.01;
        scene.filtrate.pressure_drop = pressure_drop;
        scene.filtrate.initial_flux = initial_flux;
        scene.filtrate.medium_resistance = medium_resistance;
        let outcome = outcome(&scene);
        assert!((series(&outcome, "flux")[0] / 0.01 - 1.0).abs() < 1e-15);
        assert!((series(&outcome, "pressure_drop")[0] / 2000.0 - 1.0).abs() < 1e-15);
        assert!((scalar(&outcome, "medium_resistance") / 2e8 - 1.0).abs() < 1e-15);
    }
}

#[test]
fn medium_and_cake_share_the_pressure_drop_in_series() {
    let mut scene = cell();
    for held in [Held::Pressure, Held::Flux] {
        scene.filtrate.held = held;
        let outcome = outcome(&scene);
        let [flux, pressure, cake] =
            ["flux", "pressure_drop", "cake_resistance"].map(|name| series(&outcome, name));
        for ((flux, pressure), cake) in flux.iter().zip(pressure).zip(cake) {
            let darcy = flux * 1e-3 * (2e8 + cake);
            assert!((darcy / pressure - 1.0).abs() < 1e-12, "{darcy}, {pressure}");
        }
        let last = cake.len() - 1;
        assert!(cake[last] > 1e6);
        match held {
            Held::Pressure => assert!(pressure.iter().all(|pressure| *pressure == 2000.0)),
            Held::Flux => assert!(flux.iter().all(|flux| *flux == 0.01)),
        }
    }
}

#[test]
fn the_published_cake_at_the_height_of_its_cell_lets_the_published_flux_through() {
    // Alvim (2016), section 4.2.2: 40 diameters of 150 µm at a porosity of 0.388 give 6.53 mm/s at 2 kPa.
    let filtrate = Filtrate {
        resistance: Resistance::DarcyCapped,
        ..cell().filtrate
    };
    let operation = filtrate.operation(1e-3).unwrap();
    let permeability = crate::coupling::permeability::kozeny_carman(0.388, DIAMETER);
    let flux = |length: f64| filtrate.with_cake(&operation, 1e-3, length / permeability).0;
    assert!(
        (flux(40.0 * DIAMETER) / 6.53e-3 - 1.0).abs() < 0.005,
        "{}",
        flux(40.0 * DIAMETER)
    );
    assert_eq!(flux(0.0), 0.01);
    assert_eq!(flux(8.0 * DIAMETER), 0.01);
}

#[test]
fn no_volume_is_lost_at_any_output_and_the_cake_is_what_lies_in_it() {
    for mut scene in [cell(), over_grains(0.0, 2)] {
        scene.bed.classes[0].largest_diameter = Some(1.3 * DIAMETER);
        let outcome = outcome(&scene);
        assert!(scalar(&outcome, "volume_error") < 1e-13);
        let columns = ["deposited_volume", "porosity_whole", "thickness"];
        let [volume, porosity, thickness] = columns.map(|name| series(&outcome, name));
        let area = scene.area();
        for ((volume, porosity), thickness) in volume.iter().zip(porosity).zip(thickness) {
            if *volume > 0.0 {
                let solids = (1.0 - porosity) * area * thickness;
                assert!((solids / volume - 1.0).abs() < 1e-12, "{solids}, {volume}");
            }
        }
        let parts = ["deposited", "in_flight", "passed"].map(|name| scalar(&outcome, name));
        assert_eq!(parts.iter().sum::<f64>(), scalar(&outcome, "fed"));
        assert!(scalar(&outcome, "deposited") > 50.0);
    }
}

#[test]
fn a_lonely_grain_comes_down_with_the_filtrate_and_its_own_weight() {
    // Through a wide cell, where nobody hinders it.
    let mut scene = cell();
    scene.bed.classes[0].number = 1;
    scene.bed.container.width = 40.0 * DIAMETER;
    scene.bed.container.depth = 40.0 * DIAMETER;
    scene.bed.duration = 0.1;
    scene.feed = Feed::Rate {
        rate: 1e4,
        layers: 2.0,
    };
    let own = scene.settling_speed(1.0).unwrap();
    for fluid in [StillFluid::Still(WATER), StillFluid::Column(WATER)] {
        scene.bed.fluid = fluid;
        let outcome = outcome(&scene);
        let [times, heights] = ["time", "centre_of_mass"].map(|name| series(&outcome, name));
        let rows = times.len();
        let speed = (heights[rows / 2] - heights[rows - 1]) / (times[rows - 1] - times[rows / 2]);
        assert!(
            (speed / (0.01 + own) - 1.0).abs() < 5e-3,
            "{speed}, {}",
            0.01 + own
        );
    }
}

#[test]
fn a_fed_cake_grows_as_fast_as_grains_come_and_what_is_under_way_adds() {
    let mut scene = cell();
    scene.filtrate.held = Held::Flux;
    scene.bed.classes[0].number = 1000;
    let outcome = outcome(&scene);
    let [times, volumes] = ["time", "deposited_volume"].map(|name| series(&outcome, name));
    let rows = times.len();
    let [first, last] = [rows * 6 / 10, rows - 1];
    let growth = (volumes[last] - volumes[first]) / (times[last] - times[first]);
    let volume = std::f64::consts::PI / 6.0 * DIAMETER.powi(3);
    let fed = 800.0 * volume;
    let among = |flying: f64| 0.01 + scene.settling_speed(1.0 - flying).unwrap();
    let flying = fed / (scene.area() * among(fed / (scene.area() * 0.02)));
    let solids = 1.0 - scalar(&outcome, "porosity_half");
    // The rising surface meets the grains on their way.
    let expected = fed * solids / (solids - flying);
    assert!((growth / expected - 1.0).abs() < 0.06, "{}", growth / expected);
}

#[test]
fn the_suspension_brings_what_the_filtrate_draws() {
    let mut scene = cell();
    scene.bed.classes[0].number = 10_000;
    scene.bed.container.height = 100.0 * DIAMETER;
    scene.bed.duration = 0.3;
    for settling in [false, true] {
        scene.feed = Feed::Suspension {
            solids_fraction: 0.05,
            settling,
            layers: 5.0,
        };
        let own = if settling {
            scene.settling_speed(0.95).unwrap()
        } else {
            0.0
        };
        let outcome = outcome(&scene);
        let volume = std::f64::consts::PI / 6.0 * DIAMETER.powi(3);
        let drawn = 0.05 * scene.area() * (0.01 + own) * 0.3 / volume;
        let come = scalar(&outcome, "fed") + scalar(&outcome, "waiting");
        assert!((come - drawn).abs() <= 1.0 + 0.01 * drawn, "{come}, {drawn}");
    }
}

#[test]
fn layers_in_series_resist_as_one_where_the_cake_is_even() {
    let mut scene = cell();
    scene.bed.duration = 0.35;
    let mean = outcome(&scene);
    scene.filtrate.permeability = CakePermeability::Layered;
    let layered = outcome(&scene);
    let [mean, layered] = [&mean, &layered].map(|outcome| scalar(outcome, "specific_resistance"));
    assert!((layered / mean - 1.0).abs() < 0.5, "{layered}, {mean}");
    assert!(layered != mean);
}

#[test]
fn a_run_is_the_same_at_any_number_of_threads_and_another_with_another_seed() {
    let mut scene = over_grains(0.0, 1);
    scene.bed.duration = 0.15;
    scene.bed.snapshots = 4;
    let alone = outcome(&scene);
    scene.bed.threads = 3;
    let together = outcome(&scene);
    let numbers = |outcome: &Outcome| -> Vec<u64> {
        let columns = outcome.tables.iter().flat_map(|table| &table.columns);
        columns
            .flat_map(|column| &column.values)
            .map(|value| value.to_bits())
            .collect()
    };
    assert_eq!(numbers(&alone), numbers(&together));
    scene.bed.seed = 2;
    assert_ne!(numbers(&alone), numbers(&outcome(&scene)));
}

#[test]
fn every_scheme_and_sleep_feed_the_same_grains() {
    let mut scene = cell();
    scene.bed.duration = 0.25;
    let reference = outcome(&scene);
    scene.bed.sleeping = true;
    let asleep = outcome(&scene);
    scene.bed.sleeping = false;
    scene.bed.integrator = IntegratorChoice::Gear5;
    let gear = outcome(&scene);
    for other in [asleep, gear] {
        assert_eq!(scalar(&other, "fed"), scalar(&reference, "fed"));
        let gap = scalar(&other, "deposited") - scalar(&reference, "deposited");
        assert!(gap.abs() <= 8.0, "{gap}");
        assert!(scalar(&other, "volume_error") < 1e-13);
    }
}

#[test]
fn all_grains_at_once_end_in_the_cake_and_the_run_with_them() {
    let mut scene = cell();
    scene.feed = Feed::AtStart;
    scene.bed.until = Until::Settled;
    scene.bed.duration = 2.0;
    let outcome = outcome(&scene);
    assert_eq!(scalar(&outcome, "deposited"), 200.0);
    assert_eq!(series(&outcome, "fed")[0], 200.0);
    let times = series(&outcome, "time");
    assert!(times[times.len() - 1] < 0.5);
    assert_eq!(scalar(&outcome, "settling_time"), times[times.len() - 1]);
}
