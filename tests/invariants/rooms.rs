//! The rooms of the library import in one direction.

use std::fs;
use std::path::{Path, PathBuf};

/// Rooms of the library; each imports only from those before it.
const ROOMS: [&str; 7] = [
    "page",
    "model",
    "modes",
    "stability",
    "motion",
    "analyses",
    "app",
];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .flat_map(|path| {
            if path.is_dir() {
                sources(&path)
            } else {
                vec![path]
            }
        })
        .filter(|path| path.extension().is_some_and(|ending| ending == "rs"))
        .collect()
}

#[test]
fn no_room_imports_from_a_room_above_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (height, room) in ROOMS.iter().enumerate() {
        for path in sources(&root.join(room)) {
            let text = fs::read_to_string(&path).unwrap();
            let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap();
            for line in code
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
            {
                let mut above = ROOMS[height + 1..].iter();
                let is_import = above.any(|room| line.contains(&format!("crate::{room}::")));
                assert!(!is_import, "{}: {line}", path.display());
            }
        }
    }
}
