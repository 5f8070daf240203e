//! Singular configurations, in which the inputs cannot drive the mechanism, and the rates that are possible there.
//!
//! The velocities solve J u' = -A v'. A configuration is singular where det J = 0: the rank of J is less than the
//! number of unknowns, so that
//!
//! - some rates of unknowns can be chosen freely: those with J u' = 0, the null vectors of J ([`Singularity::free`]);
//! - the input rates cannot: only those with l . A v' = 0 for every l with l J = 0 are possible
//!   ([`Singularity::admissible`]);
//! - whether it is singular depends on which coordinate drives: another may drive where this one cannot
//!   ([`Singularity::drivers`]).
//!
//! A slider-crank driven by its slider is singular in its dead centres, where crank and rod are aligned; driven by its
//! crank only where the rod is perpendicular to the guide, which takes a rod as long as the crank. Source: lecture
//! notes "Analisi cinematica di velocità per meccanismi articolati piani", section 1.2, "Le configurazioni singolari".
//!
//! # Measures
//!
//! J mixes lengths with pure numbers, so its singular values depend on units. Therefore every row is divided by the
//! scale of its residual, the sum of the magnitudes of its terms, and every column by the largest magnitude that an
//! entry of it could then have. sigma min is the smallest singular value of this equilibrated J: between 0 and the root
//! of the number of unknowns, the same in every unit of length. A relative error `eps` of the residuals moves the
//! unknowns, multiplied by the divisors of their columns, by `eps / sigma_min`: [`accuracy`].
//!
//! ```
//! use linkage::{linkage, singularity};
//!
//! linkage! {
//!     mechanism SliderCrank {
//!         param z1 = 1, z2 = 3;
//!         coordinate z3, phi1, phi2;
//!         loop z1@phi1 + z2@phi2 = z3@0;
//!         drive Engine by z3;
//!         drive Compressor by phi1;
//!     }
//! }
//!
//! // The top dead centre: crank and rod in line.
//! let engine = Engine::default();
//! let pose = engine.pose_at(&SliderCrankCoordinates { z3: 4.0, phi1: 0.0, phi2: 0.0 });
//! let found = singularity::report(&engine, &pose).unwrap();
//! assert!(found.is_singular());
//! assert_eq!(found.rank(), 1);
//! // The piston must rest; the crank may turn, the rod a third as fast the other way.
//! assert_eq!(found.admissible().count(), 0);
//! let free = found.free().next().unwrap();
//! assert!((free[0] / free[1] + 3.0).abs() < 1e-15);
//! // Either angle could drive here.
//! let mut drivers: Vec<_> = found.drivers().map(|driver| driver.unknown).collect();
//! drivers.sort_unstable();
//! assert_eq!(drivers, ["phi1", "phi2"]);
//! println!("{found}");
//!
//! // Driven by its crank it is far from singular there.
//! let compressor = Compressor::default();
//! let pose = compressor.assemble(0.0, CompressorBranch { z3_phi2: linkage::Slider::Far }).unwrap();
//! assert!(!singularity::report(&compressor, &pose).unwrap().is_singular());
//! ```

mod decomposition;

use core::fmt;

#[cfg(feature = "serde")]
use serde::ser::SerializeStruct;

use crate::error::{all_finite, finite};
use crate::jacobian::ulp::{ZERO_ULPS, ulps};
use crate::jacobian::{Blocks, largest_entries, scale_or_one};
use crate::scalar::arithmetic::*;
use crate::scalar::{largest, relative, to_f64};
#[cfg(feature = "serde")]
use crate::serialised::Sequence;
use crate::{Build, Column, Dim, Group, Matrix, Mechanism, Name, PerInput, PerUnknown, PositionErrorOf, Real, real};
use decomposition::Decomposition;

