//! From the written scene to the plain data that runs.

mod collision;
mod sedimentation;
mod snapshot;
mod suspension;

pub use snapshot::Snapshots;

use kynch_sim::scene::{
    Column, ConstantPorosityBlock, Coupling, CouplingLengths, Drag, Fluid, Grains, Hydrostatics,
    KernelChoice, Medium, PorosityPath, Scene, Scheme, SelfDisturbance, SharpeningChoice, SingleSphere, Slip,
    SoundSpeed, SphFluid, Start, StressDensity, SuspendedClass,
};

use super::faults::{Fault, faults};
use super::model::{Rehearsal, RehearsalEnding, Work};
use super::spec::quantity::{CoefficientSpec, SoundSpeedSpec, StiffnessSpec, TimeStepSpec};
use super::spec::scene::*;
use super::spec::sedimentation::{ArrangementSpec, SedimentationSpec};
use super::spec::suspension::{SuspendingFluidSpec, SuspensionSpec};

/// Fills in what follows from other fields and files: the lattice of a block, the grains of a snapshot, the
/// sharpening that suits the scene.
pub fn completed(mut spec: SceneSpec, snapshots: &Snapshots) -> SceneSpec {
    if let SceneSpec::Sedimentation(SedimentationSpec {
        arrangement: ArrangementSpec::Snapshot(snapshot),
        ..
    }) = &mut spec
    {
        snapshots.fill(snapshot);
    }
    if let SceneSpec::ConstantPorosityBlock(block) = &mut spec {
        let classes = suspension::classes(&block.grains, &block.classes);
        let volume =
            |class: &SuspendedClass| class.share * std::f64::consts::PI / 6.0 * class.diameter.powi(3);
        let pitch = cubic_pitch(classes.iter().map(volume).sum(), block.porosity.0);
        let width = block.column.width.0;
        block.grains_per_side.get_or_insert(count(width / pitch));
        let thickness = block.thickness.map(|thickness| thickness.0);
        if let Some(thickness) = thickness {
            block.layers.get_or_insert(count(thickness / pitch));
        }
    }
    sharpen(&mut spec);
    spec
}

/// Settles an automatic sharpening.
fn sharpen(spec: &mut SceneSpec) {
    let (fluid, suits) = match spec {
        SceneSpec::SingleSphere(SingleSphereSpec {
            fluid: FluidSpec::Sph(sph),
            ..
        })
        | SceneSpec::ConstantPorosityBlock(BlockSpec {
            fluid: FluidSpec::Sph(sph),
            ..
        }) => (sph, SharpeningSpec::Conservative),
        SceneSpec::Suspension(SuspensionSpec {
            fluid: SuspendingFluidSpec::Sph(sph),
            ..
        }) => (sph, SharpeningSpec::None),
        _ => return,
    };
    if let SharpeningSpec::Automatic = fluid.scheme.sharpening {
        fluid.scheme.sharpening = suits;
    }
}

/// Distance [m] of neighbours in a cubic lattice of grains of a volume [m³] at the given porosity.
fn cubic_pitch(volume: f64, porosity: f64) -> f64 {
    (volume / (1.0 - porosity)).cbrt()
}

/// Nearest whole number; nonsense becomes 0 and is refused later.
fn count(ratio: f64) -> u32 {
    ratio.round() as u32
}

/// Canonical settings: map form, SI numbers, defaults filled in, keys sorted.
pub fn settings(spec: &SceneSpec) -> serde_json::Value {
    let mut settings = serde_json::to_value(spec).unwrap_or_default();
    settings.sort_all_objects();
    settings
}

