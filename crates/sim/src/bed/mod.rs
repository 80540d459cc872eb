//! Many grains under contact, attraction and a fluid that is not solved for.
//!
//! A step: kick, drift, renew the lists, sum the forces. Pairs are kept in half lists in blocks of
//! eight with their contact histories beside them; grains are stored along a curve in space.

mod attraction;
mod contacts;
mod crew;
mod driven;
mod grains;
mod motion;
mod pairs;
mod scheme;
mod sleep;
mod slices;
#[cfg(test)]
mod tests;
mod touching;
mod walls;

pub use attraction::{Attraction, Charge};
pub use contacts::{Interaction, Laws};
pub use driven::Drive;
pub use grains::{Grain, Grains};
pub use motion::Surroundings;
pub use scheme::Scheme;
pub use slices::Porosity;
pub use touching::Touching;
pub use walls::Wall;

use crate::math::Vec3;
use crate::neighbours::{Record, Search, in_widest};

use contacts::PairSweep;
use crew::Crew;
use driven::Driven;
use motion::{KickAndDrift, Stride};
use pairs::PairList;
use sleep::Sleep;
use walls::{WallSweep, Walls};

/// Skin of a list where every step makes its own [m over the smallest diameter].
const NO_SKIN: f64 = 0.0;
/// Skin of a list over the smallest diameter: at least, at most.
const SKIN: [f64; 2] = [0.02, 0.4];
/// Steps that a list should last.
const LIST_STEPS: f64 = 60.0;

/// How near pairs are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Listing {
    /// With a skin over the smallest diameter; `None` picks it from the speeds.
    Skin(Option<f64>),
    /// Searched anew in every step.
    EveryStep(Search),
}

/// A grain that moved where no grain can.
#[derive(Clone, Debug, PartialEq)]
pub struct Astray {
    /// Number of the grain.
    pub grain: u32,
    /// Where it is [m].
    pub position: Vec3,
    /// [m/s]
    pub velocity: Vec3,
}

/// Work done so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    pub steps: u64,
    /// Pairs in the lists, summed over the steps.
    pub pairs: u64,
    /// Pairs looked at while lists were made.
    pub looked_at: u64,
    pub lists: u64,
    /// Grains in the sub-steps of a driven bed, summed over the sub-steps.
    pub sub_steps: u64,
    /// Spans that grains of a driven bed flew through without a sub-step.
    pub flights: u64,
    /// Spans of a driven bed done again, since a grain went farther than was foreseen.
    pub repeats: u64,
}

/// Grains, what acts on them, and where they are.
pub struct Bed {
    pub grains: Grains,
    pub interaction: Interaction,
    pub surroundings: Surroundings,
    pub listing: Listing,
    /// `None` where every grain sees clear fluid at rest.
    pub porosity: Option<Porosity>,
    pub work: Work,
    /// Greatest overlap over the smaller diameter since it was last set to zero.
    pub deepest: f64,
    walls: Walls,
    pairs: PairList,
    forces: Vec<Record>,
    /// `None` where one thread does everything.
    crew: Option<Crew>,
    /// `None` where nobody ever sleeps.
    sleep: Option<Sleep>,
    driven: Driven,
    /// Way every grain may go before the lists must be renewed [m].
    slack: f64,
    /// Smallest diameter [m].
    smallest: f64,
}

impl Bed {
    pub fn new(
        grains: Grains,
        walls: &[Wall],
        interaction: Interaction,
        surroundings: Surroundings,
        listing: Listing,
        porosity: Option<Porosity>,
    ) -> Self {
        let smallest = grains
            .spheres()
            .iter()
            .map(|sphere| 2.0 * sphere.0[3])
            .fold(f64::INFINITY, f64::min);
        let mut bed = Bed {
            forces: vec![Record::default(); grains.motion.len()],
            grains,
            interaction,
            surroundings,
            listing,
            porosity,
            work: Work::default(),
            deepest: 0.0,
            walls: Walls::new(walls),
            pairs: PairList::default(),
            crew: None,
            sleep: None,
            driven: Driven::default(),
            slack: 0.0,
            smallest,
        };
        bed.renew_lists(0.0);
        if let Some(porosity) = &mut bed.porosity {
            porosity.refresh(&mut bed.grains, &bed.surroundings);
        }
        bed.sum_forces(0.0);
        bed
    }

