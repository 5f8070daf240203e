//! The found columns of a batch: their names, and where `kinematics` and `full_kinematics` hold their numbers.

use proc_macro2::{Ident, TokenStream};
use quote::quote;

use crate::derivation::Derivation;
use crate::emit::names::{comment, ident};
use crate::emit::rust::literal;
use crate::emit::types::{field, other_scalar};
use crate::graph::SymbolId;
use crate::ids::{ColumnId, CoordinateId};
use crate::lower::Code;
use crate::model::{Kind, Name};
use crate::program::{Program, Taken};

/// Endings of the names of a quantity and of its derivatives, with the fields of its motion.
const MOTION: [(&str, &str); 3] = [("", "position"), ("_rate", "velocity"), ("_acceleration", "acceleration")];

/// A found column.
pub struct Column {
    pub name: String,
    text: String,
    /// Its number among the results of `kinematics` or `full_kinematics`.
    pub value: TokenStream,
    /// For an angle computed from its direction, the direction.
    pub direction: Option<TokenStream>,
}

/// The columns of a driver, in the order of a batch.
pub struct Columns {
    /// Directions, lengths, rates and accelerations.
    pub coordinates: Vec<Column>,
    pub angles: Vec<Column>,
    /// Points and outputs.
    pub quantities: Vec<Column>,
}

impl Columns {
    pub fn of(program: &Program<Code>, derivation: Option<&Derivation>) -> Self {
        let mut columns = Self { coordinates: Vec::new(), angles: Vec::new(), quantities: Vec::new() };
        let mut taken = Taken::unreserved();
        columns.add_coordinates(program, derivation, &mut taken);
        columns.add_quantities(program, &mut taken);
        columns
    }

