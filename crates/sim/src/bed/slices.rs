//! The fluid as grains see it: porosity of their slices, and the flow back through them.

use crate::contact::Body;
use crate::coupling::slices::{Measure, Slices};
use crate::drag::{self, DragLaw};
use crate::math::Vec3;

use super::grains::Grains;
use super::motion::Surroundings;

/// Way a grain may go before porosities are summed anew, in slices.
const WAY: f64 = 0.01;
/// Time after which the return flow is summed anew, over the time in which drag stops a grain alone.
const TIME: f64 = 0.02;
/// The same over the time in which it does so in the densest slice. There the fluid flows back faster than the
/// grains come: a flow kept for longer than they need to follow it would throw them to and fro.
const DENSE_TIME: f64 = 0.25;

/// Horizontal slices over all moving grains.
#[derive(Clone, Debug)]
pub struct Porosity {
    slices: Slices,
    height: f64,
    /// Whether the vessel is closed: the fluid flows back through the grains.
    closed: bool,
    /// Whether grains of several densities share the drag on the mixture.
    mixed: bool,
    /// Volume flux q [m/s] that leaves through the floor.
    drawn: f64,
    /// Time in which drag stops the lightest grain alone [s].
    relaxation: f64,
    /// Time for which a return flow may be kept [s].
    patience: f64,
    way: f64,
    time: f64,
    sums: Vec<f64>,
    pub refreshes: u64,
}

impl Porosity {
    /// Slices of a height [m] over a cross-section [m²] (a width [m], by areas), from zero up.
    pub fn new(height: f64, area: f64, measure: Measure, closed: bool, mixed: bool, relaxation: f64) -> Self {
        Porosity {
            slices: Slices::new(0.0, height, area, measure),
            height,
            closed,
            mixed,
            drawn: 0.0,
            relaxation,
            patience: 0.0,
            way: f64::INFINITY,
            time: f64::INFINITY,
            sums: Vec::new(),
            refreshes: 0,
        }
    }

    /// The same from a height [m] up.
    pub fn from_height(mut self, bottom: f64) -> Self {
        self.slices.begin(bottom);
        self
    }

    /// Draws a volume flux q [m/s] through the floor from now on: in a closed vessel that of fluid and
    /// grains together, u_f = (−q − (1 − ε)⟨v⟩)/ε, else the fluid's velocity itself.
    pub fn draw(&mut self, flux: f64) {
        self.drawn = flux;
    }

    /// Slices held at the least porosity, counted at every refresh.
    pub fn clips(&self) -> u64 {
        self.slices.clips()
    }

    /// Lets the fastest grain go its way [m] in a time [s]; says what the grains see where that has
    /// changed by much.
    pub fn follow(&mut self, grains: &mut Grains, surroundings: &Surroundings, way: f64, time: f64) {
        self.way += way;
        self.time += time;
        let flows = (self.closed || self.mixed) && self.time > self.patience;
        if self.way > WAY * self.height || flows {
            self.refresh(grains, surroundings);
        }
    }

    /// Time for which a return flow may be kept [s].
    fn patience(&self, surroundings: &Surroundings) -> f64 {
        let densest = self.slices.porosity().iter().copied().fold(1.0, f64::min);
        let hindrance = surroundings
            .drag
            .map_or(1.0, |law| law.factor(0.0, densest).max(1.0));
        self.relaxation * TIME.min(DENSE_TIME / hindrance)
    }

    /// Says what the grains see now.
    pub fn refresh(&mut self, grains: &mut Grains, surroundings: &Surroundings) {
        (self.way, self.time) = (0.0, 0.0);
        self.refreshes += 1;
        let moving = grains.moving;
        let records = &grains.motion[..moving];
        self.slices
            .place(records.iter().map(|record| (record.0[2], record.0[3])));
        self.patience = self.patience(surroundings);
        let slices = &self.slices;
        for (grain, spin) in grains.spin[..moving].iter_mut().enumerate() {
            spin.0[4] = slices.sample(grain, slices.porosity());
        }
        if self.closed {
            let speeds = records.iter().map(|record| record.0[6]);
            self.slices.return_flow(speeds, &mut self.sums);
            for (flow, porosity) in self.sums.iter_mut().zip(self.slices.porosity()) {
                *flow -= self.drawn / porosity;
            }
            for (grain, spin) in grains.spin[..moving].iter_mut().enumerate() {
                spin.0[5] = self.slices.sample(grain, &self.sums);
            }
        }
        if !self.closed {
            grains.spin[..moving]
                .iter_mut()
                .for_each(|spin| spin.0[5] = 0.0 - self.drawn);
        }
        if self.mixed {
            self.share_drag(grains, surroundings);
        }
    }

    /// Model B for grains of several densities: f_i + (V_i/ε) Σ n_j f_j in place of f_i/ε, which counts
    /// on all grains being dragged alike. Source: Anderson & Jackson (1967), Ind. Eng. Chem. Fundam. 6,
    /// 527–539, for the forms of the pressure gradient.
    fn share_drag(&mut self, grains: &mut Grains, surroundings: &Surroundings) {
        let Some(law) = &surroundings.drag else { return };
        let fluid = [surroundings.fluid_density, surroundings.viscosity];
        let moving = grains.moving;
        let drags: Vec<f64> = (0..moving)
            .map(|grain| {
                let [.., porosity, flow, _, _] = grains.spin[grain].0;
                let z = grains.position(grain).z;
                let slip = Vec3::from(surroundings.flow(z, flow)) - grains.velocity(grain);
                let superficial = porosity * slip.norm();
                let diameter = 2.0 * grains.radius(grain);
                porosity * slip.z * drag::coefficient(law, fluid, diameter, superficial, porosity)
            })
            .collect();
        let volume = |grain: usize| Body::sphere(2.0 * grains.radius(grain), 1.0).mass;
        self.slices.deposit(
            (0..moving).map(|grain| drags[grain] / volume(grain)),
            &mut self.sums,
        );
        let corrections: Vec<f64> = (0..moving)
            .map(|grain| {
                let porosity = grains.spin[grain].0[4];
                let mean = self.slices.sample(grain, &self.sums);
                (volume(grain) * mean - (1.0 - porosity) * drags[grain]) / porosity
            })
            .collect();
        for (spin, correction) in grains.spin[..moving].iter_mut().zip(corrections) {
            spin.0[6] = correction;
        }
    }
}
