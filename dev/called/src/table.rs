//! A list of calls, and the numbers that they take.

/// A mechanism or a scene with its functions.
#[derive(Debug)]
pub struct Called {
    /// The file of the gallery, without its ending.
    pub file: &'static str,
    pub mechanism: &'static str,
    /// The mechanism, or a driver of one with several.
    pub name: &'static str,
    pub scene: Option<&'static str>,
    /// The number of parameters.
    pub parameters: usize,
    /// The functions by their names.
    pub functions: &'static [(&'static str, Call)],
    /// The functions of a pose of the mechanism.
    pub of_pose: &'static [(&'static str, Call)],
}

/// A call: its result as `Debug` writes it.
pub type Call = fn(&mut dyn Numbers) -> String;

/// The numbers of a call, one after the other.
pub trait Numbers {
    fn number(&mut self) -> f64;
    /// A parameter, whose usual value this is; NaN if it has none.
    fn parameter(&mut self, usual: f64) -> f64;
    /// A choice between two solutions.
    fn side(&mut self) -> bool;
    /// The number of a position among several.
    fn position(&mut self) -> Option<usize>;
    /// The turns of an angle.
    fn turns(&mut self) -> i32;

    /// The numbers that follow are one value of this kind.
    fn begin(&mut self, _: Kind) {}
    /// A result, which may be the value of an argument.
    fn keep(&mut self, _: Kind, _: &[f64]) {}
    /// True if a pose has any numbers, not those of coordinates.
    fn is_any_pose(&mut self) -> bool {
        false
    }
    /// A direction of such a pose.
    fn direction(&mut self) -> ::linkage::nalgebra::UnitComplex<f64> {
        ::linkage::nalgebra::UnitComplex::new(self.number())
    }
}

/// The kinds of values with one number for each coordinate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    Coordinates,
    Rates,
    Accelerations,
    Jerks,
}

/// Numbers of a list; zeros follow the last.
#[derive(Debug)]
pub struct Listed<'n>(pub &'n [f64]);

impl Listed<'_> {
    /// The next number, which is an integer.
    fn count(&mut self) -> i32 {
        self.number() as i32
    }
}

impl Numbers for Listed<'_> {
    fn number(&mut self) -> f64 {
        match self.0.split_first() {
            Some((first, others)) => {
                self.0 = others;
                *first
            }
            None => 0.0,
        }
    }

    fn parameter(&mut self, _: f64) -> f64 {
        self.number()
    }

    fn side(&mut self) -> bool {
        self.count() != 0
    }

    /// 1 more than its number.
    fn position(&mut self) -> Option<usize> {
        usize::try_from(self.count()).ok()?.checked_sub(1)
    }

    fn turns(&mut self) -> i32 {
        self.count()
    }
}
