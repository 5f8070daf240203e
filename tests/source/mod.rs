//! The mechanisms of `tests/mechanisms` as text.

/// The tokens between the braces of the one `linkage!` of a file.
pub fn tokens_of(file: &str) -> proc_macro2::TokenStream {
    let path = format!("{}/tests/mechanisms/{file}.rs", env!("CARGO_MANIFEST_DIR"));
    let source = std::fs::read_to_string(&path).expect(&path);
    let parsed: syn::File = syn::parse_str(&source).expect(&path);
    match parsed.items.as_slice() {
        [syn::Item::Macro(item)] => item.mac.tokens.clone(),
        _ => panic!("{path} holds one linkage! and nothing else"),
    }
}
