//! Why a bed of grains makes no sense any more.

use crate::bed::{Astray, Bed};

/// Overlap over the smaller diameter at which a run counts as diverged [-].
const DEEPEST: f64 = 0.05;

/// What is wrong with a bed at `time` [s]: motion that is not finite, an overlap `deepest` [-] beyond 5 % of a
/// diameter, or a kinetic energy over `most` [J].
pub fn diverged(bed: &Bed, deepest: f64, most: f64, time: f64) -> Option<String> {
    let kinetic = kinetic_energy(bed);
    if !kinetic.is_finite() || bed.astray_spin().is_some() {
        let grain = bed.astray_spin().unwrap_or(0);
        return Some(format!(
            "the motion is not finite at t = {time:.6e} s: {}",
            whereabouts(bed, grain)
        ));
    }
    if deepest > DEEPEST {
        return Some(format!(
            "an overlap of {:.1} % of the diameter before t = {time:.6e} s: stiffer contacts or a shorter step \
             are needed{}",
            100.0 * deepest,
            deepest_now(bed)
        ));
    }
    (kinetic > most && most > 0.0).then(|| {
        format!(
            "the kinetic energy {kinetic:.3e} J at t = {time:.6e} s is over twice the work of gravity; fastest: {}",
            fastest(bed)
        )
    })
}

/// A grain that moved where no grain can, in words.
pub fn leapt(astray: &Astray, time: f64) -> String {
    let (x, v) = (astray.position, astray.velocity);
    format!(
        "grain {} moves more than its radius in a step before t = {time:.6e} s: at ({:.4e}, {:.4e}, {:.4e}) m with \
         ({:.3e}, {:.3e}, {:.3e}) m/s",
        astray.grain, x.x, x.y, x.z, v.x, v.y, v.z
    )
}

/// Of all moving grains, spin included [J].
pub fn kinetic_energy(bed: &Bed) -> f64 {
    let grains = &bed.grains;
    let energy = |grain: usize| {
        let (speed, spin) = (
            grains.velocity(grain).norm(),
            grains.angular_velocity(grain).norm(),
        );
        0.5 * (grains.mass(grain) * speed * speed + grains.inertia(grain) * spin * spin)
    };
    (0..grains.moving).map(energy).sum()
}

fn deepest_now(bed: &Bed) -> String {
    let touching = bed.deepest_contact().filter(|(_, depth)| *depth > 0.0);
    touching.map_or_else(
        || format!("; fastest now: {}", fastest(bed)),
        |([i, j], depth)| {
            let at = bed.grains.places()[i as usize] as usize;
            let x = bed.grains.position(at);
            format!(
                "; deepest now: grains {i} and {j} at {:.1} %, at ({:.4e}, {:.4e}, {:.4e}) m",
                100.0 * depth,
                x.x,
                x.y,
                x.z
            )
        },
    )
}

fn fastest(bed: &Bed) -> String {
    let speed = |grain: &usize| bed.grains.velocity(*grain).norm();
    let fastest = (0..bed.grains.moving).max_by(|a, b| speed(a).total_cmp(&speed(b)));
    fastest.map_or_else(|| "none".to_owned(), |grain| whereabouts(bed, grain))
}

/// `grain 7 at (…) m with (…) m/s`
fn whereabouts(bed: &Bed, grain: usize) -> String {
    let grains = &bed.grains;
    let (x, v) = (grains.position(grain), grains.velocity(grain));
    format!(
        "grain {} at ({:.4e}, {:.4e}, {:.4e}) m with ({:.3e}, {:.3e}, {:.3e}) m/s",
        grains.number[grain], x.x, x.y, x.z, v.x, v.y, v.z
    )
}
