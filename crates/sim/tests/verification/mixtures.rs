//! Rigid blocks of grains of two sizes: their speed, and what the fluid knows of them under each choice of the
//! coupling lengths.

use kynch_sim::outcome::Outcome;
use kynch_sim::scene::{ConstantPorosityBlock, CouplingLengths, Drag, Scheme};

use crate::scenes::{block, class, particles, profile, run_block, scalar};

/// Equal numbers of 200 and 100 µm at porosity 0.906: 10.397 mm/s by the force balance of Raso (2014),
/// eq. 4.5 with the excess density.
const POROSITY: f64 = 0.906;
const SPEED: f64 = 10.3972e-3;
/// Solids fraction of the larger class.
const LARGER: f64 = 0.094 * 8.0 / 9.0;

fn mixed(lengths: CouplingLengths, duration: f64) -> ConstantPorosityBlock {
    let scheme = Scheme {
        coupling_lengths: lengths,
        ..Scheme::default()
    };
    ConstantPorosityBlock {
        classes: vec![class(2e-4, 0.5), class(1e-4, 0.5)],
        drag: Drag::BeetstraCello,
        grains_per_side: 8,
        layers: 10,
        duration,
        ..block(particles(2.0, scheme), POROSITY, 2.4e-3)
    }
}

fn at_rest(lengths: CouplingLengths) -> Outcome {
    run_block(&mixed(lengths, 2e-4))
}

#[test]
fn settle_at_the_speed_of_their_force_balance_and_close_momentum() {
    let outcome = run_block(&mixed(CouplingLengths::PerClass, 60e-3));
    let speed = scalar(&outcome, "terminal_velocity");
    assert!((speed / SPEED - 1.0).abs() < 0.03, "{speed}");
    let error = scalar(&outcome, "momentum_error");
    assert!(error < 1e-12, "{error:e}");
}

#[test]
fn equal_classes_are_one_class() {
    let of = |classes: &[_]| {
        let scene = ConstantPorosityBlock {
            classes: classes.to_vec(),
            duration: 6e-3,
            ..block(particles(4.0, Scheme::default()), 0.9, 4e-3)
        };
        scalar(&run_block(&scene), "terminal_velocity")
    };
    let (one, two) = (of(&[class(1e-4, 1.0)]), of(&[class(1e-4, 0.5), class(1e-4, 0.5)]));
    assert!((one / two - 1.0).abs() < 1e-9, "{one} {two}");
}

#[test]
fn ripple_with_the_length_of_the_small_grains_and_not_with_each_class_s_own() {
    let ripple = |lengths| scalar(&at_rest(lengths), "porosity_ripple");
    let (own, fine) = (
        ripple(CouplingLengths::PerClass),
        ripple(CouplingLengths::Smallest),
    );
    let (coarse, twice) = (
        ripple(CouplingLengths::Largest),
        ripple(CouplingLengths::DoubleSmoothing),
    );
    assert!(
        own < 0.002 && coarse < 0.002 && twice < 0.002,
        "{own} {coarse} {twice}"
    );
    assert!(fine > 3.0 * own, "{fine} {own}");
}

#[test]
fn double_smoothing_as_printed_leaves_the_square_of_the_larger_grains() {
    let plateau = |lengths| scalar(&at_rest(lengths), "plateau_porosity");
    let corrected = plateau(CouplingLengths::DoubleSmoothing);
    assert!((corrected - POROSITY).abs() < 2e-3, "{corrected}");
    let printed = plateau(CouplingLengths::DoubleSmoothingLiteral);
    let expected = POROSITY + LARGER - LARGER * LARGER;
    assert!((printed - expected).abs() < 2e-3, "{printed} {expected}");
}

#[test]
fn double_smoothing_has_the_profile_of_the_coarse_length() {
    let profile_of = |lengths| profile(&at_rest(lengths), "porosity_profile", "porosity_profile").to_vec();
    let (coarse, twice) = (
        profile_of(CouplingLengths::Largest),
        profile_of(CouplingLengths::DoubleSmoothing),
    );
    let squares: f64 = coarse.iter().zip(&twice).map(|(a, b)| (a - b).powi(2)).sum();
    let difference = (squares / coarse.len() as f64).sqrt();
    assert!(difference < 0.01, "{difference}");
}
