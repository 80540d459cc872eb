//! The particles of the fluid and their step: kick, drift, sweep, kick.
//!
//! The column is periodic in x and y, closed by a floor of three fixed layers below z = 0 whose
//! pressure is extrapolated from the fluid (Adami et al. 2012, J. Comput. Phys. 231, 7057), and open
//! at the top. Masses never change; the intrinsic density ϱ follows continuity.

use super::EquationOfState;
use super::kernel::{Kernel, Lucy, WendlandC2};
use super::sweep::{Coefficients, Rates, Record, Sweep};
use crate::math::Vec3;
use crate::neighbours::{Image, Rows, images, in_widest};

/// Numerical choices of a fluid.
#[derive(Clone, Copy, Debug)]
pub struct Numerics {
    /// Particle spacing [m].
    pub spacing: f64,
    /// Viscosity μ of the Morris form [Pa s]; zero when the artificial form carries it.
    pub viscosity: f64,
    /// α of the artificial viscosity [-]; zero compiles the term out.
    pub artificial: f64,
    /// χ of the bulk viscosity χ ρ₀ c h that damps compression [-].
    ///
    /// It acts on the rate of compression, so it vanishes in a steady state. Diffusion of the density
    /// does not: it lets fluid leak down the pressure that carries a bed, and speeds a block up by
    /// 5 to 11 per cent at a spacing of six diameters.
    pub bulk: f64,
    /// Kernel on the support 2h.
    pub lucy: bool,
    /// Weight of the fluid per mass [m/s²]: g when the equation of state carries the whole
    /// pressure, zero when the hydrostatic part is split off.
    pub gravity: f64,
    pub continuity: Continuity,
    pub state: EquationOfState,
}

/// Which balance moves the density.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Continuity {
    /// ε Dϱ/Dt = −ϱ ∇·j with the mixture flux j = ε u + (1 − ε) v_s, fluid and solid balance added up.
    /// j is free of divergence where ε is steep, so no kernel can smear it. It also is what the mean
    /// viscous stress depends on, since rigid grains do not deform: ∇·τ = μ∇²j (Batchelor 1970,
    /// J. Fluid Mech. 41, 545).
    MixtureFlux,
    /// D(εϱ)/Dt = −εϱ ∇·u and ∇·τ = μ∇²u, as published for averaged equations on particles.
    Superficial,
}

impl Numerics {
    /// Smoothing length h = 1.5 spacings [m].
    pub fn smoothing(&self) -> f64 {
        1.5 * self.spacing
    }
}

/// Share of the support added to the rows, so that they outlive many steps.
const SKIN: f64 = 0.04;

/// Layers of wall particles: the support of a particle on the floor.
const WALL_LAYERS: usize = 3;

pub struct FluidParticles {
    pub numerics: Numerics,
    /// Side of the periodic cross-section [m].
    pub width: f64,
    pub position: Vec<Vec3>,
    /// Interstitial velocity u [m/s].
    pub velocity: Vec<Vec3>,
    pub mass: Vec<f64>,
    /// Intrinsic density ϱ [kg/m³]; the superficial one is ε ϱ.
    pub density: Vec<f64>,
    pub density_rate: Vec<f64>,
    /// Porosity ε [-].
    pub porosity: Vec<f64>,
    /// Volume flux of the grains (1 − ε) v_s at each particle [m/s].
    pub solid_flux: Vec<Vec3>,
    /// Pressure (excess pressure where the hydrostatic part is split off) [Pa].
    pub pressure: Vec<f64>,
    /// Force density σ = −∇p + ∇·τ [N/m³].
    pub stress: Vec<Vec3>,
    /// Acceleration by σ and gravity [m/s²].
    pub acceleration: Vec<Vec3>,
    /// Acceleration by the grains [m/s²].
    pub reaction: Vec<Vec3>,
    wall: Vec<Vec3>,
    wall_pressure: Vec<f64>,
    images: Vec<Image>,
    rows: Rows,
    wall_rows: Rows,
    /// Positions when the rows were made.
    anchor: Vec<Vec3>,
    records: Vec<Record>,
    rates: Vec<Rates>,
    pub rebuilds: u64,
    pub pairs: u64,
}

