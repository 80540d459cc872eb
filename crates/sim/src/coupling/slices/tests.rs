use super::*;
use crate::drag::voidage::DiFelice;
use crate::drag::{DragScale, Hindered, SchillerNaumann};

const LARGEST: f64 = 250e-6;
const AREA: f64 = 100.0 * LARGEST * LARGEST;

/// Numbers between 0 and 1, evenly scattered.
fn scattered(i: usize, stride: f64) -> f64 {
    ((i + 1) as f64 * stride).fract()
}

/// Heights and radii of grains up to the largest size, 40 largest diameters high.
fn grains(number: usize) -> Vec<(f64, f64)> {
    (0..number)
        .map(|i| {
            let radius = 0.5 * LARGEST * (0.5 + 0.5 * scattered(i, 0.754_877_666_246_693));
            let z = radius + (40.0 * LARGEST - 2.0 * radius) * scattered(i, 0.569_840_290_998_053);
            (z, radius)
        })
        .collect()
}

fn placed(grains: &[(f64, f64)], measure: Measure) -> Slices {
    let mut slices = Slices::new(0.0, LARGEST, AREA, measure);
    slices.place(grains.iter().copied());
    slices
}

fn volume(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius.powi(3)
}

#[test]
fn slices_hold_what_lies_between_their_planes() {
    let grains = grains(1000);
    let slices = placed(&grains, Measure::Exact);
    for (k, porosity) in slices.porosity().iter().enumerate() {
        let (low, high) = (k as f64 * LARGEST, (k + 1) as f64 * LARGEST);
        let solids = solid_volume_between(grains.iter().copied(), low, high) / (AREA * LARGEST);
        assert!((1.0 - porosity - solids).abs() < 1e-14, "slice {k}");
    }
}

#[test]
fn no_solid_is_lost_by_either_volume() {
    let grains = grains(1000);
    let whole: f64 = grains.iter().map(|grain| volume(grain.1)).sum();
    for measure in [Measure::Exact, Measure::Centre] {
        let slices = placed(&grains, measure);
        let solids: f64 = slices.porosity().iter().map(|e| (1.0 - e) * AREA * LARGEST).sum();
        assert!((solids / whole - 1.0).abs() < 1e-12);
        assert_eq!(slices.clips(), 0);
    }
}

#[test]
fn sampling_is_the_transpose_of_the_deposit() {
    let grains = grains(300);
    for measure in [Measure::Exact, Measure::Centre] {
        let slices = placed(&grains, measure);
        let field: Vec<f64> = (0..slices.count()).map(|k| scattered(k, 0.31)).collect();
        let weight = |i| scattered(i, 0.47) - 0.5;
        let mut density = Vec::new();
        slices.deposit((0..grains.len()).map(weight), &mut density);
        let of_slices: f64 = density
            .iter()
            .zip(&field)
            .map(|(d, f)| d * f * AREA * LARGEST)
            .sum();
        let of_grains: f64 = (0..grains.len())
            .map(|i| weight(i) * volume(grains[i].1) * slices.sample(i, &field))
            .sum();
        assert!((of_slices / of_grains - 1.0).abs() < 1e-11);
    }
}

#[test]
fn exact_porosity_moves_smoothly_as_a_grain_rises_and_that_of_centres_jumps() {
    let largest_jump = |measure| {
        let rise = (0..4000).map(|i| (0.6 + i as f64 * 1e-3) * LARGEST);
        let lowest = rise.map(|z| placed(&[(z, 0.5 * LARGEST)], measure).porosity()[1]);
        let lowest: Vec<f64> = lowest.collect();
        lowest
            .windows(2)
            .map(|pair| (pair[1] - pair[0]).abs())
            .fold(0.0, f64::max)
    };
    let whole = volume(0.5 * LARGEST) / (AREA * LARGEST);
    // The widest disc is 1.5 mean ones.
    assert!(largest_jump(Measure::Exact) < 1.51e-3 * whole);
    assert!(largest_jump(Measure::Centre) > 0.99 * whole);
}

