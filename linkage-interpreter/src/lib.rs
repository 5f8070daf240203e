//! Planar linkages at run time: the language of `linkage!` as text, and mechanisms with the bits of the emitted code.
//!
//! [`Program::compile`] takes a text, the inside of `linkage! { … }`, and returns its mechanisms, or the macro's own messages
//! with their places. A [`Mechanism`] with values of its parameters is a [`Design`]: it calls every function that the macro
//! emits by its name, with values by name, and computes many positions at once from columns. The scenes of a mechanism are
//! [`SceneDesign`]s.
//!
//! ```
//! use linkage_interpreter::{Data, Program};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let text = "
//!     mechanism FourBar {
//!         param l1 = 80, l2 = 20, l3 = 50, l4 = 70;
//!         input theta2;
//!         unknown theta3, theta4;
//!         loop l2@theta2 + l3@theta3 + l4@theta4 = l1@0;
//!         point C = l2@theta2 + l3@theta3;
//!     }
//! ";
//! let program = Program::compile(text).map_err(|messages| messages[0].clone())?;
//! let design = program.mechanism("FourBar")?.design().with("l2", 25.0)?;
//! let branch = Data::fields([("theta3_theta4", "left".into())]);
//! let pose = design.call("assemble", &[1.0.into(), branch])?;
//! let points = design.call("points", &[pose])?;
//! assert!(points.get("c.x").and_then(Data::number).is_some());
//! # Ok(())
//! # }
//! ```
//!
//! Numbers have the bits of the emitted code, since the functions of the runtime that it calls are called here: a compiled
//! function is read expression by expression, in the order of emitted code. Columns are computed in blocks, as `derive lanes`
//! does, which hides the cost of reading. [`Design::row`] computes one position after the other by the same tape, from lists of
//! numbers: a call by name, whose values have names and places in memory of their own, takes ten times as long.
//!
//! A [`Program`] is written and read by serde, so that a mechanism runs without its text; without the feature `compiler` it
//! runs without the compiler.
//!
//! [`Design::prepared`] makes a design ready for the algorithms of `linkage-runtime`, [`SceneDesign::prepared`] a scene for those of
//! `linkage-dynamics`: paths, limits, circuits and simulations take them as they take emitted ones.

mod at_run_time;
mod call_error;
mod columns;
#[cfg(feature = "compiler")]
mod compile;
mod convert;
mod data;
mod error;
mod formulas;
mod machine;
mod mechanism;
mod program;
mod shape;
mod tape;
mod words;
mod written;

pub use at_run_time::{
    AllCoordinates, AtRunTime, BranchAtRunTime, CertifiableAtRunTime, ContactCount, CoordinatesAtRunTime, Count,
    FormulasAtRunTime, JointCoordinates, JointForcesAtRunTime, NotPrepared, OfDesign, ParameterCount, PoseAtRunTime,
    Prepared, PreparedScene, QuantityCount, SceneAtRunTime, StateCount, WithFormulas,
};
pub use call_error::CallError;
pub use columns::{Columns, Rejected, Row, Values};
pub use data::Data;
pub use error::{Error, Mistake};
#[cfg(feature = "compiler")]
pub use linkage_compiler::text::Message;
pub use machine::Defect;
pub use mechanism::{Design, Mechanism, SceneDesign};
pub use shape::{Argument, Record, Shape};
pub use words::Words;

/// The mechanisms of a text. One with several choices of inputs is several.
#[derive(Debug, Clone)]
pub struct Program {
    mechanisms: Vec<Mechanism>,
}

/// The mechanisms of [`Program::compile_with`] as one that can be written.
impl FromIterator<Mechanism> for Program {
    fn from_iter<I: IntoIterator<Item = Mechanism>>(mechanisms: I) -> Self {
        Self::of(mechanisms.into_iter().collect())
    }
}

/// A message about a text as a whole.
#[cfg(feature = "compiler")]
fn without_place(text: String) -> Message {
    Message { line: 1, column: 1, length: 0, text, help: None }
}

impl Program {
    fn of(mechanisms: Vec<Mechanism>) -> Self {
        Self { mechanisms }
    }

