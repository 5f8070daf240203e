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

use nalgebra::{SMatrix, SVector};

use crate::error::all_finite;
use crate::scalar::{larger, largest, relative, to_f64};
use crate::{Error, Mechanism, Real, finite, real};
use decomposition::Decomposition;

/// A singular value below this many roundings for each unknown is zero.
const ROUNDINGS: f64 = 4.0;

/// How near a position is to a singular configuration, and what is special about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Singularity<T, const U: usize, const V: usize> {
    mechanism: &'static str,
    unknowns: [&'static str; U],
    inputs: [&'static str; V],
    determinant: T,
    rank: usize,
    sigma_min: T,
    groups: [GroupMeasure<T>; U],
    group_count: usize,
    rank_with_inputs: usize,
    /// The last U - rank columns.
    free: SMatrix<T, U, U>,
    /// The last `admissible_count` columns.
    admissible: SMatrix<T, V, V>,
    admissible_count: usize,
    /// sigma min with an input in place of an unknown, where that is regular.
    exchanges: SMatrix<T, U, V>,
}

/// How near one group of unknowns is to being singular.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroupMeasure<T> {
    /// The unknowns by name.
    pub name: &'static str,
    /// The determinant of the group's block of J, in the units of the mechanism.
    pub determinant: T,
    /// A pure number, 0 where the group is singular: of one and two unknowns the determinant beside the largest
    /// product of entries that it could be made of (of a dyad RRR |sin| of the angle between its links, of a slider
    /// on a guide |cos| of the pressure angle), of more unknowns the determinant beside the product of its columns.
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
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Accuracy<T, const U: usize> {
    /// The largest residual beside the sum of the magnitudes of its terms.
    pub residual: T,
    /// The smallest singular value of the equilibrated J.
    pub sigma_min: T,
    /// The divisors of the columns of J.
    scales: SVector<T, U>,
}

impl<T: Real, const U: usize> Accuracy<T, U> {
    /// eps / sigma min: the relative error that rounding the closures once explains. Infinite in a singular
    /// configuration, where the position is a double root and right to about the root of eps.
    #[must_use]
    pub fn attainable(&self) -> T {
        T::default_epsilon() / self.sigma_min
    }

    /// The same of each unknown by itself, in radians and lengths.
    #[must_use]
    pub fn unknowns(&self) -> SVector<T, U> {
        self.scales.map(|scale| self.attainable() / scale)
    }
}

/// J and A with rows and columns of comparable sizes.
struct Equilibrated<T, const U: usize, const V: usize> {
    unknowns: SMatrix<T, U, U>,
    inputs: SMatrix<T, U, V>,
    sizes: SVector<T, U>,
    /// What the columns of J and of A were divided by.
    unknown_scales: SVector<T, U>,
    input_scales: SVector<T, V>,
}

impl<T: Real, const U: usize, const V: usize> Equilibrated<T, U, V> {
    fn of<M: Mechanism<T, U, V>>(mechanism: &M, pose: &M::Pose) -> Result<Self, Error> {
        let (mut unknowns, mut inputs) = (mechanism.jacobian_unknowns(pose), mechanism.jacobian_inputs(pose));
        let sizes = mechanism.closure_sizes(pose);
        let (mut unknown_sizes, mut input_sizes) = mechanism.jacobian_sizes(pose);
        for row in 0..U {
            let size = positive(sizes[row]);
            unknowns.row_mut(row).unscale_mut(size);
            unknown_sizes.row_mut(row).unscale_mut(size);
            inputs.row_mut(row).unscale_mut(size);
            input_sizes.row_mut(row).unscale_mut(size);
        }
        let unknown_scales =
            SVector::<T, U>::from_fn(|column, _| positive(largest(unknown_sizes.column(column).iter().copied())));
        let input_scales =
            SVector::<T, V>::from_fn(|column, _| positive(largest(input_sizes.column(column).iter().copied())));
        for column in 0..U {
            unknowns.column_mut(column).unscale_mut(unknown_scales[column]);
        }
        for column in 0..V {
            inputs.column_mut(column).unscale_mut(input_scales[column]);
        }
        // Divided by infinite sizes everything would be zero.
        let scales = sizes.iter().chain(unknown_scales.iter()).chain(input_scales.iter());
        all_finite(M::NAME, "the Jacobian", unknowns.iter().chain(inputs.iter()).chain(scales))?;
        Ok(Self { unknowns, inputs, sizes, unknown_scales, input_scales })
    }
}

/// A divisor: what is zero divides nothing.
fn positive<T: Real>(size: T) -> T {
    if size.is_zero() { T::one() } else { size }
}

/// Below this a singular value of `count` unknowns is zero.
fn threshold<T: Real>(count: usize) -> T {
    real::<T>(ROUNDINGS * u32::try_from(count).map_or(f64::MAX, f64::from)) * T::default_epsilon()
}

/// All that can be said of a position as to singularity. It takes a singular value decomposition for each pair of an
/// unknown and an input: a report, not a part of an inner loop.
///
/// # Errors
/// [`Error::NotFinite`] if an entry of the Jacobian, a determinant or a rate is not a finite number.
pub fn report<T, M, const U: usize, const V: usize>(
    mechanism: &M,
    pose: &M::Pose,
) -> Result<Singularity<T, U, V>, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let Equilibrated { unknowns: j, inputs: a, unknown_scales, input_scales, .. } = &equilibrated;
    let zero = threshold::<T>(U);
    let right = Decomposition::of(*j);
    let rank = right.rank(zero);
    // l J = 0: what is left of the closures where no unknown can answer, (l A) v' = 0.
    let left = Decomposition::of(j.transpose()).vectors;
    let mut conditions = left.transpose() * a;
    for row in 0..rank {
        conditions.row_mut(row).fill(T::zero());
    }
    let conditions = Decomposition::of(conditions);
    let conditions_rank = conditions.rank(zero);
    let exchanges = SMatrix::<T, U, V>::from_fn(|unknown, input| {
        let mut exchanged = *j;
        exchanged.set_column(unknown, &a.column(input));
        let sigma_min = Decomposition::of(exchanged).least();
        if sigma_min > zero { sigma_min } else { T::zero() }
    });
    let determinant = mechanism.determinant(pose);
    finite(M::NAME, "the determinant", [determinant])?;
    all_finite(M::NAME, "a singular value", right.values.iter())?;
    let groups = core::array::from_fn(|group| measure(mechanism, pose, &equilibrated, group));
    let measures =
        groups.iter().flat_map(|group: &GroupMeasure<T>| [&group.determinant, &group.regularity, &group.sigma_min]);
    all_finite(M::NAME, "the determinant", measures)?;
    let (free, admissible) = (in_units(right.vectors, unknown_scales), in_units(conditions.vectors, input_scales));
    all_finite(M::NAME, "a rate", free.iter().chain(admissible.iter()).chain(exchanges.iter()))?;
    Ok(Singularity {
        mechanism: M::NAME,
        unknowns: M::UNKNOWNS,
        inputs: M::INPUTS,
        determinant,
        rank,
        sigma_min: right.least(),
        groups,
        group_count: M::GROUPS.len(),
        rank_with_inputs: rank + conditions_rank,
        free,
        admissible,
        admissible_count: V - conditions_rank,
        exchanges,
    })
}

