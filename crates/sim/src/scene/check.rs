//! What cannot be simulated, found before anything runs. Paths are below the kind of the scene.

use super::mixture::{self, Mixture};
use super::sedimentation::class_path;
use super::setup::Settling;
use super::suspension::MOST_CLASSES;
use super::{
    ConstantPorosityBlock, CouplingLengths, Fault, Fluid, Medium, PorosityPath, Scene, SingleSphere,
    SoundSpeed, SphFluid, SuspendedClass,
};

const MOST_THREADS: u32 = 64;
/// Fewest particle spacings across a periodic column: a support of 2h must not meet its own image.
const FEWEST_ACROSS: f64 = 6.0;
/// Departure of the sum of the shares from one [-].
const SHARE_ROUNDING: f64 = 1e-6;
/// Admitted departure of a spacing that is adjusted to fit a column.
const TOLERANCE: f64 = 0.02;

/// All faults of a scene; empty when it can run.
pub fn check(scene: &Scene) -> Vec<Fault> {
    let mut list = List::default();
    match scene {
        Scene::SingleSphere(sphere) => single_sphere(sphere, &mut list),
        Scene::ConstantPorosityBlock(block) => porosity_block(block, &mut list),
        Scene::BinaryCollision(collision) => super::collision::check(collision, &mut list),
        Scene::Sedimentation(sedimentation) => super::sedimentation::check(sedimentation, &mut list),
        Scene::Suspension(suspension) => super::suspension::check(suspension, &mut list),
    }
    // The safe step follows from numbers that must make sense first.
    if list.0.is_empty() {
        match scene {
            Scene::SingleSphere(sphere) => time_step(&Settling::of_sphere(sphere), &mut list),
            Scene::ConstantPorosityBlock(block) => time_step(&Settling::of_block(block), &mut list),
            Scene::BinaryCollision(_) | Scene::Sedimentation(_) | Scene::Suspension(_) => {}
        }
    }
    list.0
}

#[derive(Default)]
pub(super) struct List(Vec<Fault>);

impl List {
    pub(super) fn add(&mut self, path: &str, message: String, help: &str) {
        self.0.push(Fault {
            path: path.to_owned(),
            message,
            help: help.to_owned(),
        });
    }

    /// Asks for a finite number above zero; says whether it is.
    pub(super) fn positive(&mut self, path: &str, value: f64) -> bool {
        let holds = value > 0.0 && value.is_finite();
        if !holds {
            let name = path.rsplit('.').next().unwrap_or(path);
            self.add(
                path,
                format!("`{name}` is {}, it must be above 0", shown(value)),
                "write a positive number",
            );
        }
        holds
    }

    /// Asks for a finite number of any sign.
    pub(super) fn finite(&mut self, path: &str, value: f64) -> bool {
        if !value.is_finite() {
            let name = path.rsplit('.').next().unwrap_or(path);
            let message = format!("`{name}` is {value}, it must be finite");
            self.add(path, message, "write a number");
        }
        value.is_finite()
    }

    /// Asks for a finite number that may vanish.
    pub(super) fn not_negative(&mut self, path: &str, value: f64) -> bool {
        let holds = value >= 0.0 && value.is_finite();
        if !holds {
            let name = path.rsplit('.').next().unwrap_or(path);
            let message = format!("`{name}` is {}, it must be 0 or above", shown(value));
            self.add(path, message, "write a number that is not negative");
        }
        holds
    }

    pub(super) fn between(&mut self, path: &str, value: f64, low: f64, high: f64) -> bool {
        let holds = value > low && value < high;
        if !holds {
            let name = path.rsplit('.').next().unwrap_or(path);
            let message = format!("`{name}` is {value}, it must lie between {low} and {high}");
            self.add(path, message, "both limits are excluded");
        }
        holds
    }
}

