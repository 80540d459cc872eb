//! How fast the grains of a suspension settle, by the balance of forces.

use super::bed::sphere;
use super::model::{SuspendedClass, Suspension};
use crate::drag::{PolydisperseLaw, polydisperse_coefficient};
use crate::math::bisect;
use crate::scene::setup::with_law;

impl Suspension {
    /// Density of the solids [kg/m³], the mean over their volume.
    pub fn solids_density(&self) -> f64 {
        let (mut mass, mut volume) = (0.0, 0.0);
        for class in &self.classes {
            let own = class.share * class.diameter.powi(3);
            volume += own;
            mass += class.density * own;
        }
        mass / volume
    }

    /// Sauter mean diameter ⟨d⟩ of the solids [m].
    pub fn sauter_mean(&self) -> f64 {
        let sum = |power: i32| -> f64 {
            (self.classes.iter())
                .map(|class| class.share * class.diameter.powi(power))
                .sum()
        };
        sum(3) / sum(2)
    }

    /// Settling speed of a class [m/s], downward positive, amid the whole suspension at a porosity: in a
    /// closed column it is the superficial slip at which drag carries the weight over that of the mixture,
    /// V (ρ_i − ρ_mix) g. Negative for a class that the others push up.
    pub fn settling_speed(&self, class: &SuspendedClass, porosity: f64) -> f64 {
        let medium = self.fluid.medium();
        let mixture = porosity * medium.density + (1.0 - porosity) * self.solids_density();
        let volume = sphere(class).mass / class.density;
        let force = (class.density - mixture) * volume * self.gravity;
        let sizes = [class.diameter, class.diameter / self.sauter_mean()];
        let fluid = [medium.density, medium.viscosity];
        let speed = with_law!(self.drag, law => balance(&law, fluid, sizes, porosity, force.abs()));
        speed.copysign(force)
    }

    /// Greatest settling speed of the classes amid the suspension at the start [m/s].
    pub fn greatest_settling_speed(&self) -> f64 {
        let speeds = self.classes.iter();
        speeds
            .map(|class| self.settling_speed(class, self.porosity).abs())
            .fold(0.0, f64::max)
    }
}

/// Superficial slip speed [m/s] at which the drag equals a force [N].
fn balance(law: &impl PolydisperseLaw, fluid: [f64; 2], sizes: [f64; 2], porosity: f64, force: f64) -> f64 {
    let drag = |slip: f64| slip * polydisperse_coefficient(law, fluid, sizes, slip, porosity) - force;
    let mut high = force / polydisperse_coefficient(law, fluid, sizes, 0.0, porosity);
    if high == 0.0 {
        return 0.0;
    }
    while drag(high) < 0.0 {
        high *= 2.0;
    }
    bisect(0.0, high, drag)
}
