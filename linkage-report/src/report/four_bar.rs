//! Loops of four turning joints, and their classes by Grashof's law.
//!
//! A link turns fully relative to the others if the sum of the shortest and the longest length is not larger than that of
//! the other two (F. Grashof, "Theoretische Maschinenlehre" 2, 1883), and then it is the shortest.

use std::fmt;

use linkage_runtime::derivation::KinematicChain;

use super::dyad::{Dyad, DyadKind, dot, scaled};
use super::local::{Local, Vector};

/// A loop of four links with turning joints, one of which is the ground.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FourBarLoop {
    /// The coordinates of the links in the order of the loop: that which drives the other two, the coupler, the output.
    pub links: [String; 3],
    /// The lengths of ground, driving link, coupler and output.
    pub lengths: [f64; 4],
    /// The class.
    pub class: GrashofClass,
    /// The sum of the two middle lengths less that of the shortest and the longest, divided by the sum of all: positive if
    /// the shortest link turns fully.
    pub margin: f64,
}

/// The class of a loop of four turning joints, seen from the link that drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum GrashofClass {
    /// The ground is the shortest link: both links on it turn fully.
    DoubleCrank,
    /// The driving link is the shortest: it turns fully, and the output swings.
    CrankRocker,
    /// The output is the shortest link: it turns fully, and the driving link swings.
    RockerCrank,
    /// The coupler is the shortest link: it turns fully, and both links on the ground swing.
    DoubleRocker,
    /// No link turns fully.
    TripleRocker,
    /// Both sums are equal up to rounding errors: the links can lie in line, where motions cross.
    ChangePoint,
}

/// The rounding error of a sum of two lengths, each with a few of its own, divided by the sum of all four.
const EQUAL: f64 = 8.0 * f64::EPSILON;

impl GrashofClass {
    /// The class of these lengths of ground, driving link, coupler and output, and the margin of
    /// [`FourBarLoop::margin`].
    #[must_use]
    pub fn of(lengths: [f64; 4]) -> (Self, f64) {
        let mut sorted = lengths;
        sorted.sort_by(f64::total_cmp);
        let [shortest, shorter, longer, longest] = sorted;
        let sum: f64 = lengths.iter().sum();
        let margin = ((shorter - shortest) - (longest - longer)) / sum;
        let [ground, driving, coupler, _] = lengths;
        let class = match shortest {
            _ if margin.abs() <= EQUAL => Self::ChangePoint,
            _ if margin < 0.0 => Self::TripleRocker,
            least if least == ground => Self::DoubleCrank,
            least if least == driving => Self::CrankRocker,
            least if least == coupler => Self::DoubleRocker,
            _ => Self::RockerCrank,
        };
        (class, margin)
    }
}

impl fmt::Display for GrashofClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::DoubleCrank => "double crank",
            Self::CrankRocker => "crank-rocker",
            Self::RockerCrank => "rocker-crank",
            Self::DoubleRocker => "double rocker",
            Self::TripleRocker => "triple rocker",
            Self::ChangePoint => "change-point linkage",
        })
    }
}

/// The loop of four turning joints that a dyad closes, if it does: two links from one that turns about the ground.
pub(super) fn of_dyad(local: &Local<'_, '_>, dyad: &Dyad) -> Option<FourBarLoop> {
    let derivation = local.derivation;
    let chain = derivation.chain.filter(|_| dyad.kind == DyadKind::Rrr)?;
    let names: Vec<&str> = derivation.unknowns.iter().chain(derivation.inputs).map(|symbol| symbol.name).collect();
    let coordinates = || names.iter().copied();
    let coordinate = |place: usize| names.get(place).copied().unwrap_or_default();
    // The link of each coordinate that alone is in its angle.
    let own = |name: &str| chain.links.iter().position(|link| link.turns_with == [name]);
    let [one, other] = dyad.unknowns.map(coordinate);
    let around = coordinates().filter(|driver| driver != &one && driver != &other).filter_map(|driver| {
        let ring = |coupler, output| {
            let links = [own(driver)?, own(coupler)?, own(output)?];
            is_ring(&chain, links).then_some([driver, coupler, output])
        };
        ring(one, other).or_else(|| ring(other, one))
    });
    let links = around.into_iter().next()?;
    // Another coordinate in these equations is one of another loop.
    let (of_unknowns, of_inputs) = (derivation.jacobian_unknowns, derivation.jacobian_inputs);
    let entries = of_unknowns.entries.iter().map(|entry| (entry.row, entry.column));
    let entries =
        entries.chain(of_inputs.entries.iter().map(|entry| (entry.row, derivation.unknowns.len() + entry.column)));
    let mut columns = entries.filter(|(row, _)| dyad.rows.contains(row)).map(|(_, column)| coordinate(column));
    if columns.any(|name| !links.contains(&name)) {
        return None;
    }
    let place = |name: &str| coordinates().position(|other| other == name);
    let mut vectors = Vec::new();
    for name in links {
        let rates = local.unit(place(name)?);
        // Of the angle of a link alone Psi_aa = -a.
        let vector = scaled(local.mixed(&rates, &rates, dyad.rows), -1.0);
        vectors.push(vector);
    }
    let [driving, coupler, output]: [Vector; 3] = vectors.try_into().ok()?;
    let ground = [0, 1].map(|axis| driving[axis] + coupler[axis] + output[axis]);
    let lengths = [ground, driving, coupler, output].map(|vector| dot(vector, vector).sqrt());
    let (class, margin) = GrashofClass::of(lengths);
    Some(FourBarLoop { links: links.map(str::to_owned), lengths, class, margin })
}

/// True for joints that turn between ground, first, second and third link and ground again.
fn is_ring(chain: &KinematicChain<'_>, [first, second, third]: [usize; 3]) -> bool {
    let meet = |one: usize, other: usize| {
        chain
            .joints
            .iter()
            .any(|joint| joint.slides_along.is_none() && (joint.links == [one, other] || joint.links == [other, one]))
    };
    meet(0, first) && meet(first, second) && meet(second, third) && meet(third, 0)
}
