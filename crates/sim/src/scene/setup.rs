//! From a scene to numbers: lattices, sound speed, time step, steps.

use std::f64::consts::PI;

use super::mixture::{Mixture, mass, volume};
use super::{
    Column, ConstantPorosityBlock, CouplingLengths, Drag, Fluid, Hydrostatics, Medium, SingleSphere,
    SoundSpeed, SphFluid, SuspendedClass,
};
use crate::drag::DragScale;
use crate::math::Vec3;

/// Courant number of the fluid step in terms of h/c.
pub const COURANT: f64 = 0.4;
/// Density change of a fluid that passes through a block [-]: it expands by as much on the way, and
/// that flux adds to the slip, so at one per cent a block of porosity 0.9 falls 0.5 per cent too slowly.
const BLOCK_COMPRESSION: f64 = 0.004;
/// Porosity length of a grain class over its diameter [-].
pub const POROSITY_LENGTH: f64 = 3.0;

/// Calls a generic function with the law a scene names.
macro_rules! with_law {
    ($drag:expr, $law:ident => $body:expr) => {
        match $drag {
            crate::scene::Drag::Stokes => {
                let $law = crate::drag::Stokes;
                $body
            }
            crate::scene::Drag::Dallavalle => {
                let $law = crate::drag::Dallavalle;
                $body
            }
            crate::scene::Drag::SchillerNaumann => {
                let $law = crate::drag::SchillerNaumann;
                $body
            }
            crate::scene::Drag::DiFelice => {
                let $law = crate::drag::DiFelice;
                $body
            }
            crate::scene::Drag::CoulsonRichardson => {
                let $law = crate::drag::CoulsonRichardson;
                $body
            }
            crate::scene::Drag::Beetstra => {
                let $law = crate::drag::Beetstra;
                $body
            }
            crate::scene::Drag::BeetstraCello => {
                let $law = crate::drag::BeetstraCello;
                $body
            }
        }
    };
}
pub(super) use with_law;

/// What both scenes share.
#[derive(Clone)]
pub struct Settling<'a> {
    pub mixture: Mixture,
    pub drag: Drag,
    pub fluid: &'a Fluid,
    pub column: &'a Column,
    pub duration: f64,
    pub gravity: f64,
    /// The block, when there is one.
    pub block: Option<&'a ConstantPorosityBlock>,
    pub sphere: Option<&'a SingleSphere>,
}

impl<'a> Settling<'a> {
    pub fn of_sphere(sphere: &'a SingleSphere) -> Self {
        Settling {
            mixture: Mixture {
                classes: vec![SuspendedClass {
                    diameter: sphere.grains.diameter,
                    density: sphere.grains.density,
                    share: 1.0,
                }],
            },
            drag: sphere.drag,
            fluid: &sphere.fluid,
            column: &sphere.column,
            duration: sphere.duration,
            gravity: sphere.gravity,
            block: None,
            sphere: Some(sphere),
        }
    }

    pub fn of_block(block: &'a ConstantPorosityBlock) -> Self {
        Settling {
            mixture: Mixture {
                classes: block.classes.clone(),
            },
            drag: block.drag,
            fluid: &block.fluid,
            column: &block.column,
            duration: block.duration,
            gravity: block.gravity,
            block: Some(block),
            sphere: None,
        }
    }

    pub fn medium(&self) -> Medium {
        match self.fluid {
            Fluid::Still(medium) | Fluid::Column(medium) => *medium,
            Fluid::Sph(sph) => sph.medium,
        }
    }

