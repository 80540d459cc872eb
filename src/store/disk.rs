//! Files that are either there in full or not at all, and one writer at a time.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::error::StoreError;

const LOCK: &str = ".lock";
/// Start of the name of a file that is being written.
pub(super) const TEMPORARY: &str = ".tmp-";
/// Folders of a store besides its root.
pub(super) const FOLDERS: [&str; 3] = ["pending", "profiles", "series"];

/// The folder of a store.
#[derive(Debug)]
pub(super) struct Disk {
    root: PathBuf,
    writes: AtomicU64,
    /// Held as long as the store is open; the operating system lets go when the process dies,
    /// however it dies, so that a stale lock cannot exist. `None` when opened for reading only.
    lock: Option<File>,
    /// Writes that still succeed before the disk counts as full.
    #[cfg(test)]
    pub writes_left: std::sync::atomic::AtomicI64,
}

impl Disk {
    /// Creates the folder if need be and becomes its only writer.
    pub fn open(root: &Path) -> Result<Disk, StoreError> {
        for folder in FOLDERS {
            let path = root.join(folder);
            fs::create_dir_all(&path).map_err(|error| not_writable(root, error))?;
        }
        let lock = take_lock(root)?;
        let mut disk = Disk::read(root);
        disk.lock = Some(lock);
        // A read-only folder with an old lock file would pass the steps above.
        disk.write(".probe", b"")?;
        disk.remove(".probe")?;
        Ok(disk)
    }

    /// Looks at a folder without changing anything.
    pub fn read(root: &Path) -> Disk {
        Disk {
            root: root.to_path_buf(),
            writes: AtomicU64::new(0),
            lock: None,
            #[cfg(test)]
            writes_left: std::sync::atomic::AtomicI64::new(i64::MAX),
        }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }

    /// Writes a file under a hidden temporary name, flushes it to the disk and renames it.
    /// The file `name` is the old one or the new one at any instant, even through a power cut.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), StoreError> {
        if self.lock.is_none() {
            let source = io::Error::new(io::ErrorKind::PermissionDenied, "it was opened for reading only");
            let path = self.root.clone();
            return Err(StoreError::NotWritable { path, source });
        }
        let number = self.writes.fetch_add(1, Ordering::Relaxed);
        let temporary = self.path(&format!("{TEMPORARY}{}-{number}", std::process::id()));
        let written = self.write_and_rename(&temporary, &self.path(name), bytes);
        written.map_err(|error| {
            let _ = fs::remove_file(&temporary);
            StoreError::io("write", &self.path(name), error)
        })
    }

    fn write_and_rename(&self, temporary: &Path, target: &Path, bytes: &[u8]) -> io::Result<()> {
        #[cfg(test)]
        if self.writes_left.fetch_sub(1, Ordering::Relaxed) <= 0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        let mut file = File::create(temporary)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(temporary, target)?;
        sync_folder(target)
    }

    pub fn bytes(&self, name: &str) -> Result<Vec<u8>, StoreError> {
        let path = self.path(name);
        fs::read(&path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => StoreError::damaged(name, "the file is missing"),
            _ => StoreError::io("read", &path, error),
        })
    }

    /// BLAKE3 of a file; `None` when it does not exist.
    pub fn sum(&self, name: &str) -> Result<Option<String>, StoreError> {
        let path = self.path(name);
        if !path.exists() {
            return Ok(None);
        }
        let hash = || -> io::Result<String> {
            let mut file = File::open(&path)?;
            let mut hasher = blake3::Hasher::new();
            let mut block = vec![0; 1 << 16];
            loop {
                match file.read(&mut block)? {
                    0 => return Ok(hasher.finalize().to_hex().to_string()),
                    length => hasher.update(&block[..length]),
                };
            }
        };
        hash()
            .map(Some)
            .map_err(|error| StoreError::io("read", &path, error))
    }

    /// Removes a file; one that is not there is no error.
    pub fn remove(&self, name: &str) -> Result<(), StoreError> {
        let path = self.path(name);
        match fs::remove_file(&path) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                Err(StoreError::io("remove", &path, error))
            }
            _ => Ok(()),
        }
    }

    /// Names of the files in a folder of the store (`""` is the root), sorted, without folders and
    /// without the lock.
    pub fn files(&self, folder: &str) -> Result<Vec<String>, StoreError> {
        let path = self.path(folder);
        let read = |path: &Path| -> io::Result<Vec<String>> {
            let mut names = Vec::new();
            for entry in fs::read_dir(path)? {
                let entry = entry?;
                let name = entry.file_name().to_string_lossy().into_owned();
                if !entry.file_type()?.is_dir() && name != LOCK {
                    names.push(if folder.is_empty() {
                        name
                    } else {
                        format!("{folder}/{name}")
                    });
                }
            }
            names.sort();
            Ok(names)
        };
        match read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
            other => other.map_err(|error| StoreError::io("read", &path, error)),
        }
    }
}

fn not_writable(root: &Path, source: io::Error) -> StoreError {
    let path = root.to_path_buf();
    match StoreError::io("create", root, source) {
        StoreError::Io { source, .. } => StoreError::NotWritable { path, source },
        other => other,
    }
}

fn take_lock(root: &Path) -> Result<File, StoreError> {
    let path = root.join(LOCK);
    let mut file = OpenOptions::new()
        .read(true)
        .write(true)
        .create(true)
        .truncate(false)
        .open(&path)
        .map_err(|error| not_writable(root, error))?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            let mut owner = String::new();
            let _ = file.read_to_string(&mut owner);
            let owner = match owner.trim() {
                "" => "another process".to_string(),
                process => format!("process {process}"),
            };
            let path = root.to_path_buf();
            return Err(StoreError::InUse { path, owner });
        }
        // Some network file systems know no locks: better unguarded than unusable.
        Err(TryLockError::Error(error)) if error.kind() == io::ErrorKind::Unsupported => {}
        Err(TryLockError::Error(error)) => return Err(StoreError::io("lock", &path, error)),
    }
    let owner = std::process::id().to_string();
    file.set_len(0)
        .and_then(|()| file.write_all(owner.as_bytes()))
        .map_err(|error| StoreError::io("write", &path, error))?;
    Ok(file)
}

/// A rename is durable only once its folder is flushed.
fn sync_folder(file: &Path) -> io::Result<()> {
    match file.parent() {
        #[cfg(unix)]
        Some(folder) => File::open(folder)?.sync_all(),
        _ => Ok(()),
    }
}
