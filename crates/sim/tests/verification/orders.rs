//! Observed orders in time of each integrator with each class of force.
//!
//! Exact drag: exact for linear drag, first order for drag that depends on speed. The fluid step is second
//! order (`waves`); contacts are judged by the study `collision` and beside their integrators.

use kynch_sim::drag::{DiFelice, DragLaw, DragScale, SchillerNaumann, Stokes};
use kynch_sim::integrator::ExactDrag;
use kynch_sim::math::Vec3;

use crate::scenes::{GLASS, GRAVITY, WATER, order, volume};

/// Speed [m/s] of a glass sphere a time after its release, in so many exact-drag steps.
fn fallen_speed(law: impl DragLaw, porosity: f64, time: f64, steps: u32) -> f64 {
    let scale = DragScale {
        diameter: GLASS.diameter,
        density: WATER.density,
        viscosity: WATER.viscosity,
    };
    let weight = (GLASS.density - WATER.density) * volume(&GLASS) * GRAVITY;
    let mut velocity = Vec3::zeros();
    for _ in 0..steps {
        let body = ExactDrag {
            mass: GLASS.density * volume(&GLASS),
            drag: scale.coefficient(&law, velocity.norm(), porosity),
            pull: Vec3::zeros(),
            force: Vec3::new(0.0, 0.0, -weight),
        };
        velocity = body.advance(velocity, time / f64::from(steps)).0;
    }
    -velocity.z
}

/// Relaxation time of the glass sphere: d² ρ_p/(18 μ).
fn relaxation() -> f64 {
    GLASS.density * GLASS.diameter.powi(2) / (18.0 * WATER.viscosity)
}

#[test]
fn exact_drag_is_exact_for_stokes_drag_in_a_step_of_any_length() {
    let time = 3.0 * relaxation();
    let one = fallen_speed(Stokes, 1.0, time, 1);
    let many = fallen_speed(Stokes, 1.0, time, 1000);
    assert!((one / many - 1.0).abs() < 1e-12);
    let closed = (GLASS.density - WATER.density) * GRAVITY * GLASS.diameter.powi(2)
        / (18.0 * WATER.viscosity)
        * (1.0 - (-3.0_f64).exp());
    assert!((one / closed - 1.0).abs() < 1e-13);
}

#[test]
fn exact_drag_is_of_first_order_where_drag_depends_on_speed() {
    fn observed(law: impl DragLaw, porosity: f64) -> [f64; 2] {
        let time = relaxation();
        let speed = |steps| fallen_speed(law, porosity, time, steps);
        let fine = speed(1 << 16);
        let error = |steps| (speed(steps) - fine).abs();
        [16, 32].map(|steps| order(error(steps), error(2 * steps), 2.0))
    }
    let orders = [observed(SchillerNaumann, 1.0), observed(DiFelice, 0.9)];
    for order in orders.into_iter().flatten() {
        assert!((order - 1.0).abs() < 0.1, "{orders:?}");
    }
}
