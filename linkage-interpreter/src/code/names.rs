//! Names of fields as numbers, so that the fields of a record are found without comparing texts.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::Name;

/// The names of a program.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Names(Vec<Arc<str>>);

macro_rules! known {
    ($($name:ident $number:literal $text:literal)*) => {
        /// The names that the machine itself uses, in the order of their numbers.
        const KNOWN: &[&str] = &[$($text),*];

        impl Name {
            $(pub(crate) const $name: Self = Self($number);)*
        }

        #[test]
        fn known_names_have_their_numbers() {
            let names = Names::default();
            $(assert_eq!(names.text(Name::$name), $text);)*
        }
    };
}

known! {
    RE 0 "re"
    IM 1 "im"
    X 2 "x"
    Y 3 "y"
    POSITION 4 "position"
    VELOCITY 5 "velocity"
    ACCELERATION 6 "acceleration"
    VALUE 7 "value"
    RATE 8 "rate"
    LINKS 9 "links"
    LINE 10 "line"
    SCALE 11 "scale"
    REACH_SQUARED 12 "reach_squared"
    DISTANCE_SQUARED 13 "distance_squared"
    FACTORS 14 "factors"
    CONSTANTS 15 "constants"
    IN_LOOP 16 "in_loop"
    ALONG 17 "along"
    Q 18 "q"
    INPUT_RATES 19 "input_rates"
    BRANCH 20 "branch"
    POSE 21 "pose"
    LEAST 22 "least"
    MOST 23 "most"
    IS_DIRECTION 24 "is_direction"
    NAME 25 "name"
    LAW 26 "law"
    LIMIT 27 "limit"
    FORCES 28 "forces"
    SCALES 29 "scales"
    SLOPES 30 "slopes"
    WITH 31 "with"
    BIAS 32 "bias"
    FACTOR 33 "factor"
    LOWER 34 "lower"
    UPPER 35 "upper"
    RESTITUTION 36 "restitution"
    RANGED 37 "Ranged"
    COORDINATES 38 "coordinates"
    ITERATIONS 39 "iterations"
    RESIDUAL 40 "residual"
    SAME_BRANCH 41 "same_branch"
    OF 42 "of"
    IS_ANGLE 43 "is_angle"
    INPUT 44 "input"
    GROUP 45 "group"
    END 46 "end"
    ASSEMBLED 47 "assembled"
    UNBUILDABLE 48 "unbuildable"
    EXACT 49 "Exact"
    JOINT_RANGE 50 "JointRange"
    BRACKETED 51 "Bracketed"
}

impl Default for Names {
    fn default() -> Self {
        Self(KNOWN.iter().map(|&text| text.into()).collect())
    }
}

impl Names {
    /// The number of a name, a new one if it has none.
    #[cfg(feature = "compiler")]
    pub(crate) fn of(&mut self, text: &str) -> Name {
        let found = self.find(text);
        found.unwrap_or_else(|| {
            self.0.push(text.into());
            Name(self.0.len() as u32 - 1)
        })
    }

    /// The number of a name.
    pub(crate) fn find(&self, text: &str) -> Option<Name> {
        self.0.iter().position(|name| **name == *text).map(|place| Name(place as u32))
    }

    /// The name of this number.
    pub(crate) fn text(&self, name: Name) -> &str {
        self.0.get(name.0 as usize).map_or("", |text| text)
    }

    /// The name of this number, shared.
    pub(crate) fn shared(&self, name: Name) -> Arc<str> {
        self.0.get(name.0 as usize).map_or_else(|| "".into(), Arc::clone)
    }
}
