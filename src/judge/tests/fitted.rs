//! A law fitted along an axis.

use super::*;
use crate::study::model::{FitTarget, FittedLaw, LawFit, Parameter};

const POROSITIES: [f64; 6] = [0.6, 0.7, 0.8, 0.85, 0.9, 0.95];

/// Blocks that settle by the force balance of a law, times a power of the porosity, for each seed with noise.
fn blocks(drag: &str, power: f64, noise: f64, seeds: u64) -> Vec<Run> {
    let mut runs = Vec::new();
    for porosity in POROSITIES {
        let settings = json!({"constant_porosity_block": {
            "grains": {"diameter": 1e-4, "density": 2500.0}, "drag": drag, "porosity": porosity,
            "fluid": {"column": {"density": 1000.0, "viscosity": 8.9e-4}}, "gravity": 9.81}});
        let facts = crate::reference::Facts {
            settings: &settings,
            scalars: &|_| None,
        };
        let balance = crate::reference::scalar("force_balance", &facts).unwrap().values[0];
        for seed in 1..=seeds {
            let wave = noise * (37.0 * porosity + 5.0 * seed as f64).sin();
            let mut run = seeded(
                &rehearse("a", 1.0, 0.0),
                seed,
                balance * porosity.powf(power) * (1.0 + wave),
            );
            run.id = PointId(format!("{drag}-{porosity}-{seed}"));
            run.axes = vec![
                ("drag".to_string(), AxisValue::Word(drag.to_string())),
                ("porosity".to_string(), AxisValue::Number(porosity)),
            ];
            run.settings = settings.clone();
            runs.push(run);
        }
    }
    runs
}

fn fit(parameter: Parameter, target: FitTarget) -> Check {
    Check::Fit(LawFit {
        law: FittedLaw {
            of: "limit".to_string(),
            over: "porosity".to_string(),
            linear: false,
        },
        parameter,
        target,
    })
}

fn beside(below: f64) -> FitTarget {
    FitTarget::Reference {
        against: "force_balance".to_string(),
        below,
    }
}

#[test]
fn a_fitted_exponent_is_judged_beside_the_same_fit_to_the_reference() {
    let exact = one(
        fit(Parameter::Exponent, beside(0.01)),
        &blocks("di_felice", 0.0, 0.0, 1),
    );
    assert_eq!(exact.verdict, Outcome::Holds, "{exact:?}");
    // Di Felice at low Reynolds numbers.
    assert!(
        (exact.computed.unwrap() - 4.41).abs() < 0.05,
        "{:?}",
        exact.computed
    );
    assert!(exact.error.unwrap() < 1e-12);
    assert!(
        reason(&exact).contains("velocity at porosity 1"),
        "{}",
        reason(&exact)
    );
    // A power of 0.1 more is 2.3 % of the exponent.
    let steeper = blocks("di_felice", 0.1, 0.0, 1);
    let fails = one(fit(Parameter::Exponent, beside(0.02)), &steeper);
    assert_eq!(fails.verdict, Outcome::Fails);
    assert_eq!(
        one(fit(Parameter::Exponent, beside(0.03)), &steeper).verdict,
        Outcome::Holds
    );
    assert!((fails.computed.unwrap() - fails.expected.unwrap() - 0.1).abs() < 1e-9);
    // The velocity at porosity 1 is the same.
    assert_eq!(
        one(fit(Parameter::Velocity, beside(1e-6)), &steeper).verdict,
        Outcome::Holds
    );
}

#[test]
fn correlations_stand_beside_and_decide_nothing() {
    let verdict = one(
        fit(Parameter::Exponent, beside(0.01)),
        &blocks("di_felice", 0.0, 0.0, 1),
    );
    let labels: Vec<&str> = verdict.points.iter().map(|point| point.label.as_str()).collect();
    assert_eq!(labels[0], "scene=a along porosity");
    assert_eq!(labels[1], "scene=a along porosity: Wallis (1969)");
    assert_eq!(verdict.points.len(), 5);
    for point in &verdict.points[1..] {
        assert_eq!((point.holds, point.computed), (None, verdict.computed));
        assert!((4.2..5.0).contains(&point.expected.unwrap()), "{point:?}");
    }
}

#[test]
fn each_group_has_a_fit_of_its_own_and_the_worst_speaks() {
    let mut runs = blocks("di_felice", 0.0, 0.0, 1);
    runs.extend(blocks("stokes", 0.2, 0.0, 1));
    let verdict = one(fit(Parameter::Exponent, beside(0.01)), &runs);
    assert_eq!(verdict.verdict, Outcome::Fails);
    assert!(reason(&verdict).contains("drag=stokes"), "{}", reason(&verdict));
    // Without a voidage function v is proportional to the porosity.
    assert!((verdict.expected.unwrap() - 1.0).abs() < 1e-6);
    let judged = verdict.points.iter().filter(|point| point.holds.is_some());
    assert_eq!(judged.count(), 2);
}

#[test]
fn noise_that_hides_the_difference_decides_nothing() {
    let noisy = blocks("di_felice", 0.0, 0.05, 1);
    let open = one(fit(Parameter::Exponent, beside(0.01)), &noisy);
    assert_eq!(open.verdict, Outcome::NotDecidable, "{open:?}");
    assert!(reason(&open).contains("straddles 1 %"), "{}", reason(&open));
    assert_eq!(
        one(fit(Parameter::Exponent, beside(0.9)), &noisy).verdict,
        Outcome::Holds
    );
    // Means over seeds enter, not the seeds.
    let averaged = one(
        fit(Parameter::Exponent, beside(0.9)),
        &blocks("di_felice", 0.0, 0.05, 40),
    );
    assert!(averaged.half_width.unwrap() < open.half_width.unwrap());
}

#[test]
fn a_band_may_stand_in_place_of_a_reference() {
    let band = |above, below| {
        let band = Band {
            above: Some(above),
            below: Some(below),
        };
        one(
            fit(Parameter::Exponent, FitTarget::Band(band)),
            &blocks("di_felice", 0.0, 0.0, 1),
        )
    };
    assert_eq!(band(4.0, 4.9).verdict, Outcome::Holds);
    assert_eq!(band(4.6, 4.9).verdict, Outcome::Fails);
    assert_eq!(band(4.0, 4.9).error, None);
}

#[test]
fn what_cannot_be_fitted_stays_open() {
    let two: Vec<Run> = blocks("di_felice", 0.0, 0.0, 1).into_iter().take(2).collect();
    let verdict = one(fit(Parameter::Exponent, beside(0.01)), &two);
    assert_eq!(verdict.verdict, Outcome::NotDecidable);
    assert!(reason(&verdict).contains("2 points"), "{}", reason(&verdict));
    let nowhere = one(fit(Parameter::Exponent, beside(0.01)), &ladder(0.001));
    assert!(reason(&nowhere).contains("`porosity`"), "{}", reason(&nowhere));
}
