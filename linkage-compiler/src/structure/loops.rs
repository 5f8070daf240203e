//! Groups whose equations are loops of links: k_i + sum_j c_ij e^(i psi_j) = 0, where each direction psi_j is an integer
//! combination of the unknown angles, and loops of which some have an unknown length s along a guide: s d, or s d
//! e^(i psi) with one psi for all guides that turn.
//!
//! Two rows r and t are those of one loop, r + i t, if each direction turns them in one sense: with
//! r = sum (p cos psi + q sin psi) + k, the row t has -q cos psi + p sin psi or the negative. That is also so if the rows
//! come from an elimination, in either order and with either sign: r + i t is then the loop times 1, -1, i or -i, or its
//! conjugate. A length in several loops is left in one: L_i - (d_i / d_1) L_1 is free of it.

use std::collections::{BTreeMap, BTreeSet};

use super::directions::{Direction, Row, Waves};
use super::obstacle::Obstacle;
use crate::graph::{Graph, NodeId, Number, SymbolId};

/// The most loops of a group of which all positions can be listed.
pub const MOST_LOOPS: usize = 3;

/// The loops of a group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Loops {
    /// The factor of each unknown in each column: a direction in the place of each angle, a length in its own place.
    pub directions: Vec<Vec<i64>>,
    /// The factor of each column in each unknown: the inverse.
    pub unknowns: Vec<Vec<i64>>,
    /// k_i as real and imaginary part, by loop.
    pub constants: Vec<[NodeId; 2]>,
    /// c_ij, by loop and column; zero for lengths.
    pub factors: Vec<Vec<[NodeId; 2]>>,
    /// The guide of each unknown that is a length.
    pub guides: Vec<Option<Guide<NodeId>>>,
}

/// The guide of an unknown length s.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Guide<V> {
    /// The loop in which the length is.
    pub in_loop: usize,
    /// d of s d or s d e^(i psi), as real and imaginary part.
    pub along: [V; 2],
    /// The column of psi.
    pub with: Option<usize>,
}

impl<V> Guide<V> {
    pub fn map<W>(self, f: impl FnMut(V) -> W) -> Guide<W> {
        Guide { in_loop: self.in_loop, along: self.along.map(f), with: self.with }
    }
}

impl Loops {
    /// The loops of two or three pairs of rows.
    ///
    /// # Errors
    /// The reason why the rows have another form.
    pub fn of(graph: &mut Graph, rows: &[NodeId], unknowns: &[SymbolId]) -> Result<Self, Obstacle> {
        let size = rows.len() / 2;
        if unknowns.len() > 2 * MOST_LOOPS {
            return Err(Obstacle::MoreLoops);
        }
        let rows: Vec<Row> = rows.iter().map(|&row| Row::of(graph, row, unknowns)).collect::<Result<_, _>>()?;
        if rows.len() != unknowns.len() || !rows.len().is_multiple_of(2) || size < 2 {
            return Err(Obstacle::NotLoops);
        }
        let mut pairs = paired(graph, rows).ok_or(Obstacle::NotLoops)?;
        let senses = senses(&pairs).ok_or(Obstacle::NotLoops)?;
        let lengths: BTreeSet<usize> = pairs.iter().flat_map(|pair| pair.lengths.keys().copied()).collect();
        let matrix = columns(&senses, &lengths, unknowns.len()).ok_or(Obstacle::NotLoops)?;
        let inverse = inverse(&matrix).ok_or(Obstacle::NotLoops)?;
        let mut guides = vec![None; unknowns.len()];
        let angles: Vec<usize> = (0..unknowns.len()).filter(|index| !lengths.contains(index)).collect();
        for &length in &lengths {
            let (in_loop, guide) = keep_in_one(graph, &mut pairs, length)?;
            let with = guide.with.map(|of| senses.keys().take_while(|other| **other != of).count());
            let with = with.and_then(|index| angles.get(index).copied());
            guides[length] = Some(Guide { in_loop, along: guide.along, with });
        }
        if pairs.iter().any(|pair| pair.lengths.len() > 1) {
            return Err(Obstacle::LengthsInOneLoop);
        }
        let turning: BTreeSet<usize> = guides.iter().flatten().filter_map(|guide| guide.with).collect();
        if turning.len() > 1 {
            return Err(Obstacle::TwoGuides);
        }
        let zero = graph.zero();
        let factors = pairs.iter().map(|pair| {
            let mut factors = vec![[zero; 2]; unknowns.len()];
            for (&index, of) in angles.iter().zip(senses.keys()) {
                factors[index] = pair.waves.get(of).map_or([zero; 2], |(factor, _)| *factor);
            }
            factors
        });
        let factors = factors.collect();
        let constants = pairs.iter().map(|pair| pair.constant).collect();
        Ok(Self { directions: matrix, unknowns: inverse, constants, factors, guides })
    }

