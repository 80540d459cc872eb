//! Study files: finding, reading and checking them.

use std::fs;
use std::path::{Path, PathBuf};

use super::assemble::parse;
use super::model::Study;
use super::nearest::advice;
use super::problem::{Problems, StudyError};
use super::yaml::{self, Value};

/// Folder of the studies that are called by name.
const FOLDER: &str = "studies";

/// Largest study file [bytes].
const LARGEST: u64 = 1 << 20;

/// A line of `kynch list`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    pub name: String,
    pub meaning: String,
}

/// The file behind a study name: `studies/NAME.yaml`, or the path itself when it is one.
///
/// # Errors
/// When there is no such file; the message names the nearest study.
pub fn find(name: &str) -> Result<PathBuf, StudyError> {
    let path = PathBuf::from(name);
    let is_path = name.ends_with(".yaml") || name.ends_with(".yml") || path.components().count() > 1;
    if is_path && path.exists() {
        return Ok(path);
    }
    let named = folder().join(format!("{name}.yaml"));
    if !is_path || named.is_file() {
        if named.is_file() {
            return Ok(named);
        }
        let entries = list();
        let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        let message = format!("there is no study `{name}`");
        return Err(StudyError::of_file(&named, &message, &advice(name, &names)));
    }
    Err(StudyError::of_file(
        &path,
        "there is no such file",
        "check the path; a name alone is looked up in studies/",
    ))
}

/// `studies/` here, or in the nearest folder above that has one.
fn folder() -> PathBuf {
    let here = PathBuf::from(FOLDER);
    if here.is_dir() {
        return here;
    }
    let above = std::env::current_dir().unwrap_or_default();
    let mut folders = above.ancestors().map(|folder| folder.join(FOLDER));
    folders.find(|folder| folder.is_dir()).unwrap_or(here)
}

/// Parses, checks and expands a study file.
///
/// # Errors
/// Everything wrong with it, all at once.
pub fn load(path: &Path) -> Result<Study, StudyError> {
    parse(path, &read(path)?)
}

fn read(path: &Path) -> Result<String, StudyError> {
    let fault = |message: &str, help: &str| StudyError::of_file(path, message, help);
    let about = match fs::metadata(path) {
        Ok(about) => about,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Err(fault(
                "there is no such file",
                "check the path; a name alone is looked up in studies/",
            ));
        }
        Err(error) => {
            return Err(fault(
                &format!("the file cannot be read: {error}"),
                "check its permissions",
            ));
        }
    };
    if about.is_dir() {
        return Err(fault(
            "this is a directory, not a study file",
            "name a file in it",
        ));
    }
    if !about.is_file() {
        return Err(fault("this is not a plain file", "write the study to a file"));
    }
    if about.len() > LARGEST {
        let size = about.len() as f64 / 1e6;
        let message = format!("the file is {size:.1} MB large, a study has at most 1 MB");
        return Err(fault(&message, "is this really a study file?"));
    }
    let bytes = match fs::read(path) {
        Ok(bytes) => bytes,
        Err(error) => {
            return Err(fault(
                &format!("the file cannot be read: {error}"),
                "check its permissions",
            ));
        }
    };
    String::from_utf8(bytes).map_err(|error| {
        let at = error.utf8_error().valid_up_to();
        let line = 1 + error.as_bytes()[..at]
            .iter()
            .filter(|byte| **byte == b'\n')
            .count();
        fault(
            &format!("the file is not UTF-8 text: line {line} holds a byte that is not"),
            "save it as UTF-8",
        )
    })
}

/// Every study below `studies/`, with its question.
pub fn list() -> Vec<Entry> {
    let mut entries = Vec::new();
    gather(&folder(), "", &mut entries);
    entries.sort_by(|left, right| left.name.cmp(&right.name));
    entries
}

fn gather(folder: &Path, prefix: &str, entries: &mut Vec<Entry>) {
    for item in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = item.path();
        let stem = path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let is_folder = item.file_type().is_ok_and(|kind| kind.is_dir());
        if is_folder && prefix.len() < 200 {
            gather(&path, &format!("{prefix}{stem}/"), entries);
        } else if path.extension().is_some_and(|extension| extension == "yaml") {
            entries.push(Entry {
                name: format!("{prefix}{stem}"),
                meaning: question(&path),
            });
        }
    }
}

fn question(path: &Path) -> String {
    let text = read(path).unwrap_or_default();
    let tree = yaml::parse(&text, &mut Problems::default());
    match tree
        .as_ref()
        .and_then(|tree| tree.get("question"))
        .map(|node| &node.value)
    {
        Some(Value::Text(question)) => question.clone(),
        _ => "(cannot be read)".to_owned(),
    }
}

/// Every scene a study may name, with one line each.
pub fn scenes() -> Vec<Entry> {
    choices("SceneSpec")
}

/// Every way to make a number of series, with one line each.
pub fn derivations() -> Vec<Entry> {
    choices("DerivedSpec")
}

/// Every kind of expectation, with one line each.
pub fn expectations() -> Vec<Entry> {
    choices("ExpectationSpec")
}

/// Every kind of figure, with one line each.
pub fn figures() -> Vec<Entry> {
    choices("FigureSpec")
}

/// Names and first lines of what a study file chooses from.
fn choices(of: &str) -> Vec<Entry> {
    let schema = super::schema();
    let variants = schema["$defs"][of]["oneOf"].as_array().into_iter().flatten();
    variants
        .filter_map(|variant| {
            let name = variant["properties"].as_object()?.keys().next()?.clone();
            let meaning = variant["description"]
                .as_str()
                .unwrap_or_default()
                .replace('\n', " ");
            Some(Entry { name, meaning })
        })
        .collect()
}
