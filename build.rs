//! Writes into the program where it comes from. Works without git and without a repository.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").expect("cargo sets CARGO_MANIFEST_DIR"));
    let simulator = root.join("crates/sim");
    let lock = root.join("Cargo.lock");
    println!("cargo:rerun-if-changed=build.rs");
    watch(&lock);
    // The harness as well: whether the sources differ from the commit depends on it.
    watch(&root.join("src"));
    watch(&simulator.join("src"));
    watch(&simulator.join("Cargo.toml"));
    for name in ["HEAD", "index", "logs/HEAD"] {
        if let Some(path) = output("git", &["rev-parse", "--git-path", name], &root) {
            watch(&root.join(path));
        }
    }
    let commit = output("git", &["rev-parse", "HEAD"], &root);
    // Without optional locks, `status` leaves alone the index that is watched above.
    let dirty = output(
        "git",
        &[
            "--no-optional-locks",
            "status",
            "--porcelain",
            "--untracked-files=no",
        ],
        &root,
    );
    let compiler = output(
        &env::var("RUSTC").unwrap_or_else(|_| "rustc".into()),
        &["--version"],
        &root,
    );
    set("COMMIT", commit.as_deref().unwrap_or("unknown"));
    set(
        "DIRTY",
        if dirty.is_some_and(|list| !list.is_empty()) {
            "true"
        } else {
            "false"
        },
    );
    set(
        "COMPILER",
        compiler.as_deref().unwrap_or("rustc, version unknown"),
    );
    set(
        "LOCK_HASH",
        &hash_of(&[(String::new(), fs::read(lock).unwrap_or_default())]),
    );
    set("SIMULATOR_HASH", &simulator_hash(&simulator));
    embed(&root.join("references"));
}

/// Writes the list of published tables that the program carries: name and content of each.
fn embed(folder: &Path) {
    watch(folder);
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "csv"))
        .collect();
    files.sort();
    let mut list = String::from("&[\n");
    for file in files {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        list += &format!("({name:?}, include_str!({:?})),\n", file.display().to_string());
    }
    list += "]\n";
    let folder = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::write(folder.join("tables.rs"), list).expect("the build folder is writable");
}

fn set(name: &str, value: &str) {
    println!("cargo:rustc-env=KYNCH_{name}={value}");
}

fn watch(path: &Path) {
    // A path that does not exist would make every build start over.
    if path.exists() {
        println!("cargo:rerun-if-changed={}", path.display());
    }
}

fn output(program: &str, arguments: &[&str], folder: &Path) -> Option<String> {
    let done = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .output()
        .ok()?;
    let text = String::from_utf8(done.stdout).ok()?;
    done.status.success().then(|| text.trim().to_string())
}

/// Over every source file of the simulator and its manifest, by path in a fixed order: two checkouts
/// of the same sources agree, wherever they lie.
fn simulator_hash(folder: &Path) -> String {
    let mut files = vec![folder.join("Cargo.toml")];
    collect(&folder.join("src"), &mut files);
    let mut named: Vec<(String, Vec<u8>)> = files
        .into_iter()
        .map(|path| {
            let name = path.strip_prefix(folder).expect("below its folder");
            let name = name.to_string_lossy().replace('\\', "/");
            (name, fs::read(&path).unwrap_or_default())
        })
        .collect();
    named.sort();
    hash_of(&named)
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            collect(&path, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
}

/// Lengths go in too, so that no two lists of files run together.
fn hash_of(files: &[(String, Vec<u8>)]) -> String {
    let mut hasher = blake3::Hasher::new();
    for (name, bytes) in files {
        hasher.update(&(name.len() as u64).to_le_bytes());
        hasher.update(name.as_bytes());
        hasher.update(&(bytes.len() as u64).to_le_bytes());
        hasher.update(bytes);
    }
    hasher.finalize().to_hex().to_string()
}
