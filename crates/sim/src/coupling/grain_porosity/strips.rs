//! Sums over all grains near a grain, eight at a time straight from memory.
//!
//! Grains, their periodic copies and their images at the floor are sorted into strips along x, and each
//! strip into short cells. What a strip has within reach of a place is then one run of cells: no list is
//! kept, so there is none to outgrow.

use crate::coupling::GrainSize;
use crate::fluid::kernel::Sharpening;
use crate::math::Vec3;
use crate::neighbours::{LANES, Wide, WideWork};

/// Strips per reach, and cells of a strip per reach.
const PER_REACH: f64 = 2.0;
const CELLS_PER_REACH: f64 = 4.0;
/// Strips and cells along each direction at most, however far a stray grain lies.
const MOST: f64 = 200.0;

#[derive(Clone, Debug, Default)]
pub(super) struct Strips {
    /// Twice the widest length [m].
    reach: f64,
    /// Sides of the cells [m], where they begin [m] and how many there are along x, y and z.
    sides: [f64; 3],
    origin: [f64; 3],
    counts: [usize; 3],
    /// First member of each cell. The last cell of each strip is never filled: it holds empty members, so
    /// that a group of eight never runs into the next strip.
    starts: Vec<u32>,
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    /// V/h³.
    unit: Vec<f64>,
    per_length: Vec<f64>,
    /// The grain that a member is, `NOBODY` for copies and images.
    grain: Vec<u32>,
}

const NOBODY: u32 = u32::MAX;

/// A grain or a copy of one.
#[derive(Clone, Copy)]
struct Member {
    place: Vec3,
    source: u32,
    own: bool,
}

impl Strips {
    pub fn fill(&mut self, position: &[Vec3], sizes: &[GrainSize], width: f64, floor_images: bool) {
        self.reach = 2.0 * sizes.iter().map(|size| size.length).fold(0.0, f64::max);
        let members = self.copies(position, sizes, width, floor_images);
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for member in &members {
            low = low.inf(&member.place);
            high = high.sup(&member.place);
        }
        for axis in 0..3 {
            let extent = (high[axis] - low[axis]).max(0.0);
            let per_reach = if axis == 0 { CELLS_PER_REACH } else { PER_REACH };
            self.sides[axis] = (self.reach / per_reach).max(extent / MOST);
            self.origin[axis] = low[axis];
            self.counts[axis] = (extent / self.sides[axis]) as usize + 1;
        }
        self.counts[0] += 1;
        self.sort(&members, sizes);
    }

    /// All grains with their copies beyond the sides and under the floor.
    fn copies(&self, position: &[Vec3], sizes: &[GrainSize], width: f64, floor_images: bool) -> Vec<Member> {
        let mut members = Vec::with_capacity(2 * position.len());
        for (source, (place, size)) in position.iter().zip(sizes).enumerate() {
            let reach = 2.0 * size.length;
            let wrapped = Vec3::new(place.x.rem_euclid(width), place.y.rem_euclid(width), place.z);
            let member = |place: Vec3, own: bool| Member {
                place,
                source: source as u32,
                own,
            };
            let turns = |x: f64| {
                let (low, high) = (x > width - reach, x < reach);
                -i32::from(low)..=i32::from(high)
            };
            for ix in turns(wrapped.x) {
                for iy in turns(wrapped.y) {
                    let moved = wrapped + Vec3::new(f64::from(ix), f64::from(iy), 0.0) * width;
                    members.push(member(moved, (ix, iy) == (0, 0)));
                    if floor_images && place.z < reach {
                        members.push(member(Vec3::new(moved.x, moved.y, -moved.z), false));
                    }
                }
            }
        }
        members
    }

    fn sort(&mut self, members: &[Member], sizes: &[GrainSize]) {
        let cells: usize = self.counts.iter().product();
        let homes: Vec<usize> = members.iter().map(|member| self.home(&member.place)).collect();
        self.starts.clear();
        self.starts.resize(cells + 1, 0);
        homes.iter().for_each(|&home| self.starts[home + 1] += 1);
        for cell in 0..cells {
            let last_of_strip = (cell + 1).is_multiple_of(self.counts[0]);
            let empty = if last_of_strip { LANES as u32 } else { 0 };
            self.starts[cell + 1] += self.starts[cell] + empty;
        }
        let total = self.starts[cells] as usize;
        // Empty members are out of everybody's reach.
        let far = 1e3 * (1.0 + self.reach);
        for values in [&mut self.x, &mut self.y, &mut self.z] {
            values.clear();
            values.resize(total, far);
        }
        for values in [&mut self.unit, &mut self.per_length] {
            values.clear();
            values.resize(total, 0.0);
        }
        self.grain.clear();
        self.grain.resize(total, NOBODY);
        let mut next = self.starts.clone();
        for (member, &home) in members.iter().zip(&homes) {
            let at = next[home] as usize;
            next[home] += 1;
            self.write(at, member, &sizes[member.source as usize]);
        }
    }

