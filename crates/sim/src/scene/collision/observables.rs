//! What a collision can be asked for.

use super::model::{BinaryCollision, Partner};
use super::setup::Impact;
use crate::scene::Observable;
use crate::scene::ObservableKind::{self, Scalar, Series};

type Row = (&'static str, &'static str, ObservableKind, &'static str);

const ALWAYS: &[Row] = &[
    (
        "restitution",
        "1",
        Scalar,
        "speed of separation over speed of approach, along the normal",
    ),
    ("contact_time", "s", Scalar, "time from first touch to separation"),
    (
        "maximum_overlap",
        "1",
        Scalar,
        "greatest overlap over the diameter of the smaller grain",
    ),
    (
        "energy_balance_error",
        "1",
        Scalar,
        "energy lost less energy dissipated by the laws, over the energy at the start",
    ),
    ("time_step", "s", Scalar, "step of the run"),
    ("overlap", "m", Series, "overlap"),
    (
        "normal_force",
        "N",
        Series,
        "force along the normal, repulsive positive",
    ),
    (
        "tangential_force",
        "N",
        Series,
        "friction on the grain along its tangential velocity",
    ),
];

const OBLIQUE: &[Row] = &[(
    "tangential_restitution",
    "1",
    Scalar,
    "slip of the surfaces after over before, reversal positive",
)];

const PAIR: &[Row] = &[
    (
        "momentum_error",
        "1",
        Scalar,
        "greatest change of momentum over reduced mass times speed",
    ),
    (
        "angular_momentum_error",
        "1",
        Scalar,
        "greatest change of angular momentum over reduced mass times speed times radius",
    ),
];

pub fn observables(scene: &BinaryCollision) -> Vec<Observable> {
    let oblique = if Impact::of(scene).slip() != 0.0 {
        OBLIQUE
    } else {
        &[]
    };
    let pair = if scene.partner == Partner::Wall { &[] } else { PAIR };
    let observable = |&(name, unit, kind, meaning): &Row| Observable {
        name,
        unit,
        kind,
        meaning,
    };
    ALWAYS.iter().chain(oblique).chain(pair).map(observable).collect()
}
