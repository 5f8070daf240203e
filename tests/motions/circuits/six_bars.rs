//! Six-bars, legs and others of the gallery against the count by small steps.

use linkage::{Branches, D};

use linkage_gallery::andrews::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::jansen::*;
use linkage_gallery::klann::*;
use linkage_gallery::stephenson_i::*;
use linkage_gallery::stephenson_iii::*;
use linkage_gallery::watt_i::*;
use linkage_gallery::watt_ii::*;

use crate::circuits::by_steps::partition;
use crate::circuits::{circuits, counts};

/// The modes of each motion are those that small steps connect; returns the numbers of modes, circuits and full turns.
fn agrees<M>(m: &M, input: f64) -> [usize; 3]
where
    M: Branches<Scalar = f64, V = D<1>>,
{
    let found = circuits(m, input);
    let motions: Vec<usize> = found.modes.iter().map(|mode| mode.motion).collect();
    assert_eq!(motions, partition(m, input, 240), "{} at {input}", M::NAME);
    counts(&found)
}

#[test]
fn circuits_of_the_gallery() {
    for input in [0.2, 3.7] {
        assert_eq!(agrees(&WattI::default(), input), [4, 4, 4]);
        assert_eq!(agrees(&WattII::default(), input), [4, 4, 4]);
        assert_eq!(agrees(&StephensonIII::default(), input), [4, 4, 4]);
        assert_eq!(agrees(&Andrews::default(), input), [4, 4, 4]);
        assert_eq!(agrees(&GearedFiveBar::default(), input), [2, 2, 2]);
        // Two modes meet at dead points, and not at every input are there such modes.
        assert_eq!(agrees(&StephensonI::default(), input), [4, 3, 2]);
        assert_eq!(agrees(&Klann::default(), input), if input < 3.0 { [4, 3, 2] } else { [2, 2, 2] });
        assert_eq!(agrees(&Jansen::default(), input), if input < 3.0 { [32, 24, 16] } else { [24, 20, 16] });
    }
}
