//! What of a collision cannot be simulated.

use super::model::{BinaryCollision, Normal, Partner, Rolling, Tangential};
use super::setup::Impact;
use crate::contact::EffectiveMass;
use crate::scene::check::List;

pub fn check(scene: &BinaryCollision, list: &mut List) {
    let mut sound = list.positive("grains.diameter", scene.grains.diameter);
    sound &= list.positive("grains.density", scene.grains.density);
    if let Partner::Grain(grains) = &scene.partner {
        sound &= list.positive("partner.grain.diameter", grains.diameter);
        sound &= list.positive("partner.grain.density", grains.density);
    }
    sound &= list.positive("speed", scene.speed);
    sound &= list.positive("time_step_over_contact_time", scene.time_step_over_contact_time);
    if let Some(step) = scene.time_step {
        sound &= list.positive("time_step", step);
    }
    sound &= list.finite("tangential_speed", scene.tangential_speed);
    sound &= list.finite("spin", scene.spin);
    sound &= check_laws(&scene.normal, &scene.tangential, &scene.rolling, list);
    if sound && ends(scene, list) {
        time_step(scene, list);
    }
}

/// Parameters of contact laws, below `normal`, `tangential` and `rolling`.
pub fn check_laws(normal: &Normal, tangential: &Tangential, rolling: &Rolling, list: &mut List) -> bool {
    let mut sound = normal_law(normal, list);
    sound &= tangential_law(tangential, list);
    if let Rolling::Resistance(law) = rolling {
        sound &= list.not_negative("rolling.resistance.friction", law.friction);
    }
    sound
}

fn restitution(path: &str, value: f64, list: &mut List) -> bool {
    let holds = value > 0.0 && value <= 1.0;
    if !holds {
        list.add(
            path,
            format!("`restitution` is {value}, it must lie between 0 and 1"),
            "1 rebounds at full speed; 0 is excluded, for the bodies would never part",
        );
    }
    holds
}

fn poisson_ratio(path: &str, value: f64, list: &mut List) -> bool {
    let holds = value > -1.0 && value <= 0.5;
    if !holds {
        let message = format!("`poisson_ratio` is {value}, it must lie between -1 and 0.5");
        list.add(path, message, "most solids have 0.2 to 0.4");
    }
    holds
}

fn normal_law(normal: &Normal, list: &mut List) -> bool {
    let material = |law: &str, material: &super::Material, list: &mut List| {
        let young = list.positive(&format!("normal.{law}.young_modulus"), material.young_modulus);
        poisson_ratio(
            &format!("normal.{law}.poisson_ratio"),
            material.poisson_ratio,
            list,
        ) && young
    };
    match normal {
        Normal::LinearSpringDashpot {
            stiffness,
            restitution: e,
            ..
        } => {
            let stiff = list.positive("normal.linear_spring_dashpot.stiffness", *stiffness);
            restitution("normal.linear_spring_dashpot.restitution", *e, list) && stiff
        }
        Normal::HertzViscoelastic {
            material: solid,
            damping_time,
        } => {
            let path = "normal.hertz_viscoelastic.damping_time";
            list.not_negative(path, *damping_time) & material("hertz_viscoelastic", solid, list)
        }
        Normal::HertzTsuji {
            material: solid,
            restitution: e,
        } => restitution("normal.hertz_tsuji.restitution", *e, list) & material("hertz_tsuji", solid, list),
        Normal::HertzLiteral {
            material: solid,
            damping,
        } => {
            let path = "normal.hertz_literal.damping";
            list.not_negative(path, *damping) & material("hertz_literal", solid, list)
        }
    }
}

fn tangential_law(tangential: &Tangential, list: &mut List) -> bool {
    match tangential {
        Tangential::None => true,
        Tangential::HaffWerner(law) => {
            list.not_negative("tangential.haff_werner.damping", law.damping)
                & list.not_negative("tangential.haff_werner.friction", law.friction)
        }
        Tangential::CundallStrack(law) => {
            list.positive("tangential.cundall_strack.stiffness", law.stiffness)
                & list.not_negative("tangential.cundall_strack.damping", law.damping)
                & list.not_negative("tangential.cundall_strack.friction", law.friction)
        }
        Tangential::Mindlin(law) => {
            list.not_negative("tangential.mindlin.friction", law.friction)
                & poisson_ratio("tangential.mindlin.poisson_ratio", law.poisson_ratio, list)
        }
    }
}

/// An overdamped contact never ends.
fn ends(scene: &BinaryCollision, list: &mut List) -> bool {
    let holds = Impact::of(scene).contact_time().is_finite();
    let arithmetic = matches!(
        scene.normal,
        Normal::LinearSpringDashpot {
            effective_mass: EffectiveMass::Arithmetic,
            ..
        }
    );
    if !holds && arithmetic {
        list.add(
            "normal.linear_spring_dashpot.effective_mass",
            "with the arithmetic mass this contact is overdamped and never ends".to_owned(),
            "raise `restitution`, or take the reduced mass",
        );
    }
    holds
}

fn time_step(scene: &BinaryCollision, list: &mut List) {
    let impact = Impact::of(scene);
    let (limit, name) = impact.step_limit();
    let step = impact.time_step();
    // A step exactly at the limit is meant to be safe.
    if scene.unsafe_time_step || step <= limit * (1.0 + 1e-9) {
        return;
    }
    let path = if scene.time_step.is_some() {
        "time_step"
    } else {
        "time_step_over_contact_time"
    };
    let message = format!("the time step is {step:.3e} s, its limit {name} is {limit:.3e} s");
    let share = 100.0 * limit / impact.contact_time();
    let help = format!("stay at {share:.3} % of the contact time or below, or set `unsafe_time_step: true`");
    list.add(path, message, &help);
}
