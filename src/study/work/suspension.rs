//! From the written suspension to the plain data that runs.

use kynch_sim::scene::{Homogeneity, SoftContact, SuspendedClass, SuspendingFluid, Suspension};

use super::{coefficient, column, drag, medium, sph};
use crate::study::faults::Fault;
use crate::study::spec::quantity::{StiffnessSpec, TimeStepSpec};
use crate::study::spec::scene::GrainsSpec;
use crate::study::spec::suspension::*;

/// The scene with the first seed; a point sets its own.
pub fn suspension(spec: &SuspensionSpec) -> Suspension {
    Suspension {
        classes: classes(&spec.grains, &spec.classes),
        porosity: spec.porosity.0,
        column: column(&spec.column),
        arrangement: match spec.arrangement {
            HomogeneitySpec::Even => Homogeneity::Even,
            HomogeneitySpec::Random => Homogeneity::Random,
        },
        drag: drag(spec.drag),
        fluid: match &spec.fluid {
            SuspendingFluidSpec::Column(still) => SuspendingFluid::Column(medium(still)),
            SuspendingFluidSpec::Sph(fluid) => SuspendingFluid::Sph(sph(fluid)),
        },
        contact: SoftContact {
            stiffness: match spec.contact.stiffness {
                StiffnessSpec::Automatic => None,
                StiffnessSpec::Value(stiffness) => Some(stiffness),
            },
            restitution: spec.contact.restitution.0,
            friction: coefficient(spec.contact.friction),
        },
        top_grains: spec.top_grains,
        duration: spec.duration.0,
        gravity: spec.gravity.0,
        steps_per_contact: spec.steps_per_contact.0,
        time_step: match spec.time_step {
            TimeStepSpec::Automatic => None,
            TimeStepSpec::Value(step) => Some(step),
        },
        unsafe_time_step: spec.unsafe_time_step,
        threads: spec.threads,
        seed: 1,
        snapshots: spec.snapshots,
    }
}

/// The classes of grains, whichever way they are given.
pub fn classes(
    grains: &Option<GrainsSpec>,
    several: &Option<Vec<SuspendedClassSpec>>,
) -> Vec<SuspendedClass> {
    let one = grains.iter().map(|grains| SuspendedClass {
        diameter: grains.diameter.0,
        density: grains.density.0,
        share: 1.0,
    });
    let listed = |classes: &Vec<SuspendedClassSpec>| classes.iter().map(class).collect();
    several.as_ref().map_or_else(|| one.collect(), listed)
}

fn class(spec: &SuspendedClassSpec) -> SuspendedClass {
    SuspendedClass {
        diameter: spec.diameter.0,
        density: spec.density.0,
        share: spec.share.0,
    }
}

/// What contradicts itself in the grains of a scene as they are written.
pub fn contradictions(
    scene: &str,
    grains: &Option<GrainsSpec>,
    classes: &Option<Vec<SuspendedClassSpec>>,
) -> Vec<Fault> {
    let fault = |path: &str, message: &str, help: &str| Fault {
        path: path.to_owned(),
        message: message.to_owned(),
        help: help.to_owned(),
    };
    match (grains, classes) {
        (Some(_), Some(_)) => vec![fault(
            "classes",
            "`grains` and `classes` are both given",
            "keep one",
        )],
        (None, None) => vec![fault(
            "grains",
            &format!("`grains` is missing from `{scene}`"),
            "add `grains:` with diameter and density, or a list `classes:` of them with their shares",
        )],
        _ => Vec::new(),
    }
}

/// Where a fault of the scene stands in the file: a scene of one class may list it all the same.
pub fn placed(classes: &Option<Vec<SuspendedClassSpec>>, mut fault: Fault) -> Fault {
    if let (Some(_), Some(rest)) = (classes, fault.path.strip_prefix("grains.")) {
        fault.path = format!("classes.0.{rest}");
    }
    fault
}
