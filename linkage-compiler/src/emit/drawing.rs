//! The implementation of the runtime's trait for drawings.

use proc_macro2::TokenStream;
use quote::quote;

use super::names::string;
use super::rust::literal;
use crate::derivation::{Derivation, Part};
use crate::lower::Code;
use crate::program::Program;

pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>) -> TokenStream {
    let name = &program.signatures.driver.name;
    let skeleton = derivation.and_then(|derivation| derivation.skeleton.clone()).unwrap_or_default();
    let names = skeleton.joints.iter().map(|(name, _)| string(name));
    let parts = skeleton.parts.iter().map(part);
    let joints = derivation.map_or_else(|| quote!(::core::unreachable!()), |_| quote!(self.joints(pose).into()));
    let count = literal(2 * skeleton.joints.len());
    quote! {
        impl<T: __rt::Real> __rt::Skeleton for #name<T> {
            type Parts = __rt::D<#count>;
            const JOINTS: &'static [&'static str] = &[#(#names),*];
            const PARTS: &'static [__rt::Part] = &[#(#parts),*];
            fn joints(&self, pose: &Self::Pose) -> __rt::Column<T, Self::Parts> {
                #joints
            }
        }
    }
}

fn part(part: &Part) -> TokenStream {
    match part {
        Part::Ground(joint) => one("Ground", *joint),
        Part::Slider(joint) => one("Slider", *joint),
        Part::Trace(joint) => one("Trace", *joint),
        Part::Bar { joints, is_driven } => {
            let joints = joints.iter().map(|&joint| literal(joint));
            quote!(__rt::Part::Bar { joints: &[#(#joints),*], is_driven: #is_driven })
        }
        Part::Sleeve { pin, on, towards } => {
            let [pin, on] = [pin, on].map(|&joint| literal(joint));
            let towards = match towards.map(literal) {
                Some(joint) => quote!(__rt::Some(#joint)),
                None => quote!(__rt::None),
            };
            quote!(__rt::Part::Sleeve { pin: #pin, on: #on, towards: #towards })
        }
    }
}

fn one(kind: &str, joint: usize) -> TokenStream {
    let (kind, joint) = (super::names::ident(kind), literal(joint));
    quote!(__rt::Part::#kind(#joint))
}
