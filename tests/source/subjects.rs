//! The text of a program that tries out what is emitted, with the harness of `tests/input/invalid_numbers`: calls of each
//! function, and algorithms for each mechanism and scene.

use std::path::Path;

use linkage_generated::{Source, source, sources};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

/// The main file, which includes the others.
pub const MAIN: &str =
    "include!(\"subjects.rs\");\nfn main() -> std::process::ExitCode { trials::main(&subjects()) }\n";

/// The files of a program that calls the gallery as it is compiled, with algorithms for these files of it.
#[must_use]
pub fn of_gallery(root: &Path, chosen: &[&str]) -> Vec<(String, String)> {
    let folder = root.join("dev/gallery/src/mechanisms");
    let chosen = chosen.iter().map(|file| source(&folder.join(file).with_extension("rs")));
    let algorithms = chosen.flat_map(|one| one.algorithms(&module(quote!(::linkage_gallery), &one)));
    vec![(
        "subjects.rs".to_owned(),
        subjects(
            root,
            &quote!(
                use linkage_called as called;
            ),
            algorithms,
        ),
    )]
}

/// The files of a program with the emitted code of all mechanisms, or of those in the files with these names, with all
/// `derive` requests.
#[must_use]
pub fn emitted(root: &Path, chosen: Option<&[&str]>) -> Vec<(String, String)> {
    let (mut files, mut modules) = (Vec::new(), Vec::new());
    let (mut types, mut values, mut algorithms) = (Vec::new(), Vec::new(), Vec::new());
    for one in sources(root, chosen) {
        let path = module(quote!(crate), &one);
        types.extend(one.calls(&path));
        values.push(one.values(&path));
        algorithms.extend(one.algorithms(&path));
        let name = format_ident!("{}", one.file);
        // This program looks at numbers.
        modules.push(quote!(#[allow(warnings, reason = "the test `emitted_source` looks at them")] mod #name;));
        files.push((format!("{}.rs", one.file), one.emitted().to_string()));
    }
    let [table, laws] = ["dev/called/src/table.rs", "dev/gallery/src/cam_laws.rs"].map(|file| text(root, file));
    let others = quote! {
        #(#modules)*
        #[path = #laws] mod laws;
        /// The functions that cams call, counted.
        mod cam_laws {
            use linkage::Real;
            pub fn cycloidal_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T) {
                crate::harness::tally::evaluated();
                crate::laws::cycloidal_strokes(angle, height, rise)
            }
            pub fn polynomial_strokes<T: Real>(angle: T, height: T, rise: T) -> (T, T, T, T) {
                crate::harness::tally::evaluated();
                crate::laws::polynomial_strokes(angle, height, rise)
            }
        }
        mod called {
            #[path = #table] mod table;
            use linkage::Mechanism;
            pub use table::{Call, Called, Kind, Numbers};
            pub const ALL: &[Called] = &[#(#types),*];
            #(#values)*
        }
    };
    files.push(("subjects.rs".to_owned(), subjects(root, &others, algorithms)));
    files
}

fn module(of: TokenStream, source: &Source) -> TokenStream {
    let file = format_ident!("{}", source.file);
    quote!(#of::#file)
}

/// The path of a file as text.
fn text(root: &Path, file: &str) -> String {
    root.join(file).to_str().expect("a path of letters").to_owned()
}

/// The file with the list of all subjects.
fn subjects(root: &Path, others: &TokenStream, algorithms: impl IntoIterator<Item = TokenStream>) -> String {
    let [harness, trials] =
        ["harness/mod.rs", "trials.rs"].map(|file| text(root, &format!("tests/input/invalid_numbers/{file}")));
    let algorithms = algorithms.into_iter();
    quote! {
        #[path = #harness] mod harness;
        #[path = #trials] mod trials;
        #others
        const ALGORITHMS: &[(&str, fn(&mut harness::Tally, &mut harness::Source))] =
            &[#(#algorithms,)* ("integrate", harness::integrations)];
        fn subjects() -> Vec<(String, harness::Subject)> {
            let functions = called::ALL.iter().map(|of| {
                (format!("{}: {}", of.file, of.scene.unwrap_or(of.name)), harness::Subject::Functions(of))
            });
            let algorithms = ALGORITHMS.iter().map(|(name, run)| ((*name).to_owned(), harness::Subject::Algorithms(*run)));
            functions.chain(algorithms).collect()
        }
    }
    .to_string()
}
