//! Values of the types of a mechanism, made of numbers that are asked for one after the other.

use linkage_compiler::emit::Declared;
use linkage_compiler::model::{Driver, Mechanism};
use linkage_compiler::program::Code;
use linkage_compiler::program::{
    Argument, Coordinate, Parameter, Passed, Position, Program, SceneProgram, Type, TypeNames,
};
use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use crate::ident;

/// The types of a driver and of its scenes.
pub struct Values<'p, 'm> {
    /// The name of the file.
    pub file: &'p str,
    /// The module with the types.
    path: &'p TokenStream,
    pub program: &'p Program<Code>,
    pub mechanism: &'m Mechanism,
    pub driver: &'m Driver,
    types: &'p TypeNames,
    position: &'p Position,
}

impl<'p, 'm> Values<'p, 'm> {
    pub fn new(file: &'p str, path: &'p TokenStream, of: Declared<'m>, program: &'p Program<Code>) -> Self {
        let Declared { mechanism, driver } = of;
        Self { file, path, program, mechanism, driver, types: &program.signatures.types, position: &program.position }
    }

    /// The name of the module with the functions below.
    pub fn own(&self) -> Ident {
        format_ident!("{}_{}", self.file, self.driver.name.to_string())
    }

    /// A type of the mechanism.
    pub fn path(&self, name: &str) -> TokenStream {
        let (module, name) = (self.path, ident(name));
        quote!(#module::#name)
    }

    /// A module with functions that make a design, a design of each scene, and a pose of a design.
    pub fn module(&self) -> TokenStream {
        let own = self.own();
        let design = self.design();
        let scenes = self.program.scenes.iter().map(|scene| self.scene(scene));
        let pose = self.pose();
        quote! {
            #[allow(dead_code, non_snake_case, unused_variables, reason = "some types have few functions, or no numbers")]
            pub mod #own {
                use super::{Kind, Numbers};
                #design
                #(#scenes)*
                #pose
            }
        }
    }

