//! Runs a collision.

use super::model::{BinaryCollision, IntegratorChoice};
use super::pair::NORMAL;
use super::setup::{Impact, ScenePair};
use crate::contact::Touch;
use crate::integrator::{Accelerations, Bodies, Gear, Integrator, RungeKutta4, VelocityVerlet};
use crate::math::{Vec3, bisect};
use crate::outcome::{Column, Control, Counters, Failure, FailureKind, Outcome, Scalar, Table};

/// Rows of a time series, about.
const ROWS: f64 = 500.0;
/// Contact times after which a contact counts as never ending.
const LONGEST: f64 = 100.0;

/// Runs the scene from first touch to separation.
///
/// # Errors
/// A contact that does not end, passes through, or is not finite.
pub fn run(scene: &BinaryCollision, control: &Control) -> Result<Outcome, Box<Failure>> {
    let impact = Impact::of(scene);
    match scene.integrator {
        IntegratorChoice::VelocityVerlet => follow::<VelocityVerlet>(&impact, control),
        IntegratorChoice::Gear5 => follow::<Gear<5>>(&impact, control),
        IntegratorChoice::Gear6 => follow::<Gear<6>>(&impact, control),
        IntegratorChoice::RungeKutta4 => follow::<RungeKutta4>(&impact, control),
    }
}

fn follow<I: Integrator>(impact: &Impact, control: &Control) -> Result<Outcome, Box<Failure>> {
    let dt = impact.time_step();
    let mut pair = impact.pair(dt);
    let mut bodies = impact.start();
    let mut scheme = I::start(&bodies, &mut pair);
    let mut record = Record::new(impact, &pair, &bodies, dt);
    let most = (LONGEST * impact.contact_time() / dt).ceil() as u64;
    for step in 1..=most {
        let before = (bodies.clone(), scheme.accelerations().clone());
        scheme.step(&mut bodies, &mut pair, dt);
        let touch = pair.touch(&bodies);
        let between = Between {
            ends: [(&before.0, &before.1), (&bodies, scheme.accelerations())],
            time_step: dt,
        };
        record.steps = step;
        record.evaluations = pair.evaluations;
        let passed = touch.normal.dot(&pair.touch(&before.0).normal) < 0.0;
        if let Some(reason) = astray(impact, (&before.0, &bodies), passed, step as f64 * dt, &touch) {
            return Err(failed(FailureKind::Diverged, reason, record.outcome()));
        }
        record.deepen(&pair, &between, &touch);
        if touch.contact.overlap <= 0.0 {
            record.close(&pair, &between);
            return Ok(record.outcome());
        }
        record.add(&pair, &bodies, &touch);
        if step.is_multiple_of(256) && (control.stop)() {
            return Err(failed(
                FailureKind::Stopped,
                "stopped from outside".into(),
                record.outcome(),
            ));
        }
    }
    let reason = format!(
        "grains 0 and 1 are still in contact after {LONGEST} contact times, t = {:.6e} s, at {} and {}",
        most as f64 * dt,
        place(&bodies.position[0]),
        place(&bodies.position[1])
    );
    Err(failed(FailureKind::Diverged, reason, record.outcome()))
}

fn failed(kind: FailureKind, reason: String, partial: Outcome) -> Box<Failure> {
    Box::new(Failure {
        kind,
        reason,
        partial,
    })
}

/// Why the motion makes no sense any more: what, which body, where, when.
fn astray(
    impact: &Impact,
    (before, after): (&Bodies, &Bodies),
    passed: bool,
    time: f64,
    touch: &Touch,
) -> Option<String> {
    let (overlap, radius) = (touch.contact.overlap, 0.5 * impact.diameter());
    let sound = overlap.is_finite() && touch.contact.rate.is_finite() && touch.slip.norm().is_finite();
    if !sound {
        let body = after.position.iter().position(|place| !place.norm().is_finite());
        let body = body.unwrap_or(0);
        return Some(format!(
            "the motion of grain {body} is not finite at t = {time:.6e} s; a step before it was at {}",
            place(&before.position[body])
        ));
    }
    (passed || overlap > radius).then(|| {
        format!(
            "grains 0 and 1 pass through each other at t = {time:.6e} s, at {} and {}",
            place(&after.position[0]),
            place(&after.position[1])
        )
    })
}