/// sigma min of a position by itself.
///
/// # Errors
/// [`Error::NotFinite`] if an entry of the Jacobian is not a finite number.
pub fn sigma_min<T, M, const U: usize, const V: usize>(mechanism: &M, pose: &M::Pose) -> Result<T, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let sigma_min = Decomposition::of(Equilibrated::of(mechanism, pose)?.unknowns).least();
    finite(M::NAME, "a singular value", [sigma_min])?;
    Ok(sigma_min)
}

/// The residual of a position and how accurate a position can be there: eps / sigma min.
///
/// # Errors
/// [`Error::NotFinite`] if a residual or an entry of the Jacobian is not a finite number.
pub fn accuracy<T, M, const U: usize, const V: usize>(mechanism: &M, pose: &M::Pose) -> Result<Accuracy<T, U>, Error>
where
    T: Real,
    M: Mechanism<T, U, V>,
{
    let equilibrated = Equilibrated::of(mechanism, pose)?;
    let residual = mechanism.residual(pose);
    let residual = largest(residual.iter().zip(equilibrated.sizes.iter()).map(|(&psi, &size)| relative(psi, size)));
    finite(M::NAME, "the residual", [residual])?;
    let sigma_min = Decomposition::of(equilibrated.unknowns).least();
    finite(M::NAME, "a singular value", [sigma_min])?;
    Ok(Accuracy { residual, sigma_min, scales: equilibrated.unknown_scales })
}

/// Vectors of the equilibrated system as rates, the entry that counts most there being 1.
fn in_units<T: Real, const N: usize>(vectors: SMatrix<T, N, N>, scales: &SVector<T, N>) -> SMatrix<T, N, N> {
    let mut vectors = vectors;
    for mut vector in vectors.column_iter_mut() {
        let leading = vector.iamax();
        for (entry, scale) in vector.iter_mut().zip(scales) {
            *entry /= *scale;
        }
        let divisor = positive(vector[leading]);
        vector.unscale_mut(divisor);
    }
    vectors
}

