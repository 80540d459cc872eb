use super::*;

/// A damped oscillator along x and a damped spin about y: both have closed forms.
struct Oscillator {
    /// ζ [-], at ω₀ = 1 rad/s.
    damping_ratio: f64,
    evaluations: usize,
}

impl Forces for Oscillator {
    fn evaluate(&mut self, bodies: &Bodies, _: f64, accelerations: &mut Accelerations) {
        self.evaluations += 1;
        let (x, v) = (bodies.position[0], bodies.velocity[0]);
        accelerations.linear[0] = -x - v * (2.0 * self.damping_ratio);
        accelerations.angular[0] = -bodies.angular_velocity[0];
    }

    fn accept(&mut self) {}
}

fn start() -> Bodies {
    Bodies {
        position: vec![Vec3::zeros()],
        velocity: vec![Vec3::new(1.0, 0.0, 0.0)],
        angular_velocity: vec![Vec3::new(0.0, 1.0, 0.0)],
    }
}

/// State after half a period in `steps` steps, and the evaluations it took.
fn half_period<I: Integrator>(damping_ratio: f64, steps: usize) -> (Bodies, usize) {
    let mut forces = Oscillator {
        damping_ratio,
        evaluations: 0,
    };
    let mut bodies = start();
    let time = std::f64::consts::PI / (1.0 - damping_ratio * damping_ratio).sqrt();
    let mut scheme = I::start(&bodies, &mut forces);
    for _ in 0..steps {
        scheme.step(&mut bodies, &mut forces, time / steps as f64);
    }
    (bodies, forces.evaluations)
}

/// Observed orders of velocity and spin between 200 and 400 steps.
fn orders<I: Integrator>(damping_ratio: f64) -> (f64, f64) {
    let time = std::f64::consts::PI / (1.0 - damping_ratio * damping_ratio).sqrt();
    let errors = |steps| {
        let bodies = half_period::<I>(damping_ratio, steps).0;
        let speed = bodies.velocity[0].x + (-damping_ratio * time).exp();
        (speed.abs(), (bodies.angular_velocity[0].y - (-time).exp()).abs())
    };
    let (coarse, fine) = (errors(200), errors(400));
    ((coarse.0 / fine.0).log2(), (coarse.1 / fine.1).log2())
}

#[test]
fn verlet_is_of_second_order_until_a_force_depends_on_velocity() {
    let near = |order: f64, expected: f64| assert!((order - expected).abs() < 0.1, "{order}");
    near(orders::<VelocityVerlet>(0.3).0, 1.0);
    near(orders::<VelocityVerlet>(0.3).1, 1.0);
    // The undamped velocity is exact to higher order after half a period; its position shows the order.
    let position = |steps| half_period::<VelocityVerlet>(0.0, steps).0.position[0].x.abs();
    near((position(200) / position(400)).log2(), 2.0);
}

#[test]
fn the_higher_schemes_keep_their_order_under_damping() {
    let (linear, angular) = orders::<RungeKutta4>(0.3);
    assert!(
        (linear - 4.0).abs() < 0.15 && (angular - 4.0).abs() < 0.15,
        "{linear} {angular}"
    );
    let (linear, angular) = orders::<Gear<5>>(0.3);
    assert!(
        (linear - 4.0).abs() < 0.15 && (angular - 4.0).abs() < 0.15,
        "{linear} {angular}"
    );
    let (linear, angular) = orders::<Gear<6>>(0.3);
    assert!(
        (linear - 5.0).abs() < 0.15 && (angular - 5.0).abs() < 0.15,
        "{linear} {angular}"
    );
}

#[test]
fn one_evaluation_per_step_but_four_for_runge_kutta() {
    assert_eq!(half_period::<VelocityVerlet>(0.3, 100).1, 101);
    assert_eq!(half_period::<RungeKutta4>(0.3, 100).1, 401);
    assert_eq!(half_period::<Gear<5>>(0.3, 100).1, 1 + 2 * 4 + 98);
}

#[test]
fn gear_schemes_grow_beyond_their_limits_and_not_below() {
    // First unstable ω₀ Δt at ζ = 0.3: 0.42 with 5 values, 0.25 with 6.
    fn grown<I: Integrator>(time_step: f64) -> bool {
        let mut forces = Oscillator {
            damping_ratio: 0.3,
            evaluations: 0,
        };
        let mut bodies = start();
        let mut scheme = I::start(&bodies, &mut forces);
        for _ in 0..20_000 {
            scheme.step(&mut bodies, &mut forces, time_step);
        }
        let size = bodies.position[0].norm();
        size.is_nan() || size >= 1.0
    }
    assert!(!grown::<Gear<5>>(0.41) && grown::<Gear<5>>(0.43));
    assert!(!grown::<Gear<6>>(0.24) && grown::<Gear<6>>(0.26));
}
