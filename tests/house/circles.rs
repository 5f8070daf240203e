//! No file imports a file that imports it again, directly or through others: each crate reads in one direction.
//!
//! A name that a file passes on (`pub use`) is imported from the file that defines it. A call by its path, as of a module's
//! own files, is no import.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use syn::{Item, ItemMod, ItemUse, UseTree, Visibility};

/// A path of names from the root of a crate.
type Names = Vec<String>;

#[derive(Default)]
struct Module {
    file: PathBuf,
    defined: BTreeSet<String>,
    /// The names that it imports, and the paths as they stand there.
    imported: BTreeMap<String, Names>,
    globs: Vec<Names>,
    /// The paths that it imports for itself.
    used: BTreeSet<Names>,
}

struct Crate {
    modules: BTreeMap<Names, Module>,
}

impl Crate {
    fn of(root: &Path) -> Self {
        let mut found = Self { modules: BTreeMap::new() };
        found.file(root, root.parent().unwrap(), Vec::new());
        found
    }

    fn file(&mut self, file: &Path, folder: &Path, names: Names) {
        let text = fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
        let items = syn::parse_file(&text).unwrap().items;
        self.items(&items, file, folder, names);
    }

    /// The items of a module, whose children lie in a folder.
    fn items(&mut self, items: &[Item], file: &Path, folder: &Path, names: Names) {
        let mut module = Module { file: file.to_owned(), ..Module::default() };
        for item in items {
            match item {
                Item::Mod(child) if !is_test(child) => self.child(child, file, folder, &names),
                Item::Use(item) => module.import(item),
                Item::Const(item) => _ = module.defined.insert(item.ident.to_string()),
                Item::Enum(item) => _ = module.defined.insert(item.ident.to_string()),
                Item::Fn(item) => _ = module.defined.insert(item.sig.ident.to_string()),
                Item::Static(item) => _ = module.defined.insert(item.ident.to_string()),
                Item::Struct(item) => _ = module.defined.insert(item.ident.to_string()),
                Item::Trait(item) => _ = module.defined.insert(item.ident.to_string()),
                Item::Type(item) => _ = module.defined.insert(item.ident.to_string()),
                _ => {}
            }
        }
        self.modules.insert(names, module);
    }

    fn child(&mut self, child: &ItemMod, file: &Path, folder: &Path, names: &[String]) {
        let name = child.ident.to_string();
        let inner = folder.join(&name);
        let names = names.iter().cloned().chain([name]).collect();
        if let Some((_, items)) = &child.content {
            return self.items(items, file, &inner, names);
        }
        if let Some(path) = elsewhere(child) {
            let path = file.parent().unwrap().join(path);
            return self.file(&path, path.parent().unwrap(), names);
        }
        let alone = inner.with_extension("rs");
        let path = if alone.exists() { alone } else { inner.join("mod.rs") };
        self.file(&path, &inner, names);
    }

    /// The path from the root of one that stands in a module; `None` for another crate's.
    fn absolute(&self, module: &[String], path: &[String]) -> Option<Names> {
        let mut start = module.to_vec();
        let mut rest = path;
        match path.first()?.as_str() {
            "crate" => (start, rest) = (Vec::new(), &path[1..]),
            "self" | "super" => {
                while let Some((first, after)) =
                    rest.split_first().filter(|(first, _)| *first == "self" || *first == "super")
                {
                    if first == "super" {
                        start.pop();
                    }
                    rest = after;
                }
            }
            first => {
                let known = self.modules.get(module)?;
                let is_child = self.modules.contains_key(&joined(module, &path[..1]));
                if !is_child && !known.imported.contains_key(first) && !known.defined.contains(first) {
                    return None;
                }
            }
        }
        Some(joined(&start, rest))
    }

    /// The module that defines what a path from the root names. Bounded, since two globs may import each other.
    fn defining(&self, path: &[String], depth: usize) -> Option<&Module> {
        let mut at = Vec::new();
        for (index, name) in path.iter().enumerate() {
            let module = &self.modules[&at];
            let inner = joined(&at, std::slice::from_ref(name));
            if self.modules.contains_key(&inner) {
                at = inner;
                continue;
            }
            if module.defined.contains(name) || depth == 0 {
                return Some(module);
            }
            let rest = &path[index + 1..];
            if let Some(target) = module.imported.get(name) {
                return self.defining(&joined(&self.absolute(&at, target)?, rest), depth - 1);
            }
            let mut globs = module.globs.iter().filter_map(|glob| self.absolute(&at, glob));
            let through = globs.find_map(|glob| self.defined_in(&joined(&glob, &path[index..]), depth - 1));
            return through.or(Some(module));
        }
        self.modules.get(&at)
    }

