use super::pair::{NORMAL, Pair};
use super::*;
use crate::contact::{
    Body, ContactLaws, CundallStrack, EffectiveMass, HaffWerner, HertzViscoelastic, LinearSpringDashpot,
    Mindlin, NormalLaw, RollingLaw, RollingResistance, SlipLimit, TangentialLaw,
};
use crate::integrator::{Bodies, Integrator, VelocityVerlet};
use crate::math::Vec3;
use crate::outcome::{Control, Outcome};
use crate::scene::{Grains, Scene};

const INTEGRATORS: [IntegratorChoice; 4] = [
    IntegratorChoice::VelocityVerlet,
    IntegratorChoice::Gear5,
    IntegratorChoice::Gear6,
    IntegratorChoice::RungeKutta4,
];

fn linear(restitution: f64, effective_mass: EffectiveMass) -> Normal {
    Normal::LinearSpringDashpot {
        stiffness: 10.0,
        restitution,
        effective_mass,
    }
}

fn viscoelastic(damping_time: f64) -> Normal {
    Normal::HertzViscoelastic {
        material: Material {
            young_modulus: 1e6,
            poisson_ratio: 0.29,
        },
        damping_time,
    }
}

fn head_on(normal: Normal) -> BinaryCollision {
    BinaryCollision {
        grains: Grains {
            diameter: 250e-6,
            density: 2460.0,
        },
        partner: Partner::Equal,
        speed: 0.01,
        tangential_speed: 0.0,
        spin: 0.0,
        normal,
        tangential: Tangential::None,
        rolling: Rolling::None,
        integrator: IntegratorChoice::VelocityVerlet,
        time_step_over_contact_time: 1.0 / 200.0,
        time_step: None,
        unsafe_time_step: false,
    }
}

fn outcome(scene: &BinaryCollision) -> Outcome {
    let scene = Scene::BinaryCollision(scene.clone());
    assert_eq!(crate::scene::check(&scene), []);
    crate::scene::run(&scene, &Control::SILENT).unwrap_or_else(|failure| panic!("{}", failure.reason))
}

fn scalar(outcome: &Outcome, name: &str) -> f64 {
    let found = outcome.scalars.iter().find(|scalar| scalar.name == name);
    found.unwrap_or_else(|| panic!("no {name}")).value
}

#[test]
fn every_observable_is_returned_and_nothing_else() {
    for partner in [Partner::Equal, Partner::Wall] {
        for tangential_speed in [0.0, 0.01] {
            let scene = BinaryCollision {
                partner,
                tangential_speed,
                ..head_on(viscoelastic(2e-5))
            };
            let outcome = outcome(&scene);
            let columns = outcome.tables[0].columns.iter().skip(1).map(|column| column.name);
            let mut found: Vec<&str> = outcome
                .scalars
                .iter()
                .map(|scalar| scalar.name)
                .chain(columns)
                .collect();
            let mut named: Vec<&str> = observables(&scene)
                .iter()
                .map(|observable| observable.name)
                .collect();
            found.sort_unstable();
            named.sort_unstable();
            assert_eq!(found, named);
        }
    }
}

#[test]
fn printed_restitutions_come_back() {
    for (normal, partner, speed, expected) in [
        (viscoelastic(2e-5), Partner::Equal, 1e-3, 0.654),
        (viscoelastic(2e-5), Partner::Equal, 1e-2, 0.513),
        (viscoelastic(2e-5), Partner::Equal, 1e-1, 0.348),
        (viscoelastic(2e-5), Partner::Wall, 1e-3, 0.690),
        (viscoelastic(2e-5), Partner::Wall, 1e-2, 0.559),
        (viscoelastic(2e-5), Partner::Wall, 1e-1, 0.399),
        (linear(0.3, EffectiveMass::Reduced), Partner::Equal, 1e-2, 0.3),
        (
            linear(0.3, EffectiveMass::Arithmetic),
            Partner::Equal,
            1e-2,
            0.158,
        ),
    ] {
        let scene = BinaryCollision {
            partner,
            speed,
            time_step_over_contact_time: 1.0 / 4000.0,
            ..head_on(normal)
        };
        let found = scalar(&outcome(&scene), "restitution");
        assert!((found - expected).abs() < 8e-4, "{found} for {expected}");
    }
}

