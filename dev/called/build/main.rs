//! Writes a call of each public function that the macro emits for the gallery.

use std::fs;
use std::path::{Path, PathBuf};

use linkage_generated::source;
use quote::{format_ident, quote};

const MECHANISMS: &str = "../gallery/src/mechanisms";

fn main() {
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed={MECHANISMS}");
    let mut files: Vec<PathBuf> =
        fs::read_dir(MECHANISMS).expect("the gallery").map(|one| one.unwrap().path()).collect();
    files.sort();
    let (mut types, mut values) = (Vec::new(), Vec::new());
    for path in files {
        let source = source(Path::new(&path));
        let file = format_ident!("{}", source.file);
        let module = quote!(::linkage_gallery::#file);
        types.extend(source.calls(&module));
        values.push(source.values(&module));
    }
    let all = quote! {
        /// The types of the gallery with their functions.
        pub const ALL: &[Called] = &[#(#types),*];
        #(#values)*
    };
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("a folder"));
    fs::write(out.join("calls.rs"), all.to_string()).expect("a file that can be written");
}
