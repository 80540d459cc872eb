//! What random arrangements look like.

use super::*;

/// Standard deviation of the number of centres in `slices` equal slices, over the mean number.
fn unevenness(coordinates: impl Iterator<Item = f64>, low: f64, high: f64, slices: usize) -> f64 {
    let mut counts = vec![0.0; slices];
    for coordinate in coordinates.filter(|x| (low..high).contains(x)) {
        counts[((coordinate - low) / (high - low) * slices as f64) as usize] += 1.0;
    }
    let mean = counts.iter().sum::<f64>() / slices as f64;
    (counts.iter().map(|n| (n - mean) * (n - mean)).sum::<f64>() / slices as f64).sqrt() / mean
}

#[test]
fn grains_are_spread_evenly() {
    let radii = vec![0.5; 8000];
    for fraction in [0.05, 0.3, 0.4, 0.58] {
        let length = side(Dimensions::Three, &radii, fraction);
        let region = cube(length, true);
        let positions = random(&region, &radii, &mut Random::new(2)).unwrap();
        // Points independent of each other scatter by this much; grains that exclude each other less.
        let noise = (10.0f64 / 8000.0).sqrt();
        for axis in 0..2 {
            let scatter = unevenness(positions.iter().map(|p| p[axis]), 0.0, length, 10);
            assert!(
                scatter < 1.5 * noise,
                "{fraction} along {axis}: {scatter} for {noise}"
            );
        }
        // Layers along floor and lid are left out, and slices are as high as a few of them.
        let scatter = unevenness(positions.iter().map(|p| p.z), 2.0, length - 2.0, 6);
        assert!(scatter < 1.5 * noise, "{fraction} upwards: {scatter} for {noise}");
    }
}

#[test]
fn sizes_are_mixed_through_the_whole_box() {
    let radii: Vec<f64> = (0..6000)
        .map(|grain| if grain < 3000 { 0.5 } else { 0.8 })
        .collect();
    let region = cube(side(Dimensions::Three, &radii, 0.5), true);
    let positions = random(&region, &radii, &mut Random::new(6)).unwrap();
    let mean = |half: &[Vec3], axis: usize| half.iter().map(|p| p[axis]).sum::<f64>() / 3000.0;
    // Four standard deviations of the mean of 3000 uniform numbers.
    let noise = 4.0 * region.width / (12.0f64 * 3000.0).sqrt();
    for axis in 0..3 {
        for half in [&positions[..3000], &positions[3000..]] {
            assert!((mean(half, axis) - 0.5 * region.width).abs() < noise);
        }
    }
}

/// Pairs with r in [low, high) over those of independent points, away from floor and lid.
fn pair_correlation(region: &Region, positions: &[Vec3], low: f64, high: f64) -> f64 {
    let inner = |p: &&Vec3| p.z > 3.0 && p.z < region.height - 3.0;
    let (mut pairs, mut centres) = (0.0, 0.0);
    for (i, a) in positions.iter().enumerate().filter(|(_, p)| inner(p)) {
        centres += 1.0;
        let near = |(j, b): &(usize, &Vec3)| *j != i && (low..high).contains(&region.nearest(a - *b).norm());
        pairs += positions.iter().enumerate().filter(near).count() as f64;
    }
    let density = centres / (region.width * region.depth * (region.height - 6.0));
    pairs / (centres * density * 4.0 / 3.0 * PI * (high.powi(3) - low.powi(3)))
}

#[test]
fn sparse_grains_see_each_other_as_hard_spheres_do() {
    let radii = vec![0.5; 5000];
    let region = cube(side(Dimensions::Three, &radii, 0.10), true);
    let positions = random(&region, &radii, &mut Random::new(12)).unwrap();
    assert_eq!(pair_correlation(&region, &positions, 0.5, 1.0), 0.0);
    // g(r) = 1 + φ (8 − 6r + r³/2) to first order in the fraction, mean over the shell; the second
    // order adds a few hundredths.
    let near = pair_correlation(&region, &positions, 1.0, 1.2);
    assert!((near - 1.20).abs() < 0.08, "{near}");
    let far = pair_correlation(&region, &positions, 2.2, 2.8);
    assert!((far - 1.0).abs() < 0.03, "{far}");
}

#[test]
fn dense_grains_are_ordered_nearby_but_not_crystalline() {
    let radii = vec![0.5; 4000];
    let region = cube(side(Dimensions::Three, &radii, 0.58), true);
    let positions = random(&region, &radii, &mut Random::new(12)).unwrap();
    let correlation = |low, high| pair_correlation(&region, &positions, low, high);
    // Many neighbours at contact, few behind them, a second shell of nearly two diameters.
    assert!(correlation(1.0, 1.05) > 3.5);
    assert!(correlation(1.35, 1.50) < 0.9);
    assert!(correlation(1.80, 2.05) > 1.05);
    assert!((correlation(3.5, 4.5) - 1.0).abs() < 0.03);
}

