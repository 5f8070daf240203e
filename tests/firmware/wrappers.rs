//! The text of the library: what is emitted for each mechanism, and a function without type parameters for each of
//! its functions, in `f64`.

use std::fmt::Write;
use std::path::Path;

use proc_macro2::{Group, Ident, TokenStream, TokenTree};
use quote::{ToTokens, quote};
use syn::{FnArg, ImplItem, Item, ItemImpl, PathArguments, ReturnType, Type, TypeParamBound, Visibility};

use linkage_tests::every::{self, Expansion};

/// The files of the library by name, and how many functions of emitted code are wrapped in them.
pub fn files(root: &Path) -> (Vec<(String, String)>, usize) {
    let laws = root.join("dev/gallery/src/cam_laws.rs");
    let mut library = format!("#![no_std]\n#[path = {laws:?}] mod cam_laws;\n{PLANTED}\n{PROVIDED}\n");
    let (mut files, mut count) = (Vec::new(), 0);
    for Expansion { module, functions, emitted } in every::expansions(root, None) {
        let wrappers: Vec<String> = every::items(&emitted.items).into_iter().flat_map(wrapped).collect();
        count += wrappers.len();
        let wrappers = wrappers.concat();
        let text = functions + &prettyplease::unparse(&emitted);
        // Names of wrappers contain names of types, which are not in snake case. This test looks at machine code; the
        // warnings of emitted code are those of the test `emitted_source`.
        writeln!(library, "#[allow(warnings, reason = \"`emitted_source` looks at them\")] pub mod {module};").unwrap();
        let text = format!("{text}\npub mod wrappers {{ use super::*; use ::linkage::__rt;\n{wrappers}}}\n");
        files.push((format!("{module}.rs"), text));
    }
    files.push(("lib.rs".to_owned(), library));
    (files, count)
}

/// Planted functions: two that can panic, through a generic function and through a pointer in a table, and one that cannot.
const PLANTED: &str = "
pub mod planted {
    #[inline(never)]
    fn entry<T: Copy>(values: &[T], place: usize) -> T {
        values[place]
    }
    pub mod wrappers {
        use super::entry;
        #[inline(never)]
        pub fn indexes(values: &[f64], place: usize) -> f64 {
            entry(values, place)
        }
        #[inline(never)]
        pub fn points(place: bool) -> fn(&[f64], usize) -> f64 {
            const TABLE: [fn(&[f64], usize) -> f64; 2] = [entry::<f64>, indexes];
            TABLE[usize::from(place)]
        }
        #[inline(never)]
        pub fn looks(values: &[f64], place: usize) -> f64 {
            values.get(place).copied().unwrap_or_default()
        }
    }
}";

/// Calls the functions of `Kinematic` and `Mechanism` that have a body in the runtime; emitted code has its own for most
/// mechanisms.
const PROVIDED: &str = "
mod provided {
    use core::hint::black_box;
    use linkage::Kinematic;
    pub fn call<M: Kinematic<Scalar = f64>>(
        m: &M,
        (pose, other): (&M::Pose, &M::Pose),
        (q, branch): (&M::Coordinates, M::Branch),
        (rates, accelerations, inputs): (&M::Rates, &M::Accelerations, M::Inputs),
    ) {
        black_box((m.residual(pose), m.residual_scales(pose)));
        black_box((m.jacobian_unknowns(pose), m.jacobian_unknowns_scales(pose)));
        black_box((m.jacobian_inputs(pose), m.jacobian_inputs_scales(pose)));
        black_box((m.determinant(pose), m.block_determinants(pose), m.length_scale(pose)));
        let gamma = black_box(m.gamma(pose, rates));
        black_box((m.solve_jacobian(pose, &gamma), m.check_implied(q), m.same_branch(pose, other)));
        let unknowns = black_box(M::unknowns(q));
        black_box((M::with_unknowns(q, unknowns), M::with_inputs(q, M::inputs(q))));
        black_box((m.full_kinematics(q, branch, inputs, inputs), m.velocity_ratios(pose)));
        black_box((m.point_velocities(pose, rates), m.point_accelerations(pose, rates, accelerations)));
        black_box((m.output_rates(pose, rates), m.output_accelerations(pose, rates, accelerations)));
        black_box((m.output_ratios(pose), M::acceleration_parts(accelerations)));
        if let (Ok(points), Ok(ratios)) = (m.points(pose), m.point_ratios(pose)) {
            black_box((M::each_point(points), M::each_point(ratios)));
        }
        if let Ok(outputs) = m.outputs(pose) {
            black_box(M::each_output(outputs));
        }
        black_box(M::accelerations(unknowns, M::inputs(q)));
    }
}";

