//! Many positions at once: the type of the columns to find, the function that takes the given ones, and the
//! implementation of the runtime's trait.

mod columns;
mod given;

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::names::ident;
use super::rust::{argument, literal};
use crate::derivation::Derivation;
use crate::lower::Code;
use crate::program::{Access, Program};
use columns::{Column, Columns};
use given::Given;

/// The type of the columns; `batch` and the implementation of `Lanes`.
pub(super) fn of_driver(program: &Program<Code>, derivation: Option<&Derivation>) -> [TokenStream; 2] {
    let columns = Columns::of(program, derivation);
    [columns.emitted(program), implemented(program, &columns)]
}

fn implemented(program: &Program<Code>, columns: &Columns) -> TokenStream {
    let (name, branch) = (&program.signatures.driver.name, ident(&program.signatures.types.branch));
    let given = Given::of(program);
    let (batch, design) = (given.batch(name, &branch), given.design());
    let ([parameters, start], given_names) = (given.counts(), &given.names);
    let found_names = columns.all().map(|column| column.name.as_str());
    let [given_count, found_count, coordinates] =
        [given_names.len(), columns.all().count(), columns.coordinates.len()].map(literal);
    let in_lane = in_lane(program, columns, &given);
    let [of_given, of_branch, of_lane] = ["given", "branch", "lane"].map(|name| argument(name, in_lane.is_some()));
    let of_found = argument("found", in_lane.is_some() && !is_without_results(program));
    let (in_lane, exact) = (in_lane.unwrap_or_else(|| quote!(false)), exact(program, columns, &given));
    quote! {
        impl<T: __rt::Real> #name<T> {
            #batch
        }
        impl<T: __rt::Real> __rt::Lanes for #name<T> {
            type Scalar = T;
            type Branch = #branch;
            type Given = __rt::D<#given_count>;
            type Found = __rt::D<#found_count>;
            const NAME: &'static str = Self::NAME;
            const GIVEN: &'static [&'static str] = &[#(#given_names),*];
            const FOUND: &'static [&'static str] = &[#(#found_names),*];
            const PARAMETERS: usize = #parameters;
            const START: usize = #start;
            const COORDINATES: usize = #coordinates;
            #design
            #[inline(always)]
            fn lane<const W: usize, const QUANTITIES: bool>(
                &self,
                #of_given: &[[T; W]; #given_count],
                #of_branch: #branch,
                #of_lane: usize,
                #of_found: &mut [[T; W]; #found_count],
            ) -> bool {
                #in_lane
            }
            fn exact<const QUANTITIES: bool>(
                &self,
                given: &[T; #given_count],
                branch: #branch,
            ) -> __rt::Result<[T; #found_count], __rt::PositionError> {
                let mut found = [T::zero(); #found_count];
                #exact
                __rt::Ok(found)
            }
        }
    }
}

