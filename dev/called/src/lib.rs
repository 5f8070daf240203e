//! Every public function that `linkage!` emits for the mechanisms and scenes of the gallery, called from a list of numbers:
//! the parameters, those of the scene after those of its mechanism, then the arguments.

// The calls use its functions.
use linkage::Mechanism;

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
}

/// A call: its result as `Debug` writes it.
pub type Call = fn(&mut Numbers<'_>) -> String;

/// Numbers to be taken one after the other; zeros follow the last.
#[derive(Debug)]
pub struct Numbers<'n>(pub &'n [f64]);

impl Numbers<'_> {
    /// The next number.
    pub fn number(&mut self) -> f64 {
        match self.0.split_first() {
            Some((first, others)) => {
                self.0 = others;
                *first
            }
            None => 0.0,
        }
    }

    /// The next number, which is an integer: a side, 1 more than the number of a position, or a turn.
    pub fn count(&mut self) -> i32 {
        self.number() as i32
    }
}

include!(concat!(env!("OUT_DIR"), "/calls.rs"));