    /// Compiles the mechanisms of a text. Its size, the work and the memory are bounded as those of the macro, which allows
    /// minutes.
    ///
    /// # Errors
    /// Those of [`compile_within`](Self::compile_within).
    #[cfg(feature = "compiler")]
    pub fn compile(text: &str) -> Result<Self, Vec<Message>> {
        Self::compile_within(text, linkage_compiler::budget::MOST_STEPS)
    }

    /// Compiles the mechanisms of a text, which may be that of a stranger, in this number of steps, each
    /// of some microseconds at most.
    ///
    /// Spans of `proc-macro2` that were made earlier on this thread have no places any more.
    ///
    /// # Errors
    /// The messages that the macro gives for this text, in the order of their places.
    #[cfg(feature = "compiler")]
    pub fn compile_within(text: &str, steps: usize) -> Result<Self, Vec<Message>> {
        Self::compile_with_within(text, steps, &[], |_| ())
            .map(|pairs| Self::of(pairs.into_iter().map(|(mechanism, ())| mechanism).collect()))
    }

    /// Compiles the mechanisms of a text as if each had these `derive` statements besides its own, and lends each as the compiler
    /// lowered it to a function: for readers of formulas that also run them.
    ///
    /// ```
    /// use linkage_interpreter::Program;
    ///
    /// let text = "mechanism Crank { param r = 2; input phi; point P = r@phi; }";
    /// let lent = Program::compile_with(text, &[], |lowered| lowered.derivation.points.len());
    /// let (mechanism, points) = &lent.unwrap()[0];
    /// assert_eq!((mechanism.name(), *points), ("Crank", 1));
    /// ```
    ///
    /// # Errors
    /// Those of [`compile_within`](Self::compile_within).
    #[cfg(feature = "compiler")]
    pub fn compile_with<R>(
        text: &str,
        requests: &[linkage_compiler::model::Request],
        f: impl FnMut(linkage_compiler::Lowered<'_>) -> R,
    ) -> Result<Vec<(Mechanism, R)>, Vec<Message>> {
        Self::compile_with_within(text, linkage_compiler::budget::MOST_STEPS, requests, f)
    }

    /// [`compile_with`](Self::compile_with) in this number of steps, as [`compile_within`](Self::compile_within).
    ///
    /// # Errors
    /// Those of [`compile_within`](Self::compile_within).
    #[cfg(feature = "compiler")]
    pub fn compile_with_within<R>(
        text: &str,
        steps: usize,
        requests: &[linkage_compiler::model::Request],
        mut f: impl FnMut(linkage_compiler::Lowered<'_>) -> R,
    ) -> Result<Vec<(Mechanism, R)>, Vec<Message>> {
        use linkage_compiler::{budget::Budget, model::Request, text};

        let requests: Vec<Request> = requests.iter().copied().chain([Request::Lanes]).collect();
        let compiled = text::compile_with(text, &Budget::new(steps), &requests, |lowered| {
            let driver = compile::driver(&lowered);
            (driver, f(lowered))
        })?;
        let drivers = compiled.into_iter().flat_map(|compiled| compiled.drivers);
        let mechanisms = drivers.map(|(driver, lent)| match driver {
            // As when it is read: what is compiled can be written and read again.
            Ok(driver) => match written::checked(&driver) {
                Ok(()) => Ok((Mechanism::new(driver.into()), lent)),
                Err(what) => Err(vec![without_place(format!("`{}` cannot be run: {what}", driver.name))]),
            },
            Err(untranslated) => Err(vec![without_place(untranslated.to_string())]),
        });
        mechanisms.collect()
    }

    /// The mechanisms, in their order.
    #[must_use]
    pub fn mechanisms(&self) -> &[Mechanism] {
        &self.mechanisms
    }

    /// The mechanism or the choice of inputs with this name.
    ///
    /// # Errors
    /// If there is none.
    pub fn mechanism(&self, name: &str) -> Result<&Mechanism, Mistake> {
        let found = self.mechanisms.iter().find(|mechanism| mechanism.name() == name);
        found.ok_or_else(|| Mistake::unknown(name, self.mechanisms.iter().map(Mechanism::name)))
    }
}