#[test]
fn elastic_contacts_keep_energy_and_all_keep_momentum() {
    for integrator in INTEGRATORS {
        for normal in [linear(1.0, EffectiveMass::Reduced), viscoelastic(0.0)] {
            let scene = BinaryCollision {
                integrator,
                ..head_on(normal)
            };
            let outcome = outcome(&scene);
            assert!(
                (scalar(&outcome, "restitution") - 1.0).abs() < 2e-5,
                "{integrator:?}"
            );
            assert!(scalar(&outcome, "momentum_error") < 1e-13);
            assert!(scalar(&outcome, "energy_balance_error") < 4e-5);
        }
    }
}

#[test]
fn oblique_contacts_of_unequal_grains_keep_momentum_and_angular_momentum_to_rounding() {
    let frictions = [
        Tangential::HaffWerner(HaffWerner {
            damping: 10.0,
            friction: 0.3,
        }),
        Tangential::CundallStrack(CundallStrack {
            stiffness: 5.0,
            damping: 1e-5,
            friction: 0.3,
        }),
        Tangential::Mindlin(Mindlin {
            friction: 0.3,
            poisson_ratio: 0.29,
            slip_limit: SlipLimit::Correct,
        }),
    ];
    for tangential in frictions {
        let scene = BinaryCollision {
            partner: Partner::Grain(Grains {
                diameter: 500e-6,
                density: 4200.0,
            }),
            tangential_speed: 0.02,
            spin: 30.0,
            tangential,
            rolling: Rolling::Resistance(RollingResistance { friction: 0.01 }),
            ..head_on(viscoelastic(2e-5))
        };
        let outcome = outcome(&scene);
        assert!(scalar(&outcome, "momentum_error") < 1e-12);
        assert!(scalar(&outcome, "angular_momentum_error") < 1e-12);
        let balance = scalar(&outcome, "energy_balance_error");
        // The spring of Haff and Werner's law is as stiff as the step bears: no step resolves it better.
        let most = match tangential {
            Tangential::HaffWerner(_) => 2e-2,
            _ => 5e-3,
        };
        assert!(balance < most, "{tangential:?}: {balance}");
    }
}

#[test]
fn restitution_converges_at_the_order_of_scheme_and_law() {
    let order = |integrator, normal: Normal, quantity: &str, exact: Option<f64>| {
        let value = |integrator, steps: f64| {
            let scene = BinaryCollision {
                integrator,
                time_step_over_contact_time: 1.0 / steps,
                ..head_on(normal)
            };
            scalar(&outcome(&scene), quantity)
        };
        let exact = exact.unwrap_or_else(|| value(IntegratorChoice::RungeKutta4, 2e5));
        let error = |steps| (value(integrator, steps) / exact - 1.0).abs();
        (error(100.0) / error(200.0)).log2()
    };
    // The start of a Hertz contact is as smooth as the force there: t^1.5 elastic, t^0.5 viscoelastic,
    // t^0.25 in Tsuji's form. One more than that is the highest order any scheme can have.
    let tsuji = Normal::HertzTsuji {
        material: Material {
            young_modulus: 1e6,
            poisson_ratio: 0.29,
        },
        restitution: 0.5,
    };
    let damped = linear(0.5, EffectiveMass::Reduced);
    for (normal, quantity, exact, expected) in [
        (damped, "restitution", Some(0.5), [1.0, 4.0, 5.0, 4.0]),
        (viscoelastic(0.0), "maximum_overlap", None, [2.0, 2.5, 2.5, 2.5]),
        (viscoelastic(2e-5), "contact_time", None, [1.0, 1.5, 1.5, 1.5]),
        (tsuji, "contact_time", None, [1.0, 1.25, 1.25, 1.25]),
    ] {
        for (integrator, expected) in INTEGRATORS.into_iter().zip(expected) {
            let found = order(integrator, normal, quantity, exact);
            assert!(
                (found - expected).abs() < 0.15,
                "{integrator:?}, {normal:?}: {found}"
            );
        }
    }
}

