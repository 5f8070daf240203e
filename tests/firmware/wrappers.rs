//! The text of the library: what is emitted for each mechanism, and a function without type parameters for each of
//! its functions, in `f64`.

use std::path::Path;

use linkage_generated::{Source, sources};
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

/// The files of the library by name, and how many functions of emitted code are wrapped in them.
pub fn files(root: &Path) -> (Vec<(String, String)>, usize) {
    let mut count = 0;
    let mut files = modules(root, &quote!(f64), |source| {
        let wrappers = source.wrappers();
        count += wrappers.len();
        wrappers
    });
    let (_, library) = files.last_mut().expect("the library");
    *library += &format!("{PLANTED}\n{PROVIDED}\n");
    (files, count)
}

/// The files of a library with `full_kinematics` of each mechanism whose groups all have closed forms, in `f32`.
pub fn in_floats(root: &Path) -> Vec<(String, String)> {
    modules(root, &quote!(f32), Source::kinematics)
}

/// The files of a library with the emitted code of each file, and wrappers of it over this scalar; its main file is the last.
fn modules(
    root: &Path,
    scalar: &TokenStream,
    mut wrappers: impl FnMut(&Source) -> Vec<TokenStream>,
) -> Vec<(String, String)> {
    let laws = root.join("dev/gallery/src/cam_laws.rs");
    let laws = laws.to_str().expect("a path of letters");
    let mut library = quote!(#![no_std] #[path = #laws] mod cam_laws;);
    let mut files = Vec::new();
    for source in sources(root, None) {
        let (name, emitted, wrappers) = (format_ident!("{}", source.file), source.emitted(), wrappers(&source));
        // Names of wrappers contain names of types, which are not in snake case. This test looks at machine code.
        library.extend(quote!(#[allow(warnings, reason = "`emitted_source` looks at them")] pub mod #name;));
        let text = quote! {
            #emitted
            pub mod wrappers {
                use super::*;
                use ::linkage::__rt;
                type T = #scalar;
                #(#wrappers)*
            }
        };
        files.push((format!("{}.rs", source.file), text.to_string()));
    }
    files.push(("lib.rs".to_owned(), library.to_string()));
    files
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
