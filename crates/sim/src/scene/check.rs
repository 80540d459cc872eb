//! What cannot be simulated, found before anything runs. Paths are below the kind of the scene.

use super::setup::Settling;
use super::{ConstantPorosityBlock, Fault, Fluid, Grains, Medium, Scene, SingleSphere, SoundSpeed, SphFluid};

/// Fewest particle spacings across a periodic column: a support of 2h must not meet its own image.
const FEWEST_ACROSS: f64 = 6.0;
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
        Scene::Filtration(filtration) => super::filtration::check(filtration, &mut list),
    }
    // The safe step follows from numbers that must make sense first.
    if list.0.is_empty() {
        match scene {
            Scene::SingleSphere(sphere) => time_step(&Settling::of_sphere(sphere), &mut list),
            Scene::ConstantPorosityBlock(block) => time_step(&Settling::of_block(block), &mut list),
            Scene::BinaryCollision(_) | Scene::Sedimentation(_) | Scene::Filtration(_) => {}
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

    /// Takes the faults of a part, with paths of its own.
    pub(super) fn take(&mut self, part: List, path: impl Fn(String) -> String) {
        self.0.extend(part.0.into_iter().map(|fault| Fault {
            path: path(fault.path),
            ..fault
        }));
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

    fn between(&mut self, path: &str, value: f64, low: f64, high: f64) -> bool {
        let holds = value > low && value < high;
        if !holds {
            let name = path.rsplit('.').next().unwrap_or(path);
            let message = format!("`{name}` is {value}, it must lie between {low} and {high}");
            self.add(path, message, "both limits are excluded");
        }
        holds
    }
}

/// What both scenes with grains in a column share.
struct Common<'a> {
    grains: &'a Grains,
    column: &'a super::Column,
    fluid: &'a Fluid,
    duration: f64,
    gravity: f64,
}

fn common(scene: &Common, list: &mut List) -> bool {
    let medium = medium(scene.fluid);
    let model = match scene.fluid {
        Fluid::Still(_) => "still",
        Fluid::Column(_) => "column",
        Fluid::Sph(_) => "sph",
    };
    let mut sound = list.positive("grains.diameter", scene.grains.diameter);
    sound &= list.positive("grains.density", scene.grains.density);
    sound &= list.positive(&format!("fluid.{model}.density"), medium.density);
    sound &= list.positive(&format!("fluid.{model}.viscosity"), medium.viscosity);
    sound &= list.positive("column.width", scene.column.width);
    sound &= list.positive("column.height", scene.column.height);
    sound &= list.positive("duration", scene.duration);
    sound &= list.positive("gravity", scene.gravity);
    if sound && scene.grains.diameter >= scene.column.width {
        let message = format!(
            "a grain of {} does not fit in a column {} wide",
            millimetres(scene.grains.diameter),
            millimetres(scene.column.width)
        );
        list.add(
            "grains.diameter",
            message,
            "make the grain smaller or the column wider",
        );
        sound = false;
    }
    if let (true, Fluid::Sph(fluid)) = (sound, scene.fluid) {
        particle_fluid(scene, fluid, list);
    }
    sound
}

fn medium(fluid: &Fluid) -> &Medium {
    match fluid {
        Fluid::Still(medium) | Fluid::Column(medium) => medium,
        Fluid::Sph(fluid) => &fluid.medium,
    }
}

fn particle_fluid(scene: &Common, fluid: &SphFluid, list: &mut List) {
    if list.positive("fluid.sph.spacing_over_diameter", fluid.spacing_over_diameter) {
        let spacing = fluid.spacing_over_diameter * scene.grains.diameter;
        fits("width", scene.column.width, spacing, list);
        fits("height", scene.column.height, spacing, list);
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
    let shared = Common {
        grains: &scene.grains,
        column: &scene.column,
        fluid: &scene.fluid,
        duration: scene.duration,
        gravity: scene.gravity,
    };
    let sound = common(&shared, list);
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
    let shared = Common {
        grains: &scene.grains,
        column: &scene.column,
        fluid: &scene.fluid,
        duration: scene.duration,
        gravity: scene.gravity,
    };
    let sound = common(&shared, list);
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

fn lattice(scene: &ConstantPorosityBlock, list: &mut List) {
    let diameter = scene.grains.diameter;
    let pitch = scene.column.width / f64::from(scene.grains_per_side);
    if pitch < diameter {
        let message = format!("{} grains do not fit along the width", scene.grains_per_side);
        let most = (scene.column.width / diameter).floor();
        return list.add("grains_per_side", message, &format!("there is room for {most}"));
    }
    let volume = std::f64::consts::PI / 6.0 * diameter.powi(3);
    let layer = volume / ((1.0 - scene.porosity) * pitch * pitch);
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