/// A sphere that rests on a plane, its weight carried by the contact, pulled by `gravity` along it.
struct Plane<N, T, R> {
    pair: Pair<N, T, R>,
    bodies: Bodies,
}

const BALL: f64 = 1e-3;

impl<N: NormalLaw, T: TangentialLaw, R: RollingLaw> Plane<N, T, R> {
    fn new(laws: ContactLaws<N, T, R>, slope: f64, stiffness: f64) -> Self {
        let body = Body::sphere(BALL, 2500.0);
        let mut pair = Pair::new([body, Body::WALL], laws, 2e-6);
        pair.gravity = Vec3::new(-slope.cos(), slope.sin(), 0.0) * 9.81;
        let sunk = body.mass * 9.81 * slope.cos() / stiffness;
        let bodies = Bodies {
            position: vec![NORMAL * (body.radius - sunk), Vec3::zeros()],
            velocity: vec![Vec3::zeros(); 2],
            angular_velocity: vec![Vec3::zeros(); 2],
        };
        Plane { pair, bodies }
    }

    /// Runs for a time [s]; gives back the speed along the plane and the slip of the surface.
    fn run(&mut self, time: f64) -> (f64, f64) {
        let mut scheme = VelocityVerlet::start(&self.bodies, &mut self.pair);
        let time_step = self.pair.time_step;
        for _ in 0..(time / time_step).round() as u64 {
            scheme.step(&mut self.bodies, &mut self.pair, time_step);
        }
        (self.bodies.velocity[0].y, self.pair.touch(&self.bodies).slip.y)
    }
}

fn springs<T: TangentialLaw>(tangential: T) -> ContactLaws<LinearSpringDashpot, T> {
    ContactLaws {
        normal: LinearSpringDashpot::with_restitution(100.0, 0.5),
        tangential,
        rolling: (),
    }
}

const SPRING: CundallStrack = CundallStrack {
    stiffness: 30.0,
    damping: 1e-3,
    friction: 0.3,
};
const VISCOUS: HaffWerner = HaffWerner {
    damping: 10.0,
    friction: 0.3,
};

#[test]
fn a_sliding_sphere_ends_rolling_at_five_sevenths_of_its_speed() {
    fn last<T: TangentialLaw>(law: T) -> (f64, f64) {
        let mut plane = Plane::new(springs(law), 0.0, 100.0);
        plane.bodies.velocity[0].y = 0.05;
        plane.run(0.02)
    }
    for (speed, slip) in [last(SPRING), last(VISCOUS)] {
        assert!((speed / (0.05 * 5.0 / 7.0) - 1.0).abs() < 2e-3, "{speed}");
        assert!(slip.abs() < 1e-4, "{slip}");
    }
}

#[test]
fn a_sphere_on_an_incline_rolls_below_its_friction_and_slips_above() {
    // A rolling sphere needs tan(slope) < 7/2 μ = 1.05.
    for (tangent, slips) in [(0.9_f64, false), (1.2, true)] {
        let slope = tangent.atan();
        let mut plane = Plane::new(springs(SPRING), slope, 100.0);
        let (speed, slip) = plane.run(0.05);
        let rolling = 5.0 / 7.0 * 9.81 * slope.sin() * 0.05;
        let sliding = 9.81 * (slope.sin() - 0.3 * slope.cos()) * 0.05;
        let expected = if slips { sliding } else { rolling };
        assert!((speed / expected - 1.0).abs() < 5e-3, "{speed} for {expected}");
        assert_eq!(slip.abs() > 1e-3 * speed, slips, "slip {slip}");
    }
}

