//! How a command ended: exit codes and what went wrong.

use std::process::ExitCode;

use crate::export::ExportError;
use crate::report::ReportError;
use crate::runner::RunError;
use crate::store::StoreError;
use crate::study::StudyError;

/// The end of a command, mildest first: of several, the last one decides the exit code.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Everything held.
    #[default]
    Held,
    /// An expectation failed, or, when strict, could not be decided.
    Failed,
    /// Points are missing or did not complete.
    Incomplete,
    /// The store or the report folder is damaged or cannot be written.
    Damaged,
    /// What was typed, or the study file, makes no sense; or nothing was selected.
    BadInput,
}

impl Status {
    pub fn code(self) -> u8 {
        match self {
            Status::Held => 0,
            Status::Failed => 1,
            Status::BadInput => 2,
            Status::Incomplete => 3,
            Status::Damaged => 5,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> ExitCode {
        ExitCode::from(status.code())
    }
}

/// What kept a command from doing its work.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    #[error("{0}")]
    Input(String),
    #[error(transparent)]
    Study(#[from] StudyError),
    #[error(transparent)]
    Store(#[from] StoreError),
    #[error(transparent)]
    Report(#[from] ReportError),
    #[error(transparent)]
    Export(#[from] ExportError),
    /// The point asked for has no completed run.
    #[error("{0}")]
    Missing(String),
    #[error("interrupted; what is finished is kept, the same command goes on from there")]
    Interrupted,
    #[error("cannot write the output: {0}")]
    Output(#[from] std::io::Error),
}

impl Problem {
    pub fn status(&self) -> Status {
        match self {
            Problem::Input(_) | Problem::Study(_) | Problem::Export(ExportError::Nothing(_)) => {
                Status::BadInput
            }
            Problem::Interrupted | Problem::Missing(_) => Status::Incomplete,
            Problem::Store(_) | Problem::Report(_) | Problem::Export(_) | Problem::Output(_) => {
                Status::Damaged
            }
        }
    }
}

impl From<RunError> for Problem {
    fn from(error: RunError) -> Problem {
        match error {
            RunError::Input(text) => Problem::Input(text),
            RunError::Store(error) => Problem::Store(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_several_ends_bad_input_goes_before_damage_before_gaps_before_failures() {
        let worst_first = [2, 5, 3, 1, 0];
        let mut all = [
            Status::Held,
            Status::Incomplete,
            Status::Failed,
            Status::BadInput,
            Status::Damaged,
        ];
        all.sort();
        all.reverse();
        assert_eq!(all.map(Status::code), worst_first);
        assert_eq!(Status::Failed.max(Status::Incomplete).code(), 3);
    }

    #[test]
    fn problems_know_their_end() {
        let full = std::io::Error::from(std::io::ErrorKind::StorageFull);
        assert_eq!(
            Problem::from(RunError::Input("x".into())).status(),
            Status::BadInput
        );
        assert_eq!(Problem::from(full).status(), Status::Damaged);
        assert_eq!(Problem::Interrupted.status(), Status::Incomplete);
    }
}
