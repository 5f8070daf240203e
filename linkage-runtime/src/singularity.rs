//! Singular configurations: where the inputs cannot drive the mechanism, and what moves there instead.
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
//! A slider-crank driven by its slider is singular where crank and rod are aligned, in its dead centres; driven by its
//! crank only where the rod stands across the guide, which takes a rod as long as the crank. Source: lecture notes
//! "Analisi cinematica di velocità per meccanismi articolati piani", section 1.2, "Le configurazioni singolari".
//!
//! # Measures
//!
//! J mixes lengths with pure numbers, so its singular values mean nothing by themselves. Here every row is divided by
//! the size of its closure, the sum of the magnitudes of its terms, and every column by the largest magnitude that an
//! entry of it could then have. sigma min is the smallest singular value of what is left: between 0 and the root of
//! the number of unknowns, the same in every unit of length. A relative error `eps` of the closures moves the unknowns
//! by `eps / sigma_min` of what the columns were divided by: [`accuracy`].
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
//! // The piston must stand still; the crank may turn, the rod a third as fast the other way.
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
//! let pose = compressor.assemble(0.0, CompressorBranch { phi2: linkage::Slope::Rising }).unwrap();
//! assert!(!singularity::report(&compressor, &pose).unwrap().is_singular());
//! ```

mod decomposition;

use core::fmt;

use crate::error::{all_finite, finite};
use crate::jacobian::rounding::{CLOSED, roundings};
use crate::jacobian::{Blocks, largest_entries, positive};
use crate::scalar::arithmetic::*;
use crate::scalar::{largest, relative, to_f64};
use crate::{Column, Dim, Matrix, Mechanism, PerInput, PerUnknown, PositionError, Real, real};
use decomposition::Decomposition;

/// How near a position is to a singular configuration, and what is special about it.
pub struct Singularity<M: Mechanism> {
    determinant: M::Scalar,
    rank: usize,
    sigma_min: M::Scalar,
    groups: Column<GroupMeasure<M::Scalar>, M::G>,
    rank_with_inputs: usize,
    /// The last U - rank columns.
    free: Matrix<M::Scalar, M::U, M::U>,
    /// The last `admissible_count` columns.
    admissible: Matrix<M::Scalar, M::V, M::V>,
    admissible_count: usize,
    /// sigma min with an input in place of an unknown, where that is regular.
    exchanges: Matrix<M::Scalar, M::U, M::V>,
}

crate::__by_fields!([M: Mechanism] Singularity<M> { determinant, rank, sigma_min, groups, rank_with_inputs, free, admissible, admissible_count, exchanges });

/// How near one group of unknowns is to being singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupMeasure<T> {
    /// The unknowns by name.
    pub name: &'static str,
    /// The determinant of the group's block of J, in the units of the mechanism.
    pub determinant: T,
    /// A pure number, 0 where the group is singular: of one and two unknowns the determinant beside the largest
    /// product of entries that it could be made of (of a dyad RRR |sin| of the angle between its links, of a slider
    /// on a guide |cos| of the pressure angle), of more unknowns the smallest pivot of the equilibrated block.
    pub regularity: T,
    /// The smallest singular value of the equilibrated block.
    pub sigma_min: T,
    /// Whether the block has full rank.
    pub is_regular: bool,
}

/// An unknown that could take the place of an input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exchange<T> {
    /// The unknown that would drive.
    pub unknown: &'static str,
    /// The input that would be driven.
    pub input: &'static str,
    /// sigma min of the mechanism driven that way.
    pub sigma_min: T,
}

/// What the residual and the singular values say of a position.
pub struct Accuracy<M: Mechanism> {
    /// The largest residual beside the sum of the magnitudes of its terms.
    pub residual: M::Scalar,
    /// The smallest singular value of the equilibrated J.
    pub sigma_min: M::Scalar,
    /// The divisors of the columns of J.
    scales: PerUnknown<M>,
}

crate::__by_fields!([M: Mechanism] Accuracy<M> { residual, sigma_min, scales });

impl<M: Mechanism> Accuracy<M> {
    /// eps / sigma min: the relative error that rounding the closures once explains. Infinite in a singular
    /// configuration, where the position is a double root and right to about the root of eps.
    #[must_use]
    pub fn attainable(&self) -> M::Scalar {
        M::Scalar::default_epsilon() / self.sigma_min
    }

    /// The same of each unknown by itself, in radians and lengths.
    #[must_use]
    pub fn unknowns(&self) -> PerUnknown<M> {
        self.scales.map(|scale| self.attainable() / scale)
    }
}

/// J and A with rows and columns of comparable sizes.
struct Equilibrated<M: Mechanism> {
    unknowns: Matrix<M::Scalar, M::U, M::U>,
    inputs: Matrix<M::Scalar, M::U, M::V>,
    sizes: PerUnknown<M>,
    /// What the columns of J and of A were divided by.
    unknown_scales: PerUnknown<M>,
    input_scales: PerInput<M>,
}

