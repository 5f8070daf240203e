//! Certificates of motions and enclosures over boxes of any mechanism, as texts.

use std::fmt::Debug;

use linkage::certify::{Certificate, Certify, Curve};
use linkage::circuits::{CircuitOptions, Circuits};
use linkage::enclose::PoseBox;
use linkage::{Branches, Certifiable, D, Interval, PerInput};

fn of_certificate<M: Certifiable<V = D<1>>>(found: &Certificate<M>) -> Vec<String> {
    let middle = Interval::from(found.inputs().middle());
    let ranges = found.joint_ranges();
    let ranges = ranges.iter().map(|range| format!("{} {:?}", range.of, range.proof));
    let pose = match found.pose_box(middle) {
        Ok(pose) => format!("{pose:?} {:?}", pose.velocity_ratios()),
        Err(error) => error.to_string(),
    };
    let outside = found.pose_box(Interval::ENTIRE).err().map(|error| error.to_string());
    let numbers = format!(
        "{} {:?} {:?} {:?} {:?} {:?}",
        found.boxes(),
        found.end(),
        found.start(),
        found.unknowns_at(middle),
        found.quantities(),
        found.velocity_ratios()
    );
    [found.to_string(), numbers, pose].into_iter().chain(outside).chain(ranges).collect()
}

fn of_curve<M: Certifiable<V = D<1>>>(found: &Curve<M>) -> Vec<String> {
    let dead_points = found.dead_points().iter().map(|at| format!("{} {:?} {:?}", at.group, at.input, at.unknowns));
    let numbers = format!("{} {:?} {:?}", found.boxes(), found.turns(), found.quantities());
    [found.to_string(), numbers].into_iter().chain(dead_points).collect()
}

/// The certificate of a turn.
pub fn turn<M: Certifiable<V = D<1>>>(m: &M, start: &M::Coordinates) -> Vec<String> {
    Certify::new(m).turn(start).map_or_else(|error| vec![error.to_string()], |found| of_certificate(&found))
}

/// Certificates of the motion through a position and of the circuits at an input, and enclosures at the position.
pub fn certificates<M: Certifiable<V = D<1>> + Branches>(m: &M, start: &M::Coordinates) -> Vec<String> {
    let input = M::inputs(start)[0];
    let mut all = Vec::new();
    for certify in [Certify::new(m), Certify::new(m).tolerance(1e-6), Certify::new(m).most_tests(2)] {
        for found in [certify.turn(start), certify.range(start, input + 0.2), certify.range(start, f64::NAN)] {
            all.extend(found.map_or_else(|error| vec![error.to_string()], |found| of_certificate(&found)));
        }
    }
    let curve = Certify::new(m).curve(start);
    all.extend(curve.map_or_else(|error| vec![error.to_string()], |found| of_curve(&found)));
    if let Ok(circuits) = Circuits::of(m, 0.7, CircuitOptions::default()) {
        for found in Certify::new(m).circuits(&circuits) {
            all.extend(found.map_or_else(|error| vec![error.to_string()], |found| of_curve(&found)));
        }
    }
    all.extend(boxes(m, start));
    all
}

/// Enclosures about a position, one of them over a box in which J is singular, and one over infinite intervals.
fn boxes<M: Certifiable<V = D<1>>>(m: &M, q: &M::Coordinates) -> Vec<String> {
    let (unknowns, inputs) = M::parts(q);
    let about = |radius: f64| {
        let wide = |value: f64| Interval::around(value, radius).unwrap_or(Interval::ENTIRE);
        PoseBox::new(m, unknowns.map(wide), inputs.map(wide))
    };
    let text = |found: Result<PoseBox<M>, _>| match found {
        Ok(pose) => {
            let one = PerInput::<M>::from([1.0]).map(Interval::from);
            let rates = pose.velocity(&one);
            let accelerations = rates.and_then(|rates| pose.acceleration(&rates, &one, &one));
            let infinite = pose.velocity(&one.map(|_| Interval::ENTIRE)).err().map(|error| error.to_string());
            format!("{pose:?} {} {} {} {infinite:?}", shown(&rates), shown(&accelerations), shown(&pose.sensitivity()))
        }
        Err(error) => linkage::enclose::EncloseErrorOf::<M>::to_string(&error),
    };
    [0.0, 1e-6, 3.0, f64::INFINITY].map(|radius| text(about(radius))).into()
}

fn shown<X: Debug, E: std::fmt::Display>(found: &Result<X, E>) -> String {
    found.as_ref().map_or_else(|error| error.to_string(), |found| format!("{found:?}"))
}
