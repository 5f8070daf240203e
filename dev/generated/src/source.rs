//! The mechanisms of files, and what is written about them.

use std::fs;
use std::path::{Path, PathBuf};

use linkage_compiler::Lowered;
use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::Item;

use crate::values::Values;

/// All `derive` requests that add functions; those that a mechanism lacks are added.
const REQUESTS: [&str; 5] = ["limits", "jerk", "velocity_ratio_derivatives", "sensitivity", "intervals"];

/// Folders and files with mechanisms.
const SOURCES: [&str; 3] =
    ["dev/gallery/src/mechanisms", "examples/engine/machine.rs", "examples/door_closer/machine.rs"];

/// One `linkage!` of a file.
pub struct Source {
    /// The name of the file; of a file `machine`, that of its folder.
    pub file: String,
    /// Modules of the file, to which the mechanisms refer.
    modules: TokenStream,
    tokens: TokenStream,
}

/// The texts about the types of a file.
#[derive(Default)]
pub struct Calls {
    /// Entries of a list of `Called`.
    pub types: Vec<TokenStream>,
    /// Functions that make the values of the types, in a module for each driver.
    pub values: TokenStream,
    /// Runs of the algorithms for any mechanism and for any scene: pairs of a name and a function.
    pub algorithms: Vec<TokenStream>,
}

/// The `linkage!` of all files of a repository, or of those with these names, each with all `derive` requests.
///
/// # Panics
///
/// If a file cannot be read.
#[must_use]
pub fn sources(root: &Path, chosen: Option<&[&str]>) -> Vec<Source> {
    let files = SOURCES.iter().flat_map(|source| files(&root.join(source)));
    let all = files.map(|path| source(&path)).filter(|one| chosen.is_none_or(|all| all.contains(&one.file.as_str())));
    all.map(Source::with_all_requests).collect()
}

/// A file, or the files of a folder.
fn files(path: &Path) -> Vec<PathBuf> {
    if !path.is_dir() {
        return vec![path.to_owned()];
    }
    let entries = fs::read_dir(path).expect("a folder");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a file").path()).collect();
    paths.sort();
    paths
}

/// The `linkage!` of a file.
///
/// # Panics
///
/// If there is not exactly one.
#[must_use]
pub fn source(path: &Path) -> Source {
    let name = |path: Option<&Path>| path.and_then(Path::file_stem).unwrap_or_default().to_string_lossy().into_owned();
    let own = name(Some(path));
    let text = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let items = syn::parse_file(&text).expect("Rust").items;
    let modules = items.iter().filter(|item| matches!(item, Item::Mod(_))).map(ToTokens::to_token_stream).collect();
    let mut invocations = items.into_iter().filter_map(|item| match item {
        Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens),
        _ => None,
    });
    let (Some(tokens), None) = (invocations.next(), invocations.next()) else {
        panic!("{}: one `linkage!`", path.display());
    };
    Source { file: if own == "machine" { name(path.parent()) } else { own }, modules, tokens }
}

impl Source {
    fn with_all_requests(self) -> Self {
        let text = self.tokens.to_string();
        let is_right = |tokens: &TokenStream| {
            let mechanisms = linkage_compiler::read(tokens.clone());
            mechanisms.is_ok_and(|all| all.iter().all(|one| linkage_compiler::each_driver(one, |_| ()).is_ok()))
        };
        let wanted: Vec<&str> = text.split("derive ").skip(1).filter_map(|rest| rest.split(';').next()).collect();
        let is_wanted = |request: &str| wanted.iter().any(|list| list.split(',').any(|name| name.trim() == request));
        // The first brace is that of the mechanism.
        let with = |requests: &[&str]| match requests {
            [] => self.tokens.clone(),
            requests => {
                let text = text.replacen('{', &format!("{{ derive {};", requests.join(", ")), 1);
                text.parse().expect("tokens")
            }
        };
        let missing: Vec<&str> = REQUESTS.into_iter().filter(|request| !is_wanted(request)).collect();
        let all = with(&missing);
        let tokens = if is_right(&all) {
            all
        } else {
            let allowed: Vec<&str> = missing.into_iter().filter(|request| is_right(&with(&[request]))).collect();
            with(&allowed)
        };
        Self { tokens, ..self }
    }

    /// Applies a function to the program of each driver.
    fn each<R>(&self, mut f: impl FnMut(&Lowered) -> R) -> Vec<R> {
        let mechanisms = linkage_compiler::read(self.tokens.clone()).expect("a mechanism without mistakes");
        let of = |mechanism| linkage_compiler::each_driver(mechanism, |of| f(&of)).expect("it compiles");
        mechanisms.iter().flat_map(of).collect()
    }

    /// The module of its emitted code, with the modules of the file.
    ///
    /// # Panics
    ///
    /// If the mechanism has a mistake.
    #[must_use]
    pub fn emitted(&self) -> TokenStream {
        let mechanisms = linkage_compiler::read(self.tokens.clone()).expect("a mechanism without mistakes");
        let root = quote!(::linkage);
        let emitted = mechanisms.iter().map(|one| linkage_compiler::compile(one, &root).expect("it compiles").tokens);
        let modules = &self.modules;
        quote!(#modules #(#emitted)*)
    }

    /// Calls of the public functions of its types, which are in this module.
    #[must_use]
    pub fn calls(&self, module: &TokenStream) -> Calls {
        let mut all = Calls::default();
        self.each(|of| {
            let values = Values::new(&self.file, module, of.declared, &of.program);
            all.types.extend(values.calls());
            all.values.extend(values.module());
            all.algorithms.extend(values.algorithms());
        });
        all
    }

    /// Functions without type parameters for those of its types, which are in the module around theirs: `T` is the scalar, and
    /// `__rt` are the names of the library for emitted code.
    #[must_use]
    pub fn wrappers(&self) -> Vec<TokenStream> {
        self.wrapped(|values| values.wrappers())
    }

    /// Such functions of the motion of all links and points in one call.
    #[must_use]
    pub fn kinematics(&self) -> Vec<TokenStream> {
        self.wrapped(|values| values.kinematics())
    }

    fn wrapped(&self, wrappers: impl Fn(&Values<'_, '_>) -> Vec<TokenStream>) -> Vec<TokenStream> {
        let module = TokenStream::new();
        self.each(|of| wrappers(&Values::new(&self.file, &module, of.declared, &of.program)))
            .into_iter()
            .flatten()
            .collect()
    }
}
