//! What was typed: flags and names, before anything is made of them.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;

const EXIT_CODES: &str = "Exit codes: 0 everything held · 1 an expectation failed (with --strict: or could not be decided) · \
2 bad input or nothing selected · 3 points missing or failed, also after Ctrl-C · 5 store or report folder damaged or not writable. \
When several apply: 2, then 5, then 3, then 1.";

/// Validation harness for settling simulations: one study file in, one verdict out.
#[derive(Debug, Parser)]
#[command(name = "kynch", version, after_help = EXIT_CODES, max_term_width = 110)]
pub struct Arguments {
    #[command(subcommand)]
    pub action: Action,
}

#[derive(Debug, Subcommand)]
pub enum Action {
    /// Run what is missing of each study, judge it and write its report
    Study {
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        place: Place,
        #[command(flatten)]
        choice: Choice,
        #[command(flatten)]
        limits: Limits,
        #[command(flatten)]
        reporting: Reporting,
    },
    /// Show every point, what is cached, what will run and why, with its physics and cost; runs nothing
    Plan {
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        place: Place,
        #[command(flatten)]
        choice: Choice,
        #[command(flatten)]
        limits: Limits,
    },
    /// Run what is missing of each study, without judging it
    Run {
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        place: Place,
        #[command(flatten)]
        choice: Choice,
        #[command(flatten)]
        limits: Limits,
    },
    /// Judge each study and write its report from the store alone; never runs physics
    Report {
        #[command(flatten)]
        studies: Studies,
        #[command(flatten)]
        place: Place,
        #[command(flatten)]
        replicates: Replicates,
        #[command(flatten)]
        reporting: Reporting,
    },
    /// Write the stored tables of one point for other programs: CSV, or VTK for ParaView
    Export {
        /// Name of a file in studies/ (here or in a folder above), or a path to a study file
        #[arg(value_name = "STUDY")]
        name: String,
        #[command(flatten)]
        place: Place,
        #[command(flatten)]
        choice: Choice,
        #[command(flatten)]
        extract: Extract,
    },
    /// List studies, scenes, drag laws and references, one line each
    List,
    /// Put the scenes of each study into words: equations, dimensionless numbers, warnings
    Explain {
        #[command(flatten)]
        studies: Studies,
    },
    /// Print the JSON Schema of a study file, for editors
    Schema,
    /// Check every file of the store against its checksum; find orphans and torn files
    Verify {
        #[command(flatten)]
        place: Place,
    },
    /// Print a completion script
    Completions { shell: Shell },
}

#[derive(Debug, Args)]
pub struct Studies {
    /// Name of a file in studies/ (here or in a folder above), or a path to a study file
    #[arg(required = true, value_name = "NAME")]
    pub names: Vec<String>,
}

#[derive(Debug, Args)]
pub struct Place {
    /// Folder that keeps the results
    #[arg(long, value_name = "DIR", default_value = "store")]
    pub store: PathBuf,
}

#[derive(Debug, Args)]
pub struct Choice {
    /// Run only points with this value of an axis, of `scene` or of a setting; repeat to narrow down
    #[arg(long, value_name = "AXIS=VALUE[,VALUE]")]
    pub only: Vec<String>,
    #[command(flatten)]
    pub replicates: Replicates,
}

#[derive(Debug, Args)]
pub struct Extract {
    /// The point by its number in `kynch plan`
    #[arg(long, value_name = "N", conflicts_with = "only")]
    pub point: Option<usize>,
    /// Only the kept time nearest to this one: 0.1s, 20ms
    #[arg(long, value_name = "TIME")]
    pub time: Option<String>,
    /// csv: every table; vtk: the grains of the snapshots
    #[arg(long, value_enum)]
    pub format: ExportFormat,
    /// Only this table
    #[arg(long, value_name = "NAME")]
    pub table: Option<String>,
    /// Folder that receives the files
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ExportFormat {
    Vtk,
    Csv,
}

#[derive(Debug, Args)]
pub struct Replicates {
    /// Seeds 1 to N in place of the study's
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub seeds: Option<u64>,
}

#[derive(Debug, Args)]
pub struct Limits {
    /// Threads at a time; a point takes as many as its scene asks for [default: the cores there are]
    #[arg(long, value_name = "N", value_parser = positive)]
    pub jobs: Option<usize>,
    /// At most N of the points that are due
    #[arg(long, value_name = "N", value_parser = positive)]
    pub limit: Option<usize>,
    /// End a point after this time: 90s, 10m, 2h
    #[arg(long, value_name = "TIME")]
    pub timeout: Option<String>,
    /// End a point above this memory: 500MB, 2GiB
    #[arg(long, value_name = "SIZE")]
    pub memory: Option<String>,
    /// Start no more points after N failures
    #[arg(long, value_name = "N", value_parser = positive)]
    pub max_failures: Option<usize>,
    /// Run points again though they are finished
    #[arg(long)]
    pub fresh: bool,
    /// Where points run: on threads of this process
    #[arg(long, value_enum, default_value_t = Executor::Local)]
    pub executor: Executor,
    /// Show the plan and run nothing
    #[arg(long)]
    pub dry_run: bool,
}

#[derive(Debug, Args)]
pub struct Reporting {
    /// Folder that receives one report folder per study
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Let an expectation that cannot be decided count as failed
    #[arg(long)]
    pub strict: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Executor {
    Local,
}

fn positive(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) => Err("give at least 1".into()),
        Ok(number) => Ok(number),
        Err(_) => Err("give a whole number, 1 or more".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;
    use clap::error::ErrorKind;

    #[test]
    fn the_declaration_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn usage_errors_leave_with_2_and_help_with_0() {
        for (typed, code) in [
            ("kynch", 2),
            ("kynch study", 2),
            ("kynch study a --jobs 0", 2),
            ("kynch study a --jobs -3", 2),
            ("kynch run a --limit 0", 2),
            ("kynch run a --seeds 0", 2),
            ("kynch run a --executor slurm", 2),
            ("kynch fly a", 2),
            ("kynch --help", 0),
            ("kynch --version", 0),
        ] {
            let error = Arguments::try_parse_from(typed.split(' ')).expect_err(typed);
            assert_eq!(error.exit_code(), code, "{typed}");
        }
    }

    #[test]
    fn the_help_tells_the_exit_codes() {
        let error = Arguments::try_parse_from(["kynch", "--help"]).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::DisplayHelp);
        assert!(error.to_string().contains("Exit codes"));
    }
}
