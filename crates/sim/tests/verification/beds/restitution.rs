//! Head-on impacts in a bed against the equation of motion of the pair, in tiny steps.

use kynch_sim::contact::{AnyNormal, Body, Contact, Couple, NormalLaw};
use kynch_sim::math::Vec3;

use super::{Setup, elastic_normals, grain, normals, smooth, states};

const SPEED: f64 = 0.05;
const DIAMETERS: [f64; 2] = [250e-6, 180e-6];
const DENSITY: f64 = 2500.0;

fn start() -> Contact {
    let [a, b] = DIAMETERS.map(|diameter| Body::sphere(diameter, DENSITY));
    let couple = Couple::new(&a, &b);
    Contact {
        overlap: 0.0,
        rate: SPEED,
        reduced_mass: couple.reduced_mass,
        mean_mass: couple.mean_mass,
        reduced_radius: couple.reduced_radius,
    }
}

/// Restitution by fourth-order Runge–Kutta, 20,000 steps a contact, up to the end of the overlap.
fn exact(law: AnyNormal) -> f64 {
    let start = start();
    let dt = law.contact_time(&start) / 20_000.0;
    let slope = |[overlap, rate]: [f64; 2]| {
        let contact = Contact {
            overlap,
            rate,
            ..start
        };
        [rate, -law.force(&contact) / start.reduced_mass]
    };
    let along = |y: [f64; 2], k: [f64; 2], h: f64| [y[0] + h * k[0], y[1] + h * k[1]];
    let mut y = [0.0, SPEED];
    loop {
        let a = slope(y);
        let b = slope(along(y, a, 0.5 * dt));
        let c = slope(along(y, b, 0.5 * dt));
        let d = slope(along(y, c, dt));
        let mean = [0, 1].map(|i| (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]) / 6.0);
        let next = along(y, mean, dt);
        if next[0] <= 0.0 {
            let share = y[0] / (y[0] - next[0]);
            return -(y[1] + share * (next[1] - y[1])) / SPEED;
        }
        y = next;
    }
}

/// Restitution in a bed that meets `phase` of a step after its start.
fn found(law: AnyNormal, steps_per_contact: f64, phase: f64) -> f64 {
    let contact_time = law.contact_time(&start());
    let dt = contact_time / steps_per_contact;
    let apart = 0.5 * (DIAMETERS[0] + DIAMETERS[1]) + SPEED * dt * phase;
    let mut grains = vec![
        grain(DIAMETERS[0], DENSITY, Vec3::zeros()),
        grain(DIAMETERS[1], DENSITY, Vec3::x() * apart),
    ];
    grains[1].velocity = Vec3::x() * -SPEED;
    let bed = Setup::new(grains, smooth(law), dt).after((3.0 * steps_per_contact) as u64);
    let states = states(&bed);
    (states[1][1] - states[0][1]).x / SPEED
}

/// Root mean square error over when in a step the grains meet.
fn error(law: AnyNormal, steps_per_contact: f64) -> f64 {
    let exact = exact(law);
    let squares = (0..16).map(|phase| {
        let phase = (f64::from(phase) + 0.5) / 16.0;
        (found(law, steps_per_contact, phase) - exact).powi(2)
    });
    (squares.sum::<f64>() / 16.0).sqrt()
}

#[test]
fn damped_impacts_converge_at_first_order_to_the_equation_of_motion() {
    for law in normals() {
        let errors = [50.0, 200.0, 800.0].map(|steps| error(law, steps));
        let orders = [0, 1].map(|i| (errors[i] / errors[i + 1]).ln() / 4f64.ln());
        assert!(errors[0] < 0.02, "{errors:?} {law:?}");
        assert!(
            orders.iter().all(|order| *order > 0.85 && *order < 1.5),
            "{orders:?} {law:?}"
        );
    }
}

#[test]
fn elastic_impacts_converge_at_second_order_to_full_restitution() {
    for law in elastic_normals() {
        let errors = [50.0, 200.0, 800.0].map(|steps| error(law, steps));
        let order = (errors[0] / errors[2]).ln() / 16f64.ln();
        assert!((exact(law) - 1.0).abs() < 1e-9);
        assert!(order > 1.8, "{order} {law:?}");
    }
}
