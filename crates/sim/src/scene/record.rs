//! Watches a run: time series, windows, momentum and final profiles.

use super::SphFluid;
use super::setup::Settling;
use crate::drag::PolydisperseLaw;
use crate::math::Vec3;
use crate::outcome::{Column, Counters, Outcome, Scalar, Table};
use crate::simulation::Simulation;

/// Rows of a time series at most.
const ROWS: u64 = 600;
/// Steps between momentum audits.
const AUDIT_INTERVAL: u64 = 20;

/// Lengths of the widest kernel after which it has no more than 1e-4 of its weight beyond a plane [-].
const EDGE: f64 = 1.5;

/// A quantity that is averaged over the terminal window: name, unit, value.
type Windowed = (&'static str, &'static str, fn(&Sample) -> f64);

const WINDOWED: [Windowed; 4] = [
    ("terminal_slip", "m/s", |sample| sample.slip),
    ("terminal_drag", "N", |sample| sample.drag),
    ("terminal_stress_force", "N", |sample| sample.stress),
    ("terminal_fluid_acceleration", "m/s²", |sample| {
        sample.fluid_acceleration
    }),
];

/// A row of the time series.
#[derive(Clone, Debug, Default)]
pub struct Sample {
    pub time: f64,
    pub velocity: f64,
    pub slip: f64,
    pub drag: f64,
    pub stress: f64,
    pub fluid_acceleration: f64,
    pub disturbance: f64,
    pub own_flow: f64,
    pub height: f64,
    pub tracked_slip: [f64; 4],
    pub tracked_drag: [f64; 4],
    pub momentum_error: f64,
}

pub struct Recorder {
    every: u64,
    tracked: [usize; 4],
    samples: Vec<Sample>,
    window: (f64, f64),
    /// Largest momentum residual of an audited step and largest impulse exchanged in a step [N s].
    residual: f64,
    exchanged: f64,
    spurious: f64,
    scalars: Vec<Scalar>,
    relaxation: f64,
    /// Buoyancy that the fluid's stress does not hold [N].
    buoyancy: f64,
    /// Of a grain on the mean [kg].
    mass: f64,
    isolated: bool,
    block_layers: usize,
    /// Half the height of the block that smoothing at its edges does not reach [m].
    inside: f64,
}

impl Recorder {
    pub fn new<L: PolydisperseLaw>(
        settling: &Settling,
        sph: &SphFluid,
        dt: f64,
        steps: u64,
        simulation: &Simulation<L>,
    ) -> Self {
        let count = simulation.grains.grains.len();
        let sound = simulation.fluid.numerics.state.sound_speed;
        let scalar = |name, unit, value| Scalar { name, unit, value };
        let mass = simulation.grains.mass() / count as f64;
        let buoyancy = mass * settling.gravity - simulation.grains.weight() / count as f64;
        Recorder {
            every: steps.div_ceil(ROWS),
            tracked: [0, count / 3, 2 * count / 3, count - 1],
            samples: vec![Sample {
                height: simulation.grains.grains[0].position.z,
                fluid_acceleration: buoyancy / mass,
                ..Sample::default()
            }],
            window: terminal_window(settling, Some(sound)),
            residual: 0.0,
            exchanged: 0.0,
            spurious: 0.0,
            relaxation: settling.relaxation_time(),
            buoyancy,
            mass,
            isolated: settling.sphere.is_some(),
            block_layers: settling.block.map_or(0, |block| block.layers as usize),
            inside: settling.block.map_or(0.0, |block| {
                let edge = EDGE * settling.exchange_length(sph);
                (0.5 * settling.thickness(block) - edge).max(settling.spacing(sph))
            }),
            scalars: vec![
                scalar("sound_speed", "m/s", sound),
                scalar("time_step", "s", dt),
                scalar("smoothing_length", "m", simulation.fluid.numerics.smoothing()),
                scalar("exchange_length", "m", settling.exchange_length(sph)),
                scalar("fluid_particles", "1", simulation.fluid.len() as f64),
                scalar("grains", "1", count as f64),
                scalar("porosity", "1", settling.porosity()),
                scalar(
                    "spacing_over_diameter",
                    "1",
                    settling.spacing(sph) / settling.mixture.smallest(),
                ),
            ],
        }
    }