fn place(x: &Vec3) -> String {
    format!("({:.4e}, {:.4e}, {:.4e}) m", x.x, x.y, x.z)
}

/// The motion between two instants, from states and accelerations at both: cubic.
struct Between<'a> {
    ends: [(&'a Bodies, &'a Accelerations); 2],
    time_step: f64,
}

impl Between<'_> {
    fn at(&self, share: f64) -> Bodies {
        let [(a, slopes_a), (b, slopes_b)] = self.ends;
        let cubic = |values: [&Vec<Vec3>; 2], slopes: [&Vec<Vec3>; 2]| -> Vec<Vec3> {
            (0..values[0].len())
                .map(|i| self.cubic(share, [values[0][i], values[1][i]], [slopes[0][i], slopes[1][i]]))
                .collect()
        };
        Bodies {
            position: cubic([&a.position, &b.position], [&a.velocity, &b.velocity]),
            velocity: cubic([&a.velocity, &b.velocity], [&slopes_a.linear, &slopes_b.linear]),
            angular_velocity: cubic(
                [&a.angular_velocity, &b.angular_velocity],
                [&slopes_a.angular, &slopes_b.angular],
            ),
        }
    }

    /// Hermite's polynomial at a share of the step.
    fn cubic(&self, s: f64, values: [Vec3; 2], slopes: [Vec3; 2]) -> Vec3 {
        let r = 1.0 - s;
        let [a, b] = values;
        let [da, db] = slopes.map(|slope| slope * self.time_step);
        a * (r * r * (1.0 + 2.0 * s)) + b * (s * s * (3.0 - 2.0 * s)) + (da * r - db * s) * (r * s)
    }
}

/// Kinetic energy [J], momentum [N s] and angular momentum [N m s] of the bodies that move.
fn totals(pair: &ScenePair, bodies: &Bodies) -> (f64, Vec3, Vec3) {
    let mut totals = (0.0, Vec3::zeros(), Vec3::zeros());
    for (i, body) in pair.bodies.iter().enumerate().filter(|(_, body)| !body.is_wall()) {
        let (x, v, w) = (bodies.position[i], bodies.velocity[i], bodies.angular_velocity[i]);
        totals.0 += 0.5 * body.mass * v.norm_squared() + 0.5 * body.inertia * w.norm_squared();
        totals.1 += v * body.mass;
        totals.2 += x.cross(&v) * body.mass + w * body.inertia;
    }
    totals
}

/// What is kept of a run.
struct Record<'a> {
    impact: &'a Impact<'a>,
    dt: f64,
    steps: u64,
    /// Evaluations of the contact's force.
    evaluations: u64,
    every: u64,
    /// Time, overlap, normal force, tangential force.
    rows: Vec<[f64; 4]>,
    start: (f64, Vec3, Vec3),
    /// Greatest overlap so far [m] and the approach at the last step [m/s].
    deepest: f64,
    approach: f64,
    /// Energy dissipated so far [J] and the power at the last step [W].
    dissipated: f64,
    power: f64,
    /// Greatest departures of momentum and angular momentum so far.
    momentum: f64,
    angular_momentum: f64,
    end: Option<End>,
}

/// The instant of separation.
struct End {
    time: f64,
    touch: Touch,
    energy: f64,
}

impl<'a> Record<'a> {
    fn new(impact: &'a Impact, pair: &ScenePair, bodies: &Bodies, dt: f64) -> Self {
        let touch = pair.touch(bodies);
        let steps = impact.contact_time() / dt;
        let mut record = Record {
            impact,
            dt,
            steps: 0,
            evaluations: 0,
            every: (steps / ROWS).ceil().max(1.0) as u64,
            rows: Vec::new(),
            start: totals(pair, bodies),
            deepest: 0.0,
            approach: touch.contact.rate,
            dissipated: 0.0,
            power: 0.0,
            momentum: 0.0,
            angular_momentum: 0.0,
            end: None,
        };
        let (reaction, _) = pair.reaction(&touch, 0.0);
        record.power = reaction.dissipation.sum();
        record.row(0.0, &touch, &reaction);
        record
    }

    fn row(&mut self, time: f64, touch: &Touch, reaction: &crate::contact::Reaction) {
        let friction = reaction.friction.y;
        let overlap = touch.contact.overlap.max(0.0);
        self.rows.push([time, overlap, reaction.normal_force, friction]);
    }

