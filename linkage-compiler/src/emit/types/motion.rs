//! The types of results that hold a position with its motion.

use proc_macro2::TokenStream;
use quote::quote;

use super::derives::{derives, derives_of_pose};
use crate::emit::names::{comment, ident};
use crate::model::{Mechanism, TypeName};
use crate::program::TypeNames;

/// The results of `kinematics` and `full_kinematics`.
pub(super) fn kinematics(mechanism: &Mechanism, name: &TypeName, types: &TypeNames, root: &TokenStream) -> TokenStream {
    let visibility = &mechanism.visibility;
    let [kinematics, full, pose, rates, accelerations] =
        [&types.kinematics, &types.full_kinematics, &types.pose, &types.rates, &types.accelerations]
            .map(|name| ident(name));
    let fields = quote! {
        #[doc = " The position."]
        pub pose: #pose<T>,
        #[doc = " The rates q'."]
        pub rates: #rates<T>,
        #[doc = " The accelerations q''."]
        pub accelerations: #accelerations<T>,
    };
    let derives = derives_of_pose(mechanism, root);
    let title = comment(&format!(" A position of [`{name}`] with its rates and accelerations."));
    let of_quantities = moving_quantities(mechanism, types, root);
    let full = (!of_quantities.is_empty()).then(|| {
        let title = comment(&format!(
            " A position of [`{name}`] with its rates and accelerations, and the motion of points and outputs."
        ));
        quote! {
            #[doc = #title]
            #derives
            #visibility struct #full<T: #root::__rt::Scalar = f64> { #fields #of_quantities }
        }
    });
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #kinematics<T = f64> { #fields }
        #full
    }
}

/// The fields of points and outputs with their derivatives.
fn moving_quantities(mechanism: &Mechanism, types: &TypeNames, root: &TokenStream) -> TokenStream {
    let points = (!mechanism.points.is_empty()).then(|| {
        let points = ident(&types.points);
        quote! {
            #[doc = " Positions, velocities and accelerations of the points."]
            pub points: #points<#root::__rt::PointMotion<T>>,
        }
    });
    let outputs = (!mechanism.outputs.is_empty()).then(|| {
        let outputs = ident(&types.outputs);
        quote! {
            #[doc = " Values, rates and accelerations of the outputs."]
            pub outputs: #outputs<#root::__rt::OutputMotion<T>>,
        }
    });
    quote!(#points #outputs)
}

/// The result of `motion`.
pub(super) fn motion(mechanism: &Mechanism, name: &TypeName, types: &TypeNames, root: &TokenStream) -> TokenStream {
    let (visibility, derives) = (&mechanism.visibility, derives(mechanism, root));
    let [motion, coordinates, rates, accelerations] =
        [&types.motion, &types.coordinates, &types.rates, &types.accelerations].map(|name| ident(name));
    let of_quantities = moving_quantities(mechanism, types, root);
    let title = comment(&format!(
        " A position of [`{name}`] with its rates and accelerations, and the motion of points and outputs."
    ));
    quote! {
        #[doc = #title]
        #derives
        #visibility struct #motion<T: #root::__rt::Scalar = f64> {
            #[doc = " The position q."]
            pub position: #coordinates<T>,
            #[doc = " The rates q'."]
            pub rates: #rates<T>,
            #[doc = " The accelerations q''."]
            pub accelerations: #accelerations<T>,
            #of_quantities
        }
    }
}