    /// Takes a step, audits and samples.
    pub fn step<L: PolydisperseLaw>(&mut self, simulation: &mut Simulation<L>, step: u64, dt: f64) {
        if step.is_multiple_of(AUDIT_INTERVAL) {
            let residual = simulation.audited_step(dt);
            self.residual = self.residual.max(residual.norm());
            let speeds = simulation.fluid.velocity.iter().map(Vec3::norm_squared);
            self.spurious = self.spurious.max(speeds.fold(0.0, f64::max).sqrt());
        } else {
            simulation.step(dt);
        }
        self.exchanged = self.exchanged.max(simulation.report.impulse);
        if (step + 1).is_multiple_of(self.every) {
            self.samples.push(self.sample(simulation));
        }
    }

    /// Momentum not closed in a step over the impulse grains and fluid exchange in one [-].
    fn momentum_error(&self) -> f64 {
        self.residual / self.exchanged.max(f64::MIN_POSITIVE)
    }

    fn sample<L: PolydisperseLaw>(&self, simulation: &Simulation<L>) -> Sample {
        let report = &simulation.report;
        Sample {
            time: simulation.time,
            velocity: -simulation.grains.velocity.z,
            slip: report.slip,
            drag: report.drag,
            stress: report.stress,
            fluid_acceleration: (report.drag + report.stress + self.buoyancy) / self.mass,
            disturbance: report.sampled,
            own_flow: report.own_flow,
            height: simulation.grains.grains[0].position.z,
            tracked_slip: self.tracked.map(|i| simulation.slip_and_drag(i).0),
            tracked_drag: self.tracked.map(|i| simulation.slip_and_drag(i).1),
            momentum_error: self.momentum_error(),
        }
    }

    /// Everything watched, as an outcome.
    pub fn finish<L: PolydisperseLaw>(mut self, simulation: &Simulation<L>) -> Outcome {
        let error = self.momentum_error();
        let mut push = |name, unit, value| self.scalars.push(Scalar { name, unit, value });
        let times: Vec<f64> = self.samples.iter().map(|sample| sample.time).collect();
        let velocity: Vec<f64> = self.samples.iter().map(|sample| sample.velocity).collect();
        if let Some((mean, drift)) = window_mean(&times, &velocity, self.window) {
            push("terminal_velocity", "m/s", mean);
            push("terminal_velocity_drift", "m/s", drift);
        }
        if simulation.rules.two_way {
            push("momentum_error", "1", error);
        }
        for (name, unit, value) in WINDOWED {
            let values: Vec<f64> = self.samples.iter().map(value).collect();
            if let Some((mean, _)) = window_mean(&times, &values, self.window) {
                push(name, unit, mean);
            }
        }
        push("spurious_velocity", "m/s", self.spurious);
        push("overlap", "1", simulation.report.overlap);
        if !self.isolated {
            push(
                "plateau_porosity",
                "1",
                super::profiles::plateau_porosity(simulation),
            );
            push(
                "porosity_ripple",
                "1",
                super::profiles::porosity_ripple(simulation, self.inside),
            );
        }
        if self.isolated {
            let largest = self.samples.iter().map(|s| s.velocity).fold(0.0, f64::max);
            let settled = || {
                self.samples
                    .iter()
                    .filter(|sample| sample.time > 3.0 * self.relaxation)
            };
            let gap = settled()
                .map(|s| (s.disturbance - s.own_flow).abs())
                .fold(0.0, f64::max);
            let wake = settled().map(|s| s.disturbance.abs()).fold(0.0, f64::max);
            let corrected = self.samples.iter().any(|sample| sample.own_flow != 0.0);
            if wake > 0.0 {
                push("disturbance_share", "1", wake / largest);
            }
            if wake > 0.0 && corrected {
                push("self_disturbance_error", "1", gap / wake);
            }
        }
        let profiles = super::profiles::fluid(simulation);
        if !self.isolated {
            let solids = 1.0 - super::profiles::plateau_porosity(simulation);
            push(
                "edge_width",
                "m",
                solids / super::profiles::steepest(&profiles[0]),
            );
        }
        let mut tables = vec![self.series()];
        tables.extend(profiles);
        if !self.isolated {
            tables.push(super::profiles::axis(simulation));
        }
        tables.extend(super::profiles::layers(simulation, self.block_layers));
        Outcome {
            scalars: self.scalars,
            tables,
            counters: counters(simulation),
        }
    }