    /// k_i, c_ij and d, by loop.
    #[must_use]
    pub fn nodes(&self) -> Vec<NodeId> {
        let guides = self.guides.iter().flatten().map(|guide| &guide.along);
        self.constants.iter().chain(self.factors.iter().flatten()).chain(guides).flatten().copied().collect()
    }

    /// These loops with other expressions.
    #[must_use]
    pub fn map(self, f: impl Fn(NodeId) -> NodeId) -> Self {
        let constants = self.constants.into_iter().map(|part| part.map(&f)).collect();
        let of_loop = |factors: Vec<[NodeId; 2]>| factors.into_iter().map(|part| part.map(&f)).collect();
        let guides = self.guides.into_iter().map(|guide| guide.map(|guide| guide.map(&f))).collect();
        Self { constants, factors: self.factors.into_iter().map(of_loop).collect(), guides, ..self }
    }
}

/// The directions in the places of the angles, and the lengths; `None` if there are not as many directions as angles.
fn columns(senses: &BTreeMap<Direction, i64>, lengths: &BTreeSet<usize>, unknowns: usize) -> Option<Vec<Vec<i64>>> {
    // An unknown in a direction is no length.
    if senses.keys().any(|of| lengths.iter().any(|&length| of.0[length] != 0)) {
        return None;
    }
    let mut directions = senses.iter();
    let mut matrix = Vec::new();
    for index in 0..unknowns {
        if lengths.contains(&index) {
            matrix.push((0..unknowns).map(|other| i64::from(other == index)).collect());
        } else {
            let (of, sense) = directions.next()?;
            matrix.push(of.0.iter().map(|factor| factor * sense).collect());
        }
    }
    directions.next().is_none().then_some(matrix)
}

/// A length of a loop: d, and the direction with which its guide turns.
#[derive(Debug, Clone)]
struct Slide {
    along: [NodeId; 2],
    with: Option<Direction>,
}

/// One loop r + i t, or its conjugate.
struct Pair {
    constant: [NodeId; 2],
    /// c and the sense in which the direction turns.
    waves: BTreeMap<Direction, ([NodeId; 2], i64)>,
    lengths: BTreeMap<usize, Vec<Slide>>,
    /// The sense of the directions of the guides.
    guides: BTreeMap<Direction, i64>,
}

impl Pair {
    /// The loop of two rows.
    fn of(graph: &mut Graph, r: &Row, t: &Row) -> Option<Self> {
        let waves = turned(graph, &r.free, &t.free)?;
        let (mut lengths, mut guides) = (BTreeMap::new(), BTreeMap::new());
        let zero = Waves { constant: graph.zero(), parts: BTreeMap::new() };
        let indices: BTreeSet<usize> = r.lengths.keys().chain(t.lengths.keys()).copied().collect();
        for index in indices {
            let [of_r, of_t] = [r, t].map(|row| row.lengths.get(&index).unwrap_or(&zero));
            let mut slides = Vec::new();
            let constant = [of_r.constant, of_t.constant];
            if !constant.iter().all(|&part| graph.is_zero(part)) {
                slides.push(Slide { along: constant, with: None });
            }
            for (direction, (along, sense)) in turned(graph, of_r, of_t)? {
                if guides.insert(direction.clone(), sense).is_some_and(|other| other != sense) {
                    return None;
                }
                slides.push(Slide { along, with: Some(direction) });
            }
            lengths.insert(index, slides);
        }
        let is_turning = !(waves.is_empty() && guides.is_empty());
        is_turning.then_some(Self { constant: [r.free.constant, t.free.constant], waves, lengths, guides })
    }

