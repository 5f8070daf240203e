//! Functions without type parameters, each of which calls a function of emitted code.

use linkage_compiler::emit::type_tokens;
use linkage_compiler::program::Code;
use linkage_compiler::program::{Access, Argument, Associated, Function, Implementation, Implemented, Passed, Type};
use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use crate::constructors::over_scalar;
use crate::ident;
use crate::values::Values;

/// The type that has a function, and the trait of the function.
struct On<'p> {
    /// The name, and the type over the scalar `T`.
    name: &'p str,
    of: TokenStream,
    /// The trait, if it is not a function of the type itself.
    by: Option<Implemented>,
    error: &'p str,
}

impl Values<'_, '_> {
    /// A function without type parameters for each function that can be called: those of a type, and those of the traits by
    /// which general algorithms call it. `T` is the scalar.
    pub fn wrappers(&self) -> Vec<TokenStream> {
        let types = &self.program.signatures.types;
        let mut all = self.functions(&types.driver, "PositionError", self.program.functions.iter());
        for implementation in &self.program.implementations {
            all.extend(self.implementation(implementation));
        }
        for scene in &self.program.scenes {
            all.extend(self.functions(&scene.signatures.types.itself, "MotionError", scene.functions.iter()));
            all.extend(scene.implementation.iter().flat_map(|implementation| self.implementation(implementation)));
        }
        all.extend(self.constructors());
        all
    }

