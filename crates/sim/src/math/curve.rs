//! An order along which neighbours in space are neighbours in memory.

use std::cmp::Ordering;

/// Indices of places [m] along Morton's curve through cells of a `width` [m]. The order follows from the
/// places alone, not from the order they come in.
///
/// Source: Morton (1966), A computer oriented geodetic data base.
pub fn along_curve(places: &[[f64; 3]], width: f64) -> Vec<u32> {
    let mut low = [f64::INFINITY; 3];
    for place in places {
        (0..3).for_each(|axis| low[axis] = low[axis].min(place[axis]));
    }
    let mut order: Vec<(u64, u32)> = places
        .iter()
        .zip(0..)
        .map(|(place, index)| {
            let cell = [0, 1, 2].map(|axis| ((place[axis] - low[axis]) / width) as u64);
            (interleaved(cell), index)
        })
        .collect();
    let tie = |one: u32, other: u32| {
        let (one, other) = (&places[one as usize], &places[other as usize]);
        (0..3).fold(Ordering::Equal, |order, axis| {
            order.then(one[axis].total_cmp(&other[axis]))
        })
    };
    order.sort_unstable_by(|one, other| one.0.cmp(&other.0).then_with(|| tie(one.1, other.1)));
    order.into_iter().map(|(_, index)| index).collect()
}

/// Morton's order: the bits of three numbers in turn. Numbers beyond 2²¹ count as 2²¹.
fn interleaved(cell: [u64; 3]) -> u64 {
    let spread = |number: u64| {
        let mut bits = number.min((1 << 21) - 1);
        for (shift, mask) in [
            (32, 0x001f_0000_0000_ffff),
            (16, 0x001f_0000_ff00_00ff),
            (8, 0x100f_00f0_0f00_f00f),
            (4, 0x10c3_0c30_c30c_30c3),
            (2, 0x1249_2492_4924_9249),
        ] {
            bits = (bits | bits << shift) & mask;
        }
        bits
    };
    spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interleaving_keeps_every_bit() {
        assert_eq!(interleaved([0b11, 0b00, 0b10]), 0b101_001);
        assert_eq!(interleaved([0, 1 << 20, 0]), 1 << 61);
        assert_eq!(interleaved([u64::MAX; 3]), (1 << 63) - 1);
    }

    #[test]
    fn the_order_follows_from_the_places_alone() {
        let places: Vec<[f64; 3]> = (0..50)
            .map(|i| [0.37, 0.73, 0.19].map(|step| (f64::from(i) * step).fract()))
            .collect();
        let turned: Vec<[f64; 3]> = places.iter().rev().copied().collect();
        let along = |places: &[[f64; 3]]| -> Vec<[f64; 3]> {
            let order = along_curve(places, 0.3);
            order.into_iter().map(|index| places[index as usize]).collect()
        };
        assert_eq!(along(&places), along(&turned));
        assert_ne!(along(&places), places);
    }
}