    /// Directions and lengths, then rates, then accelerations; and the angles.
    fn add_coordinates(&mut self, program: &Program<Code>, derivation: Option<&Derivation>, taken: &mut Taken) {
        let (mechanism, driver) = (program.signatures.mechanism, program.signatures.driver);
        let unknowns = driver.unknowns.iter().map(|&place| (place, &mechanism.coordinates[place].name));
        for (place, Name { text, field, .. }) in unknowns.clone() {
            match place_in_pose(program, derivation, place) {
                Held::Number(held) => {
                    let held = ident(&held);
                    self.coordinates.push(column(taken, field, format!("`{text}`."), quote!(pose.#held)));
                }
                Held::Direction(held, number) => {
                    let held = ident(&held);
                    for (part, function) in [("re", "cos"), ("im", "sin")] {
                        let (part, name) = (ident(part), format!("{function}_{field}"));
                        let text = format!("`{function}({text})`.");
                        self.coordinates.push(column(taken, &name, text, quote!(pose.#held.#part)));
                    }
                    let number = number.map(|number| ident(&number));
                    let value = match &number {
                        Some(number) => quote!(pose.#number),
                        None => quote!(pose.#held.im.arctangent2(pose.#held.re)),
                    };
                    let direction = number.is_none().then(|| quote!(pose.#held));
                    self.angles.push(Column { direction, ..column(taken, field, format!("`{text}`."), value) });
                }
            }
        }
        for (ending, of, word) in [("_rate", "rates", "rate"), ("_acceleration", "accelerations", "acceleration")] {
            let of = ident(of);
            for (_, name) in unknowns.clone() {
                let (field, text) = (field(name), format!("The {word} of `{}`.", name.text));
                self.coordinates.push(column(taken, &format!("{}{ending}", name.field), text, quote!(#of.#field)));
            }
        }
    }

    /// Points and outputs, each followed by its derivatives, as the function for one lane returns them.
    fn add_quantities(&mut self, program: &Program<Code>, taken: &mut Taken) {
        let mechanism = program.signatures.mechanism;
        for Name { text, field, .. } in mechanism.points.iter().map(|point| &point.name) {
            let of = ident(field);
            for (ending, member) in MOTION {
                let part = ident(member);
                for axis in ["x", "y"] {
                    let (name, text) =
                        (format!("{field}_{axis}{ending}"), format!("{axis} of the {member} of `{text}`."));
                    let axis = ident(axis);
                    self.quantities.push(column(taken, &name, text, quote!(points.#of.#part.#axis)));
                }
            }
        }
        for Name { text, field, .. } in mechanism.outputs.iter().map(|output| &output.name) {
            let of = ident(field);
            for (ending, member) in MOTION {
                let (part, text) = match ending {
                    "" => (ident("value"), format!("`{text}`.")),
                    ending => (ident(member), format!("The {} of `{text}`.", ending.trim_start_matches('_'))),
                };
                self.quantities.push(column(taken, &format!("{field}{ending}"), text, quote!(outputs.#of.#part)));
            }
        }
    }

    pub fn all(&self) -> impl Iterator<Item = &Column> {
        self.coordinates.iter().chain(&self.angles).chain(&self.quantities)
    }

    /// The type with one field for each column.
    pub fn emitted(&self, program: &Program<Code>) -> TokenStream {
        let (mechanism, driver) = (program.signatures.mechanism, &program.signatures.driver.name);
        let (visibility, name) = (&mechanism.visibility, ident(&program.signatures.types.columns));
        let fields: Vec<Ident> = self.all().map(|column| ident(&column.name)).collect();
        let docs = self.all().map(|column| comment(&format!(" {}", column.text)));
        let (count, entry) = (literal(fields.len()), other_scalar(mechanism));
        // The stub of a mechanism without coordinates has none.
        let none = fields.is_empty().then(|| quote!(scalar: ::core::marker::PhantomData<#entry>));
        let title = comment(&format!(
            " One entry for each column of a batch of [`{driver}`]: `Option<&mut [T]>` for the columns to find."
        ));
        quote! {
            #[doc = #title]
            #[derive(::core::clone::Clone, ::core::marker::Copy, ::core::fmt::Debug, ::core::default::Default)]
            #visibility struct #name<#entry> {
                #(#[doc = #docs] pub #fields: #entry,)*
                #none
            }
            impl<#entry> #name<#entry> {
                #[doc = " The columns in order, as `Batch::run` takes them."]
                #[must_use]
                pub fn list(self) -> [#entry; #count] {
                    [#(self.#fields),*]
                }
            }
        }
    }
}

fn column(taken: &mut Taken, name: &str, text: String, value: TokenStream) -> Column {
    Column { name: taken.unique(name), text, value, direction: None }
}

/// The fields of a pose that hold a coordinate.
enum Held {
    Number(String),
    /// The direction, and the number if there is one.
    Direction(String, Option<String>),
}

fn place_in_pose(program: &Program<Code>, derivation: Option<&Derivation>, place: CoordinateId) -> Held {
    let coordinate = &program.signatures.mechanism.coordinates[place];
    let name = &coordinate.name.field;
    let Some((derived, derivation)) = program.derived.as_ref().zip(derivation) else {
        // A stub is never run.
        return match coordinate.kind {
            Kind::Angle => Held::Direction(name.clone(), None),
            _ => Held::Number(name.clone()),
        };
    };
    let of_column = |column: &ColumnId| derivation.coordinates[*column].name == *name;
    let number = derived.pose.values.iter().find(|(column, ..)| of_column(column)).map(|(_, field, _)| field.clone());
    let symbol = derivation.coordinates.iter().find(|other| other.name == *name).map(|other| other.value);
    let is_it = |angle: Option<SymbolId>| angle.is_some() && angle == symbol;
    let mut directions = derived.pose.directions.iter();
    match directions.find(|(angle, _)| is_it(derivation.graph.as_symbol(**angle))) {
        Some((_, field)) => Held::Direction(field.clone(), number),
        None => Held::Number(number.unwrap_or_else(|| name.clone())),
    }
}
