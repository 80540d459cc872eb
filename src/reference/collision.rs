//! The collision scene's references: which closed form or integral holds for its laws.

use std::f64::consts::PI;

use super::hertz_collision::{Damping, Hertz, Rebound};
use super::settings::Case;
use super::spring_dashpot_collision::SpringDashpot;
use super::{Entry, Kind, ReferenceError, Solution};

const KIND: &str = "binary_collision";
const SOURCE: &str = "linear contact: Luding (1998); Hertz contact: Brilliantov et al. (1996), Phys. Rev. E 53, 5382, \
    its equation of motion integrated where there is damping";

/// Masses and radii of the pair; the second are infinite for a wall.
struct Pair {
    masses: [f64; 2],
    radii: [f64; 2],
}

impl Pair {
    fn of(case: &Case) -> Result<Pair, ReferenceError> {
        let grain = |path: &str| -> Result<(f64, f64), ReferenceError> {
            let diameter = case.number(&format!("{path}.diameter"))?;
            let density = case.number(&format!("{path}.density"))?;
            Ok((density * PI / 6.0 * diameter.powi(3), 0.5 * diameter))
        };
        let first = grain("grains")?;
        let second = match case.word("partner") {
            Some("wall") => (f64::INFINITY, f64::INFINITY),
            Some("grain") => grain("partner.grain")?,
            _ => first,
        };
        Ok(Pair {
            masses: [first.0, second.0],
            radii: [first.1, second.1],
        })
    }

    fn reduced_mass(&self) -> f64 {
        1.0 / self.masses.map(f64::recip).iter().sum::<f64>()
    }

    /// (m_i + m_j)/2 [kg], the grain's own at a wall.
    fn mean_mass(&self) -> f64 {
        let finite = self.masses.iter().filter(|mass| mass.is_finite());
        finite.clone().sum::<f64>() / finite.count() as f64
    }

    fn reduced_radius(&self) -> f64 {
        1.0 / self.radii.map(f64::recip).iter().sum::<f64>()
    }

    /// Diameter of the smaller grain [m].
    fn diameter(&self) -> f64 {
        2.0 * self.radii[0].min(self.radii[1])
    }
}

fn rebound(name: &str, case: &Case) -> Result<Rebound, ReferenceError> {
    case.only(name, KIND)?;
    let pair = Pair::of(case)?;
    let speed = case.number("speed")?;
    match case.word("normal") {
        Some("linear_spring_dashpot") => linear(case, &pair, speed),
        Some(law) => hertz(case, law, &pair)?
            .rebound(speed)
            .ok_or_else(|| ReferenceError(format!("`{name}`: the bodies do not part"))),
        None => Err(ReferenceError("the settings name no normal law".to_string())),
    }
}

fn linear(case: &Case, pair: &Pair, speed: f64) -> Result<Rebound, ReferenceError> {
    let stiffness = case.number("normal.linear_spring_dashpot.stiffness")?;
    let restitution = case.number("normal.linear_spring_dashpot.restitution")?;
    let damped = match case.word("normal.linear_spring_dashpot.effective_mass") {
        Some("arithmetic") => pair.mean_mass(),
        _ => pair.reduced_mass(),
    };
    let contact = SpringDashpot {
        mass: pair.reduced_mass(),
        stiffness,
        damping: SpringDashpot::damping(damped, stiffness, restitution),
    };
    Ok(Rebound {
        restitution: contact.restitution(),
        contact_time: contact.contact_time(),
        overlap: contact.overlap(speed),
    })
}

fn hertz(case: &Case, law: &str, pair: &Pair) -> Result<Hertz, ReferenceError> {
    let field = |name: &str| case.number(&format!("normal.{law}.{name}"));
    let damping = match law {
        "hertz_viscoelastic" => Damping::Viscoelastic(field("damping_time")?),
        "hertz_tsuji" => {
            let ln_e = field("restitution")?.ln();
            Damping::Tsuji {
                ratio: (5.0f64 / 6.0).sqrt() * ln_e.abs() / ln_e.hypot(PI),
                mass: pair.reduced_mass(),
            }
        }
        "hertz_literal" => Damping::Tsuji {
            ratio: field("damping")?,
            mass: pair.mean_mass(),
        },
        _ => return Err(ReferenceError(format!("no normal law is called `{law}`"))),
    };
    Ok(Hertz {
        mass: pair.reduced_mass(),
        radius: pair.reduced_radius(),
        modulus: field("young_modulus")? / (2.0 * (1.0 - field("poisson_ratio")?.powi(2))),
        damping,
    })
}

pub(super) fn restitution() -> Solution {
    Solution {
        entry: Entry {
            name: "collision_restitution",
            meaning: "restitution of a collision under the scene's normal law",
            source: SOURCE,
        },
        unit: "1",
        kind: Kind::Scalar(|case| Ok(rebound("collision_restitution", case)?.restitution)),
    }
}

pub(super) fn contact_time() -> Solution {
    Solution {
        entry: Entry {
            name: "collision_contact_time",
            meaning: "time from first touch to separation under the scene's normal law",
            source: SOURCE,
        },
        unit: "s",
        kind: Kind::Scalar(|case| Ok(rebound("collision_contact_time", case)?.contact_time)),
    }
}

