//! Contact laws of grains: normal, tangential and rolling, each a small `Copy` struct.
//!
//! Two bodies that touch are described once by a [`Touch`]; [`ContactLaws`] turns it into a
//! [`Reaction`]. Absent physics is the unit type `()`.

mod any;
mod body;
mod laws;
pub mod normal;
pub mod rolling;
pub mod tangential;
mod touch;

pub use any::{AnyNormal, AnyRolling, AnyTangential};
pub use body::{Body, Couple};
pub use laws::{ContactLaws, Dissipation, Reaction};
pub use normal::{
    Contact, EffectiveMass, HertzLiteral, HertzTsuji, HertzViscoelastic, LinearSpringDashpot, NormalLaw,
};
pub use rolling::{Rolling, RollingLaw, RollingResistance};
pub use tangential::{CundallStrack, HaffWerner, Mindlin, Slip, SlipLimit, TangentialLaw};
pub use touch::{Meeting, Motion, Touch};
