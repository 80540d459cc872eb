//! A collision in words and numbers.

use super::model::{BinaryCollision, IntegratorChoice, Normal, Partner, Rolling, Tangential};
use super::setup::Impact;
use crate::contact::{EffectiveMass, SlipLimit};
use crate::scene::Description;

/// Cost of a step of one pair over that of a fluid particle.
const STEP_COST: f64 = 0.2;

pub fn describe(scene: &BinaryCollision) -> Description {
    let impact = Impact::of(scene);
    let (dt, contact_time) = (impact.time_step(), impact.contact_time());
    let (limit, _) = impact.step_limit();
    let steps = (contact_time / dt).ceil() as u64;
    let mut description = Description {
        grains: if scene.partner == Partner::Wall { 1 } else { 2 },
        steps,
        work: steps as f64 * STEP_COST,
        memory: 1 << 20,
        ..Description::default()
    };
    description.numbers.extend([
        ("reduced mass".to_owned(), impact.contact.reduced_mass, "kg"),
        ("reduced radius".to_owned(), impact.contact.reduced_radius, "m"),
        ("contact time of the normal law".to_owned(), contact_time, "s"),
        ("time step".to_owned(), dt, "s"),
        ("longest safe time step".to_owned(), limit, "s"),
        (
            "slip of the surfaces at first touch".to_owned(),
            impact.slip(),
            "m/s",
        ),
    ]);
    describe_laws(&scene.normal, &scene.tangential, &scene.rolling, &mut description);
    description.active.push(integrator(scene.integrator));
    description
        .left_out
        .push("gravity, fluid and long-range forces: a collision happens in empty space".to_owned());
    if dt > limit {
        description.warnings.push(format!(
            "the time step {dt:.3e} s is beyond its limit {limit:.3e} s"
        ));
    }
    description
}

/// The contact laws, those that are left out among them.
pub fn describe_laws(
    normal_law: &Normal,
    tangential_law: &Tangential,
    rolling: &Rolling,
    description: &mut Description,
) {
    description.active.push(normal(normal_law));
    match tangential(tangential_law) {
        Some(words) => description.active.push(words),
        None => description
            .left_out
            .push("friction: no tangential law is named".to_owned()),
    }
    match rolling {
        Rolling::Resistance(law) => description.active.push(format!(
            "rolling resistance with coefficient {}, one radius per pair",
            law.friction
        )),
        Rolling::None => description
            .left_out
            .push("rolling resistance: no rolling law is named".to_owned()),
    }
}

fn normal(normal: &Normal) -> String {
    match normal {
        Normal::LinearSpringDashpot { effective_mass, .. } => {
            let mass = match effective_mass {
                EffectiveMass::Reduced => "reduced",
                EffectiveMass::Arithmetic => "arithmetic mean",
            };
            format!("linear spring and dashpot, damped by the {mass} mass, not clipped at zero")
        }
        Normal::HertzViscoelastic { .. } => {
            "Hertz contact of viscoelastic spheres, damping time γ_n, not clipped at zero".to_owned()
        }
        Normal::HertzTsuji { .. } => "Hertz contact with one restitution at every speed".to_owned(),
        Normal::HertzLiteral { .. } => {
            "Hertz contact with the damping of a published misprint: practically undamped".to_owned()
        }
    }
}

fn tangential(tangential: &Tangential) -> Option<String> {
    let words = match tangential {
        Tangential::None => return None,
        Tangential::HaffWerner(_) => {
            "viscous friction capped by Coulomb's, integrated implicitly so that it holds"
        }
        Tangential::CundallStrack(_) => "tangential spring and dashpot capped by Coulomb's friction",
        Tangential::Mindlin(law) => match law.slip_limit {
            SlipLimit::Correct => "Mindlin friction in its full-slip form",
            SlipLimit::Literal => {
                "Mindlin friction with the full slip of a published misprint: half the stiffness"
            }
        },
    };
    Some(words.to_owned())
}

/// An integrator in words.
pub fn integrator(choice: IntegratorChoice) -> String {
    match choice {
        IntegratorChoice::VelocityVerlet => "velocity Verlet: first order under damping, second without",
        IntegratorChoice::Gear5 => "Gear predictor–corrector of 5 values, 19/90",
        IntegratorChoice::Gear6 => "Gear predictor–corrector of 6 values, 3/16",
        IntegratorChoice::RungeKutta4 => "classical Runge–Kutta of fourth order",
    }
    .to_owned()
}
