//! The forces between the two bodies of a collision, as an integrator sees them.

use crate::contact::{Body, ContactLaws, Motion, NormalLaw, Reaction, RollingLaw, TangentialLaw, Touch};
use crate::integrator::{Accelerations, Bodies, Forces};
use crate::math::{Vec3, Vector};

/// Unit vector from the second body to the first at first touch, and the normal of a wall.
pub const NORMAL: Vec3 = Vec3::new(1.0, 0.0, 0.0);

/// Two bodies under one set of contact laws.
#[derive(Clone, Debug)]
pub struct Pair<N, T, R> {
    pub bodies: [Body; 2],
    pub laws: ContactLaws<N, T, R>,
    /// Acceleration of the first body from outside [m/s²].
    pub gravity: Vec3,
    /// Steps of the run [s].
    pub time_step: f64,
    /// Whether the laws act beyond the end of the overlap too: a contact that ends within a step is
    /// followed smoothly to the end of that step, and cut where the overlap was zero.
    pub continued: bool,
    history: Vector<f64>,
    trial: Vector<f64>,
    /// Evaluations of the force so far.
    pub evaluations: u64,
}

impl<N: NormalLaw, T: TangentialLaw, R: RollingLaw> Pair<N, T, R> {
    pub fn new(bodies: [Body; 2], laws: ContactLaws<N, T, R>, time_step: f64) -> Self {
        Pair {
            bodies,
            laws,
            gravity: Vec3::zeros(),
            time_step,
            continued: false,
            history: Vector::zeros(),
            trial: Vector::zeros(),
            evaluations: 0,
        }
    }

    pub fn touch(&self, bodies: &Bodies) -> Touch {
        let motion = |body: usize| Motion {
            position: bodies.position[body].into(),
            velocity: bodies.velocity[body].into(),
            angular_velocity: bodies.angular_velocity[body].into(),
        };
        let (first, second) = (motion(0), motion(1));
        if self.bodies[1].is_wall() {
            Touch::of_sphere_and_wall(&self.bodies[0], [&first, &second], NORMAL.into())
        } else {
            Touch::of_spheres([&self.bodies[0], &self.bodies[1]], [&first, &second])
        }
    }

    /// What the contact does at a state that lies `elapsed` [s] after the last accepted one.
    pub fn reaction(&self, touch: &Touch, elapsed: f64) -> (Reaction, Vector<f64>) {
        self.laws.react(touch, self.history, elapsed, self.time_step)
    }
}

impl<N: NormalLaw, T: TangentialLaw, R: RollingLaw> Forces for Pair<N, T, R> {
    fn evaluate(&mut self, bodies: &Bodies, elapsed: f64, accelerations: &mut Accelerations) {
        self.evaluations += 1;
        accelerations.linear.fill(Vec3::zeros());
        accelerations.angular.fill(Vec3::zeros());
        accelerations.linear[0] = self.gravity;
        let touch = self.touch(bodies);
        if touch.contact.overlap < 0.0 && !self.continued {
            self.trial = Vector::zeros();
            return;
        }
        let (reaction, trial) = self.reaction(&touch, elapsed);
        self.trial = trial;
        let force = Vec3::from(reaction.force);
        accelerations.linear[0] += force / self.bodies[0].mass;
        accelerations.linear[1] -= force / self.bodies[1].mass;
        for body in 0..2 {
            accelerations.angular[body] = Vec3::from(reaction.torques[body]) / self.bodies[body].inertia;
        }
    }

    fn accept(&mut self) {
        self.history = self.trial;
    }
}
