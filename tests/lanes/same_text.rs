//! The functions for lanes have the formulas of the functions for one position, term by term, in every mechanism of the
//! gallery. Otherwise the sign of a zero could differ.

use std::collections::BTreeMap;

use linkage_gallery::source;
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::visit::Visit;
use syn::{ImplItemFn, Stmt};

/// A mechanism with `derive lanes;`.
fn with_lanes(mechanism: TokenStream) -> TokenStream {
    let mut tokens: Vec<TokenTree> = mechanism.into_iter().collect();
    let body = tokens.iter_mut().rev().find_map(|token| match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
        _ => None,
    });
    let body = body.expect("a mechanism has a body");
    let has_lanes = body
        .stream()
        .to_string()
        .split(';')
        .any(|part| part.trim_start().starts_with("derive") && part.split([' ', ',']).any(|word| word == "lanes"));
    if !has_lanes {
        let inside = body.stream();
        *body = Group::new(Delimiter::Brace, quote!(#inside derive lanes;));
    }
    tokens.into_iter().collect()
}

/// The inherent functions by their type and name.
struct Functions(BTreeMap<(String, String), ImplItemFn>);

impl Visit<'_> for Functions {
    fn visit_item_impl(&mut self, item: &syn::ItemImpl) {
        let syn::Type::Path(of) = &*item.self_ty else { return };
        let of = &of.path.segments.last().expect("a name").ident;
        for item in item.items.iter().filter(|_| item.trait_.is_none()) {
            if let syn::ImplItem::Fn(function) = item {
                self.0.insert((of.to_string(), function.sig.ident.to_string()), function.clone());
            }
        }
    }
}

/// Writes the forms of functions without branches as those of one position: `__rt::lane::f(x, y)` as `x.f(y)`.
fn with_branches(tokens: TokenStream) -> TokenStream {
    let mut out: Vec<TokenTree> = Vec::new();
    for token in tokens {
        let TokenTree::Group(group) = token else {
            out.push(token);
            continue;
        };
        let inside = with_branches(group.stream());
        // `__rt`, two colons, `lane`, two colons, the name.
        let path: Vec<String> = out.iter().rev().take(7).rev().map(ToString::to_string).collect();
        if !path.concat().starts_with("__rt::lane::") {
            out.push(Group::new(group.delimiter(), inside).into());
            continue;
        }
        let name = out.split_off(out.len() - 7).pop();
        let mut arguments: Vec<TokenTree> = inside.into_iter().collect();
        let is_comma = |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if punct.as_char() == ',');
        let rest = arguments.iter().position(is_comma).map_or_else(Vec::new, |comma| arguments.split_off(comma));
        let is_operator =
            |token: &TokenTree| matches!(token, TokenTree::Punct(punct) if "+-*/".contains(punct.as_char()));
        let (is_formula, first) = (arguments.iter().any(is_operator), TokenStream::from_iter(arguments));
        out.extend(if is_formula { quote!((#first)) } else { first });
        let rest: TokenStream = rest.into_iter().skip(1).collect();
        out.extend(quote!(.#name(#rest)));
    }
    out.into_iter().collect()
}

/// The formulas of a function by the pattern that they are bound to.
fn formulas(function: &ImplItemFn) -> BTreeMap<String, String> {
    let bound = function.block.stmts.iter().filter_map(|statement| {
        let Stmt::Local(local) = statement else { return None };
        let formula = with_branches(local.init.as_ref()?.expr.to_token_stream()).to_string();
        Some((local.pat.to_token_stream().to_string(), formula))
    });
    bound.collect()
}

/// The names of flags. A chord says by an option that it is regular, and in lanes by a flag.
const FLAGS: [&str; 4] = ["is_", "has_", "are_finite", "closes"];

/// The numbers in the lists of a value, in order.
struct Numbers(Vec<String>);

impl Visit<'_> for Numbers {
    fn visit_expr_array(&mut self, array: &syn::ExprArray) {
        for element in &array.elems {
            match element {
                syn::Expr::Array(inside) => self.visit_expr_array(inside),
                number => self.0.push(number.to_token_stream().to_string()),
            }
        }
    }
}

/// The numbers in the lists of the value of a function.
fn numbers(function: &ImplItemFn) -> Vec<String> {
    let mut numbers = Numbers(Vec::new());
    let last = function.block.stmts.last().expect("a value");
    numbers.visit_stmt(&syn::parse2(with_branches(last.to_token_stream())).unwrap_or_else(|_| last.clone()));
    numbers.0
}

#[test]
fn lanes_have_the_formulas_of_one_position() {
    let root: TokenStream = "::linkage".parse().unwrap();
    let (mut pairs, mut lanes) = (0, 0);
    for file in linkage_gallery::FILES {
        let expanded = linkage_compiler::expand(with_lanes(source::tokens_of(file)), &root);
        let expanded: syn::File = syn::parse2(expanded).unwrap_or_else(|error| panic!("{file}: {error}"));
        let mut functions = Functions(BTreeMap::new());
        functions.visit_file(&expanded);
        for ((of, name), function) in &functions.0 {
            let named = |name: &str| functions.0.get(&(of.clone(), name.to_owned()));
            let other = match name.as_str() {
                "kinematics_in_lane" => named("kinematics"),
                "quantities_in_lane" => named("motion_of_quantities"),
                "motion_of_quantities" => named("full_kinematics").or(named("full_kinematics_near")),
                _ => continue,
            };
            let other = other.unwrap_or_else(|| panic!("{of} of {file} has no other function than {name}"));
            let (in_lane, alone) = (formulas(function), formulas(other));
            for (pattern, formula) in in_lane {
                // Several sines at once in one position, one after the other in lanes.
                let is_circular =
                    formula.ends_with(". sine_cosine ()") && alone.keys().any(|all| all.contains(&pattern));
                let is_flag = FLAGS.iter().any(|flag| pattern.starts_with(flag)) && !alone.contains_key(&pattern);
                if !is_flag && !is_circular && !formula.contains("chord") {
                    assert_eq!(Some(&formula), alone.get(&pattern), "{pattern} in {name} of {of} of {file}");
                    pairs += 1;
                }
            }
            if name == "kinematics_in_lane" {
                lanes += 1;
            } else {
                let found = numbers(function);
                assert!(!found.is_empty());
                assert_eq!(found, numbers(other), "{name} of {of} of {file}");
                pairs += found.len();
            }
        }
    }
    assert!(pairs > 2000 && lanes > 40, "{pairs} formulas, {lanes} mechanisms in lanes");
}