    fn write(&mut self, at: usize, member: &Member, size: &GrainSize) {
        let per_length = 1.0 / size.length;
        self.x[at] = member.place.x;
        self.y[at] = member.place.y;
        self.z[at] = member.place.z;
        self.unit[at] = size.volume() * (per_length * per_length * per_length);
        self.per_length[at] = per_length;
        self.grain[at] = if member.own { member.source } else { NOBODY };
    }

    fn home(&self, place: &Vec3) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| self.cell(place[axis], axis));
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// The cell along one axis that holds a value, or the nearest one.
    #[inline(always)]
    fn cell(&self, value: f64, axis: usize) -> usize {
        let position = (value - self.origin[axis]) / self.sides[axis];
        let last = self.counts[axis] - if axis == 0 { 2 } else { 1 };
        (position.max(0.0) as usize).min(last)
    }

    /// The first and the last cell along one axis within reach of a value.
    #[inline(always)]
    fn near(&self, value: f64, axis: usize) -> (usize, usize) {
        (
            self.cell(value - self.reach, axis),
            self.cell(value + self.reach, axis),
        )
    }

    /// Members between two values of x [m] in a strip, some beyond included.
    #[inline(always)]
    fn run(&self, [y, z]: [usize; 2], low: f64, high: f64) -> (usize, usize) {
        let strip = (z * self.counts[1] + y) * self.counts[0];
        (
            self.starts[strip + self.cell(low, 0)] as usize,
            self.starts[strip + self.cell(high, 0) + 1] as usize,
        )
    }

    /// Distance [m] of a value from a row of strips along one axis.
    #[inline(always)]
    fn distance(&self, value: f64, row: usize, axis: usize) -> f64 {
        let low = self.origin[axis] + row as f64 * self.sides[axis];
        (low - value).max(value - low - self.sides[axis]).max(0.0)
    }
}

/// Σ V W of every grain, itself included.
pub(super) struct StripSum<'a> {
    pub strips: &'a Strips,
    pub sharpening: Sharpening,
    pub solids: &'a mut [f64],
}

impl WideWork for StripSum<'_> {
    type Output = ();

    #[inline(always)]
    fn run<W: Wide>(self) {
        let strips = self.strips;
        let reach2 = strips.reach * strips.reach;
        for (place, &grain) in strips.grain.iter().enumerate() {
            if grain == NOBODY {
                continue;
            }
            let [x, y, z] = [strips.x[place], strips.y[place], strips.z[place]];
            let own = [W::splat(x), W::splat(y), W::splat(z)];
            let mut sum = W::splat(0.0);
            let (bottom, top) = strips.near(z, 2);
            let (front, back) = strips.near(y, 1);
            for row in bottom..=top {
                let rise = strips.distance(z, row, 2);
                for column in front..=back {
                    let aside = strips.distance(y, column, 1);
                    let left = reach2 - rise * rise - aside * aside;
                    if left < 0.0 {
                        continue;
                    }
                    let half = left.sqrt();
                    let (mut at, end) = strips.run([column, row], x - half, x + half);
                    // What the last group of eight has beyond the run is out of reach or empty.
                    while at < end {
                        sum = sum + self.group::<W>(at, &own);
                        at += LANES;
                    }
                }
            }
            self.solids[grain as usize] = sum.total();
        }
    }
}

impl StripSum<'_> {
    /// What eight members from `at` on add.
    #[inline(always)]
    fn group<W: Wide>(&self, at: usize, own: &[W; 3]) -> W {
        let strips = self.strips;
        let r = [
            load::<W>(&strips.x, at) - own[0],
            load::<W>(&strips.y, at) - own[1],
            load::<W>(&strips.z, at) - own[2],
        ];
        let q = (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt() * load::<W>(&strips.per_length, at);
        load::<W>(&strips.unit, at) * self.sharpening.value(q)
    }
}

#[inline(always)]
fn load<W: Wide>(values: &[f64], at: usize) -> W {
    let mut lanes = [0.0; LANES];
    lanes.copy_from_slice(&values[at..at + LANES]);
    W::from_lanes(lanes)
}