    pub fn sph(&self) -> Option<&'a SphFluid> {
        match self.fluid {
            Fluid::Sph(sph) => Some(sph),
            _ => None,
        }
    }

    /// Of the Sauter mean of the grains.
    pub fn scale(&self) -> DragScale {
        let medium = self.medium();
        DragScale {
            diameter: self.mixture.sauter_mean(),
            density: medium.density,
            viscosity: medium.viscosity,
        }
    }

    /// Mean volume of a grain [m³].
    pub fn volume(&self) -> f64 {
        self.mixture.mean(volume)
    }

    /// Mean mass of a grain [kg].
    pub fn mass(&self) -> f64 {
        self.mixture.mean(mass)
    }

    /// Mass of the fluid that an accelerating grain carries along [kg]: that of half its volume, the
    /// potential flow around a sphere (Lamb, 1932, Hydrodynamics, art. 92); zero where it is left out.
    pub fn added_mass(&self) -> f64 {
        match self.sphere {
            Some(sphere) if sphere.added_mass => 0.5 * self.medium().density * self.volume(),
            _ => 0.0,
        }
    }

    /// Weight less buoyancy of a grain, on the mean [N].
    pub fn excess_weight(&self) -> f64 {
        self.mixture.mean(|class| self.excess_weight_of(class))
    }

    /// Weight less buoyancy of a grain of a class [N].
    pub fn excess_weight_of(&self, class: &SuspendedClass) -> f64 {
        (class.density - self.medium().density) * volume(class) * self.gravity
    }

    /// Porosity the grains settle at [-].
    pub fn porosity(&self) -> f64 {
        self.block.map_or(1.0, |block| block.porosity)
    }

    /// Settling speed expected from the force balance [m/s].
    pub fn expected_speed(&self) -> f64 {
        let force = self.excess_weight().abs() * self.porosity();
        if force == 0.0 {
            return 0.0;
        }
        let medium = self.medium();
        let fluid = [medium.density, medium.viscosity];
        with_law!(self.drag, law => self.mixture.balance(&law, fluid, force, self.porosity()))
    }

    /// Stokes relaxation time m/(3πμd) [s] of the class that has the shortest.
    pub fn relaxation_time(&self) -> f64 {
        let viscosity = self.medium().viscosity;
        let time = |class: &SuspendedClass| mass(class) / (3.0 * PI * viscosity * class.diameter);
        self.mixture
            .classes
            .iter()
            .map(time)
            .fold(f64::INFINITY, f64::min)
    }

    /// (m + added mass) v/F at the terminal velocity [s]: how fast a grain in a fluid that is not solved comes
    /// to it. The relaxation time under Stokes drag without added mass; shorter by f(Re) under other laws.
    pub fn response_time(&self) -> f64 {
        let mass = self.mass() + self.added_mass();
        let speed = self.expected_speed();
        match speed > 0.0 {
            true => mass * speed / self.excess_weight().abs(),
            false => self.relaxation_time() * mass / self.mass(),
        }
    }

    /// Particle spacing [m] of an sph fluid over the smallest grain, adjusted to divide the width.
    pub fn spacing(&self, sph: &SphFluid) -> f64 {
        let wanted = sph.spacing_over_diameter * self.mixture.smallest();
        self.column.width / (self.column.width / wanted).round().max(1.0)
    }

    /// Largest excess pressure the grains can build up [Pa].
    pub fn excess_pressure(&self) -> f64 {
        self.block.map_or(0.0, |block| {
            (1.0 - block.porosity) * self.excess_weight().abs() / self.volume() * self.thickness(block)
        })
    }

    /// Thickness of the block [m]: layers times vertical pitch.
    pub fn thickness(&self, block: &ConstantPorosityBlock) -> f64 {
        block.layers as f64 * self.vertical_pitch(block)
    }

    /// Height of a layer [m] at which all grains together have the porosity of the block.
    fn vertical_pitch(&self, block: &ConstantPorosityBlock) -> f64 {
        let solids: f64 = self.lattice(block).iter().map(|class| volume(class)).sum();
        let area = self.column.width * self.column.width;
        solids / ((1.0 - block.porosity) * area * f64::from(block.layers))
    }

    /// The class of each grain of a block, layer by layer.
    fn lattice(&self, block: &ConstantPorosityBlock) -> Vec<&SuspendedClass> {
        let (side, layers) = (block.grains_per_side as usize, block.layers as usize);
        let classes = self.mixture.arrange(side, layers);
        classes
            .iter()
            .map(|&class| &self.mixture.classes[class])
            .collect()
    }

    /// The class of each grain, in the order of [`positions`](Self::positions).
    pub fn grains(&self) -> Vec<&SuspendedClass> {
        match self.block {
            Some(block) => self.lattice(block),
            None => vec![&self.mixture.classes[0]],
        }
    }

    /// Diameter [m] whose lengths a grain of a class has in the coupling.
    fn coupling_diameter(&self, sph: &SphFluid, class: &SuspendedClass) -> f64 {
        match sph.scheme.coupling_lengths {
            CouplingLengths::PerClass | CouplingLengths::DoubleSmoothing => class.diameter,
            CouplingLengths::Largest => self.mixture.largest(),
            CouplingLengths::Smallest | CouplingLengths::DoubleSmoothingLiteral => self.mixture.smallest(),
        }
    }

    /// Exchange length h_x of a grain of a class [m].
    pub fn exchange_length_of(&self, sph: &SphFluid, class: &SuspendedClass) -> f64 {
        (POROSITY_LENGTH * self.coupling_diameter(sph, class)).max(1.2 * self.spacing(sph))
    }

    /// Porosity length h_p of a grain of a class [m].
    pub fn porosity_length_of(&self, sph: &SphFluid, class: &SuspendedClass) -> f64 {
        POROSITY_LENGTH * self.coupling_diameter(sph, class)
    }

    /// The longest exchange length of all classes [m].
    pub fn exchange_length(&self, sph: &SphFluid) -> f64 {
        let lengths = (self.mixture.classes.iter()).map(|class| self.exchange_length_of(sph, class));
        lengths.fold(0.0, f64::max)
    }

    /// Sound speed [m/s]: ten times any speed, one per cent of density change, and pressure that
    /// settles around a grain within a third of its relaxation time.
    pub fn sound_speed(&self, sph: &SphFluid) -> f64 {
        match sph.scheme.sound_speed {
            SoundSpeed::Value(value) => value,
            SoundSpeed::FreeFall => 20.0 * (2.0 * self.gravity * self.column.height).sqrt(),
            SoundSpeed::Automatic => {
                let density = self.medium().density;
                let carried = match sph.scheme.hydrostatics {
                    Hydrostatics::Split => 0.0,
                    Hydrostatics::Carried => density * self.gravity * self.column.height,
                };
                let compression = (self.excess_pressure() / (BLOCK_COMPRESSION * density)
                    + carried / (0.01 * density))
                    .sqrt();
                let equilibrium = match self.block {
                    None => 1.5 * self.exchange_length(sph) / self.relaxation_time(),
                    Some(_) => 0.0,
                };
                compression.max(10.0 * self.expected_speed()).max(equilibrium)
            }
        }
    }

    /// Longest safe fluid step [s] and the limit that sets it.
    pub fn step_limit(&self, sph: &SphFluid) -> (f64, &'static str) {
        let medium = self.medium();
        let h = 1.5 * self.spacing(sph);
        let acoustic = COURANT * h / self.sound_speed(sph);
        let nu = medium.viscosity / medium.density
            + sph.scheme.artificial_viscosity.unwrap_or(0.0) * self.sound_speed(sph) * h / 9.0;
        let viscous = 0.125 * h * h / nu;
        let coupling = 0.2 * self.relaxation_time();
        [
            (acoustic, "0.4 h/c"),
            (viscous, "0.125 h²/ν"),
            (coupling, "0.2 m/(3πμd)"),
        ]
        .into_iter()
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .unwrap_or((acoustic, "0.4 h/c"))
    }

    /// Step [s] of the run and the number of steps.
    pub fn steps(&self) -> (f64, u64) {
        let wanted = match self.sph() {
            Some(sph) => sph.scheme.time_step.unwrap_or(self.step_limit(sph).0),
            None if self.sphere.is_some() => self.response_time().min(self.relaxation_time()) / 50.0,
            None => self.relaxation_time() / 50.0,
        };
        let steps = (self.duration / wanted).ceil().max(1.0);
        (self.duration / steps, steps as u64)
    }

    /// Where the grains start [m].
    pub fn positions(&self) -> Vec<Vec3> {
        if let Some(sphere) = self.sphere {
            let middle = 0.5 * self.column.width;
            return vec![Vec3::new(
                middle,
                middle,
                sphere.release_height * self.column.height,
            )];
        }
        let Some(block) = self.block else {
            return Vec::new();
        };
        let side = block.grains_per_side as usize;
        let (pitch, rise) = (self.column.width / side as f64, self.vertical_pitch(block));
        let bottom = 0.5 * self.column.height;
        (0..block.layers as usize * side * side)
            .map(|i| {
                let (x, y, layer) = (i % side, i / side % side, i / side / side);
                Vec3::new(
                    (x as f64 + 0.5) * pitch,
                    (y as f64 + 0.5) * pitch,
                    bottom + (layer as f64 + 0.5) * rise,
                )
            })
            .collect()
    }

    /// Fluid particles, wall layers left out.
    pub fn fluid_particles(&self) -> u64 {
        self.sph().map_or(0, |sph| {
            let spacing = self.spacing(sph);
            let side = (self.column.width / spacing).round() as u64;
            side * side * (self.column.height / spacing).round() as u64
        })
    }
}

/// Isolated terminal speed [m/s] under a law, used by `describe`.
pub fn isolated_speed(settling: &Settling) -> f64 {
    let force = settling.excess_weight().abs();
    with_law!(settling.drag, law => settling.scale().balance(&law, force, 1.0))
}