    /// The senses of all directions.
    fn senses(&self) -> impl Iterator<Item = (&Direction, i64)> {
        let of_waves = self.waves.iter().map(|(direction, (_, sense))| (direction, *sense));
        of_waves.chain(self.guides.iter().map(|(direction, sense)| (direction, *sense)))
    }

    fn conjugate(&mut self, graph: &mut Graph) {
        let of_waves = self.waves.values_mut().map(|(factor, _)| factor);
        let of_lengths = self.lengths.values_mut().flatten().map(|slide| &mut slide.along);
        for [_, imaginary] in std::iter::once(&mut self.constant).chain(of_waves).chain(of_lengths) {
            *imaginary = graph.negate(*imaginary);
        }
        let senses = self.waves.values_mut().map(|(_, sense)| sense);
        senses.chain(self.guides.values_mut()).for_each(|sense| *sense = -*sense);
    }

    /// Subtracts m times another loop, in which a length has the factor d and in this one m d.
    fn reduce(&mut self, graph: &mut Graph, times: [NodeId; 2], other: &Self) {
        self.constant = less(graph, self.constant, times, other.constant);
        let zero = [graph.zero(); 2];
        for (direction, (factor, sense)) in &other.waves {
            let (mine, _) = self.waves.entry(direction.clone()).or_insert((zero, *sense));
            *mine = less(graph, *mine, times, *factor);
        }
    }
}

/// c and the sense of each direction of r + i t.
fn turned(graph: &mut Graph, r: &Waves, t: &Waves) -> Option<BTreeMap<Direction, ([NodeId; 2], i64)>> {
    if !r.parts.keys().eq(t.parts.keys()) {
        return None;
    }
    let mut waves = BTreeMap::new();
    for (direction, &[p, q]) in &r.parts {
        let turned = [graph.negate(q), p];
        let back = [q, graph.negate(p)];
        let sense = match t.parts[direction] {
            other if other == turned => 1,
            other if other == back => -1,
            _ => return None,
        };
        // p cos psi + q sin psi is the real part of (p - i sense q) e^(i sense psi).
        let imaginary = graph.scale(Number::integer(-sense), q);
        waves.insert(direction.clone(), ([p, imaginary], sense));
    }
    Some(waves)
}

/// a - m b.
fn less(graph: &mut Graph, a: [NodeId; 2], m: [NodeId; 2], b: [NodeId; 2]) -> [NodeId; 2] {
    let product = times(graph, m, b);
    [graph.subtract(a[0], product[0]), graph.subtract(a[1], product[1])]
}

fn times(graph: &mut Graph, [a, b]: [NodeId; 2], [c, d]: [NodeId; 2]) -> [NodeId; 2] {
    let [ac, bd, ad, bc] = [(a, c), (b, d), (a, d), (b, c)].map(|(one, other)| graph.multiply(one, other));
    [graph.subtract(ac, bd), graph.add(ad, bc)]
}

/// a / b: 1 or -1 if the numbers are equal but for the sign.
fn ratio(graph: &mut Graph, a: [NodeId; 2], b: [NodeId; 2]) -> [NodeId; 2] {
    for sign in [Number::ONE, Number::MINUS_ONE] {
        if b.map(|part| graph.scale(sign, part)) == a {
            return [graph.number(sign), graph.zero()];
        }
    }
    let back = [b[0], graph.negate(b[1])];
    let squares = b.map(|part| graph.power(part, 2));
    let size = graph.add(squares[0], squares[1]);
    times(graph, a, back).map(|part| graph.divide(part, size))
}