/// Asks for threads and snapshots that make sense; says whether both do.
pub(super) fn threads_and_snapshots(threads: u32, snapshots: u32, list: &mut List) -> bool {
    let mut sound = true;
    if !(1..=MOST_THREADS).contains(&threads) {
        let message = format!("`threads` is {threads}, it must lie between 1 and {MOST_THREADS}");
        list.add("threads", message, "below 20000 grains one thread is fastest");
        sound = false;
    }
    if snapshots == 1 {
        let message = "`snapshots` is 1, but the first and the last are always kept".to_owned();
        list.add("snapshots", message, "write 0 for none, or 2 and more");
        sound = false;
    }
    sound
}

/// What both scenes with grains in a column share.
struct Common<'a> {
    /// Smallest and largest diameter [m], and where the largest stands.
    diameters: [f64; 2],
    largest: String,
    column: &'a super::Column,
    fluid: &'a Fluid,
    duration: f64,
    gravity: f64,
}

fn common(scene: &Common, grains_sound: bool, list: &mut List) -> bool {
    let medium = medium(scene.fluid);
    let model = match scene.fluid {
        Fluid::Still(_) => "still",
        Fluid::Column(_) => "column",
        Fluid::Sph(_) => "sph",
    };
    let mut sound = list.positive(&format!("fluid.{model}.density"), medium.density);
    sound &= list.positive(&format!("fluid.{model}.viscosity"), medium.viscosity);
    sound &= list.positive("column.width", scene.column.width);
    sound &= list.positive("column.height", scene.column.height);
    sound &= list.positive("duration", scene.duration);
    sound &= list.positive("gravity", scene.gravity);
    let [smallest, largest] = scene.diameters;
    sound &= grains_sound;
    if sound && largest >= scene.column.width {
        let message = format!(
            "a grain of {} does not fit in a column {} wide",
            millimetres(largest),
            millimetres(scene.column.width)
        );
        list.add(
            &scene.largest,
            message,
            "make the grain smaller or the column wider",
        );
        sound = false;
    }
    if let (true, Fluid::Sph(fluid)) = (sound, scene.fluid) {
        particle_fluid(fluid, smallest, scene.column, list);
    }
    sound
}

fn medium(fluid: &Fluid) -> &Medium {
    match fluid {
        Fluid::Still(medium) | Fluid::Column(medium) => medium,
        Fluid::Sph(fluid) => &fluid.medium,
    }
}

/// What of a particle fluid around grains of a diameter [m] cannot be simulated; says whether all can.
pub(super) fn particle_fluid(
    fluid: &SphFluid,
    diameter: f64,
    column: &super::Column,
    list: &mut List,
) -> bool {
    let before = list.0.len();
    if list.positive("fluid.sph.spacing_over_diameter", fluid.spacing_over_diameter) {
        let spacing = fluid.spacing_over_diameter * diameter;
        fits("width", column.width, spacing, list);
        fits("height", column.height, spacing, list);
    }
    let scheme = &fluid.scheme;
    for (name, value) in [
        ("artificial_viscosity", scheme.artificial_viscosity),
        ("viscosity_constant", scheme.viscosity_constant),
        ("stiffness", scheme.stiffness),
        ("time_step", scheme.time_step),
        ("steps_per_contact", Some(scheme.steps_per_contact)),
    ] {
        if let Some(value) = value {
            list.positive(&format!("fluid.sph.scheme.{name}"), value);
        }
    }
    if let SoundSpeed::Value(speed) = scheme.sound_speed {
        list.positive("fluid.sph.scheme.sound_speed", speed);
    }
    list.0.len() == before
}

