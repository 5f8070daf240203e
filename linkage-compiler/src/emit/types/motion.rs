//! The names of results that hold a position with its motion: types of the runtime over those of the mechanism.

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::names::{comment, ident};
use crate::model::{Mechanism, TypeName};
use crate::program::TypeNames;

/// The results of `kinematics`, `full_kinematics` and `motion`.
pub(super) fn motions(mechanism: &Mechanism, name: &TypeName, types: &TypeNames, root: &TokenStream) -> TokenStream {
    let visibility = &mechanism.visibility;
    let has_quantities = !mechanism.points.is_empty() || !mechanism.outputs.is_empty();
    let full = has_quantities.then_some(("FullKinematicsOf", &types.full_kinematics));
    let all = [Some(("KinematicsOf", &types.kinematics)), full, Some(("MotionOf", &types.motion))];
    let named = all.into_iter().flatten().map(|(of, alias)| {
        let with = if of == "KinematicsOf" { "" } else { ", and the motion of points and outputs" };
        let title = comment(&format!(" A position of [`{name}`] with its rates and accelerations{with}."));
        let [alias, of] = [alias, of].map(ident);
        quote! {
            #[doc = #title]
            #visibility type #alias<T = f64> = #root::__rt::#of<#name<T>>;
        }
    });
    named.collect()
}