impl<M: Mechanism> Equilibrated<M> {
    fn of(mechanism: &M, pose: &M::Pose) -> Result<Self, PositionError> {
        let sizes = mechanism.closure_sizes(pose);
        let divisors = sizes.map(positive);
        let (unknowns, unknown_scales) =
            equilibrated(&divisors, &mechanism.jacobian_unknowns(pose), &mechanism.jacobian_unknowns_sizes(pose));
        let (inputs, input_scales) =
            equilibrated(&divisors, &mechanism.jacobian_inputs(pose), &mechanism.jacobian_inputs_sizes(pose));
        // Divided by infinite sizes everything would be zero.
        let scales = sizes.iter().chain(unknown_scales.iter()).chain(input_scales.iter());
        all_finite(M::NAME, "the Jacobian", unknowns.iter().chain(inputs.iter()).chain(scales))?;
        Ok(Self { unknowns, inputs, sizes, unknown_scales, input_scales })
    }
}

/// A matrix with its rows divided, and its columns by the largest entry that they could then have.
///
/// These are not the sizes of [`Scales`](crate::jacobian::Scales): a row is divided by what its rounding is in proportion
/// to, the sum of the magnitudes of its terms here, and the column of an angle is divided like any other, so that sigma min
/// says how the closures determine the unknowns and not how far a unit of an angle moves something.
fn equilibrated<T: Real, R: Dim, C: Dim>(
    divisors: &Column<T, R>,
    matrix: &Matrix<T, R, C>,
    sizes: &Matrix<T, R, C>,
) -> (Matrix<T, R, C>, Column<T, C>) {
    let scales = largest_entries(sizes, divisors).map(positive);
    let columns = matrix.columns().zip_map(&scales, |column, scale| column.component_div(divisors).map(|x| x / scale));
    (Matrix::from_columns(columns), scales)
}

/// Below this a singular value of `count` unknowns is zero.
fn threshold<T: Real>(count: usize) -> T {
    roundings(CLOSED * u32::try_from(count).map_or(f64::MAX, f64::from))
}

/// All that can be said of a position as to singularity. It takes a singular value decomposition for each pair of an
/// unknown and an input: a report, not a part of an inner loop.
///
/// # Errors
/// [`PositionError::NotFinite`] if an entry of the Jacobian, a determinant or a rate is not a finite number.
pub fn report<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<Singularity<M>, PositionError> {
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let Equilibrated { unknowns: j, inputs: a, unknown_scales, input_scales, .. } = &equilibrated;
    let zero = threshold::<M::Scalar>(M::U::COUNT);
    let right = Decomposition::of(*j);
    let rank = right.rank(zero);
    // l J = 0: what is left of the closures where no unknown can answer, (l A) v' = 0.
    let left = Decomposition::of(j.transpose()).vectors;
    let mut conditions = left.tr_mul_matrix(a);
    for row in 0..rank {
        conditions.scale_row(row, M::Scalar::zero());
    }
    let conditions = Decomposition::of(conditions);
    let conditions_rank = conditions.rank(zero);
    let exchanges = Matrix::<M::Scalar, M::U, M::V>::from_fn(|unknown, input| {
        let mut exchanged = *j;
        exchanged.set_column(unknown, a.column(input));
        let sigma_min = Decomposition::of(exchanged).least();
        if sigma_min > zero { sigma_min } else { M::Scalar::zero() }
    });
    let determinant = mechanism.determinant(pose);
    finite(M::NAME, "the determinant", [determinant])?;
    all_finite(M::NAME, "a singular value", right.values.iter())?;
    let blocks = Blocks::of(mechanism, pose);
    let groups = Column::<_, M::G>::from_fn(|group| measure(&blocks, group));
    let measures = groups.iter().flat_map(|group| [&group.determinant, &group.regularity, &group.sigma_min]);
    all_finite(M::NAME, "the determinant", measures)?;
    let (free, admissible) = (in_units(right.vectors, unknown_scales), in_units(conditions.vectors, input_scales));
    all_finite(M::NAME, "a rate", free.iter().chain(admissible.iter()).chain(exchanges.iter()))?;
    Ok(Singularity {
        determinant,
        rank,
        sigma_min: right.least(),
        groups,
        rank_with_inputs: rank + conditions_rank,
        free,
        admissible,
        admissible_count: M::V::COUNT - conditions_rank,
        exchanges,
    })
}

/// sigma min of a position by itself.
///
/// # Errors
/// [`PositionError::NotFinite`] if an entry of the Jacobian is not a finite number.
pub fn sigma_min<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<M::Scalar, PositionError> {
    let sigma_min = Decomposition::of(Equilibrated::of(mechanism, pose)?.unknowns).least();
    finite(M::NAME, "a singular value", [sigma_min])?;
    Ok(sigma_min)
}

