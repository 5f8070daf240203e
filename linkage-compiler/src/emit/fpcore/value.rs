//! Values of a function that is executed with symbols.

use std::rc::Rc;

use linkage_ir::ValueId;

use crate::program::Order;

#[derive(Debug, Clone)]
pub(super) enum Value {
    Number(ValueId),
    /// The fields of a struct.
    Members(Rc<[(String, Value)]>),
    /// An array or a tuple.
    List(Rc<[Value]>),
    /// The columns of a matrix or a vector.
    Columns(Rc<[Value]>),
    Given(Given),
    Text(String),
    /// The turns of a branch, all zero: angles have their principal values.
    PrincipalTurns,
    /// No formula, or nothing that results depend on.
    Unknown,
}

/// An argument, or a part of one.
#[derive(Debug, Clone)]
pub(super) struct Given {
    pub(super) role: Role,
    /// The fields and indices that lead to the part.
    pub(super) path: Vec<String>,
}

/// The meaning of an argument.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Role {
    /// The parameters of a mechanism and of its scenes.
    Parameters,
    /// Coordinates, or their derivatives with respect to time.
    Motion(Order),
    /// The sides of groups, 1 for the positive root and -1 for the negative.
    Branch,
    Other(String),
}

impl Role {
    /// The key of a part of an argument.
    pub(super) fn key(&self, path: &[String]) -> (usize, String) {
        let argument = if let Self::Other(argument) = self { argument } else { "" };
        // A field that holds the mechanism is not a part of the name of a parameter.
        let path = if *self == Self::Parameters { &path[path.len().saturating_sub(1)..] } else { path };
        (self.number(), format!("{argument}.{}", path.join(".")))
    }

    /// The name of a field of an argument with this role.
    pub(super) fn name(&self, field: &str) -> String {
        let endings = ["", "_rate", "_acceleration", "_jerk"];
        let ending = match self {
            Self::Motion(order) => endings[*order as usize],
            Self::Branch => "_side",
            Self::Parameters | Self::Other(_) => "",
        };
        format!("{field}{ending}")
    }

    /// A number that tells roles apart.
    fn number(&self) -> usize {
        match self {
            Self::Parameters => 0,
            Self::Branch => 1,
            Self::Other(_) => 2,
            Self::Motion(order) => 3 + Order::ALL.iter().take_while(|other| *other != order).count(),
        }
    }
}

impl Value {
    pub(super) fn given(role: Role) -> Self {
        Self::Given(Given { role, path: Vec::new() })
    }

    pub(super) fn list(values: impl IntoIterator<Item = Self>) -> Self {
        Self::List(values.into_iter().collect())
    }

    pub(super) fn members(members: impl IntoIterator<Item = (impl Into<String>, Self)>) -> Self {
        Self::Members(members.into_iter().map(|(name, value)| (name.into(), value)).collect())
    }

    pub(super) fn field(&self, name: &str) -> Self {
        match self {
            Self::Members(members) => {
                members.iter().find(|(field, _)| field == name).map_or(Self::Unknown, |(_, value)| value.clone())
            }
            // `matrix.data.0` is the list of its columns.
            Self::Columns(_) if name == "data" => self.clone(),
            Self::Columns(columns) if name == "0" => Self::List(columns.clone()),
            Self::Given(Given { role, path }) => {
                let path = path.iter().cloned().chain([name.to_owned()]).collect();
                Self::Given(Given { role: role.clone(), path })
            }
            _ => Self::Unknown,
        }
    }

    pub(super) fn index(&self, place: usize) -> Self {
        match self {
            Self::List(values) => values.get(place).cloned().unwrap_or(Self::Unknown),
            Self::Given(_) => self.field(&place.to_string()),
            _ => Self::Unknown,
        }
    }

    /// Visits the numbers with their places in the value, such as `points.c.x` and `jacobian(0, 1)`.
    pub(super) fn each_number(&self, path: &str, visit: &mut dyn FnMut(&str, ValueId)) {
        match self {
            Self::Number(place) => visit(path, *place),
            Self::Members(members) => {
                for (name, value) in members.iter() {
                    value.each_number(&format!("{path}.{name}"), visit);
                }
            }
            Self::List(values) => {
                for (place, value) in values.iter().enumerate() {
                    value.each_number(&format!("{path}[{place}]"), visit);
                }
            }
            Self::Columns(columns) => {
                let is_vector = columns.len() == 1;
                for (column, entries) in columns.iter().enumerate() {
                    let Self::List(entries) = entries else { continue };
                    for (row, entry) in entries.iter().enumerate() {
                        let place =
                            if is_vector { format!("{path}[{row}]") } else { format!("{path}({row},{column})") };
                        entry.each_number(&place, visit);
                    }
                }
            }
            Self::Given(_) | Self::Text(_) | Self::PrincipalTurns | Self::Unknown => {}
        }
    }
}
