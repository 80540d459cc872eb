//! What a contact needs to know of the two bodies in it.

use std::f64::consts::PI;

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

/// a b/(a + b), which is a for an infinite b.
pub(super) fn reduced(a: f64, b: f64) -> f64 {
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