    /// `design(n)`, a mechanism.
    fn design(&self) -> TokenStream {
        let path = self.path(&self.driver.name.to_string());
        let members = numbers(&self.program.signatures.parameters);
        let value = match self.program.signatures.parameters.len() {
            0 => quote!(#path::<f64>::default()),
            _ if self.has_defaults() => quote!(let usual = #path::<f64>::default(); #path::<f64> { #members }),
            _ => quote!(#path::<f64> { #members }),
        };
        quote!(pub fn design(n: &mut dyn Numbers) -> #path<f64> { #value })
    }

    fn has_defaults(&self) -> bool {
        has_defaults(&self.program.signatures.parameters)
    }

    /// The name of the function that makes a scene.
    pub fn scene_function(scene: &SceneProgram<Code>) -> Ident {
        format_ident!("scene_{}", scene.signatures.scene)
    }

    fn scene(&self, scene: &SceneProgram<Code>) -> TokenStream {
        let path = self.path(&scene.signatures.scene);
        let (function, field) = (Self::scene_function(scene), ident(&scene.signatures.field));
        let parameters = &scene.signatures.parameters;
        let has_defaults = self.has_defaults() && has_defaults(parameters);
        let usual = has_defaults.then(|| quote!(let usual = #path::<f64>::default();));
        let members: TokenStream = parameters.iter().map(|parameter| number(parameter, has_defaults)).collect();
        quote! {
            pub fn #function(n: &mut dyn Numbers) -> #path<f64> {
                #usual
                #path::<f64> { #field: design(n), #members }
            }
        }
    }

    /// `pose(n, m)`, a pose of the mechanism, or any numbers in its fields.
    fn pose(&self) -> TokenStream {
        let (of, path) = (self.path(&self.types.driver), self.path(&self.types.pose));
        let q = self.coordinates();
        let fields = self.program.derived.iter().flat_map(|derived| &derived.fields);
        let fields: TokenStream = fields
            .map(|field| {
                let name = ident(&field.name);
                match field.is_direction {
                    true => quote!(#name: n.direction(),),
                    false => quote!(#name: n.number(),),
                }
            })
            .collect();
        quote! {
            pub fn pose(n: &mut dyn Numbers, m: &#of<f64>) -> #path<f64> {
                if n.is_any_pose() { #path::<f64> { #fields } } else { ::linkage::Mechanism::pose_at(m, &#q) }
            }
        }
    }

    fn coordinates(&self) -> TokenStream {
        self.by_coordinate(Some("Coordinates"), &self.types.coordinates)
    }

    /// The statement that reads an argument of a function, and its use.
    pub fn argument(&self, of: &Argument) -> (TokenStream, TokenStream) {
        let name = format_ident!("argument_{}", of.name);
        let (value, is_borrowed) = match &of.passed {
            Passed::ByValue(of) | Passed::Converted(of) => (self.value(of), false),
            Passed::ByReference(of) => (self.value(of), true),
            Passed::ByMutableReference(_) | Passed::Turns => unreachable!("no public function takes it"),
        };
        (quote!(let #name = #value;), if is_borrowed { quote!(&#name) } else { quote!(#name) })
    }

    /// A value of a type, made by statements in which `m` is the mechanism or the scene, and `of` its mechanism.
    fn value(&self, of: &Type) -> TokenStream {
        let types = self.types;
        match of {
            Type::Scalar => quote!(n.number()),
            Type::Own(name) if *name == types.inputs => self.by_name(&self.path(name), &self.program.signatures.inputs),
            Type::Own(name) if *name == types.coordinates => self.coordinates(),
            Type::Own(name) if self.kind(name).is_some() => self.by_coordinate(self.kind(name), name),
            Type::Own(name) if *name == types.pose => {
                let own = self.own();
                quote!(#own::pose(n, of))
            }
            Type::Bare(name) if *name == types.branch => self.branch(&self.path(name)),
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

    /// The kind of a type with one number for each coordinate.
    fn kind(&self, name: &str) -> Option<&'static str> {
        let TypeNames { coordinates, rates, accelerations, jerks, .. } = self.types;
        let kinds =
            [(coordinates, "Coordinates"), (rates, "Rates"), (accelerations, "Accelerations"), (jerks, "Jerks")];
        kinds.into_iter().find_map(|(of, kind)| (of == name).then_some(kind))
    }

    fn by_coordinate(&self, kind: Option<&str>, name: &str) -> TokenStream {
        let value = self.by_name(&self.path(name), &self.program.signatures.coordinates);
        let kind = kind.map(ident);
        quote!({ n.begin(Kind::#kind); #value })
    }

    fn by_name(&self, path: &TokenStream, of: &[Coordinate]) -> TokenStream {
        let members: Vec<TokenStream> = of.iter().map(field).map(|field| quote!(#field: n.number())).collect();
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
            quote!(#field: if n.side() { ::linkage::#choice::#other } else { ::linkage::#choice::#one })
        });
        let modes = self.position.modes.iter().map(|modes| {
            let field = ident(&modes.field);
            quote!(#field: n.position().map_or(::linkage::AssemblyMode::OfGuess, ::linkage::AssemblyMode::Number))
        });
        let turns = self.position.turns_of_branch().iter().map(|turn| {
            let field = ident(&turn.field);
            quote!(#field: n.turns())
        });
        quote!(#path { #(#sides,)* #(#modes,)* #(#turns,)* })
    }

    /// The statement that gives the numbers of a result, by which later calls may be made, to be kept.
    pub fn kept(&self, result: &Type) -> Option<TokenStream> {
        let (of, found) = match result {
            Type::Own(name) if *name == self.types.pose => {
                (&self.types.coordinates, quote!(found.as_ref().map(|pose| pose.coordinates())))
            }
            Type::Own(name) => (name, quote!(&found)),
            Type::Around("Solution" | "AnyBranch", of) => match &**of {
                Type::Own(name) => (name, quote!(found.as_ref().map(|found| found.coordinates))),
                _ => return None,
            },
            _ => return None,
        };
        let kind = ident(self.kind(of)?);
        let fields = self.program.signatures.coordinates.iter().map(field);
        Some(quote!(if let Ok(found) = #found { n.keep(Kind::#kind, &[#(found.#fields),*]); }))
    }
}

/// The members of parameters, with usual values.
fn numbers(parameters: &[Parameter]) -> TokenStream {
    let has_usual = has_defaults(parameters);
    parameters.iter().map(|parameter| number(parameter, has_usual)).collect()
}

fn has_defaults(parameters: &[Parameter]) -> bool {
    parameters.iter().all(|parameter| parameter.default.is_some())
}

fn field(of: &Coordinate) -> Ident {
    ident(&of.name.field)
}

fn number(parameter: &Parameter, has_usual: bool) -> TokenStream {
    let field = ident(&parameter.name.field);
    match has_usual {
        true => quote!(#field: n.parameter(usual.#field),),
        false => quote!(#field: n.parameter(f64::NAN),),
    }
}
