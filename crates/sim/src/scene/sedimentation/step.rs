//! Contact times of a scene and the time step they allow.

use super::model::{Sedimentation, StillFluid};
use crate::contact::{AnyNormal, Body, Contact, NormalLaw, TangentialLaw};
use crate::math::bisect;
use crate::scene::{IntegratorChoice, Normal};

/// Fewest steps that resolve a contact.
pub const FEWEST_STEPS: f64 = 10.0;
/// ω₀ Δt that a Gear scheme bears in one contact over what it bears in a bed, where a grain has many.
const BED: f64 = 4.0;
/// Longest step over the time in which drag stops a grain in a dense bed.
const DRAG: f64 = 0.5;
/// Porosity of that bed [-].
const DENSE: f64 = 0.4;
/// Speed [m/s] taken where nothing sets grains in motion.
const REST: f64 = 1e-6;

/// What drives grains beside their weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drive {
    /// Greatest speed of the fluid [m/s].
    pub speed: f64,
    /// Force on all grains together [N].
    pub force: f64,
}

/// What the contacts of a scene say about its step.
#[derive(Clone, Debug, PartialEq)]
pub struct Limits {
    /// Speed of the fastest impact expected [m/s].
    pub impact_speed: f64,
    /// Shortest contact time [s]; not finite when no contact ever ends.
    pub contact_time: f64,
    /// Greatest overlap expected, over the smaller diameter [-].
    pub overlap: f64,
    /// Longest safe step [s] and what sets it.
    pub longest: f64,
    pub name: String,
    /// The step that is picked [s], two digits, rounded down.
    pub automatic: f64,
    /// The step of the run [s]: the given one, or else the picked one.
    pub time_step: f64,
}

/// The step of a scene, from the pair of grains that is fastest to part.
///
/// Impacts are taken at the terminal speed of the fastest grain (or at the speed of free fall through
/// the box, where that is less), or at the speed that loads a contact as the whole bed loads its lowest
/// layer, where that is more; attraction adds its work.
pub fn limits(scene: &Sedimentation) -> Limits {
    limits_under(scene, &Drive::default())
}

/// The same where more than their weight drives the grains.
pub fn limits_under(scene: &Sedimentation, drive: &Drive) -> Limits {
    let grains = scene.extremes();
    let fastest = grains
        .iter()
        .map(|(grain, density)| drive.speed + scene.greatest_speed(grain, *density))
        .fold(REST, f64::max);
    let mut longest = Longest::default();
    let (mut impact_speed, mut contact_time, mut overlap) = (fastest, f64::INFINITY, 0.0_f64);
    for (place, (one, density)) in grains.iter().enumerate() {
        let partners = grains[place..].iter().map(|(other, _)| other);
        for other in partners.chain([&Body::WALL]) {
            let pair = Pair::of(scene, one, other, fastest, scene.load() + drive.force);
            impact_speed = impact_speed.max(pair.contact.rate);
            contact_time = contact_time.min(pair.contact_time());
            overlap = overlap.max(pair.contact.overlap / (2.0 * one.radius.min(other.radius)));
            pair.bound(&mut longest);
        }
        drag(scene, one, *density, &mut longest);
    }
    let wanted = contact_time / scene.steps_per_contact;
    let picked = if scene.unsafe_time_step {
        wanted
    } else {
        wanted.min(longest.step)
    };
    let automatic = rounded_down(picked);
    Limits {
        impact_speed,
        contact_time,
        overlap,
        longest: longest.step,
        name: longest.name,
        automatic,
        time_step: scene.time_step.unwrap_or(automatic),
    }
}

/// The shortest of several limits, with its name.
struct Longest {
    step: f64,
    name: String,
}

impl Default for Longest {
    fn default() -> Self {
        Longest {
            step: f64::INFINITY,
            name: String::new(),
        }
    }
}

impl Longest {
    fn bound(&mut self, step: f64, name: impl Into<String>) {
        if step < self.step {
            *self = Longest {
                step,
                name: name.into(),
            };
        }
    }
}

/// Two bodies as they meet fastest.
struct Pair<'a> {
    scene: &'a Sedimentation,
    normal: AnyNormal,
    /// At first touch but for its overlap, which is the greatest of the impact.
    contact: Contact,
}

impl<'a> Pair<'a> {
    /// At a speed [m/s], under a load on the whole floor [N].
    fn of(scene: &'a Sedimentation, one: &Body, other: &Body, fastest: f64, load: f64) -> Self {
        let reduced = |a: f64, b: f64| 1.0 / (1.0 / a + 1.0 / b);
        let normal = scene.normal.law();
        let mut pair = Pair {
            scene,
            normal,
            contact: Contact {
                overlap: 0.0,
                rate: 0.0,
                reduced_mass: reduced(one.mass, other.mass),
                mean_mass: if other.is_wall() {
                    one.mass
                } else {
                    0.5 * (one.mass + other.mass)
                },
                reduced_radius: reduced(one.radius, other.radius),
            },
        };
        let energy = pair.pressed(one, other, load).max(pair.kinetic(fastest)) + pair.attraction();
        pair.contact.rate = (2.0 * energy / pair.contact.reduced_mass).sqrt();
        pair.contact.overlap = pair.deepest(|overlap| pair.elastic(overlap) - energy);
        pair
    }

    fn kinetic(&self, speed: f64) -> f64 {
        0.5 * self.contact.reduced_mass * speed * speed
    }

