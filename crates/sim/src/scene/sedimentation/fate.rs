//! Why a run makes no sense any more.

use crate::bed::Bed;

/// Overlap over the smaller diameter at which a run counts as diverged [-].
const DEEPEST: f64 = 0.05;

/// What a run is judged by.
#[derive(Clone, Copy, Debug)]
pub struct Signs {
    /// [s]
    pub time: f64,
    /// Energy of the grains [J].
    pub energy: f64,
    /// The most they can have [J], above zero, and where it comes from.
    pub most: f64,
    pub source: &'static str,
    /// Greatest overlap since the last time over the smaller diameter [-].
    pub deepest: f64,
}

/// Why a run makes no sense any more.
pub fn diverged(bed: &Bed, signs: &Signs) -> Option<String> {
    let Signs {
        time,
        energy,
        most,
        source,
        deepest,
    } = *signs;
    if !energy.is_finite() || bed.astray_spin().is_some() {
        let grain = bed.astray_spin().unwrap_or(0);
        return Some(format!(
            "the motion is not finite at t = {time:.6e} s: {}",
            whereabouts(bed, grain)
        ));
    }
    if deepest > DEEPEST {
        let touching = bed.deepest_contact().filter(|(_, depth)| *depth > 0.0);
        let who = touching.map_or_else(
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
        );
        return Some(format!(
            "an overlap of {:.1} % of the diameter before t = {time:.6e} s: stiffer contacts or a shorter step \
             are needed{who}",
            100.0 * deepest
        ));
    }
    (energy > 2.0 * most && most > 0.0).then(|| {
        format!(
            "the kinetic energy {energy:.3e} J at t = {time:.6e} s is over twice {source}; fastest: {}",
            fastest(bed)
        )
    })
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
