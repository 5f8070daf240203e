//! Writes a call of each public function that the macro emits for the gallery.

use std::fs;
use std::path::{Path, PathBuf};

use linkage_compiler::ids::CoordinateId;
use linkage_compiler::lower::Code;
use linkage_compiler::model::{Driver, Mechanism, Scene};
use linkage_compiler::program::{Argument, Function, Passed, Program, Type, TypeNames};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use syn::Item;

const MECHANISMS: &str = "../gallery/src/mechanisms";

fn main() {
    println!("cargo::rerun-if-changed=build");
    println!("cargo::rerun-if-changed={MECHANISMS}");
    let mut files: Vec<PathBuf> =
        fs::read_dir(MECHANISMS).expect("the gallery").map(|one| one.unwrap().path()).collect();
    files.sort();
    let mut types = Vec::new();
    for path in files {
        let file = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let mechanisms = linkage_compiler::read(tokens_of(&path)).expect("a mechanism without mistakes");
        for mechanism in &mechanisms {
            types.extend(
                linkage_compiler::each_driver(mechanism, |lowered| of_program(&file, &lowered.program))
                    .expect("it compiles")
                    .into_iter()
                    .flatten(),
            );
        }
    }
    let all = quote! {
        /// The types of the gallery with their functions.
        pub const ALL: &[Called] = &[#(#types),*];
    };
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("a folder"));
    fs::write(out.join("calls.rs"), all.to_string()).expect("a file that can be written");
}

/// The tokens between the braces of the `linkage!` of a file.
fn tokens_of(path: &Path) -> TokenStream {
    let file = syn::parse_file(&fs::read_to_string(path).expect("a text")).expect("Rust");
    let of = |item| match item {
        Item::Macro(item) if item.mac.path.is_ident("linkage") => Some(item.mac.tokens),
        _ => None,
    };
    file.items.into_iter().find_map(of).expect("one `linkage!`")
}

