//! Names of fields as numbers, so that the fields of a record are found without comparing texts.

use alloc::collections::BTreeMap;
use alloc::sync::Arc;
use alloc::vec::Vec;

use crate::Name;

/// The names of the fields of a program.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Vec<Arc<str>>", into = "Vec<Arc<str>>"))]
pub struct Names {
    all: Vec<Arc<str>>,
    numbers: BTreeMap<Arc<str>, Name>,
}

macro_rules! known {
    ($($name:ident $number:literal $text:literal)*) => {
        /// The names of fields of the runtime, in the order of their numbers.
        const KNOWN: &[&str] = &[$($text),*];

        #[allow(missing_docs, reason = "each is the name that it says")]
        impl Name {
            $(pub const $name: Self = Self::new($number);)*
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
    COORDINATES 37 "coordinates"
    ITERATIONS 38 "iterations"
    RESIDUAL 39 "residual"
    SAME_BRANCH 40 "same_branch"
    OF 41 "of"
    IS_ANGLE 42 "is_angle"
    INPUT 43 "input"
    GROUP 44 "group"
    END 45 "end"
    ASSEMBLED 46 "assembled"
    UNBUILDABLE 47 "unbuildable"
    EXACT 48 "Exact"
    JOINT_RANGE 49 "JointRange"
    BRACKETED 50 "Bracketed"
}

impl Default for Names {
    fn default() -> Self {
        KNOWN.iter().map(|&text| text.into()).collect::<Vec<_>>().into()
    }
}

impl From<Vec<Arc<str>>> for Names {
    fn from(all: Vec<Arc<str>>) -> Self {
        let numbers = all.iter().enumerate().map(|(number, text)| (Arc::clone(text), Name::new(number)));
        Self { numbers: numbers.collect(), all }
    }
}

impl From<Names> for Vec<Arc<str>> {
    fn from(names: Names) -> Self {
        names.all
    }
}

impl Names {
    /// The number of a name, a new one if it has none.
    pub fn of(&mut self, text: &str) -> Name {
        if let Some(known) = self.find(text) {
            return known;
        }
        let (text, name): (Arc<str>, _) = (text.into(), Name::new(self.all.len()));
        self.numbers.insert(Arc::clone(&text), name);
        self.all.push(text);
        name
    }

    /// True if there is a name of this number.
    #[must_use]
    pub fn has(&self, name: Name) -> bool {
        name.index() < self.all.len()
    }

    /// The number of a name.
    #[must_use]
    pub fn find(&self, text: &str) -> Option<Name> {
        self.numbers.get(text).copied()
    }

    /// The name of this number.
    #[must_use]
    pub fn text(&self, name: Name) -> &str {
        self.all.get(name.index()).map_or("", |text| text)
    }

    /// The name of this number, shared.
    #[must_use]
    pub fn shared(&self, name: Name) -> Arc<str> {
        self.all.get(name.index()).map_or_else(|| "".into(), Arc::clone)
    }
}
