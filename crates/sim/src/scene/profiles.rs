//! Profiles over height at the end of a run.

use crate::drag::PolydisperseLaw;
use crate::outcome::{Column, Table};
use crate::simulation::Simulation;

/// Horizontal means of the fluid, one bin per spacing.
pub fn fluid<L: PolydisperseLaw>(simulation: &Simulation<L>) -> Vec<Table> {
    let fluid = &simulation.fluid;
    let spacing = fluid.numerics.spacing;
    let top = fluid.position.iter().map(|x| x.z).fold(0.0, f64::max);
    let bins = (top / spacing) as usize + 1;
    let mut sums = vec![[0.0; 4]; bins];
    for a in 0..fluid.len() {
        let bin = ((fluid.position[a].z / spacing).max(0.0) as usize).min(bins - 1);
        let row = [1.0, fluid.porosity[a], fluid.velocity[a].z, fluid.pressure[a]];
        sums[bin]
            .iter_mut()
            .zip(row)
            .for_each(|(sum, value)| *sum += value);
    }
    // A field on particles means something over a kernel, not from one layer to the next: neighbouring
    // bins are mixed 1 : 2 : 1, which leaves out the wavelength of two spacings that no gradient sees.
    let mixed = |bin: usize| {
        let mut row = sums[bin].map(|sum| 2.0 * sum);
        for near in [bin.wrapping_sub(1), bin + 1] {
            if let Some(other) = sums.get(near) {
                row.iter_mut().zip(other).for_each(|(sum, value)| *sum += value);
            }
        }
        row.map(|sum| sum / row[0])
    };
    let filled: Vec<(f64, [f64; 4])> = (0..bins)
        .filter(|&bin| sums[bin][0] > 0.0)
        .map(|bin| ((bin as f64 + 0.5) * spacing, mixed(bin)))
        .collect();
    let table = |name, column, unit, field: usize| Table {
        name,
        columns: vec![
            Column {
                name: "height",
                unit: "m",
                values: filled.iter().map(|row| row.0).collect(),
            },
            Column {
                name: column,
                unit,
                values: filled.iter().map(|row| row.1[field]).collect(),
            },
        ],
    };
    vec![
        table("porosity_profile", "porosity_profile", "1", 1),
        table("fluid_velocity_profile", "fluid_velocity_profile", "m/s", 2),
        table("pressure_profile", "pressure_profile", "Pa", 3),
    ]
}

/// Mean porosity [-] of the fluid particles within a spacing of the middle of the grains.
pub fn plateau_porosity<L: PolydisperseLaw>(simulation: &Simulation<L>) -> f64 {
    let fluid = &simulation.fluid;
    let middle = middle_height(simulation);
    let near = |a: &usize| (fluid.position[*a].z - middle).abs() < fluid.numerics.spacing;
    let (sum, count) = (0..fluid.len()).filter(near).fold((0.0, 0.0), |(sum, count), a| {
        (sum + fluid.porosity[a], count + 1.0)
    });
    sum / count
}

/// Root mean square departure of the fluid's porosity from its mean over the mean [-], within a height
/// `half` [m] of the middle of the grains.
pub fn porosity_ripple<L: PolydisperseLaw>(simulation: &Simulation<L>, half: f64) -> f64 {
    let fluid = &simulation.fluid;
    let middle = middle_height(simulation);
    let inside: Vec<f64> = (0..fluid.len())
        .filter(|&a| (fluid.position[a].z - middle).abs() < half)
        .map(|a| fluid.porosity[a])
        .collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let centre = mean(&inside);
    let squares: Vec<f64> = inside.iter().map(|value| (value - centre).powi(2)).collect();
    mean(&squares).sqrt() / centre
}

/// Porosity of the fluid particles around the vertical axis of the column, from the bottom.
pub fn axis<L: PolydisperseLaw>(simulation: &Simulation<L>) -> Table {
    let fluid = &simulation.fluid;
    let (axis, reach) = (0.5 * fluid.width, fluid.numerics.spacing);
    let near = |x: f64| (0.0..reach).contains(&(x - axis));
    let mut rows: Vec<(f64, f64)> = (0..fluid.len())
        .filter(|&a| near(fluid.position[a].x) && near(fluid.position[a].y))
        .map(|a| (fluid.position[a].z, fluid.porosity[a]))
        .collect();
    rows.sort_by(|a, b| a.0.total_cmp(&b.0));
    let column = |name, unit, values| Column { name, unit, values };
    Table {
        name: "axis_porosity",
        columns: vec![
            column("height", "m", rows.iter().map(|row| row.0).collect()),
            column("axis_porosity", "1", rows.iter().map(|row| row.1).collect()),
        ],
    }
}

/// Steepest slope [1/m] of a profile: its second column over its first, from one row to the next.
pub fn steepest(profile: &Table) -> f64 {
    let (heights, values) = (&profile.columns[0].values, &profile.columns[1].values);
    (heights.windows(2).zip(values.windows(2)))
        .map(|(z, value)| ((value[1] - value[0]) / (z[1] - z[0])).abs())
        .fold(0.0, f64::max)
}

/// Mean height of the grains [m].
fn middle_height<L: PolydisperseLaw>(simulation: &Simulation<L>) -> f64 {
    let grains = &simulation.grains.grains;
    grains.iter().map(|grain| grain.position.z).sum::<f64>() / grains.len() as f64
}

/// Means over each horizontal layer of grains: the porosity they see, slip and drag.
pub fn layers<L: PolydisperseLaw>(simulation: &Simulation<L>, layers: usize) -> Vec<Table> {
    if layers == 0 {
        return Vec::new();
    }
    let grains = &simulation.grains.grains;
    let per_layer = grains.len() / layers;
    let mean = |values: &[f64]| -> Vec<f64> {
        values
            .chunks(per_layer)
            .map(|layer| layer.iter().sum::<f64>() / layer.len() as f64)
            .collect()
    };
    let (slip, drag): (Vec<f64>, Vec<f64>) = (0..grains.len()).map(|i| simulation.slip_and_drag(i)).unzip();
    let porosity: Vec<f64> = (0..grains.len()).map(|i| simulation.porosity_at(i)).collect();
    let heights = mean(&grains.iter().map(|grain| grain.position.z).collect::<Vec<_>>());
    let table = |name, unit, values: &[f64]| Table {
        name,
        columns: vec![
            Column {
                name: "height",
                unit: "m",
                values: heights.clone(),
            },
            Column {
                name,
                unit,
                values: mean(values),
            },
        ],
    };
    vec![
        table("grain_porosity", "1", &porosity),
        table("grain_slip", "m/s", &slip),
        table("grain_drag", "N", &drag),
    ]
}
