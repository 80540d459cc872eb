//! Published data: the CSV tables and citations of a `references/` folder.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use serde::Deserialize;

use super::ReferenceError;
use super::data::DataReference;

/// An opened `references/` folder.
pub struct Library {
    tables: Tables,
    index: Index,
}

/// Where the text of the tables comes from.
enum Tables {
    Folder(PathBuf),
    /// Name and content.
    Carried(&'static [(&'static str, &'static str)]),
}

/// The index and the tables of the repository, as they were when the program was built.
const INDEX: &str = include_str!("../../references/references.yaml");
const TABLES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/tables.rs"));

static CARRIED: LazyLock<Result<Library, ReferenceError>> = LazyLock::new(built_in);

fn built_in() -> Result<Library, ReferenceError> {
    Ok(Library {
        tables: Tables::Carried(TABLES),
        index: index("references.yaml", INDEX)?,
    })
}

#[derive(Deserialize)]
struct Index {
    citations: BTreeMap<String, String>,
    datasets: Vec<DataSetEntry>,
}

/// What `references.yaml` says of a data set.
#[derive(Clone, Debug, Deserialize)]
pub struct DataSetEntry {
    /// File name inside the folder.
    pub file: String,
    pub title: String,
    pub citation_keys: Vec<String>,
    pub provenance: String,
    pub confidence: String,
    /// References by the name that a study calls them: columns of this file.
    #[serde(default)]
    pub references: BTreeMap<String, DataReference>,
}

/// A table of text, numbers on demand. Rows count from zero.
#[derive(Clone, Debug)]
pub struct DataSet {
    /// Where it was read from, for messages.
    name: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Library {
    /// Opens the folder and reads its `references.yaml`.
    ///
    /// # Errors
    /// A missing or malformed index.
    pub fn open(root: &Path) -> Result<Library, ReferenceError> {
        let path = root.join("references.yaml");
        Ok(Library {
            index: index(&path.display().to_string(), &read(&path)?)?,
            tables: Tables::Folder(root.to_path_buf()),
        })
    }

    /// The folder that the program was built with.
    ///
    /// # Errors
    /// A malformed index.
    pub fn carried() -> Result<&'static Library, ReferenceError> {
        CARRIED.as_ref().map_err(Clone::clone)
    }

    /// Opens the folder `references` that lies nearest above a path: that of the studies which use it;
    /// without one, the folder that the program was built with.
    ///
    /// # Errors
    /// A malformed index.
    pub fn above(path: &Path) -> Result<Library, ReferenceError> {
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        let folders = whole.ancestors().skip(1).map(|folder| folder.join("references"));
        let mut indexed = folders.filter(|folder| folder.join("references.yaml").is_file());
        match indexed.next() {
            Some(folder) => Library::open(&folder),
            None => built_in(),
        }
    }

    /// Every data set of the index.
    pub fn datasets(&self) -> &[DataSetEntry] {
        &self.index.datasets
    }

    /// The full citation behind a key.
    pub fn citation(&self, key: &str) -> Option<&str> {
        self.index.citations.get(key).map(String::as_str)
    }

    /// The citations of a data set, one line.
    ///
    /// # Errors
    /// A file or a key that is not in the index.
    pub fn source(&self, file: &str) -> Result<String, ReferenceError> {
        self.cited(file, &self.entry(file)?.citation_keys)
    }

    /// The citations behind some keys, one line; `file` is who cites, for messages.
    ///
    /// # Errors
    /// A key that is not in the index.
    pub fn cited(&self, file: &str, keys: &[String]) -> Result<String, ReferenceError> {
        let citations: Result<Vec<_>, _> = keys
            .iter()
            .map(|key| {
                self.citation(key).ok_or_else(|| {
                    ReferenceError(format!(
                        "references.yaml: {file} cites `{key}`, which has no citation"
                    ))
                })
            })
            .collect();
        Ok(citations?.join("; "))
    }

    /// Reads a data set of the index.
    ///
    /// # Errors
    /// A file that is not in the index, cannot be read, or is no table.
    pub fn dataset(&self, file: &str) -> Result<DataSet, ReferenceError> {
        self.entry(file)?;
        match &self.tables {
            Tables::Folder(root) => DataSet::parse(file, &read(&root.join(file))?),
            Tables::Carried(tables) => {
                let table = tables.iter().find(|(name, _)| *name == file);
                let (_, text) = table.ok_or_else(|| {
                    ReferenceError(format!("references.yaml names `{file}`, which is not there"))
                })?;
                DataSet::parse(file, text)
            }
        }
    }