impl FluidParticles {
    /// A lattice of spacing Δx from the floor to `height` [m], at rest, pure and without pressure.
    pub fn lattice(numerics: Numerics, width: f64, height: f64) -> Self {
        let spacing = numerics.spacing;
        let side = (width / spacing).round() as usize;
        let layers = (height / spacing).round() as usize;
        let site = |layer: f64| {
            (0..side * side).map(move |i| {
                Vec3::new((i % side) as f64 + 0.5, (i / side) as f64 + 0.5, layer + 0.5) * spacing
            })
        };
        let position: Vec<Vec3> = (0..layers).flat_map(|layer| site(layer as f64)).collect();
        let wall: Vec<Vec3> = (1..=WALL_LAYERS)
            .flat_map(|layer| site(-(layer as f64)))
            .collect();
        let count = position.len();
        let density = numerics.state.density;
        let mut fluid = FluidParticles {
            numerics,
            width,
            velocity: vec![Vec3::zeros(); count],
            mass: vec![density * spacing.powi(3); count],
            density: vec![density; count],
            density_rate: vec![0.0; count],
            porosity: vec![1.0; count],
            solid_flux: vec![Vec3::zeros(); count],
            pressure: vec![0.0; count],
            stress: vec![Vec3::zeros(); count],
            acceleration: vec![Vec3::zeros(); count],
            reaction: vec![Vec3::zeros(); count],
            wall_pressure: vec![0.0; wall.len()],
            wall,
            images: Vec::new(),
            rows: Rows::default(),
            wall_rows: Rows::default(),
            anchor: Vec::new(),
            records: Vec::new(),
            rates: vec![Rates::default(); count],
            rebuilds: 0,
            pairs: 0,
            position,
        };
        fluid.rebuild_rows();
        fluid
    }

    pub fn len(&self) -> usize {
        self.position.len()
    }

    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Sets masses and densities so that the particles carry `porosity` at `pressure` [Pa] exactly.
    pub fn prepare(&mut self, porosity: &[f64], pressure: impl Fn(&Vec3) -> f64) {
        let volume = self.numerics.spacing.powi(3);
        self.porosity.copy_from_slice(porosity);
        for a in 0..self.len() {
            self.density[a] = self.numerics.state.density_at(pressure(&self.position[a]));
            self.mass[a] = self.porosity[a] * self.density[a] * volume;
        }
    }

    /// Volume of the mixture that particle `a` stands for [m³].
    #[inline]
    pub fn volume(&self, a: usize) -> f64 {
        self.mass[a] / (self.porosity[a] * self.density[a])
    }

    /// Takes over a new porosity of particle `a`.
    pub fn set_porosity(&mut self, a: usize, porosity: f64) {
        if self.numerics.continuity == Continuity::Superficial {
            // ε ϱ is what that balance moves: it does not change with ε.
            self.density[a] *= self.porosity[a] / porosity;
        }
        self.porosity[a] = porosity;
    }

    /// First half of a step: velocities and densities to the middle, positions to the end.
    pub fn kick_and_drift(&mut self, dt: f64) {
        let half = 0.5 * dt;
        for a in 0..self.len() {
            self.velocity[a] += half * (self.acceleration[a] + self.reaction[a]);
            self.density[a] += half * self.density_rate[a];
            self.position[a] += dt * self.velocity[a];
        }
        self.refresh_rows();
    }

    /// Rates at the present positions, with velocities and densities extrapolated `ahead` [s] by the
    /// old rates.
    pub fn sum_rates(&mut self, ahead: f64) {
        self.write_records(ahead);
        self.extrapolate_wall_pressure();
        self.write_images();
        self.pairs += self.rows.pairs;
        let coefficients = Coefficients {
            smoothing: self.numerics.smoothing(),
            viscosity: self.numerics.viscosity,
            artificial: self.numerics.artificial
                * self.numerics.state.density
                * self.numerics.state.sound_speed,
        };
        match (self.numerics.lucy, self.numerics.artificial > 0.0) {
            (false, false) => self.sweep_with::<_, false>(WendlandC2, coefficients),
            (false, true) => self.sweep_with::<_, true>(WendlandC2, coefficients),
            (true, false) => self.sweep_with::<_, false>(Lucy, coefficients),
            (true, true) => self.sweep_with::<_, true>(Lucy, coefficients),
        }
        self.read_rates();
    }

    /// Velocity [m/s] a time `ahead` [s] from now, at the present acceleration.
    #[inline]
    pub fn velocity_ahead(&self, a: usize, ahead: f64) -> Vec3 {
        self.velocity[a] + ahead * (self.acceleration[a] + self.reaction[a])
    }