    /// The module that [`Self::defining`] finds, if it has the name: another glob may have it.
    fn defined_in(&self, path: &[String], depth: usize) -> Option<&Module> {
        let module = self.defining(path, depth)?;
        path.iter().any(|name| module.defined.contains(name)).then_some(module)
    }

    /// The files that each file imports.
    fn imports(&self) -> BTreeMap<&Path, BTreeSet<&Path>> {
        let mut imports: BTreeMap<&Path, BTreeSet<&Path>> = BTreeMap::new();
        for (names, module) in &self.modules {
            let used = module.used.iter().filter_map(|path| self.absolute(names, path));
            let files = used.filter_map(|path| self.defining(&path, 16)).map(|module| module.file.as_path());
            imports.entry(&module.file).or_default().extend(files.filter(|file| *file != module.file));
        }
        imports
    }
}

fn joined(names: &[String], rest: &[String]) -> Names {
    names.iter().chain(rest).cloned().collect()
}

fn is_test(module: &ItemMod) -> bool {
    module.attrs.iter().any(|attribute| {
        attribute.path().is_ident("cfg") && attribute.parse_args::<syn::Path>().is_ok_and(|path| path.is_ident("test"))
    })
}

/// The path of `#[path = ".."]`.
fn elsewhere(module: &ItemMod) -> Option<String> {
    let value = module.attrs.iter().find(|attribute| attribute.path().is_ident("path"))?.meta.require_name_value();
    match &value.ok()?.value {
        syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
        _ => None,
    }
}

impl Module {
    fn import(&mut self, item: &ItemUse) {
        if item.leading_colon.is_none() {
            self.tree(&item.tree, &[], matches!(item.vis, Visibility::Inherited));
        }
    }

    fn tree(&mut self, tree: &UseTree, before: &[String], is_private: bool) {
        let with = |name: &syn::Ident| joined(before, &[name.to_string()]);
        let (name, path) = match tree {
            UseTree::Path(tree) => return self.tree(&tree.tree, &with(&tree.ident), is_private),
            UseTree::Group(group) => {
                return group.items.iter().for_each(|tree| self.tree(tree, before, is_private));
            }
            UseTree::Glob(_) => {
                if is_private {
                    self.used.insert(before.to_vec());
                }
                return self.globs.push(before.to_vec());
            }
            UseTree::Name(tree) if tree.ident == "self" => (before.last().unwrap().clone(), before.to_vec()),
            UseTree::Name(tree) => (tree.ident.to_string(), with(&tree.ident)),
            UseTree::Rename(tree) => (tree.rename.to_string(), with(&tree.ident)),
        };
        if is_private {
            self.used.insert(path.clone());
        }
        self.imported.insert(name, path);
    }
}

/// Sets of files that import each other, directly or through others.
fn circles<'a>(imports: &BTreeMap<&'a Path, BTreeSet<&'a Path>>) -> BTreeSet<Vec<&'a Path>> {
    let reached = |from: &'a Path| {
        let mut reached = BTreeSet::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            open.extend(imports[file].iter().filter(|file| reached.insert(**file)));
        }
        reached
    };
    let reach: BTreeMap<&Path, BTreeSet<&Path>> = imports.keys().map(|file| (*file, reached(file))).collect();
    let circle = |file: &&Path| reach[file].iter().copied().filter(|other| reach[other].contains(file)).collect();
    reach.keys().map(circle).filter(|files: &Vec<_>| files.len() > 1).collect()
}

/// The first files of all libraries and programs.
fn roots(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if path.is_dir() && name != "target" && name != "node_modules" && !name.starts_with('.') {
            roots(&path, found);
        } else if folder.ends_with("src") && (name == "lib.rs" || name == "main.rs") {
            found.push(path);
        }
    }
}

#[test]
fn no_circle_of_imports() {
    let here = Path::new(linkage_tests::ROOT);
    let mut all = Vec::new();
    roots(here, &mut all);
    all.sort();
    let mut report = String::new();
    let mut files = 0;
    let shown = |file: &Path| file.strip_prefix(here).unwrap().display().to_string();
    for root in &all {
        let found = Crate::of(root);
        let imports = found.imports();
        files += imports.len();
        for circle in circles(&imports) {
            writeln!(report, "a circle of {} files:", circle.len()).unwrap();
            for file in &circle {
                let others = imports[file].iter().filter(|other| circle.contains(*other)).map(|other| shown(other));
                writeln!(report, "  {} imports {}", shown(file), others.collect::<Vec<_>>().join(", ")).unwrap();
            }
        }
    }
    assert!(files > 400, "{files} files");
    assert!(report.is_empty(), "\n{report}");
}