    fn entry(&self, file: &str) -> Result<&DataSetEntry, ReferenceError> {
        self.datasets()
            .iter()
            .find(|entry| entry.file == file)
            .ok_or_else(|| ReferenceError(format!("references.yaml has no data set `{file}`")))
    }
}

impl DataSet {
    /// Reads CSV text with one header line; quotes as in RFC 4180.
    ///
    /// # Errors
    /// No header, or a row with more or fewer cells than the header.
    pub fn parse(name: &str, text: &str) -> Result<DataSet, ReferenceError> {
        let mut records = records(text).into_iter();
        let header = records
            .next()
            .ok_or_else(|| ReferenceError(format!("{name}: empty, a header line is needed")))?;
        let rows: Vec<_> = records.collect();
        for (index, row) in rows.iter().enumerate() {
            if row.len() != header.len() {
                return Err(ReferenceError(format!(
                    "{name}: data row {} has {} cells, the header has {}",
                    index + 1,
                    row.len(),
                    header.len()
                )));
            }
        }
        Ok(DataSet {
            name: name.to_string(),
            header,
            rows,
        })
    }

    pub fn columns(&self) -> &[String] {
        &self.header
    }

    pub fn len(&self) -> usize {
        self.rows.len()
    }

    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// A column as text.
    ///
    /// # Errors
    /// An unknown column.
    pub fn texts(&self, column: &str) -> Result<Vec<&str>, ReferenceError> {
        let index = self
            .header
            .iter()
            .position(|name| name == column)
            .ok_or_else(|| {
                ReferenceError(format!(
                    "{}: no column `{column}`; there are {}",
                    self.name,
                    self.header.join(", ")
                ))
            })?;
        Ok(self.rows.iter().map(|row| row[index].as_str()).collect())
    }

    /// Two columns as pairs of numbers, of the rows that hold these texts; rows with an empty cell are left out.
    ///
    /// # Errors
    /// An unknown column, a cell that is no number, or no row at all.
    pub fn pairs(
        &self,
        (x, y): (&str, &str),
        rows: &[(String, String)],
    ) -> Result<Vec<(f64, f64)>, ReferenceError> {
        let mut wanted = vec![true; self.len()];
        for (column, text) in rows {
            for (wanted, cell) in wanted.iter_mut().zip(self.texts(column)?) {
                *wanted &= cell == text;
            }
        }
        let number = |column: &str, text: &str| {
            text.parse::<f64>().map_err(|_| {
                ReferenceError(format!(
                    "{}: `{text}` in column `{column}` is no number",
                    self.name
                ))
            })
        };
        let cells = self.texts(x)?.into_iter().zip(self.texts(y)?);
        let mut pairs = Vec::new();
        for ((across, up), _) in cells.zip(wanted).filter(|(_, wanted)| *wanted) {
            if !across.is_empty() && !up.is_empty() {
                pairs.push((number(x, across)?, number(y, up)?));
            }
        }
        match pairs.is_empty() {
            true => Err(ReferenceError(format!("{}: no row fits", self.name))),
            false => Ok(pairs),
        }
    }

    /// A column as numbers.
    ///
    /// # Errors
    /// An unknown column, or a cell that is no number.
    pub fn numbers(&self, column: &str) -> Result<Vec<f64>, ReferenceError> {
        self.texts(column)?
            .into_iter()
            .map(|text| {
                text.parse().map_err(|_| {
                    ReferenceError(format!(
                        "{}: `{text}` in column `{column}` is no number",
                        self.name
                    ))
                })
            })
            .collect()
    }
}

fn index(name: &str, text: &str) -> Result<Index, ReferenceError> {
    serde_saphyr::from_str(text).map_err(|error| ReferenceError(format!("{name}: {error}")))
}

fn read(path: &Path) -> Result<String, ReferenceError> {
    std::fs::read_to_string(path).map_err(|error| ReferenceError(format!("{}: {error}", path.display())))
}

/// Splits CSV text into records; blank lines are skipped.
fn records(text: &str) -> Vec<Vec<String>> {
    let mut records = Vec::new();
    let (mut record, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut characters = text.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => record.push(std::mem::take(&mut cell)),
            '\r' if !quoted => {}
            '\n' if !quoted => {
                if !(record.is_empty() && cell.is_empty()) {
                    record.push(std::mem::take(&mut cell));
                    records.push(std::mem::take(&mut record));
                }
            }
            other => cell.push(other),
        }
    }
    if !(record.is_empty() && cell.is_empty()) {
        record.push(cell);
        records.push(record);
    }
    records
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A data set of the repository, for tests that hold a solution to it.
    pub struct Printed(DataSet);