/// The types of a driver and of its scenes.
fn of_program(file: &str, program: &Program<Code>) -> Vec<TokenStream> {
    let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
    let of = Of {
        file,
        mechanism,
        driver,
        types: &program.signatures.types,
        position: &program.position,
        of_mechanism: quote!(m),
    };
    let name = format_ident!("{}", driver.name.to_string());
    let module = format_ident!("{file}");
    let parameters = mechanism.parameters.iter().map(|parameter| ident(&parameter.name.field));
    let members: Vec<TokenStream> = parameters.map(|field| quote!(#field: n.number())).collect();
    let path = quote!(::linkage_gallery::#module::#name::<f64>);
    let design = if members.is_empty() { quote!(#path::default()) } else { quote!(#path { #(#members,)* }) };
    let functions = program.functions.iter().filter(|function| function.access.is_public());
    let functions: Vec<TokenStream> = functions.map(|function| of.call(function, &design)).collect();
    let (mechanism_name, count) = (mechanism.name.to_string(), members.len());
    let text = driver.name.to_string();
    let mut all = vec![quote! {
        Called { file: #file, mechanism: #mechanism_name, name: #text, scene: None, parameters: #count, functions: &[#(#functions),*] }
    }];
    for scene in &program.scenes {
        let name = format_ident!("{}", scene.signatures.scene.name.to_string());
        let field = ident(&scene.signatures.field);
        let parameters: Vec<TokenStream> = own_parameters(mechanism, scene.signatures.scene);
        let own = format!("{}", scene.signatures.scene.name);
        let scene_design = quote!(::linkage_gallery::#module::#name::<f64> { #field: #design, #(#parameters,)* });
        let functions = scene.functions.iter().filter(|function| function.access.is_public());
        let of = Of { of_mechanism: quote!(m.#field), ..of.clone() };
        let functions: Vec<TokenStream> = functions.map(|function| of.call(function, &scene_design)).collect();
        let count = count + parameters.len();
        all.push(quote! {
            Called { file: #file, mechanism: #mechanism_name, name: #text, scene: Some(#own), parameters: #count, functions: &[#(#functions),*] }
        });
    }
    all
}

fn own_parameters(mechanism: &Mechanism, scene: &Scene) -> Vec<TokenStream> {
    let of = scene.parameters.iter().map(|&id| ident(&mechanism.scene_parameters[id].name.field));
    of.map(|field| quote!(#field: n.number())).collect()
}

fn ident(name: &str) -> proc_macro2::Ident {
    syn::parse_str(name).unwrap_or_else(|_| proc_macro2::Ident::new_raw(name, proc_macro2::Span::call_site()))
}

#[derive(Clone)]
struct Of<'p> {
    file: &'p str,
    mechanism: &'p Mechanism,
    driver: &'p Driver,
    types: &'p TypeNames,
    position: &'p linkage_compiler::program::Position,
    /// The mechanism of the value `m`.
    of_mechanism: TokenStream,
}

impl Of<'_> {
    fn call(&self, function: &Function<Code>, design: &TokenStream) -> TokenStream {
        let (name, text) = (ident(&function.name), &function.name);
        let arguments = function.arguments.iter().map(|argument| self.argument(argument));
        let (values, uses): (Vec<TokenStream>, Vec<TokenStream>) = arguments.unzip();
        let is_iterator = matches!(function.returns, Type::Branches { .. } | Type::Iterator { .. });
        let listed = is_iterator.then(|| quote!(.map(|found| found.collect::<Vec<_>>())));
        let call = match function.is_method {
            true => quote!(m.#name(#(#uses),*)),
            false => {
                let (module, of) = (format_ident!("{}", self.file), format_ident!("{}", self.driver.name.to_string()));
                quote!(::linkage_gallery::#module::#of::<f64>::#name(#(#uses),*))
            }
        };
        let is_deprecated = function.access == linkage_compiler::program::Access::Deprecated;
        let allowed = is_deprecated.then(|| quote!(#[expect(deprecated)]));
        quote! {
            (#text, |n| {
                let m = #design;
                #(#values)*
                let _ = &m;
                #allowed
                let found = #call #listed;
                format!("{found:?}")
            })
        }
    }

    /// The statement that reads an argument, and its use.
    fn argument(&self, of: &Argument) -> (TokenStream, TokenStream) {
        let name = format_ident!("argument_{}", of.name);
        let (value, is_borrowed) = match &of.passed {
            Passed::ByValue(of) | Passed::Converted(of) => (self.value(of), false),
            Passed::ByReference(of) => (self.value(of), true),
            Passed::ByMutableReference(_) | Passed::Turns => unreachable!("no public function takes it"),
        };
        (quote!(let #name = #value;), if is_borrowed { quote!(&#name) } else { quote!(#name) })
    }

    fn value(&self, of: &Type) -> TokenStream {
        let module = format_ident!("{}", self.file);
        let path = |name: &str| {
            let name = format_ident!("{name}");
            quote!(::linkage_gallery::#module::#name)
        };
        let types = self.types;
        match of {
            Type::Scalar => quote!(n.number()),
            Type::Own(name) if *name == types.inputs => self.by_name(&path(name), self.driver.inputs.iter()),
            Type::Own(name)
                if [&types.coordinates, &types.rates, &types.accelerations, &types.jerks].contains(&name) =>
            {
                self.by_name(&path(name), self.mechanism.coordinate_order(self.driver).iter())
            }
            Type::Own(name) if *name == types.pose => {
                let q = self.by_name(&path(&types.coordinates), self.mechanism.coordinate_order(self.driver).iter());
                {
                    let mechanism = self.of_mechanism.clone();
                    quote!(#mechanism.pose_at(&#q))
                }
            }
            Type::Bare(name) if *name == types.branch => self.branch(&path(name)),
            Type::Column(of, count) => {
                let of = (0..*count).map(|_| self.value(of));
                quote!(::linkage::Column::from([#(#of),*]))
            }
            Type::List(of, count) => {
                let of = (0..*count).map(|_| self.value(of));
                quote!([#(#of),*])
            }
            other => unreachable!("no public function takes {other:?}"),
        }
    }

    fn by_name<'c>(&self, path: &TokenStream, of: impl Iterator<Item = &'c CoordinateId>) -> TokenStream {
        let members: Vec<TokenStream> = of
            .map(|&id| ident(&self.mechanism.coordinates[id].name.field))
            .map(|field| quote!(#field: n.number()))
            .collect();
        // A type without fields has its scalar as a mark.
        match members.as_slice() {
            [] => quote!(#path::<f64>::from(::linkage::Column::zeros())),
            members => quote!(#path::<f64> { #(#members,)* }),
        }
    }

    fn branch(&self, path: &TokenStream) -> TokenStream {
        let sides = self.position.sides.iter().map(|side| {
            let (field, choice) = (ident(&side.field), format_ident!("{}", side.choice.name()));
            let [one, other] = side.choice.variants().map(|name| format_ident!("{name}"));
            quote!(#field: if n.count() == 0 { ::linkage::#choice::#one } else { ::linkage::#choice::#other })
        });
        let modes = self.position.modes.iter().map(|modes| {
            let field = ident(&modes.field);
            quote!(#field: match n.count() { 0 => ::linkage::AssemblyMode::OfGuess, count => ::linkage::AssemblyMode::Number(count as usize - 1) })
        });
        let turns = self.position.turns.iter().map(|turn| {
            let field = ident(&turn.field);
            quote!(#field: n.count())
        });
        quote!(#path { #(#sides,)* #(#modes,)* #(#turns,)* })
    }
}