    /// The public functions of a type.
    fn functions<'f>(
        &self,
        name: &str,
        error: &str,
        functions: impl Iterator<Item = &'f Function<Code>>,
    ) -> Vec<TokenStream> {
        let of = over_scalar(name);
        let public = functions.filter(|function| function.access.is_public());
        public
            .map(|function| {
                let by = (function.access == Access::OfMechanism).then_some(Implemented::Mechanism);
                self.wrapper(&On { name, of: of.clone(), by, error }, function, &[])
            })
            .collect()
    }

    fn implementation(&self, of: &Implementation<Code>) -> Vec<TokenStream> {
        let name = &of.on;
        let on = if of.is_generic { over_scalar(name) } else { ident(name).to_token_stream() };
        match of.of {
            Implemented::Itself | Implemented::Mechanism | Implemented::Assembly | Implemented::Scene => {}
            Implemented::Lanes => return vec![run_of_a_batch(name, &on)],
            Implemented::Kinematic => return vec![provided(name, &on)],
            // They only list positions, and parts of a drawing.
            Implemented::Branches | Implemented::Skeleton => return Vec::new(),
        }
        let by = (of.of != Implemented::Itself).then_some(of.of);
        let functions = of.functions.iter().filter(|function| by.is_some() || function.access.is_public());
        let mechanism = self.program.implementations.iter().find(|one| one.of == Implemented::Mechanism);
        let types = [Some(of), mechanism].map(|one| one.map_or(&[][..], |one| &one.types));
        let on = On { name, of: on, by, error: of.error };
        let own = functions.map(|function| self.wrapper(&on, function, &types));
        let conversions = (of.of == Implemented::Mechanism).then(|| conversions(name, &on.of));
        own.chain(conversions.into_iter().flatten()).collect()
    }

    /// The wrapper of a function; associated types of a trait are in the lists.
    fn wrapper(&self, on: &On, function: &Function<Code>, types: &[&[(&'static str, Associated)]]) -> TokenStream {
        let own = |of: &Type| match of {
            Type::Itself => on.of.clone(),
            Type::OfTrait(name) => associated(name, types),
            other => type_tokens(other),
        };
        let itself = function.is_method.then(|| {
            let of = &on.of;
            quote!(itself: &#of)
        });
        let passed = function.arguments.iter().enumerate().map(|(place, Argument { passed, .. })| {
            let name = format_ident!("a{place}");
            match passed {
                Passed::ByValue(of) | Passed::Converted(of) => (name, own(of)),
                Passed::ByReference(of) => {
                    let of = own(of);
                    (name, quote!(&#of))
                }
                Passed::ByMutableReference(_) | Passed::Turns => unreachable!("no public function takes it"),
            }
        });
        let (names, of_arguments): (Vec<_>, Vec<_>) = passed.unzip();
        let parameters = itself.into_iter().chain(names.iter().zip(&of_arguments).map(|(name, of)| quote!(#name: #of)));
        let given =
            function.is_method.then(|| quote!(itself)).into_iter().chain(names.iter().map(|name| quote!(#name)));
        let (of, name) = (&on.of, ident(&function.name));
        let call = match on.by.and_then(Implemented::name).map(ident) {
            None => quote!(<#of>::#name(#(#given),*)),
            Some(by) => quote!(<#of as __rt::#by>::#name(#(#given),*)),
        };
        let by = on.by.and_then(Implemented::name).map_or(String::new(), |by| format!("_as_{by}"));
        let wrapper = format_ident!("{}{by}_{}", on.name, function.name);
        let each = quote!(.for_each(|item| { ::core::hint::black_box(item); }));
        let body = match &function.returns {
            // The positions on all branches.
            Type::Branches { .. } | Type::Iterator { .. } if function.is_fallible => {
                quote!(-> bool { #call.is_ok_and(|found| { found #each; true }) })
            }
            Type::Branches { .. } | Type::Iterator { .. } => quote!({ #call #each; }),
            returns => {
                let (returns, error) = (own(returns), ident(on.error));
                match function.is_fallible {
                    true => quote!(-> Result<#returns, __rt::#error> { #call }),
                    false => quote!(-> #returns { #call }),
                }
            }
        };
        quote!(#[inline(never)] pub fn #wrapper(#(#parameters),*) #body)
    }

    /// Wrappers of `full_kinematics` of a mechanism.
    pub fn kinematics(&self) -> Vec<TokenStream> {
        let name = ident(&self.program.signatures.types.driver);
        vec![quote! {
            #[inline(never)]
            pub fn #name(
                m: &#name<T>,
                guess: &<#name<T> as ::linkage::Mechanism>::Coordinates,
                branch: <#name<T> as ::linkage::Mechanism>::Branch,
                rates: <#name<T> as ::linkage::Mechanism>::Inputs,
            ) {
                ::core::hint::black_box(::linkage::Kinematic::full_kinematics(m, guess, branch, rates, rates).is_ok());
            }
        }]
    }
}

/// A type of a trait.
fn associated(name: &str, types: &[&[(&'static str, Associated)]]) -> TokenStream {
    let found = types.iter().flat_map(|list| list.iter()).find(|(other, _)| *other == name);
    match found.map(|(_, of)| of) {
        Some(Associated::Type(of)) => type_tokens(of),
        Some(Associated::Text) => quote!(&'static str),
        _ => unreachable!("no type `{name}`"),
    }
}

/// The conversions between columns and values by name, which the trait has.
fn conversions(name: &str, of: &TokenStream) -> [TokenStream; 4] {
    let by_columns = |function: &str, to: &str| {
        let [function, to, wrapper] =
            [function.to_owned(), to.to_owned(), format!("{name}_{function}")].map(|name| ident(&name));
        quote! {
            #[inline(never)]
            pub fn #wrapper(
                unknowns: ::linkage::PerUnknown<#of>,
                inputs: ::linkage::PerInput<#of>,
            ) -> <#of as __rt::Mechanism>::#to {
                <#of as __rt::Mechanism>::#function(unknowns, inputs)
            }
        }
    };
    let to_columns = |function: &str, from: &str| {
        let [function, from, wrapper] =
            [function.to_owned(), from.to_owned(), format!("{name}_{function}")].map(|name| ident(&name));
        quote! {
            #[inline(never)]
            pub fn #wrapper(from: &<#of as __rt::Mechanism>::#from) -> (::linkage::PerUnknown<#of>, ::linkage::PerInput<#of>) {
                <#of as __rt::Mechanism>::#function(from)
            }
        }
    };
    [
        by_columns("coordinates", "Coordinates"),
        by_columns("rates", "Rates"),
        to_columns("parts", "Coordinates"),
        to_columns("rate_parts", "Rates"),
    ]
}

/// The computation of many positions of a mechanism.
fn run_of_a_batch(name: &str, of: &TokenStream) -> TokenStream {
    let wrapper = format_ident!("{name}_run");
    quote! {
        #[inline(never)]
        pub fn #wrapper(
            batch: &::linkage::lanes::Batch<'_, #of>,
            found: &mut [Option<&mut [T]>],
            accepted: &mut [bool],
        ) -> Result<usize, ::linkage::InputError> {
            batch.run(found, accepted)
        }
    }
}

/// The functions of a mechanism that have a body in the runtime, which `provided` of the crate calls.
fn provided(name: &str, of: &TokenStream) -> TokenStream {
    let wrapper = format_ident!("{name}_provided");
    let associated = |name: &str| {
        let name = ident(name);
        quote!(<#of as ::linkage::Mechanism>::#name)
    };
    let [pose, q, branch, rates, inputs] = ["Pose", "Coordinates", "Branch", "Rates", "Inputs"].map(associated);
    quote! {
        #[inline(never)]
        pub fn #wrapper(
            m: &#of,
            poses: (&#pose, &#pose),
            at: (&#q, #branch),
            motion: (&#rates, &<#of as ::linkage::Kinematic>::Accelerations, #inputs),
        ) {
            crate::provided::call(m, poses, at, motion);
        }
    }
}