#[test]
fn rolling_resistance_holds_a_sphere_below_its_coefficient() {
    let laws = |friction| ContactLaws {
        normal: LinearSpringDashpot::with_restitution(100.0, 0.5),
        tangential: SPRING,
        rolling: RollingResistance { friction },
    };
    let speed = |friction| Plane::new(laws(friction), 0.05, 100.0).run(0.02).0;
    let free = 5.0 / 7.0 * 9.81 * 0.05_f64.sin() * 0.02;
    assert!(speed(0.08) < 1e-2 * free, "{} of {free}", speed(0.08));
    assert!(speed(0.02) > 0.3 * free && speed(0.02) < 0.9 * free);
}

#[test]
fn a_common_velocity_changes_nothing() {
    let laws = ContactLaws {
        normal: HertzViscoelastic {
            effective_modulus: 5e5,
            damping_time: 2e-5,
        },
        tangential: SPRING,
        rolling: RollingResistance { friction: 0.01 },
    };
    let after = |common: Vec3| {
        let body = Body::sphere(250e-6, 2460.0);
        let mut pair = Pair::new([body, body], laws, 1e-7);
        let mut bodies = Bodies {
            position: vec![NORMAL * 250e-6, Vec3::zeros()],
            velocity: vec![Vec3::new(-0.01, 0.004, 0.002) + common, common],
            angular_velocity: vec![Vec3::new(3.0, 10.0, -20.0), Vec3::zeros()],
        };
        let mut scheme = VelocityVerlet::start(&bodies, &mut pair);
        for _ in 0..3000 {
            scheme.step(&mut bodies, &mut pair, 1e-7);
        }
        (bodies.velocity[0] - common, bodies.angular_velocity[1])
    };
    let (rest, moving) = (after(Vec3::zeros()), after(Vec3::new(0.3, -0.2, 0.1)));
    assert!(
        (rest.0 - moving.0).norm() < 1e-10,
        "{}",
        (rest.0 - moving.0).norm()
    );
    assert!((rest.1 - moving.1).norm() < 1e-6 * rest.1.norm());
}

#[test]
fn a_bouncing_sphere_keeps_its_energy_for_a_million_steps() {
    let laws = ContactLaws {
        normal: HertzViscoelastic {
            effective_modulus: 1e5,
            damping_time: 0.0,
        },
        tangential: (),
        rolling: (),
    };
    let mut plane = Plane::new(laws, 0.0, 1.0);
    plane.bodies.position[0] = NORMAL * BALL;
    plane.pair.time_step = 1e-6;
    let height = |bodies: &Bodies| bodies.position[0].x + bodies.velocity[0].norm_squared() / (2.0 * 9.81);
    let mut scheme = VelocityVerlet::start(&plane.bodies, &mut plane.pair);
    let (start, mut worst) = (height(&plane.bodies), 0.0_f64);
    for _ in 0..1_000_000 {
        scheme.step(&mut plane.bodies, &mut plane.pair, 1e-6);
        if plane.pair.touch(&plane.bodies).contact.overlap < 0.0 {
            worst = worst.max((height(&plane.bodies) / start - 1.0).abs());
        }
    }
    assert!(worst < 1e-4, "{worst}");
}

#[test]
fn a_contact_that_never_ends_or_a_step_too_long_is_refused() {
    let faults = |scene: BinaryCollision| crate::scene::check(&Scene::BinaryCollision(scene));
    let overdamped = head_on(linear(0.01, EffectiveMass::Arithmetic));
    assert_eq!(
        faults(overdamped)[0].path,
        "normal.linear_spring_dashpot.effective_mass"
    );
    let coarse = BinaryCollision {
        time_step_over_contact_time: 0.2,
        ..head_on(viscoelastic(2e-5))
    };
    assert_eq!(faults(coarse)[0].path, "time_step_over_contact_time");
}

#[test]
fn a_run_that_goes_astray_ends_with_its_reason() {
    let scene = BinaryCollision {
        speed: 1e4,
        ..head_on(viscoelastic(0.0))
    };
    let failure = crate::scene::run(&Scene::BinaryCollision(scene), &Control::SILENT).unwrap_err();
    assert!(failure.reason.contains("pass through"), "{}", failure.reason);
}