    /// Elastic energy [J] of an overlap [m].
    fn elastic(&self, overlap: f64) -> f64 {
        let share = match self.scene.normal {
            Normal::LinearSpringDashpot { .. } => 0.5,
            // ∫δ^1.5 over δ · δ^1.5.
            Normal::HertzViscoelastic { .. } | Normal::HertzTsuji { .. } | Normal::HertzLiteral { .. } => 0.4,
        };
        share * overlap * self.force(overlap, 0.0)
    }

    fn force(&self, overlap: f64, rate: f64) -> f64 {
        self.normal.force(&Contact {
            overlap,
            rate,
            ..self.contact
        })
    }

    /// Root of a function that rises with the overlap [m], no more than a few radii.
    fn deepest(&self, rising: impl Fn(f64) -> f64) -> f64 {
        bisect(0.0, 4.0 * self.contact.reduced_radius, rising)
    }

    /// Elastic energy [J] of a contact at the bottom of the settled bed.
    fn pressed(&self, one: &Body, other: &Body, load: f64) -> f64 {
        let larger = 2.0
            * if other.is_wall() {
                one.radius
            } else {
                one.radius.max(other.radius)
            };
        let floor = self.scene.container.width * self.scene.depth();
        let load = load * (larger * larger / floor).min(1.0);
        self.elastic(self.deepest(|overlap| self.force(overlap, 0.0) - load))
    }

    /// Work [J] of the attraction from afar to contact, H R*/(6 h) at the smallest gap h.
    fn attraction(&self) -> f64 {
        self.scene.cohesion.map_or(0.0, |cohesion| {
            cohesion.hamaker * self.contact.reduced_radius / (6.0 * cohesion.smallest_gap)
        })
    }

    fn contact_time(&self) -> f64 {
        let touch = Contact {
            overlap: 0.0,
            ..self.contact
        };
        self.normal.contact_time(&touch)
    }

    fn bound(&self, longest: &mut Longest) {
        longest.bound(self.contact_time() / FEWEST_STEPS, format!("t_c/{FEWEST_STEPS}"));
        let tangential = self
            .scene
            .tangential
            .step_limit(2.0 / 7.0 * self.contact.reduced_mass);
        longest.bound(tangential, "of the tangential spring and dashpot");
        let stable = match self.scene.integrator {
            IntegratorChoice::VelocityVerlet | IntegratorChoice::RungeKutta4 => return,
            IntegratorChoice::Gear5 => [0.42, 0.165],
            IntegratorChoice::Gear6 => [0.25, 0.09],
        };
        let (frequency, damping) = self.oscillation();
        let bound = gear(stable, damping) / BED;
        longest.bound(
            bound / frequency,
            format!("{bound:.3}/ω₀ of the Gear scheme in a bed"),
        );
    }

    /// Angular frequency ω₀ [1/s] and damping ratio [-] of the contact at its greatest overlap.
    fn oscillation(&self) -> (f64, f64) {
        let Contact {
            overlap,
            reduced_mass,
            ..
        } = self.contact;
        let step = 1e-3 * overlap;
        let stiffness = (self.force(overlap + step, 0.0) - self.force(overlap - step, 0.0)) / (2.0 * step);
        let dashpot = self.force(overlap, 1.0) - self.force(overlap, 0.0);
        (
            (stiffness / reduced_mass).sqrt(),
            dashpot / (2.0 * (stiffness * reduced_mass).sqrt()),
        )
    }
}

/// Largest stable ω₀ Δt of one contact: measured at damping ratios of 0.3 and 0.9, on a line between,
/// and falling with the damping beyond.
fn gear([weak, strong]: [f64; 2], damping: f64) -> f64 {
    let between = ((damping - 0.3) / 0.6).clamp(0.0, 1.0);
    (weak + (strong - weak) * between) * (0.9 / damping).min(1.0)
}

/// Drag must not turn a grain's motion about within a step, not even in a dense bed. Velocity Verlet
/// integrates it exactly and knows no such limit.
fn drag(scene: &Sedimentation, grain: &Body, density: f64, longest: &mut Longest) {
    if scene.integrator == IntegratorChoice::VelocityVerlet {
        return;
    }
    let speed = scene.greatest_speed(grain, density);
    let slower = scene.drag_coefficient(grain, 0.0, DENSE);
    let faster = scene.drag_coefficient(grain, DENSE * speed, DENSE);
    let over = match scene.fluid {
        StillFluid::Still(_) => 1.0,
        StillFluid::Column(_) => DENSE,
    };
    let coefficient = slower.max(faster) / over;
    if coefficient > 0.0 {
        longest.bound(DRAG * grain.mass / coefficient, "of the drag in a dense bed");
    }
}

/// Two significant digits, no more than the number itself.
fn rounded_down(step: f64) -> f64 {
    if !(step > 0.0 && step.is_finite()) {
        return step;
    }
    let unit = 10f64.powi(step.log10().floor() as i32 - 1);
    // Digits that are whole up to rounding stay.
    let digits = (step / unit * (1.0 + 1e-12)).floor();
    format!("{digits}e{}", unit.log10().round())
        .parse()
        .unwrap_or(step)
}

/// Whether the contact of some pair is overdamped and never ends.
pub fn overdamped(scene: &Sedimentation) -> bool {
    let grains = scene.extremes();
    grains.iter().enumerate().any(|(place, (one, _))| {
        let partners = grains[place..].iter().map(|(other, _)| other);
        partners.chain([&Body::WALL]).any(|other| {
            !Pair::of(scene, one, other, REST, scene.load())
                .contact_time()
                .is_finite()
        })
    })
}
