//! Where the time of a run goes.

use std::time::Instant;

/// What a step spends its time on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// Neighbours, pressure, viscosity and motion of the fluid.
    Fluid,
    /// Weights between grains and fluid, porosities.
    Weights,
    /// Sampling, drag and reaction.
    Exchange,
    /// Contacts and motion of the grains.
    Grains,
}

/// Names of the parts, in their order.
const NAMES: [&str; 4] = ["fluid", "weights", "exchange", "grains"];

/// A stopwatch with laps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Laps {
    last: Instant,
    /// By part [s].
    spent: [f64; NAMES.len()],
}

impl Laps {
    pub fn new() -> Self {
        Laps {
            last: Instant::now(),
            spent: [0.0; NAMES.len()],
        }
    }

    /// From here on time counts for the lap to come.
    pub fn start(&mut self) {
        self.last = Instant::now();
    }

    /// The lap that ends here was spent on this part.
    pub fn end(&mut self, part: Part) {
        let now = Instant::now();
        self.spent[part as usize] += (now - self.last).as_secs_f64();
        self.last = now;
    }

    /// Names of the parts and what was spent on each [s].
    pub fn split(&self) -> Vec<(&'static str, f64)> {
        NAMES.into_iter().zip(self.spent).collect()
    }
}
