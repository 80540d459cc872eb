//! Settling of several kinds of grains in a closed column, and the zones they leave above each other.
//!
//! ```text
//! ε u_f = Σ_k φ_k w_k               no net volume flux through any height
//! w_i = (s_i − Σ_k φ_k s_k)/ε       s_i: superficial slip of the mixture
//! φ_k (w_k − W) = φ'_k (w'_k − W)   across the front that falls at W
//! ```
//!
//! w: speed in the laboratory, positive downwards; u_f: of the fluid, upwards. In the mixed zone all kinds
//! are there; its top is the front of the fastest kind, above which the others are alone, closer together
//! than below. The front of each kind falls at its speed in the zone which it tops.
//!
//! Even in every zone, no diffusion, nothing on the floor yet. Source: force balance with the weight of the
//! mixture and conservation of volume; Lockett & Bassoon (1979), Powder Technology 24, 1–7; Raso (2014),
//! eqs. 1.45–1.53, with the slip of Richardson and Zaki in place of the balance.

use super::mixture::Mixture;
use super::settings::Case;
use super::{Entry, Kind, ReferenceError, Solution};

/// Where a front's continuity is met [-].
const TOLERANCE: f64 = 1e-13;

/// A height range in which the same kinds settle together.
#[derive(Clone, Debug)]
pub struct Zone {
    /// Volume fraction of every kind [-]; zero for those that are below.
    pub fractions: Vec<f64>,
    /// w_i [m/s]; zero for those that are below.
    pub velocities: Vec<f64>,
    /// The kinds whose front tops the zone.
    pub fastest: Vec<usize>,
    /// W, at which the zone's top falls [m/s].
    pub front: f64,
}

/// w_i of a mixture [m/s].
pub fn velocities(mixture: &Mixture) -> Vec<f64> {
    let slips = mixture.slips();
    let shared: f64 = mixture
        .fractions
        .iter()
        .zip(&slips)
        .map(|(fraction, slip)| fraction * slip)
        .sum();
    slips
        .iter()
        .map(|slip| (slip - shared) / mixture.porosity())
        .collect()
}

/// The zones from the floor up.
///
/// # Errors
/// A zone in which the continuity of the front below has no solution.
pub fn zones(mixture: &Mixture) -> Result<Vec<Zone>, ReferenceError> {
    let mut zones: Vec<Zone> = Vec::new();
    let mut there: Vec<usize> = (0..mixture.grains.len()).collect();
    let mut fractions = mixture.fractions.clone();
    while !there.is_empty() {
        let zone = zone(mixture, &there, fractions);
        there.retain(|kind| !zone.fastest.contains(kind));
        fractions = above(mixture, &zone, &there)?;
        zones.push(zone);
    }
    Ok(zones)
}

fn zone(mixture: &Mixture, there: &[usize], fractions: Vec<f64>) -> Zone {
    let velocities = among(mixture, there, &fractions);
    let front = there
        .iter()
        .map(|kind| velocities[*kind])
        .fold(f64::NEG_INFINITY, f64::max);
    let equal = |kind: &&usize| (velocities[**kind] - front).abs() <= 1e-9 * front.abs();
    Zone {
        fastest: there.iter().filter(equal).copied().collect(),
        front,
        fractions,
        velocities,
    }
}

/// w_i of the kinds that are there, zero for the others.
fn among(mixture: &Mixture, there: &[usize], fractions: &[f64]) -> Vec<f64> {
    let part = Mixture {
        law: mixture.law,
        grains: there.iter().map(|kind| mixture.grains[*kind]).collect(),
        fractions: there.iter().map(|kind| fractions[*kind]).collect(),
    };
    let mut all = vec![0.0; mixture.grains.len()];
    for (kind, velocity) in there.iter().zip(velocities(&part)) {
        all[*kind] = velocity;
    }
    all
}

