//! Profiles: height upwards, the quantity along, one line per run.

use super::super::axis::Scale;
use super::super::panel::{Axis, Panel};
use super::lines::{self, Line};
use super::replicates::deviation_of;
use super::{Cell, Material, Plate, Table};
use crate::report::{ReportError, format, selection};
use crate::store::model::{Column, Run};

pub fn draw(material: &Material, of: &str, group: Option<&str>) -> Result<Plate, ReportError> {
    let looks = lines::looks(material, &[of.to_owned()], group);
    let mut drawn = Vec::new();
    let (mut height_axis, mut along_axis) = (None, None);
    for (run, (style, opacity, markers)) in material.runs.iter().zip(&looks.styles) {
        let (height, along) = columns(run, of)?;
        height_axis.get_or_insert((height.name.clone(), height.unit.clone()));
        along_axis.get_or_insert((along.name.clone(), along.unit.clone()));
        drawn.push(Line {
            x: along.values.clone(),
            y: height.values.clone(),
            style: *style,
            opacity: *opacity,
            markers: *markers,
            band: scatter(run, of, along),
        });
    }
    let (height_name, height_unit) = height_axis.unwrap_or_default();
    let (along_name, along_unit) = along_axis.unwrap_or_default();
    let along = format::readable(&along_unit, lines::largest(drawn.iter().flat_map(|line| &line.x)));
    let height = format::readable(
        &height_unit,
        lines::largest(drawn.iter().flat_map(|line| &line.y)),
    );
    let called = format::words(along_name.strip_suffix("_profile").unwrap_or(&along_name));
    let mut panel = Panel::new(
        Axis {
            title: format!("{called}{}", along.in_brackets()),
            scale: Scale::linear(
                drawn
                    .iter()
                    .flat_map(|line| line.all_x().into_iter().map(|x| x * along.factor)),
            ),
        },
        Axis {
            title: format!("{}{}", format::words(&height_name), height.in_brackets()),
            scale: Scale::tight(
                drawn
                    .iter()
                    .flat_map(|line| line.y.iter().map(|y| y * height.factor)),
            ),
        },
    );
    panel.heading = looks.heading;
    for line in &drawn {
        lines::shade(&mut panel, line, (along.factor, height.factor));
    }
    for line in &drawn {
        lines::draw(&mut panel, line, (along.factor, height.factor));
    }
    let suggested = format!("{called} over {}", format::words(&height_name));
    let title = material.title(&suggested);
    let notes = material.captioned(&suggested, looks.note.into_iter().collect());
    let description = format!("{} profiles, height upwards.", drawn.len());
    let drawing = panel.finish(&looks.legend, &material.id(), &title, &description)?;
    let heads = [
        "run".to_owned(),
        format!("{height_name} [{height_unit}]"),
        format!("{along_name} [{along_unit}]"),
        format!("{} [{along_unit}]", deviation_of(&along_name)),
    ];
    let means = drawn.iter().any(|line| line.band.is_some());
    let table = table(material, of, &heads[..if means { 4 } else { 3 }])?;
    Ok(material.plate(title, drawing, notes, table))
}

/// Height and quantity: `of` names a profile table (its second column is drawn) or a column of one.
fn columns<'a>(run: &'a Run, of: &str) -> Result<(&'a Column, &'a Column), ReportError> {
    let whole = run
        .table(of)
        .and_then(|table| Some((table.columns.first()?, table.columns.get(1)?)));
    let profiles = || run.tables.iter().filter(|table| table.name != "time_series");
    let column = || profiles().find_map(|table| Some((table.columns.first()?, table.column(of)?)));
    whole.or_else(column).ok_or_else(|| {
        ReportError(format!(
            "run {} keeps no profile `{of}`: add it to `observe`",
            run.id.0
        ))
    })
}

/// The scatter over seeds of a mean.
fn scatter(run: &Run, of: &str, along: &Column) -> Option<lines::Band> {
    let name = deviation_of(&along.name);
    let table = run.table(of).filter(|table| table.column(&name).is_some());
    let mut profiles = run.tables.iter().filter(|table| table.name != "time_series");
    let column = table.map_or_else(
        || profiles.find_map(|table| table.column(&name)),
        |table| table.column(&name),
    )?;
    let half = column.values.clone();
    Some(lines::Band { half, across: true })
}

fn table(material: &Material, of: &str, head: &[String]) -> Result<Table, ReportError> {
    let mut table = Table {
        head: head.to_vec(),
        rows: Vec::new(),
    };
    for run in &material.runs {
        let (height, along) = columns(run, of)?;
        let label = selection::label(material.study, run);
        let band = scatter(run, of, along);
        for (index, (height, along)) in height.values.iter().zip(&along.values).enumerate() {
            let mut row = vec![
                Cell::Words(label.clone()),
                Cell::Number(*height),
                Cell::Number(*along),
            ];
            row.extend(band.as_ref().map(|band| Cell::Number(band.half[index])));
            table.rows.push(row);
        }
    }
    Ok(table)
}
