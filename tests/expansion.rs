//! tmp
use proc_macro2::TokenStream;
fn expand(source: &str) -> String {
    let file: syn::File = syn::parse_str(source).unwrap();
    let syn::Item::Macro(item) = &file.items[0] else { panic!() };
    let root: TokenStream = "::linkage".parse().unwrap();
    let t = linkage_compiler::expand(item.mac.tokens.clone(), &root);
    match syn::parse2(t.clone()) { Ok(f) => prettyplease::unparse(&f), Err(e) => format!("{e}\n{t}") }
}
#[test]
fn show() {
    for f in std::env::var("SHOW").unwrap().split(',') {
        println!("{}", expand(&std::fs::read_to_string(format!("tests/mechanisms/{f}.rs")).unwrap()));
    }
}