    /// Second half of a step.
    pub fn kick(&mut self, dt: f64) {
        let half = 0.5 * dt;
        for a in 0..self.len() {
            self.velocity[a] += half * (self.acceleration[a] + self.reaction[a]);
            self.density[a] += half * self.density_rate[a];
        }
    }

    fn sweep_with<K: Kernel, const ARTIFICIAL: bool>(&mut self, kernel: K, coefficients: Coefficients) {
        in_widest(Sweep::<K, ARTIFICIAL> {
            kernel,
            coefficients,
            records: &self.records,
            rows: &self.rows,
            rates: &mut self.rates,
        });
    }

    fn write_records(&mut self, ahead: f64) {
        let state = self.numerics.state;
        let bulk = self.numerics.bulk * state.density * state.sound_speed * self.numerics.smoothing();
        for a in 0..self.len() {
            let mut velocity = self.velocity_ahead(a, ahead);
            if self.numerics.continuity == Continuity::MixtureFlux {
                velocity = self.porosity[a] * velocity + self.solid_flux[a];
            }
            let density = self.density[a] + ahead * self.density_rate[a];
            self.pressure[a] = self.numerics.state.pressure(density);
            let x = &self.position[a];
            self.records[a] = Record([
                x.x,
                x.y,
                x.z,
                velocity.x,
                velocity.y,
                velocity.z,
                self.mass[a] / (self.porosity[a] * density),
                self.pressure[a] + bulk * self.density_rate[a] / density,
            ]);
        }
    }

    /// Shepard mean of the fluid pressure around each wall particle, with the hydrostatic part of
    /// the distance where the pressure carries it.
    fn extrapolate_wall_pressure(&mut self) {
        let (count, walls) = (self.len(), self.wall.len());
        let per_smoothing = 1.0 / self.numerics.smoothing();
        let weight = self.numerics.state.density * self.numerics.gravity;
        let volume = self.numerics.spacing.powi(3);
        for w in 0..walls {
            let (mut sum, mut norm) = (0.0, 0.0);
            for &b in self.wall_rows.row(w) {
                let (source, shift) = self.origin(b as usize);
                if source >= count {
                    continue;
                }
                let r = self.position[source] + shift - self.wall[w];
                let value = WendlandC2.value(r.norm() * per_smoothing);
                sum += value * (self.pressure[source] + weight * r.z);
                norm += value;
            }
            self.wall_pressure[w] = if norm > 0.0 { sum / norm } else { 0.0 };
            let x = &self.wall[w];
            self.records[count + w] = Record([x.x, x.y, x.z, 0.0, 0.0, 0.0, volume, self.wall_pressure[w]]);
        }
    }

    fn write_images(&mut self) {
        let real = self.len() + self.wall.len();
        for (i, image) in self.images.iter().enumerate() {
            let mut record = self.records[image.source as usize];
            record.0[0] += image.shift.x;
            record.0[1] += image.shift.y;
            self.records[real + i] = record;
        }
    }

    fn read_rates(&mut self) {
        let numerics = &self.numerics;
        let weight = Vec3::new(0.0, 0.0, -numerics.gravity);
        for a in 0..self.position.len() {
            let rates = &self.rates[a];
            let volume = self.records[a].0[6];
            self.stress[a] = Vec3::from(rates.stress);
            self.acceleration[a] = self.stress[a] * (volume / self.mass[a]) + weight;
            let density = self.mass[a] / (volume * self.porosity[a]);
            let share = match numerics.continuity {
                Continuity::MixtureFlux => 1.0 / self.porosity[a],
                Continuity::Superficial => 1.0,
            };
            self.density_rate[a] = -share * density * rates.divergence;
        }
    }

    /// Source particle and offset of a row member; wall particles follow the fluid.
    fn origin(&self, member: usize) -> (usize, Vec3) {
        let real = self.len() + self.wall.len();
        if member < real {
            (member, Vec3::zeros())
        } else {
            self.images
                .get(member - real)
                .map_or((usize::MAX, Vec3::zeros()), |i| (i.source as usize, i.shift))
        }
    }

    fn refresh_rows(&mut self) {
        let allowed = 0.5 * SKIN * 2.0 * self.numerics.smoothing();
        let moved = |a: usize| (self.position[a] - self.anchor[a]).norm_squared();
        if (0..self.len()).any(|a| moved(a) >= allowed * allowed) {
            self.wrap();
            self.rebuild_rows();
        }
    }

    fn wrap(&mut self) {
        for x in &mut self.position {
            x.x = x.x.rem_euclid(self.width);
            x.y = x.y.rem_euclid(self.width);
        }
    }