/// A wrapper of each function of an `impl` that can be called: those of a type, and those of the traits by which
/// general algorithms call it.
fn wrapped(item: &Item) -> Vec<String> {
    let Item::Impl(implementation) = item else { return Vec::new() };
    let called = implementation.trait_.as_ref().map(|(path, _)| path);
    let is_of_runtime = |path: &syn::Path| {
        let name = &path.segments.last().unwrap().ident;
        ["Mechanism", "Assembly", "Scene"].iter().any(|known| name == known)
    };
    let of = in_doubles(implementation.self_ty.to_token_stream());
    if called.is_some_and(|path| path.segments.last().unwrap().ident == "Lanes") {
        return vec![run_of_a_batch(&of)];
    }
    if called.is_some_and(|path| path.segments.last().unwrap().ident == "Kinematic") {
        return vec![provided(&of)];
    }
    if called.is_some_and(|path| !is_of_runtime(path)) {
        return Vec::new();
    }
    let functions = implementation.items.iter().filter_map(|item| match item {
        // Those that take and sort columns only move numbers.
        ImplItem::Fn(function) if function.sig.ident == "batch" || function.sig.ident == "list" => None,
        ImplItem::Fn(function) if called.is_some() || matches!(function.vis, Visibility::Public(_)) => Some(function),
        _ => None,
    });
    functions.map(|function| wrapper(implementation, called, &function.sig)).collect()
}

/// A wrapper of the computation of many positions of a mechanism.
fn run_of_a_batch(of: &TokenStream) -> String {
    let name = quote::format_ident!("{}_run", of.to_string().split('<').next().unwrap_or_default().trim());
    let text = quote! {
        pub fn #name(
            batch: &::linkage::lanes::Batch<'_, #of>,
            found: &mut [Option<&mut [f64]>],
            accepted: &mut [bool],
        ) -> Result<usize, ::linkage::InputError> {
            batch.run(found, accepted)
        }
    };
    format!("#[inline(never)] {text}\n")
}

/// The text of a library with `full_kinematics` of each mechanism whose groups all have closed forms, in `f32`.
pub fn in_floats(root: &Path) -> Vec<(String, String)> {
    let laws = root.join("dev/gallery/src/cam_laws.rs");
    let mut library = format!("#![no_std]\n#[path = {laws:?}] mod cam_laws;\n");
    let mut files = Vec::new();
    for Expansion { module, functions, emitted } in every::expansions(root, None) {
        let wrappers: String = every::items(&emitted.items).into_iter().filter_map(full_kinematics).collect();
        let text = functions + &prettyplease::unparse(&emitted);
        writeln!(library, "#[allow(warnings, reason = \"`emitted_source` looks at them\")] pub mod {module};").unwrap();
        files.push((format!("{module}.rs"), format!("{text}\npub mod wrappers {{ use super::*;\n{wrappers}}}\n")));
    }
    files.push(("lib.rs".to_owned(), library));
    files
}

/// A wrapper of `full_kinematics` of a mechanism in `f32`.
fn full_kinematics(item: &Item) -> Option<String> {
    let Item::Impl(implementation) = item else { return None };
    let (path, _) = implementation.trait_.as_ref()?;
    if path.segments.last()?.ident != "Kinematic" {
        return None;
    }
    let of = replaced(implementation.self_ty.to_token_stream(), &|name| (name == "T").then(|| quote!(f32)));
    let name = quote::format_ident!("{}", of.to_string().split('<').next().unwrap_or_default().trim());
    let text = quote! {
        pub fn #name(
            m: &#of,
            guess: &<#of as ::linkage::Mechanism>::Coordinates,
            branch: <#of as ::linkage::Mechanism>::Branch,
            rates: <#of as ::linkage::Mechanism>::Inputs,
        ) {
            ::core::hint::black_box(::linkage::Kinematic::full_kinematics(m, guess, branch, rates, rates).is_ok());
        }
    };
    Some(format!("#[inline(never)] {text}\n"))
}