/// Eliminates a length from all loops but one, and returns that one: of the loops with the length, the one with the
/// fewest lengths.
fn keep_in_one(graph: &mut Graph, pairs: &mut [Pair], length: usize) -> Result<(usize, Slide), Obstacle> {
    let with = (0..pairs.len()).filter(|&index| pairs[index].lengths.contains_key(&length));
    let kept = with.min_by_key(|&index| pairs[index].lengths.len()).ok_or(Obstacle::NotLoops)?;
    let slide = |pair: &Pair| match pair.lengths.get(&length).map(Vec::as_slice) {
        Some([slide]) => Ok(slide.clone()),
        _ => Err(Obstacle::TwoGuides),
    };
    if pairs[kept].lengths.len() > 1 {
        return Err(Obstacle::LengthsInOneLoop);
    }
    let guide = slide(&pairs[kept])?;
    let (before, rest) = pairs.split_at_mut(kept);
    let Some((pivot, after)) = rest.split_first_mut() else { return Err(Obstacle::NotLoops) };
    for pair in before.iter_mut().chain(after).filter(|pair| pair.lengths.contains_key(&length)) {
        let other = slide(pair)?;
        if other.with != guide.with {
            return Err(Obstacle::TwoGuides);
        }
        let times = ratio(graph, other.along, guide.along);
        pair.reduce(graph, times, pivot);
        pair.lengths.remove(&length);
    }
    Ok((kept, guide))
}

/// The loops of all rows, such that each direction turns in one sense.
fn paired(graph: &mut Graph, mut rows: Vec<Row>) -> Option<Vec<Pair>> {
    let mut pairs: Vec<Pair> = Vec::new();
    while !rows.is_empty() {
        let first = rows.remove(0);
        let found = rows.iter().enumerate().find_map(|(index, row)| Some((index, Pair::of(graph, &first, row)?)));
        let (index, pair) = found?;
        rows.remove(index);
        pairs.push(pair);
    }
    // Most directions turn as they are written.
    for pair in &mut pairs {
        if pair.senses().map(|(_, sense)| sense).sum::<i64>() < 0 {
            pair.conjugate(graph);
        }
    }
    let mut known: BTreeMap<Direction, i64> = BTreeMap::new();
    let mut settled = Vec::new();
    while !pairs.is_empty() {
        let is_joined = |pair: &Pair| pair.senses().any(|(direction, _)| known.contains_key(direction));
        let index = pairs.iter().position(is_joined).unwrap_or(0);
        let mut pair = pairs.remove(index);
        if pair.senses().any(|(direction, sense)| known.get(direction).is_some_and(|other| *other != sense)) {
            pair.conjugate(graph);
        }
        known.extend(pair.senses().map(|(direction, sense)| (direction.clone(), sense)));
        settled.push(pair);
    }
    Some(settled)
}

/// The sense of each direction; `None` if one turns in both.
fn senses(pairs: &[Pair]) -> Option<BTreeMap<Direction, i64>> {
    let mut senses = BTreeMap::new();
    for (direction, sense) in pairs.iter().flat_map(Pair::senses) {
        if senses.insert(direction.clone(), sense).is_some_and(|other| other != sense) {
            return None;
        }
    }
    Some(senses)
}

/// The inverse of a matrix of integers, if it has integers only: its determinant is 1 or -1.
fn inverse(matrix: &[Vec<i64>]) -> Option<Vec<Vec<i64>>> {
    let whole = determinant(matrix);
    let minor = |row: usize, column: usize| -> i64 {
        let rows = matrix.iter().enumerate().filter(|(index, _)| *index != row).map(|(_, entries)| {
            entries.iter().enumerate().filter(|(index, _)| *index != column).map(|(_, entry)| *entry).collect()
        });
        let sign = if (row + column).is_multiple_of(2) { 1 } else { -1 };
        sign * determinant(&rows.collect::<Vec<Vec<i64>>>())
    };
    let indices = 0..matrix.len();
    let column = |row: usize| indices.clone().map(|column| whole * minor(column, row)).collect();
    (whole.abs() == 1).then(|| indices.clone().map(column).collect())
}

fn determinant(matrix: &[Vec<i64>]) -> i64 {
    let Some((first, rest)) = matrix.split_first() else { return 1 };
    let terms = first.iter().enumerate().filter(|(_, entry)| **entry != 0).map(|(column, entry)| {
        let minor = rest.iter().map(|row| [&row[..column], &row[column + 1..]].concat());
        let sign = if column.is_multiple_of(2) { 1 } else { -1 };
        sign * entry * determinant(&minor.collect::<Vec<Vec<i64>>>())
    });
    terms.sum()
}
