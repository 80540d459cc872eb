//! Cost against error: which points no other beats.

use crate::store::model::Run;

/// What a run costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Wall time [s].
    Wall,
    /// CPU time [s].
    Cpu,
    /// A work counter by name: the same on every machine.
    Counter(String),
}

impl Cost {
    /// The cost of a run; `None` for a counter it does not have.
    pub fn of(&self, run: &Run) -> Option<f64> {
        match self {
            Cost::Wall => Some(run.timing.wall),
            Cost::Cpu => Some(run.timing.cpu),
            Cost::Counter(name) => run
                .counters
                .iter()
                .find(|(counter, _)| counter == name)
                .map(|(_, count)| *count as f64),
        }
    }
}

/// Indices of the (cost, error) points for which no other is as good in both and better in one, in order of
/// cost, then index. Equal points are all on the front; points that are not finite never are.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let finite = |&index: &usize| points[index].0.is_finite() && points[index].1.is_finite();
    let mut order: Vec<usize> = (0..points.len()).filter(finite).collect();
    order.sort_by(|&a, &b| {
        let (first, second) = (points[a], points[b]);
        first
            .0
            .total_cmp(&second.0)
            .then(first.1.total_cmp(&second.1))
            .then(a.cmp(&b))
    });
    let mut front: Vec<usize> = Vec::new();
    for index in order {
        match front.last().map(|&last| points[last]) {
            Some(best) if points[index].1 >= best.1 && points[index] != best => {}
            _ => front.push(index),
        }
    }
    front
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn keeps_the_cheap_and_the_exact_and_drops_the_beaten() {
        let points = [(1.0, 0.1), (2.0, 0.2), (3.0, 0.01), (3.0, 0.02), (4.0, 0.01)];
        assert_eq!(front(&points), [0, 2]);
    }

    #[test]
    fn ties_stay_in_order_and_the_infinite_goes() {
        let points = [(2.0, 0.1), (1.0, f64::NAN), (2.0, 0.1), (f64::INFINITY, 0.0)];
        assert_eq!(front(&points), [0, 2]);
        assert!(front(&[]).is_empty());
    }

    proptest! {
        #[test]
        fn is_exactly_the_points_nobody_beats(points in prop::collection::vec((0u8..8, 0u8..8), 0..30)) {
            let points: Vec<(f64, f64)> = points.iter().map(|&(a, b)| (a.into(), b.into())).collect();
            let front = front(&points);
            for (index, point) in points.iter().enumerate() {
                let beaten = points.iter().any(|other| other.0 <= point.0 && other.1 <= point.1 && other != point);
                prop_assert_eq!(front.contains(&index), !beaten);
            }
        }
    }
}
