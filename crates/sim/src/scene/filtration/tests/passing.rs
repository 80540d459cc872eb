//! Grains that pass through the medium, and grains that find no room.

use super::*;

#[test]
fn grains_fall_through_wide_gaps_counted_and_nothing_is_lost() {
    let mut scene = over_grains(1.5 * DIAMETER, 1);
    scene.bed.snapshots = 5;
    let outcome = outcome(&scene);
    let [fed, passed] = ["fed", "passed"].map(|name| scalar(&outcome, name));
    assert!(passed > 0.3 * fed, "{passed} of {fed}");
    assert!(scalar(&outcome, "volume_error") < 1e-13);
    let sums = ["deposited", "in_flight", "passed"].map(|name| series(&outcome, name));
    for (row, fed) in series(&outcome, "fed").iter().enumerate() {
        assert_eq!(sums.iter().map(|column| column[row]).sum::<f64>(), *fed);
    }
    // Numbers stay those of the feed when others have left.
    let kept = outcome
        .tables
        .iter()
        .find(|table| table.name == "snapshots")
        .unwrap();
    let [time, grain, class] = ["time", "grain", "class"].map(|name| {
        let found = kept.columns.iter().find(|column| column.name == name);
        &found.unwrap().values
    });
    let last = time[time.len() - 1];
    let rows = || (0..time.len()).filter(|row| time[*row] == last);
    let mut numbers: Vec<f64> = rows().map(|row| grain[row]).collect();
    let fixed = rows().filter(|row| class[*row] < 0.0).count() as f64;
    assert_eq!(fixed, scalar(&outcome, "medium_grains"));
    assert_eq!(numbers.len() as f64, fed - passed + fixed);
    numbers.sort_by(f64::total_cmp);
    assert!(numbers.windows(2).all(|pair| pair[0] < pair[1]), "{numbers:?}");
    assert_eq!(numbers[numbers.len() - 1], 200.0 + fixed - 1.0);
}

#[test]
fn a_medium_of_its_own_grains_holds_them_all_in_one_layer_and_in_two() {
    for layers in [1, 2] {
        let outcome = outcome(&over_grains(0.0, layers));
        assert_eq!(scalar(&outcome, "passed"), 0.0);
        assert_eq!(scalar(&outcome, "medium_grains"), 25.0 * f64::from(layers));
        assert!(scalar(&outcome, "deposited") > 100.0);
    }
}

#[test]
fn layers_lie_in_the_hollows_of_one_another() {
    use crate::scene::sedimentation::floor::floor_grains;
    for dimensions in [Dimensions::Two, Dimensions::Three] {
        let mut scene = over_grains(0.0, 3);
        scene.bed.dimensions = dimensions;
        let grains = floor_grains(&scene.bed);
        let side = scene.bed.container.width;
        let wrapped = |way: f64| way - side * (way / side).round();
        for (place, one) in grains.iter().enumerate() {
            let gaps = grains
                .iter()
                .enumerate()
                .filter(|(other, _)| *other != place)
                .map(|(_, other)| {
                    let way = one.position - other.position;
                    let way = crate::math::Vec3::new(wrapped(way.x), wrapped(way.y), way.z);
                    way.norm() / DIAMETER - 1.0
                });
            let nearest = gaps.fold(f64::INFINITY, f64::min);
            assert!(nearest.abs() < 1e-9, "{dimensions:?}: {nearest}");
        }
        let lowest = grains.iter().map(|grain| grain.position.z).fold(0.0, f64::min);
        assert!((lowest - 0.5 * DIAMETER - scene.bed.floor_bottom()).abs() < 1e-12);
    }
}

#[test]
fn what_finds_no_room_waits_and_comes_later() {
    let mut scene = cell();
    scene.feed = Feed::Rate {
        rate: 1e5,
        layers: 1.0,
    };
    let outcome = outcome(&scene);
    let waiting = series(&outcome, "waiting");
    assert!(waiting.iter().copied().fold(0.0, f64::max) > 50.0);
    assert_eq!(waiting[waiting.len() - 1], 0.0);
    assert_eq!(scalar(&outcome, "fed"), 200.0);
    assert!(scalar(&outcome, "largest_overlap") < 0.01);
    assert!(scalar(&outcome, "feed_depth") <= 0.5 + 1e-6);
}

#[test]
fn a_full_cell_lets_the_rest_wait_for_ever() {
    let mut scene = cell();
    scene.bed.classes[0].number = 380;
    scene.bed.container.height = 14.0 * DIAMETER;
    scene.feed = Feed::Rate {
        rate: 5e3,
        layers: 2.0,
    };
    scene.bed.duration = 0.6;
    // Rough grains make a loose cake, higher than the cell.
    scene.bed.tangential = Tangential::CundallStrack(CundallStrack {
        stiffness: 6.0,
        damping: 0.0,
        friction: 1.0,
    });
    let outcome = outcome(&scene);
    let [fed, waiting] = ["fed", "waiting"].map(|name| scalar(&outcome, name));
    assert_eq!(fed + waiting, 380.0);
    assert!(waiting > 0.0, "{fed}");
    assert!(scalar(&outcome, "volume_error") < 1e-13);
}

#[test]
fn a_run_that_is_stopped_tells_what_it_knows_of_those_who_have_just_come() {
    use std::cell::Cell;
    for dimensions in [Dimensions::Two, Dimensions::Three] {
        let mut scene = over_grains(0.0, 1);
        scene.bed.dimensions = dimensions;
        scene.bed.snapshots = 11;
        for patience in [1, 3, 40, 41, 42, 43] {
            let asked = Cell::new(0);
            let control = Control {
                stop: &|| {
                    asked.set(asked.get() + 1);
                    asked.get() > patience
                },
                progress: &|_| {},
                split: &|_| {},
            };
            let failure = run(&Scene::Filtration(scene.clone()), &control).unwrap_err();
            assert!(
                failure
                    .partial
                    .tables
                    .iter()
                    .any(|table| table.name == "snapshots")
            );
        }
    }
}