pub(super) fn overlap() -> Solution {
    Solution {
        entry: Entry {
            name: "collision_overlap",
            meaning: "greatest overlap of a collision over the diameter of the smaller grain",
            source: SOURCE,
        },
        unit: "1",
        kind: Kind::Scalar(|case| {
            let overlap = rebound("collision_overlap", case)?.overlap;
            Ok(overlap / Pair::of(case)?.diameter())
        }),
    }
}

/// The impulse along the normal is m*(1 + e) v; where the surfaces slide all the while, friction takes
/// 7/2 μ (1 + e) v from the slip.
pub(super) fn sliding() -> Solution {
    Solution {
        entry: Entry {
            name: "sliding_restitution",
            meaning: "tangential restitution of spheres that slide throughout an elastic contact",
            source: "impulses of two rigid spheres with Coulomb friction; Walton (1993), Particulate Two-Phase Flow, ch. 25",
        },
        unit: "1",
        kind: Kind::Scalar(tangential_restitution),
    }
}

fn tangential_restitution(case: &Case) -> Result<f64, ReferenceError> {
    case.only("sliding_restitution", KIND)?;
    let law = case.word("tangential").unwrap_or("none");
    let friction = case.number(&format!("tangential.{law}.friction"))?;
    let e = rebound("sliding_restitution", case)?.restitution;
    let spin = case.number("spin")? * 0.5 * case.number("grains.diameter")?;
    let slip = (case.number("tangential_speed")? + spin).abs();
    let taken = 3.5 * friction * (1.0 + e) * case.number("speed")?;
    if taken >= slip {
        let message = "`sliding_restitution` holds while the surfaces slide; here friction stops them";
        return Err(ReferenceError(message.to_string()));
    }
    Ok(taken / slip - 1.0)
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::reference::{Facts, scalar};

    fn settings(normal: Value, partner: Value, tangential: Value) -> Value {
        json!({"binary_collision": {
            "grains": {"diameter": 250e-6, "density": 2460.0}, "partner": partner, "speed": 0.01,
            "tangential_speed": 0.1, "spin": 0.0, "normal": normal, "tangential": tangential}})
    }

    fn value(name: &str, settings: &Value) -> Result<f64, String> {
        let facts = Facts {
            settings,
            scalars: &|_| None,
        };
        scalar(name, &facts)
            .map(|expected| expected.values[0])
            .map_err(|error| error.0)
    }

    #[test]
    fn printed_restitutions_of_every_law_and_partner() {
        let viscoelastic = json!({"hertz_viscoelastic":
            {"young_modulus": 1e6, "poisson_ratio": 0.29, "damping_time": 2e-5}});
        let tsuji = json!({"hertz_tsuji": {"young_modulus": 1e6, "poisson_ratio": 0.29, "restitution": 0.3}});
        let literal = |damping: f64| json!({"hertz_literal": {"young_modulus": 1e6, "poisson_ratio": 0.29, "damping": damping}});
        let linear = |mass: &str| json!({"linear_spring_dashpot": {"stiffness": 10.0, "restitution": 0.3, "effective_mass": mass}});
        for (normal, partner, expected) in [
            (viscoelastic.clone(), "equal", 0.513),
            (viscoelastic, "wall", 0.559),
            (tsuji, "equal", 0.3),
            (literal(2e-5), "equal", 0.9999),
            (literal(0.3), "equal", 0.192),
            (linear("reduced"), "equal", 0.3),
            (linear("arithmetic"), "equal", 0.158),
            (linear("arithmetic"), "wall", 0.3),
        ] {
            let settings = settings(normal, json!(partner), json!("none"));
            let found = value("collision_restitution", &settings).unwrap();
            assert!((found - expected).abs() < 6e-4, "{found} for {settings}");
        }
    }

    #[test]
    fn a_wall_is_the_limit_of_a_huge_grain() {
        let normal =
            json!({"hertz_tsuji": {"young_modulus": 1e6, "poisson_ratio": 0.29, "restitution": 0.3}});
        let huge = json!({"grain": {"diameter": 2.5, "density": 2460.0}});
        for name in ["collision_contact_time", "collision_overlap"] {
            let at = |partner| value(name, &settings(normal.clone(), partner, json!("none"))).unwrap();
            assert!(
                (at(huge.clone()) / at(json!("wall")) - 1.0).abs() < 1e-3,
                "{name}"
            );
        }
    }

    #[test]
    fn sliding_is_refused_where_friction_stops_it() {
        let normal = json!({"linear_spring_dashpot": {"stiffness": 10.0, "restitution": 1.0}});
        let friction = |friction: f64| json!({"haff_werner": {"damping": 10.0, "friction": friction}});
        let at = |law| {
            value(
                "sliding_restitution",
                &settings(normal.clone(), json!("equal"), law),
            )
        };
        assert!((at(friction(0.3)).unwrap() + 0.79).abs() < 1e-12);
        assert!(at(friction(2.0)).unwrap_err().contains("stops"));
        assert!(at(json!("none")).unwrap_err().contains("friction"));
    }
}