    /// The greatest overlap lies where the approach changes its sign.
    fn deepen(&mut self, pair: &ScenePair, between: &Between, touch: &Touch) {
        let rate = touch.contact.rate;
        if self.approach > 0.0 && rate <= 0.0 {
            let at = bisect(0.0, 1.0, |s| -pair.touch(&between.at(s)).contact.rate);
            let overlap = pair.touch(&between.at(at)).contact.overlap;
            self.deepest = self.deepest.max(overlap);
        }
        self.approach = rate;
    }

    fn add(&mut self, pair: &ScenePair, bodies: &Bodies, touch: &Touch) {
        let (reaction, _) = pair.reaction(touch, 0.0);
        self.dissipate(reaction.dissipation.sum(), self.dt);
        self.balance(pair, bodies);
        if self.steps.is_multiple_of(self.every) {
            self.row(self.steps as f64 * self.dt, touch, &reaction);
        }
    }

    /// Adds the dissipation of a stretch of time, by the trapezoidal rule.
    fn dissipate(&mut self, power: f64, time: f64) {
        self.dissipated += 0.5 * (self.power + power) * time;
        self.power = power;
    }

    fn balance(&mut self, pair: &ScenePair, bodies: &Bodies) {
        let (_, momentum, angular) = totals(pair, bodies);
        self.momentum = self.momentum.max((momentum - self.start.1).norm());
        self.angular_momentum = self.angular_momentum.max((angular - self.start.2).norm());
    }

    /// Cuts the last step where the overlap was zero.
    fn close(&mut self, pair: &ScenePair, between: &Between) {
        let share = bisect(0.0, 1.0, |s| -pair.touch(&between.at(s)).contact.overlap);
        let bodies = between.at(share);
        let touch = pair.touch(&bodies);
        let (reaction, _) = pair.reaction(&touch, 0.0);
        let time = ((self.steps - 1) as f64 + share) * self.dt;
        self.dissipate(reaction.dissipation.sum(), share * self.dt);
        self.balance(pair, between.ends[1].0);
        self.row(time, &touch, &reaction);
        self.end = Some(End {
            time,
            touch,
            energy: totals(pair, &bodies).0,
        });
    }

    fn outcome(&self) -> Outcome {
        let column = |name, unit, i: usize| Column {
            name,
            unit,
            values: self.rows.iter().map(|row| row[i]).collect(),
        };
        Outcome {
            scalars: self.scalars(),
            tables: vec![Table {
                name: "time_series",
                columns: vec![
                    column("time", "s", 0),
                    column("overlap", "m", 1),
                    column("normal_force", "N", 2),
                    column("tangential_force", "N", 3),
                ],
            }],
            counters: Counters {
                steps: self.steps,
                grain_steps: self.steps,
                grain_pairs: self.evaluations,
                ..Counters::default()
            },
        }
    }

    fn scalars(&self) -> Vec<Scalar> {
        let scalar = |name, unit, value| Scalar { name, unit, value };
        let impact = self.impact;
        let mut scalars = vec![
            scalar("time_step", "s", self.dt),
            scalar("maximum_overlap", "1", self.deepest / impact.diameter()),
        ];
        let Some(end) = &self.end else {
            return scalars;
        };
        let speed = impact.scene.speed;
        let lost = self.start.0 - end.energy;
        scalars.extend([
            scalar("restitution", "1", -end.touch.contact.rate / speed),
            scalar("contact_time", "s", end.time),
            scalar(
                "energy_balance_error",
                "1",
                (lost - self.dissipated).abs() / self.start.0,
            ),
        ]);
        if impact.slip() != 0.0 {
            let after = end.touch.slip.dot(&Vec3::new(-NORMAL.y, NORMAL.x, 0.0).into());
            scalars.push(scalar("tangential_restitution", "1", -after / impact.slip()));
        }
        if !impact.bodies[1].is_wall() {
            let unit = impact.contact.reduced_mass * speed;
            let lever = 0.5 * impact.diameter();
            scalars.push(scalar("momentum_error", "1", self.momentum / unit));
            scalars.push(scalar(
                "angular_momentum_error",
                "1",
                self.angular_momentum / (unit * lever),
            ));
        }
        scalars
    }
}
