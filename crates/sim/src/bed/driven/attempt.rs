//! The sub-steps of a span, which may be taken back.

use crate::bed::contacts::{Interaction, PairSweep};
use crate::bed::motion::Stride;
use crate::bed::pairs::History;
use crate::bed::walls::WallSweep;
use crate::bed::{Astray, Bed};
use crate::neighbours::{Record, in_widest};

use super::sub_steps::KickSome;
use super::{Driven, ROUNDING, Span};

/// How the busy ones were before the span.
#[derive(Clone, Debug, Default)]
pub struct Start {
    /// Motion, spin and forces in the order of `some`.
    pub states: Vec<[Record; 3]>,
    pairs: (Vec<History>, Vec<bool>),
    walls: (Vec<History>, Vec<bool>),
}

impl Bed {
    pub(super) fn keep_start(&mut self) {
        let Driven { some, start, .. } = &mut self.driven;
        start.states.clear();
        for &place in some.as_flattened() {
            let place = place as usize;
            start.states.push([
                self.grains.motion[place],
                self.grains.spin[place],
                self.forces[place],
            ]);
        }
        let lists = [
            (&mut start.pairs, &self.pairs),
            (&mut start.walls, &self.walls.list),
        ];
        for (kept, list) in lists {
            kept.0.clear();
            kept.0.extend_from_slice(&list.histories[..list.active]);
            kept.1.clear();
            kept.1.extend_from_slice(&list.live[..list.active]);
        }
    }

    /// Puts the busy ones back to the start of the span.
    pub(super) fn take_back(&mut self) {
        let Driven {
            some,
            start,
            launches,
            ..
        } = &mut self.driven;
        for (&place, state) in some.as_flattened().iter().zip(&start.states) {
            let place = place as usize;
            [
                self.grains.motion[place],
                self.grains.spin[place],
                self.forces[place],
            ] = *state;
            launches[place].0[4..].fill(0.0);
        }
        let lists = [
            (&start.pairs, &mut self.pairs),
            (&start.walls, &mut self.walls.list),
        ];
        for (kept, list) in lists {
            list.histories[..list.active].copy_from_slice(&kept.0);
            list.live[..list.active].copy_from_slice(&kept.1);
        }
    }

    /// Takes the busy ones through the span; returns the greatest speed [m/s].
    pub(super) fn sub_step(&mut self, span: &Span) -> Result<f64, Astray> {
        let interaction = Interaction {
            time_step: span.step,
            ..self.interaction
        };
        let mut fastest = 0.0_f64;
        if self.driven.count == 0 {
            return Ok(fastest);
        }
        for step in 0..span.steps {
            let kick = if step == 0 { 0.5 * span.step } else { span.step };
            fastest = fastest.max(self.kick(kick, span.step, span.limit)?);
            self.sum_active(&interaction);
        }
        fastest = fastest.max(self.kick(0.5 * span.step, 0.0, span.limit)?);
        self.work.steps += u64::from(span.steps);
        self.work.sub_steps += u64::from(span.steps) * self.driven.count as u64;
        Ok(fastest)
    }

    fn kick(&mut self, kick: f64, drift: f64, limit: f64) -> Result<f64, Astray> {
        // What acts on fixed grains moves nobody.
        self.forces[self.grains.moving..].fill(Record::default());
        let fastest = in_widest(KickSome {
            motion: &mut self.grains.motion,
            spin: &mut self.grains.spin,
            forces: &mut self.forces,
            launches: &mut self.driven.launches,
            some: &self.driven.some,
            stride: Stride { kick, drift, limit },
            turn: self.interaction.laws.turn(),
        });
        if fastest.is_finite() {
            Ok(fastest)
        } else {
            Err(self.astray(limit))
        }
    }

    fn sum_active(&mut self, interaction: &Interaction) {
        let deepest = in_widest(PairSweep {
            interaction,
            grains: &self.grains,
            pairs: self.pairs.whole(),
            elapsed: interaction.time_step,
            sink: &mut self.forces[..],
        });
        let at_walls = in_widest(WallSweep {
            interaction,
            grains: &self.grains,
            walls: &mut self.walls,
            elapsed: interaction.time_step,
            forces: &mut self.forces,
        });
        self.deepest = self.deepest.max(deepest).max(at_walls);
        self.work.pairs += self.pairs.count as u64;
    }

    /// Whether a busy grain changed its velocity by more than was foreseen and so may have met somebody
    /// outside. Bounds hold for what happened after it.
    pub(super) fn overlooked(&mut self, span: &Span) -> bool {
        let Driven {
            some,
            launches,
            flights,
            change,
            ..
        } = &mut self.driven;
        let mut farther = false;
        for &place in some.as_flattened() {
            let (bound, changed) = (&mut flights[place as usize].0[3], launches[place as usize].0[7]);
            if changed > *bound * (1.0 + ROUNDING) {
                (*bound, farther) = (changed, true);
                *change = change.max(changed);
            }
        }
        if !farther {
            return false;
        }
        self.swap_start();
        let overlooked = self.somebody_meets_outside(span);
        self.swap_start();
        overlooked
    }

    /// Exchanges the motion of the busy ones now and at the start of the span.
    fn swap_start(&mut self) {
        let Driven { some, start, .. } = &mut self.driven;
        // Empty lanes stand for one that does not move.
        for (&place, state) in some.as_flattened().iter().zip(&mut start.states) {
            std::mem::swap(&mut self.grains.motion[place as usize], &mut state[0]);
        }
    }
}
