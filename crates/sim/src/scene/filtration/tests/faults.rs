//! What cannot be simulated is told with where and what to do.

use super::*;

fn faults(scene: Filtration) -> Vec<String> {
    let faults = check(&Scene::Filtration(scene));
    faults.into_iter().map(|fault| fault.path).collect()
}

fn with(change: impl Fn(&mut Filtration)) -> Filtration {
    let mut scene = cell();
    change(&mut scene);
    scene
}

#[test]
fn sound_scenes_have_no_fault() {
    for scene in [cell(), over_grains(0.0, 2), over_grains(1.5 * DIAMETER, 1)] {
        assert_eq!(faults(scene), Vec::<String>::new());
    }
}

#[test]
fn two_of_pressure_flux_and_resistance_are_needed() {
    let none = with(|scene| scene.filtrate.initial_flux = None);
    assert_eq!(faults(none), ["filtrate"]);
    let all = with(|scene| scene.filtrate.medium_resistance = Some(2e8));
    assert_eq!(faults(all), ["filtrate"]);
    let zero = with(|scene| scene.filtrate.pressure_drop = Some(0.0));
    assert_eq!(faults(zero), ["filtrate.pressure_drop"]);
    let backwards = with(|scene| scene.filtrate.initial_flux = Some(-0.01));
    assert_eq!(faults(backwards), ["filtrate.initial_flux"]);
}

#[test]
fn a_feed_that_can_never_fit_is_refused() {
    let rate = |rate, layers| with(move |scene| scene.feed = Feed::Rate { rate, layers });
    assert_eq!(faults(rate(0.0, 5.0)), ["feed.rate.rate"]);
    assert_eq!(faults(rate(1e3, 0.5)), ["feed.rate.layers"]);
    assert_eq!(faults(rate(1e3, 21.0)), ["feed.rate.layers"]);
    let many = with(|scene| scene.bed.classes[0].number = 1000);
    assert_eq!(faults(many), ["grains.number"]);
    let dense = with(|scene| {
        scene.feed = Feed::Suspension {
            solids_fraction: 0.6,
            settling: false,
            layers: 5.0,
        };
    });
    assert_eq!(faults(dense), ["feed.suspension.solids_fraction"]);
    let arranged = with(|scene| scene.bed.arrangement = Arrangement::Lattice);
    assert_eq!(faults(arranged), ["arrangement"]);
}

#[test]
fn a_flow_across_needs_a_cell_that_goes_on() {
    let across = |sides, mean_velocity| {
        with(move |scene| {
            scene.bed.container.sides = sides;
            scene.crossflow = Some(Crossflow {
                mean_velocity,
                shear_lift: false,
            });
        })
    };
    assert_eq!(faults(across(Sides::Walls, 0.01)), ["container.sides"]);
    assert_eq!(faults(across(Sides::PeriodicAlongX, 0.01)), Vec::<String>::new());
    assert_eq!(
        faults(across(Sides::Periodic, f64::NAN)),
        ["fluid.parabolic.mean_velocity"]
    );
}

#[test]
fn faults_of_the_bed_keep_their_paths_and_the_fluid_has_its_own_name() {
    let thin = with(|scene| {
        scene.bed.fluid = StillFluid::Column(Medium {
            density: 1000.0,
            viscosity: 0.0,
        });
    });
    assert_eq!(faults(thin), ["fluid.uniform.viscosity"]);
    let layers = with(|scene| {
        scene.bed.container.floor = Floor::Grains(FloorGrains {
            diameter: DIAMETER,
            gap: -1e-6,
            layers: 0,
        });
    });
    assert_eq!(
        faults(layers),
        ["container.floor.grains.gap", "container.floor.grains.layers"]
    );
    let long = with(|scene| scene.bed.time_step = Some(1e-3));
    assert_eq!(faults(long), ["time_step"]);
}