/// Fractions above a zone of the kinds that are left.
fn above(mixture: &Mixture, below: &Zone, left: &[usize]) -> Result<Vec<f64>, ReferenceError> {
    let mut fractions = vec![0.0; mixture.grains.len()];
    for kind in left {
        fractions[*kind] = below.fractions[*kind];
    }
    let (mut weight, mut last_change) = (0.7, f64::INFINITY);
    for _ in 0..1000 {
        let speeds = among(mixture, left, &fractions);
        let mut change: f64 = 0.0;
        for kind in left.iter().copied() {
            let passed = below.fractions[kind] * (below.front - below.velocities[kind]);
            let gap = below.front - speeds[kind];
            // A kind that would overtake the front is too thin yet.
            let ratio = if gap > 0.0 {
                passed / (gap * fractions[kind])
            } else {
                2.0
            };
            change = change.max((ratio - 1.0).abs());
            fractions[kind] *= 1.0 + weight * (ratio.clamp(0.5, 2.0) - 1.0);
        }
        if change < TOLERANCE {
            return Ok(fractions);
        }
        if fractions.iter().sum::<f64>() >= 1.0 {
            break;
        }
        if change > last_change {
            weight = (0.5 * weight).max(0.02);
        }
        last_change = change;
    }
    match left.is_empty() {
        true => Ok(fractions),
        false => Err(ReferenceError(
            "no even zone lies above the front of the fastest grains: the others would overtake it"
                .to_string(),
        )),
    }
}

/// Speed at which the front of a kind falls [m/s].
fn front(zones: &[Zone], kind: usize) -> f64 {
    let own = zones.iter().find(|zone| zone.fastest.contains(&kind));
    own.map_or(0.0, |zone| zone.front)
}

