//! The rooms of the library import in one direction, and so do their files.

use std::collections::{BTreeMap, BTreeSet};
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

/// The text of a file without its tests and comments.
fn code_of(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let code = text.split("\n#[cfg(test)]\nmod tests {").next().unwrap();
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    let lines: Vec<&str> = code.lines().filter(is_code).collect();
    lines.join("\n")
}

#[test]
fn no_room_imports_from_a_room_above_it() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for (height, room) in ROOMS.iter().enumerate() {
        for path in sources(&root.join(room)) {
            for line in code_of(&path).lines() {
                let mut above = ROOMS[height + 1..].iter();
                let is_import = above.any(|room| line.contains(&format!("crate::{room}::")));
                assert!(!is_import, "{}: {line}", path.display());
            }
        }
    }
}

/// The paths of a declaration such as `a::{b, c::{d, e}}`.
fn expanded(declared: &str) -> Vec<String> {
    let Some((head, tail)) = declared.split_once('{') else {
        return vec![declared.trim().to_owned()];
    };
    let (mut depth, mut parts) = (0, vec![String::new()]);
    for letter in tail[..tail.rfind('}').unwrap()].chars() {
        depth += i32::from(letter == '{') - i32::from(letter == '}');
        match letter {
            ',' if depth == 0 => parts.push(String::new()),
            _ => parts.last_mut().unwrap().push(letter),
        }
    }
    parts.retain(|part| !part.trim().is_empty());
    let whole = |part: &String| expanded(&format!("{}{}", head.trim(), part.trim()));
    parts.iter().flat_map(whole).collect()
}

/// Code of every module but the root, by its path from there: `model::scene`.
struct Modules(BTreeMap<String, String>);

impl Modules {
    /// The path from the root of one that is written in a module; `None` for those of other libraries.
    fn absolute(&self, module: &str, path: &str) -> Option<String> {
        let (mut base, mut rest) = (module, path.strip_prefix("self::").unwrap_or(path));
        if let Some(known) = path.strip_prefix("crate::") {
            return Some(known.to_owned());
        }
        while let Some(above) = rest.strip_prefix("super::") {
            (base, rest) = (base.rsplit_once("::").map_or("", |(above, _)| above), above);
        }
        let first = rest.split("::").next()?;
        let is_own = rest != path || self.0.contains_key(&format!("{module}::{first}"));
        is_own.then(|| format!("{base}::{rest}").trim_start_matches(':').to_owned())
    }

    /// Names that a module imports, each with its path and whether the module exports it.
    fn imports(&self, module: &str) -> BTreeMap<String, (String, bool)> {
        let is_path = |c: char| c.is_alphanumeric() || "_:{},* \n".contains(c);
        let statements = self.0[module]
            .split(';')
            .filter_map(|text| text.rsplit_once("use "));
        let paths = statements
            .filter(|(_, declared)| declared.chars().all(is_path))
            .flat_map(|(before, declared)| {
                let is_export = before
                    .lines()
                    .last()
                    .is_some_and(|line| line.starts_with("pub"));
                expanded(declared)
                    .into_iter()
                    .map(move |path| (path, is_export))
            });
        let named = paths.filter_map(|(path, is_export)| {
            let (path, name) = path
                .split_once(" as ")
                .unwrap_or((&path, path.rsplit("::").next()?));
            Some((name.to_owned(), (self.absolute(module, path)?, is_export)))
        });
        named.collect()
    }

    /// The module that defines what a path names, through the imports of others; `None` for a module itself.
    fn definer(&self, path: &str) -> Option<String> {
        let mut module = path;
        while !self.0.contains_key(module) {
            module = module.rsplit_once("::")?.0;
        }
        let name = path[module.len()..].strip_prefix("::")?;
        let first = name.split("::").next()?;
        match self.imports(module).get(first) {
            Some((known, _)) => self.definer(&format!("{known}{}", &name[first.len()..])),
            None => Some(module.to_owned()),
        }
    }

    /// The modules from which a module uses anything. What a module only exports, it does not use.
    fn used_by(&self, module: &str) -> BTreeSet<String> {
        let imports = self.imports(module);
        let lines = self.0[module].lines().filter(|line| !line.contains("use "));
        let words =
            lines.flat_map(|line| line.split(|c: char| !c.is_alphanumeric() && !"_:".contains(c)));
        let written = words.filter_map(|word| {
            let first = word.split("::").next().filter(|first| *first != word)?;
            match imports.get(first) {
                Some((known, _)) => Some(format!("{known}{}", &word[first.len()..])),
                None => self.absolute(module, word),
            }
        });
        let imported = imports.values().filter(|(_, is_export)| !is_export);
        let paths = written.chain(imported.map(|(path, _)| path.clone()));
        let used = paths.filter_map(|path| self.definer(path.trim_end_matches(':')));
        used.filter(|used| used != module).collect()
    }
}

#[test]
fn no_file_imports_in_a_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let modules = ROOMS
        .iter()
        .flat_map(|room| sources(&root.join(room)))
        .filter_map(|path| {
            let place = path.strip_prefix(&root).unwrap().with_extension("");
            let names: Vec<&str> = place.iter().filter_map(|name| name.to_str()).collect();
            let is_test = names
                .iter()
                .any(|name| name.ends_with("tests") || name.starts_with("test_"));
            let module = names.join("::");
            (!is_test).then(|| (module.trim_end_matches("::mod").to_owned(), code_of(&path)))
        });
    let modules = Modules(modules.collect());
    let all = modules.0.keys();
    let mut uses: BTreeMap<&String, BTreeSet<String>> = all
        .map(|module| (module, modules.used_by(module)))
        .collect();
    assert!(uses.values().map(BTreeSet::len).sum::<usize>() > 1000);
    // Modules that use none of the rest are taken away, until only circles are left and what is above them.
    let mut count = 0;
    while count != uses.len() {
        count = uses.len();
        let left: BTreeSet<String> = uses.keys().map(|module| (*module).clone()).collect();
        uses.retain(|_, used| !used.is_disjoint(&left));
    }
    assert!(
        uses.is_empty(),
        "in a circle or above one: {:#?}",
        uses.keys()
    );
}