    fn rebuild_rows(&mut self) {
        let reach = 2.0 * self.numerics.smoothing() * (1.0 + SKIN);
        let mut points = self.position.clone();
        points.extend(&self.wall);
        self.images = images(&points, self.width, reach);
        points.extend(
            self.images
                .iter()
                .map(|i| points[i.source as usize] + i.shift)
                .collect::<Vec<_>>(),
        );
        let nobody = points.len() as u32;
        self.rows = Rows::new(&self.position, &points, reach, nobody);
        self.wall_rows = Rows::new(&self.wall, &points, reach, nobody);
        self.anchor = self.position.clone();
        self.records = vec![Record::default(); points.len() + 1];
        // Padding points at a particle without volume, out of everybody's reach.
        self.records[points.len()].0[..3].fill(-1e3 * (1.0 + self.width));
        self.rebuilds += 1;
    }

    /// Fluid particles and their images with the offset, for sums around grains.
    pub fn points_with_images(&self) -> (Vec<Vec3>, Vec<u32>) {
        let mut points = self.position.clone();
        let mut sources: Vec<u32> = (0..self.len() as u32).collect();
        for image in self
            .images
            .iter()
            .filter(|image| (image.source as usize) < self.len())
        {
            points.push(self.position[image.source as usize] + image.shift);
            sources.push(image.source);
        }
        (points, sources)
    }

    /// Momentum of the fluid [kg m/s] a time `ahead` [s] from now, summed with compensation.
    pub fn momentum_ahead(&self, ahead: f64) -> Vec3 {
        compensated((0..self.len()).map(|a| self.velocity_ahead(a, ahead) * self.mass[a]))
    }

    /// Force of the floor on the fluid [N], from the pairs of wall and fluid alone.
    pub fn wall_force(&self) -> Vec3 {
        // Equal terms round alike, so a plain sum over the lattice of the wall would drift.
        compensated((0..self.wall.len()).map(|w| self.force_of_wall_particle(w)))
    }

    fn force_of_wall_particle(&self, w: usize) -> Vec3 {
        let (count, h) = (self.len(), self.numerics.smoothing());
        let slope = |q| {
            if self.numerics.lucy {
                Lucy.slope(q)
            } else {
                WendlandC2.slope(q)
            }
        };
        let state = &self.numerics.state;
        let artificial = self.numerics.artificial * state.density * state.sound_speed;
        let own = self.records[count + w].0;
        let mut force = Vec3::zeros();
        for &b in self.wall_rows.row(w) {
            if self.origin(b as usize).0 >= count {
                continue;
            }
            let other = self.records[b as usize].0;
            let r = Vec3::new(other[0] - own[0], other[1] - own[1], other[2] - own[2]);
            let v = Vec3::new(other[3], other[4], other[5]);
            let weight = own[6] * other[6] * slope(r.norm() / h) / h.powi(5);
            let along = artificial * v.dot(&r) / r.norm() - own[7] - other[7];
            force += weight * (2.0 * self.numerics.viscosity * v + along * r);
        }
        force
    }

    /// Energy stored in compression [J]: Σ V p²/(2 ρ c²).
    pub fn elastic_energy(&self) -> f64 {
        let state = &self.numerics.state;
        let unit = 0.5 / (state.density * state.sound_speed * state.sound_speed);
        (0..self.len())
            .map(|a| unit * self.records[a].0[6] * self.pressure[a] * self.pressure[a])
            .sum()
    }

    /// Where a particle was when its neighbours were last collected [m].
    pub fn anchored_position(&self, a: usize) -> Vec3 {
        self.anchor[a]
    }

    /// Bytes held by the particles and their rows.
    pub fn memory(count: usize) -> u64 {
        // About 190 bytes of state per particle, 1.4 records with images and 130 row entries.
        count as u64 * (190 + 90 + 130 * 4)
    }
}

/// Sum with Neumaier's compensation: the audit of momentum must not see its own rounding.
fn compensated(terms: impl Iterator<Item = Vec3>) -> Vec3 {
    let (mut sum, mut lost) = (Vec3::zeros(), Vec3::zeros());
    for term in terms {
        for axis in 0..3 {
            let next = sum[axis] + term[axis];
            let (large, small) = if sum[axis].abs() >= term[axis].abs() {
                (sum, term)
            } else {
                (term, sum)
            };
            lost[axis] += (large[axis] - next) + small[axis];
            sum[axis] = next;
        }
    }
    sum + lost
}
