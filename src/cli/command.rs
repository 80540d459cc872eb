//! What the arguments mean: commands with every value understood that needs no study to be understood.

use std::path::PathBuf;
use std::time::Duration;

use clap::CommandFactory;
use clap_complete::Shell;

use super::arguments::{Action, Arguments, Choice, ExportFormat, Extract, Limits, Place, Reporting, Studies};
use super::magnitude::{bytes, duration};
use super::selection::only;
use super::status::Problem;
use crate::export::{Format, Wanted};
use crate::runner::Options;

/// One thing to do.
#[derive(Debug)]
pub enum Command {
    Study(Job, Reporting),
    Plan(Job),
    Run(Job),
    Report(Job, Reporting),
    Export(Job, Extraction),
    List,
    Explain(Vec<String>),
    Schema,
    Verify(PathBuf),
    Completions(Shell),
}

/// One point's tables for other programs.
#[derive(Debug)]
pub struct Extraction {
    pub point: Option<usize>,
    pub wanted: Wanted,
    pub out: PathBuf,
}

/// Some studies, the store they live in and how to treat their points.
#[derive(Debug)]
pub struct Job {
    pub names: Vec<String>,
    pub store: PathBuf,
    pub options: Options,
}

impl Command {
    /// Makes sense of what was typed.
    ///
    /// # Errors
    /// A [`Problem`] of bad input for a value that cannot be understood.
    pub fn from_arguments(arguments: Arguments) -> Result<Command, Problem> {
        Ok(match arguments.action {
            Action::Study {
                studies,
                place,
                choice,
                limits,
                reporting,
            } => match Job::new(studies, place, choice, Some(&limits))? {
                job if limits.dry_run => Command::Plan(job),
                job => Command::Study(job, reporting),
            },
            Action::Run {
                studies,
                place,
                choice,
                limits,
            } => match Job::new(studies, place, choice, Some(&limits))? {
                job if limits.dry_run => Command::Plan(job),
                job => Command::Run(job),
            },
            Action::Plan {
                studies,
                place,
                choice,
                limits,
            } => Command::Plan(Job::new(studies, place, choice, Some(&limits))?),
            Action::Report {
                studies,
                place,
                replicates,
                reporting,
            } => {
                let everything = Choice {
                    only: Vec::new(),
                    replicates,
                };
                Command::Report(Job::new(studies, place, everything, None)?, reporting)
            }
            Action::Export {
                name,
                place,
                choice,
                extract,
            } => {
                let studies = Studies { names: vec![name] };
                let extraction = Extraction::new(extract)?;
                Command::Export(Job::new(studies, place, choice, None)?, extraction)
            }
            Action::List => Command::List,
            Action::Explain { studies } => Command::Explain(studies.names),
            Action::Schema => Command::Schema,
            Action::Verify { place } => Command::Verify(place.store),
            Action::Completions { shell } => Command::Completions(shell),
        })
    }
}

impl Extraction {
    fn new(extract: Extract) -> Result<Extraction, Problem> {
        let format = match extract.format {
            ExportFormat::Vtk => Format::Vtk,
            ExportFormat::Csv => Format::Csv,
        };
        Ok(Extraction {
            point: extract.point,
            wanted: Wanted {
                format,
                time: understood("--time", &extract.time, instant)?,
                table: extract.table,
            },
            out: extract.out,
        })
    }
}

/// A time of a run [s]: a number, or one with a unit, blanks or none between them.
fn instant(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let digits = |letter: char| letter.is_ascii_digit() || "+-.".contains(letter);
    let unit = text
        .find(|letter: char| !digits(letter) && letter != 'e')
        .unwrap_or(text.len());
    let (number, unit) = (text[..unit].trim(), text[unit..].trim());
    let factor = match unit {
        "" | "s" => Some(1.0),
        "ms" => Some(1e-3),
        "us" | "µs" => Some(1e-6),
        "min" => Some(60.0),
        _ => None,
    };
    let value = number.parse::<f64>().ok().filter(|number| number.is_finite());
    let known = value.zip(factor).map(|(number, factor)| number * factor);
    known.ok_or_else(|| format!("`{text}` is no time; write 0.1s, 20ms or a number of seconds"))
}