    pub fn dataset(file: &str) -> Printed {
        Printed(library().dataset(file).unwrap())
    }

    impl Printed {
        pub fn rows(&self) -> usize {
            assert!(!self.0.is_empty());
            self.0.len()
        }

        pub fn text(&self, column: &str, row: usize) -> &str {
            self.0.texts(column).unwrap()[row]
        }

        pub fn number(&self, column: &str, row: usize) -> f64 {
            self.0.numbers(column).unwrap()[row]
        }
    }

    /// Asserts that a value rounds to a number printed with six significant digits, trailing zeros dropped;
    /// a tie may be rounded either way.
    pub fn assert_printed(value: f64, printed: &str) {
        let expected: f64 = printed.parse().unwrap();
        let unit = 10f64.powf(expected.abs().log10().floor() - 5.0);
        assert!(
            (value - expected).abs() <= 0.500_001 * unit,
            "{value} is not {printed}"
        );
    }

    fn library() -> Library {
        Library::open(&folder()).unwrap()
    }

    fn folder() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("references")
    }

    #[test]
    fn every_table_has_an_entry_and_every_entry_a_readable_table() {
        let library = library();
        let mut files: Vec<String> = std::fs::read_dir(folder())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.ends_with(".csv"))
            .collect();
        files.sort();
        let mut entries: Vec<String> = library
            .datasets()
            .iter()
            .map(|entry| entry.file.clone())
            .collect();
        entries.sort();
        assert_eq!(files, entries);
        for file in files {
            assert!(!library.dataset(&file).unwrap().is_empty());
            assert!(!library.source(&file).unwrap().is_empty());
        }
    }

    #[test]
    fn the_program_carries_what_the_folder_holds() {
        let carried = Library::carried().unwrap();
        for entry in library().datasets() {
            let table = carried.dataset(&entry.file).unwrap();
            assert_eq!(table.rows, library().dataset(&entry.file).unwrap().rows);
        }
        assert_eq!(carried.datasets().len(), TABLES.len());
    }

    #[test]
    fn quoted_cells_keep_commas_quotes_and_line_ends() {
        let table = DataSet::parse("x", "a,b\r\n\"1,5\",\"say \"\"so\"\"\nthen\"\n\n2,\n").unwrap();
        assert_eq!(table.texts("a").unwrap(), ["1,5", "2"]);
        assert_eq!(table.texts("b").unwrap(), ["say \"so\"\nthen", ""]);
    }

    #[test]
    fn pairs_come_from_the_rows_that_fit() {
        let table = DataSet::parse(
            "x.csv",
            "case,a,b\nfirst,1,2\nsecond,3,4\nsecond,,6\nsecond,7,wide\n",
        )
        .unwrap();
        let rows = |case: &str| vec![("case".to_string(), case.to_string())];
        assert_eq!(table.pairs(("a", "b"), &rows("first")).unwrap(), [(1.0, 2.0)]);
        let message = |rows: &[(String, String)], y| table.pairs(("a", y), rows).unwrap_err().0;
        assert!(message(&rows("second"), "b").contains("`wide` in column `b`"));
        assert!(message(&rows("third"), "b").contains("no row"));
        assert!(message(&[], "c").contains("case, a, b"));
    }

    #[test]
    fn the_folder_above_a_study_comes_before_the_one_of_the_program() {
        let home = tempfile::tempdir().unwrap();
        let study = home.path().join("studies/deep/one.yaml");
        let datasets = || Library::above(&study).map(|library| library.datasets().len());
        assert_eq!(datasets(), Ok(TABLES.len()));
        let own = home.path().join("references");
        std::fs::create_dir(&own).unwrap();
        std::fs::write(own.join("references.yaml"), "{citations: {}, datasets: []}").unwrap();
        assert_eq!(datasets(), Ok(0));
        std::fs::write(own.join("references.yaml"), "nothing").unwrap();
        assert!(datasets().is_err());
    }

    #[test]
    fn faults_name_the_place() {
        let table = DataSet::parse("x.csv", "a,b\n1,two\n").unwrap();
        assert!(table.numbers("b").unwrap_err().0.contains("`two` in column `b`"));
        assert!(table.texts("c").unwrap_err().0.contains("a, b"));
        assert!(
            DataSet::parse("x.csv", "a,b\n1\n")
                .unwrap_err()
                .0
                .contains("row 1")
        );
        assert!(DataSet::parse("x.csv", "").is_err());
        assert!(library().dataset("nothing.csv").is_err());
        assert!(Library::open(Path::new("nowhere")).is_err());
    }
}
