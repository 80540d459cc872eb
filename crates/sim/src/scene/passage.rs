//! What every step of a fall is watched for, between the kept rows.

use super::setup::Settling;

/// Velocities of a grain on its way down, until one diameter is left below it: nearer to the floor the
/// fluid that it squeezes out would slow it down (lubrication), which is not modelled.
pub struct Passage {
    /// Height of the centre where the way ends [m].
    end: f64,
    /// Largest settling speed so far [m/s].
    pub largest: f64,
    /// Times [s] and speeds [m/s] while the speed rises.
    rise: Vec<(f64, f64)>,
}

impl Passage {
    /// A grain at rest at `start` [m].
    pub fn of(settling: &Settling, start: f64) -> Passage {
        Passage {
            end: (1.5 * settling.mixture.largest()).min(start),
            largest: 0.0,
            rise: vec![(0.0, 0.0)],
        }
    }

    /// Notes time [s], settling speed [m/s] and height [m] after a step.
    pub fn note(&mut self, [time, speed, height]: [f64; 3]) {
        if height < self.end {
            return;
        }
        if speed > self.largest {
            self.largest = speed;
            self.rise.push((time, speed));
        }
    }

    /// When the speed first came to `speed` [s], straight between steps; nothing if it never did.
    pub fn time_to(&self, speed: f64) -> Option<f64> {
        let after = self.rise.partition_point(|(_, reached)| *reached < speed);
        let (time, reached) = *self.rise.get(after)?;
        let Some((before, slower)) = after.checked_sub(1).map(|before| self.rise[before]) else {
            return Some(time);
        };
        Some(before + (speed - slower) / (reached - slower) * (time - before))
    }
}