    fn series(&self) -> Table {
        let column = |name, unit, value: fn(&Sample) -> f64| Column {
            name,
            unit,
            values: self.samples.iter().map(value).collect(),
        };
        let mut columns = vec![
            column("time", "s", |s| s.time),
            column("velocity", "m/s", |s| s.velocity),
            column("height", "m", |s| s.height),
            column("slip_velocity", "m/s", |s| s.slip),
            column("drag_force", "N", |s| s.drag),
            column("stress_force", "N", |s| s.stress),
            column("fluid_acceleration", "m/s²", |s| s.fluid_acceleration),
            column("momentum_error_history", "1", |s| s.momentum_error),
        ];
        if self.isolated {
            columns.push(column("disturbance", "m/s", |s| s.disturbance));
            columns.push(column("disturbance_analytic", "m/s", |s| s.own_flow));
        } else {
            columns.push(column("slip_velocity_1", "m/s", |s| s.tracked_slip[0]));
            columns.push(column("slip_velocity_2", "m/s", |s| s.tracked_slip[1]));
            columns.push(column("slip_velocity_3", "m/s", |s| s.tracked_slip[2]));
            columns.push(column("slip_velocity_4", "m/s", |s| s.tracked_slip[3]));
            columns.push(column("drag_force_1", "N", |s| s.tracked_drag[0]));
            columns.push(column("drag_force_2", "N", |s| s.tracked_drag[1]));
            columns.push(column("drag_force_3", "N", |s| s.tracked_drag[2]));
            columns.push(column("drag_force_4", "N", |s| s.tracked_drag[3]));
        }
        Table {
            name: "time_series",
            columns,
        }
    }
}

fn counters<L: PolydisperseLaw>(simulation: &Simulation<L>) -> Counters {
    Counters {
        steps: simulation.steps,
        grain_steps: simulation.grain_steps,
        fluid_pairs: simulation.fluid.pairs,
        coupling_pairs: simulation.exchange.pairs,
        list_rebuilds: simulation.fluid.rebuilds,
        porosity_clips: simulation.porosity_clips,
        ..Counters::default()
    }
}

/// When the speed counts as terminal [s]: 20 to 40 relaxation times for a sphere (response times where the
/// fluid is not solved), the last 4 H/c for a block; cut to the run.
pub fn terminal_window(settling: &Settling, sound_speed: Option<f64>) -> (f64, f64) {
    let relaxation = match (settling.sphere, settling.sph()) {
        (Some(_), None) => settling.response_time(),
        _ => settling.relaxation_time(),
    };
    match (settling.block, sound_speed) {
        (Some(_), Some(c)) => {
            let length = (4.0 * settling.column.height / c).min(0.5 * settling.duration);
            (settling.duration - length, settling.duration)
        }
        _ => (20.0 * relaxation, (40.0 * relaxation).min(settling.duration)),
    }
}

/// Mean over a window and the drift across it: the mean of its second half less that of its first.
pub fn window_mean(times: &[f64], values: &[f64], window: (f64, f64)) -> Option<(f64, f64)> {
    let inside: Vec<f64> = times
        .iter()
        .zip(values)
        .filter(|(time, _)| (window.0..=window.1 * (1.0 + 1e-12)).contains(*time))
        .map(|(_, value)| *value)
        .collect();
    if inside.len() < 2 {
        return None;
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (first, second) = inside.split_at(inside.len() / 2);
    Some((mean(&inside), mean(second) - mean(first)))
}