#[test]
fn grains_of_middling_density_see_each_other_as_a_fluid_does() {
    let radii = vec![0.5; 4000];
    let region = cube(side(Dimensions::Three, &radii, 0.35), true);
    let positions = random(&region, &radii, &mut Random::new(12)).unwrap();
    // At contact (1 − φ/2)/(1 − φ)³ = 3.00 by Carnahan and Starling (1969), and falling.
    let near = pair_correlation(&region, &positions, 1.0, 1.04);
    assert!((near - 2.9).abs() < 0.3, "{near}");
    let behind = pair_correlation(&region, &positions, 1.2, 1.3);
    assert!(behind > 1.0 && behind < 1.6, "{behind}");
}

/// Structure factor at the longest sideways waves: |Σ exp(i k·x)|²/N, 1 if grains did not see each other.
fn scatter(region: &Region, positions: &[Vec3]) -> f64 {
    let waves = [
        [1.0, 0.0],
        [0.0, 1.0],
        [1.0, 1.0],
        [1.0, -1.0],
        [2.0, 0.0],
        [0.0, 2.0],
    ];
    let power = |[a, b]: [f64; 2]| {
        let phase = |place: &Vec3| 2.0 * PI * (a * place.x + b * place.y) / region.width;
        let real: f64 = positions.iter().map(|place| phase(place).cos()).sum();
        let imaginary: f64 = positions.iter().map(|place| phase(place).sin()).sum();
        real * real + imaginary * imaginary
    };
    waves.into_iter().map(power).sum::<f64>() / (waves.len() * positions.len()) as f64
}

#[test]
fn an_even_arrangement_has_no_long_waves_and_neither_has_any_part_of_its_list() {
    let radii = vec![0.5; 4096];
    let region = cube(side(Dimensions::Three, &radii, 0.1), true);
    let random = random(&region, &radii, &mut Random::new(1)).unwrap();
    let even = even(&region, &radii, &mut Random::new(1)).unwrap();
    assert_sound(&region, &radii, &even);
    // Hard spheres at a tenth: (1 − φ)⁴/(1 + 2φ)² = 0.46.
    let (random, whole) = (scatter(&region, &random), scatter(&region, &even));
    let (first, last) = (scatter(&region, &even[..2048]), scatter(&region, &even[2048..]));
    println!("{random} {whole} {first} {last}");
    assert!((0.15..1.5).contains(&random), "{random}");
    assert!(whole < 0.1, "{whole}");
    // Placed at random half of them would scatter with (1 + 0.46)/2.
    assert!(first < 0.1 && last < 0.1, "{first} {last}");
}

#[test]
fn an_even_arrangement_has_no_clusters_in_a_box_of_any_shape() {
    let radii = vec![0.5; 2292];
    // Twenty diameters wide and sixty high, dilute.
    let side = 20.0;
    let region = Region {
        width: side,
        depth: side,
        height: 60.0,
        periodic: [true, true],
        dimensions: Dimensions::Three,
    };
    let even = even(&region, &radii, &mut Random::new(1)).unwrap();
    assert_sound(&region, &radii, &even);
    for (low, high) in [(1.0, 2.0), (2.0, 3.0), (3.0, 4.0)] {
        let found = pair_correlation(&region, &even, low, high);
        assert!((found - 1.0).abs() < 0.1, "{found} from {low} to {high}");
    }
}

#[test]
fn an_even_arrangement_fills_the_box_up_to_its_floor_and_lid() {
    let radii = vec![0.5; 4000];
    for fraction in [0.02, 0.1, 0.4] {
        let region = cube(side(Dimensions::Three, &radii, fraction), true);
        let even = even(&region, &radii, &mut Random::new(2)).unwrap();
        assert_sound(&region, &radii, &even);
        let within = |low: f64, high: f64| {
            let spheres = even.iter().map(|place| (place.z, 0.5));
            crate::coupling::slices::solid_volume_between(spheres, low, high)
                / (region.width * region.depth * (high - low))
        };
        let height = region.height;
        for (low, high) in [(0.0, 0.25), (0.25, 0.5), (0.5, 0.75), (0.75, 1.0)] {
            let found = within(low * height, high * height);
            assert!(
                (found / fraction - 1.0).abs() < 0.03,
                "{found} for {fraction} from {low}"
            );
        }
    }
}
