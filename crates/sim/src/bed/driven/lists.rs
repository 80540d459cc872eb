//! Lists divided into pairs that may meet within a span and others.

use crate::bed::contacts::Interaction;
use crate::bed::pairs::Standing;
use crate::bed::{Bed, Listing};
use crate::neighbours::{LANES, Record, Search, in_widest};

use super::encounters::{Encounters, Suspects, pairs_in};
use super::{Driven, ROUNDING, Span};

/// Gap over the smallest diameter up to which pairs are sub-stepped although they cannot meet by
/// themselves: one that is hit may still reach the other.
const FLOOR: f64 = 0.005;
/// The same of pairs whose both grains are sub-stepped anyway.
const CROWD: f64 = 0.02;
/// Spans after which pairs that were sub-stepped are looked at again.
const SPANS: u32 = 8;
impl Driven {
    /// Those of the moving grains that are busy will be sub-stepped; empty lanes hold `nobody`.
    fn employ(&mut self, busy: Vec<bool>, moving: usize, nobody: u32) {
        let places = 0..moving as u32;
        let some: Vec<u32> = places.filter(|place| busy[*place as usize]).collect();
        self.count = some.len();
        self.some.clear();
        self.some.extend(some.chunks(LANES).map(|chunk| {
            let mut places = [nobody; LANES];
            places[..chunk.len()].copy_from_slice(chunk);
            places
        }));
        self.busy = busy;
        (self.divided, self.age) = (true, 0);
    }
}

impl Bed {
    /// Makes lists that hold while grains go so far [m], and for longer if they may.
    pub(super) fn widen_lists(&mut self, way: f64) {
        let (search, wanted) = match self.listing {
            Listing::EveryStep(search) => (search, 0.0),
            Listing::Skin(Some(skin)) => (Search::Grid, skin * self.smallest),
            Listing::Skin(None) => (Search::Grid, self.skin_for(way)),
        };
        // Forces stay with their grains.
        let mut forces = vec![Record::default(); self.grains.len()];
        for (number, force) in self.grains.number.iter().zip(&self.forces) {
            forces[*number as usize] = *force;
        }
        self.list_within(search, wanted.max(2.0 * (1.0 + ROUNDING) * way));
        for (number, force) in self.grains.number.iter().zip(&mut self.forces) {
            *force = forces[*number as usize];
        }
    }

    fn encounters<'a>(&'a self, interaction: &'a Interaction, span: &Span, floor: f64) -> Encounters<'a> {
        Encounters {
            interaction,
            motion: &self.grains.motion,
            flights: &self.driven.flights,
            span: span.time,
            floor,
        }
    }

    /// Divides the lists anew where somebody outside may meet, or when it is time.
    pub(super) fn foresee(&mut self, span: &Span) {
        self.driven.age += 1;
        if !self.driven.divided || self.driven.age >= SPANS || self.somebody_meets_outside(span) {
            self.divide(span);
        }
    }

    /// Whether somebody may meet in a pair that is not sub-stepped.
    pub(super) fn somebody_meets_outside(&mut self, span: &Span) -> bool {
        let active = self.pairs.active;
        let found = self.suspects(span, 0.0, active);
        let blocks = &self.pairs.blocks;
        let nobody = self.pairs.filling[0];
        let encounters = self.encounters(&self.interaction, span, 0.0);
        let among_grains = found.iter().any(|&block| {
            let mut pairs = pairs_in(&blocks[block as usize], nobody);
            pairs.any(|pair| encounters.standing(pair) != Standing::Dormant)
        });
        let list = &self.walls.list;
        let mut at_walls = list.blocks[list.active..]
            .iter()
            .flat_map(|block| pairs_in(block, nobody));
        let meets = |pair: [u32; 2]| encounters.standing_at_wall(&self.walls, pair) != Standing::Dormant;
        let meets = among_grains || at_walls.any(meets);
        self.driven.suspects = found;
        meets
    }

    /// Blocks from `first` on in which somebody may meet, or comes nearer than `floor` [m].
    fn suspects(&mut self, span: &Span, floor: f64, first: usize) -> Vec<u32> {
        let mut found = std::mem::take(&mut self.driven.suspects);
        found.clear();
        in_widest(Suspects {
            encounters: self.encounters(&self.interaction, span, floor),
            change: self.driven.change,
            blocks: &self.pairs.blocks,
            first,
            found: &mut found,
        });
        found
    }

    /// How all pairs stand, in their order.
    fn standing_within(&mut self, span: &Span, floor: f64) -> Vec<Standing> {
        let found = self.suspects(span, floor, 0);
        let encounters = self.encounters(&self.interaction, span, floor);
        let mut suspects = found.iter().peekable();
        let mut standing = Vec::with_capacity(LANES * self.pairs.blocks.len());
        for (place, block) in self.pairs.blocks.iter().enumerate() {
            let suspect = suspects.next_if(|found| **found as usize == place).is_some();
            standing.extend(pairs_in(block, self.pairs.filling[0]).map(|pair| {
                if suspect {
                    encounters.standing(pair)
                } else {
                    Standing::Dormant
                }
            }));
        }
        self.driven.suspects = found;
        standing
    }

    /// Divides the lists into pairs that may meet and others, and finds who is to be sub-stepped.
    pub(super) fn divide(&mut self, span: &Span) {
        let mut standing = self.standing_within(span, FLOOR * self.smallest);
        let encounters = self.encounters(&self.interaction, span, FLOOR * self.smallest);
        let pairs = self.walls.list.pairs();
        let at_walls: Vec<Standing> = pairs
            .map(|(.., pair)| encounters.standing_at_wall(&self.walls, pair))
            .collect();
        let mut busy = std::mem::take(&mut self.driven.busy);
        busy.clear();
        busy.resize(self.grains.motion.len(), false);
        for (list, standing, ends) in [(&self.pairs, &standing, 2), (&self.walls.list, &at_walls, 1)] {
            let near = list.pairs().zip(standing);
            for ((.., pair), _) in near.filter(|(_, standing)| **standing != Standing::Dormant) {
                pair[..ends].iter().for_each(|end| busy[*end as usize] = true);
            }
        }
        // Among those who are sub-stepped anyway more pairs cost little and are seldom overlooked.
        let encounters = self.encounters(&self.interaction, span, CROWD * self.smallest);
        for ((.., pair), standing) in self.pairs.pairs().zip(&mut standing) {
            if *standing == Standing::Dormant && pair.iter().all(|end| busy[*end as usize]) {
                *standing = encounters.standing(pair);
            }
        }
        self.pairs = self.pairs.divided(&standing);
        self.walls.list = self.walls.list.divided(&at_walls);
        self.driven
            .employ(busy, self.grains.moving, self.grains.len() as u32);
    }

    /// Makes the lists whole again.
    pub(in crate::bed) fn join_lists(&mut self) {
        if !self.driven.divided {
            return;
        }
        self.driven.divided = false;
        self.pairs = self.pairs.sorted_anew(&self.grains, self.interaction.period);
        let near = vec![Standing::Apart; self.walls.list.pairs().count()];
        self.walls.list = self.walls.list.divided(&near);
        if let Some(crew) = &mut self.crew {
            crew.learn(&self.pairs, &self.grains);
        }
    }
}