/// The distance of a position from a singular configuration, and the rates that are possible at it.
pub struct Singularity<M: Mechanism> {
    determinant: M::Scalar,
    rank: usize,
    sigma_min: M::Scalar,
    groups: Column<GroupMeasure<M::Scalar, M::Name>, M::G>,
    rank_with_inputs: usize,
    /// Null vectors of J: the last U - rank columns.
    free: Matrix<M::Scalar, M::U, M::U>,
    /// Admissible rates of the inputs: the last `admissible_count` columns.
    admissible: Matrix<M::Scalar, M::V, M::V>,
    admissible_count: usize,
    /// sigma min with an input in place of an unknown; zero if that is singular.
    exchanges: Matrix<M::Scalar, M::U, M::V>,
    mechanism: M::Name,
    unknowns: Column<M::Name, M::U>,
    inputs: Column<M::Name, M::V>,
}

crate::__by_fields!([M: Mechanism] Singularity<M> { determinant, rank, sigma_min, groups, rank_with_inputs, free, admissible, admissible_count, exchanges, mechanism, unknowns, inputs });

/// The distance of one group of unknowns from a singularity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GroupMeasure<T, N = &'static str> {
    /// The unknowns by name.
    pub name: N,
    /// The determinant of the group's block of J, in the units of the mechanism.
    pub determinant: T,
    /// Nondimensional, 0 if the group is singular. For one and two unknowns the determinant divided by the largest
    /// product of entries that it could be made of (for a dyad RRR |sin| of the angle between its links, for a slider
    /// on a guide |cos| of the pressure angle), for more unknowns the smallest pivot of the equilibrated block.
    pub regularity: T,
    /// The smallest singular value of the equilibrated block.
    pub sigma_min: T,
    /// True if the block has full rank.
    pub is_regular: bool,
}

/// An unknown that could take the place of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Exchange<T, N = &'static str> {
    /// The unknown that would drive.
    pub unknown: N,
    /// The input that would be driven.
    pub input: N,
    /// sigma min of the mechanism driven that way.
    pub sigma_min: T,
}

/// The residual of a position, and the accuracy that a position can have there.
pub struct Accuracy<M: Mechanism> {
    /// The largest residual divided by the sum of the magnitudes of its terms.
    pub residual: M::Scalar,
    /// The smallest singular value of the equilibrated J.
    pub sigma_min: M::Scalar,
    /// The divisors of the columns of J.
    scales: PerUnknown<M>,
}

crate::__by_fields!([M: Mechanism] Accuracy<M> { residual, sigma_min, scales });

impl<M: Mechanism> Accuracy<M> {
    /// eps / sigma min: the relative error caused by one rounding error of the residuals. It is infinite in a singular
    /// configuration, where the position is a double root, accurate to about sqrt(eps).
    #[must_use]
    pub fn attainable(&self) -> M::Scalar {
        M::Scalar::default_epsilon() / self.sigma_min
    }

    /// The attainable error of each unknown, in radians and lengths.
    #[must_use]
    pub fn unknowns(&self) -> PerUnknown<M> {
        self.scales.map(|scale| self.attainable() / scale)
    }
}

/// The equilibrated J and A.
struct Equilibrated<M: Mechanism> {
    unknowns: Matrix<M::Scalar, M::U, M::U>,
    inputs: Matrix<M::Scalar, M::U, M::V>,
    residual_scales: PerUnknown<M>,
    /// The divisors of the columns of J and of A.
    unknown_scales: PerUnknown<M>,
    input_scales: PerInput<M>,
}

impl<M: Mechanism> Equilibrated<M> {
    fn of(mechanism: &M, pose: &M::Pose) -> Result<Self, PositionErrorOf<M>> {
        let residual_scales = mechanism.residual_scales(pose);
        let divisors = residual_scales.map(scale_or_one);
        let (unknowns, unknown_scales) =
            equilibrated(&divisors, &mechanism.jacobian_unknowns(pose), &mechanism.jacobian_unknowns_scales(pose));
        let (inputs, input_scales) =
            equilibrated(&divisors, &mechanism.jacobian_inputs(pose), &mechanism.jacobian_inputs_scales(pose));
        // Divided by infinite scales, everything would be zero.
        let scales = residual_scales.iter().chain(unknown_scales.iter()).chain(input_scales.iter());
        all_finite(
            mechanism.name(),
            Name::from_static("the Jacobian"),
            unknowns.iter().chain(inputs.iter()).chain(scales),
        )?;
        Ok(Self { unknowns, inputs, residual_scales, unknown_scales, input_scales })
    }
}

