//! The state of all grains.

use crate::contact::Body;
use crate::math::{Vec3, along_curve};
use crate::neighbours::{Period, Record};

/// Grains in the order they are stored, near ones near each other; moving ones first, fixed ones last.
#[derive(Clone, Debug, Default)]
pub struct Grains {
    /// x, y, z [m], R [m], v_x, v_y, v_z [m/s], 1/m [1/kg]
    pub motion: Vec<Record>,
    /// ω_x, ω_y, ω_z [rad/s], 1/I [1/(kg m²)], porosity it sees [-], fluid velocity it sees along z
    /// [m/s], force on it of its neighbours' drag [N], 1 where it is awake and 0 where it sleeps
    pub spin: Vec<Record>,
    /// The number each grain was given at the start.
    pub number: Vec<u32>,
    /// The class each grain belongs to.
    pub class: Vec<u16>,
    /// How many of them move.
    pub moving: usize,
}

/// Where a grain starts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    pub body: Body,
    pub class: u16,
    /// [m]
    pub position: Vec3,
    /// [m/s]
    pub velocity: Vec3,
    /// [rad/s]
    pub angular_velocity: Vec3,
}

impl Grains {
    /// Grains numbered as they come, `moving` first; a body of infinite mass but finite radius is fixed.
    pub fn new(moving: &[Grain], fixed: &[Grain]) -> Grains {
        let mut grains = Grains {
            moving: moving.len(),
            ..Grains::default()
        };
        for (number, (grain, free)) in moving
            .iter()
            .map(|grain| (grain, 1.0))
            .chain(fixed.iter().map(|grain| (grain, 0.0)))
            .enumerate()
        {
            let (x, v, w) = (grain.position, grain.velocity, grain.angular_velocity);
            let body = &grain.body;
            grains.motion.push(Record([
                x.x,
                x.y,
                x.z,
                body.radius,
                v.x,
                v.y,
                v.z,
                free / body.mass,
            ]));
            grains
                .spin
                .push(Record([w.x, w.y, w.z, free / body.inertia, 1.0, 0.0, 0.0, 1.0]));
            grains.number.push(number as u32);
            grains.class.push(grain.class);
        }
        // Empty lanes of a list point at two more, which never touch anything nor each other.
        for x in [0.0, 1.0] {
            grains.motion.push(Record([x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]));
            grains.spin.push(Record([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]));
        }
        grains
    }

    pub fn len(&self) -> usize {
        self.number.len()
    }

    pub fn is_empty(&self) -> bool {
        self.number.is_empty()
    }

    /// Positions and radii of all grains, nobody else's.
    pub fn spheres(&self) -> &[Record] {
        &self.motion[..self.len()]
    }

    pub fn position(&self, grain: usize) -> Vec3 {
        let record = &self.motion[grain].0;
        Vec3::new(record[0], record[1], record[2])
    }

    pub fn velocity(&self, grain: usize) -> Vec3 {
        let record = &self.motion[grain].0;
        Vec3::new(record[4], record[5], record[6])
    }

    pub fn angular_velocity(&self, grain: usize) -> Vec3 {
        let record = &self.spin[grain].0;
        Vec3::new(record[0], record[1], record[2])
    }

    pub fn radius(&self, grain: usize) -> f64 {
        self.motion[grain].0[3]
    }

    /// Mass [kg]; infinite for a fixed grain.
    pub fn mass(&self, grain: usize) -> f64 {
        1.0 / self.motion[grain].0[7]
    }

    /// Moment of inertia [kg m²]; infinite for a fixed grain.
    pub fn inertia(&self, grain: usize) -> f64 {
        1.0 / self.spin[grain].0[3]
    }

    /// Porosity [-] that the grain at a place sees, and velocity of the fluid along z [m/s].
    pub fn seen(&self, grain: usize) -> [f64; 2] {
        let [.., porosity, flow, _, _] = self.spin[grain].0;
        [porosity, flow]
    }

    /// Where each number is stored.
    pub fn places(&self) -> Vec<u32> {
        let mut places = vec![0; self.len()];
        for (place, &number) in self.number.iter().enumerate() {
            places[number as usize] = place as u32;
        }
        places
    }

    /// Brings positions back into [0, side) of the periodic directions.
    pub(super) fn wrap(&mut self, period: Period) {
        let (grains, empty) = self.motion.split_at_mut(self.number.len());
        for (axis, &side) in period.iter().enumerate().filter(|(_, side)| **side > 0.0) {
            // What empty lanes point at stays as far apart as it can: sides that divide a metre would
            // bring them together.
            (empty[0].0[axis], empty[1].0[axis]) = (0.0, 0.5 * side);
            for record in grains.iter_mut() {
                let position = &mut record.0[axis];
                *position -= side * (*position / side).floor();
                // Rounding may leave a tiny negative number at the full side.
                if *position >= side {
                    *position = 0.0;
                }
            }
        }
    }

    /// Stores the moving grains along a curve that keeps neighbours together: shared cache lines are
    /// worth a third of the time of a large bed. The order follows from the positions alone.
    pub(super) fn sort(&mut self) {
        let (mut smallest, mut largest) = (f64::INFINITY, 0.0_f64);
        for record in &self.motion[..self.moving] {
            (smallest, largest) = (smallest.min(record.0[3]), largest.max(record.0[3]));
        }
        // No sum over the grains: its rounding would depend on the order they come in.
        let width = smallest + largest;
        let places: Vec<[f64; 3]> = self.motion[..self.moving]
            .iter()
            .map(|record| [record.0[0], record.0[1], record.0[2]])
            .collect();
        let order = along_curve(&places, width);
        if order.iter().zip(0..).all(|(grain, place)| *grain == place) {
            return;
        }
        let moving = self.moving;
        let arranged = |from: &mut Vec<Record>| {
            let new: Vec<Record> = order.iter().map(|&grain| from[grain as usize]).collect();
            from[..moving].copy_from_slice(&new);
        };
        arranged(&mut self.motion);
        arranged(&mut self.spin);
        let number: Vec<u32> = order.iter().map(|&grain| self.number[grain as usize]).collect();
        self.number[..moving].copy_from_slice(&number);
        let class: Vec<u16> = order.iter().map(|&grain| self.class[grain as usize]).collect();
        self.class[..moving].copy_from_slice(&class);
    }
}
