//! Gears: a motion closes after several turns of the input.

use linkage::circuits::{CircuitOptions, Circuits, CurveEnd, CurveEvent};
use linkage::linkage;

use linkage_gallery::drag_link_drive::*;
use linkage_gallery::geared_five_bar::*;
use linkage_gallery::pin_and_slot::*;

use crate::circuits::{circuits, counts};

linkage! {
    /// A geared five-bar without an unknown for its second crank.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism HiddenGear {
        param a = 1, b = 2.4, d = 0.8, e = 2, ratio = 0.5, phase = 40deg;
        input theta;
        unknown phi, psi;
        loop a@theta + b@phi = e@0 + d@(ratio * theta + phase) + b@psi;
    }
    /// A pin turns a slotted wheel, which turns a pointer half as fast.
    #[derive(Debug, Clone, PartialEq)]
    pub mechanism HalfWheel {
        param pin = 3, offset = 1;
        input theta;
        unknown slot, s, half;
        loop pin@theta = offset@0 + s@slot;
        equation 2 * half = slot;
        point Pointer = 2@half;
    }
}

/// A ratio p/q closes after q turns. The positions at whole turns before that are not in the list of the start input.
#[test]
fn geared_five_bar_closes_after_the_denominator_of_its_ratio() {
    for (p, q) in [(-2.0, 1), (1.0, 2), (-2.0, 3), (5.0, 7)] {
        let ratio = p / f64::from(q);
        let seen = circuits(&GearedFiveBar { ratio, b: 2.4, c: 2.4, ..GearedFiveBar::default() }, 0.3);
        let hidden = circuits(&HiddenGear { ratio, ..HiddenGear::default() }, 0.3);
        assert_eq!([counts(&seen), counts(&hidden)], [[2, 2, 2]; 2], "{p}/{q}");
        let turns: Vec<i32> = seen
            .motions
            .iter()
            .map(|at| at.full_turns())
            .chain(hidden.motions.iter().map(|at| at.full_turns()))
            .collect();
        assert_eq!(turns, [q; 4], "{p}/{q}");
        for motion in &hidden.motions {
            let passed = motion.points.iter().filter(|at| matches!(at.event, Some(CurveEvent::Mode(None)))).count();
            assert_eq!(passed as i32, q - 1);
        }
        // Starts one turn apart are two sets of modes, but one motion.
        if q > 1 {
            let inputs = [0.3, 0.3 + std::f64::consts::TAU];
            let both =
                Circuits::over(&HiddenGear { ratio, ..HiddenGear::default() }, inputs, CircuitOptions::default());
            assert_eq!(counts(&both.unwrap()), [4, 2, 2], "{p}/{q}");
        }
    }
}

#[test]
fn irrational_gear_does_not_close() {
    let m = HiddenGear { ratio: 0.5_f64.sqrt(), ..HiddenGear::default() };
    let found = Circuits::of(&m, 0.3, CircuitOptions { most_turns: 12, ..CircuitOptions::default() }).unwrap();
    assert_eq!(counts(&found), [2, 2, 0]);
    assert!(found.motions.iter().all(|motion| motion.end == CurveEnd::Open));
}

/// Wheels behind an angle that turns fully: half an angle takes two turns, a rack never comes back.
#[test]
fn whole_turns_of_unknowns_matter_where_a_wheel_counts_them() {
    let found = circuits(&HalfWheel::default(), 0.4);
    assert_eq!(counts(&found), [2, 2, 2]);
    assert_eq!(found.motions.iter().map(|motion| motion.full_turns()).collect::<Vec<_>>(), [2, 2]);
    // Twice the angle of the slot, which is the direction of nothing, grows from turn to turn.
    let few = CircuitOptions { most_turns: 3, ..CircuitOptions::default() };
    let counted = Circuits::of(&PinAndSlot::default(), 0.4, few).unwrap();
    assert!(counted.motions.iter().all(|motion| motion.end == CurveEnd::Open));
    let drive = Circuits::of(&DragLinkDrive::default(), 0.4, few).unwrap();
    assert!(!drive.motions.is_empty() && drive.motions.iter().all(|motion| motion.end == CurveEnd::Open));
}