/// A wrapper of the functions of a mechanism that have a body in the runtime.
fn provided(of: &TokenStream) -> String {
    let name = quote::format_ident!("{}_provided", of.to_string().split('<').next().unwrap_or_default().trim());
    let associated = |name: &str| {
        let name = quote::format_ident!("{name}");
        quote!(<#of as ::linkage::Mechanism>::#name)
    };
    let [pose, q, branch, rates, inputs] = ["Pose", "Coordinates", "Branch", "Rates", "Inputs"].map(associated);
    let text = quote! {
        pub fn #name(
            m: &#of,
            poses: (&#pose, &#pose),
            at: (&#q, #branch),
            motion: (&#rates, &<#of as ::linkage::Kinematic>::Accelerations, #inputs),
        ) {
            crate::provided::call(m, poses, at, motion);
        }
    };
    format!("#[inline(never)] {text}\n")
}

fn wrapper(implementation: &ItemImpl, called: Option<&syn::Path>, signature: &syn::Signature) -> String {
    let of = in_doubles(implementation.self_ty.to_token_stream());
    let scalars: Vec<&Ident> = signature.generics.type_params().map(|parameter| &parameter.ident).collect();
    let concrete = |tokens| replaced(tokens, &|name| scalars.contains(&name).then(|| quote!(f64)));
    let own = |tokens| with_self(concrete(in_doubles(tokens)), implementation, &of);
    let mut arguments = Vec::new();
    for (place, argument) in signature.inputs.iter().enumerate() {
        let of = match argument {
            FnArg::Receiver(receiver) => match &receiver.kind {
                syn::ReceiverKind::Reference(..) => quote!(&#of),
                _ => of.clone(),
            },
            FnArg::Typed(argument) => own(argument_type(&argument.ty)),
        };
        arguments.push((quote::format_ident!("a{place}"), of));
    }
    let parameters = arguments.iter().map(|(name, of)| quote!(#name: #of));
    let names = arguments.iter().map(|(name, _)| name);
    let function = &signature.ident;
    let on = match called {
        None => quote!(<#of>),
        Some(path) => {
            let path = in_doubles(path.to_token_stream());
            quote!(<#of as #path>)
        }
    };
    let call = quote!(#on::#function(#(#names),*));
    let plain = |tokens: &TokenStream| tokens.to_string().split('<').next().unwrap_or_default().trim().to_owned();
    let by = called.map_or(String::new(), |path| format!("_as_{}", path.segments.last().unwrap().ident));
    let name = quote::format_ident!("{}{by}_{function}", plain(&of));
    let text = match &signature.output {
        ReturnType::Default => quote!(pub fn #name(#(#parameters),*) { #call }),
        // The positions on all branches.
        ReturnType::Type(_, _) if signature.ident == "branches" => quote! {
            pub fn #name(#(#parameters),*) -> bool {
                #call.is_ok_and(|found| { found.for_each(|item| { ::core::hint::black_box(item); }); true })
            }
        },
        ReturnType::Type(_, of) if matches!(**of, Type::ImplTrait(_)) => quote! {
            pub fn #name(#(#parameters),*) { #call.for_each(|item| { ::core::hint::black_box(item); }) }
        },
        ReturnType::Type(_, of) => {
            let of = own(of.to_token_stream());
            quote!(pub fn #name(#(#parameters),*) -> #of { #call })
        }
    };
    format!("#[inline(never)] {text}\n")
}

/// `impl Into<X>` is an X, and `impl Fn(X) -> Y` a pointer.
fn argument_type(of: &Type) -> TokenStream {
    let Type::ImplTrait(bounds) = of else { return of.to_token_stream() };
    let Some(TypeParamBound::Trait(bound)) = bounds.bounds.first() else { return of.to_token_stream() };
    match bound.path.segments.last().map(|segment| &segment.arguments) {
        Some(PathArguments::AngleBracketed(arguments)) => arguments.args.to_token_stream(),
        Some(PathArguments::Parenthesized(of)) => quote!(fn #of),
        _ => of.to_token_stream(),
    }
}

/// f64 for T.
fn in_doubles(tokens: TokenStream) -> TokenStream {
    replaced(tokens, &|name| (name == "T").then(|| quote!(f64)))
}

/// The type for `Self`; where that leads to an associated type, the trait says of which implementation.
fn with_self(tokens: TokenStream, implementation: &ItemImpl, of: &TokenStream) -> TokenStream {
    let mechanism = implementation.items.iter().find_map(|item| match item {
        ImplItem::Type(item) if item.ident == "Mechanism" => Some(item.ty.to_token_stream()),
        _ => None,
    });
    let mut text = tokens.to_string();
    if let Some(mechanism) = mechanism {
        text = text.replace("Self :: Mechanism", &in_doubles(mechanism).to_string());
    }
    if let Some((path, _)) = &implementation.trait_ {
        let path = in_doubles(path.to_token_stream());
        // What an assembly says of positions is that of the mechanism.
        let mechanism = path.to_string().replace("Assembly", "Mechanism");
        text = text.replace("Self ::", &format!("< {of} as {mechanism} > ::"));
    }
    replaced(text.parse().unwrap(), &|name| (name == "Self").then(|| of.clone()))
}

fn replaced(tokens: TokenStream, by: &impl Fn(&Ident) -> Option<TokenStream>) -> TokenStream {
    let replace = |token| match token {
        TokenTree::Ident(name) => by(&name).unwrap_or_else(|| name.into_token_stream()),
        TokenTree::Group(group) => Group::new(group.delimiter(), replaced(group.stream(), by)).into_token_stream(),
        other => other.into_token_stream(),
    };
    tokens.into_iter().map(replace).collect()
}