/// The residual of a position and how accurate a position can be there: eps / sigma min.
///
/// # Errors
/// [`PositionError::NotFinite`] if a residual or an entry of the Jacobian is not a finite number.
pub fn accuracy<M: Mechanism>(mechanism: &M, pose: &M::Pose) -> Result<Accuracy<M>, PositionError> {
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let residual = mechanism.residual(pose);
    let residual = largest(residual.iter().zip(equilibrated.sizes.iter()).map(|(&psi, &size)| relative(psi, size)));
    finite(M::NAME, "the residual", [residual])?;
    let sigma_min = Decomposition::of(equilibrated.unknowns).least();
    finite(M::NAME, "a singular value", [sigma_min])?;
    Ok(Accuracy { residual, sigma_min, scales: equilibrated.unknown_scales })
}

/// Vectors of the equilibrated system as rates, the entry that counts most there being 1.
fn in_units<T: Real, N: Dim>(vectors: Matrix<T, N, N>, scales: &Column<T, N>) -> Matrix<T, N, N> {
    Matrix::from_columns(vectors.columns().map(|vector| {
        let leading = vector.leading();
        let rates = vector.component_div(scales);
        rates.map(|rate| rate / positive(rates[leading]))
    }))
}

fn measure<M: Mechanism>(blocks: &Blocks<M>, group: usize) -> GroupMeasure<M::Scalar> {
    let block = &M::GROUPS[group];
    // The block in the corner of a diagonal that is larger than any singular value of it.
    let count = u32::try_from(M::U::COUNT).map_or(f64::MAX, f64::from);
    let sigma_min = Decomposition::of(blocks.equilibrated(block, real(count))).least();
    let is_regular = sigma_min > threshold(block.unknowns.len());
    let (determinant, regularity) = (blocks.determinants()[group], blocks.regularity(group));
    GroupMeasure { name: block.name, determinant, regularity, sigma_min, is_regular }
}

impl<M: Mechanism> Singularity<M> {
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

    /// Whether the rank of J is less than the number of unknowns: the inputs cannot drive the mechanism.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.rank < M::U::COUNT
    }

    /// The rank of J and A together. Where it is less than the number of unknowns, no choice of inputs is regular:
    /// branches of motion meet here, as in a flat parallelogram.
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
    pub fn groups(&self) -> impl Iterator<Item = &GroupMeasure<M::Scalar>> {
        self.groups.iter()
    }

    /// A basis of the rates u' that are possible while the inputs stand still; none where J is regular. In each
    /// the rate that matters most is 1.
    pub fn free(&self) -> impl Iterator<Item = PerUnknown<M>> {
        (self.rank..M::U::COUNT).map(|column| self.free.column(column))
    }

    /// A basis of the input rates v' that are possible: as many as there are inputs where J is regular.
    pub fn admissible(&self) -> impl Iterator<Item = PerInput<M>> {
        (M::V::COUNT - self.admissible_count..M::V::COUNT).map(|column| self.admissible.column(column))
    }

    /// The exchanges of one input for one unknown with which J is regular.
    pub fn drivers(&self) -> impl Iterator<Item = Exchange<M::Scalar>> {
        let pairs = (0..M::V::COUNT).flat_map(|input| (0..M::U::COUNT).map(move |unknown| (unknown, input)));
        pairs.filter_map(|(unknown, input)| {
            let sigma_min = self.exchanges[(unknown, input)];
            let exchange = Exchange { unknown: M::UNKNOWNS[unknown], input: M::INPUTS[input], sigma_min };
            (sigma_min > M::Scalar::zero()).then_some(exchange)
        })
    }
}

impl<M: Mechanism> fmt::Display for Singularity<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.is_singular() { "singular" } else { "regular" };
        writeln!(
            f,
            "{} is {verdict}: det J = {:.3e}, rank {} of {}, sigma min {:.1e}",
            M::NAME,
            to_f64(self.determinant),
            self.rank,
            M::U::COUNT,
            to_f64(self.sigma_min)
        )?;
        for group in self.groups() {
            let (regularity, sigma_min) = (to_f64(group.regularity), to_f64(group.sigma_min));
            writeln!(f, "- {}: regular to {regularity:.1e}, sigma min {sigma_min:.1e}", group.name)?;
        }
        for free in self.free() {
            write!(f, "free:")?;
            rates(f, M::UNKNOWNS, free.iter())?;
        }
        if self.admissible_count == 0 {
            writeln!(f, "no input can move")?;
        } else if self.admissible_count < M::V::COUNT {
            for admissible in self.admissible() {
                write!(f, "admissible:")?;
                rates(f, M::INPUTS, admissible.iter())?;
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

fn rates<'a, T: Real>(f: &mut fmt::Formatter<'_>, names: &[&str], rates: impl Iterator<Item = &'a T>) -> fmt::Result {
    for (name, rate) in names.iter().zip(rates) {
        write!(f, " {name}' = {:.4}", to_f64(*rate))?;
    }
    writeln!(f)
}