/// Divides the rows of a matrix by `divisors`, and its columns by the largest entry that they could then have.
///
/// These divisors are not those of [`Scales`](crate::jacobian::Scales): a row is divided by the sum of the magnitudes
/// of its terms here, to which its rounding error is proportional, and the column of an angle is divided like any
/// other, so that sigma min measures how well the constraints determine the unknowns, independently of the unit of an
/// angle.
fn equilibrated<T: Real, R: Dim, C: Dim>(
    divisors: &Column<T, R>,
    matrix: &Matrix<T, R, C>,
    largest: &Matrix<T, R, C>,
) -> (Matrix<T, R, C>, Column<T, C>) {
    let scales = largest_entries(largest, divisors).map(scale_or_one);
    let columns = matrix.columns().zip_map(&scales, |column, scale| column.component_div(divisors).map(|x| x / scale));
    (divisors.dim().columns(columns), scales)
}

/// The threshold up to which a singular value of `count` unknowns is zero.
fn threshold<T: Real>(count: usize) -> T {
    ulps(ZERO_ULPS * u32::try_from(count).map_or(f64::MAX, f64::from))
}

/// Analyses a position for singularity. It takes a singular value decomposition for each pair of an unknown and an
/// input, too slow for an inner loop.
///
/// # Errors
/// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if an entry of the Jacobian, a determinant or a rate is
/// not a finite number.
pub fn report<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<Singularity<M>, PositionErrorOf<M>> {
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let Equilibrated { unknowns: j, inputs: a, unknown_scales, input_scales, .. } = &equilibrated;
    let (u, v, g) = mechanism.dims();
    let zero = threshold::<M::Scalar>(u.count());
    let right = Decomposition::of(*j);
    let rank = right.rank(zero);
    // The left null vectors l, l J = 0, restrict the inputs to (l A) v' = 0.
    let left = Decomposition::of(j.transpose()).vectors;
    let mut conditions = left.tr_mul_matrix(a);
    for row in 0..rank {
        conditions.scale_row(row, M::Scalar::zero());
    }
    let conditions = Decomposition::of(conditions);
    let conditions_rank = conditions.rank(zero);
    let exchanges = u.matrix(v, |unknown, input| {
        let mut exchanged = *j;
        exchanged.set_column(unknown, a.column(input));
        let sigma_min = Decomposition::of(exchanged).least();
        if sigma_min > zero { sigma_min } else { M::Scalar::zero() }
    });
    let determinant = mechanism.determinant(pose);
    finite(mechanism.name(), Name::from_static("the determinant"), [determinant])?;
    all_finite(mechanism.name(), Name::from_static("a singular value"), right.values.iter())?;
    let blocks = Blocks::of(mechanism, pose);
    let groups = g.column(|place| measure(&blocks, place, mechanism.group(place)));
    let measures = groups.iter().flat_map(|group| [&group.determinant, &group.regularity, &group.sigma_min]);
    all_finite(mechanism.name(), Name::from_static("the determinant"), measures)?;
    let (free, admissible) = (in_units(right.vectors, unknown_scales), in_units(conditions.vectors, input_scales));
    all_finite(
        mechanism.name(),
        Name::from_static("a rate"),
        free.iter().chain(admissible.iter()).chain(exchanges.iter()),
    )?;
    Ok(Singularity {
        determinant,
        rank,
        sigma_min: right.least(),
        groups,
        rank_with_inputs: rank + conditions_rank,
        free,
        admissible,
        admissible_count: v.count() - conditions_rank,
        exchanges,
        mechanism: mechanism.name(),
        unknowns: u.column(|place| mechanism.unknown_name(place)),
        inputs: v.column(|place| mechanism.input_name(place)),
    })
}

