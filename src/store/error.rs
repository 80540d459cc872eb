//! What can go wrong with a store, and what to do about it.

use std::io;
use std::path::{Path, PathBuf};

/// Every message says what is wrong, where, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    #[error("the store at {} cannot be written: {source}\n  help: make the folder writable, or name another one with --store", path.display())]
    NotWritable { path: PathBuf, source: io::Error },

    #[error(
        "the disk is full: {} could not be written ({source})\n  help: free some space and run again; \
         results finished before are kept", path.display()
    )]
    Full { path: PathBuf, source: io::Error },

    #[error(
        "the store at {} is in use by {owner}\n  help: wait for it to end, or name another store with --store",
        path.display()
    )]
    InUse { path: PathBuf, owner: String },

    #[error("the store is damaged: {file}: {problem}\n  help: {help}")]
    Damaged {
        file: String,
        problem: String,
        help: String,
    },

    #[error("cannot {action} {}: {source}\n  help: check the disk and the rights of this path", path.display())]
    Io {
        action: &'static str,
        path: PathBuf,
        source: io::Error,
    },

    /// A run that has no place in a table: a fault of the scene that made it.
    #[error(
        "this result cannot be stored: {problem}\n  help: this is a fault of the scene; please report it"
    )]
    Invalid { problem: String },
}

impl StoreError {
    /// Sorts an error of the operating system into what the user can do about it.
    pub(super) fn io(action: &'static str, path: &Path, source: io::Error) -> StoreError {
        use io::ErrorKind::{PermissionDenied, QuotaExceeded, ReadOnlyFilesystem, StorageFull};
        let path = path.to_path_buf();
        match source.kind() {
            StorageFull | QuotaExceeded => StoreError::Full { path, source },
            PermissionDenied | ReadOnlyFilesystem if action != "read" => {
                StoreError::NotWritable { path, source }
            }
            _ => StoreError::Io { action, path, source },
        }
    }

    pub(super) fn damaged(file: &str, problem: impl Into<String>) -> StoreError {
        let help = if file.starts_with("series/") || file.starts_with("profiles/") {
            "run the study again with --fresh, or bring the file back from a copy"
        } else {
            "`kynch verify` lists everything that is wrong; bring the file back from a copy, or move the \
             store away and run again"
        };
        StoreError::Damaged {
            file: file.to_string(),
            problem: problem.into(),
            help: help.to_string(),
        }
    }

    pub(super) fn invalid(problem: impl Into<String>) -> StoreError {
        StoreError::Invalid {
            problem: problem.into(),
        }
    }
}