/// The scene ready to run. Expects a [`completed`] one.
pub fn work(spec: &SceneSpec) -> Work {
    match spec {
        SceneSpec::SingleSphere(sphere) => Work::Simulation(Scene::SingleSphere(SingleSphere {
            grains: grains(&sphere.grains),
            drag: drag(sphere.drag),
            fluid: fluid(&sphere.fluid),
            column: column(&sphere.column),
            release_height: sphere.release_height.0,
            coupling: match sphere.coupling {
                CouplingSpec::OneWay => Coupling::OneWay,
                CouplingSpec::TwoWay => Coupling::TwoWay,
            },
            self_disturbance: match sphere.self_disturbance {
                SelfDisturbanceSpec::Corrected => SelfDisturbance::Corrected,
                SelfDisturbanceSpec::Uncorrected => SelfDisturbance::Uncorrected,
            },
            added_mass: matches!(sphere.added_mass, Switch::On),
            duration: sphere.duration.0,
            gravity: sphere.gravity.0,
        })),
        SceneSpec::ConstantPorosityBlock(block) => {
            Work::Simulation(Scene::ConstantPorosityBlock(ConstantPorosityBlock {
                classes: suspension::classes(&block.grains, &block.classes),
                drag: drag(block.drag),
                fluid: fluid(&block.fluid),
                column: column(&block.column),
                porosity: block.porosity.0,
                grains_per_side: block.grains_per_side.unwrap_or_default(),
                layers: block.layers.unwrap_or_default(),
                held: block.held,
                duration: block.duration.0,
                gravity: block.gravity.0,
            }))
        }
        SceneSpec::BinaryCollision(spec) => {
            Work::Simulation(Scene::BinaryCollision(collision::collision(spec)))
        }
        SceneSpec::Sedimentation(spec) => {
            Work::Simulation(Scene::Sedimentation(sedimentation::sedimentation(spec)))
        }
        SceneSpec::Suspension(spec) => Work::Simulation(Scene::Suspension(suspension::suspension(spec))),
        SceneSpec::Rehearsal(rehearsal) => Work::Rehearsal(rehearsed(rehearsal)),
    }
}

/// Everything that keeps a scene from running, as it is written. Expects a [`completed`] one.
pub fn refusals(spec: &SceneSpec, work: &Work) -> Vec<Fault> {
    match spec {
        SceneSpec::Sedimentation(spec) => {
            let contradictions = sedimentation::contradictions(spec);
            if !contradictions.is_empty() {
                return contradictions;
            }
            let found = faults(work).into_iter();
            found.map(|fault| sedimentation::placed(spec, fault)).collect()
        }
        SceneSpec::Suspension(spec) => {
            let contradictions = suspension::contradictions("suspension", &spec.grains, &spec.classes);
            if !contradictions.is_empty() {
                return contradictions;
            }
            let found = faults(work).into_iter();
            found
                .map(|fault| suspension::placed(&spec.classes, fault))
                .collect()
        }
        SceneSpec::ConstantPorosityBlock(spec) => {
            let name = "constant_porosity_block";
            let contradictions = suspension::contradictions(name, &spec.grains, &spec.classes);
            if !contradictions.is_empty() {
                return contradictions;
            }
            let found = faults(work).into_iter();
            found
                .map(|fault| suspension::placed(&spec.classes, fault))
                .collect()
        }
        _ => faults(work),
    }
}

fn rehearsed(spec: &RehearsalSpec) -> Rehearsal {
    Rehearsal {
        limit: spec.limit.0,
        time_constant: spec.time_constant.0,
        duration: spec.duration.0,
        samples: spec.samples,
        scale: spec.scale.0,
        order: spec.order.0,
        error: spec.error.0,
        grains: spec.grains,
        delay: spec.delay.0,
        ending: match spec.ending {
            EndingSpec::Completes => RehearsalEnding::Completes,
            EndingSpec::Diverges => RehearsalEnding::Diverges,
            EndingSpec::Panics => RehearsalEnding::Panics,
        },
    }
}

fn grains(spec: &GrainsSpec) -> Grains {
    Grains {
        diameter: spec.diameter.0,
        density: spec.density.0,
    }
}

fn column(spec: &ColumnSpec) -> Column {
    Column {
        width: spec.width.0,
        height: spec.height.0,
    }
}

fn drag(spec: DragSpec) -> Drag {
    match spec {
        DragSpec::Stokes => Drag::Stokes,
        DragSpec::Dallavalle => Drag::Dallavalle,
        DragSpec::SchillerNaumann => Drag::SchillerNaumann,
        DragSpec::DiFelice => Drag::DiFelice,
        DragSpec::CoulsonRichardson => Drag::CoulsonRichardson,
        DragSpec::Beetstra => Drag::Beetstra,
        DragSpec::BeetstraCello => Drag::BeetstraCello,
    }
}

fn fluid(spec: &FluidSpec) -> Fluid {
    match spec {
        FluidSpec::Still(still) => Fluid::Still(medium(still)),
        FluidSpec::Column(column) => Fluid::Column(medium(column)),
        FluidSpec::Sph(fluid) => Fluid::Sph(sph(fluid)),
    }
}

