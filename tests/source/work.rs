//! The operations of emitted functions, read from their documentation.

use std::collections::BTreeMap;

use linkage_compiler::program::Operations;
use proc_macro2::TokenStream;
use syn::visit::Visit;

/// Operations by type and function, without functions that have none.
pub type Work = BTreeMap<(String, String), Operations>;

/// The operations of all functions that `linkage!` emits for these tokens.
pub fn work(tokens: TokenStream) -> Work {
    let expansion = linkage_compiler::expand(tokens, &"::linkage".parse().expect("a path"));
    let mut visitor = Visitor { of: String::new(), work: Work::new() };
    visitor.visit_file(&syn::parse2(expansion).expect("items"));
    visitor.work
}

struct Visitor {
    of: String,
    work: Work,
}

impl Visit<'_> for Visitor {
    fn visit_item_impl(&mut self, item: &syn::ItemImpl) {
        if item.trait_.is_some() {
            // A function of a trait has the name of another.
            return;
        }
        if let syn::Type::Path(path) = &*item.self_ty {
            self.of = path.path.segments.last().expect("a name").ident.to_string();
        }
        syn::visit::visit_item_impl(self, item);
    }

    fn visit_impl_item_fn(&mut self, function: &syn::ImplItemFn) {
        for attribute in &function.attrs {
            let syn::Meta::NameValue(syn::MetaNameValue { value: syn::Expr::Lit(text), .. }) = &attribute.meta else {
                continue;
            };
            let syn::Lit::Str(text) = &text.lit else { continue };
            if let Some((_, list)) = text.value().split_once("Operations: ") {
                self.work.insert((self.of.clone(), function.sig.ident.to_string()), operations(list));
            }
        }
    }
}

/// `4 functions, 1 division, 38 multiplications, 18 additions.`
fn operations(list: &str) -> Operations {
    let mut all = Operations::default();
    let line = list.trim().lines().next().unwrap_or_default();
    for part in line.trim_end_matches('.').split(", ") {
        let (count, of) = part.split_once(' ').expect("a count");
        let count: usize = count.parse().expect("a count");
        match &of[..3] {
            "fun" => all.functions = count,
            "div" => all.divisions = count,
            "mul" => all.multiplications = count,
            "add" => all.additions = count,
            _ => panic!("{of} is no operation"),
        }
    }
    all
}
