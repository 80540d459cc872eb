//! Runs a settling scene in a fluid that is not solved: at rest, or flowing back in a closed column.
//!
//! Every grain of the set sees the same fluid, so one grain, the mean of all, stands for them. Buoyancy is that of the
//! pure fluid (model B): force = −V ρ_f g + f/ε with the drag f of the superficial slip.

use super::Fluid;
use super::passage::Passage;
use super::record::{terminal_window, window_mean};
use super::setup::Settling;
use crate::drag::PolydisperseLaw;
use crate::integrator::ExactDrag;
use crate::math::Vec3;
use crate::outcome::{Column, Control, Counters, Failure, FailureKind, Outcome, Scalar, Table};

/// Rows of a time series at most.
const ROWS: usize = 600;
/// Share of the terminal velocity at which a grain counts as there [-].
const TERMINAL: f64 = 0.95;

/// Runs a scene without fluid particles under one drag law.
pub fn run<L: PolydisperseLaw>(
    settling: &Settling,
    law: L,
    control: &Control,
) -> Result<Outcome, Box<Failure>> {
    let (dt, steps) = settling.steps();
    let start = settling.positions()[0].z;
    let mut rows = vec![[0.0, 0.0, start, 0.0, 0.0, fluid_acceleration(settling, 0.0)]];
    let mut passage = Passage::of(settling, start);
    let (mut velocity, mut height) = (Vec3::zeros(), start);
    let held = settling.block.is_some_and(|block| block.held);
    let every = (steps as usize).div_ceil(ROWS);
    for step in 1..=steps {
        if (control.stop)() {
            let partial = outcome(settling, &rows, &passage, dt, step);
            return Err(Box::new(Failure {
                kind: FailureKind::Stopped,
                reason: "stopped from outside".into(),
                partial,
            }));
        }
        if !held {
            let (end, mean) = advance(settling, law, velocity, dt);
            velocity = end;
            height = (height + mean.z * dt).max(0.5 * settling.mixture.largest());
            if height <= 0.5 * settling.mixture.largest() {
                velocity = Vec3::zeros();
            }
        }
        let beta = coefficient(settling, law, velocity.norm());
        passage.note([step as f64 * dt, -velocity.z, height]);
        if (step as usize).is_multiple_of(every) {
            let drag = -beta * velocity.z;
            let slip = superficial(settling, -velocity.z);
            let time = step as f64 * dt;
            rows.push([
                time,
                -velocity.z,
                height,
                slip,
                drag,
                fluid_acceleration(settling, drag),
            ]);
        }
    }
    Ok(outcome(settling, &rows, &passage, dt, steps))
}

/// Velocity after a step and mean velocity over it, with the drag coefficient of the middle of the step:
/// second order, exact at rest, at the terminal velocity and under Stokes drag.
fn advance<L: PolydisperseLaw>(settling: &Settling, law: L, velocity: Vec3, dt: f64) -> (Vec3, Vec3) {
    let body = |speed: f64| ExactDrag {
        mass: settling.mass() + settling.added_mass(),
        drag: coefficient(settling, law, speed),
        pull: Vec3::zeros(),
        force: Vec3::new(0.0, 0.0, -settling.excess_weight()),
    };
    let (predicted, _) = body(velocity.norm()).advance(velocity, 0.5 * dt);
    body(predicted.norm()).advance(velocity, dt)
}

/// Acceleration of a grain by the fluid [m/s²], upward: drag, buoyancy and what added mass takes.
fn fluid_acceleration(settling: &Settling, drag: f64) -> f64 {
    let mass = settling.mass() + settling.added_mass();
    (drag - settling.excess_weight()) / mass + settling.gravity
}

/// Superficial slip of a grain that moves at `speed`: ε v in a fluid at rest, v where it flows back.
fn superficial(settling: &Settling, speed: f64) -> f64 {
    match settling.fluid {
        Fluid::Still(_) => settling.porosity() * speed,
        _ => speed,
    }
}

/// Drag per speed [kg/s] in the laboratory frame.
fn coefficient<L: PolydisperseLaw>(settling: &Settling, law: L, speed: f64) -> f64 {
    let share = superficial(settling, 1.0);
    let porosity = settling.porosity();
    let medium = settling.medium();
    let fluid = [medium.density, medium.viscosity];
    share / porosity * settling.mixture.coefficient(&law, fluid, share * speed, porosity)
}

fn outcome(settling: &Settling, rows: &[[f64; 6]], passage: &Passage, dt: f64, steps: u64) -> Outcome {
    let column = |name, unit, i: usize| Column {
        name,
        unit,
        values: rows.iter().map(|row| row[i]).collect(),
    };
    let columns = vec![
        column("time", "s", 0),
        column("velocity", "m/s", 1),
        column("height", "m", 2),
        column("slip_velocity", "m/s", 3),
        column("drag_force", "N", 4),
        column("fluid_acceleration", "m/s²", 5),
    ];
    let scalar = |name, unit, value| Scalar { name, unit, value };
    let count = settling.positions().len() as f64;
    let mut scalars = vec![
        scalar("time_step", "s", dt),
        scalar("porosity", "1", settling.porosity()),
        scalar("grains", "1", count),
        scalar("overlap", "1", 0.0),
    ];
    scalars.push(scalar("largest_velocity", "m/s", passage.largest));
    let window = terminal_window(settling, None);
    if let Some((mean, drift)) = window_mean(&columns[0].values, &columns[1].values, window) {
        scalars.push(scalar("terminal_velocity", "m/s", mean));
        scalars.push(scalar("terminal_velocity_drift", "m/s", drift));
        if let Some(time) = passage.time_to(TERMINAL * mean) {
            scalars.push(scalar("terminal_time", "s", time));
        }
    }
    Outcome {
        scalars,
        tables: vec![Table {
            name: "time_series",
            columns,
        }],
        counters: Counters {
            steps,
            grain_steps: steps,
            ..Counters::default()
        },
    }
}
