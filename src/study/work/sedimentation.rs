//! From the written sedimentation, and the box of grains of every scene, to the plain data that runs.

use kynch_sim::scene::{
    Arrangement, Charge, Cohesion, Container, Detection, Dimensions, Floor, FloorGrains, GrainClass,
    GrainDrag, Lift, Medium, Sedimentation, Sides, SlicePorosity, Snapshot, StillFluid, Until, Voidage,
};

use super::collision::{integrator, normal, rolling, tangential};
use super::medium;
use crate::study::faults::Fault;
use crate::study::spec::quantity::{SkinSpec, TimeStepSpec};
use crate::study::spec::scene::MediumSpec;
use crate::study::spec::sedimentation::*;

/// The scene with the first seed; a point sets its own.
pub fn sedimentation(spec: &SedimentationSpec) -> Sedimentation {
    bed(&spec.bed, fluid(&spec.fluid))
}

/// The grains, their box, laws and numerics, in a fluid.
pub fn bed(spec: &BedSpec, fluid: StillFluid) -> Sedimentation {
    Sedimentation {
        dimensions: if spec.dimensions == 2 {
            Dimensions::Two
        } else {
            Dimensions::Three
        },
        classes: classes(spec).iter().map(class).collect(),
        container: container(spec),
        arrangement: match &spec.arrangement {
            ArrangementSpec::Random => Arrangement::Random,
            ArrangementSpec::Lattice => Arrangement::Lattice,
            ArrangementSpec::Packed(packed) => Arrangement::Packed {
                solids_fraction: packed.solids_fraction.0,
            },
            ArrangementSpec::Snapshot(written) => Arrangement::Snapshot(snapshot(written)),
        },
        normal: normal(&spec.normal),
        tangential: tangential(&spec.tangential),
        rolling: rolling(&spec.rolling),
        cohesion: cohesion(&spec.cohesion),
        charge: match &spec.charge {
            ChargeSpec::None => None,
            ChargeSpec::Coulomb(law) => Some(Charge {
                charge: law.charge.0,
                relative_permittivity: law.relative_permittivity.0,
                cut_off: law.cut_off.0,
            }),
        },
        drag: drag(spec.drag),
        voidage: voidage(spec.voidage),
        porosity: porosity(spec.porosity),
        lift: match spec.lift {
            LiftSpec::None => Lift::None,
            LiftSpec::Magnus => Lift::Magnus,
        },
        fluid,
        gravity: spec.gravity.0,
        duration: spec.duration.0,
        until: match spec.until {
            UntilSpec::Duration => Until::Duration,
            UntilSpec::Settled => Until::Settled,
        },
        integrator: integrator(spec.integrator),
        detection: detection(&spec.detection),
        sleeping: matches!(spec.sleeping, SwitchSpec::On),
        central_slice: spec.central_slice.0,
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

/// What has been read, or that nothing has been.
fn snapshot(spec: &SnapshotSpec) -> Snapshot {
    spec.contents.clone().unwrap_or_else(|| Snapshot {
        file: spec.file.clone(),
        grains: Err(format!("`{}` has not been read", spec.file)),
    })
}

fn classes(spec: &BedSpec) -> &[GrainClassSpec] {
    match (&spec.grains, &spec.classes) {
        (_, Some(classes)) => classes,
        (Some(grains), None) => std::slice::from_ref(grains),
        (None, None) => &[],
    }
}

fn class(spec: &GrainClassSpec) -> GrainClass {
    GrainClass {
        diameter: spec.diameter.0,
        largest_diameter: spec.largest_diameter.map(|diameter| diameter.0),
        density: spec.density.0,
        number: spec.number,
    }
}

fn container(spec: &BedSpec) -> Container {
    let written = &spec.container;
    let widest = |class: &GrainClassSpec| {
        class
            .largest_diameter
            .map_or(class.diameter.0, |largest| largest.0)
    };
    let largest = classes(spec).iter().map(widest).fold(0.0, f64::max);
    Container {
        width: written.width.0,
        depth: written.depth.map_or(largest, |depth| depth.0),
        height: written.height.0,
        sides: match written.sides {
            SidesSpec::Walls => Sides::Walls,
            SidesSpec::Periodic => Sides::Periodic,
            SidesSpec::PeriodicAlongX => Sides::PeriodicAlongX,
        },
        floor: match &written.floor {
            FloorSpec::Flat => Floor::Flat,
            FloorSpec::Grains(grains) => Floor::Grains(FloorGrains {
                diameter: grains.diameter.0,
                gap: grains.gap.0,
                layers: grains.layers,
            }),
        },
    }
}

fn cohesion(spec: &CohesionSpec) -> Option<Cohesion> {
    match spec {
        CohesionSpec::None => None,
        // The end of a row of constants: no attraction.
        CohesionSpec::VanDerWaals(law) if law.hamaker.0 == 0.0 => None,
        CohesionSpec::VanDerWaals(law) => Some(Cohesion {
            hamaker: law.hamaker.0,
            smallest_gap: law.smallest_gap.0,
            cut_off: law.cut_off.0,
            walls: law.walls,
        }),
    }
}

fn drag(spec: GrainDragSpec) -> GrainDrag {
    match spec {
        GrainDragSpec::None => GrainDrag::None,
        GrainDragSpec::Stokes => GrainDrag::Stokes,
        GrainDragSpec::Dallavalle => GrainDrag::Dallavalle,
        GrainDragSpec::SchillerNaumann => GrainDrag::SchillerNaumann,
    }
}

fn voidage(spec: VoidageSpec) -> Voidage {
    match spec {
        VoidageSpec::None => Voidage::None,
        VoidageSpec::DiFelice => Voidage::DiFelice,
        VoidageSpec::AlvimLiteral => Voidage::AlvimLiteral,
    }
}

fn porosity(spec: SlicePorositySpec) -> SlicePorosity {
    match spec {
        SlicePorositySpec::Exact => SlicePorosity::Exact,
        SlicePorositySpec::Centre => SlicePorosity::Centre,
        SlicePorositySpec::Areas => SlicePorosity::Areas,
    }
}

fn fluid(spec: &StillFluidSpec) -> StillFluid {
    let medium: fn(&MediumSpec) -> Medium = medium;
    match spec {
        StillFluidSpec::Still(still) => StillFluid::Still(medium(still)),
        StillFluidSpec::Column(column) => StillFluid::Column(medium(column)),
    }
}

fn detection(spec: &DetectionSpec) -> Detection {
    match spec {
        DetectionSpec::List(list) => Detection::List {
            skin: match list.skin {
                SkinSpec::Automatic => None,
                SkinSpec::Value(skin) => Some(skin),
            },
        },
        DetectionSpec::Cells => Detection::Cells,
        DetectionSpec::BruteForce => Detection::BruteForce,
    }
}

/// What contradicts itself as it is written in a scene of that name.
pub fn contradictions(spec: &BedSpec, scene: &str) -> Vec<Fault> {
    let mut faults = Vec::new();
    let mut add = |path: &str, message: &str, help: &str| {
        faults.push(Fault {
            path: path.to_owned(),
            message: message.to_owned(),
            help: help.to_owned(),
        });
    };
    match (&spec.grains, &spec.classes) {
        (Some(_), Some(_)) => add("classes", "`grains` and `classes` are both given", "keep one"),
        (None, None) => add(
            "grains",
            &format!("`grains` is missing from `{scene}`"),
            "add `grains:` with diameter, density and number, or a list `classes:` of them",
        ),
        _ => {}
    }
    if ![2, 3].contains(&spec.dimensions) {
        let message = format!("`dimensions` is {}, it must be 2 or 3", spec.dimensions);
        add("dimensions", &message, "2 keeps the grains in a plane");
    }
    if spec.dimensions == 3 && spec.container.depth.is_none() {
        add(
            "container.depth",
            "`depth` is missing from `container`",
            "add `depth:` with a length (m), or write `dimensions: 2`",
        );
    }
    faults
}

/// Where a fault of the scene stands in the file: a scene of one class may list it all the same.
pub fn placed(spec: &BedSpec, mut fault: Fault) -> Fault {
    if let (Some(_), Some(rest)) = (&spec.classes, fault.path.strip_prefix("grains.")) {
        fault.path = format!("classes.0.{rest}");
    }
    fault
}