/// Names, meanings and what they give of the kind counted from zero.
type Line = (&'static str, fn(&Case) -> Result<f64, ReferenceError>);

pub(super) fn solutions() -> Vec<Solution> {
    let fronts: [Line; 4] = [
        ("zero_net_flux_front_1", |case| front_of(case, 0)),
        ("zero_net_flux_front_2", |case| front_of(case, 1)),
        ("zero_net_flux_front_3", |case| front_of(case, 2)),
        ("zero_net_flux_front_4", |case| front_of(case, 3)),
    ];
    let mixed: [Line; 4] = [
        ("zero_net_flux_speed_1", |case| speed_of(case, 0)),
        ("zero_net_flux_speed_2", |case| speed_of(case, 1)),
        ("zero_net_flux_speed_3", |case| speed_of(case, 2)),
        ("zero_net_flux_speed_4", |case| speed_of(case, 3)),
    ];
    let slips: [Line; 4] = [
        ("zero_net_flux_slip_1", |case| slip_of(case, 0)),
        ("zero_net_flux_slip_2", |case| slip_of(case, 1)),
        ("zero_net_flux_slip_3", |case| slip_of(case, 2)),
        ("zero_net_flux_slip_4", |case| slip_of(case, 3)),
    ];
    let meant = [
        (
            fronts,
            "speed at which the upper front of a class of grains falls",
        ),
        (
            mixed,
            "settling speed of a class of grains where all of them are mixed as at the start",
        ),
        (
            slips,
            "superficial slip of a class of grains where all of them are mixed as at the start",
        ),
    ];
    let lines = meant
        .into_iter()
        .flat_map(|(lines, meaning)| lines.map(|line| (line, meaning)));
    lines
        .map(|((name, solve), meaning)| Solution {
            entry: Entry {
                name,
                meaning,
                source: "force balance in the mixture without net volume flux, continuity across fronts",
            },
            unit: "m/s",
            kind: Kind::Scalar(solve),
        })
        .collect()
}

fn front_of(case: &Case, kind: usize) -> Result<f64, ReferenceError> {
    Ok(front(&zones(&mixture(case, kind)?)?, kind))
}

fn speed_of(case: &Case, kind: usize) -> Result<f64, ReferenceError> {
    Ok(velocities(&mixture(case, kind)?)[kind])
}

fn slip_of(case: &Case, kind: usize) -> Result<f64, ReferenceError> {
    Ok(mixture(case, kind)?.slips()[kind])
}

/// The suspension of a case that has the kind.
fn mixture(case: &Case, kind: usize) -> Result<Mixture, ReferenceError> {
    case.only("zero_net_flux", "suspension")?;
    let classes = case.classes()?;
    if kind >= classes.len() {
        let count = classes.len();
        return Err(ReferenceError(format!(
            "the scene has no class {} of grains: it has {count}",
            kind + 1
        )));
    }
    Ok(Mixture::by_number(
        case.law()?,
        &classes,
        case.number("porosity")?,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::drag_law::DragLaw;
    use crate::reference::force_balance::ForceBalance;
    use crate::reference::grain::Grain;
    use crate::reference::grain::tests::GLASS;

    fn of_density(density: f64) -> Grain {
        Grain { density, ..GLASS }
    }

    fn two_densities() -> Mixture {
        let classes = [(of_density(2450.0), 0.5), (of_density(1500.0), 0.5)];
        Mixture::by_number(DragLaw::DiFelice, &classes, 0.9)
    }

    #[test]
    fn grains_of_two_densities_fall_at_5_11_and_1_38_and_the_light_front_at_2_10_millimetres_per_second() {
        let zones = zones(&two_densities()).unwrap();
        assert!((1e3 * zones[0].velocities[0] - 5.10696).abs() < 1e-5);
        assert!((1e3 * zones[0].velocities[1] - 1.38398).abs() < 1e-5);
        assert!((1e3 * front(&zones, 0) - 5.10696).abs() < 1e-5);
        assert!(
            (1e3 * front(&zones, 1) - 2.10).abs() < 5e-3,
            "{}",
            front(&zones, 1)
        );
        assert!(
            (zones[1].fractions[1] - 0.0618).abs() < 5e-5,
            "{}",
            zones[1].fractions[1]
        );
    }

    #[test]
    fn light_grains_alone_fall_as_their_force_balance() {
        let alone = Mixture::by_number(DragLaw::DiFelice, &[(of_density(1500.0), 1.0)], 0.95);
        assert!((1e3 * velocities(&alone)[0] - 2.21561).abs() < 1e-5);
    }

    #[test]
    fn what_passes_each_front_comes_out_above_it_and_no_volume_flows_in_net() {
        let sizes = [1.5e-4, 1.2e-4, 1e-4, 0.8e-4].map(|diameter| (Grain { diameter, ..GLASS }, 0.25));
        let mixture = Mixture::by_number(DragLaw::BeetstraCello, &sizes, 0.9);
        let zones = zones(&mixture).unwrap();
        assert_eq!(zones.len(), 4);
        for (index, pair) in zones.windows(2).enumerate() {
            assert_eq!(pair[0].fastest, [index]);
            assert!(pair[1].front < pair[0].front);
            for kind in index + 1..4 {
                let passes = |zone: &Zone| zone.fractions[kind] * (pair[0].front - zone.velocities[kind]);
                assert!((passes(&pair[0]) / passes(&pair[1]) - 1.0).abs() < 1e-10);
            }
        }
        // The last kind is alone: its speed is its force balance.
        let last = ForceBalance {
            grain: sizes[3].0,
            law: DragLaw::BeetstraCello,
            porosity: 1.0 - zones[3].fractions[3],
        };
        assert!((last.settling_velocity() / zones[3].front - 1.0).abs() < 1e-10);
    }

    #[test]
    fn equal_grains_have_one_front() {
        let classes = [(GLASS, 0.5), (GLASS, 0.5)];
        let zones = zones(&Mixture::by_number(DragLaw::DiFelice, &classes, 0.9)).unwrap();
        assert_eq!((zones.len(), zones[0].fastest.len()), (1, 2));
        assert!((1e3 * front(&zones, 1) - 4.91237).abs() < 1e-5);
    }
}