impl Job {
    fn new(studies: Studies, place: Place, choice: Choice, limits: Option<&Limits>) -> Result<Job, Problem> {
        let mut options = Options {
            seeds: choice.replicates.seeds,
            ..Options::default()
        };
        if let Some(limits) = limits {
            options.jobs = limits.jobs;
            options.limit = limits.limit;
            options.timeout =
                understood("--timeout", &limits.timeout, duration)?.map(Duration::from_secs_f64);
            options.memory = understood("--memory", &limits.memory, bytes)?;
            options.max_failures = limits.max_failures;
            options.fresh = limits.fresh;
        }
        for text in &choice.only {
            options.only.extend(only(text).map_err(Problem::Input)?);
        }
        Ok(Job {
            names: studies.names,
            store: place.store,
            options,
        })
    }
}

/// The value behind a flag, with the flag named in what goes wrong.
fn understood<T>(
    flag: &str,
    text: &Option<String>,
    read: fn(&str) -> Result<T, String>,
) -> Result<Option<T>, Problem> {
    let value = text.as_deref().map(read).transpose();
    value.map_err(|why| Problem::Input(format!("{flag}: {why}")))
}

/// A completion script for a shell.
pub fn completions(shell: Shell) -> String {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "kynch", &mut script);
    String::from_utf8_lossy(&script).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    fn command(typed: &str) -> Result<Command, Problem> {
        Command::from_arguments(Arguments::try_parse_from(typed.split(' ')).expect("typed correctly"))
    }

    #[test]
    fn a_dry_run_is_a_plan() {
        assert!(matches!(command("kynch run a --dry-run"), Ok(Command::Plan(_))));
        assert!(matches!(command("kynch study a --dry-run"), Ok(Command::Plan(_))));
        assert!(matches!(command("kynch study a"), Ok(Command::Study(..))));
    }

    #[test]
    fn limits_reach_the_options() {
        let typed =
            "kynch run a b --jobs 3 --limit 4 --seeds 5 --timeout 10m --memory 2GiB --max-failures 6 --fresh";
        let Ok(Command::Run(job)) = command(typed) else {
            panic!("not a run")
        };
        assert_eq!(job.names, ["a", "b"]);
        let options = &job.options;
        assert_eq!(
            (options.jobs, options.limit, options.seeds),
            (Some(3), Some(4), Some(5))
        );
        assert_eq!(options.timeout, Some(Duration::from_secs(600)));
        assert_eq!(options.memory, Some(2 << 30));
        assert_eq!((options.max_failures, options.fresh), (Some(6), true));
    }

    #[test]
    fn folders_have_defaults() {
        let Ok(Command::Report(job, reporting)) = command("kynch report a") else {
            panic!("not a report")
        };
        assert_eq!(job.store, PathBuf::from("store"));
        assert_eq!(reporting.out, PathBuf::from("reports"));
        assert!(!reporting.strict);
    }

    #[test]
    fn a_value_that_makes_no_sense_names_its_flag() {
        let problem = command("kynch run a --timeout soon").unwrap_err();
        assert_eq!(
            problem.to_string(),
            "--timeout: `soon` is no time; write 90s, 10m or 2h"
        );
        let problem = command("kynch run a --only spacing").unwrap_err();
        assert!(problem.to_string().starts_with("--only spacing: "));
    }

    #[test]
    fn times_of_a_run_may_carry_units() {
        for (text, seconds) in [
            ("0.5", 0.5),
            ("20ms", 0.02),
            ("1e-3 s", 1e-3),
            ("5us", 5e-6),
            ("1min", 60.0),
        ] {
            let found = instant(text).unwrap_or(f64::NAN);
            assert!((found / seconds - 1.0).abs() < 1e-12, "{text}: {found}");
        }
        for text in ["soon", "", "3 m", "ms", "nan", "1..2"] {
            assert!(instant(text).is_err(), "{text}");
        }
    }

    #[test]
    fn completions_name_the_commands() {
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
            let script = completions(shell);
            assert!(
                script.contains("explain") && script.contains("max-failures"),
                "{shell}"
            );
        }
    }
}
