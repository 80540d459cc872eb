//! What a contact needs to know of the two bodies in it.

use std::f64::consts::PI;

use crate::math::Number;

/// A homogeneous sphere, or a flat wall that never moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Radius R [m]; infinite for a wall.
    pub radius: f64,
    /// Mass m [kg]; infinite for a wall.
    pub mass: f64,
    /// Moment of inertia I = 2/5 m R² [kg m²]; infinite for a wall.
    pub inertia: f64,
}

impl Body {
    /// A flat wall, fixed in place.
    pub const WALL: Body = Body {
        radius: f64::INFINITY,
        mass: f64::INFINITY,
        inertia: f64::INFINITY,
    };

    /// A sphere of diameter [m] and density [kg/m³].
    pub fn sphere(diameter: f64, density: f64) -> Body {
        let mass = density * PI / 6.0 * diameter.powi(3);
        Body {
            radius: 0.5 * diameter,
            mass,
            inertia: 0.4 * mass * (0.5 * diameter).powi(2),
        }
    }

    pub fn is_wall(&self) -> bool {
        self.mass.is_infinite()
    }
}

/// What a contact law needs of the masses and sizes of two bodies together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Couple<N = f64> {
    /// m* = m_i m_j/(m_i + m_j) [kg]; the grain's own mass at a wall.
    pub reduced_mass: N,
    /// (m_i + m_j)/2 [kg]; the grain's own mass at a wall.
    pub mean_mass: N,
    /// R* = R_i R_j/(R_i + R_j) [m]; the grain's own radius at a wall.
    pub reduced_radius: N,
    /// I* = I_i I_j/(I_i + I_j) [kg m²]; the grain's own inertia at a wall.
    pub reduced_inertia: N,
    /// Radius of the smaller body [m]: the one radius of the pair's rolling resistance.
    pub smaller_radius: N,
}

impl Couple {
    pub fn new(a: &Body, b: &Body) -> Couple {
        Couple {
            reduced_mass: reduced(a.mass, b.mass),
            mean_mass: if b.is_wall() {
                a.mass
            } else {
                0.5 * (a.mass + b.mass)
            },
            reduced_radius: reduced(a.radius, b.radius),
            reduced_inertia: reduced(a.inertia, b.inertia),
            smaller_radius: a.radius.min(b.radius),
        }
    }

    /// The same in every lane.
    pub fn splat<N: Number>(&self) -> Couple<N> {
        Couple {
            reduced_mass: N::splat(self.reduced_mass),
            mean_mass: N::splat(self.mean_mass),
            reduced_radius: N::splat(self.reduced_radius),
            reduced_inertia: N::splat(self.reduced_inertia),
            smaller_radius: N::splat(self.smaller_radius),
        }
    }
}

/// a b/(a + b), which is a for an infinite b.
fn reduced(a: f64, b: f64) -> f64 {
    1.0 / (1.0 / a + 1.0 / b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wall_leaves_the_value_of_the_grain() {
        let grain = Body::sphere(1e-3, 2500.0);
        assert_eq!(reduced(grain.mass, Body::WALL.mass), grain.mass);
        assert!(Body::WALL.is_wall() && !grain.is_wall());
    }
}