/// Computes sigma min of a position only.
///
/// # Errors
/// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if an entry of the Jacobian is not a finite number.
pub fn sigma_min<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<M::Scalar, PositionErrorOf<M>> {
    let sigma_min = Decomposition::of(Equilibrated::of(mechanism, pose)?.unknowns).least();
    finite(mechanism.name(), Name::from_static("a singular value"), [sigma_min])?;
    Ok(sigma_min)
}

/// Computes the residual of a position and the accuracy that it can have, eps / sigma min.
///
/// # Errors
/// [`PositionError::NotFinite`](crate::PositionError::NotFinite) if a residual or an entry of the Jacobian is not a finite
/// number.
pub fn accuracy<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<Accuracy<M>, PositionErrorOf<M>> {
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let residual = mechanism.residual(pose);
    let residual =
        largest(residual.iter().zip(equilibrated.residual_scales.iter()).map(|(&psi, &scale)| relative(psi, scale)));
    finite(mechanism.name(), Name::from_static("the residual"), [residual])?;
    let sigma_min = Decomposition::of(equilibrated.unknowns).least();
    finite(mechanism.name(), Name::from_static("a singular value"), [sigma_min])?;
    Ok(Accuracy { residual, sigma_min, scales: equilibrated.unknown_scales })
}

/// Converts vectors of the equilibrated system to rates; the rate of the largest entry is 1.
fn in_units<T: Real, N: Dim>(vectors: Matrix<T, N, N>, scales: &Column<T, N>) -> Matrix<T, N, N> {
    scales.dim().columns(vectors.columns().map(|vector| {
        let leading = vector.leading();
        let rates = vector.component_div(scales);
        rates.map(|rate| rate / scale_or_one(rates[leading]))
    }))
}

fn measure<M: Mechanism>(
    blocks: &Blocks<'_, M>,
    place: usize,
    group: Option<Group<'_, M::Name>>,
) -> GroupMeasure<M::Scalar, M::Name> {
    let members = group.unwrap_or(Group { name: Name::from_static(""), equations: &[], unknowns: &[] });
    // The rest of the diagonal is larger than any singular value of the block.
    let count = u32::try_from(blocks.unknowns()).map_or(f64::MAX, f64::from);
    let sigma_min = Decomposition::of(blocks.equilibrated(&members, real(count))).least();
    let is_regular = sigma_min > threshold(members.unknowns.len());
    let (determinant, regularity) = (blocks.determinants()[place], blocks.regularity(place));
    GroupMeasure { name: members.name, determinant, regularity, sigma_min, is_regular }
}

impl<M: Mechanism> Singularity<M> {
    /// The number of unknowns.
    fn count(&self) -> usize {
        self.free.dims().0.count()
    }

    /// det J.
    #[must_use]
    pub fn determinant(&self) -> M::Scalar {
        self.determinant
    }

    /// The rank of J.
    #[must_use]
    pub fn rank(&self) -> usize {
        self.rank
    }

    /// True if the rank of J is less than the number of unknowns: the inputs cannot drive the mechanism.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.rank < self.count()
    }

    /// The rank of [J A]. If it is less than the number of unknowns, the mechanism is singular for every choice of
    /// inputs: motions cross here, as in a flat parallelogram.
    #[must_use]
    pub fn rank_with_inputs(&self) -> usize {
        self.rank_with_inputs
    }

    /// The smallest singular value of the equilibrated J.
    #[must_use]
    pub fn sigma_min(&self) -> M::Scalar {
        self.sigma_min
    }

    /// The groups, in the order in which they are solved.
    pub fn groups(&self) -> impl Iterator<Item = &GroupMeasure<M::Scalar, M::Name>> {
        self.groups.iter()
    }

    /// A basis of the rates u' that are possible while the inputs rest; empty if J is regular. The rate of the largest
    /// entry of each is 1.
    pub fn free(&self) -> impl Iterator<Item = PerUnknown<M>> + Clone {
        (self.rank..self.count()).map(|column| self.free.column(column))
    }

    /// A basis of the possible rates v' of the inputs: as many as there are inputs if J is regular.
    pub fn admissible(&self) -> impl Iterator<Item = PerInput<M>> + Clone {
        let (_, v) = self.admissible.dims();
        (v.count() - self.admissible_count..v.count()).map(|column| self.admissible.column(column))
    }

    /// The exchanges of one input for one unknown that make J regular.
    pub fn drivers(&self) -> impl Iterator<Item = Exchange<M::Scalar, M::Name>> + Clone {
        let (u, v) = self.exchanges.dims();
        let pairs = (0..v.count()).flat_map(move |input| (0..u.count()).map(move |unknown| (unknown, input)));
        pairs.filter_map(|(unknown, input)| {
            let sigma_min = self.exchanges[(unknown, input)];
            let exchange = Exchange { unknown: self.unknowns[unknown], input: self.inputs[input], sigma_min };
            (sigma_min > M::Scalar::zero()).then_some(exchange)
        })
    }
}

