//! From runs and verdicts to pages and figures.

use std::path::{Path, PathBuf};

use crate::judge::model::Verdict;
use crate::store::model::Run;
use crate::study::model::{Figure, Study};

mod axis;
mod calibrated;
mod canvas;
mod colour_map;
mod cost;
mod facts;
mod figure;
pub mod format;
mod junit;
mod legend;
mod mark;
mod numbers;
mod page;
mod panel;
mod selection;
mod table;
#[cfg(test)]
mod tests;
mod theme;
pub mod told;
mod verdict_row;

use figure::Plate;
use numbers::Numbers;

#[derive(Clone, Debug, thiserror::Error)]
#[error("{0}")]
pub struct ReportError(pub String);

/// Writes `index.html`, `report.md`, `verdicts.json`, `junit.xml`, `runs.csv` and the figures with
/// their data into `out` (`reports/<study>/`); gives back the path of `index.html`. The same study,
/// runs and verdicts give the same bytes.
///
/// # Errors
/// A file that cannot be written. A figure that cannot be drawn is no error: the page says why.
pub fn render(study: &Study, runs: &[Run], verdicts: &[Verdict], out: &Path) -> Result<PathBuf, ReportError> {
    render_with(study, runs, verdicts, out, &Numbers::JUDGED)
}

fn render_with(
    study: &Study,
    runs: &[Run],
    verdicts: &[Verdict],
    out: &Path,
    numbers: &Numbers,
) -> Result<PathBuf, ReportError> {
    let folder = out.join("figures");
    clear(&folder)?;
    let plates: Vec<(&Figure, Result<Plate, ReportError>)> = study
        .figures
        .iter()
        .map(|figure| (figure, figure::draw(study, runs, figure, numbers)))
        .collect();
    for plate in plates.iter().filter_map(|(_, plate)| plate.as_ref().ok()) {
        write(&folder.join(format!("{}.svg", plate.id)), plate.svg.as_bytes())?;
        write(
            &folder.join(format!("{}.csv", plate.id)),
            plate.table.csv().as_bytes(),
        )?;
    }
    let mut frame = table::frame(study, runs)?;
    let effort = table::effort(&frame, &table::counters(runs))?;
    write(&out.join("runs.csv"), &table::csv(&mut frame)?)?;
    write(&out.join("verdicts.json"), &json(verdicts)?)?;
    let told = told::told(study, runs, verdicts);
    write(
        &out.join("junit.xml"),
        junit::write(study, runs, &told)?.as_bytes(),
    )?;
    let page = page::Page::new(study, runs, &told, &plates, &effort);
    write(&out.join("report.md"), page.markdown()?.as_bytes())?;
    let index = out.join("index.html");
    write(&index, page.html()?.as_bytes())?;
    Ok(index)
}

fn json(verdicts: &[Verdict]) -> Result<Vec<u8>, ReportError> {
    let mut text = serde_json::to_vec_pretty(verdicts)
        .map_err(|error| ReportError(format!("verdicts.json cannot be made: {error}")))?;
    text.push(b'\n');
    Ok(text)
}

/// An empty figure folder: figures of an earlier form of the study must not stay behind.
fn clear(folder: &Path) -> Result<(), ReportError> {
    let failed = |error| ReportError(format!("cannot prepare {}: {error}", folder.display()));
    std::fs::create_dir_all(folder).map_err(failed)?;
    for entry in std::fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path
            .extension()
            .is_some_and(|kind| kind == "svg" || kind == "csv")
        {
            std::fs::remove_file(&path).map_err(failed)?;
        }
    }
    Ok(())
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    std::fs::write(path, bytes).map_err(|error| {
        ReportError(format!(
            "cannot write {}: {error}; choose another folder with --out",
            path.display()
        ))
    })
}