fn measure<T: Real, M: Mechanism<T, U, V>, const U: usize, const V: usize>(
    mechanism: &M,
    pose: &M::Pose,
    equilibrated: &Equilibrated<T, U, V>,
    group: usize,
) -> GroupMeasure<T> {
    let (zero, one) = (T::zero(), T::one());
    let Some(block) = M::GROUPS.get(group) else {
        return GroupMeasure { name: "", determinant: one, regularity: one, sigma_min: one, is_regular: true };
    };
    let determinant = mechanism.block_determinants(pose).as_ref().get(group).copied().unwrap_or(zero);
    // The block in the corner of a diagonal that is larger than any singular value of it; its columns equilibrated
    // by what they could be in these rows alone.
    let (sizes, _) = mechanism.jacobian_sizes(pose);
    let count = real::<T>(u32::try_from(U).map_or(f64::MAX, f64::from));
    let mut matrix = SMatrix::<T, U, U>::from_diagonal_element(count);
    for (column, &unknown) in block.unknowns.iter().enumerate() {
        let relative_size = |&equation: &usize| sizes[(equation, unknown)] / positive(equilibrated.sizes[equation]);
        let scale = positive(largest(block.equations.iter().map(relative_size)));
        for (row, &equation) in block.equations.iter().enumerate() {
            let entry = equilibrated.unknowns[(equation, unknown)];
            matrix[(row, column)] = entry * equilibrated.unknown_scales[unknown] / scale;
        }
    }
    let decomposition = Decomposition::of(matrix);
    let regularity = match (block.equations, block.unknowns) {
        (&[i], &[j]) => relative(determinant, sizes[(i, j)]),
        (&[i, k], &[j, l]) => {
            relative(determinant, larger(sizes[(i, j)] * sizes[(k, l)], sizes[(i, l)] * sizes[(k, j)]))
        }
        // |det| is the product of the singular values.
        _ => (0..U).fold(one, |part, place| part * decomposition.values[place] / positive(matrix.column(place).norm())),
    };
    let sigma_min = decomposition.least();
    let is_regular = sigma_min > threshold(block.unknowns.len());
    GroupMeasure { name: block.name, determinant, regularity: regularity.abs(), sigma_min, is_regular }
}

impl<T: Real, const U: usize, const V: usize> Singularity<T, U, V> {
    /// det J.
    #[must_use]
    pub fn determinant(&self) -> T {
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
        self.rank < U
    }

    /// The rank of J and A together. Where it is less than the number of unknowns, no choice of inputs is regular:
    /// branches of motion meet here, as in a flat parallelogram.
    #[must_use]
    pub fn rank_with_inputs(&self) -> usize {
        self.rank_with_inputs
    }

    /// The smallest singular value of the equilibrated J.
    #[must_use]
    pub fn sigma_min(&self) -> T {
        self.sigma_min
    }

    /// The groups, in the order in which they are solved.
    pub fn groups(&self) -> impl Iterator<Item = &GroupMeasure<T>> {
        self.groups.iter().take(self.group_count)
    }

    /// A basis of the rates u' that are possible while the inputs stand still; none where J is regular. In each
    /// the rate that matters most is 1.
    pub fn free(&self) -> impl Iterator<Item = SVector<T, U>> {
        (self.rank..U).map(|column| self.free.column(column).into_owned())
    }

    /// A basis of the input rates v' that are possible: as many as there are inputs where J is regular.
    pub fn admissible(&self) -> impl Iterator<Item = SVector<T, V>> {
        (V - self.admissible_count..V).map(|column| self.admissible.column(column).into_owned())
    }

    /// The exchanges of one input for one unknown with which J is regular.
    pub fn drivers(&self) -> impl Iterator<Item = Exchange<T>> {
        let pairs = (0..V).flat_map(|input| (0..U).map(move |unknown| (unknown, input)));
        pairs.filter_map(|(unknown, input)| {
            let sigma_min = self.exchanges[(unknown, input)];
            let exchange = Exchange { unknown: self.unknowns[unknown], input: self.inputs[input], sigma_min };
            (sigma_min > T::zero()).then_some(exchange)
        })
    }
}

impl<T: Real, const U: usize, const V: usize> fmt::Display for Singularity<T, U, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let verdict = if self.is_singular() { "singular" } else { "regular" };
        writeln!(
            f,
            "{} is {verdict}: det J = {:.3e}, rank {} of {U}, sigma min {:.1e}",
            self.mechanism,
            to_f64(self.determinant),
            self.rank,
            to_f64(self.sigma_min)
        )?;
        for group in self.groups() {
            let (regularity, sigma_min) = (to_f64(group.regularity), to_f64(group.sigma_min));
            writeln!(f, "- {}: regular to {regularity:.1e}, sigma min {sigma_min:.1e}", group.name)?;
        }
        for free in self.free() {
            write!(f, "free:")?;
            rates(f, &self.unknowns, free.iter())?;
        }
        if self.admissible_count == 0 {
            writeln!(f, "no input can move")?;
        } else if self.admissible_count < V {
            for admissible in self.admissible() {
                write!(f, "admissible:")?;
                rates(f, &self.inputs, admissible.iter())?;
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