    /// Takes so many threads from now on; results do not depend on it.
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.crew = Crew::new(threads);
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, &self.grains);
        }
        self
    }

    /// Advances by `steps` time steps; velocities and positions belong to the same instant after it.
    ///
    /// # Errors
    /// A grain whose way in one step is longer than half the smallest diameter, or no number.
    pub fn advance(&mut self, steps: u64) -> Result<(), Astray> {
        self.join_lists();
        let dt = self.interaction.time_step;
        for step in 0..steps {
            if self.sleep.as_ref().is_some_and(|sleep| sleep.all(&self.grains)) {
                return Ok(());
            }
            let kick = if step == 0 { 0.5 * dt } else { dt };
            let fastest = self.move_on(kick, dt)?;
            self.work.steps += 1;
            self.slack -= fastest * dt;
            if self.slack < 0.0 {
                self.renew_lists(fastest);
            }
            if let Some(porosity) = &mut self.porosity {
                porosity.follow(&mut self.grains, &self.surroundings, fastest * dt, dt);
            }
            self.sum_forces(dt);
            self.rouse_and_rest();
        }
        if steps > 0 {
            self.move_on(0.5 * dt, 0.0)?;
        }
        Ok(())
    }

    /// Kicks and drifts; returns the greatest speed [m/s].
    fn move_on(&mut self, kick: f64, drift: f64) -> Result<f64, Astray> {
        let limit = self.speed_limit();
        let stride = Stride { kick, drift, limit };
        let moving = self.grains.moving;
        let (own, fixed) = self.forces.split_at_mut(moving);
        // What acts on fixed grains moves nobody.
        fixed.fill(Record::default());
        let (motion, spin) = (&mut self.grains.motion[..moving], &mut self.grains.spin[..moving]);
        let surroundings = &self.surroundings;
        let fastest = match &self.crew {
            Some(crew) => crew.move_on(surroundings, [motion, spin, own], stride),
            None => in_widest(KickAndDrift {
                surroundings,
                motion,
                spin,
                forces: own,
                stride,
            }),
        };
        if fastest.is_finite() {
            Ok(fastest)
        } else {
            Err(self.astray(limit))
        }
    }

    /// Speed that no grain may reach: half the smallest diameter in a step [m/s].
    fn speed_limit(&self) -> f64 {
        0.5 * self.smallest / self.interaction.time_step
    }

    /// Place of a grain whose spin or position is no number.
    pub fn astray_spin(&self) -> Option<usize> {
        (0..self.grains.moving).find(|grain| {
            let (x, w) = (self.grains.position(*grain), self.grains.angular_velocity(*grain));
            !(x.norm().is_finite() && w.norm().is_finite())
        })
    }

    fn astray(&self, limit: f64) -> Astray {
        let sound = |grain: &usize| {
            let place = self.grains.position(*grain);
            place.iter().all(|x| x.is_finite()) && self.grains.velocity(*grain).norm() < limit
        };
        let grain = (0..self.grains.moving).find(|grain| !sound(grain)).unwrap_or(0);
        Astray {
            grain: self.grains.number[grain],
            position: self.grains.position(grain),
            velocity: self.grains.velocity(grain),
        }
    }

    /// Makes the lists of near pairs anew; contacts keep their histories.
    fn renew_lists(&mut self, fastest: f64) {
        let way = fastest * self.interaction.time_step;
        let (search, skin) = match self.listing {
            Listing::EveryStep(search) => (search, NO_SKIN),
            Listing::Skin(Some(skin)) => (Search::Grid, skin * self.smallest),
            Listing::Skin(None) => (Search::Grid, self.skin_for(way)),
        };
        self.list_within(search, skin);
    }

    /// Skin of lists that should last while the fastest go so far in a step [m].
    fn skin_for(&self, way: f64) -> f64 {
        (2.0 * way * LIST_STEPS).clamp(SKIN[0] * self.smallest, SKIN[1] * self.smallest)
    }

    /// Lists the pairs whose gaps are under the skin [m] and the reach of what attracts.
    fn list_within(&mut self, search: Search, skin: f64) {
        let grains = &self.grains;
        let count = grains.len();
        let memories = self
            .pairs
            .memories(|places| places.map(|place| grains.number[place as usize]), count);
        let wall_memories = self.walls.memories(grains);
        let period = self.interaction.period;
        self.grains.wrap(period);
        self.grains.sort();
        self.slack = 0.5 * skin;
        let reach = skin
            + self
                .interaction
                .attraction
                .map_or(0.0, |attraction| attraction.reach());
        let grains = &self.grains;
        self.pairs = PairList::of_grains(grains, search, period, reach, &mut self.work.looked_at);
        self.pairs.recall(
            |places| places.map(|place| grains.number[place as usize]),
            &memories,
        );
        self.walls.renew(grains, reach, &wall_memories);
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, grains);
        }
        self.find_border();
        self.driven.forget();
        self.work.lists += 1;
    }

    /// Sums the forces on all grains; histories move on by `elapsed` [s].
    fn sum_forces(&mut self, elapsed: f64) {
        let (interaction, grains) = (&self.interaction, &self.grains);
        let deepest = match &mut self.crew {
            Some(crew) => crew.sum(interaction, grains, &mut self.pairs, elapsed, &mut self.forces),
            None => in_widest(PairSweep {
                interaction,
                grains,
                pairs: self.pairs.whole(),
                elapsed,
                sink: &mut self.forces[..],
            }),
        };
        let at_walls = in_widest(WallSweep {
            interaction: &self.interaction,
            grains: &self.grains,
            walls: &mut self.walls,
            elapsed,
            forces: &mut self.forces,
        });
        self.deepest = self.deepest.max(deepest).max(at_walls);
        self.work.pairs += self.pairs.count as u64;
    }
}