#[test]
fn a_closed_vessel_slows_a_dilute_bed_from_21_95_to_19_08_millimetres_per_second() {
    let scale = DragScale {
        diameter: LARGEST,
        density: 1000.0,
        viscosity: 1e-3,
    };
    let law = Hindered {
        sphere: SchillerNaumann,
        voidage: DiFelice,
    };
    // A lattice with as much solid in every slice.
    let radius = 0.5 * LARGEST;
    let heights = (0..1000).map(|i| (0.5 + 40.0 * (i as f64 + 0.5) / 1000.0) * LARGEST);
    let lattice: Vec<(f64, f64)> = heights.map(|z| (z, radius)).collect();
    let slices = placed(&lattice, Measure::Exact);
    let middle = 500;
    let porosity = slices.sample(middle, slices.porosity());
    assert!((porosity - 0.8691).abs() < 1e-4);
    let superficial = scale.balance(&law, porosity * 1460.0 * volume(radius) * 9.81, porosity);
    // In still water the grain falls at the interstitial slip; with the return flow the slip is kept.
    let slip = superficial / porosity;
    let speed = crate::math::bisect(0.0, 2.0 * slip, |speed| {
        let mut flow = Vec::new();
        slices.return_flow(lattice.iter().map(|_| -speed), &mut flow);
        speed + slices.sample(middle, &flow) - slip
    });
    assert!((slip - 21.95e-3).abs() < 0.01e-3, "{slip}");
    assert!((speed - 19.08e-3).abs() < 0.01e-3, "{speed}");
}

#[test]
fn a_closed_vessel_has_no_net_flux_at_any_height() {
    let grains = grains(800);
    let slices = placed(&grains, Measure::Exact);
    let speed = |i| -1e-2 * scattered(i, 0.23);
    let (mut flow, mut flux) = (Vec::new(), Vec::new());
    slices.return_flow((0..800).map(speed), &mut flow);
    slices.deposit((0..800).map(speed), &mut flux);
    for k in 0..slices.count() {
        assert!((slices.porosity()[k] * flow[k] + flux[k]).abs() < 1e-18);
    }
}

#[test]
fn overfull_slices_are_held_at_the_floor_and_counted() {
    // Four spheres with their centres in one slice of a narrow column; they reach out of it.
    let radius = 0.5 * LARGEST;
    let heap = [0.95; 4].map(|z| (z * LARGEST, radius));
    let mut centre = Slices::new(0.0, LARGEST, 2.5 * LARGEST * LARGEST, Measure::Centre);
    centre.place(heap.into_iter());
    assert_eq!((centre.porosity()[0], centre.clips()), (POROSITY_FLOOR, 1));
    centre.place(heap.into_iter());
    assert_eq!(centre.clips(), 2);
    let mut exact = Slices::new(0.0, LARGEST, 2.5 * LARGEST * LARGEST, Measure::Exact);
    exact.place(heap.into_iter());
    assert_eq!(exact.clips(), 0);
}

#[test]
fn discs_fill_areas() {
    let width = 40.0 * LARGEST;
    let mut slices = Slices::new(0.0, LARGEST, width, Measure::Areas);
    slices.place((0..20).map(|_| (0.5 * LARGEST, 0.5 * LARGEST)));
    // Twenty of forty places in a row of discs.
    assert!((slices.porosity()[0] - (1.0 - PI / 8.0)).abs() < 1e-14);
}

#[test]
fn strays_do_no_harm() {
    let mut slices = Slices::new(0.0, LARGEST, AREA, Measure::Exact);
    slices.place(std::iter::empty());
    assert_eq!(slices.count(), 0);
    let radius = 0.5 * LARGEST;
    slices.place([(-1.0, radius), (1e12, radius), (f64::NAN, radius)].into_iter());
    assert_eq!(slices.count(), MOST + 1);
    let highest = volume(radius) / (AREA * LARGEST);
    assert!((1.0 - slices.porosity()[MOST] - highest).abs() < 1e-14);
    // Back among the others, the slices shrink again.
    slices.place(std::iter::once((radius, radius)));
    assert_eq!(slices.count(), 2);
}

#[test]
fn parts_of_a_sphere_are_caps_slabs_and_the_whole() {
    let (z, radius) = (3.0, 0.7);
    let whole = volume(radius);
    let between = |low: f64, high: f64| sphere_volume_between(z, radius, z + low, z + high);
    assert!((between(-9.0, 9.0) / whole - 1.0).abs() < 1e-14);
    assert!((between(-9.0, 0.0) / whole - 0.5).abs() < 1e-14);
    assert_eq!(between(1.0, 9.0), 0.0);
    assert_eq!(between(0.2, 0.2), 0.0);
    assert_eq!(between(0.3, 0.2), 0.0);
    // A cap of height R/2 is 5/32 of the sphere.
    assert!((between(0.5 * radius, 9.0) / whole - 5.0 / 32.0).abs() < 1e-14);
    // A thin slab is a disc.
    let slab = sphere_volume_between(0.0, radius, 0.3, 0.3 + 1e-9);
    assert!((slab / (PI * (0.49 - 0.09) * 1e-9) - 1.0).abs() < 1e-7);
    assert!((between(-0.4, 0.1) + between(0.1, 0.6) - between(-0.4, 0.6)).abs() < 1e-15);
}
