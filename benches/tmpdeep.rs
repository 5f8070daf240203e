use proc_macro2::TokenStream;
fn main() {
    let file = include_str!("../tests/mechanisms/four_bar.rs");
    let (open, close) = (file.find('{').map_or(0, |at| at + 1), file.rfind('}').unwrap_or(file.len()));
    let root: TokenStream = "::linkage".parse().expect("a path");
    let tokens: TokenStream = file[open..close].parse().expect("tokens");
    let mut n = 0;
    for _ in 0..std::env::var("N").map_or(5, |n| n.parse().unwrap()) {
        n += linkage_compiler::expand(tokens.clone(), &root).into_iter().count();
    }
    println!("{n}");
}
