//! Results on disk: Parquet files that survive a crash and tell when they are damaged.

pub mod model;

use std::collections::HashMap;
use std::path::Path;

use model::{PointId, Run, Status};

#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct StoreError(pub String);

pub struct Store {}

/// One thing `verify` found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    pub file: String,
    pub problem: String,
}

impl Store {
    /// Opens or creates a store.
    pub fn open(_dir: &Path) -> Result<Store, StoreError> {
        todo!()
    }

    /// Opens a store without locking or changing it; an absent one is empty.
    pub fn read(_dir: &Path) -> Result<Store, StoreError> {
        todo!()
    }

    /// Everything wrong with the store in a folder, which need not be fit for opening.
    pub fn inspect(_dir: &Path) -> Result<Vec<Damage>, StoreError> {
        todo!()
    }

    /// Every run of the store, of whatever study and version, without its tables.
    pub fn summaries(&self) -> Vec<Run> {
        todo!()
    }

    /// Points with a finished run, and how it ended.
    pub fn finished(&self) -> Result<HashMap<PointId, Status>, StoreError> {
        todo!()
    }

    /// Keeps a run: durable when this returns. Safe to call from several threads.
    pub fn append(&self, _run: &Run) -> Result<(), StoreError> {
        todo!()
    }

    /// The runs of these points that exist, in the order asked for.
    pub fn load(&self, _ids: &[PointId]) -> Result<Vec<Run>, StoreError> {
        todo!()
    }

    /// Merges small files into tables.
    pub fn compact(&self) -> Result<(), StoreError> {
        todo!()
    }

    /// Checks every file against the manifest; finds orphans and torn files.
    pub fn verify(&self) -> Result<Vec<Damage>, StoreError> {
        todo!()
    }
}