/// The body of the function for one lane without branches; `None` if there are no such formulas.
fn in_lane(program: &Program<Code>, columns: &Columns, given: &Given) -> Option<TokenStream> {
    let has =
        |name: &str| program.functions.iter().any(|function| function.access == Access::Lane && function.name == name);
    if !has("kinematics_in_lane") {
        return None;
    }
    let (kinematics, bound) = (ident(&program.signatures.types.kinematics), given.bound(&quote!([lane])));
    let on = on(program, "kinematics_in_lane");
    // The coordinates of an open chain are given: only points and outputs read its kinematics.
    let (found, taken) = match is_without_results(program) {
        true => (quote!(_), TokenStream::new()),
        false => (quote!(kinematics), quote!(let #kinematics { pose, rates, accelerations } = kinematics;)),
    };
    let store_coordinates = stored_in_lane(columns.coordinates.iter().map(|column| column.value.clone()), 0);
    let quantities = match columns.quantities.is_empty() {
        false if !has("quantities_in_lane") => quote!(false),
        true => {
            let (angles, flags) = angles_in_lane(columns);
            quote!(#angles is_accepted #(& #flags)*)
        }
        false => {
            let ((angles, flags), store_quantities) = (angles_in_lane(columns), quantities_in_lane(columns));
            let on = self::on(program, "quantities_in_lane");
            quote! {
                #angles
                let (quantities, are_accepted) = #on quantities_in_lane(pose, rates, accelerations);
                #store_quantities
                is_accepted & are_accepted #(& #flags)*
            }
        }
    };
    Some(quote! {
        #bound
        let (#found, is_accepted) = #on kinematics_in_lane(start, branch, rates, accelerations);
        #taken
        #store_coordinates
        if QUANTITIES { #quantities } else { is_accepted }
    })
}

/// The part of a call before the name of a function: some read no parameters and take no `self`.
fn on(program: &Program<Code>, name: &str) -> TokenStream {
    let is_method = program.functions.iter().any(|function| function.name == name && function.is_method);
    if is_method { quote!(self.) } else { quote!(Self::) }
}

/// True for an open chain whose points and outputs are not computed in lanes: its coordinates are given.
fn is_without_results(program: &Program<Code>) -> bool {
    let mut functions = program.functions.iter();
    let has_quantities =
        functions.any(|function| function.access == Access::Lane && function.name == "quantities_in_lane");
    program.signatures.is_open() && !has_quantities
}

/// The angles of a lane without branches, and the names of the flags that are true if they are right.
fn angles_in_lane(columns: &Columns) -> (TokenStream, Vec<Ident>) {
    let directions: Vec<&TokenStream> = columns.angles.iter().filter_map(|angle| angle.direction.as_ref()).collect();
    let flags: Vec<Ident> = (1..=directions.len()).map(|number| ident(&format!("has_angle_{number}"))).collect();
    let values = columns.angles.iter().map(|angle| match &angle.direction {
        Some(of) => quote!(__rt::lane::arctangent2(#of.im, #of.re)),
        None => angle.value.clone(),
    });
    let store = stored_in_lane(values, columns.coordinates.len());
    let statements = quote! {
        #store
        #(let #flags = __rt::lane::has_arctangent2(#directions.im, #directions.re);)*
    };
    (statements, flags)
}

/// Statements that store the points and outputs of a lane.
fn quantities_in_lane(columns: &Columns) -> TokenStream {
    let values = (0..columns.quantities.len()).map(literal).map(|place| quote!(quantities[#place]));
    stored_in_lane(values, columns.coordinates.len() + columns.angles.len())
}

/// The body of the function for one lane that calls `kinematics`, and the function for points and outputs.
fn exact(program: &Program<Code>, columns: &Columns, given: &Given) -> TokenStream {
    let (kinematics, bound) = (ident(&program.signatures.types.kinematics), given.bound(&TokenStream::new()));
    let (function, start) = match program.position.is_closed {
        true => (ident("kinematics"), quote!(start)),
        false => (ident("kinematics_near"), quote!(&start)),
    };
    // User functions need not have values.
    let has = |name: &str| program.functions.iter().any(|function| function.name == name);
    let function = if has("kinematics_alone") { ident("kinematics_alone") } else { function };
    let call = quote!(self.#function(#start, branch, rates, accelerations)?;);
    let store =
        |columns: &[Column], from| stored(columns.iter().map(|column| column.value.clone()), from, &TokenStream::new());
    let store_coordinates = store(&columns.coordinates, 0);
    let store_angles = store(&columns.angles, columns.coordinates.len());
    let from = columns.coordinates.len() + columns.angles.len();
    // A stub has no such function.
    let quantities = has("motion_of_quantities").then(|| {
        let places = (0..columns.quantities.len()).map(literal).map(|place| quote!(quantities[#place]));
        let store = stored(places, from, &TokenStream::new());
        let on = on(program, "motion_of_quantities");
        quote! {
            let quantities = #on motion_of_quantities(pose, rates, accelerations);
            #store
        }
    });
    // The coordinates of an open chain are given.
    if program.signatures.is_open() && quantities.is_none() {
        return quote!(#bound #call);
    }
    quote! {
        #bound
        let #kinematics { pose, rates, accelerations } = #call
        #store_coordinates
        if QUANTITIES {
            #store_angles
            #quantities
        }
    }
}

/// Statements that store the columns of a lane of a block from a place on.
fn stored_in_lane(values: impl Iterator<Item = TokenStream>, from: usize) -> TokenStream {
    stored(values, from, &quote!([lane]))
}

/// Statements that store columns from a place on; `index` follows the place.
fn stored(values: impl Iterator<Item = TokenStream>, from: usize, index: &TokenStream) -> TokenStream {
    let places = (from..).map(literal);
    let statements = places.zip(values).map(|(place, value)| quote!(found[#place] #index = #value;));
    statements.collect()
}