fn sph(spec: &SphSpec) -> SphFluid {
    SphFluid {
        medium: Medium {
            density: spec.density.0,
            viscosity: spec.viscosity.0,
        },
        spacing_over_diameter: spec.spacing_over_diameter.0,
        scheme: scheme(&spec.scheme),
    }
}

fn medium(spec: &MediumSpec) -> Medium {
    Medium {
        density: spec.density.0,
        viscosity: spec.viscosity.0,
    }
}

fn scheme(spec: &SchemeSpec) -> Scheme {
    Scheme {
        sound_speed: match spec.sound_speed {
            SoundSpeedSpec::Automatic => SoundSpeed::Automatic,
            SoundSpeedSpec::FreeFall => SoundSpeed::FreeFall,
            SoundSpeedSpec::Value(speed) => SoundSpeed::Value(speed),
        },
        hydrostatics: match spec.hydrostatics {
            HydrostaticsSpec::Split => Hydrostatics::Split,
            HydrostaticsSpec::Carried => Hydrostatics::Carried,
        },
        kernel: match spec.kernel {
            KernelSpec::WendlandC2 => KernelChoice::WendlandC2,
            KernelSpec::Lucy => KernelChoice::Lucy,
        },
        artificial_viscosity: coefficient(spec.artificial_viscosity),
        viscosity_constant: coefficient(spec.viscosity_constant),
        porosity: match spec.porosity {
            PorosityPathSpec::OnePass => PorosityPath::OnePass,
            PorosityPathSpec::TwoPass => PorosityPath::TwoPass,
        },
        sharpening: match spec.sharpening {
            SharpeningSpec::None => SharpeningChoice::None,
            SharpeningSpec::Automatic | SharpeningSpec::Conservative => SharpeningChoice::Conservative,
        },
        start: match spec.start {
            StartSpec::Exact => Start::Exact,
            StartSpec::Relaxed => Start::Relaxed,
        },
        stress_density: match spec.stress_density {
            PhaseSpec::Superficial => StressDensity::Superficial,
            PhaseSpec::Intrinsic => StressDensity::Intrinsic,
        },
        slip: match spec.slip {
            SlipSpec::Superficial => Slip::Superficial,
            SlipSpec::Interstitial => Slip::Interstitial,
        },
        coupling_lengths: match spec.coupling_lengths {
            CouplingLengthsSpec::PerClass => CouplingLengths::PerClass,
            CouplingLengthsSpec::Smallest => CouplingLengths::Smallest,
            CouplingLengthsSpec::Largest => CouplingLengths::Largest,
            CouplingLengthsSpec::DoubleSmoothing => CouplingLengths::DoubleSmoothing,
            CouplingLengthsSpec::DoubleSmoothingLiteral => CouplingLengths::DoubleSmoothingLiteral,
        },
        stiffness: match spec.stiffness {
            StiffnessSpec::Automatic => None,
            StiffnessSpec::Value(stiffness) => Some(stiffness),
        },
        steps_per_contact: spec.steps_per_contact.0,
        time_step: match spec.time_step {
            TimeStepSpec::Automatic => None,
            TimeStepSpec::Value(step) => Some(step),
        },
        unsafe_time_step: spec.unsafe_time_step,
    }
}

fn coefficient(spec: CoefficientSpec) -> Option<f64> {
    match spec {
        CoefficientSpec::None => None,
        CoefficientSpec::Value(value) => Some(value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_empty_scheme_is_the_default_of_the_simulator() {
        assert_eq!(scheme(&SchemeSpec::default()), Scheme::default());
    }

    #[test]
    fn the_cubic_lattice_gives_the_published_grains_per_side() {
        // Grains per side of the thesis' columns at porosity 0.9 and 0.8.
        for (width, porosity, side) in [
            (4.5e-3, 0.9, 26),
            (4.0e-3, 0.9, 23),
            (5.4e-3, 0.9, 31),
            (6.0e-3, 0.8, 44),
        ] {
            assert_eq!(
                count(width / cubic_pitch(std::f64::consts::PI / 6.0 * 1e-12, porosity)),
                side,
                "{width} {porosity}"
            );
        }
    }
}
