//! Every public function that `linkage!` emits for the mechanisms and scenes of the gallery, called from a list of numbers:
//! the parameters, those of the scene after those of its mechanism, then the arguments.

mod table;

// The calls use its functions.
use linkage::Mechanism;

pub use table::{Call, Called, Kind, Listed, Numbers};

include!(concat!(env!("OUT_DIR"), "/calls.rs"));
