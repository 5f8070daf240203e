//! A column: its name, the quantity of its numbers, and its unit.

/// The numbers of one name.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct Column {
    pub(crate) name: String,
    pub(crate) unit: Option<String>,
    pub(crate) values: Vec<f64>,
    #[cfg_attr(feature = "serde", serde(skip))]
    pub(crate) quantity: Quantity,
}

/// The kind of the numbers; that of an angle or a length with the order of its derivative by time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Quantity {
    /// Unknown, as that of an output.
    Plain,
    /// In radians.
    Angle(u8),
    Degrees(u8),
    Length(u8),
    Time,
    #[cfg(feature = "dynamics")]
    Force,
    /// A force times a length.
    #[cfg(feature = "dynamics")]
    Torque,
    /// A torque by time.
    #[cfg(feature = "dynamics")]
    Power,
}

/// The units in which a mechanism is given: those of length, time and force.
///
/// They must agree with the unit of mass: N is kg m/s^2. With lengths in mm, forces in N and times in s, masses are in
/// tonnes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units<'a> {
    /// The unit of lengths.
    pub length: &'a str,
    /// The unit of times.
    pub time: &'a str,
    /// The unit of forces.
    pub force: &'a str,
}

impl Units<'static> {
    /// m, s, N, and for masses kg.
    pub const SI: Self = Self { length: "m", time: "s", force: "N" };
}

impl Quantity {
    /// The unit; degrees have theirs also where no units are given.
    pub(crate) fn unit(self, units: Option<Units<'_>>) -> Option<String> {
        let time = units.map_or("s", |units| units.time);
        let by_time = |unit: &str, order: u8| match order {
            0 => unit.to_owned(),
            1 => format!("{unit}/{time}"),
            _ => format!("{unit}/{time}^{order}"),
        };
        if let Self::Degrees(order) = self {
            return Some(by_time("deg", order));
        }
        let Units { length, time, force: _force } = units?;
        match self {
            Self::Plain => None,
            Self::Angle(order) => Some(by_time("rad", order)),
            Self::Degrees(order) => Some(by_time("deg", order)),
            Self::Length(order) => Some(by_time(length, order)),
            Self::Time => Some(time.to_owned()),
            #[cfg(feature = "dynamics")]
            Self::Force => Some(_force.to_owned()),
            #[cfg(feature = "dynamics")]
            Self::Torque => Some(format!("{_force} {length}")),
            #[cfg(feature = "dynamics")]
            Self::Power if (_force, length, time) == ("N", "m", "s") => Some("W".to_owned()),
            #[cfg(feature = "dynamics")]
            Self::Power => Some(format!("{_force} {length}/{time}")),
        }
    }
}

impl Column {
    pub(crate) fn new(name: String, quantity: Quantity) -> Self {
        Self { name, unit: None, values: Vec::new(), quantity }
    }

    /// The name with the unit.
    pub(crate) fn head(&self) -> String {
        match &self.unit {
            Some(unit) => format!("{} [{unit}]", self.name),
            None => self.name.clone(),
        }
    }

    pub(crate) fn is_in_degrees(&self) -> bool {
        matches!(self.quantity, Quantity::Degrees(_))
    }

    pub(super) fn is_angle(&self) -> bool {
        matches!(self.quantity, Quantity::Angle(_))
    }

    pub(super) fn may_be_angle(&self) -> bool {
        matches!(self.quantity, Quantity::Angle(_) | Quantity::Degrees(_) | Quantity::Plain)
    }

    /// Converts radians to degrees; returns false if there is nothing to convert.
    pub(super) fn turn_to_degrees(&mut self) -> bool {
        let Quantity::Angle(order) = self.quantity else { return false };
        self.quantity = Quantity::Degrees(order);
        // The unit of time may be named already.
        let named = self.unit.as_deref().and_then(|unit| unit.strip_prefix("rad"));
        self.unit = named.map(|by_time| format!("deg{by_time}")).or_else(|| self.quantity.unit(None));
        for value in &mut self.values {
            *value = value.to_degrees();
        }
        true
    }
}
