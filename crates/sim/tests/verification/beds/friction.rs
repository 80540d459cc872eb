//! A sphere on a floor and on an incline.

use std::f64::consts::PI;

use kynch_sim::bed::{Bed, Laws, Wall};
use kynch_sim::contact::{AnyNormal, AnyRolling, AnyTangential, LinearSpringDashpot};
use kynch_sim::math::Vec3;

use super::{Setup, grain, rolling, tangentials};

const DIAMETER: f64 = 250e-6;
const DENSITY: f64 = 2500.0;
const STIFFNESS: f64 = 20.0;
const GRAVITY: f64 = 9.81;
const FRICTION: f64 = 0.3;
const STEP: f64 = 1e-6;

/// A sphere that rests on a plane of this slope [-], pressed in as its weight wants it.
struct Incline {
    setup: Setup,
    /// Unit vector down the slope.
    down: Vec3,
    /// Angle of the slope [rad].
    angle: f64,
    /// Height of the centre over the plane [m].
    height: f64,
}

impl Incline {
    fn new(slope: f64, tangential: AnyTangential, rolling: AnyRolling) -> Incline {
        let angle = slope.atan();
        let normal = Vec3::new(angle.sin(), 0.0, angle.cos());
        let mass = DENSITY * PI / 6.0 * DIAMETER.powi(3);
        let height = 0.5 * DIAMETER - mass * GRAVITY * angle.cos() / STIFFNESS;
        let laws = Laws {
            normal: AnyNormal::Linear(LinearSpringDashpot::with_restitution(STIFFNESS, 0.5)),
            tangential,
            rolling,
        };
        let mut setup = Setup::new(vec![grain(DIAMETER, DENSITY, normal * height)], laws, STEP);
        setup.surroundings.gravity = GRAVITY;
        setup.walls = vec![Wall {
            normal,
            point: Vec3::zeros(),
        }];
        Incline {
            setup,
            down: Vec3::new(angle.cos(), 0.0, -angle.sin()),
            angle,
            height,
        }
    }

    /// Speed down the slope [m/s], and how fast the lowest point slips over it [m/s].
    fn speeds(&self, bed: &Bed) -> [f64; 2] {
        let speed = bed.grains.velocity(0).dot(&self.down);
        // Rolling down the slope is a turn about y.
        let slip = speed - self.height * bed.grains.angular_velocity(0).y;
        [speed, slip]
    }
}

#[test]
fn a_sphere_set_sliding_ends_rolling_at_five_sevenths_of_its_speed() {
    for tangential in &tangentials(FRICTION)[1..] {
        let mut floor = Incline::new(0.0, *tangential, AnyRolling::None);
        floor.setup.grains[0].velocity = Vec3::new(0.05, 0.0, 0.0);
        let mut bed = floor.setup.after(8000);
        // A contact without a dashpot goes on trembling: its mean is looked at.
        let mut mean = [0.0; 2];
        for _ in 0..2000 {
            bed.advance(1).expect("no grain leaps");
            let speeds = floor.speeds(&bed);
            (0..2).for_each(|i| mean[i] += speeds[i] / 2000.0);
        }
        let flattened = 2.0 * floor.height / DIAMETER;
        let expected = 0.05 / (1.0 + 0.4 / (flattened * flattened));
        assert!((expected / 0.05 - 5.0 / 7.0).abs() < 1e-4);
        let error = mean[0] / expected - 1.0;
        assert!(error.abs() < 1e-4, "{error:e} {tangential:?}");
        assert!(mean[1].abs() < 1e-4 * mean[0], "{:e} {tangential:?}", mean[1]);
    }
}

#[test]
fn it_rolls_down_an_incline_up_to_seven_halves_of_the_friction_and_slips_beyond() {
    const STEPS: u64 = 5000;
    let time = STEPS as f64 * STEP;
    for tangential in &tangentials(FRICTION)[1..] {
        for share in [0.5, 0.9, 1.1, 2.0] {
            let incline = Incline::new(share * 3.5 * FRICTION, *tangential, AnyRolling::None);
            let bed = incline.setup.after(STEPS);
            let [speed, slip] = incline.speeds(&bed);
            let (sine, cosine) = incline.angle.sin_cos();
            let expected = if share < 1.0 {
                5.0 / 7.0 * sine
            } else {
                sine - FRICTION * cosine
            } * GRAVITY
                * time;
            assert!(
                (speed / expected - 1.0).abs() < 3e-3,
                "{speed} for {expected}, {tangential:?}"
            );
            let slips = slip.abs() > 0.02 * speed;
            assert_eq!(slips, share > 1.0, "{slip} of {speed} at {share}, {tangential:?}");
        }
    }
}

#[test]
fn a_sphere_that_cannot_roll_slides_beyond_the_coefficient_of_friction() {
    const STEPS: u64 = 20_000;
    let stubborn = rolling(2.0);
    for tangential in &tangentials(FRICTION)[1..] {
        let below = Incline::new(0.9 * FRICTION, *tangential, stubborn);
        let [speed, _] = below.speeds(&below.setup.after(STEPS));
        // The resistance itself gives way a little: by what gravity does in a few steps.
        assert!(speed.abs() < 12.0 * GRAVITY * STEP, "{speed:e} {tangential:?}");
        let above = Incline::new(1.1 * FRICTION, *tangential, stubborn);
        let [speed, _] = above.speeds(&above.setup.after(STEPS));
        let (sine, cosine) = above.angle.sin_cos();
        let expected = (sine - FRICTION * cosine) * GRAVITY * STEPS as f64 * STEP;
        assert!(
            (speed / expected - 1.0).abs() < 2e-2,
            "{speed:e} for {expected:e}, {tangential:?}"
        );
    }
}

#[test]
fn rolling_resistance_holds_a_sphere_up_to_its_coefficient() {
    const STEPS: u64 = 10_000;
    const RESISTANCE: f64 = 0.1;
    for tangential in &tangentials(FRICTION)[1..] {
        let below = Incline::new(0.9 * RESISTANCE, *tangential, rolling(RESISTANCE));
        let [creep, _] = below.speeds(&below.setup.after(STEPS));
        assert!(creep.abs() < 5.0 * GRAVITY * STEP, "{creep:e} {tangential:?}");
        let above = Incline::new(2.0 * RESISTANCE, *tangential, rolling(RESISTANCE));
        let [speed, _] = above.speeds(&above.setup.after(STEPS));
        let (sine, cosine) = above.angle.sin_cos();
        let expected = 5.0 / 7.0 * (sine - RESISTANCE * cosine) * GRAVITY * STEPS as f64 * STEP;
        assert!(
            (speed / expected - 1.0).abs() < 5e-3,
            "{speed:e} for {expected:e}, {tangential:?}"
        );
    }
}
