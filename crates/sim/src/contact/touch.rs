//! The geometry of two bodies in contact.
//!
//! ```text
//! δ = R_i + R_j − |r_i − r_j|,   n from j to i
//! slip = v_i − v_j + l_i n×ω_i + l_j n×ω_j, tangential part
//! ```
//!
//! The levers l_i + l_j add up to the distance of the centres, so that action and reaction meet in
//! one point and no angular momentum is lost. Alvim (2016), eqs. 19–24 and 35–36, with radii for levers.

use super::body::{Body, reduced};
use super::normal::Contact;
use crate::math::Vec3;

/// Where a body is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// [m]; for a wall any point of its surface.
    pub position: Vec3,
    /// [m/s]
    pub velocity: Vec3,
    /// [rad/s]
    pub angular_velocity: Vec3,
}

/// Two bodies in contact.
#[derive(Clone, Copy, Debug)]
pub struct Touch {
    /// Unit vector n from the second body to the first.
    pub normal: Vec3,
    /// What the normal law sees.
    pub contact: Contact,
    /// Velocity of the first surface over the second, without its part along n [m/s].
    pub slip: Vec3,
    /// Angular velocity of the first body over the second, without its part along n [rad/s].
    pub rolling: Vec3,
    /// Distances of the two centres from the point of contact [m]; zero for a wall.
    pub levers: [f64; 2],
    /// Radius of the smaller body [m]: the one radius of the pair's rolling resistance.
    pub rolling_radius: f64,
    /// I_i I_j/(I_i + I_j) [kg m²].
    pub reduced_inertia: f64,
}

impl Touch {
    /// Two spheres, in contact or not: the overlap is negative when they are apart.
    pub fn of_spheres(bodies: [&Body; 2], motions: [&Motion; 2]) -> Touch {
        let between = motions[0].position - motions[1].position;
        let distance = between.norm();
        let overlap = bodies[0].radius + bodies[1].radius - distance;
        let levers = bodies.map(|body| body.radius - 0.5 * overlap);
        Touch::new(bodies, motions, between / distance, overlap, levers)
    }

    /// A sphere and a flat wall with unit normal `normal` into the room.
    pub fn of_sphere_and_wall(sphere: &Body, motions: [&Motion; 2], normal: Vec3) -> Touch {
        let height = (motions[0].position - motions[1].position).dot(&normal);
        let overlap = sphere.radius - height;
        Touch::new([sphere, &Body::WALL], motions, normal, overlap, [height, 0.0])
    }

    fn new(bodies: [&Body; 2], motions: [&Motion; 2], normal: Vec3, overlap: f64, levers: [f64; 2]) -> Touch {
        let [first, second] = motions;
        let relative = first.velocity - second.velocity;
        let rate = -relative.dot(&normal);
        let turning =
            normal.cross(&(first.angular_velocity * levers[0] + second.angular_velocity * levers[1]));
        let spin = first.angular_velocity - second.angular_velocity;
        let [a, b] = bodies;
        Touch {
            normal,
            contact: Contact {
                overlap,
                rate,
                reduced_mass: reduced(a.mass, b.mass),
                mean_mass: if b.is_wall() {
                    a.mass
                } else {
                    0.5 * (a.mass + b.mass)
                },
                reduced_radius: reduced(a.radius, b.radius),
            },
            slip: relative + normal * rate + turning,
            rolling: spin - normal * spin.dot(&normal),
            levers,
            rolling_radius: a.radius.min(b.radius),
            reduced_inertia: reduced(a.inertia, b.inertia),
        }
    }
}
