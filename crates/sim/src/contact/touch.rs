//! The geometry of two bodies in contact.
//!
//! ```text
//! δ = R_i + R_j − |r_i − r_j|,   n from j to i
//! slip = v_i − v_j + l_i n×ω_i + l_j n×ω_j, tangential part
//! ```
//!
//! The levers l_i + l_j add up to the distance of the centres, so that action and reaction meet in
//! one point and no angular momentum is lost. Alvim (2016), eqs. 19–24 and 35–36, with radii for levers.

use super::body::{Body, Couple};
use super::normal::Contact;
use crate::math::{Number, Vector};

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<N = f64> {
    /// [m]; for a wall any point of its surface.
    pub position: Vector<N>,
    /// [m/s]
    pub velocity: Vector<N>,
    /// [rad/s]
    pub angular_velocity: Vector<N>,
}

/// Two bodies in contact.
#[derive(Clone, Copy, Debug)]
pub struct Touch<N = f64> {
    /// Unit vector n from the second body to the first.
    pub normal: Vector<N>,
    /// What the normal law sees.
    pub contact: Contact<N>,
    /// Velocity of the first surface over the second, without its part along n [m/s].
    pub slip: Vector<N>,
    /// Angular velocity of the first body over the second, without its part along n [rad/s].
    pub rolling: Vector<N>,
    /// Distances of the two centres from the point of contact [m]; zero for a wall.
    pub levers: [N; 2],
    /// Radius of the smaller body [m].
    pub rolling_radius: N,
    /// I_i I_j/(I_i + I_j) [kg m²].
    pub reduced_inertia: N,
}

/// Where two bodies meet.
#[derive(Clone, Copy, Debug)]
pub struct Meeting<N = f64> {
    /// Unit vector n from the second body to the first.
    pub normal: Vector<N>,
    /// Overlap δ [m], negative when they are apart.
    pub overlap: N,
    /// Distances of the two centres from the point of contact [m]; zero for a wall.
    pub levers: [N; 2],
}

impl<N: Number> Meeting<N> {
    /// Two spheres of these radii [m], `between` [m] from the second centre to the first.
    #[inline(always)]
    pub fn of_spheres(radii: [N; 2], between: Vector<N>) -> Self {
        let distance = between.norm();
        let overlap = radii[0] + radii[1] - distance;
        let half = N::splat(0.5) * overlap;
        Meeting {
            normal: between * (N::splat(1.0) / distance),
            overlap,
            levers: [radii[0] - half, radii[1] - half],
        }
    }

    /// A sphere of radius [m] with its centre at `height` [m] above a flat wall, whose unit normal
    /// points into the room.
    #[inline(always)]
    pub fn of_sphere_and_wall(radius: N, height: N, normal: Vector<N>) -> Self {
        Meeting {
            normal,
            overlap: radius - height,
            levers: [height, N::splat(0.0)],
        }
    }
}

impl Touch {
    /// Two spheres, in contact or not.
    pub fn of_spheres(bodies: [&Body; 2], motions: [&Motion; 2]) -> Touch {
        let between = motions[0].position - motions[1].position;
        let meeting = Meeting::of_spheres(bodies.map(|body| body.radius), between);
        Touch::new(&Couple::new(bodies[0], bodies[1]), &meeting, motions)
    }

    /// A sphere and a flat wall with unit normal `normal` into the room.
    pub fn of_sphere_and_wall(sphere: &Body, motions: [&Motion; 2], normal: Vector<f64>) -> Touch {
        let height = (motions[0].position - motions[1].position).dot(&normal);
        let meeting = Meeting::of_sphere_and_wall(sphere.radius, height, normal);
        Touch::new(&Couple::new(sphere, &Body::WALL), &meeting, motions)
    }
}

impl<N: Number> Touch<N> {
    #[inline(always)]
    pub fn new(couple: &Couple<N>, meeting: &Meeting<N>, motions: [&Motion<N>; 2]) -> Self {
        let [first, second] = motions;
        let Meeting {
            normal,
            overlap,
            levers,
        } = *meeting;
        let relative = first.velocity - second.velocity;
        let rate = N::splat(0.0) - relative.dot(&normal);
        let turning =
            normal.cross(&(first.angular_velocity * levers[0] + second.angular_velocity * levers[1]));
        let spin = first.angular_velocity - second.angular_velocity;
        Touch {
            normal,
            contact: Contact {
                overlap,
                rate,
                reduced_mass: couple.reduced_mass,
                mean_mass: couple.mean_mass,
                reduced_radius: couple.reduced_radius,
            },
            slip: relative + normal * rate + turning,
            rolling: spin - normal * spin.dot(&normal),
            levers,
            rolling_radius: couple.smaller_radius,
            reduced_inertia: couple.reduced_inertia,
        }
    }
}
