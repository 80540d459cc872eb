//! The list of files with their BLAKE3 sums: `hash  path`, one file per line.
//!
//! While a table is being replaced its path is listed with both sums, the old and the new; whichever
//! the file has is right. [`ABSENT`] stands for the sum of a file that is not there yet.

use std::collections::BTreeMap;

pub(super) const FILE: &str = "manifest.blake3";
/// In place of the sum of a file that need not exist.
pub(super) const ABSENT: &str = "0000000000000000000000000000000000000000000000000000000000000000";

#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Manifest {
    entries: BTreeMap<String, Vec<String>>,
}

impl Manifest {
    /// # Errors
    /// The number and fault of the first line that is not `hash  path`.
    pub fn parse(text: &str) -> Result<Manifest, String> {
        let mut manifest = Manifest::default();
        for (position, line) in text.lines().enumerate() {
            let (hash, path) = line
                .split_once("  ")
                .filter(|(hash, path)| is_hash(hash) && !path.is_empty())
                .ok_or_else(|| format!("line {} is not `hash  path`", position + 1))?;
            manifest.admit(path, hash);
        }
        Ok(manifest)
    }

    pub fn render(&self) -> String {
        let lines = self
            .entries
            .iter()
            .flat_map(|(path, hashes)| hashes.iter().map(move |hash| format!("{hash}  {path}\n")));
        lines.collect()
    }

    /// The file has this sum and no other.
    pub fn set(&mut self, path: &str, hash: &str) {
        self.entries.insert(path.to_string(), vec![hash.to_string()]);
    }

    /// The file may have this sum besides those listed.
    pub fn admit(&mut self, path: &str, hash: &str) {
        let hashes = self.entries.entry(path.to_string()).or_default();
        if !hashes.iter().any(|known| known == hash) {
            hashes.push(hash.to_string());
        }
    }

    pub fn remove(&mut self, path: &str) {
        self.entries.remove(path);
    }

    pub fn lists(&self, path: &str) -> bool {
        self.entries.contains_key(path)
    }

    /// Sums that the file may have; empty when it is not listed.
    pub fn sums(&self, path: &str) -> &[String] {
        self.entries.get(path).map_or(&[], Vec::as_slice)
    }

    pub fn paths(&self) -> Vec<String> {
        self.entries.keys().cloned().collect()
    }
}

/// BLAKE3 in hex.
pub(super) fn sum(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

fn is_hash(text: &str) -> bool {
    text.len() == 64 && text.bytes().all(|byte| byte.is_ascii_hexdigit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_and_back() {
        let mut manifest = Manifest::default();
        manifest.set("runs.parquet", &sum(b"old"));
        manifest.admit("runs.parquet", &sum(b"new"));
        manifest.set("series/a b.parquet", &sum(b"x"));
        let text = manifest.render();
        assert_eq!(text.lines().count(), 3);
        assert_eq!(Manifest::parse(&text).unwrap(), manifest);
    }

    #[test]
    fn a_torn_line_is_named() {
        let good = format!("{}  runs.parquet\n", sum(b"x"));
        let fault = Manifest::parse(&format!("{good}{}", &good[..40])).unwrap_err();
        assert!(fault.contains("line 2"), "{fault}");
    }
}
