//! Grains as VTK XML: one `PolyData` file of points per time, and a collection that ParaView opens as a
//! series. In ParaView, `Glyph` with spheres scaled by `diameter` (factor 1) or the representation
//! `Point Gaussian` by `radius` shows the grains in their size.
//!
//! Source: The VTK User's Guide (2010), VTK XML formats; ParaView Guide, `.pvd` collections.

use std::fmt::Write;

use super::csv::number;
use super::{ExportError, Files};
use crate::store::model::Table;

const HEAD: &str = "<?xml version=\"1.0\"?>\n";
/// Values on one line.
const LINE: usize = 12;

/// Name, how many numbers per grain, whether they are whole.
type Array = (&'static str, Vec<f64>, usize, bool);

/// The files of all times in the table.
pub fn files(table: &Table) -> Result<Files, ExportError> {
    let column = |name: &str| {
        let column = table.column(name).map(|column| column.values.as_slice());
        column.ok_or_else(|| ExportError::Nothing(format!("the snapshots have no column `{name}`")))
    };
    let times = column("time")?;
    let mut kept = times.to_vec();
    kept.dedup();
    if kept.is_empty() {
        return Err(ExportError::Nothing("the table of snapshots is empty".to_owned()));
    }
    let digits = (kept.len() - 1).to_string().len().max(4);
    let mut collection = String::new();
    let mut files = Vec::new();
    for (index, time) in kept.iter().enumerate() {
        let rows: Vec<usize> = (0..times.len()).filter(|row| times[*row] == *time).collect();
        let take = |name: &str| -> Result<Vec<f64>, ExportError> {
            let values = column(name)?;
            Ok(rows.iter().map(|row| values[*row]).collect())
        };
        let name = format!("grains_{index:0digits$}.vtp");
        let _ = writeln!(
            collection,
            "<DataSet timestep=\"{}\" group=\"\" part=\"0\" file=\"{name}\"/>",
            number(*time)
        );
        files.push((name, grains(take)?));
    }
    let collection = format!(
        "{HEAD}<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n{collection}\
         </Collection>\n</VTKFile>\n"
    );
    files.push(("grains.pvd".to_owned(), collection));
    Ok(files)
}

/// One `PolyData` file: a point, and a vertex on it, per grain.
fn grains(take: impl Fn(&str) -> Result<Vec<f64>, ExportError>) -> Result<String, ExportError> {
    let places = together([take("x")?, take("y")?, take("z")?]);
    let velocity = together([take("speed_x")?, take("speed_y")?, take("speed_z")?]);
    let speed = velocity
        .chunks(3)
        .map(|parts| parts[0].hypot(parts[1]).hypot(parts[2]))
        .collect();
    let radius = take("radius")?;
    let diameter = radius.iter().map(|radius| 2.0 * radius).collect();
    let count = radius.len();
    let arrays: [Array; 7] = [
        ("grain", take("grain")?, 1, true),
        ("class", take("class")?, 1, true),
        ("radius", radius, 1, false),
        ("diameter", diameter, 1, false),
        ("velocity", velocity, 3, false),
        ("speed", speed, 1, false),
        ("coordination", take("coordination")?, 1, false),
    ];
    let whole = |values: std::ops::Range<usize>| values.map(|value| value as f64).collect::<Vec<_>>();
    let mut text = format!(
        "{HEAD}<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n<PolyData>\n\
         <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" \
         NumberOfPolys=\"0\">\n<PointData Scalars=\"speed\" Vectors=\"velocity\">\n"
    );
    for array in &arrays {
        write_array(&mut text, array);
    }
    text.push_str("</PointData>\n<Points>\n");
    write_array(&mut text, &("points", places, 3, false));
    text.push_str("</Points>\n<Verts>\n");
    write_array(&mut text, &("connectivity", whole(0..count), 1, true));
    write_array(&mut text, &("offsets", whole(1..count + 1), 1, true));
    text.push_str("</Verts>\n</Piece>\n</PolyData>\n</VTKFile>\n");
    Ok(text)
}

/// Three columns as triples.
fn together([x, y, z]: [Vec<f64>; 3]) -> Vec<f64> {
    let triples = x.into_iter().zip(y).zip(z);
    triples.flat_map(|((x, y), z)| [x, y, z]).collect()
}

fn write_array(text: &mut String, (name, values, parts, whole): &Array) {
    let whole = *whole && values.iter().all(|value| value.fract() == 0.0);
    let kind = if whole { "Int64" } else { "Float64" };
    let _ = writeln!(
        text,
        "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{parts}\" format=\"ascii\">"
    );
    for line in values.chunks(LINE) {
        let words: Vec<String> = line
            .iter()
            .map(|value| {
                if whole {
                    format!("{value:.0}")
                } else {
                    number(*value)
                }
            })
            .collect();
        text.push_str(&words.join(" "));
        text.push('\n');
    }
    text.push_str("</DataArray>\n");
}