/// A side of the column must hold a whole number of particle spacings.
fn fits(name: &str, side: f64, spacing: f64, list: &mut List) {
    let path = format!("column.{name}");
    let count = side / spacing;
    if count < FEWEST_ACROSS * (1.0 - TOLERANCE) {
        let message = format!(
            "`{name}` {} is {count:.1} particle spacings of {}, too few",
            millimetres(side),
            millimetres(spacing)
        );
        let help = format!(
            "make it at least {}, six spacings, or the spacing smaller",
            millimetres(FEWEST_ACROSS * spacing)
        );
        return list.add(&path, message, &help);
    }
    let whole = count.round();
    if (count / whole - 1.0).abs() > TOLERANCE {
        let message = format!(
            "`{name}` {} is {count:.2} particle spacings of {}, not a whole number",
            millimetres(side),
            millimetres(spacing)
        );
        let help = format!(
            "the nearest that fit are {} and {}",
            millimetres(count.floor() * spacing),
            millimetres(count.ceil() * spacing)
        );
        list.add(&path, message, &help);
    }
}

/// Refuses a step beyond the longest safe one.
fn time_step(settling: &Settling, list: &mut List) {
    let Some(fluid) = settling.sph() else { return };
    let (limit, name) = settling.step_limit(fluid);
    match fluid.scheme.time_step {
        Some(step) if step > limit && !fluid.scheme.unsafe_time_step => {
            let message = format!("`time_step` is {step:.3e} s, its limit {name} is {limit:.3e} s");
            let help = "stay below the limit, leave it to `automatic`, or set `unsafe_time_step: true`";
            list.add("fluid.sph.scheme.time_step", message, help);
        }
        _ => {}
    }
}

fn single_sphere(scene: &SingleSphere, list: &mut List) {
    let mut sound = list.positive("grains.diameter", scene.grains.diameter);
    sound &= list.positive("grains.density", scene.grains.density);
    let shared = Common {
        diameters: [scene.grains.diameter; 2],
        largest: "grains.diameter".to_owned(),
        column: &scene.column,
        fluid: &scene.fluid,
        duration: scene.duration,
        gravity: scene.gravity,
    };
    sound &= common(&shared, sound, list);
    if let (true, Fluid::Sph(_)) = (scene.added_mass, &scene.fluid) {
        list.add(
            "added_mass",
            "`added_mass: on` does not go with an `sph` fluid: its particles carry their own inertia"
                .to_owned(),
            "leave it off, or take the fluid `still` or `column`",
        );
    }
    if !list.between("release_height", scene.release_height, 0.0, 1.0) || !sound {
        return;
    }
    let (radius, height) = (0.5 * scene.grains.diameter, scene.column.height);
    let released = scene.release_height * height;
    if released < radius || released > height - radius {
        let message = format!(
            "a grain released at {} touches the floor or the surface of a column {} high",
            millimetres(released),
            millimetres(height)
        );
        let help = "keep the grain's radius away from both";
        list.add("release_height", message, help);
    }
}

fn porosity_block(scene: &ConstantPorosityBlock, list: &mut List) {
    let mut sound = classes(&scene.classes, list);
    if scene.classes.is_empty() {
        return;
    }
    let index = largest_class(&scene.classes);
    let diameters = scene.classes.iter().map(|class| class.diameter);
    let shared = Common {
        diameters: [
            diameters.fold(f64::INFINITY, f64::min),
            scene.classes[index].diameter,
        ],
        largest: format!("{}.diameter", class_path(scene.classes.len(), index)),
        column: &scene.column,
        fluid: &scene.fluid,
        duration: scene.duration,
        gravity: scene.gravity,
    };
    sound &= common(&shared, sound, list);
    if let Fluid::Sph(fluid) = &scene.fluid {
        sound &= lengths(fluid, list);
    }
    // Equal spheres cannot be packed more densely than 0.74 (Kepler).
    if !list.between("porosity", scene.porosity, 0.26, 1.0) || !sound {
        return;
    }
    if scene.grains_per_side == 0 {
        let message = "the block has no grain along its side".to_owned();
        return list.add(
            "grains_per_side",
            message,
            "give `grains_per_side`, or widen the column",
        );
    }
    if scene.layers == 0 {
        let message = "the block has no layer of grains".to_owned();
        return list.add(
            "layers",
            message,
            "give `thickness` (at least half a layer) or `layers`",
        );
    }
    lattice(scene, list);
}

