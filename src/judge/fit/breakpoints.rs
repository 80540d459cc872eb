//! Where the segments of a continuous, piecewise straight line join: every pair of places on a grid, then
//! ever finer grids around the best one.
//!
//! Costs come from sums over the points above each place, so that a candidate costs the same whatever the
//! number of points.

/// Places tried along the series.
const PLACES: usize = 96;
/// Places on either side of the best one in each finer grid.
const SIDE: i32 = 3;
/// Finer grids, each half as wide as the one before, at most.
const MOST_GRIDS: usize = 200;
/// The finest grid, as a share of the window.
const FINEST: f64 = 1e-9;

/// A weighted series whose times rise, brought to the unit square for the sums to be exact enough.
pub struct Series<'a> {
    pub times: &'a [f64],
    pub values: &'a [f64],
    pub weights: &'a [f64],
}

/// Sums over the points from one on: w, w t, w t², w y, w t y.
type Sums = [f64; 5];

struct Table {
    times: Vec<f64>,
    /// Entry `i`: over the points from `i` on.
    above: Vec<Sums>,
    squares: f64,
}

impl Table {
    fn of(series: &Series) -> Table {
        let (first, last) = (series.times[0], series.times[series.times.len() - 1]);
        let middle = series.values.iter().sum::<f64>() / series.values.len() as f64;
        let times: Vec<f64> = series
            .times
            .iter()
            .map(|time| (time - first) / (last - first))
            .collect();
        let mut above = vec![[0.0; 5]; times.len() + 1];
        let mut squares = 0.0;
        for index in (0..times.len()).rev() {
            let (time, value, weight) = (times[index], series.values[index] - middle, series.weights[index]);
            let terms = [1.0, time, time * time, value, time * value].map(|term| weight * term);
            above[index] = std::array::from_fn(|place| above[index + 1][place] + terms[place]);
            squares += weight * value * value;
        }
        Table {
            times,
            above,
            squares,
        }
    }

    fn sums(&self, from: f64) -> &Sums {
        &self.above[self.times.partition_point(|time| *time < from)]
    }

    /// Least sum of squares with joints at these places, which rise; infinite where a segment is too short.
    fn cost(&self, joints: &[f64], least: usize) -> f64 {
        let mut edges = vec![0];
        edges.extend(
            joints
                .iter()
                .map(|joint| self.times.partition_point(|time| time < joint)),
        );
        edges.push(self.times.len());
        if edges.windows(2).any(|pair| pair[1] < pair[0] + least) {
            return f64::INFINITY;
        }
        // Basis: 1, t, (t − τ)₊ for each joint τ; the ramps by where they begin.
        let size = joints.len() + 2;
        let mut ramps = [0.0; MOST_TERMS];
        ramps[2..size].copy_from_slice(joints);
        let mut normal = [[0.0; MOST_TERMS]; MOST_TERMS];
        let mut right = [0.0; MOST_TERMS];
        let whole = self.sums(0.0);
        normal[0][0] = whole[0];
        right[0] = whole[3];
        for row in 1..size {
            let own = self.sums(ramps[row]);
            normal[row][0] = own[1] - ramps[row] * own[0];
            right[row] = own[4] - ramps[row] * own[3];
            for column in 1..=row {
                let both = self.sums(ramps[row].max(ramps[column]));
                normal[row][column] =
                    both[2] - (ramps[row] + ramps[column]) * both[1] + ramps[row] * ramps[column] * both[0];
            }
        }
        explained(&normal, &right, size).map_or(f64::INFINITY, |explained| self.squares - explained)
    }
}

/// Terms of three segments.
const MOST_TERMS: usize = 4;

/// bᵀ A⁻¹ b of the lower triangle of A, by Cholesky; `None` where A is not positive definite.
fn explained(
    matrix: &[[f64; MOST_TERMS]; MOST_TERMS],
    right: &[f64; MOST_TERMS],
    size: usize,
) -> Option<f64> {
    let mut lower = *matrix;
    let mut solved = *right;
    let mut sum = 0.0;
    for row in 0..size {
        for column in 0..row {
            for before in 0..column {
                lower[row][column] -= lower[row][before] * lower[column][before];
            }
            lower[row][column] /= lower[column][column];
            lower[row][row] -= lower[row][column] * lower[row][column];
            solved[row] -= lower[row][column] * solved[column];
        }
        if lower[row][row] <= 1e-14 * matrix[row][row] {
            return None;
        }
        lower[row][row] = lower[row][row].sqrt();
        solved[row] /= lower[row][row];
        sum += solved[row] * solved[row];
    }
    Some(sum)
}

/// The best joints of `count` + 1 segments with at least `least` points each, looked for everywhere, or near
/// those of an earlier search; `None` where they do not fit.
pub fn search(series: &Series, count: usize, least: usize, near: Option<&[f64]>) -> Option<Vec<f64>> {
    let table = Table::of(series);
    let (first, last) = (series.times[0], series.times[series.times.len() - 1]);
    let mut best = Best {
        table: &table,
        least,
        cost: f64::INFINITY,
        joints: Vec::new(),
    };
    match near {
        Some(joints) => best.try_out(
            joints
                .iter()
                .map(|joint| (joint - first) / (last - first))
                .collect(),
        ),
        None => best.everywhere(count),
    }
    if best.joints.is_empty() {
        return None;
    }
    best.refine();
    Some(
        best.joints
            .iter()
            .map(|joint| first + joint * (last - first))
            .collect(),
    )
}

/// The best joints so far.
struct Best<'a> {
    table: &'a Table,
    least: usize,
    cost: f64,
    joints: Vec<f64>,
}

impl Best<'_> {
    fn try_out(&mut self, joints: Vec<f64>) {
        let cost = self.table.cost(&joints, self.least);
        if cost < self.cost {
            (self.cost, self.joints) = (cost, joints);
        }
    }

    fn everywhere(&mut self, count: usize) {
        let places: Vec<f64> = (1..PLACES).map(|index| index as f64 / PLACES as f64).collect();
        for (index, first) in places.iter().enumerate() {
            if count == 1 {
                self.try_out(vec![*first]);
                continue;
            }
            for second in &places[index + 1..] {
                self.try_out(vec![*first, *second]);
            }
        }
    }

    /// Finer and finer grids, each around the best place of the one before; a grid moves on before it shrinks.
    fn refine(&mut self) {
        let mut width = 1.0 / PLACES as f64;
        for _ in 0..MOST_GRIDS {
            let centre = self.joints.clone();
            let offset = |step: i32| f64::from(step) * width / f64::from(SIDE);
            for first in (-SIDE..=SIDE).map(offset) {
                match centre.as_slice() {
                    [one] => self.try_out(vec![one + first]),
                    [one, other] => (-SIDE..=SIDE)
                        .map(offset)
                        .for_each(|second| self.try_out(vec![one + first, other + second])),
                    _ => {}
                }
            }
            let moved = self
                .joints
                .iter()
                .zip(&centre)
                .map(|(new, old)| (new - old).abs());
            if moved.fold(0.0, f64::max) < 0.99 * width {
                width /= 2.0;
            }
            if width < FINEST {
                break;
            }
        }
    }
}
