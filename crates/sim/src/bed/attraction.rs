//! What acts between grains that do not touch.

use crate::cohesion::{Attraction as _, Coulomb, VanDerWaals};
use crate::contact::Meeting;
use crate::math::Number;

/// Attraction of grains among each other and to walls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attraction {
    pub van_der_waals: Option<VanDerWaals>,
    /// Whether walls attract as well.
    pub walls: bool,
    pub charge: Option<Charge>,
}

/// One charge on every grain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Charge {
    pub law: Coulomb,
    /// [C]
    pub charge: f64,
    /// Gap beyond which it is left out [m].
    pub cut_off_gap: f64,
}

impl Attraction {
    /// Largest gap at which anything acts [m].
    #[inline(always)]
    pub fn reach(&self) -> f64 {
        let near = match &self.van_der_waals {
            Some(law) => law.cut_off_gap(),
            None => 0.0,
        };
        match &self.charge {
            Some(charge) => near.max(charge.cut_off_gap),
            None => near,
        }
    }

    /// Attraction of two grains [N].
    #[inline(always)]
    pub fn between_grains<N: Number>(&self, meeting: &Meeting<N>, contact_distance: N, radii: [N; 2]) -> N {
        let zero = N::splat(0.0);
        let gap = zero - meeting.overlap;
        let mut pull = match &self.van_der_waals {
            Some(law) => law.force(gap, radii[0], radii[1]),
            None => zero,
        };
        if let Some(charge) = &self.charge {
            let own = N::splat(charge.charge);
            let force = charge.law.force(contact_distance + gap, own, own);
            pull = pull + N::select(gap.below(N::splat(charge.cut_off_gap)), force, zero);
        }
        pull
    }

    /// Attraction of a grain to a wall [N]; walls carry no charge.
    #[inline(always)]
    pub fn to_wall<N: Number>(&self, meeting: &Meeting<N>, radius: N) -> N {
        let zero = N::splat(0.0);
        match &self.van_der_waals {
            Some(law) if self.walls => law.wall_force(zero - meeting.overlap, radius),
            _ => zero,
        }
    }
}