/// The second of several lengths must have a use.
fn lengths(fluid: &SphFluid, list: &mut List) -> bool {
    let scheme = &fluid.scheme;
    let one =
        scheme.porosity == PorosityPath::TwoPass && scheme.coupling_lengths != CouplingLengths::PerClass;
    if one {
        let message = "`coupling_lengths` has no say under `porosity: two_pass`: all grains have the \
                       smoothing length of the fluid"
            .to_owned();
        let help = "leave it out, or write `porosity: one_pass`";
        list.add("fluid.sph.scheme.coupling_lengths", message, help);
    }
    !one
}

fn largest_class(classes: &[SuspendedClass]) -> usize {
    let diameter = |index: &usize| classes[*index].diameter;
    (0..classes.len())
        .max_by(|a, b| diameter(a).total_cmp(&diameter(b)))
        .unwrap_or(0)
}

/// What of the classes of grains cannot be simulated; says whether all can.
pub(super) fn classes(classes: &[SuspendedClass], list: &mut List) -> bool {
    let count = classes.len();
    if !(1..=MOST_CLASSES).contains(&count) {
        let message = format!("there are {count} classes, it must be one to {MOST_CLASSES}");
        let help = "put together what hardly differs, or leave it out";
        list.add("classes", message, help);
        return false;
    }
    let mut sound = true;
    for (index, class) in classes.iter().enumerate() {
        let path = |name: &str| format!("{}.{name}", class_path(count, index));
        sound &= list.positive(&path("diameter"), class.diameter);
        sound &= list.positive(&path("density"), class.density);
        sound &= list.positive(&path("share"), class.share);
    }
    let shares: f64 = classes.iter().map(|class| class.share).sum();
    if sound && (shares - 1.0).abs() > SHARE_ROUNDING {
        let message = format!("the shares add up to {shares}, it must be 1");
        list.add("classes", message, "shares are of the number of all grains");
        sound = false;
    }
    sound
}

fn lattice(scene: &ConstantPorosityBlock, list: &mut List) {
    let mixture = Mixture {
        classes: scene.classes.clone(),
    };
    let diameter = mixture.largest();
    let pitch = scene.column.width / f64::from(scene.grains_per_side);
    if pitch < diameter {
        let message = format!("{} grains do not fit along the width", scene.grains_per_side);
        let most = (scene.column.width / diameter).floor();
        return list.add("grains_per_side", message, &format!("there is room for {most}"));
    }
    let layer = mixture.mean(mixture::volume) / ((1.0 - scene.porosity) * pitch * pitch);
    if layer < diameter {
        let message = format!("at porosity {} the layers of grains overlap", scene.porosity);
        return list.add(
            "porosity",
            message,
            "take more grains along the side, or a larger porosity",
        );
    }
    // The bottom face stands at half the height.
    let thickness = layer * f64::from(scene.layers);
    let room = 0.5 * scene.column.height;
    if thickness > room {
        let message = format!(
            "the block is {} thick, there is room for {}",
            millimetres(thickness),
            millimetres(room)
        );
        list.add(
            "thickness",
            message,
            "make it thinner or the column higher: the block begins at half the height",
        );
    }
}

/// A number, small ones with an exponent.
fn shown(value: f64) -> String {
    if value != 0.0 && value.abs() < 1e-5 {
        format!("{value:e}")
    } else {
        value.to_string()
    }
}

/// A length in millimetres, with as many digits as it needs, at most six.
pub(super) fn millimetres(length: f64) -> String {
    let text = format!("{:.6}", 1e3 * length);
    format!("{} mm", text.trim_end_matches('0').trim_end_matches('.'))
}
