//! What is seen of a suspension at one instant.

use super::model::Suspension;
use super::profile::{Deposit, Profile};
use crate::bed::Bed;

/// Most classes of grains.
pub const MOST_CLASSES: usize = 4;
/// Slabs in a largest diameter.
const SLABS_PER_DIAMETER: f64 = 1.0;
/// Distance from the fronts, in largest diameters, at which a grain counts as suspended: nearer ones settle
/// into the deposit, or are the last ones at the top.
const AWAY: f64 = 3.0;

/// A suspension in numbers; classes by their place, no number where a class has no grains to take it from.
#[derive(Clone, Debug)]
pub struct Measures {
    pub time: f64,
    /// Mean height of the highest grains, of all and of each class [m].
    pub interface_height: [f64; 1 + MOST_CLASSES],
    /// Height above which the porosity exceeds the mean of suspension and clear fluid [m].
    pub interface_front: f64,
    pub profile: Profile,
    /// Of all and of each class [m].
    pub centre_of_mass: [f64; 1 + MOST_CLASSES],
    /// Mean superficial slip of suspended grains [m/s], upward positive.
    pub slip: [f64; MOST_CLASSES],
    /// Mean speed of suspended grains [m/s], downward positive.
    pub settling_speed: [f64; MOST_CLASSES],
    /// Rms of the vertical and of a horizontal velocity about the mean of the class [m/s].
    pub fluctuation: [f64; 2],
    /// Greatest overlap since the last row [-].
    pub deepest: f64,
}

impl Measures {
    /// `slip` gives the superficial slip of the grain at a place [m/s], upward positive.
    pub fn of(scene: &Suspension, bed: &Bed, time: f64, slip: impl Fn(usize) -> f64) -> Measures {
        let area = scene.column.width * scene.column.width;
        let largest = scene.largest_diameter();
        let suspended = 1.0 - scene.porosity;
        let profile = Profile::of(bed, scene.column.height, largest / SLABS_PER_DIAMETER, area);
        let interface_front = profile.front_from_above(0.5 * suspended);
        let bed_front = Deposit::guessed(&profile, suspended).height;
        let moments = Moments::of(
            bed,
            [bed_front + AWAY * largest, interface_front - AWAY * largest],
            slip,
        );
        Measures {
            time,
            interface_height: interface_heights(scene, bed),
            interface_front,
            profile,
            centre_of_mass: centres_of_mass(bed),
            slip: moments.mean(|sums| sums.slip),
            settling_speed: moments.mean(|sums| -sums.vertical),
            fluctuation: moments.fluctuation(),
            deepest: bed.deepest,
        }
    }
}

/// Mean heights of the highest grains, of all and of each class.
fn interface_heights(scene: &Suspension, bed: &Bed) -> [f64; 1 + MOST_CLASSES] {
    let wanted = scene.interface_grains();
    let grains = &bed.grains;
    let heights = |class: Option<usize>| {
        let of_class =
            move |grain: &usize| class.is_none_or(|class| usize::from(grains.class[*grain]) == class);
        (0..grains.moving)
            .filter(of_class)
            .map(|grain| grains.position(grain).z)
            .collect::<Vec<f64>>()
    };
    let mut means = [f64::NAN; 1 + MOST_CLASSES];
    means[0] = mean_of_highest(heights(None), wanted as usize);
    for (class, kind) in scene.classes.iter().enumerate().take(MOST_CLASSES) {
        let wanted = (wanted as f64 * kind.share).round().max(1.0);
        means[1 + class] = mean_of_highest(heights(Some(class)), wanted as usize);
    }
    means
}

fn mean_of_highest(mut heights: Vec<f64>, wanted: usize) -> f64 {
    let wanted = wanted.min(heights.len());
    if wanted == 0 {
        return f64::NAN;
    }
    heights.select_nth_unstable_by(wanted - 1, |one, other| other.total_cmp(one));
    // The order that the selection leaves depends on the order of the grains; the sum must not.
    heights[..wanted].sort_unstable_by(f64::total_cmp);
    heights[..wanted].iter().sum::<f64>() / wanted as f64
}

fn centres_of_mass(bed: &Bed) -> [f64; 1 + MOST_CLASSES] {
    let grains = &bed.grains;
    let (mut moment, mut mass) = ([0.0; 1 + MOST_CLASSES], [0.0; 1 + MOST_CLASSES]);
    for place in grains.places().into_iter().take(grains.moving) {
        let grain = place as usize;
        let own = grains.mass(grain);
        for sum in [0, 1 + usize::from(grains.class[grain])] {
            moment[sum] += own * grains.position(grain).z;
            mass[sum] += own;
        }
    }
    std::array::from_fn(|sum| moment[sum] / mass[sum])
}

/// Sums over the suspended grains of each class.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: f64,
    slip: f64,
    vertical: f64,
    vertical_squared: f64,
    horizontal_squared: f64,
}

struct Moments([Sums; MOST_CLASSES]);

impl Moments {
    /// Grains whose centres lie between two heights [m].
    fn of(bed: &Bed, [low, high]: [f64; 2], slip: impl Fn(usize) -> f64) -> Moments {
        let grains = &bed.grains;
        let mut moments = Moments([Sums::default(); MOST_CLASSES]);
        for place in grains.places().into_iter().take(grains.moving) {
            let grain = place as usize;
            let z = grains.position(grain).z;
            if z < low || z > high {
                continue;
            }
            let v = grains.velocity(grain);
            let sums = &mut moments.0[usize::from(grains.class[grain])];
            sums.count += 1.0;
            sums.slip += slip(grain);
            sums.vertical += v.z;
            sums.vertical_squared += v.z * v.z;
            sums.horizontal_squared += 0.5 * (v.x * v.x + v.y * v.y);
        }
        moments
    }

    fn mean(&self, value: impl Fn(&Sums) -> f64) -> [f64; MOST_CLASSES] {
        self.0.map(|sums| value(&sums) / sums.count)
    }

    fn fluctuation(&self) -> [f64; 2] {
        let (mut count, mut vertical, mut horizontal) = (0.0, 0.0, 0.0);
        for sums in self.0.iter().filter(|sums| sums.count > 0.0) {
            count += sums.count;
            vertical += sums.vertical_squared - sums.vertical * sums.vertical / sums.count;
            horizontal += sums.horizontal_squared;
        }
        [vertical.max(0.0), horizontal].map(|sum| (sum / count).sqrt())
    }
}