/// The results of the functions are written, each under its name.
#[cfg(feature = "serde")]
impl<M: Mechanism<Scalar: serde::Serialize, Name: serde::Serialize>> serde::Serialize for Singularity<M> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Singularity", 8)?;
        fields.serialize_field("determinant", &self.determinant)?;
        fields.serialize_field("rank", &self.rank)?;
        fields.serialize_field("rank_with_inputs", &self.rank_with_inputs)?;
        fields.serialize_field("sigma_min", &self.sigma_min)?;
        fields.serialize_field("groups", &self.groups)?;
        fields.serialize_field("free", &Sequence(self.free()))?;
        fields.serialize_field("admissible", &Sequence(self.admissible()))?;
        fields.serialize_field("drivers", &Sequence(self.drivers()))?;
        fields.end()
    }
}

/// The results of the functions are written, each under its name.
#[cfg(feature = "serde")]
impl<M: Mechanism<Scalar: serde::Serialize>> serde::Serialize for Accuracy<M> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Accuracy", 4)?;
        fields.serialize_field("residual", &self.residual)?;
        fields.serialize_field("sigma_min", &self.sigma_min)?;
        fields.serialize_field("attainable", &self.attainable())?;
        fields.serialize_field("unknowns", &self.unknowns())?;
        fields.end()
    }
}

impl<M: Mechanism> fmt::Display for Singularity<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = if self.is_singular() { "singular" } else { "regular" };
        writeln!(
            f,
            "{} is {kind}: det J = {:.3e}, rank {} of {}, sigma min {:.1e}",
            self.mechanism,
            to_f64(self.determinant),
            self.rank,
            self.count(),
            to_f64(self.sigma_min)
        )?;
        for group in self.groups() {
            let (regularity, sigma_min) = (to_f64(group.regularity), to_f64(group.sigma_min));
            writeln!(f, "- {}: regularity {regularity:.1e}, sigma min {sigma_min:.1e}", group.name)?;
        }
        for free in self.free() {
            write!(f, "free:")?;
            rates(f, self.unknowns.as_slice(), free.iter())?;
        }
        if self.admissible_count == 0 {
            writeln!(f, "no input can move")?;
        } else if self.admissible_count < self.admissible.dims().1.count() {
            for admissible in self.admissible() {
                write!(f, "admissible:")?;
                rates(f, self.inputs.as_slice(), admissible.iter())?;
            }
        }
        if self.is_singular() {
            for Exchange { unknown, input, sigma_min } in self.drivers() {
                writeln!(f, "{unknown} could drive in place of {input}: sigma min {:.1e}", to_f64(sigma_min))?;
            }
        }
        Ok(())
    }
}

fn rates<'a, T: Real>(
    f: &mut fmt::Formatter<'_>,
    names: &[impl fmt::Display],
    rates: impl Iterator<Item = &'a T>,
) -> fmt::Result {
    for (name, rate) in names.iter().zip(rates) {
        write!(f, " {name}' = {:.4}", to_f64(*rate))?;
    }
    writeln!(f)
}
